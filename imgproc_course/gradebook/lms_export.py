"""Tables of points: for a spreadsheet, and as Moodle, Canvas and nbgrader's readers take them.

grades.csv
    a row a learner and lesson; UTF-8 with the mark that spreadsheets know it by
exports/moodle-<lesson>.csv, of what came from Moodle
    the offline grading worksheet of one assignment, for "Upload grading worksheet": Identifier
    ("Participant 123"), Full name, Grade, Last modified (grade), Feedback comments. Moodle finds the columns
    by their English names and a learner by the Identifier; it passes over a grade above the assignment's
    maximum, and, as no date stands here, one that takes the place of another, unless "Allow updating records
    that have been modified more recently" is ticked
exports/canvas.csv, of what came from Canvas
    the gradebook: Student, ID, SIS User ID, SIS Login ID, Section, a column a lesson that was handed in; the
    row Points Possible. Canvas finds a learner by the ID, and an assignment by the column's name: one that is
    called otherwise there is offered as a new one. The row of points changes the assignment's own, and an
    empty cell takes a grade away
exports/nbgrader.csv
    the columns of `nbgrader export`: assignment, duedate, timestamp, student_id, last_name, first_name,
    email, raw_score, late_submission_penalty, score, max_score

Where that does not fit, the platform's own table is filled instead (`table`).

No cell begins like a formula: an apostrophe stands before one that would.
"""

import csv
import io

from imgproc_course.autograder.sanitize import spreadsheet_text

COLUMNS = (
    "learner",
    "lesson",
    "points",
    "max_points",
    "percent",
    "late",
    "submitted_at",
    "submissions",
    "status",
    "findings",
    "file",
    "platform_id",
)


def grades_csv(grades):
    """grades.csv's text, from what grades.json holds."""
    rows = [_grades_row(learner, lesson) for learner in grades["learners"] for lesson in learner["lessons"]]
    return "\ufeff" + _text(COLUMNS, rows)


def _grades_row(learner, lesson):
    told = [lesson["reason"]] if lesson["reason"] else []
    told += [_notice(notice) for notice in lesson["findings"]]
    return (
        learner["name"],
        lesson["lesson"] or "(unknown)",
        lesson["points"],
        lesson["max_points"],
        _percent(lesson),
        "late" if lesson["late"] else "",
        lesson["submitted_at"] or "",
        1 + len(lesson["earlier"]),
        lesson["status"],
        "; ".join(told),
        lesson["file"],
        lesson["platform_id"],
    )


def _notice(notice):
    return f"{notice['exercise']}: {notice['text']}" if notice["exercise"] else notice["text"]


def _percent(lesson):
    return round(100 * lesson["points"] / lesson["max_points"], 1) if lesson["max_points"] else 0


def exports(grades):
    """The tables for other programs.

    Parameters
    ----------
    grades : dict, what grades.json holds

    Returns
    -------
    {file name: text}
    """
    lessons = lessons_of(grades)
    files = {"nbgrader.csv": _nbgrader(grades, lessons)}
    for name in lessons:
        rows = list(_moodle_rows(grades, name))
        if rows:
            columns = ("Identifier", "Full name", "Grade", "Last modified (grade)", "Feedback comments")
            files[f"moodle-{name}.csv"] = _text(columns, rows)
    canvas = [learner for learner in grades["learners"] if _of_platform(learner, "canvas")]
    if canvas:
        files["canvas.csv"] = _canvas(canvas, lessons)
    return files


def lessons_of(grades):
    """{lesson: what the first key says of it}, of lessons with points."""
    return {
        each["lesson"]: each
        for key in reversed(grades["keys"])
        for each in key["lessons"]
        if each["max_points"]
    }


def _of_platform(learner, platform):
    return next((each for each in learner["lessons"] if each["platform"] == platform), None)


def _moodle_rows(grades, name):
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            if lesson["lesson"] == name and lesson["platform"] == "moodle":
                told = f"{lesson['points']} of {lesson['max_points']} points"
                told += f"; not graded: {lesson['reason']}" if lesson["reason"] else ""
                yield f"Participant {lesson['platform_id']}", learner["name"], lesson["points"], "", told


def _canvas(learners, lessons):
    # A column of nothing would make a new assignment, or take away the grades of an old one.
    handed_in = {each["lesson"] for learner in learners for each in learner["lessons"]}
    lessons = {name: about for name, about in lessons.items() if name in handed_in}
    columns = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section", *lessons)
    rows = [("    Points Possible", "", "", "", "", *(each["max_points"] for each in lessons.values()))]
    for learner in learners:
        got = {each["lesson"]: each["points"] for each in learner["lessons"]}
        number = int(_of_platform(learner, "canvas")["platform_id"])
        rows.append((learner["name"], number, "", "", "", *(got.get(name, "") for name in lessons)))
    return _text(columns, rows)


def _nbgrader(grades, lessons):
    columns = ["assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email"]
    columns += ["raw_score", "late_submission_penalty", "score", "max_score"]
    rows = []
    for name, about in lessons.items():
        for learner in grades["learners"]:
            found = next((each for each in learner["lessons"] if each["lesson"] == name), None)
            got = float(found["points"]) if found else 0.0
            when = ((found["submitted_at"] or "") if found else "").replace("T", " ")
            due = (grades["deadline"] or "").replace("T", " ")
            row = (name, due, when, learner["name"], "", "", "", got, 0.0, got, float(about["max_points"]))
            rows.append(row)
    return _text(columns, rows)


def _text(columns, rows):
    buffer = io.StringIO()
    writer = csv.writer(buffer, quoting=csv.QUOTE_NONNUMERIC, lineterminator="\r\n")
    writer.writerow(columns)
    writer.writerows([spreadsheet_text(value) for value in row] for row in rows)
    return buffer.getvalue()
