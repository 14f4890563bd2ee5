"""Fixtures for the tests of imgproc_course.ros: the processes of robots and of other programs."""

import contextlib
import importlib.util
import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

# Fast DDS prints to stdout when two processes take a port in shared memory at the same time; it then takes
# another one, and nothing is lost (eProsima/Fast-DDS issue 6117, open). This can go when it is closed.
ONLY_PYTHON_PRINTS = """
import os, sys
sys.stdout = os.fdopen(os.dup(1), "w", buffering=1, closefd=False)
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
"""


@pytest.fixture(scope="module", autouse=True)
def no_robot_of_another_module():
    """Each module begins without a robot in its domain, which belongs to this run of the tests alone."""
    if importlib.util.find_spec("rclpy") is None:
        return
    from imgproc_course.ros.robot_process import running_robot

    domain, end = int(os.environ["ROS_DOMAIN_ID"]), time.monotonic() + 15
    while running_robot(domain) and time.monotonic() < end:
        time.sleep(0.1)  # its last user has just left
    for process in _robot_processes():
        process.kill()
        process.wait(60)


def _robot_processes(domain=None):
    processes = []
    for process in psutil.process_iter(["cmdline"]):
        arguments = process.info["cmdline"] or []
        is_robot = "robot_body" in "".join(arguments[3:4])
        if is_robot and arguments[4:5] == [domain or os.environ["ROS_DOMAIN_ID"]]:
            processes.append(process)
    return processes


@pytest.fixture
def robot_processes():
    """robot_processes(domain): a list of psutil.Process; the domain is this test's own, if omitted."""
    return _robot_processes


@pytest.fixture
def collect():
    """collect(topic, type) -> the list that its messages go to, until the end of the test."""
    from rclpy.qos import qos_profile_sensor_data

    from imgproc_course.ros import RosSession

    session, subscriptions = RosSession(), []

    def subscribe(topic, message_type):
        messages = []
        subscriptions.append(
            session.node.create_subscription(message_type, topic, messages.append, qos_profile_sensor_data)
        )
        return messages

    yield subscribe
    if session.running:
        session.run(lambda: [session.node.destroy_subscription(s) for s in subscriptions])


@pytest.fixture(scope="module")
def drive_of_another_program():
    """drive_of_another_program(speed): plays the drive, as another program does, within its `with`."""
    from imgproc_course.ros.camera import ROBOT_MODULE, TOPIC
    from imgproc_course.ros.robot_process import RobotConnection

    @contextlib.contextmanager
    def play(speed, *, switch=False):
        request = {"source": "recording", "topic": TOPIC, "recording": "drive", "camera_topic": None}
        request |= {"speed": speed, "loop": True, "stamps": "now"}
        domain = int(os.environ["ROS_DOMAIN_ID"])
        connection = RobotConnection(domain, ROBOT_MODULE, request, switch=switch, on_event=print)
        try:
            yield
        finally:
            connection.leave()

    return play


@pytest.fixture(scope="module")
def shared_camera(drive_of_another_program):
    """The drive at 30 Hz during all tests of a module: their programs join this camera, which is quick."""
    with drive_of_another_program(3.0):
        yield


@pytest.fixture
def another_process():
    """A node of another context: for DDS and for the session this is another process."""
    from rclpy.context import Context
    from rclpy.node import Node

    context = Context()
    context.init()
    node = Node("another", context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


@pytest.fixture
def run_python():
    """Runs code in a child process and returns (exit code, stdout, stderr)."""

    def run(code, *, seconds=60, cwd=None, **environment):
        process = subprocess.run(
            [sys.executable, "-c", ONLY_PYTHON_PRINTS + code],
            capture_output=True,
            text=True,
            timeout=seconds,
            cwd=cwd,
            env=_environment(environment),
        )
        return process.returncode, process.stdout, process.stderr

    return run


@pytest.fixture
def start_python():
    """Starts code in a child process, which is killed at the end of the test."""
    running = []

    def start(code, *, cwd=None, **environment):
        process = subprocess.Popen(
            [sys.executable, "-u", "-c", ONLY_PYTHON_PRINTS + code],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=cwd,
            env=_environment(environment),
        )
        running.append(process)
        return process

    yield start
    for process in running:
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
        process.communicate()


def _environment(changes):
    """This process's environment with changes; None removes a variable."""
    merged = {**os.environ, **changes}
    return {name: value for name, value in merged.items() if value is not None}
