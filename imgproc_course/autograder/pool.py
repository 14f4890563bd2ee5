"""Judge answers: nbval compares what they return with the key, in a sandbox, many at a time.

    key = load_key("key")
    answers = {"messages-decode": "def decode(message): ..."}   # the source of each answer cell, by exercise
    for result in autograde([("ada", "02_images_as_messages", answers)], key):
        print(result["submission"], result["got"], "of", result["points"])

A result is a dict that JSON holds. It depends on the answers and the key alone: not on the order of the
submissions, on how many are judged at once, on the time of day or on other submissions.

    submission   the name that `autograde` was given for it
    lesson       "02_images_as_messages";  version: the course's version that the key was made from
    points, got  of the lesson's graded exercises
    exercises    one a graded exercise, in the lesson's order (practice exercises are not graded):
        id, title, points, got
        mistake        name of the known wrong answer that this one is, or ""; mistake_says: what to tell
        said           of the answer's cell itself: "its cell ended with NameError: ..." (that costs nothing
                       as long as the function is defined), or why it was not run; "" for nothing
        cases          one a check, public ones first:
            id, title, points, got, hidden
            outcome    "passed"
                       "wrong"            came back, and is not what was expected; or the input was changed
                       "raised"           an exception, of the function or of the cell that should define it
                       "not attempted"    the stub, or NotImplementedError
                       "missing"          no answer cell, or it does not define the function
                       "refused module"   uses a module that the exercise refuses
                       "time" "memory" "output"   more than an answer may use
                       "crashed"          the kernel's process ended
                       "hostile"          what came out is nothing that our check cells could have shown
                       "not judged"       the judge itself failed (a teacher must look; never seen in tests)
            hint       the master's, "" where the case passed
            said       what went wrong, plain text, shortened; of a hidden case never a word of the learner's
            and, of a public case that did not pass, the first call that failed:
            call       its number, from 0
            given      canonical forms of its arguments (their names: `KeyExercise.arguments`)
            expected   canonical form;  actual: canonical form, or None where nothing came back
            printed    what the function printed

Texts are plain (no escape sequences, no control characters) but not HTML: escape them where HTML is written.
Given, expected and actual are `exercises.canonical` forms: `array_of`, `describe` and `compare` take them.

How it works: each thread or process that judges keeps one pytest with nbval at its side (`judge_plugin`),
started so that nothing on this machine or in a submission can configure it, and sends it one submission after
another. That pytest never runs learners' code either; kernels do (`kernel/`). The checks of an exercise share
a kernel as long as they pass; whatever else comes of a check comes from a kernel of its own.
"""

import atexit
import contextlib
import itertools
import json
import os
import select
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections import deque
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from imgproc_course.autograder.answer_key import Key, load_key
from imgproc_course.autograder.results import refused_result, submission_result
from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.bubblewrap import Limits, SandboxError
from imgproc_course.autograder.sandbox.kernels import KINDS

__all__ = ["Limits", "SandboxError", "autograde", "grade_one", "open_scheduler", "stop_judges"]

_DESCRIPTOR = "IMGPROC_JUDGE_SOCKET"
_START_SECONDS = 120
_AHEAD = 4  # submissions a worker that are handed over before their results are taken


def autograde(submissions, key, *, kernel="fast", unsafe=False, workers=None, executor=None, limits=None):
    """Judge submissions, lazily and in order.

    Parameters
    ----------
    submissions : iterable of (name, lesson, answers); name is any str, lesson the name of one in the key,
        answers a dict of exercise id -> source of its answer cell (left out where there is none). It is read
        as results are taken, so a generator over thousands needs no memory
    key : Key, from `load_key`
    kernel : "fast", or "ipykernel" for Jupyter's own (some twenty times slower; the same outcomes)
    unsafe : bool, run without a sandbox
    workers : int, how many are judged at once; the number of this machine's cores where left out
    executor : concurrent.futures.Executor that runs `grade_one` somewhere else (see `open_scheduler`), or
        None for threads here
    limits : Limits of one kernel, or None for the usual ones

    Yields
    ------
    dict, one a submission, in the order of `submissions`

    Raises
    ------
    SandboxError : there is no sandbox here, before anything is run; one line with the remedy
    ValueError : a lesson that is not in the key, an unknown kernel; before anything is run of it
    """
    if kernel not in KINDS:
        raise ValueError(f"kernel {kernel!r}: there are {' and '.join(KINDS)}")
    if executor is None and not unsafe:
        bubblewrap.demand()
    return _judged(submissions, key, (kernel, unsafe, limits), workers or os.cpu_count() or 1, executor)


