"""What the room's publisher computes and follows: subscribed topics alone, commands within limits."""

import importlib
import math
import re
import time
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"


@pytest.fixture
def body(session, monkeypatch):
    """A RoomPublisher in this process; its room counts what it computes, and its images are small."""
    from imgproc_course.ros import room_images
    from imgproc_course.ros.room_publisher import open_room
    from imgproc_course.simulation import Simulation

    class Counting(Simulation):
        def __init__(self, *args, **options):
            self.calls = {}
            super().__init__(*args, **options | {"size": (160, 90)})

        def count(self, name):
            self.calls[name] = self.calls.get(name, 0) + 1

    def counted(name):
        method = getattr(Simulation, name)

        def count(self, *arguments):
            self.count(arguments[0] if arguments else "front" if name == "depth" else name)
            return method(self, *arguments)

        return count

    for name in ("frame", "depth", "scan", "odometry", "pose"):
        setattr(Counting, name, counted(name))
    monkeypatch.setattr(room_images, "Simulation", Counting)
    request = {"seed": 0, "size": (640, 360), "lighting": "day", "start": (0.4, -0.3, 0.0), "room": None}
    body = open_room({"topic": TOPIC, "rate": 30.0} | request)
    body.start()
    yield body
    body.stop()


def test_a_topic_is_computed_only_while_somebody_subscribes(body, session, wait_until):
    from geometry_msgs.msg import PoseStamped
    from nav_msgs.msg import Odometry
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image, LaserScan

    wait_until(lambda: body.played > 20)
    calls = body._images.simulation.calls
    assert calls == {"frame": 1}  # the first one, before the start
    topics = {
        "frame": (Image, TOPIC),
        "front": (Image, "/kachaka/front_camera/depth"),
        "tof": (Image, "/kachaka/tof_camera/image_raw"),
        "scan": (LaserScan, "/kachaka/lidar/scan"),
        "odometry": (Odometry, "/kachaka/odometry/odometry"),
        "person": (PoseStamped, "/truth/pose/person"),
    }
    for name, (kind, topic) in topics.items():
        before = dict(calls)
        subscription = session.node.create_subscription(kind, topic, lambda _: None, qos_profile_sensor_data)
        wait_until(lambda name=name, before=before: calls.get(name, 0) > before.get(name, 0) + 3)
        session.run(lambda subscription=subscription: session.node.destroy_subscription(subscription))
        assert {k for k in calls if calls[k] != before.get(k)} == {name}
        wait_until(lambda topic=topic: not session.node.count_subscribers(topic))
        played = body.played
        wait_until(lambda played=played: body.played > played + 3)


@pytest.fixture
def send(session):
    """send(linear, angular, publisher number): one command, from one of three publishers."""
    from geometry_msgs.msg import Twist, Vector3

    from imgproc_course.ros.robot_topics import COMMANDS

    publishers = [session.node.create_publisher(Twist, COMMANDS, 10) for _ in range(3)]

    def publish(linear, angular, number=0):
        while not publishers[number].get_subscription_count():
            time.sleep(0.01)
        publishers[number].publish(Twist(linear=Vector3(x=linear), angular=Vector3(z=angular)))

    return publish


@pytest.fixture
def reports(caplog):
    """A function: the warnings about commands; a busy machine may have others, about the rate."""
    return lambda text: [r.message for r in caplog.records if r.message.startswith(text)]


def test_impossible_commands_stop_the_robot_and_are_reported_once(body, send, wait_until, reports):
    simulation = body._images.simulation
    send(0.2, 0.0)
    wait_until(lambda: simulation.speeds[0] > 0.1)
    for command in ((math.nan, 0.0), (0.1, math.inf), (-math.inf, math.nan)):
        send(*command)
    wait_until(lambda: reports("a command"))
    wait_until(lambda: body._images._command[:2] == (0.0, 0.0))
    wait_until(lambda: simulation.speeds == (0.0, 0.0))
    assert reports("a command") == ["a command of nan m/s and 0.0 rad/s: the robot stops"]
    assert body.running and body.last_error is None


def test_commands_beyond_the_limits_drive_at_the_limits(body, send, wait_until, reports):
    simulation = body._images.simulation
    send(0.3, math.pi / 2)  # the limit 1.57, for everybody but a computer
    wait_until(lambda: simulation.speeds[1] > 0)
    assert reports("a command") == []
    wait_until(lambda: simulation.speeds == (0.0, 0.0))
    reached = []
    for _ in range(20):
        send(1e300, -1e300)
        time.sleep(0.02)
        reached.append(simulation.speeds)
    wait_until(lambda: simulation.speeds == (0.0, 0.0))  # without commands it stops
    linear, angular = np.transpose(reached)
    assert 0 < linear.max() <= 0.3 and 0 > angular.min() >= -1.57
    expected = (
        "a command of 1e+300 m/s and -1e+300 rad/s: the robot drives at most 0.3 m/s and turns at most "
        "1.57 rad/s"
    )
    assert reports("a command") == [expected]
    assert body.last_error is None


