"""How a test case can end, and the texts that belong to each outcome: the only such table."""

from dataclasses import dataclass
from enum import StrEnum

from .. import course


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


@dataclass(frozen=True)
class OutcomeTexts:
    """The texts of one outcome."""

    label: str  # a few words beside the case's title on a page
    message: str = ""  # the case's, if the kernel was ended like this; "" if it depends on the answer
    # For the learner, if every case of an exercise ended so: no input is the cause, and no case's hint helps.
    advice: str = ""


# Of the cases that are not run because those before them took too long.
BUDGET_MESSAGE = "it was not run: the checks before it took too much time"
# How the message of a case begins whose function is not there, because its cell raised an exception.
CELL_FAILS = "its cell does not run"
TEXTS = {
    Outcome.PASSED: OutcomeTexts("passed"),
    Outcome.WRONG: OutcomeTexts("returns another value"),
    Outcome.RAISED: OutcomeTexts("raised an exception"),
    Outcome.NOT_ATTEMPTED: OutcomeTexts(
        "not attempted",
        advice="You have not started this exercise yet, and that is fine. Begin with the example in the"
        " lesson, and run its check as often as you like.",
    ),
    Outcome.MISSING: OutcomeTexts(
        "the answer is missing",
        advice="No cell of the notebook defines a function or class of this name, with a def or class that"
        " begins at the left edge. Write it into its answer cell (a fresh copy of the lesson has one), and"
        f" run `{course.command} check` on the notebook before you submit it.",
    ),
    Outcome.REFUSED_MODULE: OutcomeTexts(
        "uses a module that this exercise does not allow",
        advice="The task is to write it by hand, without the modules that do it for you. If the module is a"
        " file of your own, copy its functions into a cell of the notebook: only the notebook is graded.",
    ),
    Outcome.TIME: OutcomeTexts(
        "did not finish in time",
        message="it did not finish in time",
        advice="It does not finish in time, whatever its input is. Is there a loop whose condition stays"
        " true, or a loop that visits every pixel again for each pixel?",
    ),
    Outcome.MEMORY: OutcomeTexts(
        "needed too much memory",
        message="it used more memory than an answer may use",
        advice="It needs too much memory, whatever its input is. What grows with every turn of a loop?",
    ),
    Outcome.OUTPUT: OutcomeTexts(
        "printed too much",
        message="it printed more than the autograder reads",
        advice="Remove the print calls from your answer.",
    ),
    Outcome.CRASHED: OutcomeTexts(
        "ended the Python process",
        message="it ended its process",
        advice="Nothing in your answer may end Python: no exit(), no quit(), no os._exit().",
    ),
    Outcome.HOSTILE: OutcomeTexts(
        "sent something that no answer sends",
        message="it sent something that is not a message of a notebook's kernel",
    ),
    Outcome.OPEN: OutcomeTexts("your teacher has not graded it yet"),
    Outcome.NOT_GRADED: OutcomeTexts("could not be graded; your teacher will look at it"),
}
