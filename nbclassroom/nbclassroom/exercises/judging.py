"""One judge: what an answer did in the cases of an exercise becomes a CheckResult.

`check` in a notebook and grading judge here, and all that is shown of an answer is made from this result.
"""

from dataclasses import dataclass, field, replace

from . import feedback
from .diagnosis import Diagnosis, diagnose
from .lesson import Case, Exercise, Mistake
from .running import CaseCall, attempt


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
        return repr(feedback.document_of(self))

    def _repr_html_(self):
        return feedback.document_of(self)._repr_html_()


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
