"""What is exported: tables of points for a spreadsheet, and the learners' pages as zips.

Moodle reads the participant's number and the kind of file from a folder's name in the zip, such as
Ada Lovelace_12345_assignsubmission_file; Canvas reads the numbers of the learner and of the submitted file
from a file's name, lovelaceada_77_100_20_light.html. A platform has one maximum per assignment: if an
exercise is excused, the others' points are scaled to it.

Tables are UTF-8 with a byte order mark, by which spreadsheets recognize it. No cell begins like a formula: an
apostrophe is put before one that would.
"""

import csv
from pathlib import PurePosixPath

from ..authoring.learner_files import zip_bytes
from ..autograder.sanitize import spreadsheet_text
from .csv_table import csv_text
from .grades_json import lesson_names
from .report import finding_text
from .teacher_tables import plain_number

COLUMNS = (
    *("learner", "lesson", "points", "max_points", "percent", "late", "submitted_at", "submissions"),
    *("status", "findings", "file", "platform_id", "autograded_points", "days_late", "late_deduction"),
    *("page", "open_points"),
)
EXCUSED = "EX"  # what Canvas writes


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
