"""Every lesson gets no points as it is handed out, and every point with its solutions."""

import json
from pathlib import Path

import pytest
from submissions import notebook, write

from imgproc_course.classroom.authoring.lesson_names import lesson_name
from imgproc_course.classroom.authoring.masters import find_masters, read_master
from imgproc_course.classroom.autograder.make_answer_key import make_key
from imgproc_course.classroom.gradebook.grade import grade_submissions

# Key and grading drive the robot, for minutes on a busy machine.
pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("answer_key"), pytest.mark.timeout(1800)]
NOTEBOOKS = Path(__file__).resolve().parents[3] / "notebooks"
NAMES = [lesson_name(path.stem) for path in find_masters(NOTEBOOKS / "masters")]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """With the key, the submissions of two learners, and their grades."""
    folder = tmp_path_factory.mktemp("lessons")
    make_key(NOTEBOOKS / "masters", "of this test", folder / "key")
    for path in find_masters(NOTEBOOKS / "masters"):
        master = read_master(path)
        write(
            folder / "in" / "pristine" / f"{master.name}.ipynb",
            (NOTEBOOKS / f"{path.stem}.ipynb").read_bytes(),
        )
        solutions = {each.id: each.solution for each in master.exercises}
        write(folder / "in" / "solved" / f"{master.name}.ipynb", notebook(master, solutions))
    grade_submissions(folder / "in", [folder / "key"], folder / "grades", workers=2, quiet=True)
    return folder


@pytest.fixture(scope="module")
def learners(folder):
    grades = json.loads((folder / "grades" / "grades.json").read_text(encoding="utf-8"))
    return {
        learner["name"]: {lesson["lesson"]: lesson for lesson in learner["lessons"]}
        for learner in grades["learners"]
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_lesson_as_handed_out_gets_no_points(learners, name):
    lesson = learners["pristine"][name]
    assert (lesson["points"], lesson["findings"], lesson["status"]) == (0, [], "graded")


@pytest.mark.parametrize("name", NAMES)
def test_the_solved_lesson_gets_every_point(learners, name):
    lesson = learners["solved"][name]
    assert lesson["points"] == lesson["max_points"]
    assert (lesson["max_points"] > 0) == bool(lesson["exercises"])


def test_nothing_else_was_found(learners):
    assert sorted(learners["pristine"]) == sorted(learners["solved"]) == sorted(NAMES)


def test_a_check_that_gives_no_points_says_so(folder):
    for path in (folder / "grades" / "learners").iterdir():
        text = path.read_text(encoding="utf-8")
        assert ">no points<" in text and ">0 of 0<" not in text
