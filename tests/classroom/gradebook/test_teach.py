"""The ten commands of the page docs/teach/walk.md, as written, on thirty submissions; each lesson graded.

One key serves both. To draw the drives of a lesson takes minutes, so the lessons in which the robot drives
are not in it: test_drives.py has short drives, and tests/benchmarks/bench_term.py all lessons.
"""

import json
import os
import re
import subprocess
import sys
from datetime import datetime
from pathlib import Path

import pytest
from all_masters import PATHS as ALL_PATHS
from all_masters import all_masters
from master_answers import sample_answers
from nbclassroom.authoring.lesson_names import lesson_name
from nbclassroom.authoring.masters import read_master
from nbclassroom.gradebook.grade import grade_submissions
from submissions import answers_of, notebook, thirty, write

# Key and grading drive the robot, for minutes on a busy machine.
pytestmark = [pytest.mark.sandbox, pytest.mark.timeout(1800)]
CHECKOUT = Path(__file__).resolve().parents[3]
NOTEBOOKS = CHECKOUT / "notebooks"
KEY = "imgproc-course key --out key/"  # the command, without its comment
IS_WHOLE = bool(os.environ.get("WHOLE_TERM"))
HAS_DRIVE = re.compile(r'^ +subject="drive"', re.M)
PATHS = [path for path in ALL_PATHS if IS_WHOLE or not HAS_DRIVE.search(path.read_text(encoding="utf-8"))]
NAMES = [lesson_name(path.stem) for path in PATHS]


def commands():
    text = (CHECKOUT / "docs/teach/walk.md").read_text(encoding="utf-8")
    block = re.search(r"```sh\n(.*?)```", text, re.S)
    return [line for line in block[1].splitlines() if line.strip()]


def run(line, folder):
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    return subprocess.run(
        ["bash", "-c", line],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=900,  # `key` drives the robot for minutes, on a busy machine
    )


def grades_in(folder):
    grades = json.loads((folder / "grades" / "grades.json").read_text(encoding="utf-8"))
    return {learner["name"]: learner for learner in grades["learners"]}


@pytest.fixture(scope="module")
def keyed(tmp_path_factory):
    """A folder with the lessons' key in it, made by the walk's command."""
    folder = tmp_path_factory.mktemp("term")
    (line,) = (line for line in commands() if line.partition("#")[0].strip() == KEY)
    line = line if IS_WHOLE else line.replace("key --out", f"key {' '.join(NAMES)} --out")
    ended = run(line, folder)
    assert ended.returncode == 0, ended.stderr
    return folder


def test_a_term_in_ten_commands(keyed):
    lines, tmp_path = commands(), keyed
    assert len(lines) == 10
    masters = [all_masters()[name] for name in NAMES]
    masters = [each for each in masters if any(not exercise.practice for exercise in each.exercises)]
    has_mistakes = {exercise.id for each in masters for exercise in each.exercises if exercise.mistakes}
    submitted, graded = [], 0
    for line in lines:
        if line.startswith(KEY):
            continue
        if "imgproc-course grade" in line and graded == 0:
            submitted = thirty(tmp_path / "submissions", masters)
        elif "imgproc-course grade" in line:
            own = read_master(next((tmp_path / "my_masters").glob("*.py")))
            made = notebook(own, answers_of(own, "right"))
            write(tmp_path / "submissions" / "own" / "x.ipynb", made, datetime(2026, 12, 2))
        ended = run(line, tmp_path)
        if "imgproc-course grade" not in line:
            assert ended.returncode == 0, f"{line}\n{ended.stdout}\n{ended.stderr}"
            continue
        assert ended.returncode == 3, ended.stderr  # some of the thirty are broken
        graded += 1
        learners = grades_in(tmp_path)
        for learner, lesson, kind in submitted:
            (of,) = learners[learner]["lessons"]
            assert of["lesson"] == lesson
            assert of["status"] == ("not graded" if kind == "broken" else "graded")
            if kind == "right":
                assert of["points"] == of["max_points"] - of["open_points"] > 0, learner
            elif kind in ("untouched", "raising", "broken"):
                assert of["points"] == 0, learner
            else:
                assert of["points"] < of["max_points"], learner
                unnamed = {each["id"] for each in of["exercises"] if not each["mistake"]}
                assert not unnamed & has_mistakes, learner
    assert graded == 2
    assert grades_in(tmp_path)["own"]["points"] == 3
    pages = list((tmp_path / "grades" / "learners").iterdir())
    zips = list((tmp_path / "grades" / "exports").glob("feedback-*.zip"))
    assert len(pages) == 31 and zips
    handed_out = sorted(path.stem for path in (tmp_path / "handout").glob("[0-9]*.ipynb"))
    assert handed_out == [path.stem for path in ALL_PATHS]
    assert (tmp_path / "handout" / "checks" / "grayscale.json").is_file()
    assert not (tmp_path / "handout" / "solutions").exists()
    assert (tmp_path / "handout.zip").is_file() and (tmp_path / "handout_mine.zip").is_file()


def first_mistakes(master):
    return {each.id: list(sample_answers(each).values())[-len(each.mistakes)] for each in master.exercises}


@pytest.fixture(scope="module")
def grades(keyed, tmp_path_factory):
    """The grades of three learners: who left every lesson as it was, solved it, or made known mistakes."""
    folder = tmp_path_factory.mktemp("lessons")
    for master in map(all_masters().get, NAMES):
        lesson = (NOTEBOOKS / f"{master.path.stem}.ipynb").read_bytes()
        write(folder / "in" / "pristine" / f"{master.name}.ipynb", lesson)
        solutions = {each.id: each.solution for each in master.exercises}
        write(folder / "in" / "solved" / f"{master.name}.ipynb", notebook(master, solutions))
        write(folder / "in" / "mistaken" / f"{master.name}.ipynb", notebook(master, first_mistakes(master)))
    grade_submissions(folder / "in", [keyed / "key"], folder / "grades", workers=2)
    return folder


@pytest.fixture(scope="module")
def learners(grades):
    return {
        name: {lesson["lesson"]: lesson for lesson in learner["lessons"]}
        for name, learner in grades_in(grades).items()
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_lesson_as_handed_out_gets_no_points(learners, name):
    lesson = learners["pristine"][name]
    assert (lesson["points"], lesson["findings"], lesson["status"]) == (0, [], "graded")


@pytest.mark.parametrize("name", NAMES)
def test_the_solved_lesson_gets_every_point(learners, name):
    lesson = learners["solved"][name]
    assert lesson["points"] == lesson["max_points"] - lesson["open_points"]
    assert (lesson["max_points"] > 0) == bool(lesson["exercises"])


@pytest.mark.parametrize("name", NAMES)
def test_the_first_mistake_of_each_exercise_is_named_and_costs_points(learners, name):
    graded = {each["id"]: each for each in learners["mistaken"][name]["exercises"]}
    for each in all_masters()[name].exercises:
        if each.mistakes and not each.practice:
            assert graded[each.id]["mistake"] == each.mistakes[0].name
            assert graded[each.id]["points"] < graded[each.id]["max_points"] == each.points


def test_nothing_else_was_found(learners):
    assert {name: sorted(lessons) for name, lessons in learners.items()} == {
        name: sorted(NAMES) for name in ("pristine", "solved", "mistaken")
    }


def test_a_check_that_gives_no_points_says_so(grades):
    for path in (grades / "grades" / "learners").iterdir():
        text = path.read_text(encoding="utf-8")
        assert "(no points)" in text and "(0 of 0)" not in text
