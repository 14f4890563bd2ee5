"""One judge: what an answer did in the cases of an exercise becomes a CheckResult.

`check` in a notebook and grading judge here, and all that is shown of an answer is made from this result.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from . import feedback
from .canonical import array_of
from .diagnosis import Diagnosis, diagnose
from .lesson import Case, Exercise, Mistake
from .running import CaseCall, attempt

NONE = {"type": "None"}  # the canonical form


@dataclass(frozen=True)
class CaseResult:
    """One case, and the first of its calls that failed.

    `failed_call` is None, too, if the case made no call; `reason` says why, and `note` is shown beside the
    title: grading sets them.
    """

    case: Case
    passed: bool
    failed_call: CaseCall | None
    reason: str = "not run, because the call above did not finish"
    note: str = ""
    is_open: bool = False  # not attempted


@dataclass(frozen=True)
class CheckResult:
    """The result of `check`. A notebook shows it as HTML; `print(result)` gives the same as plain text.

    `refused` is {module that the exercise does not allow: what the answer uses of it}, `gone` is {name that
    the answer reads: what has happened to the cell that made it}.
    """

    exercise: Exercise
    attempted: bool  # False for the unchanged stub
    results: tuple[CaseResult, ...] = ()  # one for each public case
    mistake: Mistake | None = None  # the known mistake that explains the answer
    refused: dict[str, str] = field(default_factory=dict)
    gone: dict[str, str] = field(default_factory=dict)
    diagnosis: Diagnosis = field(default_factory=Diagnosis)  # of the values of the shown call
    remarks: tuple[str, ...] = ()  # what is certain from the source of the function, sentences
    one_change: str = ""  # where one change would make it right, a sentence
    why_older: str = ""  # why the function is older than the page, and was not run
    calls: tuple[CaseCall, ...] = ()  # those that passed too

    @property
    def passed(self) -> bool:
        """True if grading would give every point of the public cases."""
        is_accepted = not (self.refused or self.gone or self.why_older)
        return self.attempted and is_accepted and all(result.passed for result in self.results)

    @property
    def shown(self) -> CaseCall | None:
        """The failed call whose values are shown: one that the known mistake explains, else the first."""
        failed = [result.failed_call for result in self.results if result.failed_call]
        explained = [case_call for case_call in failed if self.mistake and case_call.result.finished]
        return next(iter([*explained, *failed]), None)

    @property
    def points(self) -> int:
        """What grading gives for the public cases."""
        if self.refused or self.gone:
            return 0
        return sum(result.case.points for result in self.results if result.passed)

    def __repr__(self):
        return feedback.document_of(self).plain()

    def _repr_html_(self):
        return feedback.document_of(self).html()


def judge(exercise, calls, mistake=None, remarks=(), *, attempted=True):
    """The CheckResult of the CaseCalls of an exercise's cases, with what is certain about their values."""
    results = []
    for case in exercise.cases:
        own_calls = [case_call for case_call in calls if case_call.case is case]
        failed_call = next((case_call for case_call in own_calls if not case_call.passed), None)
        results.append(CaseResult(case, bool(own_calls) and failed_call is None, failed_call))
    result = CheckResult(exercise, attempted, tuple(results), mistake, remarks=remarks, calls=tuple(calls))
    return replace(result, diagnosis=attempt(lambda: _diagnosis(result), Diagnosis()))


def _diagnosis(result):
    shown, exercise = result.shown, result.exercise
    if not exercise.kind.shows_values or shown is None or shown.difference is None or shown.result.changed:
        return Diagnosis()
    return diagnose(result.calls, shown, exercise.names, exact_type=exercise.exact_type)


def known_mistake(exercise, calls):
    """The declared mistake that explains the CaseCalls of an answer, or None.

    A mistake explains an answer if both do the same in every call. It may also be the only mistake that does
    the same in every call in which the answer returned a value, unless these are arrays of one value. First a
    mistake with the same types is looked for; then one with the same values, unless they are right and only
    their type is not.
    """
    returned = [case_call for case_call in calls if case_call.result.value not in (None, NONE)]
    is_right = all(case_call.passed for case_call in returned)
    for exact_type in (True,) if all(map(has_right_values, returned)) else (True, False):
        matches = _mistakes_like(exercise, calls, exact_type)
        if not matches and not is_right and not all(map(_is_constant, returned)):
            matches = _mistakes_like(exercise, returned, exact_type)
            matches = matches if len(matches) == 1 else []
        if matches:
            return matches[0]
    return None


def _mistakes_like(exercise, calls, exact_type):
    """The declared mistakes that do the same in all these calls."""
    return [
        mistake
        for mistake in exercise.mistakes
        if all(_does_the_same(mistake, case_call, exact_type) for case_call in calls)
    ]


def _does_the_same(mistake, case_call, exact_type):
    position = [id(expected.arguments) for expected in case_call.case.calls].index(id(case_call.arguments))
    predicted = mistake.results[case_call.case.id][position]
    return case_call.result.matches(predicted, case_call.case.tolerance, exact_type=exact_type)


def _is_constant(case_call):
    """Whether an answer is an array of equal values, as many mistakes make one."""
    values = array_of(case_call.result.value)
    return values is not None and len(np.unique(values)) < 2


def has_right_values(case_call):
    """Whether values are right, in a type that may be wrong, also if that type has cut them."""
    expected, result = case_call.expected, case_call.result
    if result.matches(expected, case_call.case.tolerance, exact_type=False):
        return True
    values, actual = array_of(expected.value), array_of(result.value)
    if values is None or actual is None:
        return False
    with np.errstate(all="ignore"):
        return np.array_equal(values.astype(actual.dtype), actual)
