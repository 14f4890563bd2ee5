"""The process that forks kernels: it has the imports loaded, and never runs code of a learner's.

`fork_server_client` starts it with a socket (SOCK_SEQPACKET). It takes these orders:
    {"op": "fork", "id": 7, "allowed": [...], "limits": {...}, "has_time": true}, with the kernel's
                                              socket; "has_time" if it will wait for its first cell
    {"op": "end", "id": 7, "patience": 1.0}   kill the kernel and all that it started; reply how it had ended
    {"op": "drop", "id": 7}                   the same; reply null at once if it had started nothing
It ends when its socket is closed.
"""

import gc
import json
import os
import random
import signal
import socket
import sys
import time

from imgproc_course.classroom.autograder.sandbox.inside import confine

_USUAL_CELLS = (
    "def f(x):\n    return np.zeros(3) + x",
    "from imgproc_course.classroom.autograder.sandbox.inside.check_cell import emit\n\nemit(f)",
)


def _load():
    """Load what kernels need; returns the shell and what each fork calls."""
    import asyncio  # noqa: F401 - loaded for the forks
    import getpass  # noqa: F401
    import statistics  # noqa: F401

    import numpy as np
    import numpy.linalg
    import numpy.random

    from imgproc_course.classroom.autograder.sandbox.inside import check_cell, refusal, shell

    cell_shell = shell.make_shell()
    cell_shell.user_ns["np"] = np

    def warm_up(cells):
        _warm_up(cell_shell, shell, check_cell, cells)

    warm_up([*_USUAL_CELLS, "1/0"])
    cell_shell.display_formatter.format(0)  # makes the formatters, else each kernel would
    # Answers may draw from NumPy's global generator; its state is the same in each fork.
    np.random.seed(0)  # noqa: NPY002 - the global generator is meant, not one of ours
    return cell_shell, shell.serve, check_cell, refusal.allow_modules, warm_up


def _warm_up(cell_shell, shell, check_cell, cells):
    """Run what every kernel will run, so that all that is loaded at first use is loaded already.

    A fork that runs the usual cells too, while it waits, has its own copies of the memory pages that they
    write to.
    """
    shell.WRITER.descriptor = os.open(os.devnull, os.O_WRONLY)
    streams = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = shell.OutputStream("stdout"), shell.OutputStream("stderr")
    check_cell.deliver('{"calls": [{"tuple": [1.5]}], "seconds": 5}')
    for code in cells:
        cell_shell.run_cell(code, store_history=False)
    del cell_shell.user_ns["f"], cell_shell.user_ns["emit"]
    sys.stdout, sys.stderr = streams
    os.close(shell.WRITER.descriptor)


def _run_kernel(control, descriptor, order, settings, loaded):
    """What a fork does; it does not return."""
    exit_code = 70  # the fork could not be confined
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        control.close()
        confine.close_descriptors(but=descriptor)
        if settings["confined"]:
            # A process group of its own: a signal to the group reaches every process in it, in any PID
            # namespace, and the kernel that waits for the next check has the same user.
            os.setsid()
            confine.die_first()
            user = settings["user"]
            user = None if user is None else user + order["id"] % confine.USERS_OF_SERVER
            confine.confine(order["limits"], user)
        else:
            confine.die_with_parent()
            confine.set_limits(order["limits"] | {"processes": 4096})
        os.write(descriptor, b"\n")  # it is confined; until now nobody else's code ran
        cell_shell, serve, check_cell, allow_modules, warm_up = loaded
        check_cell.refuse_input()
        allow_modules(order["allowed"])
        if order["has_time"]:
            warm_up(_USUAL_CELLS)
        random.seed(0)  # Python draws another seed in each fork
        exit_code = 71  # the learner's code ended it
        serve(cell_shell, descriptor, check_cell.deliver)
        exit_code = 0
    finally:
        os._exit(exit_code)


def main():
    confine.leave_session_keyring()
    settings = json.loads(sys.argv[1])
    control = socket.socket(fileno=settings["control"])
    loaded = _load()
    null = os.open(os.devnull, os.O_RDWR)
    for standard_stream in (0, 1, 2):
        os.dup2(null, standard_stream)
    namespace = confine.open_pid_namespace() if settings["confined"] else None
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
            kernels[order["id"]] = _fork(control, descriptors[0], order, settings, loaded, namespace)
        elif order["op"] == "end":
            status = _end(kernels.pop(order["id"]), order["patience"]) if order["id"] in kernels else None
            control.send(json.dumps(status).encode())
        else:
            if order["id"] in kernels:  # else it was a kernel of a fork server before this one
                _drop(kernels.pop(order["id"]), {*kernels.values(), *ending}, ending)
            control.send(b"null")
        ending -= {child for child in ending if os.waitpid(child, os.WNOHANG)[0]}


def _fork(control, descriptor, order, settings, loaded, namespace):
    if namespace is not None:
        confine.unshare(confine.NEWPID)
    child = os.fork()
    if child == 0:
        _run_kernel(control, descriptor, order, settings, loaded)
    if namespace is not None:
        confine.return_to_pid_namespace(namespace)
    os.close(descriptor)
    return child


def _drop(child, others, ending):
    """Kill a kernel. The next one runs only after every process that it started has ended."""
    os.kill(child, signal.SIGKILL)  # first: until then it can start another one
    started = {int(entry.name) for entry in os.scandir("/proc") if entry.name.isdigit()}
    if started - others - {1, os.getpid(), child}:
        os.waitpid(child, 0)
    else:  # do not wait: the system takes some time to remove a kernel's namespaces
        ending.add(child)


def _end(child, patience):
    """How a kernel ended: by itself within `patience` seconds (signal or exit code), or killed here."""
    ended_child, status, usage = os.wait4(child, os.WNOHANG)
    give_up = time.monotonic() + patience
    while ended_child == 0 and time.monotonic() < give_up:
        time.sleep(0.001)
        ended_child, status, usage = os.wait4(child, os.WNOHANG)
    if ended_child == 0:
        os.kill(child, signal.SIGKILL)
        _, status, usage = os.wait4(child, 0)
    return {
        "signal": os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0,
        "code": os.WEXITSTATUS(status) if os.WIFEXITED(status) else 0,
        "cpu": usage.ru_utime + usage.ru_stime,
    }


if __name__ == "__main__":
    main()
