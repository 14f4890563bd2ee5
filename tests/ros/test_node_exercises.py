"""The double of node exercises does what rclpy does: the same records from real nodes."""

import contextlib
import functools
import time

import numpy as np
import pytest
from node_answers import ANSWERS

from imgproc_course.classroom.exercises import node_driver
from imgproc_course.classroom.exercises.canonical import canonical
from imgproc_course.classroom.exercises.comparison import compare

pytestmark = [pytest.mark.ros, pytest.mark.timeout(300)]

TOPIC = "/kachaka/front_camera/image_raw"
OF_ROS = ("/rosout", "/parameter_events")
PATIENCE = 20.0  # seconds; nothing waits as long on a machine that works
# Where the double differs from rclpy, by the answers that show it, and why.
DIFFERENT = {
    "no super": "rclpy raises AttributeError; the double says what to write",
    "no node": "nothing that rclpy could run",
    "spin": "rclpy.spin would never return; a drive ends there",
    "a service": "rclpy has it, and the double says that it does not",
    "a timer that publishes": "rclpy's timer fires when its period is over, the double's after each image",
    "main in one line": "rclpy.spin would not return from the cell",
    "Node.__init__, a callback with info, relative topics": "it throttles its log; a drive has no time",
    "compressed": "one process cannot have two types of one topic",
}


