"""The solved twin of a lesson with the outputs that are known without executing it.

The lessons do not need the learner's answers: a cell that reads nothing of them shows in the twin what it
shows in the lesson as shipped, where it was executed. So the twin holds the answers, the cells that read
something of them, and what these need; nbval executes it once.
"""

import re

from cells_of_ros import names_from
from IPython.core.formatters import DisplayFormatter
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.exercises.checking import run_cases
from nbformat.v4 import new_output
from needed_cells import names_changed, names_imported, names_of, needed_cells

STARTS_ROBOT = {"open_camera"}  # other cells of ROS use the robot by its topics, not by a name
ROS = ("imgproc_course.ros", "rclpy")
IGNORED = "nbval-ignore-output"
PASSES = re.compile(r"[\w-]+: (the check passes|both checks pass|all \d+ checks pass)\.\n")
# Methods that change the value of a name
IN_PLACE = (
    *("add", "append", "clear", "discard", "extend", "fill", "insert", "pop", "popitem"),
    *("put", "remove", "resize", "reverse", "setdefault", "sort", "update"),
)


def solved_twin(master, shipped):
    """The solved twin of a lesson for nbval.

    Its check cells hold the outputs of checks that pass, the others those of the lesson as shipped.
    Cells that read something of an answer are tagged: nbval executes them and does not compare them.

    Parameters
    ----------
    master : Master
    shipped : NotebookNode, the lesson as shipped

    Returns
    -------
    NotebookNode
    """
    twin, of_answers, chosen, names = lesson_notebook(master, solved=True), set(), set(), []
    exercises = {exercise.id: exercise for exercise in master.exercises}
    triples = zip(twin.cells, master.cells, shipped.cells, strict=True)
    twin.cells = []
    for cell, master_cell, shipped_cell in triples:
        if cell.cell_type != "code":
            continue
        number = len(twin.cells)
        twin.cells.append(cell)
        names.append(names_of(cell.source))
        read, bound = names[-1]
        cell.execution_count, cell.outputs = shipped_cell.execution_count, shipped_cell.outputs
        exercise = exercises.get(master_cell.exercise)
        if master_cell.role == "check" and not exercise.kind.graded_by_person:
            # What nbval does not compare, only passes in its run: see `assert_passing`.
            is_compared = IGNORED not in cell.metadata.get("tags", ())
            cell.outputs = [passing(exercise, cell.execution_count)] if is_compared else []
            chosen.add(number)
        elif master_cell.role == "answer" or read & of_answers:
            of_answers |= bound | names_changed(cell.source, IN_PLACE)
            chosen.add(number)
            cell.metadata.tags = list(dict.fromkeys([*cell.metadata.get("tags", ()), IGNORED]))
        else:
            of_answers -= bound
    sources = [cell.source for cell in twin.cells]
    modules = set().union(*map(names_imported, sources))
    changes = [names_changed(source) - modules for source in sources]
    needed = needed_cells(names, chosen, changes)
    uses_robot = set().union(*(names_from(ROS, source) for source in sources)) - {"ros_available"}
    if any(names[number][0] & uses_robot for number in needed):
        chosen |= {number for number, (read, _) in enumerate(names) if read & STARTS_ROBOT}
        needed = needed_cells(names, chosen, changes)
    twin.cells = [twin.cells[number] for number in needed]
    return twin


def passing(exercise, count):
    """The output of a check that passes."""
    result = run_cases(exercise, exercise.function_of(exercise.solution, "solution"))
    assert PASSES.match(repr(result)), repr(result)
    data, metadata = DisplayFormatter().format(result)
    return new_output("execute_result", data=data, metadata=metadata, execution_count=count)


def assert_passing(twin, outputs):
    """In nbval's run, the checks of a twin that it does not compare pass; outputs: {cell id: outputs}."""
    for cell in twin.cells:
        if cell.id.startswith("check-") and not cell.outputs:
            (result,) = outputs[cell.id]
            assert PASSES.match(result.data["text/plain"]), result.data["text/plain"]
