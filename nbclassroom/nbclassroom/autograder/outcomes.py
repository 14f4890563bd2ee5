"""How a test case can end, and the texts that belong to each outcome: the only such table."""

from enum import StrEnum
from pathlib import Path

from .. import course
from ..exercises.error_advice import read_phrases


class Outcome(StrEnum):
    """How one test case of a submission ended. The values are what grades.json holds."""

    PASSED = "passed"
    WRONG = "wrong"  # another value was returned, or the input was changed
    RAISED = "raised"  # an exception, of the function or of the cell that should define it
    NOT_ATTEMPTED = "not attempted"  # the answer is still the stub, or it raises NotImplementedError
    MISSING = "missing"  # there is no answer cell, or it does not define the function
    REFUSED_MODULE = "refused module"
    TIME = "time"
    MEMORY = "memory"
    OUTPUT = "output"
    CRASHED = "crashed"  # the kernel's process ended
    HOSTILE = "hostile"  # the kernel sent something that our check cells cannot have shown
    OPEN = "open"  # a person grades it, and has not yet
    NOT_GRADED = "not graded"  # the autograder itself failed: a teacher must look


# Of the cases that are not run because those before them took too long.
BUDGET_MESSAGE = "it was not run: the checks before it took too much time"
# How the message of a case begins whose function is not there, because its cell raised an exception.
CELL_FAILS = "its cell does not run"
# The key of a text is an outcome, for its label beside a case's title; "<outcome>: message", for a case whose
# kernel was ended so; "<outcome>: advice", for the learner, if all cases of an exercise ended so: no input is
# the cause, and no case's hint helps. Of other advice it is what the advice is about.
PHRASES = {
    key: text.format(command=course.command)
    for key, text in read_phrases(Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")).items()
}
