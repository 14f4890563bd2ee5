"""Read a submission: where each answer is, and what is unusual about the notebook.

The commands `check` and `grade` both read submissions here, so that they find the same
answers and report the same findings. Only the sources of cells are taken (see `exercises.page`). Everything
else in a notebook (outputs, kernels, tags) is ignored; a change that matters becomes a finding.
"""

import contextlib
import difflib
import json
import re
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from .. import course
from ..authoring.lesson_names import lesson_name, lessons_named
from ..autograder.sanitize import sanitize_line
from ..exercises.cell_syntax import plain_python, program_lines
from ..exercises.error_advice import advice_on
from ..exercises.page import page_of
from ..exercises.source_remarks import SAYS, STUB_LINE
from . import submission_reader
from .collect import SubmittedFile
from .submission_reader import MOST_CHARACTERS

_MOST_NAMES = 8  # that a finding lists
NOT_READ_IN_TIME = "reading it takes more time or memory than a notebook needs"
_TRIES = 4  # for one request
ONE_LESSON = "a notebook counts for one lesson: submit the others as notebooks of their own"
# No point depends on it.
EQUALS = "it equals the course's solution, whatever the names and numbers; it is public: a reason to ask"
NOT_PYTHON = "of its answer cell is not Python"


class AnswerState(StrEnum):
    """The state of one exercise in a submission, before anything is run."""

    ANSWERED = "answered"
    NOT_ATTEMPTED = "not attempted"  # the stub, as it was handed out
    MISSING = "missing"  # no answer cell
    BROKEN = "broken"  # an answer cell that cannot get its points as it is


@dataclass(frozen=True)
class Finding:
    """Something unusual about an exercise, or about the whole notebook (""), in one line.

    Of the kind "message": for the learner and the instructor; "odd": for the instructor; "hostile": for them,
    what the sandbox refused; "answer": a fault of an answer itself, which grading reports to the learner in
    its own words.
    """

    kind: str
    exercise: str
    text: str


@dataclass
class Submission:
    """What a notebook holds, or the `reason` why it cannot be read; and of one to grade, in which file it is.

    version   of the course, as the notebook says
    page      what is graded (see `exercises.page`), with the answers
    states    {exercise id: AnswerState} of every exercise
    is_page   it is a page of the course that has no answers, such as the index
    deeper    ids of exercises that can be left out, as the notebook says
    shapes    {exercise id: shape of its answer}, see `submission_reader.shapes`
    answered  ids of the exercises with more than a stub
    digests   of its bytes, and of its answers with their `key`; "" for none
    """

    lesson: str | None = None
    version: str | None = None
    page: dict = field(default_factory=lambda: {"answers": {}})
    states: dict = field(default_factory=dict)
    findings: list = field(default_factory=list)
    reason: str = ""
    is_page: bool = False
    deeper: list = field(default_factory=list)
    shapes: dict = field(default_factory=dict)
    file: SubmittedFile = field(default_factory=SubmittedFile)
    answered: frozenset = frozenset()
    file_digest: str = ""
    answers_digest: str = ""
    key: Any = None

    @property
    def answers(self):
        """{exercise id: source of the cell that holds its answer}."""
        return self.page["answers"]

    def add(self, text, exercise="", kind="message"):
        self.findings.append(Finding(kind, exercise, text))

    def texts_about(self, exercise):
        """The texts of the findings about an exercise; about the whole notebook if it is ""."""
        return [finding.text for finding in self.findings if finding.exercise == exercise]


