"""The one comparison of a test case: what its check cell showed, against what the key expects."""

from dataclasses import dataclass, field
from typing import Any

from ..exercises.comparison import Difference, compare
from .answer_forms import read_answer
from .sandbox.cell_run import CellRun


@dataclass(frozen=True)
class Verdict:
    calls: list | None = None  # of CallResult; None: the check cell showed no well-formed answer, or several
    failed_call: int | None = None  # index of the first call that did not do what the key expects
    difference: Difference | None = None  # of that call's value; None: there was no value to compare

    # What a partner measures is told of hidden cases, too (see `kinds.drive.graded.DriveVerdict`).
    when, measured, told_of_hidden = "", "", ""

    @property
    def passed(self):
        return self.calls is not None and self.failed_call is None

    @property
    def call(self):
        """The CallResult of the call that failed, or None."""
        calls, number = self.calls or [], self.failed_call
        return calls[number] if number is not None and number < len(calls) else None

    @property
    def forged(self):
        """Why no honest check shows this, "" if one does."""
        if self.calls is None:
            return "its check cell showed something else than what the function returned"
        is_other = self.failed_call is not None and self.call is None
        return "its check cell reported other calls than were made" if is_other else ""

    def case_calls(self, exercise, case):
        pairs = zip(case.calls, self.calls or (), strict=False)
        return [exercise.judge(case, expected, result) for expected, result in pairs]


@dataclass
class CaseRun:
    """One test case in its kernel: how the answer cell and then the check cell ended, and the verdict."""

    answer: CellRun = field(default_factory=CellRun)
    check: CellRun = field(default_factory=CellRun)
    verdict: Any = field(default_factory=Verdict)  # or that of a partner, see `kinds.kind.Kind.partner`
    is_measured: bool = False  # by a partner
    told: list = field(default_factory=list)  # what the kernel showed beside a partner: no verdict reads it

    @property
    def ended(self):
        """How the kernel was ended, "" if it was not (see CellRun)."""
        return self.answer.ended or self.check.ended

    @property
    def passed(self):
        return not self.ended and not self.check.error[0] and self.verdict.passed


@dataclass(frozen=True, eq=False)
class StoredAnswer:
    """What nbval finds as the stored output of a check: the answer key's values. `==` is our comparison.

    nbval asks `stored != shown`, where a CaseRun stands for the output of a check, which a learner's code
    made; it lets the check's cell fail if it is so. What a partner has measured is
    compared with the thresholds of its scenario.
    """

    expected: list  # a canonical form for each call
    tolerance: float = 0.0
    exact_type: bool = False

    def verdict(self, run):
        if run.is_measured:
            return run.verdict
        return verdict_on(run.check.answers, self.expected, self.tolerance, exact_type=self.exact_type)

    def __eq__(self, shown):
        return isinstance(shown, CaseRun) and self.verdict(shown).passed

    def explain(self, shown):
        """Why `stored == shown` is false, in a line."""
        difference = getattr(self.verdict(shown), "difference", None)
        return difference.message if difference else "it is not what the solution gives"


def verdict_on(payloads, expected, tolerance, *, exact_type=True):
    """The Verdict on the one payload that a check cell showed, against a canonical form for each call.

    The comparison is `exercises.compare`, so `check` in a lesson and the autograder agree.
    """
    calls = read_answer(payloads)
    if calls is None:
        return Verdict()
    for number, form in enumerate(expected):
        if number >= len(calls) or calls[number].value is None or calls[number].changed:
            return Verdict(calls, number)
        difference = compare(form, calls[number].value, tolerance, exact_type=exact_type)
        if difference is not None:
            return Verdict(calls, number, difference)
    return Verdict(calls, len(expected) if len(calls) > len(expected) else None)
