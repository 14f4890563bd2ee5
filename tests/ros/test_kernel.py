"""A notebook's kernel: cells run again in any order, restarts, interrupts and kills, without error output."""

import os
import re
import time
from collections import defaultdict
from queue import Empty

import pytest
from jupyter_client.manager import KernelManager

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures("shared_camera")]

OPEN = "from imgproc_course.ros import *\ncamera = open_camera(speed=3.0)"
SUBSCRIBE = """
from imgproc_course.ros import *
frames = []
def on_image(frame, msg):
    frames.append(frame.shape)
subscriber = ImageSubscriber("/kachaka/front_camera/image_raw", on_image)
"""
STOP = "RosSession.current().stop()"
READ = "print(subscriber.wait(60).shape)"
# How many publishers and subscribers this kernel has discovered: it knows the camera after some time, and
# of a killed kernel for 20 seconds more.
ALIVE = """
import threading, time
frame, node, topic = subscriber.wait(60), RosSession.current().node, subscriber.topic
count, end = lambda: (node.count_publishers(topic), node.count_subscribers(topic)), time.monotonic() + 60
while count() != (1, 1) and time.monotonic() < end:
    time.sleep(0.01)
print(sum('ROS session' in t.name for t in threading.enumerate()), *count())
"""
# What Fast DDS prints when two processes take a port in shared memory at the same time: see conftest.py.
SAME_PORT = re.compile(r"^.*RTPS_TRANSPORT_SHM.*\n", re.M)


def parent(msg):
    """The id of the request that a kernel's message belongs to; None if to none."""
    return msg["parent_header"].get("msg_id")


class Notebook:
    """A kernel, and a client that runs cells in it."""

    def __init__(self, stderr):
        self.manager = KernelManager(kernel_name="python3")
        # Like a learner's kernel: under pytest, ipykernel would not show what C code prints.
        environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
        self.manager.start_kernel(stderr=stderr, env=environment)
        self.connect()

    def connect(self):
        self.client = self.manager.client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=150)

    def run(self, code, seconds=150):
        """Runs a cell; returns its (stdout, stderr), and fails on an error."""
        request = self.client.execute(code)
        printed = {"stdout": "", "stderr": ""}
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                msg = self.client.get_iopub_msg(timeout=1)
            except Empty:
                continue
            if parent(msg) != request:
                continue
            if msg["msg_type"] == "stream":
                printed[msg["content"]["name"]] += msg["content"]["text"]
            if msg["msg_type"] == "error":
                pytest.fail("\n".join(msg["content"]["traceback"]))
            if msg["msg_type"] == "status" and msg["content"]["execution_state"] == "idle":
                return SAME_PORT.sub("", printed["stdout"]), printed["stderr"]
        pytest.fail("the cell did not end")

    def interrupt(self, code):
        """Runs a cell that prints something and then waits, and interrupts it there."""
        request = self.client.execute(code, stop_on_error=False)  # the next cells are not part of this
        # A late line of an earlier cell does not count: the signal would come too early, and have no effect.
        line = ("stream", request)
        while ((msg := self.client.get_iopub_msg(timeout=60))["msg_type"], parent(msg)) != line:
            pass
        self.manager.interrupt_kernel()
        while parent(reply := self.client.get_shell_msg(timeout=60)) != request:
            pass
        assert reply["content"]["ename"] == "KeyboardInterrupt"

    def close(self):
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=False)
        self.manager.cleanup_resources()


@pytest.fixture
def notebook(tmp_path):
    """A kernel that ends with the test. Fails if the kernel wrote our errors outside its cells."""
    with (tmp_path / "stderr").open("w") as file:
        notebook = Notebook(file)
        yield notebook
        notebook.close()
    lines = (tmp_path / "stderr").read_text().splitlines()
    # Messages of ipykernel and debugpy themselves do not count.
    markers = ("terminate", "imgproc", "rcl", "RTPS", "Traceback")
    assert [line for line in lines if any(marker in line for marker in markers)] == [], "\n".join(lines)


