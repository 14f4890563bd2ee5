"""The core of every lesson stands alone: without its deeper sections no cell misses a name."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import nbformat
import pytest

sys.path.append(str(Path(__file__).parent))
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.authoring.execute import execute, normalize, output_texts
from nbclassroom.authoring.lesson_files import lesson_files
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.authoring.minutes import read_sections
from nbclassroom.exercises.percent_script import read_script
from needed_cells import names_of, names_used
from ways_to_run import ways_of

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
MASTERS = find_masters(NOTEBOOKS / "masters")


def global_names_read(source):
    """The names of other cells that a cell may read: no local variables of its functions."""
    return {name for statement in names_used(source) for name in statement.reads}


def names_of_deeper_cells(cells):
    """(id of a core cell, name) of each name that it reads and that only deeper cells above it bind."""
    in_core, in_deeper, problems = set(), set(), []
    for cell in cells:
        read, (_, bound) = global_names_read(cell.solved_source), names_of(cell.solved_source)
        if cell.deeper:
            in_deeper |= bound
        else:
            in_core |= bound
            problems += [(cell.id, name) for name in sorted(read & in_deeper - in_core)]
    return problems


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in MASTERS])
def test_no_core_cell_needs_a_name_of_a_deeper_cell(path):
    cells = [cell for cell in read_master(path).cells if cell.kind == "code"]
    assert names_of_deeper_cells(cells) == []


@pytest.mark.parametrize("way", ["visible", "begin"])
@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in MASTERS])
def test_no_cell_needs_a_name_that_no_cell_on_a_learners_way_binds(path, way):
    notebook = lesson_notebook(read_master(path))
    names = {cell.id: names_of(cell.source) for cell in notebook.cells if cell.cell_type == "code"}
    for cells in ways_of(notebook, way):
        left_out = names.keys() - {cell.id for cell in cells}
        missing = set().union(*(names[id][1] for id in left_out))
        for cell in cells:
            for statement in names_used(cell.source):
                assert statement.reads & missing == set(), cell.id
                missing -= statement.binds


def parts_of(cell):
    """A cell as it is, or a Markdown cell once for each heading, and once for the text above the first."""
    texts = re.split(r"^(?=#{2,4} )", cell.source, flags=re.M) if cell.kind == "markdown" else [cell.source]
    return [replace(cell, source=text) for text in texts if text.strip()]


def mixed_and_unmarked(cells):
    """First lines of the deeper parts that share a cell with core text, or whose heading does not say so."""
    parts = [(number, part) for number, cell in enumerate(cells) for part in parts_of(cell)]
    _, deeper = read_sections([part for _, part in parts])
    core_cells = {number for (number, _), is_deeper in zip(parts, deeper, strict=True) if not is_deeper}
    for (number, part), is_deeper in zip(parts, deeper, strict=True):
        line = part.source.split("\n", 1)[0]
        is_unmarked = "[[minutes" in line and "deeper" not in line
        if is_deeper and (number in core_cells or is_unmarked):
            yield line


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in MASTERS])
def test_a_cell_is_core_or_deeper_and_each_deeper_heading_says_so(path):
    assert list(mixed_and_unmarked(read_script(path).cells)) == []


def test_the_core_of_a_lesson_runs_alone_and_gives_the_stored_outputs():
    """In a kernel: the lesson with the most code that can be left out."""
    masters = [read_master(path) for path in MASTERS]
    code = [sum(cell.deeper for cell in master.cells if cell.kind == "code") for master in masters]
    master = masters[code.index(max(code))]
    assert max(code) > 5
    assert outputs_that_differ(master) == []


def outputs_that_differ(master):
    """The ids of the cells whose output in the core alone is not the one of the stored lesson."""
    core = {cell.id: cell.varies for cell in master.cells if not cell.deeper}
    notebook = lesson_notebook(master)
    notebook.cells = [cell for cell in notebook.cells if cell.id in core]
    execute(notebook, master.path, files=lesson_files(master))
    normalize(notebook, master)
    lesson = nbformat.read(NOTEBOOKS / f"{master.path.stem}.ipynb", as_version=4)
    stored = {cell.id: sorted(output_texts(cell)) for cell in lesson.cells if cell.cell_type == "code"}
    cells = [cell for cell in notebook.cells if cell.cell_type == "code" and not core[cell.id]]
    return [cell.id for cell in cells if sorted(output_texts(cell)) != stored[cell.id]]
