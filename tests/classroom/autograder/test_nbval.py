"""nbval compares: a wrong answer is a cell that it lets fail, ours in grading and stock nbval alike."""

import json
import subprocess
import sys

import pytest
from attacks import LESSON
from nbclassroom.autograder import pool
from nbclassroom.autograder.nbval_plugin import notebook_of
from nbclassroom.autograder.pool import autograde
from nbclassroom.autograder.sandbox.inside import MIME
from nbclassroom.exercises.canonical import encode

pytestmark = pytest.mark.sandbox
PREPARED = """import json
from nbclassroom.autograder.sandbox.inside.check_cell import deliver
deliver(json.loads({!r}))
"""
STOCK = ["-q", "-p", "no:cacheprovider", "-p", "no:randomly", "--nbval", "exercise.ipynb"]


OTHER_OUTPUTS = """
from nbclassroom.autograder import nbval_plugin
outputs_of = nbval_plugin._stored_outputs
def changed_outputs(case):
    outputs = outputs_of(case)
    if case.id == "case-attacked-mean-1":
        call = outputs[0]["data"][nbval_plugin.MIME]["calls"][0]
        CHANGE
    return outputs
nbval_plugin._stored_outputs = changed_outputs
"""


CHANGES = ["outputs = 2 * outputs", "call['value'] = {'type': 'float', 'value': 9.5}"]


@pytest.mark.parametrize("change", CHANGES)
def test_a_cell_that_nbval_lets_fail_costs_its_points(key, right, monkeypatch, change):
    """The values are right, and nbval finds that one output is missing, or that another one is stored."""
    program = OTHER_OUTPUTS.replace("CHANGE", change)
    monkeypatch.setattr(pool, "_PROGRAM", f"{program}\n{pool._PROGRAM}")
    (graded,) = autograde([("one", LESSON, right)], key, workers=1)
    _, mean = graded.exercises
    assert [(case.outcome, case.points) for case in mean.cases] == [("not graded", 0), ("passed", 4)]
    assert mean.cases[0].message.startswith("it is right, but nbval did not let it pass")


def stock_notebook(key, id, source):
    """An exercise's notebook with an answer and the inputs in place, for nbval without our plugin."""
    exercise = key.exercise(id)
    notebook = json.loads(json.dumps(notebook_of(exercise, source)))
    for cell, case in zip(notebook["cells"][-len(exercise.cases) :], exercise.cases, strict=True):
        calls = [encode(call.arguments) for call in case.calls]
        delivered = {"calls": calls, "seconds": exercise.time_limit}
        cell["source"] = PREPARED.format(json.dumps(delivered)) + cell["source"]
    return notebook


def run_stock(notebook, folder):
    (folder / "exercise.ipynb").write_text(json.dumps(notebook))
    run = subprocess.run(
        [sys.executable, "-m", "pytest", *STOCK], cwd=folder, capture_output=True, text=True, check=False
    )
    return run.stdout


@pytest.mark.parametrize("id", ["attacked-double", "attacked-mean"])
def test_stock_nbval_passes_with_the_solution_and_fails_with_one_changed_value(key, tmp_path, id):
    notebook = stock_notebook(key, id, key.solutions(LESSON)[id])
    count = sum(cell["cell_type"] == "code" for cell in notebook["cells"])
    output = run_stock(notebook, tmp_path)
    assert f"{count} passed" in output, output
    (first, *_) = [cell for cell in notebook["cells"] if cell.get("outputs")]
    value = first["outputs"][0]["data"][MIME]["calls"][0]["value"]
    value.update({"value": value["value"] + 1} if "value" in value else {"data": "A" + value["data"][1:]})
    output = run_stock(notebook, tmp_path)
    assert f"1 failed, {count - 1} passed" in output and f"mismatch '{MIME}'" in output, output
