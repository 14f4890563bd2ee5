"""`check`: run an answer's public cases in the learner's notebook."""

import types
from dataclasses import dataclass, field, replace

from imgproc_course.classroom.exercises import feedback
from imgproc_course.classroom.exercises.cell_runs import RUNS
from imgproc_course.classroom.exercises.check_data import CheckCase, CheckData, CheckMistake, check_data_of
from imgproc_course.classroom.exercises.check_files import find_check_data
from imgproc_course.classroom.exercises.comparison import Difference, compare
from imgproc_course.classroom.exercises.declaration import PUBLIC_SEED
from imgproc_course.classroom.exercises.dependencies import Dependencies, find_dependencies, split_taken
from imgproc_course.classroom.exercises.diagnosis import Diagnosis, diagnose
from imgproc_course.classroom.exercises.guarded_imports import function_as_graded
from imgproc_course.classroom.exercises.progress import ExerciseProgress, digest_of, note_progress
from imgproc_course.classroom.exercises.running import CallResult, code_of, overwrite_freed_memory
from imgproc_course.classroom.exercises.source_remarks import remarks_on_source

_NONE = {"type": "None"}


@dataclass(frozen=True)
class CaseCall:
    """One call of a case: its arguments, the expected result, the answer's result, and their difference."""

    case: CheckCase
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

    case: CheckCase
    passed: bool
    failed_call: CaseCall | None


