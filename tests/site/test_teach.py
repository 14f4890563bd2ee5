"""The pages for instructors: one for each lesson, and plans with the points of the lessons."""

import re
from pathlib import Path

import pytest

from imgproc_course.classroom.authoring.masters import find_masters, read_master

ROOT = Path(__file__).parents[2]
TEACH = ROOT / "docs/teach"
MASTERS = {master.name: master for master in map(read_master, find_masters(ROOT / "notebooks/masters"))}
EXERCISES = {exercise.id: exercise for master in MASTERS.values() for exercise in master.exercises}
LESSON_OF = {exercise.id: name for name, master in MASTERS.items() for exercise in master.exercises}
SECTIONS = ["What learners get wrong", "Where they stop", "Ask the room", "What can be left out"]


def exercises_in(text):
    """The exercises that a text names with their points."""
    return [(name, int(points)) for name, points in re.findall(r"`([\w-]+)` \((\d+)\)", text)]


def plans():
    """The rows of each plan as lists of cells, and the points that the text below names."""
    for text in (TEACH / "plans.md").read_text("utf-8").split("\n## ")[1:3]:
        rows = [line.strip("| ").split(" | ") for line in text.splitlines() if re.match(r"\| \d", line)]
        yield rows, int(re.search(r"Together (\d+) points", text)[1])


def test_every_lesson_has_a_page_and_every_page_a_lesson():
    pages = {path.stem for path in (TEACH / "lessons").glob("*.md")} - {"index"}
    assert pages == set(MASTERS)


@pytest.mark.parametrize("name", MASTERS)
def test_a_page_has_its_parts(name):
    title, *parts = (TEACH / "lessons" / f"{name}.md").read_text("utf-8").split("\n## ")
    assert title.startswith(f"# {MASTERS[name].title}\n\n**What it is for.**")
    assert [part.splitlines()[0] for part in parts] == SECTIONS
    assert len(re.findall(r"^\d\. \*\*", parts[0], re.M)) == 5
    assert len(re.findall(r"^\d\. .*\? \*.*\*$", parts[2], re.M)) == 3


def test_the_plans_name_the_points_of_the_exercises():
    named = exercises_in((TEACH / "plans.md").read_text("utf-8"))
    assert len(named) > 30
    assert [(name, EXERCISES[name].points) for name, _ in named] == named


def test_the_points_of_the_plans_add_up():
    lengths = []
    for rows, together in plans():
        lengths.append(len(rows))
        assert [sum(points for _, points in exercises_in(row[4])) for row in rows] == [
            int(row[5]) for row in rows
        ]
        assert sum(int(row[5]) for row in rows) == together
    assert lengths == [6, 6]


def test_what_is_handed_in_are_the_lessons_of_the_exercises():
    for rows, _ in plans():
        for row in rows:
            lessons = re.findall(r"\[\[(\w+)\]\]", row[1])
            owners = dict.fromkeys(LESSON_OF[name] for name, _ in exercises_in(row[4]))
            assert re.findall(r"`(\w+)`", row[6]) == list(owners), row[0]
            assert set(owners) <= set(lessons), row[0]
            assert row[2:4] == [f"[[{part}: {', '.join(lessons)}]]" for part in ("core", "whole")]


def test_a_built_page_says_the_minutes_and_the_points(built):
    for name, master in MASTERS.items():
        page = (built[1] / "teach/lessons" / f"{name}.html").read_text("utf-8")
        assert f"{master.core_minutes} minutes for the core, {master.minutes} for all of it" in page
        assert all(exercise.id in page for exercise in master.exercises)
    for page in ("plans", "learners"):
        assert "[[" not in (built[1] / f"teach/{page}.html").read_text("utf-8")
