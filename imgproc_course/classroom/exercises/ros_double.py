"""A double of what an image node imports of ROS: for grading, and for a check where ROS is missing.

`offer_modules` puts modules named rclpy, sensor_msgs, ... into sys.modules. Their Node is the RecordingNode.
What they do not have raises NotGradedError when it is used.
"""

import array
import enum
import importlib
import importlib.util
import re
import sys
import types
from importlib.machinery import ModuleSpec
from typing import ClassVar

from .. import course
from .recording_node import RecordingNode, refusals, refuse, ros_name


class _Message:
    """A message; like rclpy's, it checks no types, and has no fields but its own."""

    __slots__ = ()
    _fields: ClassVar = {}

    def __init__(self, **values):
        for name, default in self._fields.items():
            setattr(self, name, values[name] if name in values else default())

    def __setattr__(self, name, value):
        is_bytes = self._fields.get(name) is _bytes
        object.__setattr__(self, name, array.array("B", value) if is_bytes else value)

    def __eq__(self, other):
        names = self._fields
        return type(self) is type(other) and all(getattr(self, n) == getattr(other, n) for n in names)

    __hash__ = None


def _bytes():
    return array.array("B")


def _message(kind, package, /, **fields):
    body = {"__slots__": tuple(fields), "_fields": fields, "__module__": f"{package}.msg"}
    return type(kind, (_Message,), body)


# The package of each message, its name and its fields; what others hold comes first.
_DEFINITIONS = """
builtin_interfaces Time sec:int nanosec:int
std_msgs Header stamp:Time frame_id:str
sensor_msgs Image header:Header height:int width:int encoding:str is_bigendian:int step:int data:bytes
rcl_interfaces SetParametersResult successful:bool reason:str
rcl_interfaces ParameterDescriptor name:str type:int description:str additional_constraints:str
    read_only:bool dynamic_typing:bool
rcl_interfaces ParameterValue type:int bool_value:bool integer_value:int double_value:float string_value:str
"""


def _messages():
    """{name: class} of the messages."""
    kinds = {"bool": bool, "int": int, "float": float, "str": str, "bytes": _bytes}
    for line in re.split(r"\n(?=\w)", _DEFINITIONS)[1:]:
        package, name, *fields = line.split()
        types = (field.split(":") for field in fields)
        kinds[name] = _message(name, package, **{field: kinds[kind] for field, kind in types})
    return {name: kind for name, kind in kinds.items() if name[0].isupper()}


_MESSAGES = _messages()
_PYTHON_TYPES = {bool: "BOOL", int: "INTEGER", float: "DOUBLE", str: "STRING"}
_Type = enum.Enum("Type", ("NOT_SET", *_PYTHON_TYPES.values()), start=0)


def _type_of_value(value):
    if isinstance(value, list | tuple | bytes | array.array):
        refuse("a list as the value of a parameter")
    names = (name for kind, name in _PYTHON_TYPES.items() if isinstance(value, kind))
    name = next(names, "NOT_SET")
    if value is not None and name == "NOT_SET":
        raise TypeError(f"The given value is not one of the allowed types '{value}'.")
    return _Type[name]


_Type.from_parameter_value = staticmethod(_type_of_value)


class _Parameter:
    Type = _Type

    def __init__(self, name, type_=None, value=None):
        self.name, self.value = name, value
        self.type_ = _type_of_value(value) if type_ is None else type_
        if self.type_ != _type_of_value(value):
            raise ValueError(f"Type '{self.type_}' and value '{value}' do not agree")

    def get_parameter_value(self):
        value = ros_name("rcl_interfaces.msg", "ParameterValue")(type=self.type_.value)
        if self.value is not None:
            setattr(value, f"{self.type_.name.lower()}_value", self.value)
        return value


def _policy(name, values):
    return enum.IntEnum(f"{name}Policy", {member: place for place, member in enumerate(values.split())})


