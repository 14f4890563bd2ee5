"""A node that keeps what it creates, publishes and logs; nothing is sent.

`RecordingNode` has of rclpy's Node what the exercises' nodes use. Messages, QoS profiles and parameters come
from modules named rclpy, sensor_msgs, ...: from ROS, or from `ros_double`. What it does not have raises
NotGradedError where it is used: that is no mistake.
"""

import enum
import functools
import importlib
import inspect
import re

import numpy as np

from ...running import NodeError, NotGradedError

UNKNOWN_PART = "This check does not know"  # how the messages of NotGradedError begin
LEVELS = ("debug", "info", "warn", "error", "fatal")


def refuse(name):
    if name.rpartition(".")[2].startswith("__"):  # Python asks for it
        raise AttributeError(name)
    advice = "Write the node without it, or ask your teacher to look at it."
    raise NotGradedError(f"{UNKNOWN_PART} {name} (is it spelled right?). {advice}")


def ros_name(module, name):
    return getattr(importlib.import_module(module), name)


class NodeRecord:
    """What a node created, published as (topic, fields), and logged as (level, text)."""

    def __init__(self):
        self.publishers, self.subscriptions, self.timers = [], [], []
        self.published, self.logged = [], []


class _Part:
    """A part of a node: what it does not have is refused."""

    def __getattr__(self, name):
        refuse(name)


class _Logger(_Part):
    def __init__(self, logged):
        self._logged = logged

    def __getattr__(self, name):
        level = "warn" if name == "warning" else name
        return functools.partial(self._log, level) if level in LEVELS else super().__getattr__(name)

    def _log(self, level, message, **_filters):
        if level != "debug" and not isinstance(message, str):
            raise TypeError(f"{level}() takes a text, got a value of type {type(message).__name__}")
        self._logged.append((level, message))
        return True


class _Endpoint(_Part):
    """A publisher or a subscription."""

    def __init__(self, record, msg_type, topic, qos_profile, callback=None):
        self._record, self.msg_type, self.topic_name = record, msg_type, topic
        self.topic, self.qos_profile, self.callback = topic, qos_profile, callback

    def publish(self, msg):
        if not isinstance(msg, self.msg_type):
            kind = self.msg_type.__name__
            text = f"publish takes a message of the type {kind}, and this is a value of the type"
            makes = "cv2_to_imgmsg makes one of an array" if kind == "Image" else f"make one with {kind}()"
            raise NodeError(f"{text} {type(msg).__name__}: {makes}.")
        self._record.published.append((self.topic_name, fields_of(msg)))


class _Timer(_Part):
    """A timer: the Clock calls it when it is `due`."""

    def __init__(self, seconds, callback, is_on):
        self.callback, self._is_on = callback, is_on
        self.period = max(round(seconds * 1e9), 10**6)  # nanoseconds
        self.due = CLOCK.nanoseconds + self.period

    def cancel(self):
        self._is_on = False

    def reset(self):
        self._is_on = True
        self.due = CLOCK.nanoseconds + self.period

    def is_canceled(self):
        return not self._is_on


class Clock(_Part):
    """It goes on by a millisecond with each call, and with `wait`: no answer depends on the machine."""

    def __init__(self):
        self.nanoseconds = 0

    def now(self):
        self.nanoseconds += 10**6
        return _Time(self.nanoseconds)

    def wait(self, seconds, timers):
        """Let time pass, and call the timers that are due."""
        end = self.nanoseconds + round(seconds * 1e9)
        while due := [timer for timer in timers if not timer.is_canceled() and timer.due <= end]:
            timer = min(due, key=lambda timer: timer.due)
            self.nanoseconds = max(self.nanoseconds, timer.due)
            timer.due += timer.period
            timer.callback()
        self.nanoseconds = max(self.nanoseconds, end)


CLOCK = Clock()  # of all nodes, as on a computer


class _Time(_Part):
    """A time, or the duration between two."""

    def __init__(self, nanoseconds):
        self.nanoseconds = nanoseconds

    def __sub__(self, other):
        return _Time(self.nanoseconds - other.nanoseconds)

    def to_msg(self):
        sec, nanosec = divmod(self.nanoseconds, 10**9)
        return ros_name("builtin_interfaces.msg", "Time")(sec=sec, nanosec=nanosec)


def fields_of(msg):
    """What a message holds now, as plain values; of an Image what is compared, its bytes in rows."""
    if type_text(type(msg)) != "sensor_msgs/msg/Image":
        return {"type": type_text(type(msg)), "fields": _plain(msg)}
    values = {name: getattr(msg, name) for name in ("encoding", "height", "width")}
    stamp, data, step = msg.header.stamp, np.frombuffer(bytes(msg.data), np.uint8), msg.step or 1
    values |= {"stamp": (stamp.sec, stamp.nanosec), "frame_id": msg.header.frame_id}
    return values | {"pixels": data.reshape(-1, step) if data.size % step == 0 else data}


def _plain(value):
    slots = [name.lstrip("_") for name in getattr(value, "__slots__", ())]
    return {name: _plain(getattr(value, name)) for name in slots if name != "check_fields"} or value


def type_text(kind):
    """`sensor_msgs/msg/Image` of a message class."""
    return f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}"


def takes(function, count):
    """Whether a callback can be called with so many arguments."""
    try:
        inspect.signature(function).bind(*[None] * count)
    except TypeError:
        return False
    return True


