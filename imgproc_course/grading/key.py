"""The answer key: what grading compares with, made from a secret seed by the kernel that grades.

A key is a folder, not to be handed out:

    key.json                            lessons with their versions, exercises, cases, known mistakes
    <lesson>/<exercise>.ipynb           the exercise as nbval grades it: given cells, the answer (a place for
                                        it), one check cell a case, with the solution's outputs and counts
    <lesson>/<exercise>.inputs.json     the arguments of each case's calls (see `kernel.inside.values`)
    <lesson>/<exercise>.mistakes.json   what each known mistake does on them

The seed stands in none of them. Public cases get inputs of this seed too, so that nothing in the course's
repository gives an answer away. There is no pickle in a key; an altered one can at most grade wrongly.
"""

import hashlib
import json
import tempfile
from dataclasses import asdict, dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from tqdm import tqdm

from imgproc_course.exercises import running
from imgproc_course.exercises.canonical import canonical
from imgproc_course.exercises.declaration import MasterError
from imgproc_course.grading.judge_reference import did_the_same, failing_call, is_form, read_answer
from imgproc_course.grading.kernel import sandbox
from imgproc_course.grading.kernel.inside.course_cells import MIME, argument_names, told_of
from imgproc_course.grading.kernel.inside.values import decode, encode
from imgproc_course.grading.kernel.starting import Kernels

FORMAT = 1
EMIT = "from imgproc_course.grading.kernel.inside.course_cells import emit"
PLACEHOLDER = "# the learner's answer stands here"


class KeyFolderError(ValueError):
    """A key that cannot be read or written; one line with the cure."""


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


# ---------------------------------------------------------------- making


def make_key(masters_dir, seed, out, names=(), *, unsafe=False, replace=False):
    """Make a key: run each solution on inputs drawn from the seed, in the kernel that grades.

    The folder is written at the end, whole: an error or Ctrl-C leaves what was there.

    Parameters
    ----------
    masters_dir : Path of the folder of masters
    seed : int or str, the teacher's secret; it is stored nowhere
    out : Path of the key's folder
    names : lessons, as `find_masters` takes them; all where empty
    unsafe : bool, do without a sandbox
    replace : bool, take the place of a key that stands there

    Returns
    -------
    Key

    Raises
    ------
    MasterError : a solution that fails, or inputs that cannot travel as data; names lesson and case
    KeyFolderError : there is a key already, or the folder cannot be written
    SandboxError : there is no sandbox here
    """
    # Here, and not above: it loads jupytext, which no judge needs, and each would wait for.
    from imgproc_course.grading.masters import find_masters, read_master

    out = Path(out)
    if out.exists() and not replace and (not out.is_dir() or any(out.iterdir())):
        raise KeyFolderError(
            f"{out}: there is something already, and grades may depend on it: name another folder, or say"
            " --replace"
        )
    if not unsafe:
        sandbox.demand()
    masters = [read_master(path) for path in find_masters(masters_dir, names)]
    parts = [(master, each) for master in masters for each in master.exercises]
    written = {}
    with Kernels("fast", unsafe=unsafe) as kernels:
        for master, declared in tqdm(parts, desc="key", unit=" exercises", delay=2, leave=False):
            maker = _Maker(master, declared, _number(seed), kernels)
            written[declared.id] = maker.practice() if declared.practice else maker.graded()
    files = {name: text for _, texts in written.values() for name, text in texts.items()}
    lessons = [_lesson(master, written) for master in masters]
    files["key.json"] = json.dumps({"format": FORMAT, "lessons": lessons}, indent=1, sort_keys=True) + "\n"
    _write(out, files)
    return load_key(out)


def _number(seed):
    """A seed for NumPy: words are as good as numbers, and harder to guess."""
    return int.from_bytes(hashlib.sha256(f"imgproc-course {seed}".encode()).digest()[:16])


def _lesson(master, written):
    return {
        "name": master.name,
        "title": master.title,
        "version": version("imgproc-course"),
        "digest": hashlib.sha256(master.path.read_bytes()).hexdigest(),
        "exercises": [written[each.id][0] for each in master.exercises],
    }


def _write(out, files):
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=out.parent, prefix=".key-") as folder:
            new = Path(folder) / "new"
            for name, text in files.items():
                path = new / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            new.chmod(0o700)
            if out.exists():
                out.rename(Path(folder) / "old")
            new.rename(out)
    except OSError as error:
        raise KeyFolderError(f"{out}: cannot be written ({error})") from error