def read_submission(data, versions, reader, name=""):
    """The Submission of a notebook; `versions` are {lesson: the Lessons of all keys or checks files}."""
    notebook, reason = reader.read(data)
    if notebook is None:
        return Submission(lesson=lesson_by_name(name, versions), reason=reason)
    content = Submission(version=notebook["version"], deeper=notebook["deeper"])
    cells = [cell for cell in notebook["cells"] if cell is not None]
    content.lesson = _recognize(notebook, cells, versions, name, content)
    if content.lesson is None:
        # A learner who submits a whole folder submits these too.
        content.is_page = notebook["lesson"] in ("index", "glossary")
        named = f"its lesson, {sanitize_line(notebook['lesson'], 80)!r}," if notebook["lesson"] else "it"
        content.reason = f"{named} is not, or no longer, one of {', '.join(versions)}"
        return content
    # That of the notebook's version, or else the first one.
    lesson = min(versions[content.lesson], key=lambda one: one.version != content.version)
    if content.version != lesson.version:
        version = f"version {content.version[:40]!r}" if content.version else "an unknown version"
        version = f"{sanitize_line(version)} of the lesson, not from version {lesson.version}"
        content.add(f"it was made from {version}")
    answers = _answer_cells(cells, lesson, reader, content)
    for exercise in lesson.exercises:
        content.states[exercise.id] = state = _inspect_answer(exercise, content, *answers[exercise.id])
        for cell in cells if state is AnswerState.NOT_ATTEMPTED else ():
            if cell["type"] != "code" and exercise.function in cell["names"]:
                text = f"its answer is in a text cell ({_place(cell)}), which does not run"
                content.add(f"{text}; make it a code cell (key Y)", exercise.id)
        _compare_given(exercise, cells, lesson, content)
        _report_other_tries(exercise, cells, content)
    python, own = re.match(r"3\.(\d{1,2})\b", notebook["python"] or ""), sys.version_info.minor
    is_no_python = any(NOT_PYTHON in finding.text for finding in content.findings)
    if is_no_python and python and int(python[1]) > own:
        text = f"it was run with Python {python[0]}, and Python 3.{own} grades it, which knows less syntax"
        content.add(text)
    return content


def _answer_cells(cells, lesson, reader, content):
    """{exercise id: (cells that define its function, and not as the stub; those marked as its answer cell)}.

    The first one of all counts. Takes the page.
    """
    asked = [[one.id, one.function, one.stub] for one in lesson.exercises]
    page, places, shapes = reader.page(lesson.cells, asked)
    if page is None:
        content.add("finding out what is graded takes too much time or memory", kind="odd")
        page, places, shapes = page_of({}, lesson), {id: [] for id, *_ in asked}, {}
    content.page, content.shapes = page, shapes
    for file in [cell["file"] for cell in page["cells"] if re.match(r"/|.*\.\.", cell["file"])]:
        content.add(f"it tried to write files ({sanitize_line(file, 80)})", kind="hostile")
    by_number, found = {cell["number"]: cell for cell in cells}, {}
    for exercise in lesson.exercises:
        marked = [cell for cell in cells if _is_marked(cell, exercise, lesson)]
        marked.sort(key=lambda cell: (cell["type"] != "code", cell["id"] != f"answer-{exercise.id}"))
        if exercise.kind.graded_by_person:
            marked.sort(key=lambda cell: (_is_open(cell, exercise) > exercise.figure, cell["by_place"]))
        answers = [by_number[number] for number in places[exercise.id]]
        found[exercise.id] = answers, marked
    return found


def _is_marked(cell, exercise, lesson):
    """Whether a cell is an exercise's, by its marks or, of a new text or figure, by its place."""
    is_new = (cell["type"] == "code") == exercise.figure and cell["id"] not in lesson.cells
    return cell["exercise"] == exercise.id and (is_new or not cell["by_place"])


def _is_open(cell, exercise):
    return (cell["source"] or "").strip() in ("", exercise.stub.strip())


def lesson_by_name(name, lessons):
    """The one lesson that a file's name contains, or None if there is none or more than one."""
    candidates = lessons_named(name, lessons)
    return candidates[0] if len(candidates) == 1 else None


def _recognize(notebook, cells, versions, name, content):
    """The lesson by its metadata if its answer cells agree, by those cells, by its name, or its functions."""
    marked, functions = _signs_of_lessons(cells, versions)
    metadata_lesson = lesson_name(notebook["lesson"] or "")
    claim = metadata_lesson if metadata_lesson in versions else None
    named_lesson = None if metadata_lesson else lesson_by_name(name, versions)
    signs = {"metadata": claim if claim and marked[claim] else None, "answer cells": _most(marked)}
    signs["name"] = claim or named_lesson
    signs["functions"] = None if metadata_lesson else _most(functions)
    sign, lesson = next(((sign, lesson) for sign, lesson in signs.items() if lesson), ("", None))
    if lesson != signs["name"]:
        says = f", and not as {signs['name']}" if signs["name"] else ""
        content.add(f"it was recognized as {lesson} by its {sign}{says}")
    others = [other for other, ids in marked.items() if ids and other != lesson]
    if lesson and marked[lesson] and others:
        content.add(f"it also has answer cells of {', '.join(others)}; {ONE_LESSON}")
    return lesson


