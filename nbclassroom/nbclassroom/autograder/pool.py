"""Grade submissions, many at a time, in order: threads, and the nbval process that each of them keeps.

A fault of the autograder (an exception, a process that was killed, a run without a result) costs nobody
points: the submission is graded again in new processes, and if that fails too, the outcome is "not graded".
A killed process is no sign of a fault that will come again, so it has more attempts.
An exercise that did not finish in time is graded again while nothing else runs, and that result counts. Those
that slow ones left no time for come first: only what is slow itself can lose by it.

An nbval process is a pytest with nbval and `nbval_plugin`. It is started so that nothing on this machine and
nothing in a submission can configure it. It never runs learners' code: kernels do (`sandbox`). When the
thread that started it ends, also because its process was killed, the system ends the nbval process, then the
sandbox with its kernels.
"""

import atexit
import contextlib
import itertools
import json
import os
import shutil
import socket
import subprocess
import sys
import threading
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import asdict, replace

from .. import course
from ..exercises.page import page_of
from .answer_key import Key, KeyFolderError, expected_key
from .outcomes import BUDGET_MESSAGE, Outcome
from .results import GradedSubmission, from_json, ungraded_exercise
from .sandbox import bubblewrap
from .sandbox.bubblewrap import Limits, SandboxError, make_temporary_folder, remove_abandoned_folders
from .sanitize import reproducible_text

_QUEUE_PER_WORKER = 4  # submissions that are submitted before their results are taken
_ATTEMPTS = 3  # to grade a submission, each in a new nbval process
_KILLS = 10  # of nbval processes while they start or grade one submission; they are not attempts
_START_SECONDS = 120
_BLOCKED_PLUGINS = (
    *("cacheprovider", "logging", "warnings", "doctest", "junitxml", "faulthandler", "debugging", "pastebin"),
    *("setuponly", "setupplan", "stepwise", "unraisableexception", "threadexception", "subtests", "skipping"),
)
_PROGRAM = """
import json, sys
from nbclassroom.autograder.sandbox.bubblewrap import Limits, confine
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
confine.die_with_parent()  # if it has ended already, there is nothing to read from the socket
settings = json.loads(sys.argv.pop(1))
kernel_factory = KernelFactory(unsafe=settings["unsafe"], limits=Limits(**settings["limits"]))
from nbclassroom.autograder import nbval_plugin  # while the fork server loads
nbval_plugin.main(settings["socket"], settings["folder"], kernel_factory)
"""

_processes: dict[str, "NbvalProcess"] = {}  # by the names of the threads
_stopped: set[str] = set()  # prefixes of the threads that start no more
_numbers = itertools.count(1)  # of the pools of threads


def autograde(submissions, key, *, unsafe=False, workers=None, executor=None, limits=None):
    """Grade submissions, lazily and in order; yields a GradedSubmission for each.

    `submissions` are (name, lesson, a page as `exercises.page` describes it or only {exercise id: source});
    they are read as results are taken, so that a generator of thousands needs no memory. `key` is for all, or
    {name: Key}; `unsafe` runs without a sandbox; `workers` are graded at once (None: one per core), by
    threads of this process, or by an Executor that runs `grade_one` elsewhere; `limits` are one kernel's.

    Before anything is run: SandboxError, there is no sandbox here; ValueError, a lesson is not in the key.
    """
    if executor is None and not unsafe:
        bubblewrap.require_sandbox()
    workers = workers or os.cpu_count() or 1
    with contextlib.ExitStack() as stack:
        executor = executor or stack.enter_context(open_worker_threads(workers))
        options = {"unsafe": unsafe, "limits": limits}
        queue = stack.enter_context(contextlib.closing(_Queue(executor, options)))
        submissions = iter(submissions)
        while True:
            room = workers * _QUEUE_PER_WORKER - len(queue.waiting)
            for name, lesson, answers in itertools.islice(submissions, room):
                key_of_submission = key if isinstance(key, Key) else key[name]
                if lesson not in key_of_submission.lessons:
                    names = ", ".join(key_of_submission.lessons)
                    raise ValueError(f"lesson {lesson!r} is not in the key, which has {names}")
                page = answers if "cells" in answers else page_of(answers, key_of_submission.lessons[lesson])
                submission = name, lesson, page
                future = queue.submit(submission, key_of_submission)
                queue.waiting.append((submission, key_of_submission, future))
            if not queue.waiting:
                return
            try:
                result = queue.next_result()
            except KeyboardInterrupt:
                print("\nStopping after what runs now; Ctrl-C again stops at once.", file=sys.stderr)
                raise
            yield result


