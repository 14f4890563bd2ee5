"""From nbval's verdicts to what is told: results that JSON holds, the same each time.

No time, no path, no seed and no process number stands in them.
"""

import ast
import builtins
import re
from dataclasses import dataclass, field
from functools import lru_cache

from imgproc_course.autograder.answer_key import known_mistake
from imgproc_course.autograder.reference import failing_call, read_answer
from imgproc_course.autograder.sandbox.fork_server_client import CellRun

_ANSI = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
# What IPython and ipykernel name a cell, with a number that varies.
_CELL = re.compile(r"<ipython-input-[^>\s]*>|\S*/ipykernel_\d+/\d+\.py|\b\d{5,}\.py\b")
_MEMORY = ("MemoryError", "_ArrayMemoryError")
_LONGEST = 500
_EXCEPTIONS = frozenset(name for name, kind in vars(builtins).items() if isinstance(kind, type))


@dataclass
class CaseRun:
    """One case in its kernel: how the answer's cell ended, and the check cell, if it came to that."""

    answer: CellRun = field(default_factory=CellRun)
    check: CellRun = field(default_factory=CellRun)

    @property
    def ended(self):
        return self.answer.ended or self.check.ended


def plain(text, longest=_LONGEST):
    """Text of a learner's, shortened, without what a terminal or a reader's eye takes for orders.

    Escape sequences and addresses go; control characters, surrogates and marks that turn the direction of
    writing around become visible escapes. HTML is escaped where HTML is written.
    """
    text = _CELL.sub("its cell", _ADDRESS.sub("0x…", _ANSI.sub("", text)))
    text = text if len(text) <= longest else text[: longest - 1] + "…"
    return "".join(each if each in "\n\t" or each.isprintable() else f"\\u{ord(each):04x}" for each in text)


def is_stub(source, stub):
    """Whether an answer is the stub, comments and blank lines aside."""
    if source.strip() == stub.strip():
        return True
    try:
        return ast.dump(ast.parse(source)) == _without_comments(stub)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False


@lru_cache(maxsize=64)
def _without_comments(stub):
    return ast.dump(ast.parse(stub))


def submission_result(job, lesson, results):
    """One submission, whole."""
    return {
        "submission": job["submission"],
        "lesson": lesson.name,
        "version": lesson.version,
        "points": sum(each["points"] for each in results),
        "got": sum(each["got"] for each in results),
        "exercises": results,
    }


def refused_result(exercise, outcome, said):
    """An exercise that was not run."""
    cases = [_case(case, outcome, 0) for case in exercise.cases]
    return _exercise(exercise, cases, said)


def exercise_result(exercise, content, work):
    """An exercise that was run, as nbval judged it."""
    done = {case.id: _calls(work.runs.get(case.id)) for case in exercise.cases}
    cases = [_judged(exercise, content, work, case, done[case.id]) for case in exercise.cases]
    wrong = any(case["outcome"] != "passed" for case in cases)
    mistake = known_mistake(exercise, content, done) if wrong else None
    return _exercise(exercise, cases, _said_of_answer(work, exercise), mistake)


def _exercise(exercise, cases, said, mistake=None):
    return {
        "id": exercise.id,
        "title": exercise.title,
        "points": exercise.points,
        "got": sum(case["got"] for case in cases),
        "mistake": mistake.name if mistake else "",
        "mistake_says": mistake.says if mistake else "",
        "said": said,
        "cases": cases,
    }


def _case(case, outcome, got, said="", **more):
    return {
        "id": case.id,
        "title": case.title,
        "hidden": case.hidden,
        "points": case.points,
        "got": got,
        "outcome": outcome,
        "hint": case.hint if outcome != "passed" else "",
        "said": said,
    } | more


def _calls(run):
    """What the calls of a case did, or None where its cell did not show exactly one well-formed answer."""
    if run is None or run.ended or len(run.check.answers) != 1:
        return None
    read = read_answer(run.check.answers[0])
    return read and read[0]


