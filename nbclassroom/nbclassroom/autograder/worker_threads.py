"""The threads that grade; each has an nbval process, which can start before there is anything to grade.

Little is imported here, so that nbval processes start while the rest of a command is imported.
"""

import contextlib
import itertools
import os
from concurrent.futures import ThreadPoolExecutor

from .nbval_process import nbval_process_of_thread, stop_nbval_processes
from .temporary_folder import remove_abandoned_folders

_numbers = itertools.count(1)


def usual_workers(lessons):
    """How many submissions to grade at once; `lessons` are those of keys.

    A worker with its kernels, the next submission and the pages keep two cores busy; a robot keeps one.
    """
    cores, kinds = os.cpu_count() or 1, (each.kind for lesson in lessons for each in lesson.exercises)
    return (cores + 1) // 2 if all(kind.shares_kernel for kind in kinds) else cores


@contextlib.contextmanager
def open_worker_threads(workers=None, *, early=False, unsafe=False, limits=None):
    """A thread pool whose nbval processes are stopped at the end; `early`: they start now.

    They are stopped before the threads: a process ends at once with the thread that started it.
    """
    workers, prefix = workers or os.cpu_count() or 1, f"autograde-{next(_numbers)}-"
    executor = ThreadPoolExecutor(workers, thread_name_prefix=prefix)
    try:
        for _ in range(workers if early else 0):  # an error comes again with the first submission
            executor.submit(nbval_process_of_thread, unsafe, limits)
        yield executor
    finally:
        stop_nbval_processes(prefix, for_good=True)
        executor.shutdown()
        # The next run after a killed one perhaps finds everything graded, and needs no folder of its own.
        remove_abandoned_folders()
