"""Results of grading: one GradedSubmission per submission, and its JSON form.

A result depends on the answers and the key alone: not on the order of the submissions, the number of workers,
the time of day or other submissions. It contains no time, no path, no seed and no process number.

Texts are sanitized (no control characters) but not escaped for HTML: that is done where HTML is written.
"""

import base64
import builtins
import hashlib
import json
import re
from dataclasses import dataclass, is_dataclass, replace
from types import SimpleNamespace

import msgspec

from ..exercises.canonical import canonical
from ..exercises.drive import LOOK, LOOK_SECONDS, METRICS, metric_text, sentences_of
from ..exercises.node_feedback import sentence_on_node
from ..exercises.recording_node import UNKNOWN_PART
from ..exercises.running import NODES, CallResult
from .outcomes import BUDGET_MESSAGE, CELL_FAILS, TEXTS, Outcome
from .sanitize import sanitize_text
from .verdict import CaseRun, DriveVerdict

_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
# How IPython and ipykernel name a cell, with a number that differs from run to run.
_CELL = re.compile(r"<ipython-input-[^<>\s]*>|(?<!\S)\S*/ipykernel_\d+/\d+\.py|\b\d{5,}\.py\b")
_LARGEST_SHOWN = 1_500_000  # characters of a form: as much as the largest array with values
_MOST_READ = 4  # characters that are read of a text, for each one that is kept
_MEMORY_ERRORS = ("MemoryError", "_ArrayMemoryError")
# Errors whose messages are sentences of ours; their names are those of our classes, see `running.error_name`.
_OUTCOMES_OF_ERRORS = {
    "RefusedModule": Outcome.REFUSED_MODULE,
    "NotGradedError": Outcome.NOT_GRADED,
    "NodeError": Outcome.RAISED,
}
_EXCEPTIONS = {CELL_FAILS} | {name for name, kind in vars(builtins).items() if isinstance(kind, type)}


@dataclass(frozen=True)
class FailedCall:
    """The first call of a public case that failed; values are canonical forms."""

    arguments: list  # their names: `Exercise.names`
    expected: dict
    actual: dict | None  # None if nothing was returned
    printed: str  # shortened


@dataclass(frozen=True)
class GradedCase:
    """The result of one test case."""

    id: str
    title: str
    hidden: bool
    points: int
    max_points: int
    outcome: Outcome
    hint: str = ""  # the master's; "" if the case passed
    message: str = ""  # what went wrong, shortened; for a hidden case it contains no text of the learner's
    failed_call: FailedCall | None = None  # if it was run and failed; of a hidden one for teachers alone
    drive: dict | None = None  # of a drive that began: what `drive_images.draw_map` draws

    @property
    def passed(self):
        return self.outcome == Outcome.PASSED


@dataclass(frozen=True)
class GradedExercise:
    """The result of one graded exercise."""

    id: str
    title: str
    max_points: int
    cases: tuple[GradedCase, ...]  # public ones first
    mistake: str = ""  # name of the known mistake that this answer makes
    mistake_explanation: str = ""  # what the learner is told about it
    # About the answer cell itself: its first exception (which costs nothing as long as the function is
    # defined), or why it was not run.
    message: str = ""

    @property
    def points(self):
        return sum(case.points for case in self.cases)


@dataclass(frozen=True)
class GradedSubmission:
    """The result of one submission of one lesson."""

    name: str  # that `autograde` was given for it
    lesson: str
    exercises: tuple[GradedExercise, ...]  # in the lesson's order; practice exercises are not graded

    @property
    def points(self):
        return sum(exercise.points for exercise in self.exercises)

    @property
    def max_points(self):
        return sum(exercise.max_points for exercise in self.exercises)

    @property
    def has_fault(self):
        """Whether an exercise was not graded, and not because its node uses what the check does not know."""
        return any(
            any(case.outcome == Outcome.NOT_GRADED for case in exercise.cases)
            and not any(case.message.startswith(UNKNOWN_PART) for case in exercise.cases)
            for exercise in self.exercises
        )

    def exercises_with(self, outcome):
        """The ids of the exercises of which at least one case has that outcome."""
        return {one.id for one in self.exercises if any(case.outcome == outcome for case in one.cases)}


