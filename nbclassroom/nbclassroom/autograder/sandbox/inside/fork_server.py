"""The process that forks kernels: it has the imports loaded, and never runs code of a learner's.

`fork_server_client` starts it with a socket (SOCK_SEQPACKET). It takes these orders:
    {"op": "fork", "id": 7}                   with the kernel's socket, and memory for its place in a page
    {"op": "prepare", "code": [...], "draws": true}
                                              compile a lesson's cells, as handed out; load matplotlib
    {"op": "end", "id": 7, "patience": 1.0}   kill the kernel and all that it started, if it does not end by
                                              itself within a second; reply how it ended, null without
                                              patience
It ends when its socket is closed.
"""

import builtins
import gc
import json
import mmap
import os
import signal
import socket
import sys

from nbclassroom.autograder.sandbox.inside import PLACE, confine
from nbclassroom.exercises.cell_syntax import plain_python
from nbclassroom.exercises.page_run import compiled

# They use what is loaded at its first use.
_USUAL_CELLS = (
    "def f(x):\n    return np.zeros(3) + x",
    "from nbclassroom.autograder.sandbox.inside.check_cell import emit\n\nemit(f)",
    "1/0",
    "del f, emit",
)


def _load():
    """Load what kernels need; returns what each fork calls while it waits, and then with its socket."""
    import asyncio  # noqa: F401 - loaded for the forks
    import getpass  # noqa: F401
    import statistics  # noqa: F401

    import numpy as np
    import numpy.linalg
    import numpy.random

    from nbclassroom.autograder.sandbox.inside import check_cell, refusal, shell

    cell_shell = shell.make_shell()
    cell_shell.user_ns["np"] = np

    def warm_up():
        """Load what is loaded at its first use; in a fork, copy the memory pages that a check writes to."""
        check_cell.deliver({"calls": [{"tuple": [1.5]}], "seconds": 5})
        shell.run_unseen(cell_shell, _USUAL_CELLS)

    warm_up()
    cell_shell.display_formatter.format(0)  # makes the formatters, else each kernel would

    def run_cells(descriptor, place):
        requests = shell.read_requests(socket.socket(fileno=descriptor))
        beginning, _ = next(requests)
        allowed = beginning["allowed"]
        confine.set_time_limit(beginning["cpu"])
        builtins.input = check_cell.refuse_input  # nobody would answer
        if "rclpy" in allowed:
            # Few exercises need it: a double of ROS, because nothing here can reach a network.
            from nbclassroom.exercises.kinds.node.ros_double import offer_modules

            offer_modules(even_if_installed=True)
        refusal.allow_modules(allowed)
        refusal.tell_attempts(shell.WRITER.tell_attempt)
        shell.WRITER.descriptor, shell.WRITER.place = descriptor, place
        shell.Server(cell_shell).serve(requests)

    return warm_up, run_cells


def _run_kernel(control, descriptors, kernel_id, settings, warm_up, run_cells):
    """What a fork does; it does not return."""
    exit_code = 70  # the fork could not be confined
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        control.close()
        descriptor, place = descriptors[0], mmap.mmap(descriptors[1], PLACE.size)
        os.closerange(3, descriptor)  # all others but the standard streams
        os.closerange(descriptor + 1, 1 << 20)
        if settings["confined"]:
            # A process group of its own: a signal to the group reaches every process in it, in any PID
            # namespace, and the kernel that waits for the next check has the same user.
            os.setsid()
            confine.die_first()
            user = settings["user"] and settings["user"] + kernel_id % confine.USERS_OF_SERVER
            confine.confine(settings["limits"], user)
        else:
            confine.die_with_parent()
            confine.set_limits(settings["limits"] | {"processes": 4096})
        os.write(descriptor, b"\n")  # it is confined; until now nobody else's code ran
        warm_up()
        exit_code = 71  # the learner's code ended it
        run_cells(descriptor, place)
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
    namespace = os.open("/proc/self/ns/pid", os.O_RDONLY | os.O_CLOEXEC) if settings["confined"] else None
    gc.collect()
    gc.freeze()
    control.send(b"ready")
    kernels: dict[int, int] = {}
    ending: set[int] = set()
    while True:
        text, descriptors, _, _ = socket.recv_fds(control, 1 << 20, 2)
        if not text:
            return
        order = json.loads(text)
        if order["op"] == "fork":
            child = _fork(control, descriptors, order["id"], settings, loaded, namespace)
            kernels[order["id"]] = child
        elif order["op"] == "prepare":
            for source in order["code"]:
                compiled(plain_python(source))
            if order["draws"]:  # half a second, and more memory for each fork
                import matplotlib.pyplot as plt  # noqa: F401
            gc.freeze()
        else:
            child, status = kernels.pop(order["id"], None), None
            if child is None:  # a kernel of a fork server before this one
                pass
            elif order["patience"]:
                status = confine.end_child(child, order["patience"])
            elif _kill(child, {*kernels.values(), *ending}):
                ending.add(child)
            control.send(json.dumps(status).encode())
        ending -= {child for child in ending if os.waitpid(child, os.WNOHANG)[0]}


def _fork(control, descriptors, kernel_id, settings, loaded, namespace):
    if namespace is not None:
        confine.unshare(confine.NEWPID)
    child = os.fork()
    if child == 0:
        _run_kernel(control, descriptors, kernel_id, settings, *loaded)
    if namespace is not None:
        confine.return_to_pid_namespace(namespace)
    for descriptor in descriptors:
        os.close(descriptor)
    return child


def _kill(child, others):
    """Kill a kernel with all that it started; whether it had started nothing, and may go on ending."""
    os.kill(child, signal.SIGKILL)  # first: until then it can start another one
    started = {int(entry.name) for entry in os.scandir("/proc") if entry.name.isdigit()}
    if started - others - {1, os.getpid(), child}:
        os.waitpid(child, 0)
        return False
    return True  # the system takes some milliseconds to remove its namespaces
