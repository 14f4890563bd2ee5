"""The core of every lesson stands alone: without its deeper sections no cell misses a name."""

import symtable
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent))
from IPython.core.inputtransformer2 import TransformerManager
from needed_cells import names_of

from imgproc_course.classroom.authoring.build import lesson_notebook
from imgproc_course.classroom.authoring.execute import execute
from imgproc_course.classroom.authoring.lesson_files import lesson_files
from imgproc_course.classroom.authoring.masters import find_masters, read_master

MASTERS = find_masters(Path(__file__).parents[2] / "notebooks" / "masters")


def global_names_read(source):
    """The names of other cells that a cell may read: no local variables of its functions."""
    tables = [symtable.symtable(TransformerManager().transform_cell(source), "cell", "exec")]
    names = set()
    for table in tables:
        tables += table.get_children()
        symbols = (symbol for symbol in table.get_symbols() if symbol.is_referenced())
        names |= {
            symbol.get_name() for symbol in symbols if table.get_type() == "module" or symbol.is_global()
        }
    return names


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


def test_the_core_of_a_lesson_runs_alone(tmp_path):
    """In a kernel: the lesson with the most code that can be left out."""
    masters = [read_master(path) for path in MASTERS]
    code = [sum(cell.deeper for cell in master.cells if cell.kind == "code") for master in masters]
    master = masters[code.index(max(code))]
    assert max(code) > 5
    for name, text in lesson_files(master).items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    notebook = lesson_notebook(master, solved=True)
    notebook.cells = [
        cell for cell, of_master in zip(notebook.cells, master.cells, strict=True) if not of_master.deeper
    ]
    execute(notebook, master.path, checks_dir=tmp_path / "checks")
    assert all(cell.execution_count for cell in notebook.cells if cell.cell_type == "code")
