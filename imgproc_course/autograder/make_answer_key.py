"""Make an answer key: run each solution on inputs drawn from a secret seed, in the kernel that grades.

`answer_key` describes what a key holds, and reads it.
"""

import hashlib
import json
import secrets
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from tqdm import tqdm

from imgproc_course.authoring.atomic_write import write_folder
from imgproc_course.authoring.masters import find_masters, read_master
from imgproc_course.autograder.answer_key import (
    FORMAT,
    HANDED_OUT,
    KeyCase,
    KeyExercise,
    KeyFolderError,
    KeyMistake,
    load_key,
)
from imgproc_course.autograder.reference import failing_call, is_form, read_answer
from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.inside.check_cell import MIME, argument_names, told_of
from imgproc_course.autograder.sandbox.inside.input_encoding import decode, encode
from imgproc_course.autograder.sandbox.kernels import Kernels
from imgproc_course.exercises import running
from imgproc_course.exercises.declaration import MasterError

EMIT = "from imgproc_course.autograder.sandbox.inside.check_cell import emit"
PLACEHOLDER = "# the learner's answer stands here"


def kept_seed(path):
    """The secret seed stored in a file; made and stored where there is no such file.

    Parameters
    ----------
    path : Path of a text file, readable by its owner alone

    Returns
    -------
    str, 32 hexadecimal digits where it was made here

    Raises
    ------
    OSError : the file cannot be read or written
    """
    if path.exists():
        return path.read_text(encoding="utf-8").strip()
    seed = secrets.token_hex(16)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch(mode=0o600)
    path.write_text(f"{seed}\n", encoding="utf-8")
    return seed


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
    out = Path(out)
    if out.exists() and not replace and (not out.is_dir() or any(out.iterdir())):
        raise KeyFolderError(
            f"{out}: there is something already, and grades may depend on it: name another folder, or say"
            " --replace"
        )
    if not unsafe:
        bubblewrap.demand()
    masters = [read_master(path) for path in find_masters(masters_dir, names)]
    parts = [(master, each) for master in masters for each in master.exercises]
    written = {}
    with Kernels("fast", unsafe=unsafe) as kernels:
        for master, declared in tqdm(parts, desc="key", unit=" exercises", delay=2, leave=False):
            maker = _Maker(master, declared, _number(seed), kernels)
            written[declared.id] = maker.practice() if declared.practice else maker.graded()
    files = {name: text for _, texts in written.values() for name, text in texts.items()}
    lessons = [_lesson(master, written) for master in masters]
    files[HANDED_OUT] = _handed_out(masters)
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


def _handed_out(masters):
    """What the cells of the lessons look like when they are handed out, as JSON.

    With it, changed check cells are noticed, and a learner's own cells are distinguished from the lesson's.
    """
    lessons = {
        master.name: {
            cell.id: cell.source if cell.role in ("check", "given") else None for cell in master.cells
        }
        for master in masters
    }
    return json.dumps(lessons, indent=1, sort_keys=True) + "\n"


def _write(out, files):
    try:
        write_folder(out, files, permissions=0o700)
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
