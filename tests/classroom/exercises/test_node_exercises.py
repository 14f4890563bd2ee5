"""The node exercises of the lessons: verdicts and sentences on many answers, with rclpy and without it."""

import contextlib
import json
import subprocess
import sys
import time
from pathlib import Path

import pytest
from answer_names import names_of_answer
from node_answers import ANSWERS

from imgproc_course.classroom.exercises.checking import run_check
from imgproc_course.classroom.exercises.declaration import read_exercises
from imgproc_course.classroom.exercises.expected_results import check_data_of
from imgproc_course.classroom.exercises.node_driver import drive
from imgproc_course.classroom.exercises.ros_double import offer_modules

MASTERS = Path(__file__).parents[3] / "notebooks/masters"
EXERCISES = {
    exercise.id: exercise
    for lesson in ("05_grayscale_node", "09_edge_detection_node")
    for exercise in read_exercises(MASTERS / f"{lesson}.py")
}
OTHER_TEXTS = ("Image in quotes", "publishes an array")  # rclpy's own errors have another text
WITHOUT_ROS = """
import json, sys
from imgproc_course.classroom.exercises.ros_double import offer_modules
offer_modules(even_if_installed=True)
sys.path[:0] = sys.argv[1:]
from test_node_exercises import ANSWERS, outcome_of
print(json.dumps([outcome_of(answer) for answer in ANSWERS]))
"""


def result_of(answer):
    """The CheckResult of an answer on all cases, with those that only grading runs."""
    exercise = EXERCISES[answer.exercise]
    data = check_data_of(exercise, exercise.cases)
    names, error = names_of_answer(data, answer.source)
    assert not error
    return run_check(data, names[exercise.function])


def outcome_of(answer):
    """[the cases that an answer passes, as `node_answers` names them; what `check` says]."""
    result = result_of(answer)
    names = [
        "h" if case.case.hidden else case.case.id.split("-")[-1] for case in result.results if case.passed
    ]
    return ["".join(names), " ".join(str(result).split())]


@pytest.mark.parametrize("answer", ANSWERS, ids=[f"{a.exercise}: {a.name}" for a in ANSWERS])
def test_an_answer_passes_its_cases_and_is_told_why_not_the_others(answer):
    passes, text = outcome_of(answer)
    assert (passes, answer.says in text) == (answer.passes, True), text
    assert "a dict" not in text and "In answer[" not in text


@pytest.mark.ros
def test_verdicts_and_sentences_are_the_same_without_ros():
    folders = [str(Path(__file__).parent), str(Path(__file__).parents[2])]
    run = subprocess.run(
        [sys.executable, "-c", WITHOUT_ROS, *folders], capture_output=True, text=True, check=True, timeout=300
    )
    for answer, (passes, text) in zip(ANSWERS, json.loads(run.stdout), strict=True):
        real_passes, real_text = outcome_of(answer)
        assert passes == real_passes, answer.name
        if answer.name not in OTHER_TEXTS:
            assert text == real_text, answer.name


def test_the_same_reason_is_said_once():
    reliable = next(answer for answer in ANSWERS if answer.name == "reliable")
    text = str(result_of(reliable))
    assert text.count("The image did not reach your node") == 1
    assert text.count("as in step 2 above") == 2  # step 3 and the hidden case


def test_a_drive_leaves_nothing_behind():
    offer_modules()
    names = {"__name__": "answer"}
    exec("from time import sleep\nimport rclpy\n" + ANSWERS[0].source, names)
    node_module = sys.modules["rclpy.node"]
    before = (time.sleep, names["sleep"], node_module.Node.__init__, sys.modules["rclpy"].spin)
    for look, steps in (("setup", []), ("images", [{"image": None}])):
        with contextlib.suppress(KeyError):  # of the second one, whose step is no step
            drive(names["ImageGrayProcessor"], look, steps)
    after = (time.sleep, names["sleep"], node_module.Node.__init__, sys.modules["rclpy"].spin)
    assert after == before


def test_ros_stays_missing_where_the_double_takes_its_place():
    program = (
        "from imgproc_course.exercises import offer_modules\n"
        "from imgproc_course.classroom.exercises import ros_double\n"
        "ros_double.offer_modules(even_if_installed=True)\n"
        "from imgproc_course.ros import ros_available, ros_problem\n"
        "import rclpy.node, sensor_msgs.msg, cv_bridge\n"
        "print(ros_available(), ros_problem()[:16], cv_bridge.__name__)"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=120
    )
    assert run.stdout.split("\n")[0] == "False ROS 2 is missing imgproc_course.messages.cv_bridge"
