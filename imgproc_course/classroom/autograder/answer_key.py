"""The answer key: what answers are compared with. `make_answer_key` makes it from a secret seed.

A key is a folder that learners must not get:

    key.json                            lessons with their versions, exercises, cases, known mistakes
    <lesson>/<exercise>.ipynb           the exercise as nbval grades it: given cells, a placeholder for the
                                        answer, one check cell per case with the solution's outputs
    <lesson>/<exercise>.inputs.json     the arguments of each case's calls (see `input_encoding`)
    <lesson>/<exercise>.mistakes.json   what each known mistake does with them
    handed_out.json                     the ids of each lesson's cells, the source of check and given cells
    solutions.json                      {exercise id: source}: an answer that equals it is reported

The seed is in none of these files. Public cases get inputs from this seed too, so that nothing in the
course's repository gives an answer away. A key contains no pickle; an altered key can at most grade wrongly.
"""

import contextlib
import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import msgspec

from ..exercises.canonical import canonical
from ..exercises.drive import LOOK, MEAN_LOOK_SECONDS
from ..exercises.input_encoding import decode
from ..exercises.running import answer_name
from .answer_forms import read_calls
from .sandbox.inside.answer_mime import MIME

FORMAT = 4
HANDED_OUT = "handed_out.json"
SOLUTIONS = "solutions.json"


class KeyFolderError(ValueError):
    """A key cannot be read or written; the message is one line with the remedy."""


@dataclass(frozen=True)
class KeyCase:
    """One test case in the key; `calls` is the number of its calls, in a drive one for each look."""

    id: str
    title: str
    hint: str
    points: int
    hidden: bool
    tolerance: float
    calls: int


@dataclass(frozen=True)
class KeyMistake:
    """A known wrong answer: its name, and the explanation for a learner who gives it."""

    name: str
    explanation: str


@dataclass(frozen=True)
class KeyExercise:
    """One exercise in the key; a practice exercise has no cases and is not graded."""

    id: str
    title: str
    function: str
    points: int
    allowed: tuple[str, ...]
    time_limit: float
    practice: bool
    stub: str  # the answer cell's source in the lesson
    arguments: tuple[str, ...]  # names of the function's
    cases: tuple[KeyCase, ...]
    mistakes: tuple[KeyMistake, ...]
    given: tuple[str, ...] = ()  # sources of the given cells; none in a key of an earlier version
    exact_type: bool = False  # whether a right value in another type is wrong
    subject: str = "function"  # what the answer is; or "node", "package", "drive"
    sensors: tuple[str, ...] = ()  # what a controller observes

    @property
    def drives(self):
        """Whether its answer is a controller."""
        return self.subject == "drive"

    @property
    def simulated_seconds(self):
        """How long its drives are, together."""
        return LOOK * sum(case.calls for case in self.cases) if self.drives else 0.0

    def seconds_of(self, case):
        """Processor time of a case: the time limit for each of its calls; a drive has its own."""
        return case.calls * (MEAN_LOOK_SECONDS if self.drives else self.time_limit)

    @property
    def answer_name(self):
        """How texts name its answer, double() or Doubler."""
        return answer_name(self.function, self.subject)


@dataclass(frozen=True)
class KeyLesson:
    """One lesson; its name identifies it."""

    name: str
    number: str  # only its place in the course: "04"
    title: str
    version: str  # of the course that it was made from
    digest: str  # SHA-256 of its master
    exercises: tuple[KeyExercise, ...]

    @property
    def points(self):
        return sum(exercise.points for exercise in self.exercises)


@dataclass(frozen=True)
class Key:
    """A key that `load_key` read."""

    path: Path
    digest: str  # identifies it
    lessons: dict  # {name: KeyLesson}

    def find(self, exercise_id):
        """The KeyLesson and the KeyExercise of an exercise, or None and None."""
        pairs = ((lesson, exercise) for lesson in self.lessons.values() for exercise in lesson.exercises)
        return next((pair for pair in pairs if pair[1].id == exercise_id), (None, None))

    def exercise(self, id):
        """The KeyExercise of that id, or None."""
        return self.find(id)[1]

    def content(self, exercise_id):
        """The notebook, the inputs and the mistakes of a graded exercise, as `ExerciseContent`."""
        lesson, _ = self.find(exercise_id)
        return _content(self.path / lesson.name, exercise_id, self.digest)