def test_cells_in_any_order_duplicate_nothing(notebook):
    for cell in (OPEN, SUBSCRIBE, READ, OPEN, READ, SUBSCRIBE, SUBSCRIBE, READ, STOP, STOP):
        notebook.run(cell)
    for cell in (SUBSCRIBE, OPEN, READ, SUBSCRIBE, READ):
        notebook.run(cell)
    assert notebook.run(ALIVE) == ("1 1 1\n", "")


def test_the_kernel_restarts_or_is_killed_and_the_cells_run_again(notebook):
    for now in (False, True):
        notebook.run(OPEN)
        notebook.run(SUBSCRIBE)
        assert notebook.run(READ) == ("(720, 1280, 3)\n", "")
        notebook.client.stop_channels()
        notebook.manager.restart_kernel(now=now)
        notebook.connect()
    notebook.run(OPEN)
    notebook.run(SUBSCRIBE)
    assert notebook.run(ALIVE) == ("1 1 1\n", "")


def test_interrupting_a_waiting_cell_leaves_the_graph_running(notebook):
    notebook.run(OPEN)
    notebook.run(SUBSCRIBE)
    for extra in ("", "import rclpy; rclpy.init()"):
        notebook.run(extra)
        # Short sleeps: a long one would miss a signal that comes between the print and the sleep.
        notebook.interrupt("import time\nprint('waits', flush=True)\nfor _ in range(1200): time.sleep(0.05)")
        assert notebook.run(READ) == ("(720, 1280, 3)\n", "")
        assert notebook.run(ALIVE) == ("1 1 1\n", "")


def test_a_late_warning_of_the_robot_belongs_to_the_cell_that_opened_it(notebook, drive_of_another_program):
    opening = notebook.client.execute(OPEN)
    other_cell = notebook.client.execute("print('runs', flush=True)\nwhile camera.rate != 10: pass")
    while notebook.client.get_iopub_msg(timeout=150)["content"].get("text") != "runs\n":
        pass
    with drive_of_another_program(1.0, switch=True):
        while (msg := notebook.client.get_iopub_msg(timeout=150))["msg_type"] != "stream":
            pass
    with drive_of_another_program(3.0, switch=True):  # as it was, for the other tests
        assert "has switched the robot: it is now playing drive at 10 Hz" in msg["content"]["text"]
        assert msg["parent_header"]["msg_id"] == opening != other_cell


TALKER = """
from rclpy.node import Node
from std_msgs.msg import Empty
from imgproc_course.ros import *
from imgproc_course.ros.processor import NodeLog

class Talker(Node):
    def __init__(self):
        super().__init__("talker", context=RosSession.current().context)
        self.create_subscription(Empty, "/talker", self.on_message, 10)
        self.heard, self.log = 0, NodeLog(self)
        self.get_logger().info("begins")

    def on_message(self, msg):
        self.heard += 1
        self.log.warn("kind", "an empty message", f" ({self.heard} so far)")
        raise ValueError("a mistake of the learner")

talker = RosSession.current().add_node(Talker())
"""
TALK = """
publisher = RosSession.current().node.create_publisher(Empty, "/talker", 10)
heard_before = talker.heard
while talker.heard < heard_before + 3:
    publisher.publish(Empty())
RosSession.current().stop()
"""


def test_a_nodes_log_is_neutral_once_per_cause_and_below_the_cell_that_made_the_node(notebook):
    cells = {notebook.client.execute(code): name for name, code in (("made", TALKER), ("talked", TALK))}
    printed = defaultdict(str)
    ended = set()
    while ended != {*cells}:
        msg = notebook.client.get_iopub_msg(timeout=150)
        if msg["msg_type"] == "stream":
            printed[cells[parent(msg)], msg["content"]["name"]] += msg["content"]["text"]
        elif msg["content"].get("execution_state") == "idle":
            ended.add(parent(msg))
    log, error = SAME_PORT.sub("", printed.pop(("made", "stdout"))), printed.pop(("made", "stderr"))
    assert log == "[INFO] [talker]: begins\n[WARN] [talker]: an empty message (1 so far)\n"
    heading, line, *_ = error.splitlines()
    assert heading == "a ROS callback failed; the graph continues"
    assert line.startswith("in on_message, line ") and line.endswith(
        'raise ValueError("a mistake of the learner")'
    )
    assert "Traceback" not in error and error.count("\nValueError: a mistake of the learner") == 1
    assert printed == {}


