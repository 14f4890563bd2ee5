"""Whose points changed since the run before."""

import json

from .grades_json import FORMAT
from .report import count_of

PREVIOUS = "grades.previous.json"
_MOST_LINES = 20
_NOT_THERE = "not there"


def read_grades(path):
    """The content of a grades.json, or None if there is none in today's format."""
    try:
        grades = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return grades if isinstance(grades, dict) and grades.get("format") == FORMAT else None


def changed_points(before, after):
    """Lines for the terminal: each lesson whose points differ in two contents of grades.json."""
    old, new = map(_points_of_lessons, (before, after))
    lines = [
        f"  {name}: {lesson}: {old.get((name, lesson), _NOT_THERE)} → {new.get((name, lesson), _NOT_THERE)}"
        for name, lesson in sorted(old.keys() | new.keys())
        if old.get((name, lesson)) != new.get((name, lesson))
    ]
    first = f"{count_of(len(lines), 'lesson')} with other points than in the run before ({PREVIOUS}):"
    more = [f"  and {len(lines) - _MOST_LINES} more"] if len(lines) > _MOST_LINES else []
    return [first, *lines[:_MOST_LINES], *more] if lines else []


def _points_of_lessons(grades):
    return {
        (learner["name"], lesson["lesson"] or lesson["file"]): _points(lesson)
        for learner in grades["learners"]
        for lesson in learner["lessons"]
    }


def _points(lesson):
    if lesson["status"] == "not graded":
        return f"not graded: {lesson['reason']}"
    if lesson.get("decision") and lesson["decision"]["excused"]:
        return "excused"
    text = f"{lesson['points']} of {lesson['max_points']}"
    if lesson.get("late_deduction"):
        text += f", {lesson['late_deduction']} deducted because late"
    decided = f", decided by hand; the autograder gives {lesson.get('autograded_points')}"
    return text + (decided if lesson.get("decision") else "")
