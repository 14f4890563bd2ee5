"""What a teacher adds to the autograder's points: decisions, extensions of the deadline, and a late policy.

Decisions and extensions are CSV files in UTF-8 with a row of column names, as every spreadsheet writes them.
"""

import contextlib
import difflib
import math
import re
from collections import namedtuple
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta

from ..authoring.lesson_names import lesson_name
from ..autograder.sanitize import sanitize_line, spreadsheet_text
from .csv_table import TableError, is_comment, read_csv
from .roster import names_in_roster

_POLICY = re.compile(r"(\d{1,3}(?:\.\d{1,2})?) ?% (?:a|per) day(?:, ?(\d{1,4}) days?)?", re.I)
_LINES = re.compile(r"lines((?: \d{1,2})+) of ([0-9a-f]{8})")  # of a rubric; 0 for none of them
_WORTHS = re.compile(r"points((?: -?\d{1,3})+)")
EVERYBODY = "(all)"  # in the place of a learner: other points for the lines of a rubric
DECISION_COLUMNS = ("learner", "lesson", "exercise", "points", "comment")
_MOST_SIMILAR = 3  # names that an error offers
# Another deadline for a learner; of all lessons if the lesson is "". The place is that of its row.
Extension = namedtuple("Extension", ("learner", "lesson", "deadline", "place"))
_EXTENSION_COLUMNS = ("learner", "lesson", "deadline")
DECISIONS_TEMPLATE = f"""\ufeff{",".join(DECISION_COLUMNS)}
"# One row per decision. Empty exercise: the whole lesson. Points: a number, excused, or empty for a comment."
"""


@dataclass(frozen=True)
class Decision:
    """A teacher's decision on an exercise, or on a whole lesson (""); the place is that of its row.

    The points are None if it is excused, or if there is only a comment. With a `mark`, see `GradedExercise`,
    the `lines` of the rubric give them, as far as that mark is the answer's. On EVERYBODY's, `lines` are the
    points of all lines of the rubric.
    """

    learner: str
    lesson: str
    exercise: str
    points: float | None
    excused: bool
    comment: str
    place: str
    lines: tuple = ()
    mark: str = ""


def read_decisions(path, answer_keys, text=None):
    """The Decisions in a table, or in the `text` that it shall have; TableError: a row has a mistake."""
    decisions: dict[tuple, Decision] = {}
    for row, place in _rows(read_csv(path, text), DECISION_COLUMNS, ("learner", "lesson", "points")):
        lesson = _lesson(row["lesson"], answer_keys, place)
        exercise = _exercise(row["exercise"], lesson, answer_keys, place)
        lines, mark = _lines(row, exercise)
        points, excused = (None, False) if lines else _points(row["points"], lesson, exercise, place)
        if points is None and not excused and not lines and not row["comment"]:
            raise TableError(f"{place}: it decides nothing; give points, excused, or a comment")
        target = (row["learner"], lesson.name, exercise.id if exercise else "")
        if target in decisions:
            raise TableError(f"{place}: the same as {decisions[target].place}; remove one of them")
        decisions[target] = Decision(*target, points, excused, row["comment"], place, lines, mark)
    return list(decisions.values())


def read_extensions(path, answer_keys):
    """Read extensions of the deadline, as a list of Extension; TableError: a row has a mistake."""
    extensions = []
    for row, place in _rows(read_csv(path), _EXTENSION_COLUMNS, ("learner", "deadline")):
        lesson = _lesson(row["lesson"], answer_keys, place).name if row["lesson"] else ""
        try:
            deadline = local_time_of(row["deadline"])
        except ValueError as error:
            text = f"the deadline is {sanitize_line(row['deadline'], 40)!r}"
            raise TableError(f"{place}: {text}; write it like 2026-12-01T23:59") from error
        extensions.append(Extension(row["learner"], lesson, deadline, place))
    return extensions