def to_json(result):
    """A GradedSubmission, or a part of one, as data for json.dumps."""
    # dataclasses.asdict would copy every value too, which takes much longer; msgspec keeps tuples.
    if isinstance(result, tuple):
        return [to_json(part) for part in result]
    if is_dataclass(result):
        return {name: to_json(value) for name, value in vars(result).items()}
    return result


def from_json(data):
    """The GradedSubmission that `to_json` wrote; ValueError if it did not."""
    result = msgspec.convert(data, GradedSubmission)
    if to_json(result) != data:  # msgspec ignores unknown names
        raise ValueError("this is no result of grading")
    return result


def ungraded_exercise(exercise, outcome, message):
    """The GradedExercise of an exercise that was not run: the outcome of all its cases, and why."""
    cases = tuple(_graded_case(case, outcome) for case in exercise.cases)
    return GradedExercise(exercise.id, exercise.title, exercise.points, cases, message=message)


def graded_exercise(exercise, exercise_run):
    """The GradedExercise of an exercise whose cases all have run."""
    runs = exercise_run.runs
    cases = tuple(
        _case_of_run(exercise, case, runs[case.id], case.id in exercise_run.passed)
        if case.id in runs
        else _faulty_case(case, exercise_run.faults[case.id])
        for case in exercise.cases
    )
    mistake = None
    if not all(case.passed for case in cases):
        mistake = (_mistake_in_drives if exercise.drives else _mistake_in_calls)(exercise, runs)
    known = (mistake.name, mistake.says) if mistake else ("", "")
    message = _message_about_cell(runs)
    return GradedExercise(exercise.id, exercise.title, exercise.points, cases, *known, message)


def _mistake_in_calls(exercise, runs):
    """The declared mistake (or None) that did, on every public call, exactly what the answer did.

    A mistake that agrees on the hidden calls too is preferred to one that does not. `check` has the same
    rule, so a lesson and a report name the same mistake.
    """
    calls = {id: run.verdict.calls for id, run in runs.items()}
    for cases in (exercise.cases, exercise.public):
        for mistake in exercise.mistakes:
            if all(_agree(calls.get(case.id) or (), mistake.results[case.id], case) for case in cases):
                return mistake
    return None


def _agree(calls, others, case):
    pairs = zip(calls, others, strict=False)
    return len(calls) == len(others) and all(call.matches(other, case.tolerance) for call, other in pairs)


def _mistake_in_drives(exercise, runs):
    """The declared mistake that drives as the answer does where it fails, by the rule of `check`."""
    from ..exercises.drive_check import form_of, known_mistake

    calls = [
        SimpleNamespace(case=case, passed=run.passed, record=run.verdict.record, result=result)
        for case in exercise.cases
        if isinstance((run := runs.get(case.id, CaseRun())).verdict, DriveVerdict)
        for result in [run.verdict.ending or CallResult(value=form_of(run.verdict.record))]
    ]
    return known_mistake(exercise, calls)


def _graded_case(case, outcome, message="", failed_call=None):
    points, hint = (case.points, "") if outcome == Outcome.PASSED else (0, case.hint)
    about = (case.id, case.title, case.hidden, points, case.points)
    return GradedCase(*about, outcome, hint, message, failed_call)


def _case_of_run(exercise, case, run, passed):
    if exercise.drives:
        return _case_of_drive(exercise, case, run, passed)
    if passed:
        return _graded_case(case, Outcome.PASSED)
    outcome, message = _outcome_of_run(exercise, run)
    failed_call = _failed_call(case, run.verdict)
    shown_call = failed_call if exercise.subject == "function" else None  # a node's record is no reading
    if case.hidden:
        message = _message_of_hidden(outcome, message)
    elif not shown_call:
        message = _message_on_node(case, run.verdict, failed_call) or message
    return _graded_case(case, outcome, message, shown_call)


