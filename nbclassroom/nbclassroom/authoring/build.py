"""Build lessons and their solved twins from masters, and compare stored lessons with their masters."""

import hashlib
import runpy
import time
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path
from typing import Any

import jinja2
import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from .. import course
from ..exercises.atomic_write import write_file
from ..exercises.check_files import CHECKS, SOLUTIONS
from ..exercises.declaration import MasterError
from .execute import execute, normalize, output_texts, refuse_traces
from .lesson_files import TEXTS, lesson_file_differences, lesson_files
from .lesson_names import lesson_name
from .masters import find_masters, read_master
from .references import GLOSSARY, GLOSSARY_PAGE, References, glossary_page
from .rules import RAISING_TAGS, VARYING_TAG
from .validation import validate_exercise

INDEX = "index"
CHEAT_SHEET = "cheat_sheet.html"


@dataclass
class BuildResult:
    """The result of a build: names of the lessons built, and problems (or differences), one per line."""

    built: list = field(default_factory=list)
    problems: list = field(default_factory=list)


def build(masters_dir, lessons_dir, solved_dir, names=(), progress=print, *, with_solutions=False):
    """Build lessons and their solved twins, and the files that the lessons carry.

    Each lesson is built alone and written when it is complete. A failure or Ctrl-C costs only that lesson:
    its stored file stays as it was. `progress` takes a line of text.
    """
    result, folder = BuildResult(), Path(lessons_dir)
    for name, twins, files in _build_each(result, masters_dir, folder, names, progress, solved=True):
        for twin, folder_of_twin in zip(twins, (folder, Path(solved_dir)), strict=True):
            text = nbformat.writes(twin) + "\n"
            write_file(folder_of_twin / f"{name}.ipynb", text, permissions=0o644)
        for file, text in files.items():
            if with_solutions or not file.startswith(SOLUTIONS):
                write_file(folder / file, text, permissions=0o644)
            else:
                (folder / file).unlink(missing_ok=True)  # of a build with solutions
    if not names:
        try:
            for name, text in build_pages(masters_dir).items():
                write_file(folder / name, text, permissions=0o644)
        except MasterError as error:
            result.problems.append(str(error))
        result.problems += _orphans(masters_dir, folder)
    return result


def compare_lessons(masters_dir, lessons_dir, names=(), progress=print):
    """Build lessons without writing them; the problems of the BuildResult say how the stored ones differ."""
    result, folder = BuildResult(), Path(lessons_dir)
    for name, (lesson,), files in _build_each(result, masters_dir, folder, names, progress, solved=False):
        result.problems += differences(lesson, folder / f"{name}.ipynb")
        result.problems += lesson_file_differences(files, folder)
    if not names:
        result.problems += compare_other_files(masters_dir, folder)
    return result


def compare_other_files(masters_dir, lessons_dir):
    """How the pages differ from their sources, and which files have no master; a list of str."""
    try:
        problems = lesson_file_differences(build_pages(masters_dir), Path(lessons_dir))
    except MasterError as error:
        problems = [str(error)]
    return problems + _orphans(masters_dir, lessons_dir)


def build_pages(masters_dir):
    """{file name: text} of the pages that belong to a folder of masters."""
    sources = {page: (Path(masters_dir) / source, make) for page, (source, make) in _PAGES.items()}
    return {page: make(path) for page, (path, make) in sources.items() if path.exists()}


def cheat_sheet_page(template):
    """The HTML of a cheat sheet, two pages to print, of a Jinja template.

    The Python file beside it defines the names of its examples. In the template `run("tiny[2, 4]")` gives the
    value of a line of Python, so the page shows what it computes. References such as [[arrays#2]] become
    plain text: JupyterLab shows the page in a frame, where a link would open a lesson as raw JSON.
    """
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    try:
        names = runpy.run_path(str(template.with_suffix(".py")))
        source = environment.from_string(template.read_text(encoding="utf-8"))
        page = source.render(names, run=lambda line: _value_of(line, names))
    except Exception as error:  # the examples are code of the template's author
        text = error if isinstance(error, MasterError) else f"{type(error).__name__}: {error}"
        raise MasterError(f"{template.name}: {text}") from error
    return References(template).in_text(f"{page}\n")


