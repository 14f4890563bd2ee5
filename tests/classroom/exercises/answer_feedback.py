"""What `check` says to a recorded wrong answer: the answer runs as a learner's cell would.

That is after the lesson's earlier cells, as far as the answer reads their names, and after the stub.
"""

import ast
import re
from functools import cache

from nbclassroom.exercises import CheckResult
from nbclassroom.exercises.checking import run_check
from nbclassroom.exercises.lesson import check_data_of
from nbclassroom.exercises.names_read import CellRuns
from nbclassroom.exercises.percent_script import read_script
from nbclassroom.exercises.source_remarks import SAYS
from readable_cell import run_cell

# Lines of the feedback that hold values, titles or points, and no sentence about the mistake.
_NO_SENTENCE = re.compile(
    r"[✓✗] |Points here|Practice:|Stuck\?|\s+(given|returned|expected)\b[^:]*: |\s+in your line"
    r"|(\s*(True|False|nan|inf|-?[\d.e+-]+|[(),]|\*))*$"
    r"|\s+(In answer\S*: )?(\d+ of \d+ values differ|Expected the (integer|float) \S+, got the \6 )"
)


@cache
def lesson_statements(master, exercise_id):
    """The top-level statements of the plain cells before the answer, with the names that they bind."""
    statements = []
    for cell in read_script(master).cells:
        if cell.role == "answer" and exercise_id in cell.options.get("exercise", exercise_id):
            break
        if cell.kind == "code" and not cell.role:
            statements += [(statement, bound_by(statement)) for statement in ast.parse(cell.source).body]
    return statements


def bound_by(statement):
    """The names that a statement binds, also in its inner functions."""
    if isinstance(statement, (ast.Import, ast.ImportFrom)):
        return {(alias.asname or alias.name).split(".")[0] for alias in statement.names}
    nodes = list(ast.walk(statement))
    stored = {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    return stored | ({statement.name} if isinstance(statement, ast.FunctionDef) else set())


def free_names(tree):
    """The names that a tree reads and does not bind itself."""
    read = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    arguments = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
    definitions = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    return read - bound_by(tree) - arguments - definitions


def add_earlier_names(namespace, source, statements):
    """Run those earlier statements whose names the source reads, directly or through one another.

    What needs ROS is left out.
    """
    unknown, chosen = free_names(ast.parse(source)) - namespace.keys(), []
    for statement, bound in reversed(statements):
        if bound & unknown and getattr(statement, "module", None) != "imgproc_course.ros":
            chosen.append(statement)
            unknown |= free_names(statement)
    for statement in reversed(chosen):
        try:
            exec(compile(ast.Module([statement], []), "<earlier cell>", "exec"), namespace)
        except Exception:  # noqa: BLE001 - a cell that needs a camera: its names stay unknown
            continue


def feedback_on(exercise, answer, *, searches=True):
    """(CheckResult, the sentences of its text) for one wrong answer; see `run_check`."""
    namespace = exercise.namespace()
    run_cell(exercise.stub, namespace, f"<stub of {exercise.id}>")
    runs = CellRuns()
    runs.start(exercise.stub, exercise.id)
    runs.start(answer.source, exercise.id)
    try:
        add_earlier_names(namespace, answer.source, lesson_statements(exercise.master, exercise.id))
        run_cell(answer.source, namespace, f"<{exercise.id}: {answer.name}>")
    except Exception as error:  # noqa: BLE001 - a cell that does not run: the stub is still there
        runs.fail(error)
    function = namespace[exercise.function]
    result = run_check(check_data_of(exercise), function, searches=searches)
    if why := runs.why_gone(exercise.function):
        why_older = SAYS["gone"].format(name=exercise.answer_name, why=why)
        result = CheckResult(result.exercise, attempted=True, why_older=why_older)
    return result, sentences(repr(result), exercise.id)


def sentences(text, exercise_id):
    """The sentences of a feedback's text."""
    text = text.removeprefix(f"{exercise_id}: ")
    text = re.sub(r"(Your function printed:)\n(    .*\n)+", r"\1\n", text)
    text = re.sub(r"(these checks pass)\. Look at .*: ", r"\1: ", text)  # it quotes the learner's code
    lines = text.splitlines()
    if re.match(r"\d+ of \d+ checks? pass", lines[0]):
        lines = lines[1:]
    return "\n".join(line for line in lines if not _NO_SENTENCE.match(line))