# What rclpy's Node has beside the methods below.
OF_ROS = re.compile(
    r"(create|destroy)_(client|guard_condition|publisher|rate|service|subscription|timer)"
    r"|(add|remove)_(on_|pre_|post_)\w+_callback|(count|describe|list|resolve|undeclare|wait_for)_[a-z]+(_name)?"
    r"|get_(client|fully|namespace|node|parameter|publish|service|subscri|topic)\w*|set_(descriptor|param)\w*"
    r"|\w*waitables?|clients|context|default_callback_group|executor|guards|handle|publishers|services"
    r"|subscriptions|timers|PARAM_REL_TOL"
)
_TOPIC = re.compile(r"(~|(~/|/)?[A-Za-z_]\w*)(/[A-Za-z_]\w*)*", re.ASCII)


class RecordingNode:
    """The methods of rclpy's Node that the exercises' nodes use."""

    def __init__(self, node_name, *, context=None, **options):
        if options:
            refuse(f"{min(options)}= of a node")
        if not re.fullmatch(r"[A-Za-z_]\w*", str(node_name), re.ASCII):
            raise NodeError(f"The name of a node has letters, digits and _, and yours is {node_name!r}.")
        self._node_record = NodeRecord()
        self._node_name = node_name
        self._declared, self._set_callbacks = {}, []

    def __getattr__(self, name):
        if name in ("_node_record", "_node_name", "_declared", "_set_callbacks"):
            text = "__init__ of your class must begin with super().__init__(...), and the node's name."
            raise NodeError(text)
        if OF_ROS.fullmatch(name):
            refuse(f"{name} of a node")
        return object.__getattribute__(self, name)  # raises Python's own error

    def get_name(self):
        return self._node_name

    def get_logger(self):
        return _Logger(self._node_record.logged)

    def get_clock(self):
        return CLOCK

    def create_publisher(self, msg_type, topic, qos_profile, **_options):
        return self._create(self._node_record.publishers, msg_type, topic, qos_profile)

    def create_subscription(self, msg_type, topic, callback, qos_profile, *, raw=False, **_options):
        if raw:
            refuse("raw=True")
        if not takes(callback, 1) and not takes(callback, 2):
            raise NodeError("Pass the callback without (): ROS calls it: def image_callback(self, msg):")
        return self._create(self._node_record.subscriptions, msg_type, topic, qos_profile, callback)

    def _create(self, endpoints, msg_type, topic, qos_profile, callback=None):
        if not isinstance(msg_type, type):
            raise NodeError("The first argument here is the class of the messages: Image.")
        if not isinstance(topic, str) or not _TOPIC.fullmatch(topic):
            raise NodeError(f"A topic name has letters, digits, _ and /, as ~/gray; yours is {topic!r}.")
        if isinstance(qos_profile, int):
            qos_profile = ros_name("rclpy.qos", "QoSProfile")(depth=qos_profile)
        if not hasattr(qos_profile, "depth"):
            raise NodeError("The last argument here is a QoSProfile, or the number of messages that wait.")
        if topic.startswith("~"):
            topic = f"/{self._node_name}{topic[1:]}"
        topic = topic if topic.startswith("/") else f"/{topic}"
        endpoints.append(_Endpoint(self._node_record, msg_type, topic, qos_profile, callback))
        return endpoints[-1]

    def create_timer(self, timer_period_sec, callback, *_arguments, autostart=True, **_options):
        timer = _Timer(timer_period_sec, callback, is_on=autostart)
        self._node_record.timers.append(timer)
        return timer

    destroy_timer = staticmethod(_Timer.cancel)

    def destroy_node(self):
        pass

    def declare_parameter(self, name, value=None, descriptor=None, **options):
        if options or value is None or isinstance(value, enum.Enum):
            refuse("declare_parameter without a first value, or with other options")
        if name in self._declared:
            raise ros_name("rclpy.exceptions", "ParameterAlreadyDeclaredException")([name])
        parameter = ros_name("rclpy.parameter", "Parameter")(name, value=value)
        for refused in ("dynamic_typing", "integer_range", "floating_point_range"):
            if getattr(descriptor, refused, False):
                refuse(f"{refused} of a parameter")
        if not self._is_accepted(parameter):
            error = ros_name("rclpy.exceptions", "InvalidParameterValueException")
            raise error(name, value, "a callback refuses it")
        self._declared[name] = parameter, getattr(descriptor, "read_only", False)
        return parameter

    def declare_parameters(self, namespace, parameters, **options):
        prefix = f"{namespace}." if namespace else ""
        return [self.declare_parameter(prefix + name, *others, **options) for name, *others in parameters]

    def has_parameter(self, name):
        return name in self._declared

    def get_parameter(self, name):
        if name not in self._declared:
            raise ros_name("rclpy.exceptions", "ParameterNotDeclaredException")([name])
        return self._declared[name][0]

    def get_parameters(self, names):
        return [self.get_parameter(name) for name in names]

    def add_on_set_parameters_callback(self, callback):
        self._set_callbacks.insert(0, callback)

    def set_parameters(self, parameter_list):
        return [self._set(parameter) for parameter in parameter_list]

    def _set(self, parameter):
        """Set a declared parameter if its type is the same; a SetParametersResult."""
        old, read_only = self.get_parameter(parameter.name), self._declared[parameter.name][1]
        can_be_set = not read_only and parameter.type_ == old.type_ and self._is_accepted(parameter)
        if can_be_set:
            self._declared[parameter.name] = parameter, read_only
        return ros_name("rcl_interfaces.msg", "SetParametersResult")(successful=can_be_set)

    def _is_accepted(self, parameter):
        """Whether the node's callbacks accept a new value; none is asked after the first that refuses it."""
        results = (callback([parameter]) for callback in self._set_callbacks)
        return all(getattr(result, "successful", False) for result in results)