@dataclass(frozen=True)
class ExerciseContent:
    """The contents of an exercise's three files."""

    notebook: dict  # of nbformat 4
    inputs: dict  # {case id: list of calls, each the encoded tuple of its arguments}
    mistakes: dict  # {name: {case id: list of CallResult}}
    expected: dict  # {case id: list of canonical forms, one per call}

    def canonical_arguments(self, case_id, number):
        """The canonical forms of one call's arguments, to show a public case."""
        return [canonical(value, limit=None) for value in self.arguments(case_id, number)]

    def arguments(self, case_id, number):
        """The arguments of one call."""
        return decode(self.inputs[case_id][number])

    def scenario(self, case_id):
        """What a case of a driving exercise drives through, a dict."""
        (scenario,) = self.arguments(case_id, 0)
        return scenario


@lru_cache(maxsize=64)
def _content(folder, id, _digest):
    with reading(folder / id):
        notebook, inputs, mistakes = (
            json.loads((folder / f"{id}{ending}").read_text(encoding="utf-8"))
            for ending in (".ipynb", ".inputs.json", ".mistakes.json")
        )
        expected = {
            cell["id"]: [call["value"] for call in cell["outputs"][0]["data"][MIME]["calls"]]
            for cell in notebook["cells"]
            if cell["id"] in inputs
        }
        mistakes = {
            name: {case_id: read_calls(calls) for case_id, calls in cases.items()}
            for name, cases in mistakes.items()
        }
    return ExerciseContent(notebook, inputs, mistakes, expected)


@contextlib.contextmanager
def reading(path):
    """What fails inside means that this file of a key cannot be read: KeyFolderError says so."""
    try:
        yield
    except KeyFolderError:
        raise
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise KeyFolderError(f"{path}: cannot be read ({error}); make the key again") from error


def load_key(path):
    """Read the Key in a folder; KeyFolderError: there is none that grading can use."""
    path = Path(path).resolve()
    with reading(path / "key.json"):
        if not (path / "key.json").exists():
            raise KeyFolderError(f"{path}: there is no key; make one: imgproc-course key --out {path.name}")
        data = (path / "key.json").read_bytes()
        content = msgspec.json.decode(data)
        if (found := content["format"]) != FORMAT:
            raise KeyFolderError(f"{path}: a key of format {found}, expected {FORMAT}; make it again")
        key_lessons = msgspec.convert(content["lessons"], tuple[KeyLesson, ...])
    digest = hashlib.sha256(data)
    for lesson in key_lessons:
        for exercise in lesson.exercises:
            if not exercise.practice:
                digest.update(_read_checked(path / lesson.name / f"{exercise.id}.ipynb"))
    return Key(path, digest.hexdigest(), {lesson.name: lesson for lesson in key_lessons})


def _read_checked(path):
    """The bytes of an exercise's notebook; all its cells must have been run.

    nbval never compares a cell without an execution count: such a key would let every answer pass.
    """
    with reading(path):
        data = path.read_bytes()
        for cell in json.loads(data)["cells"]:
            is_check = cell["id"].startswith(("case-", "check-", "hidden-"))
            if cell["cell_type"] == "code" and (
                not isinstance(cell.get("execution_count"), int) or (is_check and not cell["outputs"])
            ):
                raise KeyFolderError(
                    f"{path}: cell {cell['id']} has no execution count, so nbval would let every answer pass;"
                    " make the key again"
                )
    return data


def known_mistake(exercise, content, calls):
    """The declared mistake (or None) that did, on every public call, exactly what the answer's `calls` did.

    A mistake that agrees on the hidden calls too is preferred to one that does not. `check` has the same
    rule, so a lesson and a report name the same mistake.
    """
    public = [case for case in exercise.cases if not case.hidden]
    for cases in (exercise.cases, public):
        for mistake in exercise.mistakes:
            if _agrees(content.mistakes[mistake.name], calls, cases):
                return mistake
    return None


def _agrees(mistake_calls, calls, cases):
    for case in cases:
        answer, mistake = calls.get(case.id) or (), mistake_calls[case.id]
        pairs = zip(answer, mistake, strict=False)
        if len(answer) != len(mistake) or not all(call.matches(o, case.tolerance) for call, o in pairs):
            return False
    return True
