"""Raw images of the drive from another process: all arrive, in order; also in the program of the page."""

import re
import signal
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
PLAY = "from imgproc_course.ros.player import play\nplay(speed={}, stamps='recorded')"

# This page shows the program.
PAGE = Path(__file__).parents[2] / "docs/learn/camera.md"
SUBSCRIBER = re.search(
    r"<!-- tested: subscriber -->\n```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL
)[1]


def test_every_image_of_another_process_arrives_in_order(start_python, session, wait_until):
    from rclpy.qos import QoSProfile, ReliabilityPolicy

    from imgproc_course.recording import open_recording
    from imgproc_course.ros import ImageSubscriber

    frame_numbers = []
    with open_recording("drive") as drive:
        numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}

    def on_image(frame, msg):
        frame_numbers.append(numbers[msg.header.stamp.sec * 1_000_000_000 + msg.header.stamp.nanosec])

    start_python(PLAY.format(2.0))
    # A long queue, so that a busy machine makes this test slow but not wrong.
    long_queue = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
    with ImageSubscriber(TOPIC, on_image, qos=long_queue) as subscriber:
        wait_until(lambda: len(frame_numbers) >= 30)
        assert (subscriber.dropped, subscriber.failed) == (0, 0)
    first = frame_numbers[0]
    assert frame_numbers == [(first + n) % 90 for n in range(len(frame_numbers))]


def test_the_readmes_program_receives_every_frame(start_python, tmp_path):
    start_python(PLAY.format(0.5))  # a queue of five holds out for a second on a busy machine
    program = start_python(SUBSCRIBER)
    line = r"\(720, 1280, 3\) uint8, mean \d+\.\d; (\d+) received, 0 lost, \d+\.\d Hz\n"
    received = 0
    while received < 10:
        output = program.stdout.readline()
        assert output, program.stderr.read()
        assert re.fullmatch(line, output), output
        received = int(re.fullmatch(line, output)[1])
    program.send_signal(signal.SIGINT)
    out, err = program.communicate(timeout=60)
    assert (program.returncode, err, out.splitlines()[-1]) == (0, "", "bye")


def test_the_readmes_program_says_why_no_image_arrives(run_python):
    code, out, err = run_python(SUBSCRIBER.replace("timeout=10", "timeout=0.5"))
    assert (code, err) == (0, "")
    assert out.startswith(f"no image arrived on {TOPIC} in 0.5 s: no node publishes this topic or any")