_POLICIES = {
    "reliability": _policy("Reliability", "SYSTEM_DEFAULT RELIABLE BEST_EFFORT UNKNOWN BEST_AVAILABLE"),
    "durability": _policy("Durability", "SYSTEM_DEFAULT TRANSIENT_LOCAL VOLATILE UNKNOWN BEST_AVAILABLE"),
    "history": _policy("History", "SYSTEM_DEFAULT KEEP_LAST KEEP_ALL UNKNOWN"),
}
_OTHER_POLICIES = ("lifespan", "deadline", "liveliness", "liveliness_lease_duration")
_OTHER_POLICIES += ("avoid_ros_namespace_conventions",)


class InvalidQoSProfileException(Exception):
    def __init__(self, *arguments):
        super().__init__("Invalid QoSProfile", *arguments)


class _QoSProfile:
    def __init__(self, **policies):
        unknown = policies.keys() - {*_POLICIES, *_OTHER_POLICIES, "depth"}
        assert not unknown, f"Invalid arguments passed to constructor: {policies.keys()!r}"
        if not policies.keys() & {"history", "depth"}:
            raise InvalidQoSProfileException("History and/or depth settings are required.")
        self.history = policies.pop("history", _POLICIES["history"].KEEP_LAST)
        if self.history.name == "KEEP_LAST" and "depth" not in policies:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        defaults = {"depth": 10, "reliability": 1, "durability": 2}
        for name, value in (defaults | policies).items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        kind = _POLICIES.get(name)
        if kind is not None or name == "depth":
            assert isinstance(value, int)
            value = kind(value) if kind else value
        object.__setattr__(self, name, value)

    def __eq__(self, other):
        return isinstance(other, _QoSProfile) and vars(self) == vars(other)

    __hash__ = None


class _Clock:
    """It goes on by a millisecond with each look: no answer depends on the machine."""

    _milliseconds = 0

    def now(self):
        _Clock._milliseconds += 1
        return _Instant(_Clock._milliseconds * 10**6)


class _Instant:
    """A time, or the duration between two."""

    def __init__(self, nanoseconds):
        self.nanoseconds = nanoseconds

    def __sub__(self, other):
        return _Instant(self.nanoseconds - other.nanoseconds)

    def to_msg(self):
        sec, nanosec = divmod(self.nanoseconds, 10**9)
        return _MESSAGES["Time"](sec=sec, nanosec=nanosec)


def _check_name(pattern, error):
    def validate(name, *_arguments):
        if not isinstance(name, str):
            raise TypeError(f"a name must be a text, got a value of type {type(name).__name__}")
        if not re.fullmatch(pattern, name):
            raise _ERRORS[error](f"Invalid {error[len('Invalid') : -len('Exception')]}: {name!r}")
        return True

    return validate


def _expand_topic_name(topic, node_name, namespace):
    namespace = namespace.rstrip("/")
    if topic.startswith("~"):
        return f"{namespace}/{node_name}{topic[1:]}"
    return topic if topic.startswith("/") else f"{namespace}/{topic}"


def _check_message_class(kind):
    if not (isinstance(kind, type) and issubclass(kind, _Message)) and type(kind) is not _Uncovered:
        name = getattr(type(kind), "__name__", "")
        raise AttributeError(f"type object {name!r} has no attribute '_TYPE_SUPPORT'")


def _error_of(text):
    return lambda self, parameters: Exception.__init__(self, f"{text}: {parameters}")


_ERRORS = {
    "ParameterNotDeclaredException": _error_of("Invalid access to undeclared parameter(s)"),
    "ParameterAlreadyDeclaredException": _error_of("Parameter(s) already declared"),
    "ParameterUninitializedException": _error_of("The parameter is not initialized"),
    "InvalidParameterValueException": lambda self, name, value, reason: Exception.__init__(
        self, f"Invalid parameter value ({value}) for parameter. Reason: {reason}: {name}"
    ),
    **dict.fromkeys(("InvalidNodeNameException", "InvalidTopicNameException"), Exception.__init__),
}
_ERRORS = {name: type(name, (Exception,), {"__init__": init}) for name, init in _ERRORS.items()}


