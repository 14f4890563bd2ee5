"""The answer key: what grading compares with, made from a secret seed by the kernel that grades.

A key is a folder, not to be handed out:

    key.json                            lessons with their versions, exercises, cases, known mistakes
    <lesson>/<exercise>.ipynb           the exercise as nbval grades it: given cells, the answer (a place for
                                        it), one check cell a case, with the solution's outputs and counts
    <lesson>/<exercise>.inputs.json     the arguments of each case's calls (see `kernel.inside.values`)
    <lesson>/<exercise>.mistakes.json   what each known mistake does on them
    handed_out.json                     each lesson's cell ids, with the source of check and given cells

The seed stands in none of them. Public cases get inputs of this seed too, so that nothing in the course's
repository gives an answer away. There is no pickle in a key; an altered one can at most grade wrongly.
"""

import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from imgproc_course.autograder.reference import did_the_same
from imgproc_course.autograder.sandbox.inside.check_cell import MIME
from imgproc_course.autograder.sandbox.inside.input_encoding import decode
from imgproc_course.exercises.canonical import canonical

FORMAT = 1
HANDED_OUT = "handed_out.json"


class KeyFolderError(ValueError):
    """A key that cannot be read or written; one line with the remedy."""


@dataclass(frozen=True)
class KeyCase:
    """One case as the key knows it; `calls` is the number of calls that it makes."""

    id: str
    title: str
    hint: str
    points: int
    hidden: bool
    tolerance: float
    calls: int


@dataclass(frozen=True)
class KeyMistake:
    """A known wrong answer: its name, and what is said to a learner who gives it."""

    name: str
    says: str


@dataclass(frozen=True)
class KeyExercise:
    """One exercise as the key knows it; a practice exercise has no cases and is not graded.

    stub       the answer's cell as it was handed out
    arguments  names of the function's arguments
    """

    id: str
    title: str
    function: str
    points: int
    refused: tuple
    time_limit: float
    practice: bool
    stub: str
    arguments: tuple
    cases: tuple
    mistakes: tuple


@dataclass(frozen=True)
class KeyLesson:
    """One lesson: `version` of the course that it was made from, `digest` (SHA-256) of its master."""

    name: str
    title: str
    version: str
    digest: str
    exercises: tuple

    @property
    def points(self):
        return sum(each.points for each in self.exercises)


@dataclass(frozen=True)
class Key:
    """A key as `load_key` read it. `digest` tells one key from another; `lessons` maps name -> KeyLesson."""

    path: Path
    digest: str
    lessons: dict

    def exercise(self, id):
        """The KeyExercise of that id, or None."""
        return next(
            (each for lesson in self.lessons.values() for each in lesson.exercises if each.id == id), None
        )

    def lesson_of(self, exercise_id):
        """The name of the lesson that an exercise belongs to, or None."""
        return next(
            (
                name
                for name, lesson in self.lessons.items()
                if any(e.id == exercise_id for e in lesson.exercises)
            ),
            None,
        )

    def content(self, exercise_id):
        """The notebook, the inputs and the mistakes of a graded exercise, as `ExerciseContent`."""
        return _content(self.path / self.lesson_of(exercise_id), exercise_id, self.digest)


@dataclass(frozen=True)
class ExerciseContent:
    """What stands in an exercise's three files.

    notebook  dict, of nbformat 4
    inputs    {case id: list of calls, each the encoded tuple of its arguments}
    mistakes  {name: {case id: list of what each call did}}
    expected  {case id: list of canonical forms, one a call}
    """

    notebook: dict
    inputs: dict
    mistakes: dict
    expected: dict

    def inputs_shown(self, case_id, call):
        """The canonical forms of one call's arguments, for a report of a public case."""
        return [canonical(value, limit=None) for value in decode(self.inputs[case_id][call])]