def _case_of_drive(exercise, case, run, passed):
    """The GradedCase of a drive. Its metrics are the environment's: a hidden case has them, too."""
    verdict = run.verdict if isinstance(run.verdict, DriveVerdict) else None
    outcome, message = (Outcome.PASSED, "") if passed else _outcome_of_drive(exercise, run)
    if case.hidden and not passed:
        message = _message_of_hidden_drive(outcome, message, run)
    if verdict and verdict.is_whole:
        metrics = _metrics_text(verdict)
        message = f"{message.rstrip('.')} ({metrics})" if message else metrics
    return replace(_graded_case(case, outcome, message), drive=_drawn(verdict) if verdict else None)


def _outcome_of_drive(exercise, run):
    verdict = run.verdict
    if not isinstance(verdict, DriveVerdict):
        return _outcome_of_run(exercise, run)
    when = f"{verdict.record['looks'] * LOOK:.1f} s after the start"
    if run.ended or run.check.error[0]:
        outcome, message = _outcome_of_run(exercise, run)
        return outcome, f"{message}, {when}" if run.ended else message
    if verdict.ending and verdict.ending.timed_out:
        return Outcome.TIME, f"one look took more than {LOOK_SECONDS:g} s of processor time, {when}"
    if verdict.ending:
        outcome, message = _outcome_of_exception(exercise, verdict.ending)
        return outcome, f"{message}, {when}" if outcome == Outcome.RAISED else message
    if verdict.passed:
        return Outcome.NOT_GRADED, "its drive is right, but nbval did not let it pass: look at it by hand"
    sentences = " ".join(sentences_of(verdict.record, verdict.scenario))
    is_unfinished = not verdict.is_whole and not verdict.record["ended"]
    return Outcome.HOSTILE if is_unfinished else Outcome.WRONG, reproducible_text(sentences)


def _message_of_hidden_drive(outcome, message, run):
    """The message without any text of the learner's, such as a part of a value that was returned."""
    if outcome == Outcome.WRONG and run.verdict.record["ended"]:
        return "it returned something else than two numbers"
    return message if outcome in (Outcome.WRONG, Outcome.HOSTILE) else _message_of_hidden(outcome, message)


def _metrics_text(verdict):
    """The metrics that have a threshold, with their units."""
    metrics = verdict.record["metrics"]
    return ", ".join(
        f"{METRICS[name].title} {metric_text(name, metrics[name])}" for name in verdict.scenario["thresholds"]
    )


def _drawn(verdict):
    """What a map shows of a drive, as plain data; positions to a millimetre."""
    record, scenario = verdict.record, verdict.scenario
    path = [[round(number, 3) for number in place] for place in record["path"]]
    drawn = {"path": path, "bumps": record["bumps"], "decisive": record["decisive"]}
    return drawn | {name: scenario.get(name) for name in ("room", "goal", "ball")}


def _message_on_node(case, verdict, failed_call):
    """What a node does wrong, in a sentence; "" if it gave no record, or if there is no sentence."""
    if verdict.difference is None or failed_call.actual is None:
        return ""
    arguments = case.calls[verdict.failed_call].arguments
    return reproducible_text(sentence_on_node(failed_call.expected, failed_call.actual, arguments))


def _faulty_case(case, fault):
    """The GradedCase of a case that the autograder itself failed to run."""
    # An exception of ours may quote what the function returned: of a hidden case only its name is told.
    fault = fault.partition(":")[0] if case.hidden else fault
    return _graded_case(case, Outcome.NOT_GRADED, reproducible_text(f"the autograder failed: {fault}"))


def _outcome_of_run(exercise, run):
    """(Outcome, message) of a case that did not pass."""
    if run.ended == "budget":
        return Outcome.TIME, BUDGET_MESSAGE
    if run.ended:
        outcome = Outcome(run.ended)
        return outcome, TEXTS[outcome].message
    error = run.check.error
    if error[0] and not run.check.answers:
        if error[0] == "NameError":
            return _outcome_without_function(exercise, run)
        return Outcome.RAISED, _exception_text(*error)
    if error[0] or run.verdict.calls is None:
        return Outcome.HOSTILE, "its check cell showed something else than what the function returned"
    return _outcome_of_verdict(exercise, run.verdict)


