"""Grade submissions, many at a time, in order.

A fault of the autograder (an exception, a process that was killed, a run without a result) costs nobody
points: the submission is graded again in new processes, and if that fails too, the outcome is "not graded".
A killed process is no sign of a fault that will come again, so it has more attempts.
An exercise that did not finish in time is graded again while nothing else runs, and that result counts. Those
that slow ones left no time for come first: only what is slow itself can lose by it.
"""

import contextlib
import itertools
import os
import sys
from collections import deque
from concurrent.futures import Future, wait
from dataclasses import replace

from ..exercises.page import page_of
from . import nbval_process
from .answer_key import Key, KeyFolderError, expected_key
from .nbval_process import open_worker_threads
from .outcomes import BUDGET_MESSAGE, Outcome
from .results import GradedSubmission, from_json, ungraded_exercise
from .sandbox import bubblewrap
from .sandbox.bubblewrap import Limits, SandboxError
from .sanitize import reproducible_text

_QUEUE_PER_WORKER = 4  # submissions that are submitted before their results are taken
_ATTEMPTS = 3  # to grade a submission, each in a new nbval process
_KILLS = 10  # of nbval processes while they start or grade one submission; they are not attempts


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
    options = {"unsafe": unsafe, "limits": limits}
    return _grade_all(submissions, key, options, workers or os.cpu_count() or 1, executor)


def _grade_all(submissions, key, options, workers, executor):
    with contextlib.ExitStack() as stack:
        executor = executor or stack.enter_context(open_worker_threads(workers))
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
                queue.add((name, lesson, page), key_of_submission)
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

    def add(self, submission, key):
        self.waiting.append((submission, key, self._submit(submission, key)))

    def _submit(self, submission, key, **options):
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
        new_result = self._result(again, key, self._submit(again, key, **options))
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
                future = self._submit(submission, key)
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
            process = nbval_process.nbval_process_of_thread(unsafe, limits)
            result = from_json(process.grade(key, *submission))
            if not result.has_fault:
                return result
            process.stop()
        except nbval_process.NbvalProcessNotStarted:
            if attempts + 1 == _ATTEMPTS:
                raise
        except nbval_process.NbvalProcessKilled as error:
            kills += 1
            result = _not_graded(key, submission, f"the nbval process was killed {kills} times: {error}")
            continue
        except nbval_process.NbvalProcessEnded as error:  # perhaps by an earlier submission
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
        raise ValueError(
            'a scheduler needs Dask: pip install "distributed" here and on its workers'
        ) from error
    try:
        client = Client(address, timeout=patience)
    except OSError as error:
        raise ValueError(f"no Dask scheduler answers at {address} ({error})") from error
    with client, client.get_executor(pure=False, retries=3) as executor:
        yield executor
