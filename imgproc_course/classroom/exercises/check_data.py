"""What a check needs to know of an exercise: inputs, expected results and known mistakes, never the solution.

It is made from a declared exercise (`check_data_of`: validation, tests, the answer key) or read from the file
that a lesson carries (`check_files`: the learner's `check`).
"""

import linecache
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from inspect import signature

import numpy as np

from imgproc_course.classroom.exercises import feedback
from imgproc_course.classroom.exercises.cell_syntax import cells_of, needed_parts, parts_of
from imgproc_course.classroom.exercises.declaration import PUBLIC_SEED, MasterError
from imgproc_course.classroom.exercises.dependencies import tree_as_graded
from imgproc_course.classroom.exercises.running import CallResult, by_itself, call


@dataclass(frozen=True, eq=False)
class ExpectedCall:
    """One call of a case: its arguments, and what a right answer does with them."""

    arguments: tuple
    result: CallResult


@dataclass(frozen=True, eq=False)
class CheckCase:
    """One case with its calls, a tuple of ExpectedCall."""

    id: str
    title: str
    points: int
    hint: str
    tolerance: float
    calls: tuple


@dataclass(frozen=True, eq=False)
class CheckMistake:
    """A known mistake; `results` maps the id of a case to a tuple of CallResult, one for each call."""

    name: str
    says: str
    results: Mapping


@dataclass(frozen=True, eq=False)
class CheckData:
    """An exercise as a check needs it.

    names          argument names of the function
    stub           source of the answer cell as it was handed out
    given          sources of the given cells
    provided       names that an answer may use from outside its cell
    cases          tuple of CheckCase
    mistakes       tuple of CheckMistake
    hidden_count   number of the cases that only grading runs
    hidden_points  their points
    exact_type     whether a right value in another type is wrong
    The other fields are those of the declaration.
    """

    id: str
    title: str
    function: str
    names: tuple
    stub: str
    given: tuple
    provided: tuple
    allowed: tuple
    time_limit: float
    practice: bool
    cases: tuple
    mistakes: tuple
    hidden_count: int
    hidden_points: int
    border_hint: str
    hints: tuple
    another_way: str
    exact_type: bool = False

    @property
    def points(self):
        """Points of all its cases."""
        return sum(case.points for case in self.cases)

    def namespace(self):
        """A new namespace as an answer gets it in grading: np, and what the given cells define."""
        names = {"np": np, "__name__": self.id}
        for source in self.given:
            exec(compile(source, f"<given cell of {self.id}>", "exec", dont_inherit=True), names)
        return names

    def run_answer(self, source, function=None):
        """Run the source of an answer in a namespace of its own.

        As in grading, it runs statement by statement, one that fails or calls exit() costs only itself, and
        nobody sees what it prints. Modules that the exercise does not allow are not there.

        Parameters
        ----------
        source : str, as `CellDefinitions.compose` gives it
        function : str, the name of a function; then only what it needs is run

        Returns
        -------
        (the names that it defines, as a dict; the first error as text or "")
        """
        names, reason = self.namespace(), ""
        for file, part in self._parts(source, function):
            try:
                with by_itself():
                    part = tree_as_graded(part, self.allowed) or part
                    exec(compile(part, file, "exec", dont_inherit=True), names)
            except (Exception, SystemExit) as error:  # noqa: BLE001 - the learner's code may raise anything
                reason = reason or f"{type(error).__name__}: {error}"
        return names, reason

    def _parts(self, source, function):
        """(name of its file, part) of a source; the lines stay readable by the name of their file."""
        parts = []
        for place, cell in zip(("answer", "beside the answer"), reversed(cells_of(source)), strict=False):
            file = f"<{place} to {self.id}>"
            linecache.cache[file] = (len(cell), None, cell.splitlines(keepends=True), file)
            parts = [*((file, part) for part in parts_of(cell)), *parts]
        needed = None if function is None else needed_parts([part for _, part in parts], function)
        return [(file, part) for file, part in parts if needed is None or part in needed]

    def call(self, function, arguments):
        """The CallResult of one call of an answer."""
        return _call(function, arguments, self.names, self.time_limit)


class _MistakeResults(Mapping):
    """The results of a declared mistake: computed when asked for, because most checks ask for none."""

    def __init__(self, exercise, mistake, cases, seed):
        self._exercise, self._mistake, self._seed = exercise, mistake, seed
        self._cases = {case.id: case for case in cases}

    def __getitem__(self, case_id):
        return _results_of_mistake(self._exercise, self._mistake, self._cases[case_id], self._seed)

    def __iter__(self):
        return iter(self._cases)

    def __len__(self):
        return len(self._cases)


# Cached from one check to the next: a slow solution runs once. A changed master gives another Exercise.
@lru_cache(maxsize=256)
def check_data_of(exercise, cases=None, seed=PUBLIC_SEED):
    """The CheckData of a declared exercise: the solution is run on the inputs of the cases.

    Parameters
    ----------
    exercise : Exercise
    cases : tuple of Case; the public ones if omitted
    seed : int, the seed of the inputs

    Returns
    -------
    CheckData

    Raises
    ------
    MasterError : the solution or a case fails
    """
    cases = exercise.public if cases is None else cases
    names = _argument_names(exercise)
    check_cases = [
        CheckCase(case.id, case.title, case.points, case.hint, case.tolerance, _solve(exercise, case, seed))
        for case in cases
    ]
    mistakes = [
        CheckMistake(mistake.name, mistake.says, _MistakeResults(exercise, mistake, cases, seed))
        for mistake in exercise.mistakes
    ]
    return CheckData(
        id=exercise.id,
        title=exercise.title,
        function=exercise.function,
        names=names,
        stub=exercise.stub,
        given=exercise.given,
        provided=tuple(sorted(exercise.namespace())),
        allowed=exercise.allowed,
        time_limit=exercise.time_limit,
        practice=exercise.practice,
        cases=tuple(check_cases),
        mistakes=tuple(mistakes),
        hidden_count=len(exercise.hidden),
        hidden_points=sum(case.points for case in exercise.hidden),
        border_hint=exercise.border_hint,
        hints=exercise.hints,
        another_way=exercise.another_way,
        exact_type=exercise.exact_type,
    )


@lru_cache(maxsize=256)
def _argument_names(exercise):
    return tuple(signature(exercise.function_of(exercise.solution, "solution")).parameters)


def _call(function, arguments, names, time_limit):
    more_names = (f"argument {k + 1}" for k in range(len(names), len(arguments)))
    return call(function, arguments, [*names[: len(arguments)], *more_names], time_limit)


@lru_cache(maxsize=256)
def _solve(exercise, case, seed):
    solution = exercise.function_of(exercise.solution, "solution")
    calls = []
    for arguments in exercise.arguments(case, seed):
        result = _call(solution, arguments, _argument_names(exercise), exercise.time_limit)
        if not result.finished or result.changed:
            explanation = feedback.explain_call(result, None, exercise.function)
            raise MasterError(f"{exercise.master.name}, {case.id}: the solution fails. {explanation}")
        calls.append(ExpectedCall(arguments, result))
    return tuple(calls)


@lru_cache(maxsize=1024)
def _results_of_mistake(exercise, mistake, case, seed):
    wrong_function = exercise.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)
    names = _argument_names(exercise)
    return tuple(
        _call(wrong_function, expected.arguments, names, exercise.time_limit)
        for expected in _solve(exercise, case, seed)
    )
