"""The expected results of a declared exercise: its solution and its known mistakes are run on its cases."""

from dataclasses import replace
from functools import lru_cache, wraps

from . import feedback
from .drive_check import drive_scenarios
from .lesson import PUBLIC_SEED, ExpectedCall, scenario_of
from .percent_script import MasterError
from .running import argument_names


class MistakeResults(dict):
    """The results of a declared mistake: computed when asked for, because most checks ask for none."""

    def __init__(self, exercise, mistake, cases, seed):
        self._exercise, self._mistake, self._cases, self._seed = exercise, mistake, cases, seed

    def __missing__(self, case_id):
        if self._exercise.drives:
            for case, (_record, result) in zip(self._cases, self.drives(), strict=True):
                self[case.id] = (result,)
            return self[case_id]
        case = next(case for case in self._cases if case.id == case_id)
        return _results_of_mistake(self._exercise, self._mistake, case, self._seed)

    def drives(self):
        """What it drove: (record, CallResult) of each case."""
        return _drive_mistake(self._exercise, self._mistake, self._cases, self._seed)


def _cached(function):
    """Caches what does not depend on the Exercise's other mistakes."""
    cached = lru_cache(maxsize=1024)(function)
    return wraps(function)(lambda exercise, *arguments: cached(replace(exercise, mistakes=()), *arguments))


def with_results(exercise, cases, solve, results_of):
    """An Exercise with these cases, and with what its solution and its mistakes do in them.

    `solve(exercise, case)` gives ExpectedCalls; `results_of(exercise, mistake, cases)`, of cases that have
    them, gives {id of a case: CallResults}. MasterError: the solution or a case fails.
    """
    solution = exercise.function_of(exercise.solution, "solution")
    names, provided = argument_names(solution, exercise.subject), sorted(exercise.namespace())
    exercise = replace(exercise, names=tuple(names), provided=tuple(provided))
    cases = tuple(replace(case, calls=tuple(solve(exercise, case))) for case in cases)
    mistakes = [replace(one, results=results_of(exercise, one, cases)) for one in exercise.mistakes]
    return replace(exercise, cases=cases, mistakes=tuple(mistakes))


def results_of_mistake(exercise, mistake, case):
    """What a declared mistake does in a case that has its calls, a tuple of CallResult."""
    wrong_function = exercise.function_of_mistake(mistake)
    return tuple(exercise.call(wrong_function, expected.arguments) for expected in case.calls)


# Cached from one check to the next: a slow solution runs once. A changed master gives another Exercise.
@lru_cache(maxsize=256)
def check_data_of(exercise, cases=None, seed=PUBLIC_SEED):
    """The Exercise `with_results` in these cases (the public ones if omitted), with inputs from this seed.

    A mistake runs when its results are asked for. MasterError: the solution or a case fails.
    """

    def solve(exercise, case):
        return _solve(exercise, case, seed)

    def results_of(exercise, mistake, cases):
        return MistakeResults(exercise, mistake, cases, seed)

    return with_results(exercise, exercise.public if cases is None else cases, solve, results_of)


@_cached
def _solve(exercise, case, seed):
    if exercise.drives:
        return tuple(ExpectedCall(arguments) for arguments in exercise.arguments(case, seed))
    solution = exercise.function_of(exercise.solution, "solution")
    calls = []
    for arguments in exercise.arguments(case, seed):
        result = exercise.call(solution, arguments)
        if not result.finished or result.changed:
            explanation = feedback.explain_call(result, None, exercise.answer_name)
            raise MasterError(f"{exercise.master.name}, {case.id}: the solution fails. {explanation}")
        calls.append(ExpectedCall(arguments, result))
    return tuple(calls)


@_cached
def _drive_mistake(exercise, mistake, cases, _seed):
    scenarios = list(map(scenario_of, cases))
    return drive_scenarios(exercise, scenarios, lambda: exercise.function_of_mistake(mistake))


@_cached
def _results_of_mistake(exercise, mistake, case, _seed):
    return results_of_mistake(exercise, mistake, case)
