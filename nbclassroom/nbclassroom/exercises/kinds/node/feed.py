"""Drive a node class that a learner wrote, and say what it did, as plain values.

The steps are dicts, in order:

    {"image": array, "encoding": "bgr8", "topic": "/camera/image_raw", "stamp": (sec, nanosec),
     "frame_id": "camera"}       an image on a topic, as a best-effort camera publishes it. With "cut": True
                                 half of its data are missing; with "bad": True the node must survive it
    {"message": "LaserScan", "topic": "/scan", "fields": {"ranges": [1.0]}}       another message
    {"seconds": 1.2}             nothing comes; a step that sends takes 0.1 s, or its "seconds"
                                 A step may have "about", what it shows: "this scan has walls"
    {"set": {"low": 20}}         parameters, as `ros2 param set` sets them
    {"get": ["low", "high"]}     parameters, as `ros2 param get` reads them

A node of rclpy is driven as a `RecordingNode`, so nothing of it appears in the ROS graph: a class that
records stands between the learner's class and rclpy's Node.
"""

import array
import contextlib
import importlib
import sys
import threading

import numpy as np

from ...running import NodeError
from .recording_node import CLOCK, LEVELS, RecordingNode, fields_of, refuse, takes, type_text
from .ros_double import offer_modules

_WINDOWS = ("imshow", "waitKey", "waitKeyEx", "namedWindow", "destroyAllWindows", "destroyWindow")
# What a node must not do: it is trapped while it is fed, and the record says that it was used. And its time.
_TRAPS = {
    "time": {"sleep": "sleeps"} | dict.fromkeys(("time", "monotonic", "perf_counter"), "clock"),
    "cv2": dict.fromkeys(_WINDOWS, "windows"),
    "rclpy": dict.fromkeys(("spin", "spin_once"), "spins"),
    "rclpy.logging": {"get_logger": "loggers"},
}
_SPINS = (
    "rclpy.spin and spin_once wait for messages: they do not belong in the class of a node. __init__ only"
    " creates, and the callback only answers. main spins the node; here the check does it."
)
_POLICIES = ("reliability", "durability", "history", "depth")


def feed(node_class, part, steps):
    """Make a node of a class, which inherits from ROS's Node or the double's, and let it take some steps.

    The record is a dict. For the part "setup" it has what the node is after the steps: "node", its name,
    "subscriptions" and "publishers", lists of dicts sorted by topic, and "published early", the number of
    messages that it published in __init__; for "connections" less, what decides whether ROS connects it. For
    "images" it has "steps", what came of each step, and for "commands", with what a robot obeys after it: the
    newest message of each topic, zeros before the first and where nothing answers a message that was sent.
    "sleeps" and "windows" say whether it used them.

    NotGradedError: the node uses what the double does not have. NodeError: it cannot be driven. Exceptions of
    its __init__ are raised, and those of its callback with an image that is not bad.
    """
    if not isinstance(node_class, type):
        raise TypeError(f"expected the class of your node, got a value of type {type(node_class).__name__}")
    offer_modules()
    CLOCK.nanoseconds = 0
    with _recording(node_class) as recording_class, _traps(node_class) as used:
        node = recording_class()
        record = node._node_record
        early = len(record.published)
        results: list[dict] = []
        for step in steps:
            has_ended = bool(results) and bool(results[-1].get("ended"))
            results.append(results[-1] if has_ended else _take_step(node, record, step))
            if part == "commands":
                commands = _commands(record, results[-1])
                results[-1] = {"delivered": results[-1]["delivered"], "published": commands}
        if part == "connections":
            return _describe(node.get_name(), record, _POLICIES[:2]) | used
        if part == "setup":
            return _describe(node.get_name(), record, _POLICIES) | {"published early": early} | used
        return {"steps": results} | used


@contextlib.contextmanager
def _recording(node_class):
    """A class like this one that records: where rclpy is, a RecordingNode between it and rclpy's Node."""
    kinds = {(kind.__module__, kind.__name__): kind for kind in node_class.__mro__}
    ros_node, name = kinds.get(("rclpy.node", "Node")), node_class.__name__
    if ros_node is None:
        raise NodeError(f"{name} is no node. Let it inherit from Node: class {name}(Node):")
    if issubclass(ros_node, RecordingNode):
        yield node_class
        return
    unknown = {name for name in dir(ros_node) if not name.startswith("_")} - set(dir(RecordingNode))
    refusals = {name: property(lambda *_, name=name: refuse(f"{name} of a node")) for name in unknown}
    between = type("Node", (RecordingNode, ros_node), refusals)
    start = ros_node.__init__

    def start_recording(node, *arguments, **options):
        (RecordingNode.__init__ if isinstance(node, between) else start)(node, *arguments, **options)

    # Node.__init__(self, ...) does not look for the class between, as super() does.
    ros_node.__init__ = start_recording
    try:
        yield type(name, (node_class, between), {})
    finally:
        ros_node.__init__ = start


