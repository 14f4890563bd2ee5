"""Read a submission: where each answer is, and what is unusual about the notebook.

`imgproc-course check` and `imgproc-course grade` both read submissions here, so that they find the same
answers and report the same findings. Only the source of answer cells is taken. Everything else in a
notebook (check cells, outputs, metadata, kernels, tags) is ignored; a change that matters becomes a
finding.
"""

import contextlib
import json
import resource
import select
import subprocess
import sys
import time
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from imgproc_course.authoring.lesson_names import lesson_name, lessons_named
from imgproc_course.autograder.sanitize import sanitize_line
from imgproc_course.gradebook.submission_reader import MOST_CHARACTERS, function_names, syntax_digest

SECONDS = 60  # for reading one notebook
MEMORY = 2 << 30  # bytes, of the process that reads notebooks
NOT_READ_IN_TIME = "reading it takes more time or memory than a notebook needs"
_READER = Path(__file__).with_name("submission_reader.py")
_LONGEST_PREDICTION = 1_000  # characters
_GRADER_COMMENTS = ("# NBVAL_", "# PYTEST_VALIDATE_")


class AnswerState(StrEnum):
    """The state of one exercise in a submission, before anything is run."""

    ANSWERED = "answered"
    NOT_ATTEMPTED = "not attempted"  # the stub, as it was handed out
    MISSING = "missing"  # no answer cell
    BROKEN = "broken"  # an answer cell that cannot get its points as it is


@dataclass(frozen=True)
class Finding:
    """Something unusual about a submission.

    kind      "message": for the learner and the instructor
              "answer": a fault of an answer itself; grading reports it to the learner in its own words
              "odd": for the instructor
    exercise  its id, or "" for the whole notebook
    text      one line
    """

    kind: str
    exercise: str
    text: str


PAGES = ("index", "glossary")  # a learner who submits a whole folder submits these too


@dataclass
class SubmissionContent:
    """What a notebook holds.

    lesson    its name, or None if it is unknown
    version   str or None, of the course, as the notebook says
    answers   {exercise id: source}
    states    {exercise id: AnswerState}, one for every exercise of the lesson
    findings  list of Finding
    claims    exercise ids whose stored outputs say that every check passes
    predictions  {cell id: source}, what the learner predicted
    reason    why the notebook cannot be read, or ""
    is_page   it is a page of the course that has no answers, such as the index
    """

    lesson: str | None = None
    version: str | None = None
    answers: dict = field(default_factory=dict)
    states: dict = field(default_factory=dict)
    findings: list = field(default_factory=list)
    claims: list = field(default_factory=list)
    predictions: dict = field(default_factory=dict)
    reason: str = ""
    is_page: bool = False

    def add(self, text, exercise="", kind="message"):
        """Add a finding."""
        self.findings.append(Finding(kind, exercise, text))

    def texts_about(self, exercise):
        """The texts of the findings about an exercise; about the whole notebook if it is ""."""
        return [finding.text for finding in self.findings if finding.exercise == exercise]


class NotebookReader:
    """The process that reads notebooks. It starts when it is needed, and again if a notebook has ended it.

    Parameters
    ----------
    seconds : float, for reading one notebook
    memory : int, bytes
    cpu_seconds : int, for all notebooks together, or None; on a busy machine they take longer
    """

    def __init__(self, seconds=SECONDS, memory=MEMORY, cpu_seconds=None):
        self._seconds, self._memory, self._cpu_seconds = seconds, memory, cpu_seconds
        self._process = None

    def read(self, data):
        """Read a notebook.

        Parameters
        ----------
        data : bytes

        Returns
        -------
        (dict as `submission_reader.read_notebook` returns it, ""), or (None, the reason)
        """
        for _ in range(2):  # somebody else may have ended the process
            line = self._reply(data)
            if line.endswith(b"\n"):
                reply = json.loads(line)
                return reply.get("notebook"), reply.get("reason", "")
            self.close()
        return None, NOT_READ_IN_TIME

    def _reply(self, data):
        """The process's line; b"" or a part of it if the process ended or takes too long."""
        if self._process is None:
            self._start()
        with contextlib.suppress(OSError):
            return self._exchange(data)
        return b""

    def _exchange(self, data):
        stdin, stdout = self._process.stdin, self._process.stdout
        stdin.write(b"%d\n" % len(data))
        stdin.write(data)
        stdin.flush()
        end, line = time.monotonic() + self._seconds, b""
        while not line.endswith(b"\n"):
            readable, _, _ = select.select([stdout], [], [], max(0.0, end - time.monotonic()))
            chunk = stdout.read1(1 << 20) if readable else b""
            if not chunk:
                break
            line += chunk
        return line

    def _start(self):
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", "-B", str(_READER), str(self._memory)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        if self._cpu_seconds:
            limits = (self._cpu_seconds, self._cpu_seconds)
            resource.prlimit(self._process.pid, resource.RLIMIT_CPU, limits)

    def close(self):
        """End the process."""
        if self._process is None:
            return
        process, self._process = self._process, None
        process.kill()
        for stream in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                stream.close()
        process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()


