"""The command `drive`: it starts the robot or joins it, and says what to do next."""

import signal

import pytest

pytestmark = pytest.mark.ros

DRIVE = """import sys
from imgproc_course.ros.player import play
sys.exit(play('room', rate=5, lighting='evening'))"""


def test_it_shows_the_robot_until_a_signal(start_python, session):
    from imgproc_course.ros import Robot

    process = start_python(DRIVE)
    assert process.stdout.readline().startswith("started: the room (seed 0, evening, 640×360) at 5 Hz on ")
    assert [process.stdout.readline().strip() for _ in range(4)][-1] == "drive(Robot())"
    second = start_python(DRIVE)
    assert second.stdout.readline().startswith(f"joined the robot of python -c (pid {process.pid}): the room")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    last = f"left; the camera goes on for python -c (pid {second.pid})"
    assert (process.returncode, err, out.splitlines()[-1]) == (0, "", last)
    with Robot() as robot:
        assert robot.pose == (0, 0, 0)  # it goes on for the second
    second.send_signal(signal.SIGINT)
    out, err = second.communicate(timeout=60)
    assert (second.returncode, err) == (0, "")
    assert out.splitlines()[-1].startswith("stopped after ")
