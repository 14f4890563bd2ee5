"""Raw images of the drive from another process: all arrive in the program of the page."""

import re
import signal
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"
# A queue of five holds out for a second on a busy machine.
PLAY = "from imgproc_course.ros.player import play\nplay(speed=0.5)"

# This page shows the program.
PAGE = Path(__file__).parents[2] / "docs/learn/camera.md"
SUBSCRIBER = re.search(
    r"<!-- tested: subscriber -->\n```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL
)[1]


def test_the_readmes_program_receives_every_frame(start_python):
    start_python(PLAY)
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
