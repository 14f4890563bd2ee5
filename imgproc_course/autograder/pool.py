"""Grade submissions, many at a time, in order.

    key = load_key("key")
    answers = {"messages-decode": "def decode(message): ..."}   # the source of each answer cell, by exercise
    for graded in autograde([("ada", "images_as_messages", answers)], key):
        print(graded.name, graded.points, "of", graded.max_points)

Each thread or process that grades keeps one nbval process (`nbval_process`) and sends it one submission after
another. nbval runs the answers in kernels inside the sandbox. The checks of an exercise share a kernel as
long as they pass; every other result comes from a kernel of its own.
"""

import contextlib
import itertools
import os
from collections import deque
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path

from imgproc_course.autograder.answer_key import Key, load_key
from imgproc_course.autograder.nbval_process import (
    NbvalProcessEnded,
    nbval_process_of_thread,
    stop_nbval_processes,
)
from imgproc_course.autograder.outcomes import Outcome
from imgproc_course.autograder.results import GradedSubmission, ungraded_exercise
from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.bubblewrap import Limits, SandboxError
from imgproc_course.autograder.sandbox.kernel_factory import KINDS

__all__ = ["Limits", "SandboxError", "autograde", "grade_one", "open_scheduler"]

_QUEUE_PER_WORKER = 4  # submissions that are submitted before their results are taken

_pool_numbers = itertools.count(1)


def autograde(submissions, key, *, kernel="fast", unsafe=False, workers=None, executor=None, limits=None):
    """Grade submissions, lazily and in order.

    Parameters
    ----------
    submissions : iterable of (name, lesson, answers); name is any str, lesson the name of a lesson in the
        key, answers a dict of exercise id -> source of its answer cell (an exercise without one is left out).
        It is read as results are taken, so a generator of thousands needs no memory
    key : Key, from `load_key`
    kernel : "fast", or "ipykernel" for Jupyter's own (some twenty times slower; the same outcomes)
    unsafe : bool, run without a sandbox
    workers : int, how many are graded at once; None: the number of this machine's cores
    executor : concurrent.futures.Executor that runs `grade_one` elsewhere (see `open_scheduler`); None:
        threads of this process
    limits : Limits of one kernel; None: the default ones

    Yields
    ------
    GradedSubmission, one per submission, in the order of `submissions`

    Raises
    ------
    SandboxError : there is no sandbox here; raised before anything is run, one line with the remedy
    ValueError : a lesson that is not in the key, an unknown kernel; raised before anything of it is run
    """
    if kernel not in KINDS:
        raise ValueError(f"kernel {kernel!r}: expected {' or '.join(KINDS)}")
    if executor is None and not unsafe:
        bubblewrap.require_sandbox()
    options = {"kernel": kernel, "unsafe": unsafe, "limits": limits}
    return _grade_all(submissions, key, options, workers or os.cpu_count() or 1, executor)


def _grade_all(submissions, key, options, workers, executor):
    futures = deque()
    with contextlib.ExitStack() as stack:
        if executor is None:
            executor = stack.enter_context(_threads(workers))
        elif not isinstance(executor, Executor) and not hasattr(executor, "submit"):
            raise TypeError(
                f"executor: expected a concurrent.futures.Executor, got {type(executor).__name__}"
            )
        submissions = iter(submissions)
        while True:
            free_places = workers * _QUEUE_PER_WORKER - len(futures)
            for name, lesson, answers in itertools.islice(submissions, free_places):
                _check_lesson(lesson, key)
                submission = (name, lesson, dict(answers))
                futures.append(executor.submit(grade_one, submission, str(key.path), key.digest, **options))
            if not futures:
                return
            yield futures.popleft().result()


@contextlib.contextmanager
def _threads(workers):
    """A thread pool whose nbval processes are stopped at the end."""
    prefix = f"autograde-{next(_pool_numbers)}-"
    executor = ThreadPoolExecutor(workers, thread_name_prefix=prefix)
    try:
        yield executor
    finally:
        executor.shutdown(cancel_futures=True)
        stop_nbval_processes(prefix)


def _check_lesson(lesson, key):
    if lesson not in key.lessons:
        raise ValueError(f"lesson {lesson!r} is not in the key, which has {', '.join(key.lessons)}")


def grade_one(submission, key, digest=None, *, kernel="fast", unsafe=False, limits=None):
    """Grade one submission; a plain function that any Executor can run, in this process or another.

    Parameters
    ----------
    submission : (name, lesson, answers), as `autograde` takes them
    key : path of the key's folder, which must exist on the machine that runs this; or a Key
    digest : str, `Key.digest` of the expected key, any other key is refused; None: any key
    kernel, unsafe, limits : as `autograde`

    Returns
    -------
    GradedSubmission

    Raises
    ------
    SandboxError : there is no sandbox on the machine that runs this
    KeyFolderError, ValueError : there is no such key, or another one
    """
    path = key.path if isinstance(key, Key) else Path(key)
    for _ in range(2):
        try:
            return nbval_process_of_thread(path, digest, kernel, unsafe, limits).grade(*submission)
        except NbvalProcessEnded:
            continue  # again in a new process: an earlier submission must not cost this one anything
    return _not_graded(load_key(path), *submission)


def _not_graded(key, name, lesson, _answers):
    message = "the nbval process ended twice on this submission: look at it by hand"
    exercises = tuple(
        ungraded_exercise(exercise, Outcome.NOT_GRADED, message)
        for exercise in key.lessons[lesson].exercises
        if not exercise.practice
    )
    return GradedSubmission(name, lesson, key.lessons[lesson].version, exercises)


def open_scheduler(address, *, patience=20):
    """An Executor over the workers of a Dask cluster, for `autograde(..., executor=...)`.

    Every worker needs this package, bubblewrap, and the key's folder at the same path (a shared disk). A
    worker that dies is replaced, and the submission that it was grading is graded again.

    Parameters
    ----------
    address : str, "tcp://10.0.0.5:8786"
    patience : float, seconds to wait for the scheduler's answer

    Returns
    -------
    context manager that gives the Executor

    Raises
    ------
    ValueError : Dask is not installed, or nothing answers there
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise ValueError(
            'a scheduler needs Dask: pip install "imgproc-course[scheduler]" here and on its workers'
        ) from error
    return _scheduler(Client, address, patience)


@contextlib.contextmanager
def _scheduler(make_client, address, patience):
    try:
        client = make_client(address, timeout=patience)
    except OSError as error:
        raise ValueError(f"no Dask scheduler answers at {address} ({error})") from error
    with client, client.get_executor(pure=False, retries=3) as executor:
        yield executor