def _judged(submissions, key, how, workers, executor):
    kernel, unsafe, limits = how
    waiting = deque()
    with contextlib.ExitStack() as stack:
        if executor is None:
            prefix = f"judge-{next(_pools)}-"
            stack.callback(stop_judges, prefix)
            executor = ThreadPoolExecutor(workers, thread_name_prefix=prefix)
            stack.callback(executor.shutdown, cancel_futures=True)
        elif not isinstance(executor, Executor) and not hasattr(executor, "submit"):
            raise TypeError(
                f"executor: expected a concurrent.futures.Executor, got {type(executor).__name__}"
            )
        handed = iter(submissions)
        while True:
            for name, lesson, answers in itertools.islice(handed, workers * _AHEAD - len(waiting)):
                _refuse_unknown(lesson, key)
                waiting.append(
                    executor.submit(
                        grade_one,
                        (name, lesson, dict(answers)),
                        str(key.path),
                        key.digest,
                        kernel=kernel,
                        unsafe=unsafe,
                        limits=limits,
                    )
                )
            if not waiting:
                return
            yield waiting.popleft().result()


def _refuse_unknown(lesson, key):
    if lesson not in key.lessons:
        raise ValueError(f"lesson {lesson!r} is not in the key, which has {', '.join(key.lessons)}")


def grade_one(submission, key, digest=None, *, kernel="fast", unsafe=False, limits=None):
    """Judge one submission; a plain function that any Executor can run, in this process or another.

    Parameters
    ----------
    submission : (name, lesson, answers), as `autograde` takes them
    key : path of the key's folder, which must be there on the machine that runs this; or a Key
    digest : str, of the key that is meant (`Key.digest`); another one there is refused. None: any
    kernel, unsafe, limits : as `autograde`

    Returns
    -------
    dict, see the module

    Raises
    ------
    SandboxError : no sandbox where this runs
    KeyFolderError, ValueError : no such key, or another one
    """
    path = key.path if isinstance(key, Key) else Path(key)
    name, lesson, answers = submission
    job = {"submission": name, "lesson": lesson, "answers": answers}
    for _ in range(2):
        try:
            return _judge_at_side(path, digest, kernel, unsafe, limits).judge(job)
        except _JudgeGone:
            continue  # once more, with a judge of its own: what one submission did must not cost another
    return _not_judged(load_key(path), job)


def _not_judged(key, job):
    lesson = key.lessons[job["lesson"]]
    words = "the judge ended twice on this submission: look at it by hand"
    graded = [each for each in lesson.exercises if not each.practice]
    return submission_result(job, lesson, [refused_result(each, "not judged", words) for each in graded])


def open_scheduler(address, *, patience=20):
    """An Executor over the workers of a Dask cluster, for `judge(..., executor=...)`.

    Every worker needs this package, bubblewrap, and the key's folder at the same path (a shared disk). A
    worker that dies is replaced, and what it was judging is judged again.

    Parameters
    ----------
    address : str, "tcp://10.0.0.5:8786"
    patience : float, seconds to wait for its answer

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
def _scheduler(client_of, address, patience):
    try:
        client = client_of(address, timeout=patience)
    except OSError as error:
        raise ValueError(f"no Dask scheduler answers at {address} ({error})") from error
    with client, client.get_executor(pure=False, retries=3) as executor:
        yield executor


# ---------------------------------------------------------------- the pytest at one's side


class _JudgeGone(Exception):
    """Not an error: another judge is started."""


_sides = threading.local()
_all_judges = {}
_lock = threading.Lock()
_pools = itertools.count(1)


def _judge_at_side(path, digest, kernel, unsafe, limits):
    """This thread's judge, for that key; one for another key is stopped."""
    wanted = (str(path), digest, kernel, unsafe, limits)
    side = getattr(_sides, "judge", None)
    if side is None or side.wanted != wanted or not side.alive:
        if side is not None:
            side.stop()
        side = _sides.judge = _Judge(wanted)
    return side


def stop_judges(threads=""):
    """Stop the judges of this process, or of its threads whose names begin so; work starts others."""
    with _lock:
        judges = [each for each in _all_judges.values() if each.thread.startswith(threads)]
    for each in judges:
        each.hang_up()
    for each in judges:
        each.stop()


