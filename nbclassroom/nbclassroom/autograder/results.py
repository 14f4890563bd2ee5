"""Results of grading: one GradedSubmission per submission, and its JSON form.

A result depends on the answers and the key alone: not on the order of the submissions, the number of workers,
the time of day or other submissions. It contains no time, no path, no seed and no process number.

Texts are sanitized (no control characters) but not escaped for HTML, except in `body` and `review`, which are
HTML: what the notebook's `check` would show.
"""

import builtins
import hashlib
import json
import re
from dataclasses import dataclass, replace
from itertools import chain

import msgspec

from ..exercises.kinds.node.recording_node import UNKNOWN_PART
from ..exercises.running import Verdict, attempt
from .outcomes import BUDGET_MESSAGE, CELL_FAILS, PHRASES, Outcome
from .sanitize import reproducible_text
from .shown_answer import checked_answers, rendered_text
from .verdict import CaseRun

_MISSING = re.compile(
    r"name '(\w+)' is not def|(\w+) is not there, because|write this exercise without (\w+)"
)
_SYNTAX_PLACE = re.compile(r" ?\(<cell[ \d]*>, line (\d+)\)$")
NO_DETAILS = "<p>The details of these checks could not be shown.</p>"
# Errors whose messages are sentences of ours; their names are those of our classes, see `running.error_name`.
_OUTCOMES_OF_ERRORS = {
    "RefusedModule": Outcome.REFUSED_MODULE,
    "NotGradedError": Outcome.NOT_GRADED,
    "NodeError": Outcome.RAISED,
}
_EXCEPTIONS = {CELL_FAILS} | {name for name, kind in vars(builtins).items() if isinstance(kind, type)}


@dataclass(frozen=True)
class GradedCase:
    id: str
    title: str
    hidden: bool
    points: int
    max_points: int
    outcome: Outcome
    message: str = ""  # what went wrong, shortened; for a hidden case it contains no text of the learner's

    @property
    def passed(self):
        return self.outcome == Outcome.PASSED


@dataclass(frozen=True)
class GradedExercise:
    id: str
    title: str
    max_points: int
    cases: tuple[GradedCase, ...]  # public ones first
    mistake: str = ""  # name of the known mistake that this answer makes
    mistake_explanation: str = ""  # what the learner is told about it
    # About the answer cell itself: its first exception (which costs nothing as long as the function is
    # defined), why it was not run, or which other cell lets it fail.
    message: str = ""
    cause: str = ""  # id of the exercise, perhaps this one, that tells which other cell lets it fail
    body: str = ""  # the checks as HTML, for the learner
    review: str = ""  # and for the teacher, with the values of hidden ones
    rubric: tuple[tuple[str, int], ...] = ()  # (what to look for, points), where a person grades
    mark: str = ""  # of the answer and the texts of the rubric: a person's decision is on these

    @property
    def points(self):
        return sum(case.points for case in self.cases)


@dataclass(frozen=True)
class GradedSubmission:
    name: str  # that `autograde` was given for it
    lesson: str
    exercises: tuple[GradedExercise, ...]  # in the lesson's order; practice exercises are not graded
    # (exercise id or "", what its code tried, and the sandbox refused)
    tried: tuple[tuple[str, str], ...] = ()

    @property
    def points(self):
        return sum(exercise.points for exercise in self.exercises)

    @property
    def has_fault(self):
        """Whether an exercise was not graded, and not because its node uses what the check does not know."""
        messages = ((one.id, case.message) for one in self.exercises for case in one.cases)
        with_unknown = {id for id, message in messages if message.startswith(UNKNOWN_PART)}
        return bool(self.exercises_with(Outcome.NOT_GRADED) - with_unknown)

    def exercises_with(self, outcome):
        """The ids of the exercises of which at least one case has that outcome."""
        return {one.id for one in self.exercises if any(case.outcome == outcome for case in one.cases)}