class _Queue:
    """The submissions that an executor grades, in order; `waiting` holds (submission, Key, Future)."""

    def __init__(self, executor, options):
        self._executor, self._options = executor, options
        self.waiting: deque = deque()

    def submit(self, submission, key, **options):
        options = self._options | options
        try:
            return self._executor.submit(grade_one, submission, str(key.path), key.digest, **options)
        except RuntimeError as error:  # the executor has lost its workers
            future: Future = Future()
            future.set_exception(error)
            return future

    def next_result(self):
        """The GradedSubmission of the first one; an exercise out of time is graded again, alone."""
        submission, key, future = self.waiting.popleft()
        result = self._result(submission, key, future)
        if not result.exercises_with(Outcome.TIME):
            return result
        wait([future for *_, future in self.waiting])
        # Those are out of time only because others had used all of it. Now no case of theirs can use the time
        # of another one; an answer that needs more than its share is among the late ones afterwards.
        left_out = [
            exercise
            for exercise in result.exercises
            if {case.message for case in exercise.cases if case.outcome == Outcome.TIME} == {BUDGET_MESSAGE}
        ]
        if left_out:
            limits = self._options["limits"] or Limits()
            share = limits.submission / sum(len(exercise.cases) for exercise in left_out)
            limits = replace(limits, wall_factor=0, wall_grace=share)
            ids = {exercise.id for exercise in left_out}
            result = self._graded_again(submission, key, result, ids, limits=limits)
        late = result.exercises_with(Outcome.TIME)
        return self._graded_again(submission, key, result, late) if late else result

    def _graded_again(self, submission, key, result, ids, **options):
        """The result, with new results of some exercises; they have a submission's whole time."""
        name, lesson, page = submission
        again = (name, lesson, page | {"answers": {id: page["answers"][id] for id in ids}})
        new_result = self._result(again, key, self.submit(again, key, **options))
        new = {exercise.id: exercise for exercise in new_result.exercises}
        exercises = (new[exercise.id] if exercise.id in ids else exercise for exercise in result.exercises)
        return replace(result, exercises=tuple(exercises))

    def _result(self, submission, key, future):
        for _ in range(2):
            try:
                return future.result()
            except (SandboxError, KeyFolderError):  # a remedy is known, and nothing can be graded before
                raise
            except Exception as error:  # noqa: BLE001 - an executor and its workers may raise anything
                fault = f"{type(error).__name__}: {error}"
                future = self.submit(submission, key)
        return _not_graded(key, submission, fault)

    def close(self):
        """Forget what has not begun, and wait for what has."""
        for *_, future in self.waiting:
            future.cancel()
        wait([future for *_, future in self.waiting])