class _Maker:
    """The key's part of one exercise."""

    def __init__(self, master, declared, seed, kernels):
        self._master, self._declared, self._seed, self._kernels = master, declared, seed, kernels

    def practice(self):
        """Known by name, never graded; its inputs may be anything."""
        return self._entry((), ()), {}

    def graded(self):
        """The exercise's entry in key.json, and its files."""
        declared = self._declared
        if "numpy" in declared.refused:
            raise MasterError(
                f"{declared.master.name}: {declared.id} refuses numpy, which every answer finds"
            )
        inputs = {case.id: self._inputs(case) for case in declared.cases}
        shown = {case.id: self._shown(case, inputs[case.id]) for case in declared.cases}
        mistakes = {
            mistake.name: {case.id: self._done_by(mistake, inputs[case.id]) for case in declared.cases}
            for mistake in declared.mistakes
        }
        cases = tuple(
            KeyCase(
                case.id, case.title, case.hint, case.points, case.hidden, case.tolerance, len(inputs[case.id])
            )
            for case in declared.cases
        )
        known = tuple(KeyMistake(mistake.name, mistake.says) for mistake in declared.mistakes)
        where = f"{self._master.name}/{declared.id}"
        files = {
            f"{where}.ipynb": nbformat.writes(self._notebook(shown)) + "\n",
            f"{where}.inputs.json": json.dumps(inputs, sort_keys=True) + "\n",
            f"{where}.mistakes.json": json.dumps(mistakes, sort_keys=True) + "\n",
        }
        return self._entry(cases, known), files

    def _entry(self, cases, mistakes):
        declared = self._declared
        solution = declared.function_of(declared.solution, "solution")
        entry = KeyExercise(
            id=declared.id,
            title=declared.title,
            function=declared.function,
            points=sum(case.points for case in cases),
            refused=declared.refused,
            time_limit=declared.time_limit,
            practice=declared.practice,
            stub=declared.stub,
            arguments=tuple(argument_names(solution)),
            cases=cases,
            mistakes=mistakes,
        )
        return asdict(entry)

    def _inputs(self, case):
        declared = self._declared
        try:
            return [encode(arguments) for arguments in declared.arguments(case, self._seed)]
        except TypeError as error:
            raise MasterError(
                f"{declared.master.name}, line {case.line}: {case.id}: {error}; or make the exercise"
                " practice=True"
            ) from error

    def _shown(self, case, inputs):
        """What the solution's check cell shows, in a kernel as the graded ones."""
        declared = self._declared
        kernel = self._kernels.start(declared.refused, declared.time_limit * len(inputs))
        try:
            runs = [
                *(kernel.run(source) for source in (*declared.given, declared.solution)),
                kernel.deliver(inputs, declared.time_limit, declared.refused),
                kernel.run(_check_source(declared.function)),
            ]
        finally:
            kernel.stop()
        where = f"{declared.master.name}, {case.id}: the solution"
        for run in runs:
            if run.ended or run.error[0]:
                raise MasterError(f"{where} fails in grading: {run.ended} {': '.join(run.error)}".strip())
        read = read_answer(runs[-1].answers[0]) if len(runs[-1].answers) == 1 else None
        if read is None or read[1]:
            raise MasterError(f"{where} shows no values, or uses what the exercise refuses")
        for call in read[0]:
            if "value" not in call or call["changed"] or not _is_comparable(call["value"]):
                told = call.get("error") or "changes its input" if call.get("changed") else str(call)[:200]
                raise MasterError(f"{where} gives nothing that can be compared: {told}")
        expected = [call["value"] for call in read[0]]
        if failing_call(expected, read[0], case.tolerance) is not None:
            raise MasterError(f"{where} does not equal itself")
        return {"calls": read[0], "refused": []}

    def _done_by(self, mistake, inputs):
        declared = self._declared
        wrong = declared.function_of(mistake.source, f"mistake {mistake.name!r}", prepared=True)
        done = []
        for encoded in inputs:
            arguments = decode(encoded)
            outcome = running.call(wrong, arguments, argument_names(wrong, arguments), declared.time_limit)
            done.append(told_of(outcome))
        return done

    def _notebook(self, shown):
        declared = self._declared
        cells = [new_markdown_cell(f"# {declared.title}", id=f"{declared.id}-title"[:64])]
        for number, source in enumerate(declared.given, 1):
            cells.append(_code_cell(f"given-{declared.id}-{number}", source, len(cells), free=True))
        cells.append(_code_cell(f"answer-{declared.id}", PLACEHOLDER, len(cells), free=True))
        for case in declared.cases:
            cell = _code_cell(case.id, _check_source(declared.function), len(cells))
            cell.outputs = [new_output("display_data", {MIME: shown[case.id]})]
            cells.append(cell)
        kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
        about = {"exercise": declared.id, "version": version("imgproc-course")}
        return new_notebook(cells=cells, metadata={"kernelspec": kernel, "imgproc_course": about})


def _check_source(function):
    return f"{EMIT}\n\nemit({function})"


def _code_cell(id, source, count, *, free=False):
    """A cell that has been run; a `free` one is run for what it defines, and never compared."""
    tags = ["nbval-ignore-output", "nbval-raises-exception"] if free else []
    return new_code_cell(source, id=id, execution_count=count, metadata={"tags": tags} if tags else {})


def _is_comparable(form):
    """False for a form that says only that there was something."""
    if not is_form(form) or form.get("opaque") or form.get("too_large"):
        return False
    inner = [*form.get("items", ()), *form.get("fields", {}).values()]
    parts = [each for item in inner for each in (item if isinstance(item, list) else [item])]
    return all(_is_comparable(each) for each in parts)


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


def sample_answers(declared):
    """Answers that a learner could hand in: the right one, the stub, and each known mistake.

    Parameters
    ----------
    declared : Exercise, of a master

    Returns
    -------
    {name: source}: "right", "untouched", and the mistakes by their names. A mistake that calls the right
    answer, or what stands beside the declaration, is given both in its own cell.
    """
    helpers = "from imgproc_course.exercises import exercise\n\n"
    helpers += f"{declared.preparation}\n\n{declared.solution}\n\nsolution = {declared.function}\n\n"
    answers = {"right": declared.solution, "untouched": declared.stub}
    for mistake in declared.mistakes:
        answers[mistake.name] = f"{helpers}{mistake.source}"
    return answers
