"""Find the cell of a notebook that holds the answer to an exercise, wherever tools and learners put it.

The answer cell has an id, and its metadata name its exercise: the metadata survive when JupyterLab merges or
splits cells, and the id when a tool drops the metadata. If no such cell defines the exercise's function,
another cell may. Of several answer cells, such as a copy below, the one counts that the learner's check used.
"""

import re
from dataclasses import dataclass, replace

from .cell_syntax import (
    BLANK,
    CellDefinitions,
    argument_count,
    bound_names,
    function_definitions,
    plain_python,
)


@dataclass(frozen=True)
class AnswerCell:
    """The `cell` that an answer is taken from, as `submission_reader.read_notebook` describes it."""

    cell: dict
    is_answer: bool  # whether it defines the function, and not as the stub
    own: list  # cells that are marked as the exercise's, by id or metadata
    others: list  # further answers

    @property
    def is_elsewhere(self):
        """Whether it is none of the cells that are marked."""
        return self.cell not in self.own


def find_answer_cell(exercise, cells, lesson):
    """The cell that an answer is taken from.

    A cell that defines the function counts more than the stub; then a marked cell more than another one, code
    more than text, of marked cells the one that the check used, and the last of the others, as after Run All.
    It is None if no cell is marked, and none defines the function.
    """
    mark = f"answer-{exercise.id}"
    own = [cell for cell in cells if cell["id"] == mark or cell["exercise"] == exercise.id]
    own.sort(key=lambda cell: (cell["type"] != "code", cell["id"] != mark))
    others = [cell for cell in _defining(cells, lesson, exercise.function) if cell not in own]
    others.sort(key=lambda cell: (cell["type"] == "code", cell["number"]), reverse=True)
    stub = function_definitions(exercise.stub).get(exercise.function)
    answers = [cell for cell in own if _is_answer(cell, exercise, stub, is_own=True)]
    if len(answers) > 1:
        used = _used_by_check(answers, exercise, cells)
        answers = [used, *(cell for cell in answers if cell is not used)]
    answers += [cell for cell in others if _is_answer(cell, exercise, stub)]
    if answers:
        return AnswerCell(answers[0], True, own, answers[1:])
    stubs = [cell for cell in own if exercise.function in cell["functions"]]
    return next((AnswerCell(cell, False, own, []) for cell in (*stubs, *own, *others)), None)


def _used_by_check(answers, exercise, cells):
    """Of answer cells the one with the highest execution count before the last run of their check.

    Without counts it is the last one. A cell has `count` None if it was not run, or if that is unknown.
    """
    call = re.compile(rf"""\bcheck\(\s*["']{re.escape(exercise.id)}["']""")
    checks = [cell["count"] for cell in cells if cell.get("count") and call.search(cell["source"] or "")]
    candidates = [cell for cell in answers if cell["type"] == "code"] or answers[:1]
    counted = [cell for cell in candidates if cell.get("count")]
    before = [cell for cell in counted if not checks or cell["count"] < max(checks)]
    return max(before or counted or candidates, key=lambda cell: (cell.get("count") or 0, cell["number"]))


def requests_to_compose(answered):
    """The arguments of `CellDefinitions.compose` for {exercise: the cell of its answer}; lists."""
    preferred, requests = {exercise.function: cell["number"] for exercise, cell in answered.items()}, []
    for exercise, cell in answered.items():
        given = sorted({"np"}.union(*map(bound_names, exercise.given)))
        count = argument_count(exercise.stub, exercise.function)
        requests.append([cell["number"], exercise.function, given, preferred, count])
    return requests


@dataclass(frozen=True)
class ComposedAnswer:
    """The source by which an answer is graded; `taken` is a tuple of Taken, what it reads of other cells.

    `left_out` are (name, call) of calls in other cells that may change what it reads; grading runs none.
    """

    function: str
    source: str
    taken: tuple = ()
    left_out: tuple = ()


def compose_answer(lesson, exercise_id, function, cells):
    """The ComposedAnswer by which an exercise of a lesson is graded; None if no cell defines the function.

    Another function than the one that the exercise asks for is another try.
    """
    answers = {}
    for exercise in lesson.exercises:
        exercise = replace(exercise, function=function) if exercise.id == exercise_id else exercise
        answers[exercise] = find_answer_cell(exercise, cells, lesson)
    answered = {exercise: found.cell for exercise, found in answers.items() if found and found.is_answer}
    for exercise, request in zip(answered, requests_to_compose(answered), strict=True):
        if exercise.id == exercise_id:
            definitions = CellDefinitions([plain_python(cell["source"]) for cell in cells])
            source, taken, _ = definitions.compose(*request)
            calls = definitions.calls_left_out(request[0], taken)
            return ComposedAnswer(function, source, taken, tuple((name, call) for name, *_, call in calls))
    return None


def _is_answer(cell, exercise, stub, is_own=False):
    """Whether a cell defines the function, and not as the stub.

    A marked cell may define it in any way, or so that reading does not find out.
    """
    if exercise.function in cell["functions"]:
        digest = cell["functions"][exercise.function]
        return digest != BLANK and (not digest or digest != stub)
    if not is_own or cell["type"] != "code" or "answer" not in cell or not (cell["source"] or "").strip():
        return False
    names = cell["answer"]["names"]
    return not cell["answer"]["error"] and (names is None or exercise.function in names)


def _defining(cells, lesson, function):
    """The cells that define a function; if one did when the lesson was handed out, it is no answer."""
    named = {id: text for id, text in lesson.cells.items() if text and function in text}
    sources = {id: text.strip() for id, text in named.items() if function in function_definitions(text)}
    cells = [cell for cell in cells if function in cell["functions"] and cell["id"] not in sources]
    return [cell for cell in cells if (cell["source"] or "").strip() not in sources.values()]
