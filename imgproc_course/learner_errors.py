"""An error in a learner's function that other code calls: the learner's lines, the error, what to do."""

import collections
import sysconfig
import traceback
from collections.abc import Callable
from pathlib import Path

# Each gets the error's type and message, and the learner's line, "line 3: return gray[row]" or ""; it returns
# what to do in a sentence, or "".
advisers: list[Callable[[str, str, str], str]] = []

CALLS = 5  # lines that are shown at most
_OTHER_PEOPLES = (Path(__file__).parent, Path(sysconfig.get_path("stdlib")))


def is_learners(filename):
    """Whether a file, or a cell of a notebook, is neither of a package nor of Python."""
    path = Path(filename)
    return (
        not filename.startswith("<frozen")
        and not {"site-packages", "dist-packages"} & {*path.parts}
        and not any(path.is_relative_to(folder) for folder in _OTHER_PEOPLES)
    )


def learners_calls(error):
    """The FrameSummary of each call on the way to the error that stands in the learner's code."""
    return [call for call in traceback.extract_tb(error.__traceback__) if is_learners(call.filename)]


def advice_on(error):
    """What to do about the error, or ""."""
    if isinstance(error, NameError) and not isinstance(error, UnboundLocalError):
        return f"Run the cell that imports or defines {error.name}."  # that cell was left out
    message = str(error)
    if "readonly" in message or "read-only" in message:
        return "The frame shares the message's memory: draw on frame.copy()."
    lines = [f"line {call.lineno}: {call.line}" for call in learners_calls(error)[-1:]]
    texts = (adviser(type(error).__name__, message, "".join(lines)) for adviser in advisers)
    return next(filter(None, texts), "")


def describe(error):
    """The learner's lines, the error and the advice, a line each; "" if no line is the learner's."""
    calls = [f"in {call.name}, line {call.lineno}:  {call.line}" for call in learners_calls(error)[-CALLS:]]
    name = "".join(traceback.format_exception_only(error)).strip()
    return "\n".join(filter(None, [*calls, name, advice_on(error)])) if calls else ""


def failed_line(error, own_file=None):
    """The learner's line that led to an error, if possible one in `own_file`, and what the error says."""
    calls = traceback.extract_tb(error.__traceback__)
    line = (learners_calls(error) or calls)[-1]
    line = next((call for call in reversed(calls) if call.filename == own_file), line)
    file = f" of {Path(line.filename).name}" if own_file is not None else ""
    text = traceback.format_exception_only(error)[-1].strip()
    return f"in line {line.lineno}{file} ({line.line}): {text}"


class RepeatedErrors:
    """Which causes were shown already, and how often each one came again."""

    def __init__(self):
        self._counts: collections.Counter = collections.Counter()

    def news(self, error, text):
        """The text at first; how often it came again at the 10th, 100th, … time after that; otherwise ""."""
        place = [(call.filename, call.lineno) for call in traceback.extract_tb(error.__traceback__)]
        cause = type(error), *place[-1:]
        again = self._counts[cause]
        self._counts[cause] += 1
        if not again:
            return text
        is_power = again >= 10 and str(again).strip("0") == "1"
        return f"again, {again} times: {type(error).__name__}: {error}" if is_power else ""
