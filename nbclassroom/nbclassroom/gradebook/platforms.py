"""What is exported: points for a spreadsheet and in a platform's own table, and the learners' pages as zips.

Moodle reads the participant's number and the kind of file from a folder's name in the zip, such as
Ada Lovelace_12345_assignsubmission_file; Canvas reads the numbers of the learner and of the submitted file
from a file's name, lovelaceada_77_100_20_light.html. A platform has one maximum per assignment: if an
exercise is excused, the others' points are scaled to it.

A table that a platform exported is filled so that it can be imported back unchanged: only the points of
graded lessons are written; every other cell stays as it is, save for an apostrophe before what a spreadsheet
would take for a formula. A row is matched to a learner by the platform's number, which is part of the names
of the files that the platform hands out; otherwise by a name (see `roster`). Our own tables are UTF-8 with a
byte order mark, by which spreadsheets recognize it. No cell begins like a formula, either.
"""

import csv
import re
from collections import Counter
from pathlib import Path, PurePosixPath

from ..authoring.lesson_files import zip_bytes
from ..authoring.lesson_names import lesson_name, lessons_named
from ..autograder.sanitize import spreadsheet_text, without_formulas
from .csv_table import TableError, csv_text, read_csv
from .grades_json import lesson_names
from .report import finding_text
from .roster import entry_of
from .teacher_tables import plain_number

COLUMNS = (
    *("learner", "lesson", "points", "max_points", "percent", "late", "submitted_at", "submissions"),
    *("status", "findings", "file", "platform_id", "autograded_points", "days_late", "late_deduction"),
    *("page", "open_points"),
)
EXCUSED = "EX"  # what Canvas writes
_CANVAS = ("Student", "ID"), ("LastName", "FirstName", "ID")
_NUMBER = re.compile(r"[+-]?[\d.,]*")
_ITS_NUMBER = re.compile(r" \(\d+\)\Z")  # of an assignment


def grades_csv(grades):
    any_counts = grades["open_as_zero"]
    rows = [_grades_row(one, lesson, any_counts) for one in grades["learners"] for lesson in one["lessons"]]
    return "\ufeff" + csv_text([COLUMNS, *rows], quoting=csv.QUOTE_NONNUMERIC)


def _grades_row(learner, lesson, any_counts):
    percent = round(100 * lesson["points"] / lesson["max_points"], 1) if lesson["max_points"] else 0
    is_whole = any_counts or not lesson["open_points"]  # else it is graded in part
    texts = [lesson["reason"]] if lesson["reason"] else []
    texts += [finding_text(finding) for finding in lesson["findings"]]
    row = lesson | ({"percent": percent} if is_whole else {"points": "", "percent": ""})
    row |= {
        "learner": learner["name"],
        "lesson": lesson["lesson"] or "(unknown)",
        "late": "late" if lesson["late"] else "",
        "submitted_at": lesson["submitted_at"] or "",
        "submissions": 1 + len(lesson["earlier"]),
        "findings": "; ".join(texts),
        "page": learner["page"],
    }
    return [spreadsheet_text(row[column]) for column in COLUMNS]


def platform_points(lesson, excused=""):
    """Points for a platform, whose maximum stays whatever is excused; `excused` if the whole lesson is."""
    decided = [exercise for exercise in lesson["exercises"] if exercise["decision"]]
    left_out = [exercise for exercise in decided if exercise["decision"]["excused"]]
    if (lesson["decision"] and lesson["decision"]["excused"]) or (left_out and not lesson["max_points"]):
        return excused
    excused_cases = [case for exercise in left_out for case in exercise["cases"]]
    maximum = lesson["max_points"] + sum(case["max_points"] for case in excused_cases)
    return plain_number(lesson["points"] * maximum / lesson["max_points"]) if left_out else lesson["points"]


def lessons_of(grades):
    """{name: entry in `keys`} of the lessons with points, as the first key that has them describes them."""
    entries = [entry for key in reversed(grades["keys"]) for entry in key["lessons"]]
    lessons = {entry["lesson"]: entry for entry in entries if entry["max_points"]}
    return {name: lessons[name] for name in lesson_names(grades) if name in lessons}


