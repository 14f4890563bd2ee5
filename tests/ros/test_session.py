"""The session of a process: started and stopped in any order, ended in any way, and nothing remains."""

import signal
import threading

import numpy as np
import psutil
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2")

from rclpy.context import Context
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.waitable import NumberOfEntities, Waitable
from sensor_msgs.msg import Image

from imgproc_course.ros import ImageProcessor, ImageSubscriber, NumericParameter, RosSession, open_camera

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures("shared_camera")]

RECEIVES = """
from imgproc_course.ros import ImageSubscriber, RosSession, open_camera
camera = open_camera(speed=3.0)
frames = []
subscriber = ImageSubscriber(camera.topic, lambda frame, msg: frames.append(frame.shape))
subscriber.wait(60)
print("a frame arrived", flush=True)
"""


def ros_threads():
    return [thread.name for thread in threading.enumerate() if "ROS session" in thread.name]


def test_starting_and_stopping_twice_is_doing_it_once(session):
    node = session.node
    assert RosSession.current() is session and RosSession() is session and session.start() is session
    assert session.node is node
    assert ros_threads() == ["imgproc_course ROS session"]
    session.stop()
    session.stop()
    assert (session.running, session.node, session.context, ros_threads()) == (False, None, None, [])


def test_stopping_before_starting_does_nothing(run_python):
    code, out, err = run_python(
        "from imgproc_course.ros import RosSession; RosSession().stop(); print(RosSession())"
    )
    assert (code, out, err) == (0, "<RosSession: stopped>\n", "")


def test_ten_starts_and_stops_leave_no_thread_and_no_node(session, wait_until):
    session.stop()
    before = psutil.Process().num_threads()
    for _ in range(10):
        session.start()
        assert session.node.get_name() in session.node.get_node_names()
        session.stop()
    assert ros_threads() == []
    wait_until(lambda: psutil.Process().num_threads() <= before)
    context = Context()
    context.init()
    observer = Node("observer", context=context)
    assert observer.get_node_names() == ["observer"]
    observer.destroy_node()
    context.try_shutdown()


