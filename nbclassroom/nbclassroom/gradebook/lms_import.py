"""Fill a table that a learning platform exported with our points, so that it can be imported back unchanged.

Canvas's export of the gradebook has a column for each assignment, Moodle's grading worksheet is of one. Only
the points of graded lessons are written; every other cell stays as it is, save for an apostrophe before what
a spreadsheet would take for a formula. A row is matched to a learner by the platform's number, which is part
of the names of the files that the platform hands out; otherwise by a name, as a roster's (see `roster`).
"""

import re
from collections import Counter
from pathlib import Path

from ..authoring.lesson_names import lesson_name, lessons_named
from ..autograder.sanitize import without_formulas
from .csv_table import TableError, csv_text, read_csv
from .lms_export import EXCUSED, lessons_of, platform_points
from .roster import entry_of

_CANVAS = ("Student", "ID"), ("LastName", "FirstName", "ID")
_NUMBER = re.compile(r"[+-]?[\d.,]*")
_WITH_NUMBER = re.compile(r"(.+?) \(\d+\)", re.S)


def read_tables(paths):
    """The tables as CsvTables; TableError: one is none of Canvas or Moodle, or two have the same name."""
    paths = [Path(path) for path in paths]
    names = [path.name for path in paths]
    for path in paths:
        if names.count(path.name) > 1:
            raise TableError(f"{path}: two tables have the name {path.name}; rename one of them")
    tables = [read_csv(path) for path in paths]
    for table in tables:
        if not _is_canvas(table) and not {"Identifier", "Grade"} <= set(table.columns):
            listed = ", ".join(table.columns[:8]) or "nothing"
            raise TableError(
                f"{table.path}: its columns are {listed[:200]}; expected Canvas's gradebook export (Student,"
                " ID, ..., Section) or Moodle's grading worksheet in English (Identifier, ..., Grade)"
            )
    return tables


def _is_canvas(table):
    """Whether Canvas exported it; else Moodle did."""
    begins = any(table.columns[: len(names)] == names for names in _CANVAS)
    return begins and "Section" in table.columns


def fill_table(table, grades):
    """(A platform's table with our points, lines to print); TableError: no column belongs to a lesson."""
    columns = _lesson_columns(table, grades)
    rows, filled = [list(row) for _, row in table.rows], 0
    graded = _graded_lessons(grades)
    missing = [name for name, lessons in graded.items() if lessons.keys() & set(columns.values())]
    for row, learner in _matched(table, rows, grades["learners"]):
        missing = [name for name in missing if name != learner["name"]]
        for column, name in columns.items():
            lesson = graded[learner["name"]].get(name)
            points = platform_points(lesson, EXCUSED if _is_canvas(table) else "") if lesson else ""
            if points != "" and column < len(row):
                row[column] = str(points)
                filled += 1
    lines = [f"{table.path.name}: {filled} points filled in."]
    if missing:
        names = ", ".join(missing[:5]) + (f" and {len(missing) - 5} more" if len(missing) > 5 else "")
        lines.append(f"  graded, but in no row of the table: {names}")
    lines += _different_points(table, columns, grades)
    # Numbers, and the dash for no points, are no formulas.
    cells = (
        [cell if _NUMBER.fullmatch(cell.strip()) else without_formulas(cell) for cell in row]
        for row in (table.columns, *rows)
    )
    text = csv_text(cells, delimiter=table.delimiter)
    return table.byte_order_mark + text, lines


def _graded_lessons(grades):
    """{learner's name: {lesson: entry}}, without lessons that are graded in part."""
    any_counts = grades["open_as_zero"]
    return {
        learner["name"]: {
            one["lesson"]: one
            for one in learner["lessons"]
            if one["status"] == "graded" and (any_counts or not one["open_points"])
        }
        for learner in grades["learners"]
    }


def _lesson_columns(table, grades):
    """{index of a column: lesson}; Moodle's worksheet has one column of points."""
    lessons = lessons_of(grades)
    if not _is_canvas(table):
        return {table.columns.index("Grade"): _lesson_of_worksheet(table, grades, lessons)}
    lesson_names = {name.casefold(): name for name in lessons}
    lesson_names |= {lesson["title"].casefold(): name for name, lesson in lessons.items()}
    columns = {}
    for number, column in enumerate(table.columns):
        match = _WITH_NUMBER.fullmatch(column)
        title = lesson_name((match[1] if match else column).strip().casefold())
        if number > table.columns.index("Section") and title in lesson_names:
            columns[number] = lesson_names[title]
    if not columns:
        raise TableError(
            f"{table.path}: no assignment in it has the name of a lesson ({', '.join(lessons)}) or its"
            " title: rename the assignment in Canvas to the lesson's name, and export again"
        )
    return columns


def _lesson_of_worksheet(table, grades, lessons):
    in_file_name = lessons_named(table.path.stem, lessons)
    submitted = {lesson["lesson"] for learner in grades["learners"] for lesson in learner["lessons"]}
    candidates = in_file_name or sorted(submitted & set(lessons))
    if len(candidates) == 1:
        return candidates[0]
    raise TableError(
        f"{table.path}: a worksheet belongs to one lesson, but this one can belong to"
        f" {', '.join(candidates) or 'none'}: put the lesson's name into the file's name"
    )


def _matched(table, rows, learners):
    """(row, its learner) of a table; by a name only if one row and one learner without a number have it."""
    entries = [entry_of(table.record(row)) for row in rows]
    sure = [[one for one in learners if entry and entry.number in _numbers(one)] for entry in entries]
    others = [learner for learner in learners if not any(learner in own[:1] for own in sure)]
    likely = [
        [one for one in others if entry and entry.is_sender(one["name"], _numbers(one))] for entry in entries
    ]
    counts = Counter(learner["name"] for several in likely for learner in several)
    for row, own, several in zip(rows, sure, likely, strict=True):
        alone = len(several) == 1 and counts[several[0]["name"]] == 1
        yield from ((row, learner) for learner in (own or several * alone)[:1])


def _numbers(learner):
    return {(lesson["platform"], lesson["platform_id"]) for lesson in learner["lessons"]}


def _different_points(table, columns, grades):
    """A line for each lesson that has other maximum points on the platform: nothing is scaled."""
    lessons, is_canvas = lessons_of(grades), _is_canvas(table)
    # Canvas has a row of maximum points, Moodle a column.
    rows = [row for _, row in table.rows if not is_canvas or "Points Possible" in "".join(row[:1])]
    for column, name in columns.items():
        try:
            place = column if is_canvas else table.columns.index("Maximum grade")
            maximum = float(rows[0][place].replace(",", "."))
        except (ValueError, IndexError):
            continue
        if maximum != lessons[name]["max_points"]:
            yield (
                f"  {name} is worth {maximum:g} points on the platform and {lessons[name]['max_points']}"
                " here; our points are filled in without scaling: change the maximum on the platform"
            )
