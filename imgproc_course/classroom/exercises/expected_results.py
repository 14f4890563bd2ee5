"""The expected results of a declared exercise: its solution and its known mistakes are run on its cases."""

from dataclasses import replace
from functools import lru_cache, wraps

from . import feedback
from .check_data import ExpectedCall
from .declaration import PUBLIC_SEED, MasterError
from .drive_check import drive_scenarios
from .running import CallResult, argument_names


class MistakeResults(dict):
    """The results of a declared mistake: computed when asked for, because most checks ask for none."""

    def __init__(self, exercise, mistake, cases, seed):
        self._exercise, self._mistake, self._cases, self._seed = exercise, mistake, cases, seed

    def __missing__(self, case_id):
        if self._exercise.subject == "drive":
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


# Cached from one check to the next: a slow solution runs once. A changed master gives another Exercise.
@lru_cache(maxsize=256)
def check_data_of(exercise, cases=None, seed=PUBLIC_SEED):
    """The CheckData of an Exercise, for these cases (the public ones if omitted) with inputs from this seed.

    MasterError: the solution or a case fails.
    """
    cases = exercise.public if cases is None else cases
    solution = exercise.function_of(exercise.solution, "solution")
    names, provided = argument_names(solution, exercise.subject), sorted(exercise.namespace())
    exercise = replace(exercise, names=tuple(names), provided=tuple(provided))
    solved = [replace(case, calls=_solve(exercise, case, seed)) for case in cases]
    mistakes = [replace(one, results=MistakeResults(exercise, one, cases, seed)) for one in exercise.mistakes]
    return replace(exercise, cases=tuple(solved), mistakes=tuple(mistakes))


@_cached
def _solve(exercise, case, seed):
    if exercise.subject == "drive":  # thresholds judge it
        return tuple(ExpectedCall(arguments, CallResult()) for arguments in exercise.arguments(case, seed))
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
def _drive_mistake(exercise, mistake, cases, seed):
    scenarios = [_solve(exercise, case, seed)[0].arguments[0] for case in cases]
    return drive_scenarios(exercise, scenarios, lambda: exercise.function_of_mistake(mistake))


@_cached
def _results_of_mistake(exercise, mistake, case, seed):
    wrong_function = exercise.function_of_mistake(mistake)
    calls = _solve(exercise, case, seed)
    return tuple(exercise.call(wrong_function, expected.arguments) for expected in calls)
