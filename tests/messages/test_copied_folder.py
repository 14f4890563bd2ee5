"""The folder, copied into another package: it works with NumPy and OpenCV alone, under any name."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import imgproc_course

MESSAGES = Path(imgproc_course.__file__).parent / "messages"
# As on a robot: neither the course nor its dependencies are installed.
ALONE = """
import sys
sys.path.insert(0, sys.argv[1])
for name in ("imgproc_course", "rosbags", "scipy", *sys.argv[2:]):
    sys.modules[name] = None
from types import SimpleNamespace
import numpy as np
"""
READS = """
from my_robot.images import image_to_array
from my_robot.images.cv_bridge import CvBridge, CvBridgeError
from my_robot.images.encodings import encoding_info
padded = bytes([1, 2, 3, 4, 5, 6, 0])
msg = SimpleNamespace(height=1, width=2, encoding="rgb8", step=7, is_bigendian=0, data=padded)
print(image_to_array(msg, "bgr8").tolist(), CvBridge().imgmsg_to_cv2(msg).tolist())
try:
    CvBridge().imgmsg_to_cv2(msg, "mono12")
except CvBridgeError as error:
    print(error)
"""
NOTICE = """\
# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file {}.
"""
MAKES = """
from my_robot.images import array_to_compressed, array_to_image
for make in (array_to_image, array_to_compressed):
    try:
        make(np.zeros((2, 2, 3), np.uint8), "bgr8")
    except ImportError as error:
        print(error)
"""


@pytest.fixture
def run_alone(tmp_path):
    copy = tmp_path / "my_robot" / "images"
    shutil.copytree(MESSAGES, copy, ignore=shutil.ignore_patterns("__pycache__"))

    def run(program, *missing):
        command = [sys.executable, "-c", ALONE + program, str(tmp_path), *missing]
        process = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert process.stderr == ""
        return process.stdout.splitlines()

    return run


def test_the_copy_reads_messages_under_another_name(run_alone):
    frames, refusal = run_alone(READS, "sensor_msgs")
    assert frames == "[[[3, 2, 1], [6, 5, 4]]] [[[1, 2, 3], [4, 5, 6]]]"
    assert refusal.startswith("desired_encoding: unknown encoding 'mono12'; did you mean 'mono16'")


def test_without_message_classes_the_error_says_what_to_install(run_alone):
    expected = (
        "a new message needs the message classes of ROS 2, and sensor_msgs is not installed here; "
        "source ROS (source /opt/ros/jazzy/setup.bash), or pip install rosbags"
    )
    assert run_alone(MAKES, "sensor_msgs") == [expected, expected]


def test_each_file_has_its_licence_and_says_how_it_can_be_copied():
    texts = {path.name: path.read_text(encoding="utf-8") for path in MESSAGES.glob("*.py")}
    assert len(texts) > 10
    for name, text in texts.items():
        how = "with its folder, under any name" if "\nfrom ." in text else "alone"
        assert text.startswith(NOTICE.format(how)), name
