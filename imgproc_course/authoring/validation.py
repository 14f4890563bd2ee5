"""Prove an exercise before anybody is graded by it."""

from imgproc_course.exercises.canonical import VALUE_BYTES, array_of, canonical
from imgproc_course.exercises.checking import run_cases
from imgproc_course.exercises.running import call

_ANOTHER_SEED = 1  # a teacher's key draws other inputs than the lesson does


def prove(declared):
    """What is wrong with an exercise: the right answer must pass, the stub and each mistake be known.

    Parameters
    ----------
    declared : Exercise

    Returns
    -------
    list of str, empty for an exercise that grades justly

    Raises
    ------
    MasterError : the solution or a case fails outright
    """
    solution = declared.function_of(declared.solution, "solution")
    right = run_cases(declared, solution, cases=declared.cases)
    elsewhere = run_cases(declared, solution, cases=declared.cases, seed=_ANOTHER_SEED)
    problems = [
        f"{result.case.id}: the solution does not pass it a second time; does it draw by chance?"
        for result in (*right.results, *elsewhere.results)
        if not result.passed
    ]
    problems += [
        f"{declared.id}: the solution uses {module}, which the exercise refuses"
        for module in right.reach.refused
    ]
    if not _is_empty(declared):
        problems.append(f'{declared.id}: the stub answers; let it raise NotImplementedError("your turn")')
    for mistake in declared.mistakes:
        problems += _problems_of(declared, mistake)
    for result in right.results:
        problems += _too_large(declared, result.case)
    return problems


def _problems_of(declared, mistake):
    found = run_cases(
        declared, declared.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)
    )
    if all(result.passed for result in found.results):
        yield f"{declared.id}: the mistake {mistake.name!r} passes every public case; add one that catches it"
    elif found.mistake != mistake:
        taken_for = f"is taken for {found.mistake.name!r}" if found.mistake else "is not known again"
        yield f"{declared.id}: the mistake {mistake.name!r} {taken_for}; add a public case that parts them"


def _is_empty(declared):
    """Whether the stub gives nothing: a learner who adds a docstring to it has still not attempted it."""
    stub = declared.function_of(declared.stub, "stub")
    arguments = declared.arguments(declared.cases[0])[0]
    outcome = call(stub, arguments, [str(k) for k in range(len(arguments))], declared.time_limit)
    return outcome.error == "NotImplementedError" or outcome.value == {"type": "None"}


def _too_large(declared, case):
    """Grading carries large arrays as digests, in which a tolerance has no meaning."""
    solution = declared.function_of(declared.solution, "solution")
    for arguments in declared.arguments(case):
        answer = array_of(canonical(solution(*arguments), limit=None))
        if (
            answer is not None
            and answer.nbytes > VALUE_BYTES
            and (answer.dtype.kind == "f" or case.tolerance)
        ):
            yield (
                f"{case.id}: an answer of {answer.nbytes} bytes cannot be compared with a tolerance"
                f" in grading; draw a smaller input, up to {VALUE_BYTES} bytes of answer"
            )
            return
