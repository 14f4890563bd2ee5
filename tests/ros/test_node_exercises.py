"""The double of node exercises does what rclpy does: the same records from real nodes."""

import contextlib
import math

import numpy as np
import pytest
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.comparison import compare
from nbclassroom.exercises.kinds.node import feed as node_feed
from nbclassroom.exercises.kinds.node.recording_node import (
    OF_ROS,
    NodeError,
    NodeRecord,
    RecordingNode,
    fields_of,
)
from nbclassroom.exercises.kinds.node.ros_double import _POLICIES, _modules, offer_modules
from node_answers import ANSWERS

pytestmark = [pytest.mark.ros, pytest.mark.timeout(60)]

TOPIC = "/kachaka/front_camera/image_raw"
SCANS = [
    {"message": "LaserScan", "topic": "/kachaka/lidar/scan", "fields": {"ranges": ranges, "range_max": 8.0}}
    for ranges in ([math.nan, math.inf, 3.0, 2.0], [0.3, 2.0])
]
SCANS = [*SCANS, SCANS[0], {"seconds": 0.3}, SCANS[0], {"seconds": 1.2}, SCANS[0]]
OF_EVERY_NODE = ("/rosout", "/parameter_events")
# Where the double differs from rclpy, by the answers that show it, and why.
DIFFERENT = {
    "Node.__init__, a callback with info, relative topics": "rclpy throttles its log; a drive has no time",
    "main in one line": "rclpy.spin would not return",
    "a service": "rclpy has it, and the double says that it does not",
}


@pytest.fixture
def real_nodes(monkeypatch):
    """Let `feed` make real nodes: they keep what they publish and log; their time is a ROS time, set here."""
    from rclpy.clock_type import ClockType
    from rclpy.context import Context
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.impl.rcutils_logger import _rclpy
    from rclpy.node import Node
    from rclpy.publisher import Publisher
    from rclpy.qos import QoSCompatibility, qos_check_compatible, qos_profile_sensor_data
    from rclpy.time import Time

    record, context, made = NodeRecord(), Context(), []
    publish, log = Publisher.publish, _rclpy.rclpy_logging_rcutils_log

    def keep(publisher, msg):
        publish(publisher, msg)
        if publisher.topic_name not in OF_EVERY_NODE:
            record.published.append((publisher.topic_name, fields_of(msg)))

    def is_connected(subscription, step):
        compatible, _ = qos_check_compatible(qos_profile_sensor_data, subscription.qos_profile)
        sent = (step.get("topic"), step.get("message", "Image"))
        is_same = (subscription.topic_name, subscription.msg_type.__name__) == sent
        return is_same and compatible != QoSCompatibility.ERROR

    def note(severity, name, text, *place):
        log(severity, name, text, *place)
        record.logged.append((severity.name.lower(), text))

    def record_of(node):
        if node not in made:
            made.append(node)
            record.subscriptions = list(node.subscriptions)
            record.publishers = [one for one in node.publishers if one.topic_name not in OF_EVERY_NODE]
            executor.add_node(node)
            node.get_clock()._set_ros_time_is_active(True)
            wait(node_feed.CLOCK, 0.01, ())
        return record

    def wait(clock, seconds, _timers):
        for _ in range(round(100 * seconds)):
            clock.nanoseconds += 10**7
            now = Time(nanoseconds=clock.nanoseconds, clock_type=ClockType.ROS_TIME)
            made[-1].get_clock().set_ros_time_override(now)
            executor.spin_once(timeout_sec=0)

    context.init()
    executor = SingleThreadedExecutor(context=context)
    monkeypatch.setattr("rclpy.node.get_default_context", lambda: context)
    monkeypatch.setattr(Publisher, "publish", keep)
    monkeypatch.setattr(_rclpy, "rclpy_logging_rcutils_log", note)
    monkeypatch.setattr(Node, "_node_record", property(record_of), raising=False)
    monkeypatch.setattr(node_feed, "_recording", contextlib.nullcontext)
    monkeypatch.setattr(node_feed, "_is_connected", is_connected)
    monkeypatch.setattr(type(node_feed.CLOCK), "wait", wait)
    yield
    for node in made:
        node.destroy_node()
    context.try_shutdown()


def outcome_of(answer):
    """The record of steps of every kind; None if it raises."""
    offer_modules()
    names = {"__name__": "answer"}
    exec(answer.source, names)
    if answer.exercise == "obstacles-brake":
        return records_of(names["BrakeNode"], ["connections", "commands"], SCANS)
    node_class = names["EdgeDetector" if answer.exercise == "edges-class" else "ImageGrayProcessor"]
    rng = np.random.default_rng(7)
    sent = [
        {
            "image": rng.integers(0, 256, (12, 16, 3), dtype=np.uint8),
            "encoding": encoding,
            "topic": TOPIC,
            "stamp": (100 + number, 7),
            "frame_id": f"camera_{number}",
        }
        for number, encoding in enumerate(("bgr8", "rgb8", "bgr8", "bgr16", "bgr8", "bgr8"))
    ]
    sent[2] |= {"cut": True, "bad": True}
    sent[3] |= {"bad": True}
    steps = sent
    if answer.exercise == "edges-class":
        new = [{"get": ["low", "high"]}, {"set": {"low": 10, "high": 30}}, {"set": {"low": 0.5}}]
        steps = [*sent[:4], *new, *sent[4:]]
    return records_of(node_class, ["setup", "images"], steps)


def records_of(node_class, parts, steps):
    try:
        records = [node_feed.feed(node_class, part, steps) for part in parts]
    except (Exception, NodeError):  # noqa: BLE001 - other people's code
        return None
    return canonical(records)


COMPARED = [answer for answer in ANSWERS if answer.name not in DIFFERENT]


@pytest.mark.parametrize("answer", COMPARED, ids=[f"{a.exercise}: {a.name}" for a in COMPARED])
def test_the_double_does_what_rclpy_does(answer, request):
    double = outcome_of(answer)
    request.getfixturevalue("real_nodes")
    real = outcome_of(answer)
    assert (double is None) == (real is None)
    assert real is None or compare(real, double) is None


def test_the_double_has_a_word_for_every_name_of_rclpys_node():
    from rclpy.node import Node

    names = {name for name in dir(Node) if not name.startswith("_")}
    known = {name for name in dir(RecordingNode) if not name.startswith("_")}
    assert known <= names
    assert [name for name in names - known if not OF_ROS.fullmatch(name)] == []


def test_the_values_of_the_double_are_rclpys():
    import rclpy.parameter
    import rclpy.qos

    doubles = _modules()
    kinds = [(kind, getattr(rclpy.qos, kind.__name__)) for kind in _POLICIES.values()]
    kinds.append((doubles["rclpy.parameter"]["Parameter"].Type, rclpy.parameter.Parameter.Type))
    for kind, real in kinds:
        assert {one.name: one.value for one in kind} == {one.name: int(real[one.name].value) for one in kind}
    double = doubles["rclpy.qos"]["qos_profile_sensor_data"]
    real = rclpy.qos.qos_profile_sensor_data
    policies = (*_POLICIES, "depth")
    assert [getattr(double, name) for name in policies] == [getattr(real, name) for name in policies]