def test_many_threads_start_one_session(session):
    session.stop()
    nodes = []
    threads = [threading.Thread(target=lambda: nodes.append(session.start().node)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(nodes) == 8 and len(set(nodes)) == 1
    assert ros_threads() == ["imgproc_course ROS session"]


def test_run_calls_in_the_spinning_thread_and_returns_the_result(session):
    assert session.run(lambda: threading.current_thread().name) == "imgproc_course ROS session"
    with pytest.raises(ZeroDivisionError):
        session.run(lambda: 1 / 0)
    assert session.run(lambda: session.run(lambda: 42)) == 42
    session.stop()
    with pytest.raises(RuntimeError, match=r"RosSession\.current\(\) starts it"):
        session.run(lambda: None)


def test_stop_from_within_a_callback(session, wait_until):
    timer = session.node.create_timer(0.01, session.stop)
    wait_until(lambda: ros_threads() == [])
    assert timer is not None and not session.running
    assert session.start().running


def test_starting_from_a_callback_of_a_stopping_session_is_refused(session, wait_until):
    errors = []

    def callback():
        session.stop()
        try:
            session.start()
        except RuntimeError as error:
            errors.append(str(error))

    session.node.create_timer(0.01, callback)
    wait_until(lambda: ros_threads() == [])
    assert errors == ["the ROS session is stopping; start it from outside its callbacks"]


def test_a_name_of_a_cell_that_was_left_out_is_named_in_one_sentence(session, wait_until, caplog):
    session.node.create_timer(0.01, lambda: missing_module.sqrt(2))  # noqa: F821
    wait_until(lambda: caplog.records)
    assert caplog.records[0].exc_info is None
    message = caplog.records[0].message
    assert message.endswith("Run the cell that imports or defines missing_module.")
    assert "name 'missing_module' is not defined" in message


def test_a_callback_that_raises_is_logged_and_the_graph_continues(session, wait_until, caplog):
    calls = []

    def callback():
        calls.append(1)
        raise ValueError("the learner's mistake")

    session.node.create_timer(0.01, callback)
    wait_until(lambda: len(calls) >= 12)
    assert session.running
    first, again = [record.message.splitlines() for record in caplog.records]
    assert first[0] == "a ROS callback failed; the graph continues"
    assert first[1].startswith("in callback, line ") and first[1].endswith(
        ':  raise ValueError("the learner\'s mistake")'
    )
    assert first[2:] == ["ValueError: the learner's mistake"]
    assert again == ["again, 10 times: ValueError: the learner's mistake"]


def test_a_node_of_the_learners_is_spun_and_destroyed_with_the_session(session, wait_until):
    calls = []
    node = Node("learners_own", context=session.context)
    node.create_timer(0.01, lambda: calls.append(1))
    assert session.add_node(node) is node
    wait_until(lambda: calls)
    session.remove_node(node)
    session.remove_node(node)
    assert "learners_own" not in session.node.get_node_names()
    session.add_node(Node("another", context=session.context))
    session.stop()
    assert ros_threads() == []


def test_a_class_is_created_in_the_sessions_context(session, wait_until):
    calls = []

    class Counter(Node):
        def __init__(self):
            super().__init__("counter")
            self.create_timer(0.01, lambda: calls.append(self))

    first, second = session.add_node(Counter), session.add_node(Counter)
    assert second.context is session.context and session.node.get_node_names().count("counter") == 1
    wait_until(lambda: second in calls)
    calls.clear()
    wait_until(lambda: len(calls) >= 5)
    assert first not in calls


def test_adding_a_node_of_the_same_name_replaces_it(session, wait_until, capfd, caplog):
    def add(value, namespace=""):
        return session.add_node(
            ImageProcessor(
                "mine",
                lambda frame, low: {"gray": np.full((2, 2), value, np.uint8)} if value else None,
                ["gray"],
                parameters=[NumericParameter("low", 1, 0, 9, "a number")],
                namespace=namespace,
                context=session.context,
            )
        )

    open_camera(speed=3.0)
    images = ImageSubscriber("/mine/gray", encoding="mono8")
    elsewhere = add(9, "/elsewhere")
    nodes = [add(value) for value in (1, 2, 3)]
    assert session.add_node(nodes[2]) is nodes[2]
    wait_until(lambda: session.node.count_publishers("/mine/gray") == 1)
    # Images of the nodes before may still lie in the queue; a node that still ran would mix its own in.
    levels = []
    wait_until(lambda: levels.append(int(images.wait(60)[0, 0])) or levels[-8:] == [3] * 8)
    assert session.node.get_node_names_and_namespaces().count(("mine", "/")) == 1
    services = session.node.get_service_names_and_types_by_node("mine", "/")
    assert sum(name == "/mine/set_parameters" for name, _ in services) == 1
    broken = add(None)
    with pytest.raises(TimeoutError, match=r"1 s: /mine publishes it, but process must return a dict"):
        for _ in range(20):  # the last images of the node before
            images.wait(1)
    assert broken.statistics()["failed"] and elsewhere.get_parameter("low").value == 1
    assert "rosout" not in capfd.readouterr().err and caplog.records == []


def test_destroying_a_subscription_while_spinning_is_safe(session, wait_until, caplog):
    ticks = []
    session.node.create_timer(0.001, lambda: ticks.append(1))
    for _ in range(50):
        subscription = session.node.create_subscription(Image, "/images", lambda msg: None, 5)
        session.node.destroy_subscription(subscription)  # in this thread, as learners do
    count = len(ticks)
    wait_until(lambda: len(ticks) > count + 10)
    assert session.running and caplog.records == []


def test_your_own_rclpy_context_works_beside_it(run_python):
    code, out, err = run_python(
        RECEIVES + "import rclpy\n"
        "rclpy.init(); node = rclpy.create_node('mine')\n"
        "rclpy.spin_once(node, timeout_sec=0.1)\n"
        "subscriber.wait(60)\n"
        "node.destroy_node(); rclpy.shutdown()\n"
        "subscriber.wait(60); print('both work')\n"
    )
    assert (code, out, err) == (0, "a frame arrived\nboth work\n", "")


@pytest.mark.parametrize("end", ["", "RosSession.current().stop(); raise SystemExit(3)"])
def test_the_interpreter_ends_without_error_output(run_python, end):
    code, out, err = run_python(RECEIVES + end)
    assert (code, out, err) == (3 if "3" in end else 0, "a frame arrived\n", "")


@pytest.mark.parametrize("extra", ["", "import rclpy; rclpy.init()\n"], ids=["plain", "with rclpy.init"])
def test_ctrl_c_in_a_waiting_script_ends_it_with_the_usual_traceback(start_python, extra):
    # Short sleeps: a long one would miss a signal that comes between the print and the sleep.
    waits = "import time\nprint('waiting', flush=True)\nfor _ in range(1200): time.sleep(0.05)"
    process = start_python(RECEIVES + extra + waits)
    while process.stdout.readline() != "waiting\n":
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == -signal.SIGINT
    assert err.splitlines()[-1] == "KeyboardInterrupt"
    assert err.count("Traceback") == 1 and "terminate called" not in err


def shut_down_before_its_next_wait(node):
    """Shuts the context down between two rounds of an executor, as a signal handler may do."""

    class ShutsDown(Waitable):
        def get_num_entities(self):
            node.context.try_shutdown()
            return NumberOfEntities()

    node.add_waitable(ShutsDown(node.default_callback_group))


def test_a_shutdown_between_two_rounds_ends_the_session_quietly(session, wait_until, caplog):
    session.run(lambda: shut_down_before_its_next_wait(session.node))
    wait_until(lambda: ros_threads() == [])
    assert caplog.records == [] and not session.running
    assert session.start().run(lambda: 42) == 42


def test_a_shutdown_between_two_rounds_ends_a_node_as_any_other():
    context = Context()
    context.init()
    node = ImageProcessor("ends", lambda frame: {}, [], context=context)
    shut_down_before_its_next_wait(node)
    with pytest.raises(ExternalShutdownException):
        node.spin()
    node.destroy_node()


def test_after_rclpys_own_signal_handlers_it_can_be_started_again(run_python):
    code, out, err = run_python(
        RECEIVES + "import os, rclpy, signal, time\n"
        "rclpy.init()\n"
        "session = RosSession.current()\n"
        "try:\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    for _ in range(1200): time.sleep(0.05)\n"
        "except KeyboardInterrupt:\n"
        "    while session.running: time.sleep(0.01)\n"
        "RosSession.current()\n"
        "print(camera.running, subscriber.stopped)\n"
        "with open_camera(speed=3.0) as camera, ImageSubscriber(camera.topic) as subscriber:\n"
        "    print(subscriber.wait(60).shape)"
    )
    assert (code, err) == (0, "")
    assert out == "a frame arrived\nFalse True\n(720, 1280, 3)\n"


@pytest.mark.parametrize("callback", ["time.sleep(3600)", "[other.spin_once(0.01) for _ in range(360_000)]"])
def test_a_callback_that_never_returns_cannot_keep_the_interpreter_alive(run_python, callback):
    code, out, err = run_python(
        "import time\nfrom imgproc_course.ros import session as module\n"
        "module.CALLBACK_TIMEOUT = 0.5\n"
        "session = module.RosSession.current()\n"
        "other = module._Executor(context=session.context)\n"
        f"session.post(lambda: {callback})\n"
        "print('leaving', flush=True)"
    )
    assert (code, out) == (0, "leaving\n")
    assert err == "a callback has not returned for 0.5 s; the ROS session stops without it\n"


FORK = """
import os, sys, warnings
from imgproc_course.ros import RosSession
warnings.simplefilter("ignore")
session = RosSession.current()
sys.stdout.flush()
pid = os.fork()
if pid == 0:
    print("child running:", session.running)
    try:
        RosSession.current()
    except RuntimeError as error:
        print(error)
    session.stop()
    sys.exit(7)
print("child left with", os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
print("parent running:", session.running, session.run(lambda: 42))
"""


def test_a_forked_child_inherits_no_session_and_the_parent_keeps_its_own(run_python):
    code, out, err = run_python(FORK)
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "child running: False",
        "this process was forked from one with a running ROS session, and DDS does not work after a fork; "
        "start the process with multiprocessing.get_context('spawn') or subprocess instead",
        "child left with 7",
        "parent running: True 42",
    ]


def test_a_child_forked_before_any_session_can_start_one(run_python):
    code, out, err = run_python(
        "import os, warnings, imgproc_course.ros as ros\n"
        "warnings.simplefilter('ignore')  # Python 3.12 warns about NumPy's threads\n"
        "if os.fork() == 0: print(ros.RosSession.current().run(lambda: 42))\n"
        "else: os.wait()"
    )
    assert (code, out, err) == (0, "42\n", "")


@pytest.mark.parametrize(
    ("name", "value", "problem"),
    [
        ("ROS_STATIC_PEERS", "127.0.0.1,10.0.0.5", "has a name that is not found; "),
        ("ROS_DOMAIN_ID", "300", "is not a ROS domain; choose 0 to 101, the same on all machines"),
        ("ROS_DOMAIN_ID", "٣", "is not a ROS domain; choose 0 to 101, the same on all machines"),
    ],
)
def test_what_ros_cannot_use_is_named(monkeypatch, name, value, problem):
    monkeypatch.setenv(name, value)
    with pytest.raises(ValueError) as error:
        RosSession.current()
    assert str(error.value).startswith(f"{name}={value} {problem}")


def test_a_log_folder_that_cannot_be_written_does_no_harm(run_python):
    code, out, err = run_python(
        "from imgproc_course.ros import RosSession; print(RosSession.current().run(lambda: 42))",
        ROS_LOG_DIR="/proc/no/such/folder",
    )
    assert (code, out, err) == (0, "42\n", "")


def test_a_node_whose_callback_computes_for_long_is_removed_after_it(session):
    began, ends = threading.Event(), threading.Event()

    class Reader(Node):
        def __init__(self):
            super().__init__("slow_reader")
            self.timer = self.create_timer(0.05, self.read)

        def read(self):
            began.set()
            ends.wait(60)

    node = session.add_node(Reader)
    assert began.wait(60)
    with pytest.raises(TimeoutError, match=r"a callback has not returned for 0\.1 s; wait until it does"):
        session.run(list, 0.1)
    threading.Timer(5.5, ends.set).start()  # others wait 5 s for a callback
    session.remove_node(node)
    assert ends.is_set()