def feedback_zips(grades, read_page):
    """{file name: bytes} of all zips; `read_page` gives the bytes of the page of a learner's entry."""
    members, lessons = {}, lessons_of(grades)
    for learner in grades["learners"]:
        page = PurePosixPath(learner["page"])
        if not any(lesson["platform"] for lesson in learner["lessons"]):
            members[f"feedback-{page.stem}.zip"] = [(page.name, learner)]
        for lesson in learner["lessons"]:
            if lesson["platform"] and lesson["file"] and lesson["lesson"] in lessons:
                archive = f"{lesson['platform']}-feedback-{lesson['lesson']}.zip"
                members.setdefault(archive, []).append((_member(learner, lesson), learner))
    return {
        archive: zip_bytes({name: read_page(learner) for name, learner in pages})
        for archive, pages in members.items()
    }


def _member(learner, lesson):
    if lesson["platform"] == "canvas":
        # A learner's own folders and zips come after Canvas's name.
        parts = PurePosixPath(lesson["file"]).parts
        name = next((part for part in parts if f"_{lesson['platform_id']}_" in part), parts[-1])
        return f"{name.removesuffix('.ipynb').removesuffix('.zip')}.html"
    # Moodle splits the name at its underscores.
    name = learner["name"].replace("_", " ").replace("/", " ")
    return f"{name}_{lesson['platform_id']}_assignsubmission_file/feedback.html"


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
            listed = (", ".join(table.columns[:8]) or "nothing")[:200]
            expected = "Canvas's gradebook export (Student, ID, ..., Section)"
            expected += " or Moodle's grading worksheet in English (Identifier, ..., Grade)"
            raise TableError(f"{table.path}: its columns are {listed}; expected {expected}")
    return tables


def _is_canvas(table):
    """Whether Canvas exported it; else Moodle did."""
    return "Section" in table.columns and any(table.columns[: len(one)] == one for one in _CANVAS)


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
    return table.byte_order_mark + csv_text(cells, delimiter=table.delimiter), lines


def _graded_lessons(grades):
    """{learner's name: {lesson: entry}}, without lessons that are graded in part."""
    return {
        learner["name"]: {
            one["lesson"]: one
            for one in learner["lessons"]
            if one["status"] == "graded" and (grades["open_as_zero"] or not one["open_points"])
        }
        for learner in grades["learners"]
    }


def _lesson_columns(table, grades):
    """{index of a column: lesson}; Canvas has one for each assignment, Moodle's worksheet is of one."""
    lessons = lessons_of(grades)
    if not _is_canvas(table):
        return {table.columns.index("Grade"): _lesson_of_worksheet(table, grades, lessons)}
    names = {name.casefold(): name for name in lessons}
    names |= {lesson["title"].casefold(): name for name, lesson in lessons.items()}
    columns = {}
    for number, column in enumerate(table.columns):
        title = lesson_name(_ITS_NUMBER.sub("", column).strip().casefold())
        if number > table.columns.index("Section") and title in names:
            columns[number] = names[title]
    if not columns:
        problem = f"no assignment in it has the name of a lesson ({', '.join(lessons)}) or its title"
        remedy = "rename the assignment in Canvas to the lesson's name, and export again"
        raise TableError(f"{table.path}: {problem}: {remedy}")
    return columns


def _lesson_of_worksheet(table, grades, lessons):
    in_file_name = lessons_named(table.path.stem, lessons)
    submitted = {lesson["lesson"] for learner in grades["learners"] for lesson in learner["lessons"]}
    candidates = in_file_name or sorted(submitted & set(lessons))
    if len(candidates) == 1:
        return candidates[0]
    problem = "a worksheet belongs to one lesson, but this one can belong to"
    problem += f" {', '.join(candidates) or 'none'}"
    raise TableError(f"{table.path}: {problem}: put the lesson's name into the file's name")


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
            worths = f"{maximum:g} points on the platform and {lessons[name]['max_points']} here"
            remedy = "our points are filled in without scaling: change the maximum on the platform"
            yield f"  {name} is worth {worths}; {remedy}"
