"""The pages for instructors: one for each lesson, and plans with the points of the lessons."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from all_masters import PATHS, all_exercises, all_masters
from nbclassroom.authoring.lesson_names import lesson_name

ROOT = Path(__file__).parents[2]
TEACH = ROOT / "docs/teach"
NAMES = [lesson_name(path.stem) for path in PATHS]
SECTIONS = ["What learners get wrong", "Where they stop", "Ask the room", "What can be left out"]


def exercises_in(text):
    """The exercises that a text names with their points."""
    return [(name, int(points)) for name, points in re.findall(r"`([\w-]+)` \((\d+)\)", text)]


def plans():
    """The rows of each plan as lists of cells, and the points below it: asked, and in grading."""
    for text in (TEACH / "plans.md").read_text("utf-8").split("\n## ")[1:3]:
        rows = [line.strip("| ").split(" | ") for line in text.splitlines() if re.match(r"\| \d", line)]
        sums = re.search(r"Together (\d+) points, of (\d+) in grading", text)
        yield rows, tuple(map(int, sums.groups()))


def points_in_grading(lessons):
    return sum(exercise.points for name in lessons for exercise in all_masters()[name].exercises)


def test_every_lesson_has_a_page_and_every_page_a_lesson():
    pages = {path.stem for path in (TEACH / "lessons").glob("*.md")} - {"index"}
    assert pages == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_page_has_its_parts(name):
    title, *parts = (TEACH / "lessons" / f"{name}.md").read_text("utf-8").split("\n## ")
    assert title.startswith(f"# {all_masters()[name].title}\n\n**What it is for.**")
    assert [part.splitlines()[0] for part in parts] == SECTIONS
    assert len(re.findall(r"^\d\. \*\*", parts[0], re.M)) == 5
    assert len(re.findall(r"^\d\. .*\? \*.*\*$", parts[2], re.M)) == 3


def test_the_plans_name_the_points_of_the_exercises():
    named = exercises_in((TEACH / "plans.md").read_text("utf-8"))
    assert len(named) > 30
    assert [(name, all_exercises()[name].points) for name, _ in named] == named


def test_the_points_of_the_plans_add_up():
    lengths = []
    for rows, together in plans():
        lengths.append(len(rows))
        asked = [sum(points for _, points in exercises_in(row[4] + row[5])) for row in rows]
        assert asked == [int(row[6]) for row in rows]
        assert (sum(asked), sum(int(row[7]) for row in rows)) == together
    assert lengths == [6, 6]
    first, second = (together for _, together in plans())
    text = (TEACH / "plans.md").read_text("utf-8")
    assert f"these are {first[0] + second[0]} of {first[1] + second[1]}." in text
    left_out = points_in_grading(["noise_removal", "binarization"])
    assert f"{first[0] - 17} points are left, of {first[1] - left_out} in grading" in text


def test_the_plans_name_the_maximum_of_grading_and_what_is_homework():
    lesson_of = {exercise.id: name for name, master in all_masters().items() for exercise in master.exercises}
    for rows, _ in plans():
        for row in rows:
            lessons = re.findall(r"\[\[(\w+)\]\]", row[1])
            core, homework = ([name for name, _ in exercises_in(cell)] for cell in row[4:6])
            owners = dict.fromkeys(lesson_of[name] for name in core + homework)
            assert int(row[7]) == points_in_grading(owners), row[0]
            deeper = {name for lesson in lessons for name in all_masters()[lesson].deeper_exercises}
            assert set(homework) <= deeper and not deeper & set(core), row[0]
            assert set(owners) == {lesson for lesson in lessons if points_in_grading([lesson])}
            assert row[2:4] == [f"[[{part}: {', '.join(lessons)}]]" for part in ("core", "whole")]


def test_the_lines_for_the_total_add_up_the_weeks(tmp_path):
    weeks = [
        {"learners": [{"name": "Ada", "points": 8}, {"name": "Bob", "points": 2.5}], "roster": None},
        {"learners": [{"name": "Ada", "points": 3}], "roster": {"missing": ["Bob", "Cy"]}},
    ]
    for number, grades in enumerate(weeks, 1):
        folder = tmp_path / "grades" / f"week_{number}"
        folder.mkdir(parents=True)
        (folder / "grades.json").write_text(json.dumps(grades), "utf-8")
    source = re.search(r"```python\n(.*?)```", (TEACH / "plans.md").read_text("utf-8"), re.S)[1]
    command = [sys.executable, "-c", source]
    ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["11", "Ada", "2.5", "Bob", "0", "Cy"]


def test_a_built_page_says_the_minutes_and_the_points(built):
    for name, master in all_masters().items():
        page = (built[1] / "teach/lessons" / f"{name}.html").read_text("utf-8")
        assert f"{master.core_minutes} minutes for the core, {master.minutes} for all of it" in page
        assert all(exercise.id in page for exercise in master.exercises)
        assert f"<h1>For teachers: {master.title}<" in page
    for page in ("plans", "learners"):
        assert "[[" not in (built[1] / f"teach/{page}.html").read_text("utf-8")