_PAGES = {GLOSSARY_PAGE: (GLOSSARY, glossary_page), CHEAT_SHEET: (CHEAT_SHEET, cheat_sheet_page)}


def _value_of(line, names):
    """The value of an expression; None after a statement."""
    try:
        try:
            code = compile(line, "example", "eval")
        except SyntaxError:
            code = compile(line, "example", "exec")
        return eval(code, names)
    except Exception as error:  # the line is code of the template's author
        raise MasterError(f"in {line!r}: {type(error).__name__}: {error}") from error


def _build_each(result, masters_dir, lessons_dir, names, progress, *, solved):
    """(name, [lesson, and its solved twin], lesson files) of each that builds; `result` tells of all."""
    for path in _masters_to_build(masters_dir, names):
        start = time.monotonic()
        progress(f"{path.stem} ...")
        try:
            master = read_valid_master(path)
            files = lesson_files(master)
            twins = [build_lesson(master, lessons_dir / f"{path.stem}.ipynb")]
            twins += [build_lesson(master, solved=True)] if solved else []
        except MasterError as error:
            result.problems.append(str(error))
            continue
        kilobytes = len(nbformat.writes(twins[0])) / 1000
        check_kilobytes = sum(len(text) for name, text in files.items() if name.startswith(CHECKS)) / 1000
        sizes = f"{kilobytes:.0f} kB, checks {check_kilobytes:.0f} kB"
        minutes = f"core {master.core_minutes} of {master.minutes} minutes"
        progress(f"{path.stem}: {minutes}; {sizes}, {time.monotonic() - start:.0f} s")
        yield path.stem, twins, files
        result.built.append(path.stem)


def _masters_to_build(folder, names=()):
    """The masters of lessons, then the master of the index, which lists the lessons that were built."""
    index = Path(folder) / f"{INDEX}.py"
    lessons = [name for name in names if name != INDEX]
    paths = find_masters(folder, lessons) if lessons or not names else []
    return [*paths, index] if index.is_file() and (not names or INDEX in names) else paths


def read_valid_master(path):
    """Read a master that follows the rules and has valid exercises; MasterError has a line a problem."""
    master = read_master(path)
    problems = [problem for exercise in master.exercises for problem in validate_exercise(exercise)]
    if problems:
        lines = {case.id: f", line {case.line}" for exercise in master.exercises for case in exercise.cases}
        places = (master.path.name + lines.get(problem.partition(":")[0], "") for problem in problems)
        raise MasterError("\n".join(map(": ".join, zip(places, problems, strict=True))))
    return master


def build_lesson(master, stored_path=None, executed=None, *, solved=False):
    """The lesson of a master, or its solved twin, executed.

    A cell whose output varies keeps its output in the stored lesson. `executed` is `lesson_notebook` with the
    outputs of its execution. MasterError: an error in a cell, or an output that is not reproducible.
    """
    notebook = executed or lesson_notebook(master, solved=solved)
    if not executed:
        execute(notebook, master.path, files=lesson_files(master))
    normalize(notebook, master)
    if stored_path:  # a cell whose output varies keeps its stored output if no code up to it has changed
        stored = _read_stored(stored_path) or new_notebook()
        outputs = {code: cell.outputs for cell, code in _code_cells(stored)}
        varying = {cell.id for cell in master.cells if cell.varies}
        for cell, code in _code_cells(notebook):
            if cell.id in varying:
                cell.outputs = outputs.get(code, cell.outputs)
    refuse_traces(notebook, master)
    return notebook


