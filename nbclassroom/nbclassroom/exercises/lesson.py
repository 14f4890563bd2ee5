"""A lesson's exercises: one record, from its declaration to its grade.

A master declares an Exercise (`declaration`), `with_results` runs its solution and its mistakes, and
`authoring.lesson_files` writes it. `check_files` reads it again: for `check` beside a lesson, for grading in
an answer key, with the hidden cases. Then it has neither the solution nor what makes inputs.
"""

import zlib
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from .comparison import compare
from .kinds import kind_of
from .percent_script import MasterError
from .running import CallResult, CaseCall, bytes_allowed, call, explain_call
from .source_remarks import unused_arguments

PUBLIC_SEED = 20_240_501  # what `check` draws its inputs from; a teacher's key has a seed of its own


@dataclass(frozen=True, eq=False)
class ExpectedCall:
    """One call of a case: its arguments, and what a right answer does with them."""

    arguments: tuple
    result: CallResult = field(default_factory=CallResult)  # of a drive nothing: thresholds judge it


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
class Exercise:
    """An exercise; `declaration.exercise` documents most fields.

    `names` are those of the function's arguments, `given` the sources of the given cells, and `provided` the
    names that an answer may use from outside its cell; `unheeded` are those arguments that the solution does
    not use. Only grading runs the hidden cases; a key has no case of an exercise for practice. The fields
    from `master` on are its master's alone: `preparation` runs before each case and mistake, and then
    `helpers` before each mistake.
    """

    id: str
    title: str = ""
    function: str = ""
    subject: str = "function"
    sensors: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    stub: str = ""
    given: tuple[str, ...] = ()
    provided: tuple[str, ...] = ()
    allowed: tuple[str, ...] = ()
    time_limit: float = 5.0
    practice: bool = False
    hidden_count: int = 0
    hidden_points: int = 0
    unheeded: tuple[str, ...] = ()
    border_hint: str = ""
    hints: tuple[str, ...] = ()
    another_way: str = ""
    exact_type: bool = False
    figure: bool = False  # whether a person grades the last figure of a code cell
    rubric: tuple[tuple[str, int], ...] = ()  # (what to look for, points), where a person grades
    cases: tuple[Case, ...] = ()
    witnesses: tuple[Case, ...] = ()  # with other inputs, for which a change must make an answer right, too
    mistakes: tuple[Mistake, ...] = ()
    master: Any = None  # the Path of the file that it was read from
    preparation: str = ""
    solution: str = ""
    explanation: str = ""
    helpers: str = ""

    @property
    def points(self):
        return sum(case.points for case in self.cases)

    @property
    def public(self):
        return tuple(case for case in self.cases if not case.hidden)

    @property
    def hidden(self):
        return tuple(case for case in self.cases if case.hidden)

    @property
    def kind(self):
        return kind_of(self.subject)

    @property
    def answer_name(self):
        """How texts name its answer, double() or Doubler."""
        return self.kind.name_of(self.function)

    def namespace(self):
        """A new namespace as an answer gets it in grading: np, and what the given cells define."""
        self.kind.prepare()
        names = {"np": np, "__name__": self.id}
        for number, source in enumerate(self.given, 1):
            self.run_part(source, names, f"given cell {number} of {self.id}")
        return names

    def run_part(self, source, names, label):
        """Run a part of the master in a namespace; MasterError if it fails."""
        place = f"{self.master.name}, {label}"
        try:
            exec(compile(source, f"<{place}>", "exec", dont_inherit=True), names)
        except Exception as error:
            raise MasterError(f"{place}: {type(error).__name__}: {error}") from error

    def _prepared(self):
        """A new namespace for the master's own cases and mistakes."""
        names = self.namespace() | {"exercise": lambda *_arguments, **_options: None}
        self.run_part(self.preparation, names, f"declaration of {self.id}")
        return names

    def function_of(self, source, label, *, prepared=False):
        """The exercise's function as a source defines it in a new namespace; MasterError if it does not.

        Prepared, as for a mistake, it has the helpers, and the right answer as `solution`.
        """
        names = self._prepared() if prepared else self.namespace()
        if prepared:
            self.run_part(self.helpers, names, f"helpers of the mistakes of {self.id}")
            names["solution"] = self.function_of(self.solution, "solution")
        self.run_part(source, names, f"{label} of {self.id}")
        answer = names.get(self.function)
        if not self.kind.can_be_answer(answer):
            place = f"{self.master.name}: the {label} of {self.id}"
            raise MasterError(f"{place} does not define the {self.kind.noun} {self.answer_name}")
        return answer

    def function_of_mistake(self, mistake):
        return self.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)

    def call(self, function, arguments, seconds=None, expected=None):
        """The CallResult of one call of an answer, within its time limit, or within these seconds.

        Of a value that is much larger than the `expected` form, the arrays are given without their values.
        """
        most = None if expected is None else bytes_allowed(expected)
        return call(function, arguments, self.names, seconds or self.time_limit, self.kind.run, most)

    def judged_call(self, answer, case, expected, seconds=None):
        """The CaseCall of an answer for an ExpectedCall of a case, within the time limit or these seconds."""
        value = expected.result.value
        return self.judge(case, expected, self.call(answer, expected.arguments, seconds, value))

    def judge(self, case, expected, result):
        """The CaseCall of what an answer did, a CallResult."""
        difference = None
        if result.finished:
            values = expected.result.value, result.value
            difference = compare(*values, case.tolerance, exact_type=self.exact_type)
        return CaseCall(case, expected.arguments, expected.result, result, difference)

    def results_of_mistake(self, mistake, case):
        """What a declared mistake does in a case that has its calls, a tuple of CallResult."""
        answer = self.function_of_mistake(mistake)
        return tuple(self.call(answer, expected.arguments) for expected in case.calls)

    def arguments(self, case, seed=PUBLIC_SEED):
        """A tuple of arguments for each call that a case makes; it depends only on the seed and the case.

        A key's seed shuffles the calls. The seed of the lesson keeps the master's order: the simplest first.
        """
        return next(self.draws(case, seed))

    def draws(self, case, seed=PUBLIC_SEED):
        """The arguments of a case again and again, each time drawn on from the same generator."""
        label = f"line {case.line}: {case.id}"
        place, names = f"{self.master.name}, {label}", self._prepared()
        self.run_part(case.source, names, label)
        if "inputs" not in names:
            raise MasterError(f"{place} does not define inputs(rng)")
        rng = np.random.default_rng([seed, zlib.crc32(case.id.encode())])
        while True:
            try:
                inputs = names["inputs"](rng)
            except Exception as error:
                raise MasterError(f"{place}: inputs(rng) raised {type(error).__name__}: {error}") from error
            calls = inputs if isinstance(inputs, list) else [inputs]
            if not calls or not all(isinstance(call, tuple) for call in calls):
                text = "inputs(rng) must return a tuple of arguments, (frame,), or a list of such tuples"
                raise MasterError(f"{place}: {text}")
            calls = self.kind.checked_inputs(case, calls, place)
            order = range(len(calls)) if seed == PUBLIC_SEED else rng.permutation(len(calls))
            yield [calls[number] for number in order]