def read_submission(data, catalog, reader, name=""):
    """Read a submission and inspect it.

    Parameters
    ----------
    data : bytes of the notebook
    catalog : AnswerKeys (for `grade`) or CheckFileCatalog (for `check`), the lessons that it can be
    reader : NotebookReader
    name : str, the file's name, which may name the lesson

    Returns
    -------
    SubmissionContent
    """
    notebook, reason = reader.read(data)
    if notebook is None:
        return SubmissionContent(lesson=lesson_by_name(name, catalog.lessons), reason=reason)
    content = SubmissionContent(version=notebook["version"])
    cells = [cell for cell in notebook["cells"] if cell is not None]
    content.lesson = _recognize(notebook, cells, catalog, name, content)
    if content.lesson is None:
        content.is_page = notebook["lesson"] in PAGES
        claim = (
            f"; it says that it is {sanitize_line(notebook['lesson'], 80)!r}" if notebook["lesson"] else ""
        )
        content.reason = f"it is not one of the lessons {', '.join(catalog.lessons)}{claim}"
        return content
    content.predictions = {
        cell["id"]: cell["source"][:_LONGEST_PREDICTION]
        for cell in cells
        if cell["id"].startswith(f"predict-{content.lesson}-") and cell["source"]
    }
    lesson = catalog.describe(content.lesson, content.version)
    _inspect_notebook(notebook, cells, lesson, content)
    for exercise in lesson.exercises:
        content.states[exercise.id] = _inspect_answer(exercise, cells, lesson, content)
        _compare_given(exercise, cells, lesson, content)
    return content


def lesson_by_name(name, lessons):
    """The one lesson that a file's name contains, or None if there is none or more than one.

    Parameters
    ----------
    name : str
    lessons : iterable of str
    """
    candidates = lessons_named(name, lessons)
    return candidates[0] if len(candidates) == 1 else None


def _recognize(notebook, cells, catalog, name, content):
    """The lesson by its metadata if its answer cells agree, by its answer cells, or by its file name."""
    ids = {cell["id"] for cell in cells}
    metadata_lesson = lesson_name(notebook["lesson"] or "")
    claim = metadata_lesson if metadata_lesson in catalog.lessons else None
    if claim and ids & catalog.answer_ids(claim):
        return claim
    counts = {lesson: len(ids & catalog.answer_ids(lesson)) for lesson in catalog.lessons}
    best = max(counts, key=counts.get, default=None)
    if best is None or not counts[best]:
        return claim or (None if metadata_lesson else lesson_by_name(name, catalog.lessons))
    if claim:
        text = f"it says that it is {claim}, but its answer cells are those of {best}"
        content.add(f"{text}; it is graded as {best}")
    return best


def _inspect_notebook(notebook, cells, lesson, content):
    if content.version != lesson.version:
        version = f"version {content.version[:40]!r}" if content.version else "an unknown version"
        content.add(
            f"it was made from {sanitize_line(version)} of the lesson, not from version {lesson.version}"
        )
    if len(cells) < len(notebook["cells"]):
        content.add(f"{len(notebook['cells']) - len(cells)} of its cells are not cells", kind="odd")
    if notebook["kernel"] not in (None, "python3"):
        kernel = sanitize_line(notebook["kernel"], 60)
        content.add(f"it asks for the kernel {kernel!r}; grading uses its own", kind="odd")


# ---------------------------------------------------------------- answers


def _inspect_answer(exercise, cells, lesson, content):
    """Take an exercise's answer, add what is unusual about it, and return its AnswerState."""
    positions = [position for position, cell in enumerate(cells) if cell["id"] == exercise.answer_id]
    if not positions:
        place = _place_of_definition(exercise, cells, lesson)
        text = f"its answer cell ({exercise.answer_id}) is missing"
        if place:
            text += f"; {exercise.function}() is defined in another cell ({place}), which is not graded"
        content.add(text, exercise.id)
        return AnswerState.MISSING
    code = [position for position in positions if cells[position]["type"] == "code"]
    if len(positions) > 1:
        text = f"its answer cell ({exercise.answer_id}) occurs {len(positions)} times"
        content.add(f"{text}; the first code cell of them is graded", exercise.id)
    if not code:
        kind = sanitize_line(cells[positions[0]]["type"], 20) or "nameless"
        content.add(f"its answer cell is a {kind} cell; make it a code cell (key Y)", exercise.id)
        return AnswerState.BROKEN
    cell = cells[code[0]]
    if cell["source"] is None:
        content.add("the source of its answer cell is not text", exercise.id)
        return AnswerState.BROKEN
    content.answers[exercise.id] = cell["source"]
    if cell["grader_tags"] or any(comment in cell["source"] for comment in _GRADER_COMMENTS):
        text = "its answer cell has tags or comments that direct a grader; they are ignored"
        content.add(text, exercise.id, "odd")
    state = _inspect_source(exercise, cell, cells, lesson, content)
    if state in (AnswerState.ANSWERED, AnswerState.NOT_ATTEMPTED):
        _inspect_next_cell(exercise, cells[code[0] + 1 : code[0] + 2], lesson, content)
    return AnswerState.BROKEN if len(code) > 1 else state