def _signs_of_lessons(cells, versions):
    """{lesson: ids of its exercises with an answer cell}, {lesson: its functions that are defined}."""
    marks = {cell["id"] for cell in cells} | {f"answer-{cell['exercise']}" for cell in cells}
    defined = {name for cell in cells for name in cell["names"]}
    marked, functions = {}, {}
    for lesson, several in versions.items():
        entries = [item for one in several for item in one.entries.items()]
        marked[lesson] = {id for id, _ in entries if f"answer-{id}" in marks}
        functions[lesson] = defined & {entry.get("function") for _, entry in entries}
    return marked, functions


def _most(sets):
    """The key whose set is the largest; None if all are empty, or two are equally large."""
    largest = max(map(len, sets.values()), default=0)
    keys = [key for key, values in sets.items() if values and len(values) == largest]
    return keys[0] if len(keys) == 1 else None


def _inspect_answer(exercise, content, answers, marked):
    """Add what is unusual about an exercise's answer, and return its AnswerState."""
    cell = next(iter([*answers, *marked]), None)
    if cell is None:
        content.add(f"its answer cell (answer-{exercise.id}) is missing", exercise.id)
        return AnswerState.MISSING
    if len(cell["source"] or "") > MOST_CHARACTERS:
        content.answers[exercise.id] = cell["source"]
    elif exercise.kind.graded_by_person and cell["source"] is not None:
        is_open = _is_open(cell, exercise)
        content.answers[exercise.id] = exercise.stub if is_open else cell["source"]
        if cell["by_place"] and not is_open:
            text = f"graded from the cell above its check ({_place(cell)}), which is not its answer cell"
            content.add(f"{text} (answer-{exercise.id})", exercise.id)
        return AnswerState.NOT_ATTEMPTED if is_open else AnswerState.ANSWERED
    problem, is_slip = _problem(exercise, cell, answers, marked)
    if problem:
        content.add(problem, exercise.id, "message" if is_slip else "answer")
        return AnswerState.BROKEN
    if cell in marked:
        is_stub = cell["source"].strip() == exercise.stub.strip()
        if not is_stub and exercise.function in cell["answer"]["stub_lines"]:
            content.add(f"{exercise.answer_name}: {STUB_LINE}", exercise.id)
        if is_stub or not answers:
            return AnswerState.NOT_ATTEMPTED
    _report_place(exercise, cell, answers, marked, content)
    for line, code in program_lines(plain_python(cell["source"])):
        text = SAYS["line of a program"].format(line=line, code=sanitize_line(code, 80))
        content.add(text[0].lower() + text[1:].rstrip("."), exercise.id)
    return AnswerState.ANSWERED


def _problem(exercise, cell, answers, marked):
    """(Why an answer cannot get its points, whether a slip may be the cause), ("", False) if it can."""
    source = cell["source"]
    if len(source or "") > MOST_CHARACTERS:
        return f"its answer is longer than {MOST_CHARACTERS} characters, the most that are graded", True
    if not answers and cell["type"] != "code":
        return f"its answer cell is a {_kind(cell)} cell; make it a code cell (key Y)", True
    if source is None:
        return "the source of its answer cell is not text", True
    if cell not in marked or source.strip() == exercise.stub.strip():
        return "", False
    if all(not line or line.startswith("#") for line in map(str.strip, source.splitlines())):
        return "its answer cell is empty", False
    if cell["answer"]["error"]:
        return _syntax_problem(*cell["answer"]["error"]), False
    if exercise.function not in cell["names"]:
        # The function whose name was meant: the only one, or one written nearly so.
        defined = sorted(cell["answer"]["functions"])
        meant = defined if len(defined) == 1 else difflib.get_close_matches(exercise.function, defined, 1)
        name = exercise.kind.name_of(sanitize_line(meant[0], 60)) if meant else ""
        text = f"its answer cell does not define {exercise.answer_name}"
        return text + (f", but {name}; the name must be the one of the task" if name else ""), bool(name)
    return "", False


def _syntax_problem(line, text, message):
    text, message = sanitize_line(text, 80), sanitize_line(message, 100)
    problem = f"line {line} {NOT_PYTHON}: {text} ({message})"
    advice = advice_on("SyntaxError", message, f"line {line}: {text}")
    return f"{problem}. {advice}".rstrip(". ")


