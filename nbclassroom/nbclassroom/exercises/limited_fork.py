"""Compute a text under limits that hold whatever runs: C calls that no signal ends, broadcasts, recursion.

It is computed in a fork of this process. A new interpreter would be too slow, and could not be sent what an
answer uses: functions and values of the notebook. The other threads of the kernel (ROS, ZMQ) do not exist in
the fork. It uses nothing that is theirs, runs no exit handlers, and is killed in time if it waits for them.
"""

import contextlib
import gc
import logging
import os
import select
import signal
import sys
import time
import warnings
from pathlib import Path

_LONGEST_TEXT = 4_000  # bytes, which one write puts into a pipe
_LOOK = 0.05  # seconds between two looks at the clock
_PATIENCE = 0.7  # seconds that the fork may wait for a processor, in addition
_MEMORY = 60_000_000  # bytes


def text_within(compute, seconds):
    """The text that compute() returns; "" if it raises, does not end in time, or this system is not Linux.

    What it does to arrays, files of the standard streams and other memory does not reach this process.
    """
    if sys.platform != "linux":  # elsewhere libraries do not work in a fork
        return ""
    reader, writer = os.pipe()
    with os.fdopen(reader, "rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of threads
        child = os.fork()
        if child == 0:
            _compute(compute, writer, seconds)
        os.close(writer)
        try:
            return _read(file, child, seconds)
        finally:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


def limit_memory():
    """Let this process grow by 60 MB beyond the most that it has had; what needs more raises MemoryError."""
    import resource

    peak = int(Path("/proc/self/status").read_text().partition("VmPeak:")[2].split()[0]) * 1024
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (peak + _MEMORY, most))


def _compute(compute, writer, seconds):
    """What the fork does; it does not return."""
    import resource

    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is for the process that waits
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 2,) * 2)  # if nobody kills it
        null = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(null, stream)
        gc.freeze()  # a collection would write to all objects, and so copy their memory
        logging.disable()  # a handler writes past what a call redirects
        os.write(writer, compute().encode("utf-8", "replace")[:_LONGEST_TEXT])
    finally:
        os._exit(0)


def _read(file, child, seconds):
    """What the fork writes, within seconds that do not count while it waits for a processor."""
    began, waited = time.monotonic(), 0.0
    while time.monotonic() - began - min(waited, _PATIENCE) < seconds:
        if select.select([file], [], [], _LOOK)[0]:
            return file.read(_LONGEST_TEXT).decode("utf-8", "replace")
        with contextlib.suppress(OSError, IndexError):
            waited = int(Path(f"/proc/{child}/schedstat").read_text().split()[1]) / 1e9
    return ""
