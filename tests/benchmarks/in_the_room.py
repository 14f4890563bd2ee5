"""A node in another process, for a minute in the room: what the benchmarks of these nodes share.

SECONDS_IN_THE_ROOM=20 in the environment makes the minute shorter; 0 leaves it out.
"""

import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import cv2
from rich.console import Console
from rich.table import Table
from tqdm import tqdm

os.environ.setdefault("ROS_DOMAIN_ID", "97")
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
sys.path.append(str(Path(__file__).parents[1] / "ros"))
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data

from imgproc_course.geometry import Pose
from imgproc_course.ros import Robot, RosSession, open_camera

cv2.setNumThreads(1)
PROGRAMS = Path(__file__).parents[1] / "ros"
SECONDS = float(os.environ.get("SECONDS_IN_THE_ROOM", "60"))
ODOMETRY, TRUTH = "/kachaka/odometry/odometry", "/truth/pose/robot"


class Topics:
    """The messages that arrive on some topics, from now on.

    Parameters
    ----------
    kinds : dict of topic -> class of its messages
    """

    def __init__(self, kinds):
        self.messages = {topic: [] for topic in kinds}
        self.times = {topic: [] for topic in kinds}  # of arrival, as time.time()
        self.node = RosSession.current().node
        for topic, kind in kinds.items():
            self.node.create_subscription(kind, topic, partial(self._receive, topic), qos_profile_sensor_data)

    def _receive(self, topic, msg):
        self.times[topic].append(time.time())
        self.messages[topic].append(msg)

    def count(self, topic):
        return len(self.messages[topic])

    def poses(self, topic):
        """A dict of stamp in nanoseconds -> Pose."""
        return {nanoseconds(msg): pose_of(msg) for msg in list(self.messages[topic])}


def nanoseconds(msg):
    return msg.header.stamp.sec * 10**9 + msg.header.stamp.nanosec


def pose_of(msg):
    """The Pose of a PoseStamped, or of an Odometry."""
    pose = msg.pose.pose if hasattr(msg.pose, "pose") else msg.pose
    p, q = pose.position, pose.orientation
    return Pose.from_vector([p.x, p.y, p.z, q.x, q.y, q.z, q.w])


def nearest(values, time_wanted):
    """Of a dict of stamp -> value, the value whose stamp is nearest."""
    return values[min(values, key=lambda stamp: abs(stamp - time_wanted))]


@contextmanager
def room(start, seed=1, **options):
    """Opens the room, and puts the robot at its start; yields robot, and bumps(), those since then."""
    with open_camera("room", start=start, seed=seed, **options) as camera, Robot() as robot:
        robot.restart(start=start, seed=seed)
        before = camera.bumps
        yield SimpleNamespace(robot=robot, bumps=lambda: camera.bumps - before)


@contextmanager
def program(name, *arguments):
    """Runs a program of tests/ros, and ends it with Ctrl-C; afterwards `printed` is what it has printed."""
    command = [sys.executable, PROGRAMS / name, *map(str, arguments)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        running = SimpleNamespace(process=process, printed="")
        try:
            yield running
        finally:
            process.send_signal(signal.SIGINT)
        running.printed = process.communicate(timeout=60)[0]


def wait_for(condition, running):
    """Waits until condition() is true, or the program has ended."""
    while not condition() and running.process.poll() is None:
        time.sleep(0.1)


def drive_circles(robot, angular=0.25):
    """Drives for SECONDS at 0.25 m/s, and at rad/s: a circle to the left."""
    for _ in tqdm(range(round(SECONDS)), "seconds in the room"):
        robot.drive(0.25, angular, seconds=1.0)


def circles_in_the_room(name, start, kinds, begins, angular=0.25, seed=1, rate=10):
    """Drives circles with a lesson's node in another process.

    Parameters
    ----------
    name : of the lesson
    kinds : dict of topic -> class of its messages, besides odometry and truth
    begins : function of the Topics, true from when the node runs; the robot stands until then
    angular : speed in rad/s

    Returns
    -------
    Topics, what the node printed, number of bumps
    """
    with room(start, seed, rate=rate) as live:
        topics = Topics(kinds | {ODOMETRY: Odometry, TRUTH: PoseStamped})
        with program("lesson_nodes.py", name) as node:
            wait_for(lambda: begins(topics), node)
            drive_circles(live.robot, angular)
            time.sleep(2.0)  # for the last result
        return topics, node.printed, live.bumps()


def print_rows(rows, *columns):
    table = Table(*columns)
    for row in rows:
        table.add_row(*map(str, row))
    Console(width=120).print(table)


def verdict(failed):
    """Prints it; the exit code."""
    print("FAILED" if failed else "as required")
    return int(failed)