def _outcome_of_verdict(exercise, verdict):
    if verdict.failed_call is None:
        return Outcome.NOT_GRADED, "its values are right, but nbval did not let it pass: look at it by hand"
    if verdict.failed_call >= len(verdict.calls):
        return Outcome.HOSTILE, "its check cell reported other calls than were made"
    call = verdict.calls[verdict.failed_call]
    if call.timed_out:
        limit = f"{exercise.time_limit:g} s of processor time"
        return Outcome.TIME, f"{exercise.answer_name} used more than {limit}"
    if call.error:
        return _outcome_of_exception(exercise, call)
    if call.changed:
        return Outcome.WRONG, f"it changed its input {reproducible_text(', '.join(call.changed), 100)}"
    place = f"in answer{verdict.difference.path}: " if verdict.difference.path else ""
    return Outcome.WRONG, reproducible_text(f"{place}{verdict.difference.message}")


def _outcome_of_exception(exercise, call):
    if call.error == "NotImplementedError":
        return Outcome.NOT_ATTEMPTED, ""
    if outcome := _outcome_of_error(exercise, call.error):
        return outcome, reproducible_text(call.message)
    line = f" ({reproducible_text(call.line)})" if call.line else ""
    outcome = Outcome.MEMORY if call.error in _MEMORY_ERRORS else Outcome.RAISED
    return outcome, _exception_text(call.error, call.message) + line


def _outcome_of_error(exercise, name):
    """The Outcome of an error of ours, or None; only the check of a node can meet what it does not know."""
    outcome = _OUTCOMES_OF_ERRORS.get(name)
    return outcome if outcome != Outcome.NOT_GRADED or exercise.subject in NODES else None


def _outcome_without_function(exercise, run):
    name, text = run.answer.error
    if outcome := _outcome_of_error(exercise, name):
        return outcome, reproducible_text(text)
    if name:
        return Outcome.RAISED, f"{CELL_FAILS}: {_exception_text(name, text)}"
    return Outcome.MISSING, f"its cell does not define {exercise.answer_name}"


def _message_about_cell(runs):
    """The first exception of the answer cell: it costs nothing as long as the function is defined."""
    error = next(iter(runs.values()), CaseRun()).answer.error
    return f"a statement in its cell fails: {_exception_text(*error)}" if error[0] else ""


def _message_of_hidden(outcome, message):
    """The message without any text of the learner's: an exception could carry the hidden input out."""
    if outcome == Outcome.RAISED or (outcome == Outcome.MEMORY and message != TEXTS[outcome].message):
        name = message.partition(":")[0]
        return name if name in _EXCEPTIONS else "an exception"
    return message if TEXTS[outcome].message or outcome == Outcome.MISSING else ""


def _failed_call(case, verdict):
    """The call to show for a public case: the one that failed, else the first one."""
    number = min(verdict.failed_call or 0, len(case.calls) - 1)
    expected, calls = case.calls[number], verdict.calls or []
    call = calls[number] if number < len(calls) else None
    return FailedCall(
        [canonical(value, limit=None) for value in expected.arguments],
        expected.result.value,
        form_to_show(call.value, expected.result.value) if call else None,
        reproducible_text(call.printed, 2000) if call else "",
    )


def form_to_show(form, expected):
    """A value as pages, which are in memory, show it: one much larger than expected has no values."""
    if form is None or _size(form) <= max(_LARGEST_SHOWN, 3 * _size(expected)):
        return form
    if form["type"] == "ndarray":
        digest = hashlib.sha256(base64.b64decode(form["data"])).hexdigest()
        return {name: form[name] for name in ("type", "dtype", "shape")} | {"digest": digest}
    kind = form["type"]
    return {"type": kind, "too_large" if kind in ("tuple", "list", "dict") else "opaque": True}


def _size(form):
    return len(json.dumps(form))


def _exception_text(name, text):
    return reproducible_text(f"{name}: {text}" if text else name)


def reproducible_text(text, max_length=500):
    """Sanitized text of a learner's without what differs from run to run: addresses and names of cells."""
    text = text[: _MOST_READ * max_length]
    return sanitize_text(_CELL.sub("its cell", _ADDRESS.sub("0x…", text)), max_length)