def _judged(exercise, content, work, case, calls):
    run = work.runs.get(case.id) or CaseRun()
    passed = case.id in work.passed
    failing = None if calls is None else failing_call(content.expected[case.id], calls, case.tolerance)
    outcome, said = ("passed", "") if passed else _outcome(exercise, run, calls, failing)
    if case.hidden:
        said = _said_of_hidden(outcome, said)
        return _case(case, outcome, case.points if passed else 0, said)
    shown = {} if passed else _shown(content, case, calls, failing)
    return _case(case, outcome, case.points if passed else 0, said, **shown)


def _outcome(exercise, run, calls, failing):
    """The word for what went wrong, and what is said of it."""
    if run.ended:
        word = "crashed" if run.ended == "gone" else run.ended
        return word, _ENDINGS[word]
    if run.check.error[0] == "NameError" and not run.check.answers:
        return _no_function(exercise, run)
    if not run.check.answers:
        return "raised", _raised(*run.check.error)
    if calls is None or run.check.error[0]:
        return "hostile", "its check cell showed something else than what the function returned"
    refused = read_answer(run.check.answers[0])[1]
    if refused:
        return "refused module", f"it uses {plain(', '.join(refused))}, which this exercise refuses"
    return _outcome_of_calls(exercise, calls, failing)


def _outcome_of_calls(exercise, calls, failing):
    if failing is None:
        return "not judged", "its values are right, but nbval did not say so: look at it by hand"
    if failing[0] >= len(calls):
        return "hostile", "its check cell told of other calls than were made"
    number, difference = failing
    call = calls[number]
    if call.get("timed_out"):
        return "time", f"{exercise.function}() used more than {exercise.time_limit:g} s of processor time"
    if call.get("error") == "NotImplementedError":
        return "not attempted", ""
    if call.get("error") == "RefusedModule":
        return "refused module", plain(call["message"])
    if call.get("error"):
        word = "memory" if call["error"] in _MEMORY else "raised"
        where = f" ({plain(call['line'])})" if call["line"] else ""
        return word, _raised(call["error"], call["message"]) + where
    if call["changed"]:
        return "wrong", f"it changed its input {plain(', '.join(call['changed']), 100)}"
    where = f"in answer{difference.path}: " if difference.path else ""
    return "wrong", plain(f"{where}{difference.message}")


def _no_function(exercise, run):
    name, text = run.answer.error
    if name == "RefusedModule":
        return "refused module", plain(text)
    if name:
        return "raised", f"its cell does not run: {_raised(name, text)}"
    return "missing", f"its cell does not define {exercise.function}()"


def _raised(name, text):
    return plain(f"{name}: {text}" if text else name)


def _said_of_answer(work, exercise):
    """What is to be said of the answer's cell itself: it costs nothing as long as the function is there."""
    run = next(iter(work.runs.values()), CaseRun())
    return f"its cell ended with {_raised(*run.answer.error)}" if run.answer.error[0] else ""


def _said_of_hidden(outcome, said):
    """Of a hidden case no text of the learner's: an exception could carry the input out."""
    if outcome in ("raised", "memory") and said != _ENDINGS.get(outcome):
        name = said.partition(":")[0]
        return name if name in _EXCEPTIONS else "an exception"
    return said if outcome in _ENDINGS or outcome == "missing" else ""


def _shown(content, case, calls, failing):
    """For a report of a public case: what was given, what was expected, what came back."""
    number = failing[0] if failing else 0
    number = min(number, len(content.expected[case.id]) - 1)
    call = calls[number] if calls and number < len(calls) else {}
    return {
        "call": number,
        "given": content.inputs_shown(case.id, number),
        "expected": content.expected[case.id][number],
        "actual": call.get("value"),
        "printed": plain(call.get("printed", ""), 2000),
    }


_ENDINGS = {
    "time": "it did not come to its end in time",
    "memory": "it used more memory than there is for an answer",
    "output": "it gave out more than is read",
    "crashed": "it ended its process",
    "hostile": "what it sent is no message of a notebook's kernel",
}