def grade_one(submission, key_folder, digest, *, unsafe=False, limits=None):
    """The GradedSubmission of one submission; a plain function that any Executor can run, here or elsewhere.

    The key's folder must exist on the machine that runs this, with the key of this digest: else
    KeyFolderError or ValueError. The rest is as in `autograde`.
    """
    key = expected_key(key_folder, digest)
    attempts = kills = 0
    while attempts < _ATTEMPTS and kills < _KILLS:
        try:
            process = nbval_process_of_thread(unsafe, limits)
            result = from_json(process.grade(key, *submission))
            if not result.has_fault:
                return result
            process.stop()
        except NbvalProcessNotStarted:
            if attempts + 1 == _ATTEMPTS:
                raise
        except NbvalProcessKilled as error:
            kills += 1
            result = _not_graded(key, submission, f"the nbval process was killed {kills} times: {error}")
            continue
        except NbvalProcessEnded as error:  # perhaps by an earlier submission
            result = _not_graded(key, submission, f"the nbval process ended: {error}")
        attempts += 1
    return result


def _not_graded(key, submission, fault):
    name, lesson, _ = submission
    message = reproducible_text(f"the autograder failed: {fault}")
    exercises = tuple(
        ungraded_exercise(exercise, Outcome.NOT_GRADED, message)
        for exercise in key.lessons[lesson].exercises
        if not exercise.practice
    )
    return GradedSubmission(name, lesson, exercises)


@contextlib.contextmanager
def open_scheduler(address, *, patience=20):
    """An Executor over the workers of a Dask cluster, for `autograde(..., executor=...)`.

    Every worker needs this package, bubblewrap, and the key's folder at the same path (a shared disk). A
    worker that dies is replaced, and the submission that it was grading is graded again. ValueError: Dask is
    not installed, or nothing answers at the address ("tcp://10.0.0.5:8786") within `patience` seconds.
    """
    try:
        from distributed import Client
    except ImportError as error:
        remedy = 'pip install "distributed" here and on its workers'
        raise ValueError(f"a scheduler needs Dask: {remedy}") from error
    try:
        client = Client(address, timeout=patience)
    except OSError as error:
        raise ValueError(f"no Dask scheduler answers at {address} ({error})") from error
    with client, client.get_executor(pure=False, retries=3) as executor:
        yield executor


class NbvalProcessEnded(Exception):
    """The process ended or does not answer; the message says what is known of it. Start another one."""


class NbvalProcessKilled(Exception):
    """A signal ended it: the system had no memory left, or somebody killed it. No submission did that."""


class NbvalProcessNotStarted(SandboxError):
    """The process ended by itself while it started; the message says why."""


def nbval_process_of_thread(unsafe, limits):
    """This thread's NbvalProcess with these options of `autograde`; one with others is stopped."""
    thread = threading.current_thread().name
    if thread.startswith(tuple(_stopped)):
        raise NbvalProcessNotStarted("the run was stopped")
    process = _processes.get(thread)
    if process is not None and process.options != (unsafe, limits):
        process.stop()
    return _processes.get(thread) or NbvalProcess(unsafe, limits)


def stop_nbval_processes(thread_prefix=""):
    """Stop the nbval processes of threads with this prefix."""
    processes = [process for name, process in list(_processes.items()) if name.startswith(thread_prefix)]
    for process in processes:
        process.close_connection()
    for process in processes:
        process.stop()


atexit.register(stop_nbval_processes)


