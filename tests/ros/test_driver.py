"""The command `drive` in a terminal: keys move the robot, without a terminal it only shows it."""

import os
import pty
import re
import signal
import subprocess
import sys

import pytest

pytestmark = pytest.mark.ros

DRIVE = "import sys\nfrom imgproc_course.ros.driver import drive\nsys.exit(drive(rate=5.0, {}))"
PLACE = re.compile(r"x (-?[\d.]+) m, y (-?[\d.]+) m, heading (-?\d+)°, (\d+) bumps")


def test_keys_drive_the_robot_and_x_ends(wait_until):
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-u", "-c", DRIVE.format("status_seconds=0.1")],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
    )
    os.close(theirs)
    text = ""

    def read(pattern):
        """Reads until the newest text has the pattern; returns the match."""
        nonlocal text
        while not (match := re.search(pattern, text)):
            text += os.read(ours, 4096).decode()
        text = text[match.end() :]
        return match

    try:
        read(
            r"started: the room \(seed 0, day, 640×360\) at 5 Hz on /kachaka/front_camera/image_raw in domain"
        )
        read("no key, no motion")
        while float(read(PLACE)[1]) < 0.03:
            os.write(ours, b"w")
        while abs(heading := int(read(PLACE)[3])) < 5:
            os.write(ours, b"\x1b[D")  # the left arrow
        assert heading > 0
        os.write(ours, b"x")
        read("stopped")
        assert process.wait(60) == 0
    finally:
        process.kill()
        os.close(ours)


def test_without_a_terminal_it_shows_the_robot_until_a_signal(start_python, session):
    from imgproc_course.ros import Robot

    process = start_python(DRIVE.format("status_seconds=0.1, lighting='evening'"))
    assert process.stdout.readline().startswith("started: the room (seed 0, evening, 640×360) at 5 Hz on ")
    assert PLACE.match(process.stdout.readline()).groups() == ("0.00", "0.00", "0", "0")
    second = start_python(DRIVE.format("status_seconds=0.1, lighting='evening'"))
    assert second.stdout.readline().startswith(f"joined the robot of python -c (pid {process.pid}): the room")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err, out.splitlines()[-1]) == (0, "", "stopped")
    with Robot() as robot:
        assert robot.pose == (0, 0, 0)  # it goes on for the second
    second.send_signal(signal.SIGINT)
    out, err = second.communicate(timeout=60)
    assert (second.returncode, err, out.splitlines()[-1]) == (0, "", "stopped")
