"""The process that forks kernels: it has the imports loaded, and never runs anything of a learner's.

Started by `imgproc_course.autograder.sandbox.bubblewrap` with a socket (SOCK_SEQPACKET). It takes
    {"op": "fork", "id": 7, "hidden": [...], "refused": [...], "limits": {...}}, the kernel's socket with it
    {"op": "end", "id": 7}: kill the kernel and all that it started; answered by how it had ended
    {"op": "drop", "id": 7}: the same without an answer
and goes when its socket is closed.
"""

import gc
import json
import os
import random
import signal
import socket
import sys
import time

from imgproc_course.autograder.sandbox.inside import confine


def _load():
    """Load what kernels find loaded; returns the shell and what each fork calls."""
    import asyncio  # noqa: F401 - loaded for the forks
    import getpass  # noqa: F401
    import statistics  # noqa: F401

    import numpy as np
    import numpy.linalg
    import numpy.random

    from imgproc_course.autograder.sandbox.inside import check_cell, shell

    made = shell.make_shell()
    made.user_ns["np"] = np
    _warm_up(made, shell, check_cell)
    # Answers may draw from NumPy's global generator; its state is the same in each fork.
    np.random.seed(0)  # noqa: NPY002 - it is that one which is seeded here, not one of ours
    return made, shell.serve, check_cell.surround, check_cell.deliver


def _warm_up(made, shell, check_cell):
    """Run what every kernel will run, so that it finds loaded what is loaded at the first use."""
    shell.LINE.descriptor = os.open(os.devnull, os.O_WRONLY)
    streams = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = shell.Stream("stdout"), shell.Stream("stderr")
    check_cell.deliver('{"calls": [{"tuple": [1.5]}], "seconds": 5, "refused": []}')
    for code in (
        "def f(x):\n    return np.zeros(3) + x",
        "from imgproc_course.autograder.sandbox.inside.check_cell import emit\n\nemit(f)",
        "1/0",
        "del f, emit",
    ):
        made.run_cell(code, store_history=False)
    sys.stdout, sys.stderr = streams
    os.close(shell.LINE.descriptor)


def _kernel(control, descriptor, order, settings, loaded):
    """What a fork does; it does not come back."""
    code = 70  # the fork could not be shut in
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        control.close()
        if settings["confined"]:
            # A group of its own: a signal to the group reaches every process in it, in any PID namespace, and
            # the kernel that waits for the next check has the same user.
            os.setsid()
            confine.die_first()
            confine.confine(order["hidden"], order["limits"], settings["user"])
        else:
            confine.die_with_parent()
            confine.set_limits(order["limits"] | {"processes": 4096})
        made, serve, surround, deliver = loaded
        random.seed(0)  # Python draws another seed in each fork
        surround(order["refused"])
        code = 71  # something of the learner's ended it
        serve(made, descriptor, deliver)
        code = 0
    finally:
        os._exit(code)


def main():
    settings = json.loads(sys.argv[1])
    control = socket.socket(fileno=settings["control"])
    loaded = _load()
    null = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(null, standard)
    home = confine.own_pid_namespace() if settings["confined"] else None
    gc.collect()
    gc.freeze()
    control.send(json.dumps({"ready": True, "modules": sorted(sys.modules)}).encode())
    kernels, ending = {}, set()
    while True:
        text, descriptors, _, _ = socket.recv_fds(control, 1 << 20, 1)
        if not text:
            return
        order = json.loads(text)
        if order["op"] == "fork":
            kernels[order["id"]] = _fork(control, descriptors[0], order, settings, loaded, home)
        elif order["op"] == "end":
            ended = _end(kernels.pop(order["id"]), order["patience"])
            control.send(json.dumps(ended).encode())
        else:
            ending.add(kernels[order["id"]])
            os.kill(kernels.pop(order["id"]), signal.SIGKILL)
        # Reaped when it is convenient: the system takes some time to clear a kernel's namespaces away.
        ending -= {child for child in ending if os.waitpid(child, os.WNOHANG)[0]}


def _fork(control, descriptor, order, settings, loaded, home):
    if home is not None:
        confine.unshare(confine.NEWPID)
    child = os.fork()
    if child == 0:
        _kernel(control, descriptor, order, settings, loaded)
    if home is not None:
        confine.back_to(home)
    os.close(descriptor)
    return child


def _end(child, patience):
    """How a kernel ended: by itself within `patience` seconds (its signal or exit code), or killed here."""
    found, status, usage = os.wait4(child, os.WNOHANG)
    until = time.monotonic() + patience
    while found == 0 and time.monotonic() < until:
        time.sleep(0.001)
        found, status, usage = os.wait4(child, os.WNOHANG)
    if found == 0:
        os.kill(child, signal.SIGKILL)
        _, status, usage = os.wait4(child, 0)
    return {
        "signal": os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0,
        "code": os.WEXITSTATUS(status) if os.WIFEXITED(status) else 0,
        "cpu": usage.ru_utime + usage.ru_stime,
    }


if __name__ == "__main__":
    main()
