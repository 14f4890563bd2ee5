"""`check`: run an answer's public cases in the learner's notebook."""

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
from imgproc_course.exercises.dependencies import Dependencies, find_dependencies
from imgproc_course.exercises.running import CallResult, call, code_of


@dataclass(frozen=True)
class CaseCall:
    """One call of a case: its arguments, the expected result, the answer's result, and their difference."""

    case: Case
    arguments: tuple
    expected: CallResult
    result: CallResult
    difference: Difference | None

    @property
    def passed(self):
        return self.result.finished and not self.result.changed and self.difference is None


@dataclass(frozen=True)
class CaseResult:
    """One case: whether it passed, and the first of its calls that failed.

    failed_call is None if no call failed, and for a case that was not run because an earlier call did not
    finish.
    """

    case: Case
    passed: bool
    failed_call: CaseCall | None


@dataclass(frozen=True)
class CheckResult:
    """The result of `check`. A notebook shows it as HTML; `print(result)` gives the same as plain text.

    exercise      the Exercise
    attempted     False for the unchanged stub
    results       tuple of CaseResult, one for each public case
    mistake       the known mistake that explains the answer, or None
    dependencies  refused modules and names of other cells that the answer uses
    names         the argument names of the function
    """

    exercise: Exercise
    attempted: bool
    results: tuple = ()
    mistake: Mistake | None = None
    dependencies: Dependencies = field(default_factory=Dependencies)
    names: tuple = ()

    @property
    def passed(self):
        """True if grading would give every point of the public cases."""
        is_accepted = not self.dependencies.refused and not self.dependencies.foreign
        return self.attempted and is_accepted and all(result.passed for result in self.results)

    @property
    def points(self):
        """Points of the public cases that pass."""
        return sum(result.case.points for result in self.results if result.passed)

    def __repr__(self):
        return feedback.as_text(self)

    def _repr_html_(self):
        return feedback.as_html(self)


def check(exercise_id, function):
    """Check an answer: show what is right, what is wrong, and where to look.

    Parameters
    ----------
    exercise_id : str, as the lesson names it: "grayscale-luma"
    function : the learner's function itself, `luma`, not a call of it

    Returns
    -------
    CheckResult, which a notebook shows; programs use `.passed` and `.results`

    Raises
    ------
    MasterError : there is no such exercise
    TypeError : `function` cannot be called
    """
    exercise = find_exercise(exercise_id)
    if not callable(function):
        raise TypeError(
            f"check({exercise_id!r}, ...) needs your function {exercise.function} itself, got a value of type"
            f" {type(function).__name__}; run the cell with your function first (if it shows an error, repair"
            f" that), and write check({exercise_id!r}, {exercise.function}), no parentheses after the name"
        )
    return run_cases(exercise, function)


def run_cases(exercise, function, *, cases=None, seed=PUBLIC_SEED):
    """Run an answer on cases of an exercise.

    Parameters
    ----------
    exercise : Exercise
    function : callable
    cases : sequence of Case; the public ones if omitted
    seed : int, the seed of the inputs

    Returns
    -------
    CheckResult
    """
    cases = exercise.public if cases is None else tuple(cases)
    names = _argument_names(exercise)
    if _is_stub(exercise, function):
        return CheckResult(exercise, attempted=False, names=names)
    calls = []
    for case, arguments, expected in _expected_calls(exercise, cases, seed):
        result = call(function, arguments, _names_for(names, arguments), exercise.time_limit)
        if result.error == "NotImplementedError":
            return CheckResult(exercise, attempted=False, names=names)
        difference = compare(expected.value, result.value, case.tolerance) if result.finished else None
        calls.append(CaseCall(case, arguments, expected, result, difference))
        if result.timed_out:
            break  # a learner waits for one time limit, not for one per call
    results = tuple(_case_result(case, calls) for case in cases)
    dependencies = find_dependencies(function, exercise.refused, set(exercise.namespace()))
    mistake = None if all(result.passed for result in results) else _known_mistake(exercise, calls, seed)
    return CheckResult(exercise, True, results, mistake, dependencies, names)


def _expected_calls(exercise, cases, seed):
    for case in cases:
        for arguments, expected in _solve(exercise, case, seed):
            yield case, arguments, expected


def _argument_names(exercise):
    return tuple(signature(exercise.function_of(exercise.solution, "solution")).parameters)


def _names_for(names, arguments):
    return [*names[: len(arguments)], *(f"argument {k + 1}" for k in range(len(names), len(arguments)))]


def _is_stub(exercise, function):
    code, stub = code_of(function), code_of(exercise.function_of(exercise.stub, "stub"))
    return code is not None and (code.co_code, code.co_consts, code.co_names) == (
        stub.co_code,
        stub.co_consts,
        stub.co_names,
    )


def _case_result(case, calls):
    own_calls = [case_call for case_call in calls if case_call.case is case]
    failed_call = next((case_call for case_call in own_calls if not case_call.passed), None)
    return CaseResult(case, bool(own_calls) and failed_call is None, failed_call)


# Cached from one check to the next: a slow solution runs once. A changed master gives another Exercise.
@lru_cache(maxsize=256)
def _solve(exercise, case, seed):
    solution = exercise.function_of(exercise.solution, "solution")
    names = _argument_names(exercise)
    solved = []
    for arguments in exercise.arguments(case, seed):
        result = call(solution, arguments, _names_for(names, arguments), exercise.time_limit)
        if not result.finished or result.changed:
            explanation = feedback.explain_call(result, None, exercise.function)
            raise MasterError(f"{exercise.master.name}, {case.id}: the solution fails. {explanation}")
        solved.append((arguments, result))
    return tuple(solved)


@lru_cache(maxsize=256)
def _results_of_mistake(exercise, mistake, case, seed):
    wrong_function = exercise.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)
    names = _argument_names(exercise)
    return tuple(
        call(wrong_function, arguments, _names_for(names, arguments), exercise.time_limit)
        for arguments, _ in _solve(exercise, case, seed)
    )


def _known_mistake(exercise, calls, seed):
    """The declared mistake that explains an answer, or None.

    A mistake explains an answer if both do the same in every call. Otherwise it must be the only mistake that
    gives the same wrong values in the first case that fails.
    """
    matches = [mistake for mistake in exercise.mistakes if _explains(exercise, mistake, calls, seed)]
    if matches:
        return matches[0]
    first = next(case_call.case for case_call in calls if not case_call.passed)
    first_calls = [case_call for case_call in calls if case_call.case is first]
    if not all(case_call.result.finished for case_call in first_calls):
        return None  # two different errors may have the same name
    matches = [mistake for mistake in exercise.mistakes if _explains(exercise, mistake, first_calls, seed)]
    return matches[0] if len(matches) == 1 else None


def _explains(exercise, mistake, calls, seed):
    cases = list(dict.fromkeys(case_call.case for case_call in calls))
    predicted = [result for case in cases for result in _results_of_mistake(exercise, mistake, case, seed)]
    return len(predicted) == len(calls) and all(
        case_call.result.matches(result, case_call.case.tolerance)
        for case_call, result in zip(calls, predicted, strict=True)
    )
