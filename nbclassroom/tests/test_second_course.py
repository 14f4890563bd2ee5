"""Another course, without ROS and without images, from its masters to the grades of two learners."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

COURSE = Path(__file__).with_name("course")
ANSWERS = {
    "ada": (
        "def total(numbers):\n    return sum(numbers)",
        "def row_means(array):\n    return array.mean(1)",
    ),
    "bob": ("def total(numbers):\n    return sum(numbers[:-1])", "def row_means(array):\n    return 1 / 0"),
}


@pytest.fixture(scope="module")
def lessons(tmp_path_factory):
    """The folder of the course, built; in it commands run, as somebody's who has no other course."""
    folder = tmp_path_factory.mktemp("second") / "lessons"
    shutil.copytree(COURSE, folder)
    assert "Lessons built into" in run(folder, "build")
    return folder


def environment():
    left_out = ("NBCLASSROOM_COURSE", "PYTEST_CURRENT_TEST")
    return {name: value for name, value in os.environ.items() if name not in left_out}


def run(folder, *arguments, code=0):
    """What a command prints that runs in a folder."""
    command = [sys.executable, "-m", "nbclassroom", *map(str, arguments)]
    ended = subprocess.run(command, cwd=folder, env=environment(), capture_output=True, text=True)
    assert ended.returncode == code, ended.stdout + ended.stderr
    return ended.stdout + ended.stderr


def submit(folder, source, target, answers):
    """Write a lesson's notebook with answers in its answer cells, in order."""
    notebook = nbformat.read(source, as_version=4)
    cells = [cell for cell in notebook.cells if cell["id"].startswith("answer-")]
    for cell, answer in zip(cells, answers, strict=True):
        cell.source = answer
    target.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, target)
    return notebook


def test_a_lesson_is_handed_out_and_checked_in_a_kernel(lessons, tmp_path):
    handed_out = tmp_path / "handout"
    run(lessons, "handout", handed_out)
    assert {path.name for path in handed_out.iterdir() if path.is_file()} >= {"01_sums.ipynb", "course.toml"}
    shown = {}
    for name, (total, _) in ANSWERS.items():
        notebook = submit(lessons, handed_out / "01_sums.ipynb", tmp_path / f"{name}.ipynb", [total])
        client = NotebookClient(notebook, resources={"metadata": {"path": str(handed_out)}})
        client.execute(env=environment())
        (cell,) = (cell for cell in notebook.cells if cell["id"].startswith("check-"))
        shown[name] = " ".join(output["data"]["text/plain"] for output in cell.outputs if "data" in output)
    assert "Points here: 1 of 1." in shown["ada"]
    assert "The last number is missing in your sum." in shown["bob"]


@pytest.mark.sandbox
def test_two_learners_are_graded(lessons, tmp_path):
    for name, answers in ANSWERS.items():
        for lesson, answer in zip(("01_sums", "02_arrays"), answers, strict=True):
            submit(
                lessons, lessons / f"{lesson}.ipynb", tmp_path / "sent" / name / f"{lesson}.ipynb", [answer]
            )
    assert "exercises with points 2" in run(lessons, "key", "--out", tmp_path / "key")
    run(lessons, "grade", tmp_path / "sent", "--key", tmp_path / "key", "--out", tmp_path / "grades")
    grades = json.loads((tmp_path / "grades" / "grades.json").read_text())
    points = {learner["name"]: (learner["points"], learner["max_points"]) for learner in grades["learners"]}
    assert points == {"ada": (5, 5), "bob": (0, 5)}
    page = (tmp_path / "grades" / grades["learners"][1]["page"]).read_text(encoding="utf-8")
    assert "Two small lessons" in page and "ZeroDivisionError" in page


def test_without_a_course_a_command_says_what_is_missing(tmp_path):
    printed = run(tmp_path, "build", code=1)
    assert printed == (
        f"Error: no course.toml in {tmp_path} or above; go to the folder of a course, or set"
        " NBCLASSROOM_COURSE\n"
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("title = 'x'", "it has no name; the keys are name, title, "),
        ("name = 'a'\ntitle = 'x'\nteacher = 'y'", "nothing reads teacher; the keys are name, title, "),
        ("name = 'a'\ntitle = ['x']", "title must be a text, and is ['x']"),
        ("name = ", "it cannot be read: "),
    ],
)
def test_what_is_wrong_with_a_course_is_one_line(tmp_path, text, problem):
    (tmp_path / "course.toml").write_text(text)
    printed = run(tmp_path, "build", code=1)
    assert printed.startswith(f"Error: {tmp_path}/course.toml: {problem}") and printed.count("\n") == 1


def test_no_module_of_another_course_is_imported(lessons):
    modules = ("cli", "exercises", "gradebook.grade", "lab.server")
    code = f"import sys, {', '.join(f'nbclassroom.{name}' for name in modules)};"
    code += "print([name for name in sys.modules if 'imgproc' in name or name in ('rclpy', 'cv2', 'scipy')])"
    ended = subprocess.run(
        [sys.executable, "-c", code], cwd=lessons, env=environment(), capture_output=True, text=True
    )
    assert ended.stdout == "[]\n", ended.stderr