def _by_learner(rows, names):
    """{learner: rows} of a table; `names` {as written: learner, or None to leave out}; else TableError."""
    assigned: dict[str, list] = {}
    as_written = {spreadsheet_text(name): name for name in names}
    for row in rows:
        # As grades.csv writes it: an apostrophe keeps a spreadsheet from taking a name for a formula.
        name = as_written.get(row.learner, row.learner)
        if name not in names:
            raise TableError(f"{row.place}: there is no learner {_unknown(row.learner, names)}")
        if names[name] is not None:
            assigned.setdefault(names[name], []).append(row)
    return assigned


def _unknown(learner, names):
    similar = [name for name in names if name.startswith(f"{learner} (")]  # two have this name now
    similar = similar or difflib.get_close_matches(learner, names, 1)
    if similar:
        return f"{_quoted(learner)}; did you mean {' or '.join(map(repr, sorted(similar)[:_MOST_SIMILAR]))}?"
    examples = ", ".join(sorted({name for name in names.values() if name})[:3])
    text = f"{_quoted(learner)}; write the name of the folder or file that was submitted ({examples}, ...)"
    return f"{text}, or give the --roster that has those who submitted nothing"


def _rows(table, columns, required):
    """({column: cell}, "file, row 3") of each row that is not empty and no comment."""
    header = table.record(table.columns).keys() - {""}
    if header and not set(required) <= header <= set(columns):
        listed = sanitize_line(", ".join(table.columns), 100)
        raise TableError(f"{table.path}: its columns are {listed}; expected {', '.join(columns)}")
    for number, cells in table.rows:
        if is_comment(cells):
            continue
        place, expected = f"{table.path}, row {number}", len(table.columns)
        if any(map(str.strip, cells[expected:])):
            text = f"{len(cells)} cells, expected {expected}; put a text with commas in quotes"
            raise TableError(f"{place}: {text}")
        row = dict.fromkeys(columns, "") | table.record(cells)
        missing = [name for name in required if name != "points" and not row[name]]
        if missing:
            raise TableError(f"{place}: the cell {missing[0]} is empty")
        yield row, place


def _lesson(text, answer_keys, place):
    lesson = answer_keys.lessons.get(lesson_name(text))
    if lesson is None:
        known_lessons = ", ".join(answer_keys.lessons)
        raise TableError(f"{place}: there is no lesson {_quoted(text)}; the key has {known_lessons}")
    return lesson


def _exercise(text, lesson, answer_keys, place):
    if not text:
        return None
    for key in answer_keys.keys:
        for exercise in key.lessons.get(lesson.name, lesson).exercises:
            if exercise.id == text and not exercise.practice:
                return exercise
    names = ", ".join(exercise.id for exercise in lesson.exercises if not exercise.practice)
    problem = f"{lesson.name} has no exercise {_quoted(text)}"
    raise TableError(f"{place}: {problem}; it has {names or 'none with points'}")


def _lines(row, exercise):
    """(The lines of a rubric that a row names, or the points that it gives to all, the mark); else (), ""."""
    count = len(exercise.rubric) if exercise else 0
    pattern = _WORTHS if row["learner"] == EVERYBODY else _LINES
    if not count or not (match := pattern.fullmatch(row["points"])):
        return (), ""
    numbers, mark = tuple(map(int, match[1].split())), match[2] if pattern is _LINES else ""
    return (numbers, mark) if (max(numbers) <= count if mark else len(numbers) == count) else ((), "")


def _points(text, lesson, exercise, place):
    """(points or None, excused)."""
    if text.casefold() == "excused":
        return None, True
    if not text:
        return None, False
    maximum = exercise.points if exercise else lesson.points
    try:
        points, *bonus = [float(part.replace(",", ".")) for part in text.split("+")]
    except ValueError:
        points, bonus = -1.0, []
    if not (0 <= points <= maximum and len(bonus) < 2 and all(0 <= more <= maximum for more in bonus)):
        expected = f"0 to {maximum}, {maximum}+1 for a bonus, excused, or nothing"
        raise TableError(f"{place}: the points are {_quoted(text)}; expected {expected}")
    return plain_number(points + sum(bonus)), False


