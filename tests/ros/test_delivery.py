"""Raw pictures of the drive from a process of its own: all arrive, in order, and in the README's program."""

import re
import signal
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
PLAY = "from imgproc_course.ros.player import play\nplay(speed={}, stamps='recorded')"

# The README shows this program.
README = Path(__file__).parents[2] / "README.md"
README_SUBSCRIBER = re.search(
    r"<!-- tested: subscriber -->\n```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL
)[1]


def test_every_picture_of_another_process_arrives_in_order(start_python, session, wait_until):
    from rclpy.qos import QoSProfile, ReliabilityPolicy

    from imgproc_course.recording import open_recording
    from imgproc_course.ros import ImageSubscriber

    seen = []
    with open_recording("drive") as drive:
        numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}

    def on_image(frame, msg):
        seen.append(numbers[msg.header.stamp.sec * 1_000_000_000 + msg.header.stamp.nanosec])

    start_python(PLAY.format(2.0))
    # A long queue, so that a busy machine makes this slow and not wrong.
    patient = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
    with ImageSubscriber(TOPIC, on_image, qos=patient) as subscriber:
        wait_until(lambda: len(seen) >= 60, seconds=60)
        assert (subscriber.dropped, subscriber.failed) == (0, 0)
    first = seen[0]
    assert seen == [(first + n) % 90 for n in range(len(seen))]


def test_the_readmes_program_receives_every_frame(start_python, tmp_path):
    start_python(PLAY.format(0.5))  # its queue of five bears a second of a busy machine
    program = start_python(README_SUBSCRIBER)
    line = r"\(720, 1280, 3\) uint8, mean \d+\.\d; (\d+) received, 0 lost, \d+\.\d Hz\n"
    received = 0
    while received < 20:
        read = program.stdout.readline()
        assert read, program.stderr.read()
        assert re.fullmatch(line, read), read
        received = int(re.fullmatch(line, read)[1])
    program.send_signal(signal.SIGINT)
    out, err = program.communicate(timeout=20)
    assert (program.returncode, err, out.splitlines()[-1]) == (0, "", "bye")


def test_the_readmes_program_says_why_nothing_comes(run_python):
    code, out, err = run_python(README_SUBSCRIBER.replace("timeout=10", "timeout=0.5"))
    assert (code, err) == (0, "")
    assert out.startswith(f"no frame on {TOPIC} in 0.5 s: nobody publishes it, nor")
