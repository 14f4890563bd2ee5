"""What is exported: tables of points, for a spreadsheet, Moodle, Canvas and nbgrader, and pages as zips.

grades.csv
    one row per learner and lesson: the final points, the autograder's, and what makes the difference; UTF-8
    with a byte order mark, by which spreadsheets recognize it
checks.csv
    one row per learner and check, in the same form
exports/moodle-<lesson>.csv, for submissions from Moodle
    the offline grading worksheet of one assignment, for "Upload grading worksheet": Identifier
    ("Participant 123"), Full name, Grade, Last modified (grade), Feedback comments. Moodle finds the columns
    by their English names and a learner by the Identifier. It ignores a grade above the assignment's maximum.
    It also ignores a grade that replaces another one, because this table has no dates, unless "Allow updating
    records that have been modified more recently" is ticked
exports/canvas.csv, for submissions from Canvas
    the gradebook: Student, ID, SIS User ID, SIS Login ID, Section, one column per submitted lesson; the row
    Points Possible. Canvas finds a learner by the ID, and an assignment by the name of its column: a column
    with an unknown name is offered as a new assignment. The row of points changes the assignment's own
    points, and an empty cell removes a grade
exports/nbgrader.csv
    the columns of `nbgrader export`: assignment, duedate, timestamp, student_id, last_name, first_name,
    email, raw_score, late_submission_penalty, score, max_score

exports/moodle-feedback-<lesson>.zip
    for "Upload multiple feedback files in a zip". Moodle reads the participant's number and the kind of file
    from the folder's name, Ada Lovelace_12345_assignsubmission_file
exports/canvas-feedback-<lesson>.zip
    for "Re-Upload Submissions". Canvas reads the numbers of the learner and of the submitted file from the
    file's name, lovelaceada_77_100_20_light.html, and attaches the page to the submission as a comment
exports/feedback-<learner>.zip
    of a learner who submitted through no platform: nobody else's page is in it

If no table fits, fill the one that the platform exports (`grade --platform-table`).

A platform has one maximum per assignment: if an exercise is excused, the others' points are scaled to it.

No cell begins like a formula: an apostrophe is put before one that would.
"""

import csv
import io
import zipfile
from pathlib import PurePosixPath

from ..autograder.sanitize import spreadsheet_text
from .csv_table import csv_text
from .grades_json import lesson_names
from .report import count_of, finding_text
from .teacher_tables import plain_number

COLUMNS = (
    *("learner", "lesson", "points", "max_points", "percent", "late", "submitted_at", "submissions"),
    *("status", "findings", "file", "platform_id", "autograded_points", "days_late", "late_deduction"),
    *("decisions", "page"),
)
CHECK_COLUMNS = (
    *("learner", "lesson", "exercise", "check", "title", "hidden", "points", "max_points"),
    *("outcome", "message", "mistake"),
)
EXCUSED = "EX"  # what Canvas writes


def grades_csv(grades):
    """The text of grades.csv."""
    rows = [_grades_row(learner, lesson) for learner in grades["learners"] for lesson in learner["lessons"]]
    return "\ufeff" + _text(COLUMNS, rows)


def checks_csv(grades):
    """The text of checks.csv."""
    rows = [
        (
            *(learner["name"], lesson["lesson"], exercise["id"], case["id"], case["title"]),
            *("hidden" if case["hidden"] else "", case["points"], case["max_points"]),
            *(case["outcome"], case["message"], exercise["mistake"]),
        )
        for learner in grades["learners"]
        for lesson in learner["lessons"]
        for exercise in lesson["exercises"]
        for case in exercise["cases"]
    ]
    return "\ufeff" + _text(CHECK_COLUMNS, rows)


def _grades_row(learner, lesson):
    texts = [lesson["reason"]] if lesson["reason"] else []
    texts += [finding_text(finding) for finding in lesson["findings"]]
    row = lesson | {
        "learner": learner["name"],
        "lesson": lesson["lesson"] or "(unknown)",
        "percent": round(100 * lesson["points"] / lesson["max_points"], 1) if lesson["max_points"] else 0,
        "late": "late" if lesson["late"] else "",
        "submitted_at": lesson["submitted_at"] or "",
        "submissions": 1 + len(lesson["earlier"]),
        "findings": "; ".join(texts),
        "decisions": "; ".join(_decision_texts(lesson)),
        "page": learner["page"],
    }
    return [row[column] for column in COLUMNS]


def _decision_texts(lesson):
    """What the teacher decided about a lesson and its exercises, in words."""
    for entry, name in [(lesson, ""), *((exercise, exercise["id"]) for exercise in lesson["exercises"])]:
        decision = entry["decision"]
        if decision:
            points = "" if decision["points"] is None else f"{decision['points']} points"
            cells = ("excused" if decision["excused"] else points, decision["comment"])
            yield f"{name or 'the lesson'}: {', '.join(filter(None, cells))}"


