"""What changed between two runs: points, status and lateness of each learner's lessons and exercises."""

import json

from .grades_json import FORMAT
from .report import render_page

PREVIOUS = "grades.previous.json"


def read_grades(path):
    """The content of a grades.json, or None if there is none in today's format."""
    try:
        grades = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return grades if isinstance(grades, dict) and grades.get("format") == FORMAT else None


def changes_page(before, after, names):
    """The teacher's page of what changed between two contents of grades.json, HTML.

    `names` are {learner's name: the name to show}.
    """
    rows = [row | {"learner": names.get(row["learner"], "(gone)")} for row in changes_between(before, after)]
    return render_page("changes.html", rows=rows)


def changes_between(before, after):
    """The differences of two contents of grades.json.

    Yields dicts: learner, page (of the later run, or ""), lesson, exercise (or ""), before, after: texts.
    """
    old, new = _learners(before), _learners(after)
    for name in sorted({*old, *new}, key=lambda name: (name.casefold(), name)):
        about = {"learner": name, "page": new[name]["page"] if name in new else ""}
        old_parts, new_parts = (_parts(learners.get(name)) for learners in (old, new))
        for lesson, exercise in {**old_parts, **new_parts}:
            texts = [parts.get((lesson, exercise), "not there") for parts in (old_parts, new_parts)]
            if texts[0] != texts[1]:
                part = {"lesson": lesson, "exercise": exercise, "before": texts[0], "after": texts[1]}
                yield about | part


def _learners(grades):
    return {learner["name"]: learner for learner in grades["learners"]}


def _parts(learner):
    """{(lesson, exercise or ""): text}, the lesson's own text first."""
    parts = {}
    for lesson in learner["lessons"] if learner else ():
        name = lesson["lesson"] or lesson["file"]
        parts[name, ""] = _text(lesson)
        parts |= {(name, exercise["id"]): _text(exercise) for exercise in lesson["exercises"]}
    return parts


def _text(entry):
    if entry.get("status") == "not graded":
        return f"not graded: {entry['reason']}"
    if entry.get("decision") and entry["decision"]["excused"]:
        return "excused"
    text = f"{entry['points']} of {entry['max_points']}"
    if entry.get("late_deduction"):
        text += f", {entry['late_deduction']} deducted because late"
    return text + (", decided by hand" if entry.get("decision") else "")
