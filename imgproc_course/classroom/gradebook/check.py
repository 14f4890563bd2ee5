"""`imgproc-course check`: inspect a lesson before it is submitted.

The notebook is read by the same reader as in `imgproc-course grade`, so that both find the same answers and
report the same findings. Here each answer can also be run against the public checks.
"""

import asyncio
import json
import os
import sys
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from ..authoring.lesson_names import notebook_name
from ..exercises import check_files
from ..exercises.check_data import CheckData
from ..exercises.checking import CheckResult, check_built
from ..exercises.error_advice import advice_on
from ..exercises.feedback import explain_failure
from .archives import LARGEST, too_large
from .notebook_reader import NotebookReader
from .submission import AnswerState, SubmissionContent, read_submission

_ADVICE = {
    AnswerState.MISSING: "Open the lesson afresh and copy your answer into this cell.",
    AnswerState.BROKEN: "Grading would give no points for it, or might grade the wrong cell.",
}


class LessonFileError(ValueError):
    """A file that is not a lesson of this course; the message says why and what to do."""


@dataclass
class ExerciseCheck:
    """One exercise of a checked lesson; `result` is of the public checks, None if they were not run."""

    exercise: CheckData
    state: AnswerState
    source: str
    notes: list = field(default_factory=list)
    result: CheckResult | None = None


@dataclass
class LessonCheck:
    """A checked lesson; `was_run`: its answers were run; `deeper` exercises can be left out."""

    path: Path
    content: SubmissionContent
    exercises: list
    was_run: bool = False
    deeper: frozenset = frozenset()

    @property
    def ready(self):
        """True if grading finds an answer to every graded exercise of the core."""
        core = (entry for entry in self.exercises if not entry.exercise.practice and entry not in self.open)
        return all(entry.state is AnswerState.ANSWERED for entry in core)

    @property
    def open(self):
        """The deeper exercises that were not attempted."""
        left = [entry for entry in self.exercises if entry.state is AnswerState.NOT_ATTEMPTED]
        return [entry for entry in left if entry.exercise.id in self.deeper]


class CheckFileCatalog:
    """The `lessons` {name: CheckFile} of some folders, the first of each; `damage` are CheckFileErrors."""

    def __init__(self, folders):
        self.lessons, self.damage = {}, []
        for path in (path for folder in folders for path in sorted(folder.glob("*.json"))):
            try:
                file = check_files.read_check_file(path)
            except check_files.CheckFileError as error:
                self.damage.append(error)
            else:
                self.lessons.setdefault(file.lesson, file)

    def functions(self, lesson):
        """{(id of an exercise, the function that it asks for)} of a lesson."""
        return {(id, entry.get("function", "")) for id, entry in self.lessons[lesson].entries.items()}

    def describe(self, lesson, _version):
        """The LessonDescription of a lesson, in the version that its checks were built with."""
        return self.lessons[lesson].description()


def check_lesson(path, folders=None):
    """Inspect a learner's notebook, without running anything in it; a LessonCheck.

    `folders` are those of checks, if not the one beside the notebook and the course's. LessonFileError: no
    such file, no notebook, or no lesson of this course; CheckFileError: its checks are missing or damaged.
    """
    path = Path(path)
    data = _read(path)
    if folders is None:
        folders = check_files.checks_folders(path.resolve().parent)
    catalog = CheckFileCatalog(folders)
    if not catalog.lessons and not catalog.damage:
        raise check_files.CheckFileError(check_files.NO_CHECKS)
    with NotebookReader() as reader:
        content = read_submission(data, catalog, reader, path.name)
    if content.reason and catalog.damage:
        raise catalog.damage[0]  # it may be the file of this lesson
    if content.reason:
        raise LessonFileError(f"{path}: {content.reason}")
    file = catalog.lessons[content.lesson]
    checks = [_exercise_check(file.exercise(id), content) for id in file.entries]
    return LessonCheck(path, content, checks, deeper=_deeper_exercises(data))


def _deeper_exercises(data):
    """Ids of the exercises that the notebook's metadata calls deeper."""
    try:
        return frozenset(json.loads(data)["metadata"]["imgproc_course"]["deeper"])
    except (KeyError, TypeError, ValueError):  # an older lesson, or another form that is read all the same
        return frozenset()


def _exercise_check(exercise, content):
    state = content.states[exercise.id]
    notes = content.texts_about(exercise.id)
    notes += [_ADVICE[state]] if state in _ADVICE else []
    return ExerciseCheck(exercise, state, content.answers.get(exercise.id, ""), notes)


