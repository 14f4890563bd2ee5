"""One call of a case: judged, and explained."""

from dataclasses import dataclass
from typing import Any

from .comparison import Difference
from .running import CallResult


@dataclass(frozen=True)
class CaseCall:
    """One call of a case: what was expected, what the answer did; of a drive the `drive.Drive.record`."""

    case: Any
    arguments: tuple
    expected: CallResult
    result: CallResult
    difference: Difference | None
    record: dict | None = None

    @property
    def passed(self) -> bool:
        return self.result.finished and not self.result.changed and self.difference is None


def explain_call(result, difference, name):
    """What went wrong in one call of an answer of this name, in a sentence or two; "" if nothing did."""
    if result.timed_out:
        text = f"{name} did not finish in time and was stopped."
        return text + " It could not be stopped: restart the kernel before you go on." * result.stuck
    if result.error:
        text = f"{name} raised {result.error}" + (f": {result.message}" if result.message else "")
        return text + (f"\nin your {result.line}" if result.line else "")
    if result.changed:
        argument = result.changed[0]
        text = f"{name} changed its input {argument}."
        if not argument.isidentifier():
            return f"{text} Only read it, and store what you compute under new names."
        advice = f"write the result into a new array, or begin with {argument} = {argument}.copy()."
        return f"{text} Leave the input as it is: {advice}"
    if difference is None:
        return ""
    if result.value["type"] == "None" and result.printed:
        return f"{name} returned None. print only shows a value: write return in place of print."
    message = difference.message[0].upper() + difference.message[1:] + "."
    return f"In answer{difference.path}: {message}" if difference.path else message
