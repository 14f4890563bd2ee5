"""The command `check`: inspect a lesson before it is submitted.

The notebook is read by the same reader as in the command `grade`, so that both find the same answers and
report the same findings. Here each answer can also be run against the public checks, in the same kernels.
"""

from dataclasses import dataclass, field
from pathlib import Path

from .. import course
from ..authoring.lesson_names import notebook_name
from ..autograder.nbval_plugin import ExerciseRun, PageKernels
from ..autograder.outcomes import Outcome
from ..autograder.results import GradedExercise, checked_exercise
from ..autograder.sandbox.fork_server_client import KernelFactory
from ..exercises import check_files
from ..exercises.canonical import encode
from ..exercises.lesson import Exercise
from .archives import LARGEST, too_large
from .submission import AnswerState, NotebookReader, Submission, read_submission

_ADVICE = {
    AnswerState.MISSING: "Open the lesson afresh and copy your answer into this cell.",
    AnswerState.BROKEN: "Grading would give no points for it, or might grade the wrong cell.",
}


@dataclass
class ExerciseCheck:
    """One exercise of a checked lesson; `result` is of the public checks, None if they were not run."""

    exercise: Exercise
    state: AnswerState
    notes: list = field(default_factory=list)
    result: GradedExercise | None = None


@dataclass
class LessonCheck:
    """A checked lesson; `was_run`: its answers were run."""

    path: Path
    content: Submission
    exercises: list
    was_run: bool = False

    @property
    def ready(self):
        """True if grading finds an answer to every graded exercise of the core."""
        core = (entry for entry in self.exercises if not entry.exercise.practice and entry not in self.open)
        return all(entry.state is AnswerState.ANSWERED for entry in core)

    @property
    def open(self):
        """The deeper exercises that were not attempted."""
        left = [entry for entry in self.exercises if entry.state is AnswerState.NOT_ATTEMPTED]
        return [entry for entry in left if entry.exercise.id in self.content.deeper]


def _read_checks(folders):
    """({name: [the first Lesson of that name]} of some folders, CheckFileErrors of damaged files)."""
    lessons: dict[str, list] = {}
    damage = []
    for path in (path for folder in folders for path in sorted(folder.glob("*.json"))):
        try:
            file = check_files.read_check_file(path)
            lessons.setdefault(file.name, [file])
        except check_files.CheckFileError as error:
            damage.append(error)
    return lessons, damage


def check_lesson(path, folders=None):
    """Inspect a learner's notebook, without running anything in it; a LessonCheck.

    `folders` are those of checks, if not the one beside the notebook and the course's. ValueError: no such
    file, no notebook, or no lesson of this course; CheckFileError: its checks are missing or damaged.
    """
    path = Path(path)
    data = _read(path)
    lessons, damage = _read_checks(folders or check_files.checks_folders(path.resolve().parent))
    if not lessons and not damage:
        raise check_files.CheckFileError(check_files.NO_CHECKS)
    with NotebookReader() as reader:
        content = read_submission(data, lessons, reader, path.name)
    if content.reason and damage:
        raise damage[0]  # it may be the file of this lesson
    if content.reason:
        raise ValueError(f"{path}: {content.reason}")
    checks = []
    for exercise in lessons[content.lesson][0].exercises:
        state = content.states[exercise.id]
        notes = content.texts_about(exercise.id) + ([_ADVICE[state]] if state in _ADVICE else [])
        checks.append(ExerciseCheck(exercise, state, notes))
    return LessonCheck(path, content, checks)


def _read(path):
    if not path.is_file() or not notebook_name(path.name).endswith(".ipynb"):
        problem = "is a folder" if path.is_dir() else "is no notebook" if path.exists() else "does not exist"
        example = "such as my_lessons/03_images_as_messages.ipynb"
        raise ValueError(f"{path} {problem}; give the lesson that you want to submit, {example}")
    if path.stat().st_size > LARGEST:
        raise ValueError(f"{path}: {too_large(path.stat().st_size, LARGEST)}")
    try:
        return path.read_bytes()
    except OSError as error:
        text = f"{path}: it cannot be read ({error.strerror}); change its permissions"
        raise ValueError(text) from error


def run_answers(lesson_check):
    """Run each answer against its public checks, as grading runs it, but without a sandbox; sets `result`."""
    lesson_check.was_run = True
    with KernelFactory(unsafe=True) as kernel_factory:
        kernels = PageKernels(lesson_check.content.page, kernel_factory)
        for entry in lesson_check.exercises:
            if entry.exercise.kind.graded_by_person:
                entry.notes.append("a person grades it")
            elif entry.state is AnswerState.ANSWERED:
                _run_answer(entry, kernels)
        kernels.close()


def _run_answer(entry, kernels):
    exercise = entry.exercise
    try:
        encode([call.arguments for case in exercise.cases for call in case.calls])
    except TypeError:  # an argument that is no data, such as an open recording
        entry.notes.append("it is not run here; its check in the lesson runs it")
        return
    exercise_run = ExerciseRun(exercise, kernels)
    for case in exercise.cases:
        exercise_run.run(case, exercise.kind.check_source(exercise))
    exercise_run.close()
    entry.result, (answer, _) = checked_exercise(exercise_run)
    entry.notes += [entry.result.message] if entry.result.message else []
    outcomes = {case.outcome for case in entry.result.cases}
    if outcomes == {Outcome.NOT_ATTEMPTED}:
        entry.state, entry.result = AnswerState.NOT_ATTEMPTED, None
    elif outcomes != {Outcome.PASSED}:
        entry.notes += answer.plain().splitlines()


def report_lines(lesson_check):
    """The report of a LessonCheck, line by line for a terminal."""
    yield f"{lesson_check.path.name}: {lesson_check.content.lesson}"
    yield from (f"  note: {note}" for note in lesson_check.content.texts_about(""))
    deeper = lesson_check.content.deeper
    for entry in lesson_check.exercises:
        kinds = {"practice": entry.exercise.practice, "deeper": entry.exercise.id in deeper}
        kind = ", ".join(name for name, holds in kinds.items() if holds)
        summary = str(entry.state)
        if entry.result is not None:
            passed = sum(case.passed for case in entry.result.cases)
            summary = f"{passed} of {len(entry.result.cases)} checks pass"
        yield f"  {entry.exercise.id}{f' ({kind})' if kind else ''}: {summary}"
        yield from (f"      {note}" for note in entry.notes)
    yield _verdict(lesson_check)
    if lesson_check.open:
        count = len(lesson_check.open)
        are_open = "exercises are open: they give" if count > 1 else "exercise is open: it gives"
        yield f"{count} deeper {are_open} points, too."


def _verdict(lesson_check):
    if not lesson_check.ready:
        return "Not ready yet: see above."
    results = [entry.result for entry in lesson_check.exercises if entry.result is not None]
    if any(not case.passed for result in results for case in result.cases):
        return "Complete, but grading would not give every point yet: see above."
    if lesson_check.was_run:
        return "Ready to submit: every check passes."
    complete = "The core is complete" if lesson_check.open else "Complete"
    cells = f"every answer cell{' of it' * bool(lesson_check.open)}"
    run = f"`{course.command} check --run {lesson_check.path}` runs them"
    return f"{complete}: {cells} is there and filled in. The answers were not run; {run}."