def platform_points(lesson, excused=""):
    """Points for a platform, whose maximum stays whatever is excused; `excused` if the whole lesson is."""
    decided = [exercise for exercise in lesson["exercises"] if exercise["decision"]]
    left_out = [exercise for exercise in decided if exercise["decision"]["excused"]]
    if (lesson["decision"] and lesson["decision"]["excused"]) or (left_out and not lesson["max_points"]):
        return excused
    excused_cases = [case for exercise in left_out for case in exercise["cases"]]
    maximum = lesson["max_points"] + sum(case["max_points"] for case in excused_cases)
    return plain_number(lesson["points"] * maximum / lesson["max_points"]) if left_out else lesson["points"]


def exports(grades):
    """The tables for other programs, {file name: text}."""
    lessons = lessons_of(grades)
    files = {"nbgrader.csv": _nbgrader(grades, lessons)}
    for name in lessons:
        rows = list(_moodle_rows(grades, name))
        if rows:
            columns = ("Identifier", "Full name", "Grade", "Last modified (grade)", "Feedback comments")
            files[f"moodle-{name}.csv"] = _text(columns, rows)
    learners = [learner for learner in grades["learners"] if _lesson_from(learner, "canvas")]
    if learners:
        files["canvas.csv"] = _canvas(learners, lessons)
    return files


def lessons_of(grades):
    """{name: entry in `keys`} of the lessons with points, as the first key that has them describes them."""
    lessons = [lesson for key in reversed(grades["keys"]) for lesson in key["lessons"]]
    lessons = {lesson["lesson"]: lesson for lesson in lessons if lesson["max_points"]}
    return {name: lessons[name] for name in lesson_names(grades) if name in lessons}


def _lesson_from(learner, platform):
    return next((lesson for lesson in learner["lessons"] if lesson["platform"] == platform), None)


def _moodle_rows(grades, name):
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            if lesson["lesson"] == name and lesson["platform"] == "moodle":
                number = f"Participant {lesson['platform_id']}"
                yield number, learner["name"], platform_points(lesson), "", _comment(lesson)


def _comment(lesson):
    """The feedback comment: the points, what lateness cost, what the teacher decided."""
    parts = [f"{lesson['points']} of {lesson['max_points']} points"]
    if lesson["late_deduction"]:
        parts.append(f"{lesson['late_deduction']} deducted, {count_of(lesson['days_late'], 'day')} late")
    parts += [f"not graded: {lesson['reason']}"] if lesson["status"] != "graded" else []
    return "; ".join([*parts, *_decision_texts(lesson)])


def _canvas(learners, lessons):
    # An empty column would create a new assignment, or remove the grades of an old one.
    submitted = {lesson["lesson"] for learner in learners for lesson in learner["lessons"]}
    lessons = {name: lesson for name, lesson in lessons.items() if name in submitted}
    columns = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section", *lessons)
    maxima = (lesson["max_points"] for lesson in lessons.values())
    rows = [("    Points Possible", "", "", "", "", *maxima)]
    for learner in learners:
        points = {lesson["lesson"]: platform_points(lesson, EXCUSED) for lesson in learner["lessons"]}
        number = int(_lesson_from(learner, "canvas")["platform_id"])
        rows.append((learner["name"], number, "", "", "", *(points.get(name, "") for name in lessons)))
    return _text(columns, rows)


def _nbgrader(grades, lessons):
    columns = ["assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email"]
    columns += ["raw_score", "late_submission_penalty", "score", "max_score"]
    due = (grades["deadline"] or "").replace("T", " ")
    rows = []
    for name, lesson in lessons.items():
        maximum = float(lesson["max_points"])
        for learner in grades["learners"]:
            score, penalty, timestamp = 0.0, 0.0, ""
            for entry in (entry for entry in learner["lessons"] if entry["lesson"] == name):
                score, penalty = float(platform_points(entry) or 0), float(entry["late_deduction"])
                timestamp = (entry["submitted_at"] or "").replace("T", " ")
            about = (name, due, timestamp, learner["name"], "", "", "")
            rows.append((*about, score + penalty, penalty, score, maximum))
    return _text(columns, rows)


def _text(columns, rows):
    rows = [columns, *([spreadsheet_text(value) for value in row] for row in rows)]
    return csv_text(rows, quoting=csv.QUOTE_NONNUMERIC)


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
    return {archive: _zip(names, read_page) for archive, names in members.items()}


def _member(learner, lesson):
    if lesson["platform"] == "canvas":
        # A learner's own folders and zips come after Canvas's name.
        parts = PurePosixPath(lesson["file"]).parts
        name = next((part for part in parts if f"_{lesson['platform_id']}_" in part), parts[-1])
        return f"{name.removesuffix('.ipynb').removesuffix('.zip')}.html"
    # Moodle splits the name at its underscores.
    name = learner["name"].replace("_", " ").replace("/", " ")
    return f"{name}_{lesson['platform_id']}_assignsubmission_file/feedback.html"


def _zip(members, read_page):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, learner in members:
            # A ZipInfo has no date of today: the same pages give the same bytes.
            archive.writestr(zipfile.ZipInfo(name), read_page(learner), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