def lesson_notebook(master, *, solved=False):
    """A lesson, or its solved twin, without outputs."""
    cells = []
    for cell in master.cells:
        new_cell = new_code_cell if cell.kind == "code" else new_markdown_cell
        source = cell.solved_source if solved else cell.source
        cells.append(new_cell(source, id=cell.id, metadata=_cell_metadata(cell)))
    lesson_metadata = {
        "lesson": master.name,
        "title": master.title,
        "minutes": master.minutes,
        "core_minutes": master.core_minutes,
        "deeper": list(master.deeper_exercises),
        "version": course.release(),
    }
    lesson_metadata |= {"optional": True} if master.optional else {}
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    return new_notebook(cells=cells, metadata={"kernelspec": kernel, course.name: lesson_metadata})


def _cell_metadata(cell):
    tags = sorted({*cell.tags, *RAISING_TAGS}) if set(cell.tags) & set(RAISING_TAGS) else list(cell.tags)
    metadata: dict[str, Any] = {"tags": tags} if tags else {}
    if cell.folded:
        metadata["jupyter"] = {"source_hidden": True}
    if cell.role == "check":
        metadata |= {"editable": False, "deletable": False}
    elif cell.role in ("answer", "given", "predict"):
        metadata |= {"deletable": False}
    if cell.role == "answer":  # survives merging and splitting, and tools that rewrite ids
        metadata[course.name] = {"exercise": cell.exercise}
    return metadata


def _code_cells(notebook):
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    return [(cell, tuple(each.source for each in code[: number + 1])) for number, cell in enumerate(code)]


def _read_stored(path):
    """A stored lesson, or None if the file is missing or cannot be read."""
    try:
        return nbformat.read(path, as_version=4)
    except (OSError, ValueError, AttributeError, KeyError, TypeError):  # cut short, merged by hand, ...
        return None


def _orphans(masters_dir, lessons_dir):
    masters, folder = {path.stem for path in _masters_to_build(masters_dir)}, Path(lessons_dir)
    paths = [path for path in sorted(folder.glob("*.ipynb")) if path.stem not in masters]
    for page, (source, _) in _PAGES.items():
        if not (Path(masters_dir) / source).exists():
            paths += folder.glob(page)
    names = {lesson_name(master) for master in masters}
    for subfolder in (CHECKS, SOLUTIONS, TEXTS):
        paths += [path for path in sorted(folder.glob(f"{subfolder}/*.json")) if path.stem not in names]
    return [f"{path.name}: it has no master; delete it, or restore its master" for path in paths]


def differences(built, stored_path):
    """How a stored lesson differs from a built one, a text for each cell."""
    name, stored, problems = Path(stored_path).name, _read_stored(stored_path), []
    if stored is None:
        return [f"{name}: not built yet, or not a notebook; run {course.command} build"]
    if built.metadata != stored.metadata:
        problems.append(f"{name}: the lesson's metadata (title, minutes, version) differ")
    ids, stored_ids = [cell.id for cell in built.cells], [cell.id for cell in stored.cells]
    if ids != stored_ids:
        first = next(id or stored for id, stored in zip_longest(ids, stored_ids) if id != stored)
        return [*problems, f"{name}: its cells differ from the master's, from {first} on"]
    for cell, stored_cell in zip(built.cells, stored.cells, strict=True):
        if difference := _cell_difference(cell, stored_cell):
            problems.append(f"{name}: cell {cell.id}: {difference}")
    return problems


def _cell_difference(built, stored):
    if built.cell_type != stored.cell_type or built.source != stored.source:
        return "its source differs from the master"
    if built.metadata != stored.metadata:
        return "its tags or metadata differ from the master"
    varies = VARYING_TAG in built.metadata.get("tags", ())
    if built.cell_type == "code" and not varies and built.outputs != stored.outputs:
        summaries = f"    stored: {_outputs_summary(stored)}\n    now:    {_outputs_summary(built)}"
        return f"its outputs differ from the stored ones\n{summaries}"
    return ""


def _outputs_summary(cell):
    texts = [" ".join(text.split()) for text in output_texts(cell) if text.strip()]
    images = [
        f"{mime_type} {hashlib.sha256(value.encode()).hexdigest()[:8]}"
        for output in cell.outputs
        for mime_type, value in output.get("data", {}).items()
        if mime_type.startswith("image/") and isinstance(value, str)
    ]
    return " | ".join(texts + images)[:300] or "nothing"