SPIN = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty
from imgproc_course.ros import *
session = RosSession.current()
node = Node("spun", context=session.context)
node.create_subscription(Empty, "/spun/in", lambda msg: calls.append(1), 1)
calls = []
"""
CALLS = """
import time
publisher = session.node.create_publisher(Empty, "/spun/in", 1)
end = time.monotonic() + 60
while not calls and time.monotonic() < end:
    publisher.publish(Empty())
    time.sleep(0.01)
print(bool(calls))
"""


BROKEN_SPIN = """
import rclpy
from rclpy.node import Node
from imgproc_course.ros import *
node = Node("broken", context=RosSession.current().context)
def on_timer():
    return [][3]
node.create_timer(0.01, on_timer)
rclpy.spin(node)
"""


def test_an_error_in_a_callback_that_a_cell_spins_has_the_learners_lines_only(notebook):
    request = notebook.client.execute(BROKEN_SPIN, stop_on_error=False)
    while (msg := notebook.client.get_iopub_msg(timeout=60))["msg_type"] != "error":
        pass
    assert (parent(msg), msg["content"]["ename"]) == (request, "IndexError")
    traceback = re.sub(r"\x1b\[[\d;]*m", "", "\n".join(msg["content"]["traceback"]))
    assert "rclpy.spin(node)" in traceback and "return [][3]" in traceback
    assert traceback.count("Cell In") == 2 and "File " not in traceback  # no frame of a file
    assert notebook.run("print(RosSession.current().running)") == ("True\n", "")


PROGRAM = """
def main():
    rclpy.init()
    try:
        rclpy.spin(Node("own"))
    finally:
        rclpy.try_shutdown()

if __name__ == "__main__":
    main()
"""


def test_a_program_in_an_answer_cell_ends_with_the_reason_and_not_never(notebook):
    notebook.run(f"import rclpy\nfrom rclpy.node import Node\n{OPEN}")
    content = {"code": PROGRAM, "stop_on_error": False}
    metadata = {"imgproc_course": {"exercise": "node-class"}}  # JupyterLab sends the cell's
    for _ in range(2):
        request = notebook.client.session.msg("execute_request", content, metadata=metadata)
        notebook.client.shell_channel.send(request)
        while (msg := notebook.client.get_iopub_msg(timeout=60))["msg_type"] != "error":
            pass
        assert msg["content"]["evalue"].startswith("an answer cell does not spin, which never ends")
        assert "File " not in "".join(msg["content"]["traceback"])  # the learner's own lines only
    notebook.run("print(main)")  # it is defined


@pytest.mark.parametrize("call", ["", "session.add_node(node)", "rclpy.init()"])
def test_rclpys_spin_blocks_until_the_interrupt_and_the_session_lives_on(notebook, call):
    notebook.run(SPIN)
    notebook.run(OPEN)
    notebook.run(SUBSCRIBE)
    # A thread prints, so that the interrupt comes while the cell spins.
    cell = f"import threading\nthreading.Timer(1, lambda: print('spins', flush=True)).start()\n{call}\n"
    notebook.interrupt(cell + "rclpy.spin(node)\nprint('spin has returned')")
    assert notebook.run(READ) == ("(720, 1280, 3)\n", "")
    notebook.run("session.add_node(node)")
    assert notebook.run(CALLS) == ("True\n", "")
    assert notebook.run(ALIVE) == ("1 1 1\n", "")
