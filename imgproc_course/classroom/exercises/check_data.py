"""What a check knows of an exercise: inputs, expected results and known mistakes, never the solution.

A master declares it (`declaration`; `expected_results` runs the solution), or the file that a lesson carries
holds it (`check_files`: the learner's `check`).
"""

from dataclasses import dataclass, field, fields

import numpy as np

from .ros_double import offer_modules
from .running import NODES, CallResult, answer_name, bytes_allowed, call


@dataclass(frozen=True, eq=False)
class ExpectedCall:
    """One call of a case: its arguments, and what a right answer does with them."""

    arguments: tuple
    result: CallResult


@dataclass(frozen=True)
class Case:
    """One check of an exercise; `calls` are ExpectedCalls, once the solution has run."""

    id: str
    title: str
    points: int
    hint: str
    tolerance: float
    hidden: bool = False
    source: str = ""  # defines `inputs(rng)`
    line: int = 0  # of the master
    calls: tuple = field(default=(), compare=False)


@dataclass(frozen=True)
class Mistake:
    """A usual wrong answer, what it `says` to the learner, and {id of a case: a CallResult for each call}."""

    name: str
    says: str
    source: str = ""
    results: dict[str, tuple[CallResult, ...]] = field(default_factory=dict, compare=False)


@dataclass(frozen=True, kw_only=True)
class CheckData:
    """An exercise as a check needs it; `declaration.exercise` documents most fields.

    `names` are those of the function's arguments, `given` the sources of the given cells, and `provided` the
    names that an answer may use from outside its cell. Only grading runs the hidden cases.
    """

    id: str
    title: str
    function: str
    subject: str = "function"
    sensors: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    stub: str
    given: tuple[str, ...]
    provided: tuple[str, ...] = ()
    allowed: tuple[str, ...]
    time_limit: float
    practice: bool
    hidden_count: int
    hidden_points: int
    border_hint: str
    hints: tuple[str, ...]
    another_way: str
    exact_type: bool
    cases: tuple[Case, ...]
    mistakes: tuple[Mistake, ...]

    @property
    def points(self):
        """Points of all its cases."""
        return sum(case.points for case in self.cases)

    @property
    def answer_name(self):
        """How texts name its answer, double() or Doubler."""
        return answer_name(self.function, self.subject)

    @property
    def kind(self):
        """What texts call its answer."""
        return "class" if self.subject == "node" else "function"

    def can_be_answer(self, value):
        """Whether a value is of the kind of its answers."""
        return isinstance(value, type) if self.subject == "node" else callable(value)

    def namespace(self):
        """A new namespace as an answer gets it in grading: np, and what the given cells define."""
        if self.subject in NODES:
            offer_modules()
        names = {"np": np, "__name__": self.id}
        for number, source in enumerate(self.given, 1):
            self.run_part(source, names, f"given cell {number} of {self.id}")
        return names

    def run_part(self, source, names, label):
        """Run a source of the lesson's author in a namespace."""
        exec(compile(source, f"<{label}>", "exec", dont_inherit=True), names)

    def call(self, function, arguments, seconds=None, expected=None):
        """The CallResult of one call of an answer, within its time limit, or within these seconds.

        Of a value that is much larger than the `expected` form, the arrays are given without their values.
        """
        most = None if expected is None else bytes_allowed(expected)
        return call(function, arguments, self.names, seconds or self.time_limit, self.subject, most)


@dataclass(frozen=True)
class LessonDescription:
    """A lesson as it was handed out."""

    name: str
    version: str  # of the course
    exercises: tuple  # KeyExercises from an answer key, or CheckData from a checks file
    cells: dict  # {cell id: source of a check or given cell, None for the others}


def shared_fields(record, kind):
    """What a record has for the fields of another kind of record, as a dict."""
    return {field.name: getattr(record, field.name) for field in fields(kind) if hasattr(record, field.name)}
