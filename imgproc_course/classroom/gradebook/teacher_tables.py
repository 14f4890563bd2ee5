"""Tables that a teacher writes: decisions by hand, and extensions of the deadline.

They are CSV files in UTF-8 with a row of column names, as every spreadsheet writes them; a comma, a semicolon
or a tab separates the cells. A line that begins with # is a comment.
"""

import csv
import difflib
import io
import unicodedata
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from imgproc_course.classroom.authoring.lesson_names import lesson_name
from imgproc_course.classroom.autograder.sanitize import sanitize_line, without_apostrophes

_LARGEST = 10_000_000  # bytes
DECISION_COLUMNS = ("learner", "lesson", "exercise", "points", "comment")
_EXTENSION_COLUMNS = ("learner", "lesson", "deadline")
DECISIONS_TEMPLATE = f"""\ufeff{",".join(DECISION_COLUMNS)}
"# One row per decision. Empty exercise: the whole lesson. Points: a number, excused, or empty for a comment."
"""


class TeacherTableError(ValueError):
    """A table has a mistake; one line with the file, the row and the remedy."""


@dataclass(frozen=True)
class Decision:
    """A teacher's decision on an exercise, or on a whole lesson.

    exercise  its id; "" for the whole lesson
    points    int or float; None if it is excused, or if there is only a comment
    place     the file and the row, for errors
    """

    learner: str
    lesson: str
    exercise: str
    points: float | None
    excused: bool
    comment: str
    place: str


@dataclass(frozen=True)
class Extension:
    """Another deadline for a learner; `lesson` is "" for all lessons."""

    learner: str
    lesson: str
    deadline: datetime
    place: str


def read_decisions(path, answer_keys):
    """Read a teacher's decisions.

    Parameters
    ----------
    path : Path
    answer_keys : AnswerKeys, which know the lessons and exercises

    Returns
    -------
    list of Decision

    Raises
    ------
    TeacherTableError : a row has a mistake
    """
    decisions, places = [], {}
    for row, place in _rows(path, DECISION_COLUMNS, required=("learner", "lesson", "points")):
        lesson = _lesson(row["lesson"], answer_keys, place)
        exercise = _exercise(row["exercise"], lesson, answer_keys, place)
        points, excused = _points(row["points"], lesson, exercise, place)
        if points is None and not excused and not row["comment"]:
            raise TeacherTableError(f"{place}: it decides nothing; give points, excused, or a comment")
        target = (row["learner"], lesson.name, exercise.id if exercise else "")
        if target in places:
            raise TeacherTableError(f"{place}: the same as {places[target]}; remove one of them")
        places[target] = place
        decisions.append(Decision(*target, points, excused, row["comment"], place))
    return decisions


def read_extensions(path, answer_keys):
    """Read extensions of the deadline.

    Parameters
    ----------
    path : Path
    answer_keys : AnswerKeys

    Returns
    -------
    list of Extension

    Raises
    ------
    TeacherTableError : a row has a mistake
    """
    extensions = []
    for row, place in _rows(path, _EXTENSION_COLUMNS, required=("learner", "deadline")):
        lesson = _lesson(row["lesson"], answer_keys, place).name if row["lesson"] else ""
        try:
            deadline = datetime.fromisoformat(row["deadline"])
        except ValueError as error:
            text = f"the deadline is {sanitize_line(row['deadline'], 40)!r}"
            raise TeacherTableError(f"{place}: {text}; write it like 2026-12-01T23:59") from error
        deadline = deadline.astimezone().replace(tzinfo=None) if deadline.tzinfo else deadline
        extensions.append(Extension(row["learner"], lesson, deadline, place))
    return extensions


def by_learner(rows, names):
    """Assign the rows of a table to learners.

    Parameters
    ----------
    rows : list of Decision or of Extension
    names : dict {name or anonymous id: the learner's name, or None: this person's rows are left out}

    Returns
    -------
    {learner's name: list of rows}

    Raises
    ------
    TeacherTableError : nobody has that name
    """
    assigned = {}
    for row in rows:
        # An apostrophe keeps a spreadsheet from taking a name, or a part of it, for a formula.
        written = (row.learner, row.learner.removeprefix("'"), without_apostrophes(row.learner))
        name = next((text for text in written if text in names), None)
        if name is None:
            raise TeacherTableError(f"{row.place}: there is no learner {_unknown(row.learner, names)}")
        if names[name] is not None:
            assigned.setdefault(names[name], []).append(row)
    return assigned


