"""What all processes of a sandbox use together: the limits of `inside/confine.py` hold for each process.

Sixty processes of two gigabytes each may use a hundred and twenty, so the code that waits for them asks here.
"""

from contextlib import suppress

import psutil


def used_under(root, exact_above):
    """(bytes, seconds of processor time) that a process and its descendants use.

    Above `exact_above` bytes, pages that they share are counted once, which takes longer.
    """
    try:
        process = psutil.Process(root)
        processes = [process, *process.children(recursive=True)]
    except psutil.Error:
        return 0, 0.0
    memory = sum(map(_memory_of, processes))
    if memory > exact_above:
        memory = sum(_memory_of(process, exactly=True) for process in processes)
    return memory, sum(map(_seconds_of, processes))


def _seconds_of(process):
    """Of a process and of those children that it has waited for."""
    with suppress(psutil.Error):  # it has ended in the meantime
        return sum(process.cpu_times()[:4])
    return 0.0


def _memory_of(process, *, exactly=False):
    with suppress(psutil.Error):
        if exactly:
            with suppress(psutil.AccessDenied):
                memory = process.memory_full_info()
                return memory.pss + memory.swap
        return process.memory_info().rss
    return 0