def to_json(result):
    """A GradedSubmission, or a part of one, as data for json.dumps."""
    return json.loads(json.dumps(msgspec.to_builtins(result)))  # to_builtins keeps tuples


def from_json(data):
    """The GradedSubmission that `to_json` wrote; ValueError if it did not."""
    result = msgspec.convert(data, GradedSubmission)
    if to_json(result) != data:  # msgspec ignores unknown names
        raise ValueError("this is no result of grading")
    return result


def ungraded_exercise(exercise, outcome, message):
    """The GradedExercise of an exercise that was not run: the outcome of all its cases, and why."""
    cases = tuple(_graded_case(case, outcome) for case in exercise.cases)
    return _with_pages(*_checked(exercise, cases, {}, message))


def open_exercise(exercise, source, figure=""):
    """The GradedExercise of an answer that a person grades: a text, or the HTML of a figure."""
    cases = tuple(_graded_case(case, Outcome.OPEN) for case in exercise.cases)
    about = repr([source, [text for text, _ in exercise.rubric]])
    return GradedExercise(
        *(exercise.id, exercise.title, exercise.points, cases),
        **dict.fromkeys(("body", "review"), figure or attempt(lambda: rendered_text(source), NO_DETAILS, 10)),
        rubric=exercise.rubric,
        mark=hashlib.sha256(about.encode("utf-8", "surrogatepass")).hexdigest()[:8],
    )


def graded_exercises(exercise_runs, page, tried):
    """{id: GradedExercise} of {id: ExerciseRun} of one page, whose cases all have run."""
    causes = _causes(exercise_runs, page)
    hostile = {id for id, _ in tried}
    return {
        id: _with_pages(*checked_exercise(run, causes.get(id, ("", "")), is_hostile=bool(hostile & {id, ""})))
        for id, run in exercise_runs.items()
    }


def checked_exercise(exercise_run, cause=("", ""), *, is_hostile=False):
    """(the GradedExercise of an exercise whose cases all have run, without pages, its CheckedAnswers).

    A cause, see `_causes`, replaces the calls. A hostile answer gets no advice about its loops.
    """
    exercise, runs, (why, told_by) = exercise_run.exercise, exercise_run.runs, cause
    cases = tuple(_case_of_run(exercise, case, exercise_run) for case in exercise.cases)
    if why:
        return _checked(exercise, cases, {}, reproducible_text(why), cause=told_by, advises=False)
    mistake = None if all(case.passed for case in cases) else _known_mistake(exercise, runs)
    advises = not (is_hostile and cases[0].outcome in (Outcome.TIME, Outcome.MEMORY))
    error = next(iter(runs.values()), CaseRun()).answer.error  # it costs nothing if the function is defined
    text = f"a statement in its cell fails: {_exception_text(*error)}" if error[0] else ""
    return _checked(exercise, cases, runs, text, mistake, cause=told_by, advises=advises)


def _checked(exercise, cases, runs, message, mistake=None, *, cause="", advises=True):
    name, says = (mistake.name, mistake.says) if mistake else ("", "")
    graded = GradedExercise(exercise.id, exercise.title, exercise.points, cases, name, says, message, cause)
    return graded, checked_answers(exercise, cases, runs, mistake, message, advises=advises)


def _with_pages(graded, answers):
    body, review = (attempt(answer.html, NO_DETAILS, 10) for answer in answers)
    return replace(graded, body=body, review=review)


def _known_mistake(exercise, runs):
    """The declared mistake that explains the public cases, as in `check`, or else all cases; or None.

    `check` knows the answer's source, and leaves out a mistake whose advice the answer follows already.
    """
    calls = {id: run.verdict.calls for id, run in runs.items()}
    for cases in (exercise.public, exercise.cases):
        own = [calls.get(case.id, ()) for case in cases]
        mistake = all(own) and exercise.kind.known_mistake(exercise, [*chain(*own)])
        if mistake:
            return mistake
    return None


