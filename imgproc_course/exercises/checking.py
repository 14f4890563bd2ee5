"""`check`: an answer's public cases, run at once in the learner's notebook."""

from dataclasses import dataclass, field
from functools import lru_cache
from inspect import signature

from imgproc_course.exercises import feedback
from imgproc_course.exercises.comparison import Difference, compare
from imgproc_course.exercises.declaration import (
    PUBLIC_SEED,
    Case,
    Exercise,
    MasterError,
    Mistake,
    find_exercise,
)
from imgproc_course.exercises.reach import Reach, reach_of
from imgproc_course.exercises.running import CallResult, call, code_of


@dataclass(frozen=True)
class Call:
    """One call of one case: what it was given, what was expected, what it did."""

    case: Case
    arguments: tuple
    expected: CallResult
    outcome: CallResult
    difference: Difference | None

    @property
    def passed(self):
        return self.outcome.finished and not self.outcome.changed and self.difference is None


@dataclass(frozen=True)
class CaseResult:
    """One case: passed, and the first of its calls that failed.

    failed is None where none did, and where the case was not run: after a call that did not come to an end.
    """

    case: Case
    passed: bool
    failed: Call | None


@dataclass(frozen=True)
class CheckResult:
    """What `check` found. Shows itself in a notebook; `print(result)` gives the same as plain text.

    exercise   the declaration
    attempted  False for the stub as it was handed out
    results    tuple of CaseResult, one a public case
    mistake    the known mistake that explains the answer, or None
    reach      what the answer uses that grading refuses or will not know
    names      the argument names of the function
    """

    exercise: Exercise
    attempted: bool
    results: tuple = ()
    mistake: Mistake | None = None
    reach: Reach = field(default_factory=Reach)
    names: tuple = ()

    @property
    def passed(self):
        """True when grading would give every point of the public cases."""
        clean = not self.reach.refused and not self.reach.foreign
        return self.attempted and clean and all(result.passed for result in self.results)

    @property
    def points(self):
        """Points of the public cases that pass."""
        return sum(result.case.points for result in self.results if result.passed)

    def __repr__(self):
        return feedback.as_text(self)

    def _repr_html_(self):
        return feedback.as_html(self)


def check(exercise_id, function):
    """Check an answer, and say what is right, what is not, and where to look.

    Parameters
    ----------
    exercise_id : str, as the lesson names it: "grayscale-luma"
    function : the learner's function itself, `luma`, not a call of it

    Returns
    -------
    CheckResult, which a notebook shows; `.passed` and `.results` for programs

    Raises
    ------
    MasterError : there is no such exercise
    TypeError : what was given is no function
    """
    declared = find_exercise(exercise_id)
    if not callable(function):
        raise TypeError(
            f"check({exercise_id!r}, ...) needs your function {declared.function} itself, got a value of type"
            f" {type(function).__name__}; run the cell with your function first (if it shows an error, repair"
            f" that), and write check({exercise_id!r}, {declared.function}), no parentheses after the name"
        )
    return run_cases(declared, function)


def run_cases(declared, function, *, cases=None, seed=PUBLIC_SEED):
    """Run an answer through cases of an exercise.

    Parameters
    ----------
    declared : Exercise
    function : callable
    cases : sequence of Case; the public ones where left out
    seed : int, what the inputs are drawn from

    Returns
    -------
    CheckResult
    """
    cases = declared.public if cases is None else tuple(cases)
    names = _argument_names(declared)
    if _is_stub(declared, function):
        return CheckResult(declared, attempted=False, names=names)
    calls = []
    for case, arguments, expected in _planned(declared, cases, seed):
        outcome = call(function, arguments, _names_for(names, arguments), declared.time_limit)
        if outcome.error == "NotImplementedError":
            return CheckResult(declared, attempted=False, names=names)
        difference = compare(expected.value, outcome.value, case.tolerance) if outcome.finished else None
        calls.append(Call(case, arguments, expected, outcome, difference))
        if outcome.timed_out:
            break  # a learner waits for one time limit, not for one a call
    results = tuple(_result(case, [made for made in calls if made.case is case]) for case in cases)
    reach = reach_of(function, declared.refused, set(declared.namespace()))
    mistake = None if all(result.passed for result in results) else _known_mistake(declared, calls, seed)
    return CheckResult(declared, True, results, mistake, reach, names)


def _planned(declared, cases, seed):
    for case in cases:
        yield from ((case, arguments, expected) for arguments, expected in _answers(declared, case, seed))


def _argument_names(declared):
    return tuple(signature(declared.function_of(declared.solution, "solution")).parameters)


def _names_for(names, arguments):
    return [*names[: len(arguments)], *(f"argument {k + 1}" for k in range(len(names), len(arguments)))]


def _is_stub(declared, function):
    code, stub = code_of(function), code_of(declared.function_of(declared.stub, "stub"))
    return code is not None and (code.co_code, code.co_consts, code.co_names) == (
        stub.co_code,
        stub.co_consts,
        stub.co_names,
    )


def _result(case, calls):
    failed = next((made for made in calls if not made.passed), None)
    return CaseResult(case, bool(calls) and failed is None, failed)


# Kept between checks: the right answers of a slow exercise are worked out once. A changed master is another
# Exercise.
@lru_cache(maxsize=256)
def _answers(declared, case, seed):
    solution = declared.function_of(declared.solution, "solution")
    names = _argument_names(declared)
    answers = []
    for arguments in declared.arguments(case, seed):
        outcome = call(solution, arguments, _names_for(names, arguments), declared.time_limit)
        if not outcome.finished or outcome.changed:
            story = feedback.story_of(outcome, None, declared.function)
            raise MasterError(f"{declared.master.name}, {case.id}: the solution fails. {story}")
        answers.append((arguments, outcome))
    return tuple(answers)


@lru_cache(maxsize=256)
def _outcomes_of_mistake(declared, mistake, case, seed):
    wrong = declared.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)
    names = _argument_names(declared)
    return tuple(
        call(wrong, arguments, _names_for(names, arguments), declared.time_limit)
        for arguments, _ in _answers(declared, case, seed)
    )


def _known_mistake(declared, calls, seed):
    """The declared mistake that explains an answer, or None.

    It does on every call exactly what the answer did; or else it is the only one that gives the same wrong
    values in the first case that fails.
    """
    alike = [mistake for mistake in declared.mistakes if _explains(declared, mistake, calls, seed)]
    if alike:
        return alike[0]
    first = next(made.case for made in calls if not made.passed)
    there = [made for made in calls if made.case is first]
    if not all(made.outcome.finished for made in there):
        return None  # two different errors may bear one name
    alike = [mistake for mistake in declared.mistakes if _explains(declared, mistake, there, seed)]
    return alike[0] if len(alike) == 1 else None


def _explains(declared, mistake, calls, seed):
    cases = list(dict.fromkeys(made.case for made in calls))
    predicted = [made for case in cases for made in _outcomes_of_mistake(declared, mistake, case, seed)]
    return len(predicted) == len(calls) and all(
        made.outcome.like(outcome, made.case.tolerance)
        for made, outcome in zip(calls, predicted, strict=True)
    )
