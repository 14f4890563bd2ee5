"""Fill a table that a learning platform exported with our points, so that it can be imported back as it is.

    Canvas    Grades > Export: "Student", "ID", ..., "Section", a column "03_grayscale (1234)" an assignment
    Moodle    View all submissions > Download grading worksheet: "Identifier", ..., "Grade", one assignment

Every cell stays as it stands, save the points of what was graded. A row is a learner's by the platform's
number, which stands in the names of the files that it hands out; else by a login, an e-mail address or a
number that is the learner's name here.
"""

import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path

from imgproc_course.gradebook.lms_export import lessons_of

_IDENTITIES = {"SIS Login ID", "SIS User ID", "Integration ID", "Email address", "ID number", "Username"}
_WITH_NUMBER = re.compile(r"(.+?) \(\d+\)", re.S)
_LARGEST = 50_000_000


class TableError(ValueError):
    """A table that cannot be filled; one line with the remedy."""


@dataclass(frozen=True)
class PlatformTable:
    """A platform's table: `platform` "canvas" or "moodle", `columns`, `rows`, and how it was written."""

    path: Path
    platform: str
    columns: tuple
    rows: tuple
    delimiter: str
    mark: str

    @property
    def number_column(self):
        """Where the platform's number of a learner stands."""
        return self.columns.index("ID" if self.platform == "canvas" else "Identifier")


def read_tables(paths):
    """Read platforms' tables.

    Parameters
    ----------
    paths : sequence of Path

    Returns
    -------
    list of PlatformTable

    Raises
    ------
    TableError : one cannot be read, or is no table of Canvas's or Moodle's; or two have the same name
    """
    paths = [Path(path) for path in paths]
    names = [path.name for path in paths]
    for path in paths:
        if names.count(path.name) > 1:
            raise TableError(f"{path}: two tables are called {path.name}; give one of them another name")
    return [_read(path) for path in paths]


def _read(path):
    try:
        if path.stat().st_size > _LARGEST:
            raise TableError(f"{path}: larger than {_LARGEST // 1_000_000} MB; give the table as exported")
        text = path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        raise TableError(f"{path}: it is not UTF-8; export it again and do not save it in between") from error
    except OSError as error:
        raise TableError(f"{path}: it cannot be read ({error.strerror})") from error
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    first = text.removeprefix(mark).partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    try:
        rows = list(csv.reader(io.StringIO(text.removeprefix(mark), newline=""), delimiter=delimiter))
    except csv.Error as error:
        raise TableError(f"{path}: it is no CSV table ({error}); export it again") from error
    columns = tuple(each.strip() for each in rows[0]) if rows else ()
    return PlatformTable(path, _platform(path, columns), columns, tuple(rows[1:]), delimiter, mark)


def _platform(path, columns):
    if columns[:2] == ("Student", "ID") or columns[:3] == ("LastName", "FirstName", "ID"):
        if "Section" in columns:
            return "canvas"
    elif {"Identifier", "Grade"} <= set(columns):
        return "moodle"
    found = ", ".join(columns[:8]) or "nothing"
    raise TableError(
        f"{path}: its columns are {found[:200]}; expected Canvas's gradebook export (Student, ID,"
        " ..., Section) or Moodle's grading worksheet in English (Identifier, ..., Grade)"
    )


def fill(table, grades):
    """The table with our points in it.

    Parameters
    ----------
    table : PlatformTable
    grades : dict, what grades.json holds

    Returns
    -------
    (text, list of str): the table, and what is to be said of it

    Raises
    ------
    TableError : no column of it is a lesson's
    """
    columns = _lesson_columns(table, grades)
    rows, filled, matched = [list(row) for row in table.rows], 0, set()
    for row in rows:
        learner = _learner(table, row, grades["learners"])
        if learner is None:
            continue
        matched.add(learner["name"])
        for column, name in columns.items():
            graded = _graded(learner, name)
            if graded is not None and column < len(row):
                row[column] = str(graded["points"])
                filled += 1
    missing = _not_in_it(grades, matched, set(columns.values()))
    told = [f"{table.path.name}: {filled} points filled in."]
    if missing:
        names = ", ".join(missing[:5]) + (f" and {len(missing) - 5} more" if len(missing) > 5 else "")
        told.append(f"  graded, and in no row of it: {names}")
    told += _other_points(table, columns, grades)
    return table.mark + _text(table, rows), told


