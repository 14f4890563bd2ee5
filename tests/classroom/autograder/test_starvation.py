"""What is out of time is run again alone before it counts; a submission has limits."""

from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace

import pytest
from attacks import LESSON
from nbclassroom.autograder.outcomes import BUDGET_MESSAGE, Outcome
from nbclassroom.autograder.pool import Limits, autograde, stop_nbval_processes

pytestmark = pytest.mark.sandbox


def cases_of(result, exercise_id):
    return next(exercise for exercise in result.exercises if exercise.id == exercise_id).cases


class BusyMachine:
    """An executor on whose machine `slow` is out of time as long as something else runs.

    starve        what becomes of its result then
    others_done   for each submission that is graded again: whether all others had ended
    shares        for each: the wall seconds that a case may take at most, None for the usual ones
    """

    def __init__(self, starve):
        self._executor = ThreadPoolExecutor(1, thread_name_prefix="busy-")
        self._starve, self._others, self.seen, self.others_done, self.shares = starve, [], [], [], []

    def submit(self, grade_one, submission, *arguments, **options):
        name, _, page = submission
        is_again = name in self.seen
        self.seen.append(name)
        if is_again:
            self.others_done.append((sorted(page["answers"]), all(future.done() for future in self._others)))
            self.shares.append(options["limits"] and options["limits"].deadline(1000))
        future = self._executor.submit(grade_one, submission, *arguments, **options)
        if name != "slow" or is_again:
            self._others.append(future)
            return future
        starved = Future()
        future.add_done_callback(lambda done: starved.set_result(self._starve(done.result())))
        return starved

    def close(self):
        self._executor.submit(stop_nbval_processes, "busy-").result()
        self._executor.shutdown()


def out_of_time(result):
    double, *others = result.exercises
    cases = tuple(replace(case, outcome=Outcome.TIME, points=0) for case in double.cases)
    return replace(result, exercises=(replace(double, cases=cases), *others))


def left_out(result):
    """The first exercise slept in one case, and then the submission had no time left."""
    texts = [["it did not finish in time", BUDGET_MESSAGE], [BUDGET_MESSAGE, BUDGET_MESSAGE]]
    exercises = []
    for exercise, messages in zip(result.exercises, texts, strict=True):
        cases = [
            replace(case, outcome=Outcome.TIME, points=0, message=message)
            for case, message in zip(exercise.cases, messages, strict=True)
        ]
        exercises.append(replace(exercise, cases=tuple(cases)))
    return replace(result, exercises=tuple(exercises))


def test_an_exercise_for_which_slow_ones_left_no_time_is_graded_without_them(key, right):
    machine = BusyMachine(left_out)
    (result,) = autograde([("slow", LESSON, right)], key, workers=1, executor=machine)
    machine.close()
    assert result.points == 10
    assert [ids for ids, _ in machine.others_done] == [["attacked-mean"], ["attacked-double"]]
    assert machine.shares == [Limits().submission / 2, None]  # the two cases cannot use each other's time


def test_an_exercise_out_of_time_is_run_again_alone_and_then_counts(key, right):
    names = ["slow", "a", "b", "c"]
    machine = BusyMachine(out_of_time)
    results = list(autograde([(name, LESSON, right) for name in names], key, workers=1, executor=machine))
    machine.close()
    assert [(result.name, result.points) for result in results] == [(name, 10) for name in names]
    assert machine.others_done == [(["attacked-double"], True)]


def test_what_is_still_out_of_time_alone_stays_so_and_then_the_submission_has_no_time_left(key, right):
    asleep = right | {"attacked-mean": "import time\ndef mean(values):\n    time.sleep(1000)"}
    limits = Limits(grace=0.5, wall_factor=1, wall_grace=3, submission=3.5)
    (result,) = autograde([("asleep", LESSON, asleep)], key, workers=1, limits=limits)
    public, hidden = cases_of(result, "attacked-mean")
    assert {public.outcome, hidden.outcome} == {Outcome.TIME}
    assert (public.message, hidden.message) == ("it did not finish in time", BUDGET_MESSAGE)


def test_a_worker_that_dies_twice_is_reported_and_the_others_are_graded(key, right):
    class Mortal(ThreadPoolExecutor):
        def submit(self, function, submission, *arguments, **options):
            if submission[0] == "unlucky":
                raise RuntimeError("the workers are gone")
            return super().submit(function, submission, *arguments, **options)

    with Mortal(1, thread_name_prefix="mortal-") as executor:
        submissions = [(name, LESSON, right) for name in ("a", "unlucky", "b")]
        results = {result.name: result for result in autograde(submissions, key, executor=executor)}
        stop_nbval_processes("mortal-")
    assert (results["a"].points, results["b"].points) == (10, 10)
    assert results["unlucky"].exercises_with(Outcome.NOT_GRADED) == {"attacked-double", "attacked-mean"}
    message = results["unlucky"].exercises[0].message
    assert message == "the autograder failed: RuntimeError: the workers are gone"