class MistakeResults(dict):
    """The results of a declared mistake: computed when asked for, because most checks ask for none."""

    def __init__(self, exercise, mistake, cases):
        self._cases = {case.id: case for case in cases}
        self._results_of = partial(exercise.results_of_mistake, mistake)

    def __contains__(self, case_id):
        return case_id in self._cases

    def __missing__(self, case_id):
        return self.setdefault(case_id, self._results_of(self._cases[case_id]))


def with_results(exercise, cases, solve, results_of):
    """An Exercise with these cases, and with what its solution and its mistakes do in them.

    `solve(exercise, case)` gives ExpectedCalls; `results_of(exercise, mistake, cases)`, of cases that have
    them, gives {id of a case: CallResults}. MasterError: the solution or a case fails.
    """
    if exercise.kind.graded_by_person:
        return replace(exercise, cases=cases)
    solution = exercise.function_of(exercise.solution, "solution")
    names, provided = exercise.kind.argument_names(solution), sorted(exercise.namespace())
    unheeded = unused_arguments(exercise.solution, exercise.function)
    exercise = replace(exercise, names=tuple(names), provided=tuple(provided), unheeded=unheeded)
    cases = tuple(replace(case, calls=tuple(solve(exercise, case))) for case in cases)
    exercise = replace(exercise, cases=cases)
    if not exercise.kind.expects_values:
        return exercise
    mistakes = [replace(one, results=results_of(exercise, one, cases)) for one in exercise.mistakes]
    return replace(exercise, mistakes=tuple(mistakes))


# Cached from one check to the next: a slow solution runs once. A changed master gives another Exercise.
@lru_cache(maxsize=256)
def check_data_of(exercise, cases=None, seed=PUBLIC_SEED):
    """The Exercise `with_results` in these cases (the public ones if omitted), with inputs from this seed.

    A mistake runs when its results are asked for. MasterError: the solution or a case fails.
    """

    def solve(exercise, case):
        return _solve(replace(exercise, mistakes=()), case, seed)  # it does not depend on them

    return with_results(exercise, exercise.public if cases is None else cases, solve, MistakeResults)


@lru_cache(maxsize=1024)
def _solve(exercise, case, seed):
    if not exercise.kind.expects_values:
        return tuple(ExpectedCall(arguments) for arguments in exercise.arguments(case, seed))
    solution = exercise.function_of(exercise.solution, "solution")
    calls = []
    for arguments in exercise.arguments(case, seed):
        result = exercise.call(solution, arguments)
        if not result.finished or result.changed:
            explanation = explain_call(result, None, exercise.answer_name)
            raise MasterError(f"{exercise.master.name}, {case.id}: the solution fails. {explanation}")
        calls.append(ExpectedCall(arguments, result))
    return tuple(calls)