@lru_cache(maxsize=64)
def _content(folder, id, _digest):
    try:
        notebook = json.loads((folder / f"{id}.ipynb").read_text(encoding="utf-8"))
        inputs = json.loads((folder / f"{id}.inputs.json").read_text(encoding="utf-8"))
        mistakes = json.loads((folder / f"{id}.mistakes.json").read_text(encoding="utf-8"))
        expected = {
            cell["id"]: [call["value"] for call in cell["outputs"][0]["data"][MIME]["calls"]]
            for cell in notebook["cells"]
            if cell["id"] in inputs
        }
    except (OSError, ValueError, KeyError, IndexError, TypeError) as error:
        raise KeyFolderError(f"{folder}/{id}: cannot be read ({error}); make the key again") from error
    return ExerciseContent(notebook, inputs, mistakes, expected)


# ---------------------------------------------------------------- reading


def load_key(path):
    """Read a key.

    Parameters
    ----------
    path : Path of its folder

    Returns
    -------
    Key

    Raises
    ------
    KeyFolderError : no key, one of another format, or one whose check cells were never run
    """
    path = Path(path).resolve()
    try:
        text = (path / "key.json").read_text(encoding="utf-8")
        written = json.loads(text)
        if written["format"] != FORMAT:
            raise KeyFolderError(
                f"{path}: a key of format {written['format']}, expected {FORMAT}; make it again"
            )
        lessons = {lesson["name"]: _read_lesson(lesson) for lesson in written["lessons"]}
    except FileNotFoundError as error:
        raise KeyFolderError(
            f"{path}: there is no key; make one: imgproc-course key --seed S --out {path.name}"
        ) from error
    except (OSError, ValueError, KeyError, TypeError) as error:
        if isinstance(error, KeyFolderError):
            raise
        raise KeyFolderError(f"{path}/key.json: cannot be read ({error}); make the key again") from error
    digest = hashlib.sha256(text.encode())
    for lesson in lessons.values():
        for each in lesson.exercises:
            if not each.practice:
                _refuse_unrun(path / lesson.name / f"{each.id}.ipynb", digest)
    return Key(path, digest.hexdigest(), lessons)


def _read_lesson(written):
    exercises = tuple(_read_exercise(each) for each in written["exercises"])
    return KeyLesson(**{**written, "exercises": exercises})


def _read_exercise(written):
    return KeyExercise(
        **{
            **written,
            "refused": tuple(written["refused"]),
            "arguments": tuple(written["arguments"]),
            "cases": tuple(KeyCase(**case) for case in written["cases"]),
            "mistakes": tuple(KeyMistake(**mistake) for mistake in written["mistakes"]),
        }
    )


def _refuse_unrun(path, digest):
    """nbval never compares a cell without an execution count: such a key would pass everybody."""
    try:
        text = path.read_text(encoding="utf-8")
        cells = json.loads(text)["cells"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise KeyFolderError(f"{path}: cannot be read ({error}); make the key again") from error
    digest.update(text.encode())
    for cell in cells:
        checks = cell["id"].startswith(("case-", "check-", "hidden-"))
        if cell["cell_type"] == "code" and (
            not isinstance(cell.get("execution_count"), int) or (checks and not cell["outputs"])
        ):
            raise KeyFolderError(
                f"{path}: cell {cell['id']} has no execution count, so nbval would pass whatever it shows;"
                " make the key again"
            )


# ---------------------------------------------------------------- known mistakes


def known_mistake(exercise, content, done):
    """The declared mistake that did, on every public call, exactly what the answer did.

    One that did the same on the hidden calls too goes before one that did not. The rule is `check`'s own, so
    that a lesson and a report name the same mistake.

    Parameters
    ----------
    exercise : KeyExercise
    content : ExerciseContent
    done : {case id: list of what each call did, or None}

    Returns
    -------
    KeyMistake or None
    """
    public = [case for case in exercise.cases if not case.hidden]
    fitting = [
        mistake for mistake in exercise.mistakes if _fits(content.mistakes[mistake.name], done, public)
    ]
    wholly = [mistake for mistake in fitting if _fits(content.mistakes[mistake.name], done, exercise.cases)]
    return next(iter([*wholly, *fitting]), None)


def _fits(mistake, done, cases):
    for case in cases:
        calls, predicted = done.get(case.id), mistake[case.id]
        if calls is None or len(calls) != len(predicted):
            return False
        if not all(
            did_the_same(call, other, case.tolerance) for call, other in zip(calls, predicted, strict=True)
        ):
            return False
    return True