@dataclass(frozen=True)
class CheckResult:
    """The result of `check`. A notebook shows it as HTML; `print(result)` gives the same as plain text.

    exercise      CheckData
    attempted     False for the unchanged stub
    results       tuple of CaseResult, one for each public case
    mistake       the known mistake that explains the answer, or None
    dependencies  refused modules and names of other cells that the answer uses
    diagnosis     what is certain about the values of the shown call
    remarks       what is certain from the source of the function, sentences
    why_older     why the function is older than the learner's cell, and was not run; "" if it is not older
    """

    exercise: CheckData
    attempted: bool
    results: tuple = ()
    mistake: CheckMistake | None = None
    dependencies: Dependencies = field(default_factory=Dependencies)
    diagnosis: Diagnosis = field(default_factory=Diagnosis)
    remarks: tuple = ()
    why_older: str = ""

    @property
    def passed(self):
        """True if grading would give every point of the public cases."""
        is_accepted = not self.dependencies.refused and not self.dependencies.foreign and not self.why_older
        return self.attempted and is_accepted and all(result.passed for result in self.results)

    @property
    def shown(self):
        """The failed call whose values are shown: one that the known mistake explains, else the first."""
        failed = [result.failed_call for result in self.results if result.failed_call]
        explained = [case_call for case_call in failed if self.mistake and case_call.result.finished]
        return next(iter([*explained, *failed]), None)

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
    CheckFileError : there is no such exercise, or its file is missing or damaged
    TypeError : `function` cannot be called
    """
    exercise = find_check_data(exercise_id)
    if not callable(function):
        raise TypeError(
            f"check({exercise_id!r}, ...) needs your function {exercise.function} itself, got a value of type"
            f" {type(function).__name__}; run the cell with your function first (if it shows an error, repair"
            f" that), and write check({exercise_id!r}, {exercise.function}), no parentheses after the name"
        )
    why_older = RUNS.why_older(exercise_id, exercise.function, function)
    if why_older:
        return CheckResult(exercise, attempted=True, why_older=why_older)
    result = run_check(exercise, function)
    _note(result, function)
    return result


def _note(result, function):
    """Note a right answer or an honest try. Feedback does not depend on it."""
    if result.passed:
        note_progress(result.exercise.id, ExerciseProgress(passed=True))
    elif result.attempted:
        note_progress(result.exercise.id, ExerciseProgress(tries=(digest_of(function),)))


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
    return run_check(check_data_of(exercise, None if cases is None else tuple(cases), seed), function)


def run_check(exercise, function):
    """Run an answer on the cases of an exercise.

    Parameters
    ----------
    exercise : CheckData
    function : callable

    Returns
    -------
    CheckResult
    """
    hints = [case.hint for case in exercise.cases]
    remarks = tuple(remarks_on_source(function, hints=hints))
    if _is_stub(exercise, function):
        return CheckResult(exercise, attempted=False, remarks=remarks)
    function = function_as_graded(function, exercise.allowed)
    calls = []
    pairs = [(case, expected) for case in exercise.cases for expected in case.calls]
    for case, expected in pairs:
        overwrite_freed_memory(expected.result.value)
        result = exercise.call(function, expected.arguments)
        if result.error == "NotImplementedError":
            return CheckResult(exercise, attempted=False, remarks=remarks)
        difference = None
        if result.finished:
            difference = compare(
                expected.result.value, result.value, case.tolerance, exact_type=exercise.exact_type
            )
        calls.append(CaseCall(case, expected.arguments, expected.result, result, difference))
        if result.timed_out:
            break  # a learner waits for one time limit, not for one per call
    results = tuple(_case_result(case, calls) for case in exercise.cases)
    dependencies = find_dependencies(function, exercise.allowed, set(exercise.provided))
    if dependencies.foreign:
        dependencies = split_taken(dependencies, RUNS.sources(), exercise.names)
    has_passed = all(result.passed for result in results)
    mistake = None if has_passed else _known_mistake(exercise, calls)
    errors = {case_call.result.error for case_call in calls}
    remarks = () if has_passed else tuple(remarks_on_source(function, errors, hints))
    result = CheckResult(exercise, True, results, mistake, dependencies, remarks=remarks)
    return replace(result, diagnosis=_diagnosis(result, calls))


def _diagnosis(result, calls):
    shown_value = result.shown
    if shown_value is None or shown_value.difference is None or shown_value.result.changed:
        return Diagnosis()
    exercise = result.exercise
    return diagnose(calls, shown_value, exercise.names, exact_type=exercise.exact_type)


def _is_stub(exercise, function):
    code, stub = code_of(function), _code_in(exercise.stub, exercise.function)
    return None not in (code, stub) and (code.co_code, code.co_consts, code.co_names) == (
        stub.co_code,
        stub.co_consts,
        stub.co_names,
    )


def _code_in(source, name):
    """The code object of a function that a source defines, found without running the source; or None."""
    constants = compile(source, "<stub>", "exec", dont_inherit=True).co_consts
    codes = [code for code in constants if isinstance(code, types.CodeType) and code.co_name == name]
    return codes[-1] if codes else None


def _case_result(case, calls):
    own_calls = [case_call for case_call in calls if case_call.case is case]
    failed_call = next((case_call for case_call in own_calls if not case_call.passed), None)
    return CaseResult(case, bool(own_calls) and failed_call is None, failed_call)


def _known_mistake(exercise, calls):
    """The declared mistake that explains an answer, or None.

    A mistake explains an answer if both do the same in every call. It may also be the only mistake that does
    the same in every call in which the answer returned a value. If the type of a right value is free, it is
    free here too: first a mistake with the same types is looked for, then one with the same values.
    """
    returned = [case_call for case_call in calls if case_call.result.value not in (None, _NONE)]
    is_right = all(case_call.passed for case_call in returned)
    for exact_type in (True,) if exercise.exact_type else (True, False):
        matches = [mistake for mistake in exercise.mistakes if _explains(mistake, calls, exact_type)]
        if matches:
            return matches[0]
        if is_right:
            continue
        matches = [mistake for mistake in exercise.mistakes if _explains(mistake, returned, exact_type)]
        if len(matches) == 1:
            return matches[0]
    return None


def _explains(mistake, calls, exact_type):
    return all(_does_the_same(mistake, case_call, exact_type) for case_call in calls)


def _does_the_same(mistake, case_call, exact_type):
    position = [id(expected.arguments) for expected in case_call.case.calls].index(id(case_call.arguments))
    predicted = mistake.results[case_call.case.id][position]
    return case_call.result.matches(predicted, case_call.case.tolerance, exact_type=exact_type)