def test_several_publishers_are_reported_once_and_the_newest_command_counts(
    body, send, session, wait_until, reports, monkeypatch
):
    from imgproc_course.ros import camera_publisher

    monkeypatch.setattr(camera_publisher, "CHECK_PERIOD", 0.05)
    end = body.played + 90
    while body.played < end:
        for number, speed in enumerate((-0.2, 0.1, 0.3)):
            send(speed, 0.0, number)
        time.sleep(0.001)
        assert abs(body._images.simulation.speeds[0]) <= 0.3
    name = session.node.get_name()
    assert reports("3 publishers") == [
        f"3 publishers send commands on /kachaka/manual_control/cmd_vel ({name}, {name}, {name}): the robot "
        "follows the newest command of them all"
    ]
    send(-0.1, 0.0, 1)
    wait_until(lambda: body._images._command[0] == -0.1)
    assert body.last_error is None


COMMANDS_OF_A_NOTEBOOK = """
from geometry_msgs.msg import Twist
from imgproc_course.ros import RosSession
publisher = RosSession.current().node.create_publisher(Twist, "/kachaka/manual_control/cmd_vel", 10)
import time
while True:
    publisher.publish(Twist())
    time.sleep(0.05)
"""


def test_other_notebooks_that_send_commands_are_named(body, start_python, wait_until, reports, monkeypatch):
    from imgproc_course.ros import camera_publisher

    monkeypatch.setattr(camera_publisher, "CHECK_PERIOD", 0.05)
    for notebook in ("11_drive.ipynb", "12_obstacles.ipynb"):
        start_python(COMMANDS_OF_A_NOTEBOOK, JPY_SESSION_NAME=f"/lessons/{notebook}")
    start = "the notebook 11_drive.ipynb and the notebook 12_obstacles.ipynb send commands on "
    wait_until(lambda: reports(start))
    (line,) = reports(start)
    assert line.endswith(
        "newest command of them all; shut one down, in JupyterLab: Kernel > Shut Down Kernel"
    )


def test_manual_control_can_be_switched_off_as_on_the_robot(body, send, session, wait_until):
    from std_srvs.srv import SetBool

    from imgproc_course.ros.robot_topics import ENABLED

    client = session.node.create_client(SetBool, ENABLED)
    assert client.wait_for_service(30)
    send(0.2, 0.0)
    wait_until(lambda: body._images._command[0] == 0.2)
    future = client.call_async(SetBool.Request(data=False))
    wait_until(future.done)
    assert future.result().success
    assert body._images._command[:2] == (0.0, 0.0)
    send(0.1, 0.0)
    wait_until(lambda: body._images._command[0] == 0.1)


def test_without_panda3d_the_room_says_so_before_anything_is_published(run_python):
    code, out, err = run_python(
        "import sys\nsys.modules['panda3d'] = None\n"
        "from imgproc_course.ros.camera import ROOM\n"
        "from imgproc_course.ros.robot_body import open_body\n"
        "try:\n    open_body({'source': 'room', 'topic': '/image', 'rate': 30.0} | ROOM)\n"
        "except RuntimeError as error:\n    print(error)\n"
    )
    assert (code, err) == (0, "")
    assert (
        out.startswith("the room needs panda3d, which is not installed") and "open_camera('recording')" in out
    )


CHECKLIST = re.compile(r"^# - `(\S+)` \(`([a-z_]+)/(\w+)`(?:, `(\w+)`)?\): ", re.M)


def test_the_checklist_for_a_real_robot_says_what_the_room_has(body, session, wait_until):
    """The list at the end of the last lesson: topics, types and frames; and their QoS."""
    from rclpy.qos import ReliabilityPolicy, qos_profile_sensor_data

    master = next(Path(__file__).parents[2].glob("notebooks/masters/*_the_errand.py")).read_text()
    rows = CHECKLIST.findall(master)
    assert len(rows) == 5
    assert "All of them are sent with best effort." in master
    for place, package, name, frame in rows:
        topic = f"/kachaka/{place}"
        ends = "publishers" if frame else "subscriptions"
        find = getattr(session.node, f"get_{ends}_info_by_topic")
        wait_until(lambda find=find, topic=topic: find(topic))
        (end,) = find(topic)
        assert end.topic_type == f"{package}/msg/{name}"
        assert end.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
        if frame:
            message = getattr(importlib.import_module(f"{package}.msg"), name)
            received = []
            session.node.create_subscription(message, topic, received.append, qos_profile_sensor_data)
            wait_until(lambda received=received: received)
            assert received[0].header.frame_id == frame
