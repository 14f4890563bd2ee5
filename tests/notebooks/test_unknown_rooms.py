"""The lesson on unknown rooms: its baseline is the file that learners get."""

import ast
from pathlib import Path

from nbclassroom.authoring.masters import read_master

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"


def functions_of(source):
    """{name: its arguments and statements} of the functions at the top of a source."""
    return {
        node.name: (ast.unparse(node.args), [ast.unparse(statement) for statement in node.body])
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef)
    }


def test_the_baseline_in_the_lesson_is_the_shipped_controller():
    master = read_master(NOTEBOOKS / "masters" / "22_unknown_rooms.py")
    cells = [functions_of(cell.source) for cell in master.cells if cell.source.startswith("def baseline")]
    (in_lesson,) = cells
    shipped = functions_of((NOTEBOOKS / "controllers" / "baseline.py").read_text("utf-8"))
    (exercise,) = (exercise for exercise in master.exercises if exercise.id == "unknown-drive")
    assert shipped["control"] == in_lesson["baseline"] == functions_of(exercise.stub)["control"]