def _graded_case(case, outcome, message=""):
    points = case.points if outcome == Outcome.PASSED else 0
    return GradedCase(case.id, case.title, case.hidden, points, case.points, outcome, message)


def _case_of_run(exercise, case, exercise_run):
    if case.id not in exercise_run.runs:  # the autograder itself failed to run it
        # An exception of ours may quote what the function returned: of a hidden case only its name is told.
        fault = exercise_run.faults[case.id]
        fault = fault.partition(":")[0] if case.hidden else fault
        return _graded_case(case, Outcome.NOT_GRADED, reproducible_text(f"the autograder failed: {fault}"))
    run = exercise_run.runs[case.id]
    verdict, outcome, message = run.verdict, Outcome.PASSED, ""
    if not run.passed:
        outcome, message = _outcome_of_run(exercise, run)
        message = _message_of_hidden(outcome, message, verdict) if case.hidden else message
    if verdict.measured:
        message = f"{message.rstrip('.')} ({verdict.measured})" if message else verdict.measured
    return _graded_case(case, outcome, message)


def _outcome_of_run(exercise, run):
    """(Outcome, message) of a case that did not pass."""
    if run.ended == "budget":
        return Outcome.TIME, BUDGET_MESSAGE
    if run.ended:
        outcome = Outcome(run.ended)
        return outcome, _at(PHRASES[f"{outcome}: message"], run.verdict)
    error = run.check.error
    if error[0] and not run.check.answers:
        if error[0] == "NameError":
            return _outcome_without_function(exercise, run)
        return Outcome.RAISED, _exception_text(*error)
    if error[0]:
        return Outcome.HOSTILE, Verdict().forged
    return _outcome_of_verdict(exercise, run.verdict)


def _at(message, verdict):
    return f"{message}, {verdict.when}" if verdict.when else message


def _outcome_of_verdict(exercise, verdict):
    if verdict.passed:
        return Outcome.NOT_GRADED, "it is right, but nbval did not let it pass: look at it by hand"
    call = verdict.result
    if call.timed_out:
        text = f"{exercise.answer_name} used more than {exercise.time_limit:g} s of processor time"
        return Outcome.TIME, _at(call.message or text, verdict)
    if call.error:
        outcome, message = _outcome_of_exception(exercise, call)
        return outcome, _at(message, verdict) if outcome == Outcome.RAISED else message
    if verdict.forged:
        return Outcome.HOSTILE, reproducible_text(verdict.forged)
    failed = next(one for one in verdict.calls if not one.passed)
    return Outcome.WRONG, reproducible_text(exercise.kind.explain(exercise, failed)).replace("\n", " ")


def _outcome_of_exception(exercise, call):
    if call.error == "NotImplementedError":
        return Outcome.NOT_ATTEMPTED, ""
    if outcome := _outcome_of_error(exercise, call.error):
        return outcome, reproducible_text(call.message)
    line = f" ({reproducible_text(call.line)})" if call.line else ""
    outcome = Outcome.MEMORY if call.error in ("MemoryError", "_ArrayMemoryError") else Outcome.RAISED
    return outcome, _exception_text(call.error, call.message) + line


def _outcome_of_error(exercise, name):
    """The Outcome of an error of ours, or None; only some kinds can meet what they do not know."""
    outcome = _OUTCOMES_OF_ERRORS.get(name)
    return outcome if outcome != Outcome.NOT_GRADED or exercise.kind.refuses_parts else None


def _outcome_without_function(exercise, run):
    name, text = run.answer.error
    if outcome := _outcome_of_error(exercise, name):
        return outcome, reproducible_text(text)
    if name:
        return Outcome.RAISED, f"{CELL_FAILS}: {_exception_text(name, text)}"
    return Outcome.MISSING, f"its cell does not define {exercise.answer_name}"