class RealDrive:
    """Drives a node in the graph: a camera publishes, rclpy's executor calls, and a receiver subscribes."""

    def __init__(self, node_class, monkeypatch):
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.publisher import Publisher
        from rclpy.qos import qos_profile_sensor_data
        from sensor_msgs.msg import Image

        self.context = Context()
        self.context.init()
        self.executor = SingleThreadedExecutor(context=self.context)
        self.helper = Node("camera_and_receiver", context=self.context)
        self.camera = self.helper.create_publisher(Image, TOPIC, qos_profile_sensor_data)
        self.executor.add_node(self.helper)
        self.sent, self.received, self.logged, self.calls = 0, [], [], 0
        self._spy(monkeypatch, Publisher)
        monkeypatch.setattr("rclpy.node.get_default_context", lambda: self.context)
        self.node = node_class()
        self.early = self.sent
        self.executor.add_node(self.node)
        expected = [node_driver._is_connected(endpoint, TOPIC) for endpoint in self.node.subscriptions]
        self._spin_until(lambda: self.camera.get_subscription_count() >= sum(expected))
        for subscription in self.node.subscriptions:
            subscription.callback = self._counting(subscription.callback)
        for publisher in self._publishers():
            receive = functools.partial(self._receive, publisher.topic_name)
            self.helper.create_subscription(
                publisher.msg_type, publisher.topic_name, receive, qos_profile_sensor_data
            )
            self._spin_until(lambda publisher=publisher: publisher.get_subscription_count() >= 1)

    def _spy(self, monkeypatch, publisher_class):
        """Count what the node publishes, and note what it logs; both still happen."""
        from rclpy.impl.rcutils_logger import _rclpy

        publish, log = publisher_class.publish, _rclpy.rclpy_logging_rcutils_log

        def counting(publisher, msg):
            publish(publisher, msg)
            self.sent += publisher.topic_name not in (TOPIC, *OF_ROS)

        def noting(severity, name, text, *arguments):
            log(severity, name, text, *arguments)
            self.logged.append((severity.name.lower(), text))

        monkeypatch.setattr(publisher_class, "publish", counting)
        monkeypatch.setattr(_rclpy, "rclpy_logging_rcutils_log", noting)

    def _publishers(self):
        return [publisher for publisher in self.node.publishers if publisher.topic_name not in OF_ROS]

    def _counting(self, callback):
        @functools.wraps(callback)
        def counted(*arguments):
            self.calls += 1
            return callback(*arguments)

        return counted

    def _receive(self, topic, msg):
        from imgproc_course.classroom.exercises.recording_node import fields_of

        self.received.append((topic, fields_of(msg)))

    def _spin_until(self, condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, "nothing happened"
            self.executor.spin_once(timeout_sec=0.01)

    def setup(self):
        name, subscriptions = self.node.get_name(), list(self.node.subscriptions)
        description = node_driver.describe_node(name, subscriptions, self._publishers())
        return description | {"published early": self.early}

    def take_step(self, step):
        if "image" not in step:
            return node_driver.ask_parameters(self.node, step)
        received, logged, calls, sent, ended = len(self.received), len(self.logged), self.calls, self.sent, ""
        connected = self.camera.get_subscription_count()
        self.camera.publish(node_driver.image_message(step, self.camera.msg_type))
        try:
            self._spin_until(lambda: self.calls - calls >= connected)
            self._spin_until(lambda: len(self.received) - received >= self.sent - sent)
        except Exception as error:
            if not step.get("bad"):
                raise
            ended = type(error).__name__
        answer = (self.logged[logged:], self.received[received:])
        return node_driver.describe_answer(step, connected, ended, *answer)

    def close(self):
        self.executor.shutdown()
        self.node.destroy_node()
        self.helper.destroy_node()
        self.context.try_shutdown()


def class_of(answer):
    names = {"__name__": "answer"}
    exec(answer.source, names)
    return names["EdgeDetector" if answer.exercise == "edges-class" else "ImageGrayProcessor"]


def outcome_of(function, *arguments):
    """The canonical form of what a function returns, or the type of its exception."""
    try:
        return canonical(function(*arguments), limit=None)
    except Exception as error:  # noqa: BLE001 - the answers are other people's code
        return type(error).__name__


def recorded_drive(node_class, steps):
    """Both records of `drive`."""
    return node_driver.drive(node_class, "setup", []) | node_driver.drive(node_class, "images", steps)


def real_drive(node_class, steps, monkeypatch):
    """The same from ROS."""
    with monkeypatch.context() as patch, contextlib.ExitStack() as stack:
        used = stack.enter_context(node_driver._traps(node_class))
        drive = RealDrive(node_class, patch)
        stack.callback(drive.close)
        results = []
        for step in steps:
            has_ended = bool(results) and bool(results[-1].get("ended"))
            results.append(results[-1] if has_ended else drive.take_step(step))
        return drive.setup() | {"steps": results} | used


def steps_of(answer):
    """Steps of every kind: images in several encodings, bad messages, and parameters where there are some."""
    rng = np.random.default_rng(7)

    def sent(number, **more):
        image = rng.integers(0, 256, (12, 16, 3), dtype=np.uint8)
        about = {
            "encoding": "bgr8",
            "topic": TOPIC,
            "stamp": (100 + number, 7),
            "frame_id": f"camera_{number}",
        }
        return {"image": image} | about | more

    steps = [
        sent(1),
        sent(2, encoding="rgb8"),
        sent(3, cut=True, bad=True),
        sent(4, encoding="bgr16", bad=True),
    ]
    if answer.exercise == "edges-class":
        steps += [{"get": ["low", "high"]}, sent(5), {"set": {"low": 10, "high": 30}}, {"set": {"low": 0.5}}]
    return [*steps, sent(6)]


COMPARED = [answer for answer in ANSWERS if answer.name not in DIFFERENT]


@pytest.mark.parametrize("answer", COMPARED, ids=[f"{a.exercise}: {a.name}" for a in COMPARED])
def test_the_double_does_what_rclpy_does(answer, monkeypatch):
    from imgproc_course.classroom.exercises.ros_double import offer_modules

    offer_modules()  # cv_bridge
    node_class, steps = class_of(answer), steps_of(answer)
    double = outcome_of(recorded_drive, node_class, steps)
    real = outcome_of(real_drive, node_class, steps, monkeypatch)
    if isinstance(double, str) or isinstance(real, str):
        assert double == real
    else:
        assert compare(real, double) is None


def test_the_double_has_a_word_for_every_name_of_rclpys_node():
    from rclpy.node import Node

    from imgproc_course.classroom.exercises.recording_node import _UNKNOWN, RecordingNode

    names = {name for name in dir(Node) if not name.startswith("_")}
    known = {name for name in dir(RecordingNode) if not name.startswith("_")}
    assert known | set(_UNKNOWN) == names and not known & set(_UNKNOWN)


def test_the_policies_and_profiles_of_the_double_are_rclpys():
    import rclpy.qos

    from imgproc_course.classroom.exercises.ros_double import _POLICIES, _qos_names

    for kind in _POLICIES.values():
        real = getattr(rclpy.qos, kind.__name__)
        assert {member.name: member.value for member in kind}.items() <= {
            name: int(member) for name, member in real.__members__.items()
        }.items()
    for name in ("qos_profile_sensor_data", "qos_profile_system_default"):
        double, real = _qos_names()[name], getattr(rclpy.qos, name)
        assert [(p, getattr(double, p)) for p in (*_POLICIES, "depth")] == [
            (p, getattr(real, p)) for p in (*_POLICIES, "depth")
        ]
