"""The two nodes as plain scripts, without a package: run as processes on real messages."""

import os
import signal
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.ros

SCRIPTS = sorted((Path(__file__).parents[2] / "environment" / "ros2_ws" / "scripts").glob("image_*.py"))
NAMES = [path.stem for path in SCRIPTS]
# Runs a script that receives a signal while it makes its n-th message: the first is the camera's, which ROS
# hands over; the second is the view, which the script is about to publish.
SIGNALLED = """
import os, pathlib, runpy, sys, time
from sensor_msgs.msg import Image
script, number, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
make, count = Image.__init__, 0
def make_and_signal(self, **fields):
    global count
    count += 1
    if count == last:
        os.kill(os.getpid(), number)
        time.sleep(0.2)  # if ROS has signal handlers of its own, they end it meanwhile
    make(self, **fields)
Image.__init__ = make_and_signal
sys.path.insert(0, str(pathlib.Path(script).parent))
runpy.run_path(script, run_name="__main__")
"""


def expected_view(name, frame):
    """What a script publishes on ~/view for a frame: (H, W) or three images side by side (H, 3 W, 3)."""
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    if name == "image_gray_processor":
        return gray
    edges = cv2.Canny(gray, 50, 150)
    return np.hstack([frame, *(cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) for image in (gray, edges))])


@pytest.fixture
def start_script(start):
    def start_one(path):
        process = start(sys.executable, path, DISPLAY=None, WAYLAND_DISPLAY=None)
        process.wait_for("has started")
        return process

    return start_one


def test_both_nodes_of_the_original_lesson_are_there():
    assert NAMES == ["image_edge_detection", "image_gray_processor"]
    for path in SCRIPTS:
        assert path.read_text(encoding="utf-8").startswith("#!/usr/bin/env python3\n")
        assert os.access(path, os.X_OK)


@pytest.mark.parametrize("path", SCRIPTS, ids=NAMES)
def test_the_view_has_the_right_pixels_and_the_header(path, start_script, collect, camera, tools):
    process = start_script(path)
    before = camera.stamp
    result = camera.get_result(collect(f"/{path.stem}/view"), tools.message_of(tools.make_frame(3)))
    expected = expected_view(path.stem, tools.make_frame(3))
    assert (tools.pixels(result) == expected).all() and expected.std() > 0
    assert result.header.frame_id == "camera_front"
    assert before < tools.nanoseconds(result) <= camera.stamp
    assert process.leave() == 0
    assert "Traceback" not in process.output


@pytest.mark.parametrize("path", SCRIPTS, ids=NAMES)
def test_a_broken_image_is_logged_and_the_node_goes_on(path, start_script, collect, camera, tools):
    process = start_script(path)
    view = collect(f"/{path.stem}/view")
    camera.get_result(view, tools.message_of(tools.make_frame(1)))
    broken = tools.message_of(tools.make_frame(2))
    broken.data = broken.data[:-7]
    camera.send(broken)
    process.wait_for(r"\[ERROR\].*An image was not processed: ")
    frame = tools.make_frame(4)
    result = camera.get_result(view, tools.message_of(frame))
    assert (tools.pixels(result) == expected_view(path.stem, frame)).all()
    assert process.output.count("publishes ~/view instead") == 1
    assert process.leave(signal.SIGTERM) == 0


@pytest.mark.parametrize(("number", "last"), [(signal.SIGINT, 1), (signal.SIGTERM, 2)])
@pytest.mark.parametrize("path", SCRIPTS, ids=NAMES)
def test_a_signal_in_the_middle_of_an_image_ends_the_script_quietly(path, number, last, start, camera, tools):
    command = (sys.executable, "-c", SIGNALLED, path, int(number), last)
    process = start(*command, DISPLAY=None, WAYLAND_DISPLAY=None)
    process.wait_for("has started")
    camera.send_until(lambda: not process.running, tools.message_of(tools.make_frame(5)))
    assert process.wait() == 0
    assert process.output.count("\n") == 2, process.output  # that it has no window, and that it has started


def test_a_missing_screen_does_not_end_the_process(monkeypatch):
    monkeypatch.syspath_prepend(SCRIPTS[0].parent)
    import windows

    monkeypatch.setenv("DISPLAY", ":77")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert windows.window_problem().startswith(
        "windows need an OpenCV that has them, and this one is headless"
    )
    # OpenCV's window library does this without a screen: it ends the process.
    monkeypatch.setattr(windows, "PROBE", "import os; os.abort()")
    assert windows.window_problem() == (
        "windows need a screen, and no screen answers (DISPLAY is :77); start the node on a desktop"
    )
    monkeypatch.setattr(windows, "PROBE", "pass")
    assert windows.window_problem() is None
    monkeypatch.setattr(windows, "SCREEN_TIMEOUT", 0.2)
    monkeypatch.setattr(windows, "PROBE", "import time; time.sleep(60)")
    assert windows.window_problem() == "windows need a screen, and no screen answered within 0.2 s"