def _message_of_hidden(outcome, message, verdict):
    """The message without any text of the learner's: an exception could carry the hidden input out."""
    if outcome in (Outcome.WRONG, Outcome.HOSTILE) and verdict.told_of_hidden:
        return verdict.told_of_hidden
    usual_message = PHRASES.get(f"{outcome}: message", "")
    if outcome == Outcome.RAISED or (outcome == Outcome.MEMORY and message != usual_message):
        name = message.partition(":")[0]
        return name if name in _EXCEPTIONS else "an exception"
    return message if usual_message or outcome == Outcome.MISSING else ""


def _exception_text(name, text):
    return reproducible_text(f"{name}: {text}" if text else name)


def _causes(exercise_runs, page):
    """{exercise id: its cause} of the exercises that a cell which is not their answer lets fail.

    A cause is (a sentence, "" if the checks say it; the id of the exercise that tells it: it is told once).
    """
    places: dict[str, tuple[int, str]] = {}
    for id, exercise_run in exercise_runs.items():
        missing = dict(map(missing_name, exercise_run.runs.values()))
        name, text = missing.popitem() if len(missing) == 1 else ("", "")
        place = _place_of(name, text, id, page, exercise_run.runs) if name else None
        places |= {id: place} if place else {}
    failed = {id for id, one in exercise_runs.items() if not all(run.passed for run in one.runs.values())}
    causes = {}
    for id, (number, text) in places.items():
        owner = page["cells"][number]["exercise"]
        first = owner if owner in failed else next(one for one in places if places[one][0] == number)
        same = f'It fails for the same reason as "{exercise_runs[first].exercise.title}": mend that first'
        causes[id] = same if first != id else text, first
    return causes


def missing_name(run):
    """(the name that a call or the check cell of a CaseRun misses, "" if none, the error's text)."""
    ends = [run.answer.error, run.check.error] if run.check.error[0] else []
    ends += [(one.result.error, one.result.message) for one in run.verdict.calls if not one.record]
    text = next((text for error, text in ends if error in ("NameError", "RefusedModule")), "")
    match = _MISSING.match(text)
    return next(filter(None, match.groups())) if match else "", text


def _place_of(name, text, id, page, runs):
    """(the cell that fails and should make a name, or has it first, a sentence); None if it is the answer."""
    cells = page["cells"]
    errors = {number: error for number, *error in next(iter(runs.values())).answer.errors}
    numbers = [number for number in errors if number < len(cells) and _binds(cells[number]["source"], name)]
    word = re.compile(rf"\b{name}\b")
    if not word.search(page["answers"][id]):
        numbers += [number for number, cell in enumerate(cells) if word.search(cell["source"])]
    if not numbers or cells[numbers[0]]["exercise"] == id:
        return None
    lines = cells[numbers[0]]["source"].splitlines()
    first_line = next(filter(None, map(str.strip, lines)))
    error, error_text = errors.get(numbers[0], ("", text))
    reason = _reason(error, error_text, lines)
    sentence = f'The cell that begins with "{first_line[:60]}" does not work, and this exercise needs it'
    return numbers[0], "" if text.startswith("write this") else f"{sentence} ({reason}). Mend it first"


def _binds(source, name):
    """Whether a line of a source, which may be no Python, makes a name."""
    definition = re.compile(rf"(?:async )?(?:def|class) +{name}\b|{name} *[=:,]")
    word, lines = re.compile(rf"\b{name}\b"), list(map(str.strip, source.splitlines()))
    imports = [line for line in lines if line.startswith(("import ", "from "))]
    return any(map(definition.match, lines)) or any(map(word.search, imports))


def _reason(error, text, lines):
    """The error of a statement as a text, with the line that is not Python."""
    if match := _SYNTAX_PLACE.search(text):
        line = "".join(lines[int(match[1]) - 1 :][:1])
        text = f"{text[: match.start()]}, line {match[1]}: {line.strip()}"
    return ": ".join(filter(None, (error, text)))