def _lesson_columns(table, grades):
    """{column: lesson}; of Moodle's worksheet its one column of points."""
    lessons = lessons_of(grades)
    if table.platform == "moodle":
        return {table.columns.index("Grade"): _lesson_of_worksheet(table, grades, lessons)}
    known = {name.casefold(): name for name in lessons}
    known |= {about["title"].casefold(): name for name, about in lessons.items()}
    found = {}
    for number, column in enumerate(table.columns):
        match = _WITH_NUMBER.fullmatch(column)
        title = (match[1] if match else column).strip().casefold()
        if number > table.columns.index("Section") and title in known:
            found[number] = known[title]
    if not found:
        raise TableError(
            f"{table.path}: none of its assignments is called like a lesson ({', '.join(lessons)}) or like"
            " its title: give the assignment in Canvas the lesson's name, and export again"
        )
    return found


def _lesson_of_worksheet(table, grades, lessons):
    named = [name for name in lessons if name in table.path.stem]
    handed_in = {each["lesson"] for learner in grades["learners"] for each in learner["lessons"]} & set(
        lessons
    )
    candidates = named or sorted(handed_in)
    if len(candidates) == 1:
        return candidates[0]
    raise TableError(
        f"{table.path}: a worksheet is of one lesson, and it may be of {', '.join(candidates) or 'none'}:"
        " put the lesson's name into the file's name"
    )


def _learner(table, row, learners):
    """Whose row it is, or None."""
    cell = row[table.number_column] if table.number_column < len(row) else ""
    number = re.search(r"\d+$", cell.strip())
    if number:
        for learner in learners:
            for lesson in learner["lessons"]:
                if (lesson["platform"], lesson["platform_id"]) == (table.platform, number[0]):
                    return learner
    names = {
        value.strip().casefold()
        for column, value in zip(table.columns, row, strict=False)
        if column in _IDENTITIES and value.strip()
    }
    found = [each for each in learners if each["name"].casefold() in names]
    return found[0] if len(found) == 1 else None


def _graded(learner, name):
    for lesson in learner["lessons"]:
        if lesson["lesson"] == name and lesson["status"] == "graded":
            return lesson
    return None


def _not_in_it(grades, matched, lessons):
    return [
        learner["name"]
        for learner in grades["learners"]
        if learner["name"] not in matched and any(_graded(learner, name) for name in lessons)
    ]


def _other_points(table, columns, grades):
    """What to say where the platform has other points for a lesson: nothing is scaled."""
    lessons = lessons_of(grades)
    for column, name in columns.items():
        most = _most_points(table, column)
        if most is not None and most != lessons[name]["max_points"]:
            yield (
                f"  {name} is worth {most:g} points there and {lessons[name]['max_points']} here; points are"
                " filled in as they are here: change it there"
            )


def _most_points(table, column):
    if table.platform == "canvas":
        cells = [row[column] for row in table.rows if "Points Possible" in row[0] and column < len(row)]
    elif "Maximum grade" in table.columns:
        at = table.columns.index("Maximum grade")
        cells = [row[at] for row in table.rows if at < len(row)]
    else:
        cells = []
    try:
        return float(cells[0].replace(",", ".")) if cells else None
    except ValueError:
        return None


def _text(table, rows):
    buffer = io.StringIO()
    writer = csv.writer(buffer, delimiter=table.delimiter, lineterminator="\r\n")
    writer.writerow(table.columns)
    writer.writerows(rows)
    return buffer.getvalue()
