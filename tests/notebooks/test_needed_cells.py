"""Which cells a test runs of a lesson: those that read something, and those that these need."""

import ast
import sys
from pathlib import Path

import nbformat
import pytest

sys.path.append(str(Path(__file__).parent))
from needed_cells import names_changed, names_of, needed_cells, tree_of
from solved_twin import solved_twin

from imgproc_course.classroom.authoring.masters import find_masters, read_master

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"

IN_A_FUNCTION = "def step(x, dt):\n    y = [x]\n    y.append(dt)\n    path.append(y)\n    return y"


@pytest.mark.parametrize(
    ("source", "read", "bound", "changed"),
    [
        ("y = x + 1", {"x"}, {"y"}, set()),
        (IN_A_FUNCTION, {"path"}, {"step"}, {"path"}),
        ("total = sum(k * k for k in numbers)", {"sum", "numbers"}, {"total"}, set()),
        ("%matplotlib inline\nimport os\nos.environ['A'] = b", {"get_ipython", "os", "b"}, {"os"}, {"os"}),
    ],
)
def test_local_names_of_a_function_are_no_names_of_a_cell(source, read, bound, changed):
    assert names_of(source) == (read, bound)
    assert names_changed(source) - {"get_ipython"} == changed


def test_needed_are_cells_that_bind_or_change_what_is_read():
    sources = ["a = []", "b = 1", "a.append(b)", "c = 2", "a = [c]", "print(a)"]
    names, changes = [names_of(source) for source in sources], [names_changed(source) for source in sources]
    assert needed_cells(names, {5}, changes) == [3, 4, 5]
    assert needed_cells(names[:3] + names[5:], {3}, changes[:3] + changes[5:]) == [0, 1, 2, 3]


@pytest.mark.parametrize("path", find_masters(NOTEBOOKS / "masters"), ids=lambda path: path.stem)
def test_the_solved_twin_holds_every_cell_that_names_an_answer(path, monkeypatch):
    monkeypatch.setattr("solved_twin.passing", lambda exercise, count: None)  # it runs the solution
    master, shipped = read_master(path), nbformat.read(NOTEBOOKS / f"{path.stem}.ipynb", as_version=4)
    answers, naming = {exercise.function for exercise in master.exercises}, set()
    for cell in shipped.cells:
        if cell.cell_type == "code":
            names = (node for node in ast.walk(tree_of(cell.source)) if isinstance(node, ast.Name))
            naming |= {cell.id for name in names if name.id in answers}
    held = {cell.id for cell in solved_twin(master, shipped).cells}
    assert naming <= held and {f"answer-{exercise.id}" for exercise in master.exercises} <= held