class _Uncovered(type):
    """The type of the classes that stand for what the double does not have."""

    def __call__(cls, *_arguments, **_options):
        refuse(cls.__mro__[-2].__name__)

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        refuse(f"{cls.__name__}.{name}")


class _Module(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _Uncovered(name, (), {"__module__": self.__name__})


# They can be imported; what is in them cannot be used.
_EMPTY_MODULES = re.findall(
    r"\w+", "action client context duration executors lifecycle logging service task time timer utilities"
)


def _qos_names():
    sensor_data = _QoSProfile(depth=5, reliability=_POLICIES["reliability"].BEST_EFFORT)
    zeros = dict.fromkeys(("depth", "reliability", "durability"), 0)
    system_default = _QoSProfile(history=_POLICIES["history"].SYSTEM_DEFAULT, **zeros)
    names = {f"{prefix}{kind.__name__}": kind for kind in _POLICIES.values() for prefix in ("", "QoS")}
    return names | {
        "QoSProfile": _QoSProfile,
        "InvalidQoSProfileException": InvalidQoSProfileException,
        "qos_profile_sensor_data": sensor_data,
        "qos_profile_system_default": system_default,
    }


def _modules():
    """{name: what the double has in this module}."""
    names = ("rclpy", *course.ROS_MESSAGES, *(f"{package}.msg" for package in course.ROS_MESSAGES))
    modules = {name: {} for name in (*names, *(f"rclpy.{module}" for module in _EMPTY_MODULES))}
    for kind in _MESSAGES.values():
        modules[kind.__module__][kind.__name__] = kind
    for name in ("init", "shutdown", "try_shutdown", "spin", "spin_once", "spin_until_future_complete"):
        modules["rclpy"][name] = lambda *_arguments, **_options: None  # each its own: a drive traps some
    modules["rclpy"]["ok"] = lambda **_options: True
    groups = ("CallbackGroup", "MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup")
    node_class = type("Node", (RecordingNode,), refusals() | {"__module__": "rclpy.node"})
    check_node_name = _check_name(r"[A-Za-z_]\w*", "InvalidNodeNameException")
    check_topic = _check_name(r"(~|(~/|/)?[A-Za-z_]\w*)(/[A-Za-z_]\w*)*", "InvalidTopicNameException")
    return modules | {
        "rclpy.node": {"Node": node_class},
        "rclpy.qos": _qos_names(),
        "rclpy.parameter": {"Parameter": _Parameter},
        "rclpy.exceptions": _ERRORS,
        "rclpy.clock": {"Clock": _Clock},
        "rclpy.callback_groups": {group: type(group, (), {}) for group in groups},
        "rclpy.expand_topic_name": {"expand_topic_name": _expand_topic_name},
        "rclpy.type_support": {"check_is_valid_msg_type": _check_message_class},
        "rclpy.validate_node_name": {"validate_node_name": check_node_name},
        "rclpy.validate_topic_name": {"validate_topic_name": check_topic},
    }


def offer_modules(*, even_if_installed=False):
    """Let `import rclpy` give the double where ROS is missing, and `import cv_bridge` the course's own.

    `even_if_installed`: in grading; there ROS would need the network.
    """
    if "rclpy" not in sys.modules and (even_if_installed or importlib.util.find_spec("rclpy") is None):
        modules = {}
        for name, content in _modules().items():
            modules[name] = _Module(name)
            modules[name].__spec__ = ModuleSpec(name, None, is_package=True)
            vars(modules[name]).update(content, __path__=[])
            package, _, last = name.rpartition(".")
            if package:
                setattr(modules[package], last, modules[name])
        sys.modules.update(modules)
    if "cv_bridge" not in sys.modules and importlib.util.find_spec("cv_bridge") is None:
        sys.modules["cv_bridge"] = importlib.import_module(course.CV_BRIDGE)