def _unknown(learner, names):
    similar = difflib.get_close_matches(learner, names, 1)
    if similar:
        return f"{_quoted(learner)}; did you mean {similar[0]!r}?"
    examples = ", ".join(sorted({name for name in names.values() if name})[:3])
    text = f"{_quoted(learner)}; write the name of the folder or file that was submitted ({examples}, ...)"
    return f"{text}, or give the --roster that has those who submitted nothing"


def _rows(path, columns, required):
    """({column: cell}, "file, row 3") of each row that is not empty and no comment."""
    text = _text(path)
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=_delimiter(text))
    header = None
    try:
        for cells in lines:
            cells = [unicodedata.normalize("NFC", cell.strip()) for cell in cells]
            if not any(cells) or cells[0].startswith("#"):
                continue
            if header is None:
                header = _header(path, cells, columns, required)
                continue
            place = f"{path}, row {lines.line_num}"
            if len(cells) > len(header) and any(cells[len(header) :]):
                text = f"{len(cells)} cells, expected {len(header)}; put a text with commas in quotes"
                raise TeacherTableError(f"{place}: {text}")
            row = dict.fromkeys(columns, "") | dict(zip(header, cells, strict=False))
            missing = [name for name in required if name != "points" and not row[name]]
            if missing:
                raise TeacherTableError(f"{place}: the cell {missing[0]} is empty")
            yield row, place
    except csv.Error as error:
        raise TeacherTableError(f"{path}, row {lines.line_num}: it is not CSV ({error})") from error


def _text(path):
    try:
        data = Path(path).read_bytes()
        if len(data) > _LARGEST:
            raise TeacherTableError(f"{path}: larger than {_LARGEST // 1_000_000} MB")
        return data.decode("utf-8-sig")
    except OSError as error:
        raise TeacherTableError(f"{path}: it cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise TeacherTableError(f"{path}: it is not UTF-8; save it as CSV UTF-8") from error


def _delimiter(text):
    first_line = next((line for line in text.splitlines() if line.strip(' "')[:1] not in ("", "#")), "")
    return max(",;\t", key=first_line.count)


def _header(path, cells, columns, required):
    header = [cell.casefold() for cell in cells]
    unknown = [name for name in header if name and name not in columns]
    missing = [name for name in required if name not in header]
    if unknown or missing:
        listed = sanitize_line(", ".join(cells), 100)
        raise TeacherTableError(f"{path}: its columns are {listed}; expected {', '.join(columns)}")
    return header


def _lesson(text, answer_keys, place):
    lesson = answer_keys.lessons.get(lesson_name(text))
    if lesson is None:
        known_lessons = ", ".join(answer_keys.lessons)
        raise TeacherTableError(f"{place}: there is no lesson {_quoted(text)}; the key has {known_lessons}")
    return lesson


def _exercise(text, lesson, answer_keys, place):
    if not text:
        return None
    for key in answer_keys.keys:
        exercise = key.exercise(text)
        if exercise and key.lesson_of(text) == lesson.name and not exercise.practice:
            return exercise
    names = ", ".join(exercise.id for exercise in lesson.exercises if not exercise.practice)
    raise TeacherTableError(
        f"{place}: {lesson.name} has no exercise {_quoted(text)}; it has {names or 'none with points'}"
    )


def _points(text, lesson, exercise, place):
    """(points or None, excused)."""
    if text.casefold() == "excused":
        return None, True
    if not text:
        return None, False
    maximum = exercise.points if exercise else lesson.points
    try:
        points = float(text.replace(",", "."))
    except ValueError:
        points = -1.0
    if not 0 <= points <= maximum:
        text = f"the points are {_quoted(text)}"
        raise TeacherTableError(f"{place}: {text}; expected 0 to {maximum}, excused, or nothing")
    return plain_number(points), False


def plain_number(value):
    """The value rounded to hundredths; an int if it is whole, so that grades.json has 4 and not 4.0."""
    rounded = round(value + 1e-9, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def _quoted(text):
    return repr(sanitize_line(text, 60))