def plain_number(value):
    """The value rounded to hundredths; an int if it is whole, so that grades.json has 4 and not 4.0."""
    rounded = round(value + 1e-9, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def _quoted(text):
    return repr(sanitize_line(text, 60))


def local_time_of(text):
    """The local time of 2026-12-01T23:59+01:00, of a date alone its last second; ValueError: it is none."""
    with contextlib.suppress(ValueError):
        return datetime.combine(date.fromisoformat(text), time(23, 59, 59))
    moment = datetime.fromisoformat(text)
    return moment.astimezone().replace(tzinfo=None) if moment.tzinfo else moment


@dataclass(frozen=True)
class LatePolicy:
    """What lateness costs: `percent` of the points per day; after `days` days (None: no such limit) all."""

    percent: float
    days: int | None
    text: str

    def factor(self, days_late):
        """The share of the points that is left, 0 to 1."""
        if self.days is not None and days_late > self.days:
            return 0.0
        return max(0.0, 1 - self.percent * days_late / 100)


def read_late_policy(text):
    """The LatePolicy of a text, "10% a day" or "10% a day, 3 days"; ValueError: it is something else."""
    match = _POLICY.fullmatch(text.strip())
    if not match or not 0 < float(match[1]) <= 100:
        raise ValueError(f'{text[:60]!r} is no late policy; write "10% a day" or "10% a day, 3 days"')
    return LatePolicy(float(match[1]), int(match[2]) if match[2] else None, text.strip())


class TeacherRules:
    """The teacher's deadline, late policy, extensions and decisions; those two are Paths of tables.

    deadline   a local time or None
    policy     the LatePolicy or None
    decisions  after `assign`, {learner's name: list of Decision}

    Mistakes in a table or in the policy are ValueErrors.
    """

    def __init__(self, answer_keys, *, deadline=None, late=None, extensions=None, decisions=None):
        if late and not deadline:
            raise ValueError("--late needs the deadline: --deadline 2026-12-01T23:59")
        self._answer_keys, self.deadline = answer_keys, deadline
        self.policy = read_late_policy(late) if late else None
        self._tables = (
            read_extensions(extensions, answer_keys) if extensions else [],
            read_decisions(decisions, answer_keys) if decisions else [],
        )
        self._extensions, self.decisions = {}, {}
        # {exercise: other points for the lines of its rubric}
        self.worths = {one.exercise: one.lines for one in self._tables[1] if one.learner == EVERYBODY}

    def assign(self, learners, roster=()):
        """Assign extensions and decisions to learners, who are read but not yet graded.

        A row about a person of the roster who submitted nothing waits for the submission. TableError:
        nobody has a name, or a decision is on an exercise that cannot be graded.
        """
        names = names_in_roster(roster, learners)
        names |= {self._answer_keys.anonymous_id(learner.name): learner.name for learner in learners}
        names |= {learner.name: learner.name for learner in learners}
        self._extensions, self.decisions = (
            _by_learner([row for row in rows if row.learner != EVERYBODY], names) for rows in self._tables
        )
        for learner in learners:
            for decision in self.decisions.get(learner.name, ()):
                submission = learner.submissions.get(decision.lesson)
                if decision.exercise and (submission is None or not submission.answers_digest):
                    problem = "was not submitted" if submission is None else "could not be graded"
                    text = f"{decision.learner}'s {decision.lesson} {problem}, so it has no exercises"
                    raise TableError(f"{decision.place}: {text}; leave the exercise empty")

    def lateness(self, learner, lesson, file):
        """(Whether a file is late, how many days had begun after the deadline when it was submitted).

        Without an extension, it is also late if the platform says so.
        """
        extended = {one.lesson: one.deadline for one in reversed(self._extensions.get(learner, ()))}
        extension = extended.get(lesson, extended.get(""))
        due, days = extension or self.deadline, 0
        if due and file.submitted_at:
            days = max(0, math.ceil((file.submitted_at - due) / timedelta(days=1)))
        return days > 0 or (file.late and not extension), days
