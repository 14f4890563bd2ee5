"""Validate an exercise before any learner is graded by it."""

from dataclasses import replace
from functools import partial
from itertools import cycle

from ..exercises.canonical import array_of, canonical
from ..exercises.checking import run_cases, run_mistake
from ..exercises.comparison import compare, describe
from ..exercises.lesson import PUBLIC_SEED
from ..exercises.names_read import NamesRead
from ..exercises.percent_script import MasterError

_ANOTHER_SEED = 1  # an instructor's key draws other inputs than the lesson
_MOST_BYTES = 65_536  # of an answer that is compared with a tolerance
BUILD_SEEDS = 10  # by which a build draws inputs; the course's own exercises are tested with 50
_MOST_BY_CHANCE = 2  # seeds with which guesses may be right: the one that they are from, and one more


def validate_exercise(exercise, seeds=BUILD_SEEDS):
    """Problems: a solution that fails, a stub or mistake that is not recognized, a mistake without costs.

    And checks whose points an answer can earn that looks at none of its arguments, with so many seeds.
    """
    if exercise.kind.graded_by_person:
        text = "no check sees a mistake in a written answer; make it a line of the rubric, with points < 0"
        return [f"{exercise.id}: {text}"] if exercise.mistakes else []
    solution = exercise.function_of(exercise.solution, "solution")
    if not exercise.kind.expects_values:
        return [*_refusals(exercise, solution), *_problems_of_thresholds(exercise, solution)]
    problems = [
        f"{case_result.case.id}: the solution does not pass it a second time; is the solution random?"
        for seed in (PUBLIC_SEED, _ANOTHER_SEED)
        for result in [run_cases(exercise, solution, cases=exercise.cases, seed=seed)]
        for case_result in _in_time(exercise, result).results
        if not case_result.passed
    ]
    problems += _refusals(exercise, solution)
    stub, arguments = exercise.function_of(exercise.stub, "stub"), exercise.arguments(exercise.cases[0])[0]
    result = _in_time(exercise, exercise.call(stub, arguments))
    if result.error != "NotImplementedError" and result.value != {"type": "None"}:
        text = 'the stub returns a value; let it raise NotImplementedError("your turn")'
        problems.append(f"{exercise.id}: {text}")
    for mistake in exercise.mistakes:
        problems += _mistake_problems(exercise, mistake)
    for case in exercise.cases:
        found = [_size_problem(exercise, case, solution)]
        if case.points:
            found.append(_seed_problem(exercise, case, solution, [PUBLIC_SEED, *range(1, seeds)]))
        problems += [f"{case.id}: {problem}" for problem in found if problem]
    return problems


def _in_time(exercise, result):
    """The result, of a call or a check; MasterError: a call did not finish in time, which proves nothing."""
    calls = [case_result.failed_call for case_result in getattr(result, "results", ())]
    results = [call.result for call in calls if call] if calls else [result]
    if any(result.timed_out for result in results):
        text = f"{exercise.id}: a call did not finish within its time_limit of {exercise.time_limit:g} s"
        raise MasterError(f"{text}: build again while the machine does nothing else, or raise the limit")
    return result


def _refusals(exercise, solution):
    return [
        f"{exercise.id}: the solution uses {module}; name it in allowed=(...), or solve it without"
        for module in NamesRead(solution).refused(exercise.allowed, set(exercise.provided))
    ]


def _problems_of_thresholds(exercise, solution):
    """Problems of an exercise that thresholds judge, in its public cases; a key proves its own."""
    for case_result in run_cases(exercise, solution).results:
        if not case_result.passed:
            text = exercise.kind.explain(exercise, case_result.failed_call)
            yield f"{case_result.case.id}: the solution does not pass it. {text}"
    stub = run_cases(exercise, exercise.function_of(exercise.stub, "stub"))
    if any(case_result.passed for case_result in stub.results):
        yield f"{exercise.id}: the stub passes a public case; let it drive, but badly"
    for mistake in exercise.mistakes:
        yield from _recognition_problems(exercise, mistake)
    for case in {case.source: case for case in exercise.hidden}.values():
        if exercise.arguments(case) == exercise.arguments(case, _ANOTHER_SEED):
            yield f"{case.id}: inputs(rng) ignores rng; draw the scenario from it"


def _recognition_problems(exercise, mistake):
    result = run_mistake(exercise, mistake)
    if all(case_result.passed for case_result in result.results):
        yield f"{exercise.id}: the mistake {mistake.name!r} passes every public case; add one that catches it"
    elif result.mistake is None or result.mistake.name != mistake.name:
        _in_time(exercise, result)
        confusion = f"is taken for {result.mistake.name!r}" if result.mistake else "is not recognized"
        problem = f"{confusion}; add a public case that tells the two apart"
        yield f"{exercise.id}: the mistake {mistake.name!r} {problem}"


def _mistake_problems(exercise, mistake):
    yield from _recognition_problems(exercise, mistake)
    wrong_function = exercise.function_of_mistake(mistake)
    graded = tuple(case for case in exercise.cases if case.points)
    unexplained = replace(exercise, mistakes=())  # whether it passes is all that counts here
    run = partial(run_cases, unexplained, wrong_function, cases=graded)
    if not exercise.practice and any(run(seed=seed).passed for seed in (PUBLIC_SEED, _ANOTHER_SEED)):
        problem = "earns all points; add a call that catches it, for every seed, to a case with points"
        yield f"{exercise.id}: the mistake {mistake.name!r} {problem}"


def _seed_problem(exercise, case, solution, seeds):
    """Points need an answer that looks at its arguments: what it must return changes with the key's seed."""
    calls = [exercise.arguments(case, seed) for seed in seeds]
    if not exercise.kind.has_inputs(calls[0]):
        return ""  # what __init__ makes has no inputs, and the task says what it is
    arguments = [sorted(str([canonical(value) for value in call]) for call in drawn) for drawn in calls]
    if all(drawn == arguments[0] for drawn in arguments):
        return "inputs(rng) ignores rng, so its answer can be copied; draw the inputs from it"
    answers = [[_in_time(exercise, exercise.call(solution, call)).value for call in drawn] for drawn in calls]

    def agree(answer, guess):  # they have the same types, and mostly differ at once
        if not case.tolerance:
            return answer == guess
        return compare(answer, guess, case.tolerance, exact_type=exercise.exact_type) is None

    for constant in [answer for drawn in answers for answer in drawn]:
        if _passes_by_chance([constant], answers, agree):
            advice = "add a call whose answer differs"
            return f"a constant passes it with several seeds, {describe(constant)}; {advice}"
    if any(_passes_by_chance(drawn, answers, agree) for drawn in answers):
        advice = "add a call that draws its answer from more values"
        return f"an answer that only counts its calls passes it with several seeds; {advice}"
    return ""


def _passes_by_chance(guesses, answers, agree):
    """Whether these answers, call by call and then again, are right with more seeds than chance explains."""
    return sum(all(map(agree, drawn, cycle(guesses))) for drawn in answers) > _MOST_BY_CHANCE


def _size_problem(exercise, case, solution):
    """Grading carries large arrays as digests, and a tolerance has no meaning for a digest."""
    for arguments in exercise.arguments(case):
        answer = array_of(_in_time(exercise, exercise.call(solution, arguments)).value)
        if answer is None or answer.nbytes <= _MOST_BYTES:
            continue
        if case.tolerance or answer.dtype.kind == "f":
            advice = f"draw a smaller input, up to {_MOST_BYTES} bytes of answer"
            return f"grading cannot compare an answer of {answer.nbytes} bytes with a tolerance; {advice}"
    return ""
