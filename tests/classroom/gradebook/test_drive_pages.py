"""What the pages and grades.json show of drives."""

import json
import os
from pathlib import Path

import pytest
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import usual_workers
from nbclassroom.gradebook.answer_keys import AnswerKeys
from nbclassroom.gradebook.grade import grade_submissions
from nbclassroom.gradebook.report import _way
from submissions import notebook, write

pytestmark = [pytest.mark.sandbox, pytest.mark.timeout(300)]

MASTERS = Path(__file__).parents[1] / "autograder/driving/masters"
SLOW = "def control(observation, memory):\n    return 0.1, 0.0"
SENTENCE = (
    "The robot drove {0} m; the task asks for at least {1} m. The robot never drove faster than 0.10 m/s;"
)
SENTENCE = f"{SENTENCE} it can drive with 0.3 m/s (bumps 0, distance driven {{0}} m)".format
PUBLIC, HIDDEN = SENTENCE("0.09", "0.15"), SENTENCE("0.19", "0.30")


@pytest.fixture(scope="module")
def grades(tmp_path_factory):
    """The folder of grades of two learners."""
    folder = tmp_path_factory.mktemp("drives")
    make_key(MASTERS, "a-secret-of-the-tests", folder / "key")
    master = read_master(find_masters(MASTERS)[0])
    for name, source in {"ada": master.exercises[0].solution, "bo": SLOW}.items():
        write(folder / "submissions" / name / "10_driven.ipynb", notebook(master, {"driven-control": source}))
    grade_submissions(folder / "submissions", [folder / "key"], folder / "grades", workers=1)
    return folder / "grades"


def test_where_robots_drive_each_core_has_a_worker(grades, answer_keys, monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 5)
    assert usual_workers(AnswerKeys([grades.parent / "key"]).lessons.values()) == 5
    assert usual_workers(answer_keys.lessons.values()) == 3


def test_grades_json_has_metrics_in_the_messages_and_no_path(grades):
    learners = json.loads((grades / "grades.json").read_text(encoding="utf-8"))["learners"]
    assert [learner["points"] for learner in learners] == [5, 0]
    cases = [learner["lessons"][0]["exercises"][0]["cases"] for learner in learners]
    assert cases[0][1]["message"] == "bumps 0, distance driven 0.45 m"
    assert {case["message"] for case in cases[1]} == {PUBLIC, HIDDEN}
    assert set(cases[1][0]) == {*("id", "title", "hidden", "points", "max_points", "outcome", "message")}


def test_a_learner_sees_the_map_of_a_public_drive_and_the_metrics_of_all(grades):
    (page,) = (path.read_text(encoding="utf-8") for path in (grades / "learners").glob("bo-*.html"))
    assert page.count("data:image/webp;base64,") == 1
    assert page.index("data:image/webp") < page.index("another way")
    assert "The robot drove 0.09 m; the task asks for at least 0.15 m." in page and page.count(HIDDEN) == 2
    assert "Drive faster than 0.1 m/s." in page and "returns another value" not in page


def test_the_teacher_sees_the_maps_of_hidden_drives_too(grades):
    page = (grades / "review" / "driven-control.html").read_text(encoding="utf-8")
    assert page.count("data:image/webp;base64,") == 6
    assert 'href="review.html"' in (grades / "summary.html").read_text(encoding="utf-8")


def test_answers_that_drive_alike_are_grouped_by_what_the_robot_did(grades):
    learners = json.loads((grades / "grades.json").read_text(encoding="utf-8"))["learners"]
    (exercise,) = learners[1]["lessons"][0]["exercises"]
    assert _way(exercise | {"mistake": ""})[0] == f"a free way: {PUBLIC}"
