"""The `main` that a lesson and the cheat sheet show, in a script with the class beside it."""

import html
import re
import signal
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros
MASTERS = Path(__file__).parents[2] / "notebooks" / "masters"
LESSON = next(MASTERS.glob("*_grayscale_node.py")).read_text(encoding="utf-8")
(MAIN,) = (block.replace("# ", "") for block in re.findall(r"# ```python\n(.*?)# ```", LESSON, re.S))
PAGE = html.unescape((MASTERS / "cheat_sheet.html").read_text(encoding="utf-8"))
SOURCES = {
    "lesson": re.search(r"\n(class GrayNode.*?)\n\n# %%", LESSON, re.S)[1] + f"\n{MAIN}",
    "cheat sheet": MAIN.partition("def")[0] + re.search(r">(class EdgeDetector.*?)</pre>", PAGE, re.S)[1],
}
NAMES = """
import rclpy.node
from rclpy.qos import qos_profile_sensor_data as camera_qos
from sensor_msgs.msg import Image
TOPIC = "/camera"
class Node(rclpy.node.Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, lambda: print("spins"))
    def destroy_node(self):
        super().destroy_node()
        print("destroyed")
"""


@pytest.mark.parametrize("source", SOURCES.values(), ids=SOURCES)
def test_ctrl_c_ends_the_script_without_a_traceback(start_python, source):
    process = start_python(f"{NAMES}{source}\nmain()\n")
    while process.stdout.readline() != "spins\n":
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 0 and "Traceback" not in err
    assert out.splitlines()[-1] == "destroyed"