atexit.register(stop_judges)


class _Judge:
    """A pytest that runs `judge_plugin`, and the socket to it."""

    def __init__(self, wanted):
        path, digest, kernel, unsafe, limits = self.wanted = wanted
        self.thread = threading.current_thread().name
        key = load_key(path)
        if digest is not None and key.digest != digest:
            raise ValueError(f"{path}: another key stands there than the one that grading began with")
        if not unsafe:
            bubblewrap.demand()
        self._key = key
        self._limits = limits or Limits()
        self._folder = tempfile.TemporaryDirectory(prefix="judge-")
        folder = Path(self._folder.name)
        (folder / "judge.ini").write_text("[pytest]\n", encoding="utf-8")
        (folder / "work").mkdir()
        self._errors = (folder / "errors").open("w+b")
        ours, theirs = socket.socketpair()
        self._socket, self._kept = ours, b""
        with theirs:
            self._process = self._start(folder, theirs)
        self.alive = True
        with _lock:
            _all_judges[id(self)] = self
        first = {
            "key": str(path),
            "kernel": kernel,
            "unsafe": unsafe,
            "limits": asdict(limits) if limits else None,
            "folder": str(folder / "work"),
        }
        try:
            self._send(first)
            self._receive(_START_SECONDS)
        except _JudgeGone as gone:
            raise SandboxError(f"the judge did not start: {self._last_words}") from gone

    def _start(self, folder, connection):
        words = [sys.executable, "-I", "-m", "pytest", "-c", str(folder / "judge.ini")]
        words += ["--rootdir", str(folder), "--noconftest", "--color=no", "-q", "-s"]
        for name in ("cacheprovider", "logging", "warnings", "doctest", "junitxml", "faulthandler"):
            words += ["-p", f"no:{name}"]
        for name in (
            "imgproc_course.autograder.blocked_imports",
            "nbval.plugin",
            "imgproc_course.autograder.nbval_plugin",
        ):
            words += ["-p", name]
        words += ["--nbval"]
        environment = {
            name: os.environ[name] for name in ("PATH", "LANG", "TMPDIR", "HOME") if name in os.environ
        }
        environment |= {
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            "OPENBLAS_NUM_THREADS": "1",
            _DESCRIPTOR: str(connection.fileno()),
        }
        return subprocess.Popen(
            [*words, str(folder / "work")],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            pass_fds=[connection.fileno()],
            start_new_session=True,
        )

    def judge(self, job):
        """The result of one submission; raises _JudgeGone."""
        self._send(job)
        return self._receive(self._patience(job))

    def _patience(self, job):
        """Seconds after which the judge itself must be stuck: twice what all its kernels may take."""
        cases = [
            (each.time_limit * case.calls)
            for each in self._key.lessons[job["lesson"]].exercises
            for case in each.cases
        ]
        return 60 + 2 * sum(self._limits.deadline(seconds) + 10 for seconds in cases)

    def _send(self, message):
        try:
            self._socket.settimeout(60)
            self._socket.sendall((json.dumps(message) + "\n").encode("ascii"))
        except OSError as error:
            self.stop()
            raise _JudgeGone from error

    def _receive(self, patience):
        until = time.monotonic() + patience
        poll = select.poll()
        poll.register(self._socket, select.POLLIN)
        while b"\n" not in self._kept:
            more = b""
            if poll.poll(max(0.0, until - time.monotonic()) * 1000):
                with contextlib.suppress(OSError):
                    more = self._socket.recv(1 << 20)
            if not more:
                self.stop(tell=False)
                raise _JudgeGone
            self._kept += more
        line, _, self._kept = self._kept.partition(b"\n")
        return json.loads(line)

    def hang_up(self):
        """Tell the pytest that nothing more comes, and do not wait for its end."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)

    def stop(self, *, tell=True):
        """End the pytest, the kernels' process with it."""
        if not self.alive:
            return
        self.alive = False
        with _lock:
            _all_judges.pop(id(self), None)
        self._socket.close()
        if tell:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(5)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        self._process.wait()
        self._errors.seek(0)
        said = self._errors.read().decode(errors="replace").strip().splitlines()
        self._last_words = " | ".join(said[-3:])[:500]
        self._errors.close()
        with contextlib.suppress(OSError):
            self._folder.cleanup()