def _report_place(exercise, cell, answers, marked, content):
    """Report an answer that does not stand where it was handed out, or not there alone."""
    name = exercise.answer_name
    if not any(one in marked for one in [cell, *answers]):
        missing = "" if marked else f": its answer cell (answer-{exercise.id}) is missing"
        content.add(f"graded from {_place(cell)}, which defines {name}{missing}", exercise.id)
    elif cell["type"] != "code" and cell in marked:
        text = f"its answer cell is a {_kind(cell)} cell; its text is graded"
        content.add(f"{text} (key Y makes it code again)", exercise.id)
    # The answer of another exercise may hold this one again, which it calls.
    others = [one for one in answers[1:] if "answer" not in one or one in marked]
    if others:
        graded, *places = map(_place, [cell, *others[:_MOST_NAMES]])
        text = f"{graded} is graded, and not {', '.join(places)}"
        content.add(f"{len(others) + 1} cells define {name}: {text}", exercise.id)


def _place(cell):
    return f"cell number {cell['number'] + 1}"


def _kind(cell):
    return sanitize_line(cell["type"], 20) or "nameless"


def _compare_given(exercise, cells, lesson, content):
    """Report check and given cells that were changed or removed."""
    cells_by_id = {cell["id"]: cell for cell in reversed(cells)}
    cells_by_source = {(cell.get("source") or "").strip(): cell for cell in reversed(cells)}
    for id, source in sorted(lesson.cells.items()):
        if source is None or not id.startswith((f"check-{exercise.id}-", f"given-{exercise.id}-")):
            continue
        cell = cells_by_id.get(id) or cells_by_source.get(source.strip())  # some tools rewrite ids
        if change := _change(cell, source):
            role = "check cell" if id.startswith("check-") else "given cell"
            content.add(f"its {role} ({id}) {change}; grading uses its own", exercise.id)


def _report_other_tries(exercise, cells, content):
    """Report the check of a function with another name: perhaps the answer that was meant."""
    call = re.compile(
        rf"""^check\(\s*["']{re.escape(exercise.id)}["']\s*,\s*(?!{exercise.function}\b)(\w+)""", re.M
    )
    names = dict.fromkeys(name for cell in cells for name in call.findall(cell.get("source") or ""))
    if names:
        tries = ", ".join(sanitize_line(name, 60) for name in list(names)[:_MOST_NAMES])
        content.add(f"a cell checks {tries}, and {exercise.answer_name} is graded", exercise.id)


def _change(cell, source):
    if cell is None:
        return "is missing"
    if cell["type"] != "code":
        return "is not a code cell any more"
    return "" if (cell["source"] or "").strip() == source.strip() else "was changed"


class NotebookReader(contextlib.AbstractContextManager):
    """The process that reads notebooks; each request has `seconds` of processor time, `memory` bytes."""

    def __init__(self, seconds=60, memory=2 << 30):
        self._arguments = [str(memory), str(seconds), course.name]
        self._process: Any = None  # a Popen, after the first request
        self._last_read = b""

    def read(self, data):
        """(What `submission_reader.read_notebook` makes of bytes, ""), or (None, why they are not read)."""
        self._last_read = data
        reply = self._reply(b"read", data) or {"reason": NOT_READ_IN_TIME}
        return reply.get("notebook"), reply.get("reason", "")

    def page(self, lesson_cells, exercises):
        """What `page.page_of_notebook` gives of the last notebook, and `shapes` of its answers.

        Three None if it takes too much.
        """
        reply = self._reply(b"page", json.dumps([lesson_cells, exercises]).encode("ascii")) or {}
        return reply.get("page"), reply.get("places"), reply.get("shapes")

    def _reply(self, kind, data):
        """The reply to a request, a dict; None if it takes too much, or is ended too often."""
        for _ in range(_TRIES):  # somebody else may end it
            if self._process is None:
                command = [sys.executable, "-I", "-S", "-B", submission_reader.__file__, *self._arguments]
                pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
                self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere)
                if kind == b"page":  # a new process does not know the notebook
                    self._exchange(b"read", self._last_read)
            line = self._exchange(kind, data)
            if line.endswith(b"\n"):
                return json.loads(line)
            if self.close() == -signal.SIGPROF:
                break
        return None

    def _exchange(self, kind, data):
        with contextlib.suppress(OSError):
            self._process.stdin.write(b"%b %d\n%b" % (kind, len(data), data))
            self._process.stdin.flush()
            return self._process.stdout.readline()
        return b""

    def close(self):
        """End the process; returns how it ended, as `Popen.returncode` says it."""
        if self._process is None:
            return None
        process, self._process = self._process, None
        process.kill()
        for stream in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                stream.close()
        return process.wait()

    def __exit__(self, *_error):
        self.close()
