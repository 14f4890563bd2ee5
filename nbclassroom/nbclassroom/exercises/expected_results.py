"""The expected results of a declared exercise: its solution and its known mistakes are run on its cases."""

from dataclasses import replace
from functools import lru_cache

from .case_call import explain_call
from .lesson import PUBLIC_SEED, ExpectedCall
from .percent_script import MasterError
from .source_remarks import unused_arguments


class MistakeResults(dict):
    """The results of a declared mistake: computed when asked for, because most checks ask for none."""

    def __init__(self, exercise, mistake, cases):
        self._about = exercise, mistake, cases

    def __contains__(self, case_id):
        return any(case.id == case_id for case in self._about[2])

    def __missing__(self, case_id):
        self.update(self._about[0].kind.results_of_mistake(*self._about, case_id))
        return self[case_id]


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
    mistakes = [replace(one, results=results_of(exercise, one, cases)) for one in exercise.mistakes]
    return replace(exercise, cases=cases, mistakes=tuple(mistakes))


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
