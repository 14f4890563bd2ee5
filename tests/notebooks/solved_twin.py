"""The solved twin of a lesson with the outputs that are known without executing it.

The lessons do not need the learner's answers: a cell that reads nothing of them shows in the twin what it
shows in the lesson as shipped. So one execution, by nbval, is enough to compare a twin.
"""

import ast
import re

from IPython.core.formatters import DisplayFormatter
from IPython.core.inputtransformer2 import TransformerManager
from nbformat.v4 import new_output

from imgproc_course.classroom.authoring.build import lesson_notebook
from imgproc_course.classroom.exercises.checking import run_cases

IGNORED = "nbval-ignore-output"
PASSES = re.compile(r"[\w-]+: (the check passes|both checks pass|all \d+ checks pass)\.\n")


def names_of(source):
    """The names that a cell reads, and those that it binds."""
    read, bound = set(), set()
    for node in ast.walk(ast.parse(TransformerManager().transform_cell(source))):
        if isinstance(node, ast.Name):
            (read if isinstance(node.ctx, ast.Load) else bound).add(node.id)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            bound.add(node.name)
        elif isinstance(node, ast.alias):
            bound.add((node.asname or node.name).partition(".")[0])
    return read, bound


def solved_twin(master, shipped):
    """The solved twin of a lesson for nbval.

    Its check cells hold the outputs of checks that pass, and other cells those of the lesson as shipped.
    Cells that read something of an answer are tagged: nbval executes them and does not compare them.

    Parameters
    ----------
    master : Master
    shipped : NotebookNode, the lesson as shipped

    Returns
    -------
    NotebookNode
    """
    twin, of_answers = lesson_notebook(master, solved=True), set()
    exercises = {exercise.id: exercise for exercise in master.exercises}
    for cell, master_cell, shipped_cell in zip(twin.cells, master.cells, shipped.cells, strict=True):
        if cell.cell_type != "code":
            continue
        cell.execution_count, cell.outputs = shipped_cell.execution_count, shipped_cell.outputs
        if master_cell.role == "check":
            cell.outputs = [passing(exercises[master_cell.exercise], cell.execution_count)]
            continue
        read, bound = names_of(cell.source)
        if master_cell.role == "answer" or read & of_answers:
            of_answers |= bound
            cell.metadata.tags = [*cell.metadata.get("tags", ()), IGNORED]
        else:
            of_answers -= bound
    return twin


def passing(exercise, count):
    """The output of a check that passes."""
    result = run_cases(exercise, exercise.function_of(exercise.solution, "solution"))
    assert PASSES.match(repr(result)), repr(result)
    data, metadata = DisplayFormatter().format(result)
    return new_output("execute_result", data=data, metadata=metadata, execution_count=count)
