"""The node exercises of the lessons: verdicts and sentences on many answers, with rclpy and without it."""

import contextlib
import json
import subprocess
import sys
import time
from pathlib import Path

import pytest
from answer_names import names_of_answer
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.checking import run_check
from nbclassroom.exercises.declaration import read_exercises
from nbclassroom.exercises.kinds.node.feed import feed
from nbclassroom.exercises.kinds.node.feedback import sentence_on_node
from nbclassroom.exercises.kinds.node.recording_node import NodeError, NotGradedError
from nbclassroom.exercises.kinds.node.ros_double import offer_modules
from nbclassroom.exercises.lesson import check_data_of
from node_answers import ANSWERS, STARTED, changed

MASTERS = Path(__file__).parents[3] / "notebooks/masters"
EXERCISES = {
    exercise.id: exercise
    for lesson in ("05_grayscale_node", "09_edge_detection_node", "12_obstacles_ahead")
    for exercise in read_exercises(MASTERS / f"{lesson}.py")
}
WITHOUT_ROS = """
import json, sys
from nbclassroom.exercises.kinds.node.ros_double import offer_modules
offer_modules(even_if_installed=True)
sys.path[:0] = sys.argv[1:]
from test_node_exercises import everything
print(json.dumps(everything()))
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


STEERS = """
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

class Steering(Node):
    def __init__(self):
        super().__init__("steering")
        self.commands = self.create_publisher(Twist, "~/cmd_vel", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.destroy_timer(self.create_timer(0.01, self.destroy_node))
        self.create_timer(0.1, self.on_timer)
        self.nearest = None

    def on_scan(self, msg):
        self.nearest = min(msg.ranges)

    def on_timer(self):
        command = Twist()
        command.linear.x = self.nearest / 2
        self.commands.publish(command)
"""
# A line of __init__, and what the check says that it does not know
REFUSED = {
    "self.create_service(Image, 'gray', self.image_callback)": "create_service of a node",
    "self.get_logger().set_level(10)": "set_level",
    "self.get_clock().now().seconds_nanoseconds()": "seconds_nanoseconds",
    "self.create_timer(1, print).time_until_next_call()": "time_until_next_call",
    "self.declare_parameter('low')": "declare_parameter without a first value",
    "self.set_parameters_atomically([])": "set_parameters_atomically of a node",
    "from rclpy.logging import get_logger; get_logger('a')": "get_logger",
    "super().__init__('a', namespace='b')": "namespace= of a node",
}


def drive_source(source, name, steps):
    """The steps of the record of a node; what it says if it cannot be driven."""
    offer_modules()
    names = {}
    exec(source, names)
    try:
        return feed(names[name], "images", steps)["steps"]
    except (NodeError, NotGradedError) as error:
        return str(error)


def everything():
    """What `check` says of each answer, what a node that steers does, and what is said of refused lines."""
    scan = {"topic": "/scan", "message": "LaserScan", "fields": {"ranges": [2.0, 1.0]}}
    sources = [changed((STARTED, f"        {line}\n")) for line in REFUSED]
    return [
        [outcome_of(answer) for answer in ANSWERS],
        drive_source(STEERS, "Steering", [scan]),
        [drive_source(source, "ImageGrayProcessor", []) for source in sources],
    ]


def everything_without_ros():
    folders = [str(Path(__file__).parent), str(Path(__file__).parents[2])]
    run = subprocess.run(
        [sys.executable, "-c", WITHOUT_ROS, *folders], capture_output=True, text=True, check=True, timeout=300
    )
    return json.loads(run.stdout)


@pytest.fixture(scope="module", params=["without ROS", pytest.param("with ROS", marks=pytest.mark.ros)])
def outcomes(request):
    return everything_without_ros() if request.param == "without ROS" else everything()


@pytest.mark.parametrize("answer", ANSWERS, ids=[f"{a.exercise}: {a.name}" for a in ANSWERS])
def test_an_answer_passes_its_cases_and_is_told_why_not_the_others(answer, outcomes):
    passes, text = outcomes[0][ANSWERS.index(answer)]
    assert (passes, answer.says in text) == (answer.passes, True), text
    assert "a dict" not in text and "In answer[" not in text


def test_a_node_reads_a_scan_and_steers_by_a_timer(outcomes):
    (published,) = outcomes[1][0]["published"]
    assert published["topic"] == "/steering/cmd_vel"
    assert (published["type"], published["fields"]["linear"]["x"]) == ("geometry_msgs/msg/Twist", 0.5)


def test_what_the_double_does_not_have_is_refused_by_name(outcomes):
    for text, name in zip(outcomes[2], REFUSED.values(), strict=True):
        assert text.startswith(f"This check does not know {name}"), text


def test_the_same_reason_is_said_once():
    reliable = next(answer for answer in ANSWERS if answer.name == "reliable")
    text = str(result_of(reliable))
    assert text.count("The message did not reach your node") == 1
    assert text.count("as in step 2 above") == 2  # step 3 and the hidden case


def test_a_drive_leaves_nothing_behind():
    offer_modules()
    names = {"__name__": "answer"}
    exec("from time import sleep\nimport rclpy\n" + ANSWERS[0].source, names)
    node_module = sys.modules["rclpy.node"]
    before = (time.sleep, names["sleep"], node_module.Node.__init__, sys.modules["rclpy"].spin)
    for part, steps in (("setup", []), ("images", [{"image": None}])):
        with contextlib.suppress(KeyError):  # of the second one, whose step is no step
            feed(names["ImageGrayProcessor"], part, steps)
    after = (time.sleep, names["sleep"], node_module.Node.__init__, sys.modules["rclpy"].spin)
    assert after == before


def test_ros_stays_missing_where_the_double_takes_its_place():
    program = (
        "from imgproc_course.exercises import offer_modules\n"
        "from nbclassroom.exercises.kinds.node import ros_double\n"
        "ros_double.offer_modules(even_if_installed=True)\n"
        "from imgproc_course.ros import ros_available, ros_problem\n"
        "import rclpy.node, sensor_msgs.msg, cv_bridge\n"
        "print(ros_available(), ros_problem()[:16], cv_bridge.__name__)"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=120
    )
    assert run.stdout.split("\n")[0] == "False ROS 2 is missing imgproc_course.messages.cv_bridge"


def test_a_wrong_speed_is_told_with_what_the_step_shows():
    right, wrong = (
        canonical({"steps": [{"published": [{"fields": {"linear": {"x": x}}}]}]}) for x in (0.2, 0.0)
    )
    text = sentence_on_node(right, wrong, ("commands", [{"about": "this scan has walls"}]))
    assert text.startswith("When this scan has walls, the robot must drive with 0.2 m/s, and the newest ")
    text = sentence_on_node(right, wrong, ("commands", [{"topic": "/camera"}]))
    assert text.startswith("When this message comes, the robot must drive")
    text = sentence_on_node(wrong, right, ("commands", [{"seconds": 0.6}]))
    assert text.startswith("When no message came for 0.6 s, the robot must stand, and the newest ")