def _read(path):
    if path.is_dir():
        lessons = sorted(path.glob("*.ipynb"))
        example = lessons[0] if lessons else "my_lessons/03_images_as_messages.ipynb"
        raise LessonFileError(f"{path} is a folder; give the lesson itself, such as {example}")
    if not path.is_file():
        raise LessonFileError(
            f"{path}: no such file; give the lesson that you want to submit, such as"
            " my_lessons/03_images_as_messages.ipynb"
        )
    if not notebook_name(path.name).endswith(".ipynb"):
        advice = "its name does not end in .ipynb; give the lesson's own file"
        raise LessonFileError(f"{path} is not a notebook: {advice}")
    if path.stat().st_size > LARGEST:
        raise LessonFileError(f"{path}: {too_large(path.stat().st_size, LARGEST)}")
    try:
        return path.read_bytes()
    except OSError as error:
        reason = f"it cannot be read ({error.strerror}); change its permissions"
        raise LessonFileError(f"{path}: {reason}") from error


def run_answers(lesson_check):
    """Run each answer against its public checks, in a namespace of its own as in grading; sets `result`."""
    lesson_check.was_run = True
    for entry in lesson_check.exercises:
        if entry.state is AnswerState.ANSWERED:
            with _end_is_named(entry.exercise.id):
                # As in JupyterLab and in grading, an event loop is running: asyncio.run() raises there.
                asyncio.run(_run_answer(entry))


@contextmanager
def _end_is_named(exercise):
    """An answer that calls os._exit() ends this program, too: with a line, and with exit code 1."""
    end, process = os._exit, os.getpid()

    def say_and_end(status):
        if os.getpid() == process:
            text = f"Error: {exercise}: the answer ends Python, and gets no points; leave out os._exit()"
            print(text, file=sys.__stderr__, flush=True)
            status = 1
        end(status)

    os._exit = say_and_end
    try:
        yield
    finally:
        os._exit = end


async def _run_answer(entry):
    names, error = entry.exercise.run_answer(entry.source)
    function = names.get(entry.exercise.function)
    if not entry.exercise.can_be_answer(function):
        entry.state = AnswerState.BROKEN
        reason = error or f"it defines no {entry.exercise.kind} {entry.exercise.answer_name}"
        entry.notes.append(f"its cell does not run by itself: {reason}")
        return
    entry.notes += [f"a statement in its cell fails: {error}"] if error else []
    result = check_built(entry.exercise, function, entry.source)
    if not result.attempted:
        entry.state = AnswerState.NOT_ATTEMPTED
        return
    entry.result = result
    # Refused modules come first: they may be the cause of the errors below.
    refused = result.dependencies.refused
    entry.notes += [f"it uses {name}, which this exercise does not allow" for name in refused]
    failed = [case for case in result.results if not case.passed]
    if failed:
        call = failed[0].failed_call
        explanation = explain_failure(entry.exercise, call)
        advice = advice_on(call.result.error, call.result.message, call.result.line)
        text = " ".join(filter(None, [explanation, advice]))
        count = f"{len(failed)} of {len(result.results)} checks fail"
        entry.notes.append(f"{count}: {failed[0].case.title}: {text}")


def report_lines(lesson_check):
    """The report of a LessonCheck, line by line for a terminal."""
    yield f"{lesson_check.path.name}: {lesson_check.content.lesson}"
    yield from (f"  note: {note}" for note in lesson_check.content.texts_about(""))
    for entry in lesson_check.exercises:
        kinds = {"practice": entry.exercise.practice, "deeper": entry.exercise.id in lesson_check.deeper}
        kind = ", ".join(name for name, holds in kinds.items() if holds)
        yield f"  {entry.exercise.id}{f' ({kind})' if kind else ''}: {_summary(entry)}"
        yield from (f"      {' '.join(note.split())}" for note in entry.notes)
    yield _verdict(lesson_check)
    if lesson_check.open:
        count = len(lesson_check.open)
        are_open = "exercises are open: they give" if count > 1 else "exercise is open: it gives"
        yield f"{count} deeper {are_open} points, too."


def _summary(entry):
    if entry.result is None:
        return str(entry.state)
    passed = sum(case.passed for case in entry.result.results)
    return f"{passed} of {len(entry.result.results)} checks pass"


def _verdict(lesson_check):
    if not lesson_check.ready:
        return "Not ready yet: see above."
    if any(entry.result is not None and not entry.result.passed for entry in lesson_check.exercises):
        return "Complete, but grading would not give every point yet: see above."
    if lesson_check.was_run:
        return "Ready to submit: every check passes."
    complete = "The core is complete" if lesson_check.open else "Complete"
    cells = f"every answer cell{' of it' * bool(lesson_check.open)}"
    run = f"`imgproc-course check --run {lesson_check.path}` runs them"
    return f"{complete}: {cells} is there and filled in. The answers were not run; {run}."
