"""Which answers are not run at all: missing, too long, or still the stub."""

import ast
from functools import lru_cache

from imgproc_course.classroom.autograder.outcomes import Outcome

MAX_ANSWER = 200_000  # characters


def reason_not_to_run(exercise, source):
    """Why an answer is not run, as (Outcome, message); None if it has to run. Its source may be missing."""
    if not isinstance(source, str):
        return Outcome.MISSING, "its answer cell is missing"
    if len(source) > MAX_ANSWER:
        return (
            Outcome.HOSTILE,
            f"its answer is {len(source)} characters long; at most {MAX_ANSWER} are graded",
        )
    if is_stub(source, exercise.stub):
        return Outcome.NOT_ATTEMPTED, ""
    return None


def is_stub(source, stub):
    """Whether an answer is the stub; comments and blank lines do not count."""
    if source.strip() == stub.strip():
        return True
    try:
        return ast.dump(ast.parse(source)) == _syntax_tree(stub)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False


@lru_cache(maxsize=64)
def _syntax_tree(stub):
    return ast.dump(ast.parse(stub))