class NbvalProcess:
    """A thread's nbval process, and the socket to it; NbvalProcessKilled, SandboxError: it does not start."""

    def __init__(self, unsafe, limits):
        self.options = (unsafe, limits)
        self._limits = limits or Limits()
        self._folder = make_temporary_folder()
        self._errors = (self._folder / "errors").open("w+b")
        self._socket, process_end = socket.socketpair()
        self._lines = self._socket.makefile("r", 1 << 20, encoding="ascii")
        with process_end:
            self._process = self._start(process_end)
        self._is_ready, self._last_errors = False, ""
        self._thread = threading.current_thread().name
        _processes[self._thread] = self
        try:
            if not unsafe:
                bubblewrap.require_sandbox()  # while the process starts
            self._answer("", _START_SECONDS)
            self._is_ready = True
        except NbvalProcessEnded as error:
            raise NbvalProcessNotStarted(f"the nbval process did not start: {error}") from error
        except SandboxError:
            self.stop()
            raise

    def _start(self, connection):
        folder = self._folder
        (folder / "work").mkdir()
        settings = {
            "unsafe": self.options[0],
            "limits": asdict(self._limits),
            "folder": str(folder / "work"),
            "socket": connection.fileno(),
        }
        command = [sys.executable, "-I", "-c", _PROGRAM, json.dumps(settings)]
        command += ["-c", os.devnull, "--rootdir", str(folder), "--noconftest"]
        command += ["--color=no", "-q", "-s"]
        # The blocked imports first, so that nbval does not import what they block.
        for plugin in (*_BLOCKED_PLUGINS, "nbclassroom.autograder.blocked_imports", "nbval.plugin"):
            command += ["-p", f"no:{plugin}" if plugin in _BLOCKED_PLUGINS else plugin]
        environment = {name: os.environ[name] for name in ("PATH", "LANG", "HOME") if name in os.environ}
        environment |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "OPENBLAS_NUM_THREADS": "1"}
        environment |= {course.VARIABLE: str(course.file()), "TMPDIR": str(folder)}
        return subprocess.Popen(
            [*command, "--nbval", str(folder / "work")],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            pass_fds=[connection.fileno()],
            start_new_session=True,
        )

    def grade(self, key, name, lesson, page):
        """Grade one submission; what `results.to_json` wrote. NbvalProcessEnded, NbvalProcessKilled."""
        job = {"key": str(key.path), "digest": key.digest, "submission": name, "lesson": lesson, "page": page}
        return self._answer(json.dumps(job) + "\n", self._patience(key.lessons[lesson]))

    def _patience(self, lesson):
        """Seconds after which the process itself must be stuck: twice what kernels and robots may take."""
        deadlines = [
            self._limits.deadline(exercise.kind.seconds_of(exercise, case))
            for exercise in lesson.exercises
            for case in exercise.cases
        ]
        # The last case begins within the submission's time, and it may be run again.
        kernels = self._limits.submission + 2 * max(deadlines, default=0)
        # A robot needs less time than the one in the scenario would.
        robots = sum(exercise.kind.simulated_seconds(exercise) for exercise in lesson.exercises)
        return 60 + 2 * (kernels + robots)

    def _answer(self, request, patience):
        self._socket.settimeout(patience)
        try:
            self._socket.sendall(request.encode("ascii"))
            line = self._lines.readline()
        except TimeoutError as error:
            raise self._stopped(f"no answer within {patience:.0f} s") from error
        except OSError as error:
            raise self._stopped(str(error)) from error
        if not line.endswith("\n"):
            raise self._stopped("it closed the connection")
        return json.loads(line)

    def _stopped(self, fault):
        """Clean up after a process that ended, or is stuck; returns the exception to raise."""
        code = self.stop(patience=5)
        if code < 0:
            return NbvalProcessKilled(f"signal {-code} ended it")
        return NbvalProcessEnded(self._last_errors or fault)

    def close_connection(self):
        """Tell the process that no more submissions come, without waiting for its end."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)

    def stop(self, patience=None):
        """End it and its fork server; its exit code if it ended by itself within `patience` seconds."""
        code = 0
        if _processes.get(self._thread) is not self:  # it was stopped before
            return code
        del _processes[self._thread]
        self.close_connection()
        self._lines.close()
        self._socket.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = self._process.wait((5 if self._is_ready else 0) if patience is None else patience)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        self._process.wait()
        self._errors.seek(0)
        errors = self._errors.read().decode(errors="replace").strip().splitlines()
        self._last_errors = " | ".join(errors[-3:])[:500]
        self._errors.close()
        shutil.rmtree(self._folder, ignore_errors=True)
        return code


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
        _stopped.add(prefix)
        stop_nbval_processes(prefix)
        executor.shutdown()
        # The next run after a killed one perhaps finds everything graded, and needs no folder of its own.
        remove_abandoned_folders()