@contextlib.contextmanager
def _traps(node_class):
    """Trap what a node must not do, also under the names that the learner's cell imported it by."""
    used, own_thread = {"sleeps": False, "windows": False}, threading.get_ident()

    def trap(function, name):
        def trapped(*arguments, **options):
            if threading.get_ident() != own_thread:  # the camera's thread, or that of a RosSession
                return function(*arguments, **options)
            if name == "spins":
                raise NodeError(_SPINS)
            if name == "clock":
                return CLOCK.now().nanoseconds / 1e9
            if name == "loggers":
                refuse("get_logger of rclpy.logging")
            used[name] = True
            return -1  # no key was pressed

        return trapped

    modules = {name: sys.modules[name] for name in _TRAPS if name in sys.modules}
    functions = {
        getattr(module, function): name
        for module_name, module in modules.items()
        for function, name in _TRAPS[module_name].items()
    }
    members = (value for kind in node_class.__mro__ for value in vars(kind).values())
    own_names: dict = next((value.__globals__ for value in members if hasattr(value, "__globals__")), {})
    with contextlib.ExitStack() as stack:
        for names in (*map(vars, modules.values()), own_names):
            for name, value in list(names.items()):
                with contextlib.suppress(TypeError):  # no function: it has no hash
                    if value in functions:
                        stack.callback(names.__setitem__, name, value)
                        names[name] = trap(value, functions[value])
        yield used


def _describe(name, record, policies):
    """What the constructor of a node made, as plain values."""
    subscriptions = [
        _endpoint(endpoint) | {name: _policy(endpoint, name) for name in policies}
        for endpoint in record.subscriptions
    ]
    return {
        "node": name,
        "subscriptions": sorted(subscriptions, key=lambda entry: entry["topic"]),
        "publishers": sorted(map(_endpoint, record.publishers), key=lambda entry: entry["topic"]),
    }


def _endpoint(endpoint):
    return {"topic": endpoint.topic_name, "type": type_text(endpoint.msg_type)}


def _policy(endpoint, name):
    value = getattr(endpoint.qos_profile, name)
    return getattr(value, "name", value)


def _take_step(node, record, step):
    """What came of a step, as plain values; of one that sends a message:

    delivered  how many subscriptions got it
    ended      the type of the exception that ended the node, ""
    log        the level of what was logged of a bad message; of a right one only the text of an error counts
    published  the fields of each message
    """
    if "get" in step or "set" in step:
        return _ask_parameters(node, step)
    published, logged = len(record.published), len(record.logged)
    delivered, ended = 0, ""
    for subscription in list(record.subscriptions):
        if _is_connected(subscription, step):
            delivered += 1
            try:
                message, callback = _message(step, subscription.msg_type), subscription.callback
                callback(message) if takes(callback, 1) else callback(message, {})
            except Exception as error:
                if not step.get("bad"):
                    raise
                ended = type(error).__name__
    if not ended:
        CLOCK.wait(step.get("seconds", 0.1), record.timers)
    level, text = max(record.logged[logged:], key=lambda entry: LEVELS.index(entry[0]), default=("", ""))
    level = "error" if level == "fatal" else level
    return {
        "delivered": delivered,
        "ended": ended,
        "log": level if step.get("bad") else text if level == "error" else "",
        "published": [{"topic": topic} | fields for topic, fields in record.published[published:]],
    }


def _commands(record, step):
    """The newest message on each topic, sorted; zeros without one, and after a step that nothing answers."""
    first = {endpoint.topic_name: fields_of(endpoint.msg_type()) for endpoint in record.publishers}
    is_answered = step["published"] or not step["delivered"]
    newest = first | dict(record.published if is_answered else ())
    return [{"topic": topic} | newest[topic] for topic in sorted(newest)]


def _ask_parameters(node, step):
    """What came of a step that sets or gets parameters; None for one that the node does not have."""
    if "get" in step:
        names = filter(node.has_parameter, step["get"])
        return {"parameters": {name: node.get_parameter(name).value for name in names}}
    parameter_class = importlib.import_module("rclpy.parameter").Parameter
    accepted: dict = {}
    for name, value in step["set"].items():
        accepted[name] = None
        if node.has_parameter(name):
            accepted[name] = node.set_parameters([parameter_class(name, value=value)])[0].successful
    return {"accepted": accepted}


def _is_connected(subscription, step):
    """Whether ROS connects a subscription with a sensor that offers best effort and volatile."""
    sent = (step.get("topic"), step.get("message", "Image"))
    asks_for_more = {_policy(subscription, "reliability"), _policy(subscription, "durability")}
    is_same = (subscription.topic_name, subscription.msg_type.__name__) == sent
    return is_same and not asks_for_more & {"RELIABLE", "TRANSIENT_LOCAL"}


def _message(step, kind):
    if "fields" in step:
        fields = step["fields"].items()
        return kind(**{name: array.array("f", v) if isinstance(v, list) else v for name, v in fields})
    pixels = np.ascontiguousarray(step["image"])
    msg = kind()
    msg.height, msg.width = pixels.shape[:2]
    msg.encoding, msg.step = step["encoding"], pixels[0].nbytes
    msg.header.stamp.sec, msg.header.stamp.nanosec = step["stamp"]
    msg.header.frame_id = step["frame_id"]
    msg.data.frombytes(pixels.tobytes()[: pixels.nbytes // 2 if step.get("cut") else None])
    return msg
