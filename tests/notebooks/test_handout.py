"""What learners get holds no solution and no hidden case: every file is opened, also in the zip file."""

import ast
import json
from pathlib import Path
from textwrap import indent

import pytest
from all_masters import PATHS, all_exercises, all_masters
from handed_out import HandedOut
from nbclassroom.authoring.handout import hand_out

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handout") / "handout"
    _, archive = hand_out(folder, NOTEBOOKS, zipped=True)
    return HandedOut([*folder.rglob("*"), archive])


@pytest.mark.parametrize("lesson", [path.stem[3:] for path in PATHS])
def test_no_file_holds_a_solution_or_a_hidden_case(handed_out, lesson):
    for exercise in all_masters()[lesson].exercises:
        assert list(handed_out.leaks(exercise)) == []


def test_every_file_was_opened(handed_out):
    names = {Path(name).name for name in handed_out.files}
    assert {path.name for path in NOTEBOOKS.glob("*.ipynb")} <= names
    assert {path.name for path in (NOTEBOOKS / "checks").glob("*.json")} <= names
    zipped = [name for name in handed_out.files if ".zip/" in name]
    assert 2 * len(zipped) == len(handed_out.files) > 2 * len(PATHS)


def test_a_leak_would_be_found(tmp_path):
    """The solution as it is, renamed, and without its def line; a hidden case's inputs."""
    exercise = all_exercises()["canny-suppression"]
    tree = ast.parse(exercise.solution)
    renamed = ast.unparse(Renamed().visit(ast.parse(exercise.solution)))
    hidden = exercise.hidden[0]
    leaked = {
        "as it is": exercise.solution,
        "renamed": renamed,
        "in another function": f"def other():\n{indent(renamed, '    ')}\n    print(1)",
        "without def": "\n".join(map(ast.unparse, tree.body[-1].body)),
        "a name": f"{hidden.id} is the hard one",
        "inputs": hidden.source,
    }
    for name, text in leaked.items():
        notebook = {"cells": [{"cell_type": "markdown", "source": f"{text}\n".splitlines(keepends=True)}]}
        path = tmp_path / f"{name}.ipynb"
        path.write_text(json.dumps(notebook))
        assert list(HandedOut([path]).leaks(exercise)), name


class Renamed(ast.NodeTransformer):
    """Gives every variable another name."""

    def visit_Name(self, node):
        return ast.Name(f"{node.id}_2" if node.id not in ("np", "range", "len") else node.id, node.ctx)

    def visit_arg(self, node):
        return ast.arg(f"{node.arg}_2")

    def visit_FunctionDef(self, node):
        node.name += "_2"
        return self.generic_visit(node)