def _inspect_source(exercise, cell, cells, lesson, content):
    source, syntax = cell["source"], cell["answer"]
    if len(source) > MOST_CHARACTERS:
        text = f"its answer is longer than {MOST_CHARACTERS} characters, the most that are graded"
        content.add(text, exercise.id, "answer")
        return AnswerState.BROKEN
    if _is_stub(source, syntax, exercise.stub):
        return AnswerState.NOT_ATTEMPTED
    if not _has_code(source):
        _add_undefined("its answer cell is empty", exercise, cells, lesson, content)
        return AnswerState.BROKEN
    if syntax["error"]:
        line, text, message = syntax["error"]
        text = f"line {line} of its answer cell is not Python: {sanitize_line(text, 80)}"
        text += f" ({sanitize_line(message, 100)})"
        content.add(text, exercise.id, "answer")
        return AnswerState.BROKEN
    if syntax["names"] is not None and exercise.function not in syntax["names"]:
        text = f"its answer cell does not define {exercise.function}()"
        _add_undefined(text, exercise, cells, lesson, content)
        return AnswerState.BROKEN
    return AnswerState.ANSWERED


def _is_stub(source, syntax, stub):
    same_text = source.strip() == stub.strip()
    return same_text or (syntax["digest"] is not None and syntax["digest"] == syntax_digest(stub))


def _has_code(source):
    return any(line.strip() and not line.strip().startswith("#") for line in source.splitlines())


def _add_undefined(text, exercise, cells, lesson, content):
    place = _place_of_definition(exercise, cells, lesson)
    if place:
        text += (
            f"; cell {place} defines {exercise.function}(), which is not graded: was the answer cell split?"
        )
        text += " Join the two (Edit > Merge Cells)"
    content.add(text, exercise.id, "message" if place else "answer")


def _inspect_next_cell(exercise, next_cells, lesson, content):
    """Report functions in a learner's cell directly below the answer: perhaps the answer needs them."""
    for cell in next_cells:
        if lesson.cells and cell["id"] not in lesson.cells and cell.get("functions"):
            names = ", ".join(f"{sanitize_line(name, 60)}()" for name in cell["functions"][:3])
            text = f"a cell below its answer cell defines {names}; only the answer cell is graded"
            content.add(text, exercise.id)


def _place_of_definition(exercise, cells, lesson):
    """The id of a cell that defines the exercise's function where it is not graded; "" if there is none."""
    for cell in cells:
        own = cell["id"].startswith("answer-") or _defines(lesson, cell["id"], exercise.function)
        if not own and exercise.function in cell.get("functions", ()):
            return sanitize_line(cell["id"], 80) or "without an id"
    return ""


def _defines(lesson, id, function):
    """Whether the lesson as it was handed out defines a function in this cell."""
    if not lesson.cells:
        return id.startswith("given-")
    return function in function_names(lesson.cells.get(id) or "")


# ---------------------------------------------------------------- cells of the lesson


def _compare_given(exercise, cells, lesson, content):
    """Report check and given cells that were changed or removed, and collect what check cells claim."""
    cells_by_id = {}
    for cell in cells:
        cells_by_id.setdefault(cell["id"], cell)
    for id, source in sorted(lesson.cells.items()):
        if source is None or not id.startswith((f"check-{exercise.id}-", f"given-{exercise.id}-")):
            continue
        change = _change(cells_by_id.get(id), source)
        if change:
            role = "check cell" if id.startswith("check-") else "given cell"
            content.add(f"its {role} ({id}) {change}; grading uses its own", exercise.id)
    outputs = (cell["output"] for id, cell in cells_by_id.items() if id.startswith(f"check-{exercise.id}-"))
    if _claims_to_pass(exercise.id, "\n".join(outputs)):
        content.claims.append(exercise.id)


def _change(cell, source):
    if cell is None:
        return "is missing"
    if cell["type"] != "code":
        return "is not a code cell any more"
    return "" if (cell["source"] or "").strip() == source.strip() else "was changed"


def _claims_to_pass(exercise_id, output):
    starts = (f"{exercise_id}: the check passes", f"{exercise_id}: all ")
    return any(
        line.startswith(starts) and line.rstrip(".").endswith(("passes", "pass"))
        for line in output.splitlines()
    )
