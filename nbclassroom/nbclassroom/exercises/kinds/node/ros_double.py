"""A double of what a node imports of ROS: for grading, and for a check where ROS is missing.

`offer_modules` puts modules named rclpy, sensor_msgs, ... into sys.modules. Their Node is the RecordingNode.
What they do not have can be imported, and raises NotGradedError when it is used.
"""

import array
import dataclasses
import enum
import functools
import importlib
import importlib.util
import operator
import re
import sys
import types
from importlib.machinery import ModuleSpec

from nbclassroom import course

from .recording_node import RecordingNode, refuse, ros_name


class _Message:
    """A message; like rclpy's, it checks no types, and has no fields but its own."""

    __slots__ = ()

    def __setattr__(self, name, value):
        object.__setattr__(self, name, array.array("B", value) if isinstance(value, bytes) else value)


# The package of each message, its name and its fields; what others hold comes first.
_DEFINITIONS = """
builtin_interfaces Time sec:int nanosec:int
std_msgs Header stamp:Time frame_id:str
sensor_msgs Image header:Header height:int width:int encoding:str is_bigendian:int step:int data:bytes
sensor_msgs LaserScan header:Header angle_min:float angle_max:float angle_increment:float
    time_increment:float scan_time:float range_min:float range_max:float ranges:floats intensities:floats
geometry_msgs Vector3 x:float y:float z:float
geometry_msgs Twist linear:Vector3 angular:Vector3
rcl_interfaces SetParametersResult successful:bool reason:str
rcl_interfaces ParameterDescriptor name:str type:int description:str additional_constraints:str
    read_only:bool dynamic_typing:bool
rcl_interfaces ParameterValue type:int bool_value:bool integer_value:int double_value:float string_value:str
"""


def _messages():
    kinds: dict = {"bool": bool, "int": int, "float": float, "str": str}
    kinds |= {"bytes": functools.partial(array.array, "B"), "floats": functools.partial(array.array, "f")}
    for line in re.split(r"\n(?=\w)", _DEFINITIONS)[1:]:
        package, name, *fields = line.split()
        pairs = (field.split(":") for field in fields)
        made = [(field, object, dataclasses.field(default_factory=kinds[kind])) for field, kind in pairs]
        kind = dataclasses.make_dataclass(name, made, bases=(_Message,), slots=True, kw_only=True)
        kind.__module__ = f"{package}.msg"  # here: from Python 3.12 on, make_dataclass sets it itself
        kinds[name] = kind
        yield kind


_PYTHON_TYPES = {bool: "BOOL", int: "INTEGER", float: "DOUBLE", str: "STRING", type(None): "NOT_SET"}


class _Parameter:
    Type = enum.Enum("Type", ("NOT_SET", "BOOL", "INTEGER", "DOUBLE", "STRING"), start=0)

    def __init__(self, name, type_=None, value=None):
        names = [text for kind, text in _PYTHON_TYPES.items() if isinstance(value, kind)]
        if not names:
            refuse(f"a value of the type {type(value).__name__} for a parameter")
        self.name, self.value, self.type_ = name, value, self.Type[names[0]]
        if type_ not in (None, self.type_):
            raise ValueError(f"the parameter {name} is a {type_.name}, and {value!r} is not")

    def get_parameter_value(self):
        values = {"type": self.type_.value, f"{self.type_.name.lower()}_value": self.value}
        return ros_name("rcl_interfaces.msg", "ParameterValue")(**values)


_POLICIES: dict = {
    name.lower(): enum.IntEnum(f"{name}Policy", values, start=0)
    for name, values in {
        "Reliability": "SYSTEM_DEFAULT RELIABLE BEST_EFFORT UNKNOWN BEST_AVAILABLE",
        "Durability": "SYSTEM_DEFAULT TRANSIENT_LOCAL VOLATILE UNKNOWN BEST_AVAILABLE",
        "History": "SYSTEM_DEFAULT KEEP_LAST KEEP_ALL",
    }.items()
}


class _QoSProfile:
    def __init__(self, **policies):
        for name in policies.keys() - {*_POLICIES, "depth"}:
            refuse(f"{name} of QoSProfile")
        if "depth" not in policies and policies.get("history", 1) == 1:
            raise ros_name("rclpy.qos", "InvalidQoSProfileException")("depth is missing")
        defaults = {"depth": 10, "history": 1, "reliability": 1, "durability": 2}
        for name, value in (defaults | policies).items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        object.__setattr__(self, name, _POLICIES.get(name, operator.index)(value))


class _Uncovered(type):
    """The type of the classes that stand for what the double does not have."""

    def __call__(cls, *_arguments, **_options):
        refuse(cls.__mro__[-2].__name__)

    def __getattr__(cls, name):
        refuse(f"{cls.__name__}.{name}")


class _Module(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        is_error = name.endswith(("Exception", "Error"))
        kind, bases = (type, (Exception,)) if is_error else (_Uncovered, ())
        setattr(self, name, kind(name, bases, {"__module__": self.__name__}))
        return getattr(self, name)


# They can be imported; what is in them cannot be used.
_EMPTY_MODULES = "action client clock context duration exceptions executors lifecycle logging publisher"
_EMPTY_MODULES += " service subscription task time timer utilities"


def _modules():
    """{name: what the double has in this module}."""
    modules: dict[str, dict] = {name: {} for name in course.ros_messages}
    for kind in _messages():
        modules.setdefault(kind.__module__.partition(".")[0], {})
        modules.setdefault(kind.__module__, {})[kind.__name__] = kind
    names = ("init", "shutdown", "try_shutdown", "spin", "spin_once")
    groups = ("CallbackGroup", "MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup")
    best_effort = _POLICIES["reliability"].BEST_EFFORT
    policies = {f"{qos}{kind.__name__}": kind for kind in _POLICIES.values() for qos in ("", "QoS")}
    return modules | {
        # Each is a function of its own: `feed` traps some.
        "rclpy": {name: lambda *_arguments, **_options: None for name in names} | {"ok": lambda: True},
        **{f"rclpy.{name}": {} for name in _EMPTY_MODULES.split()},
        "rclpy.node": {"Node": type("Node", (RecordingNode,), {"__module__": "rclpy.node"})},
        "rclpy.qos": policies
        | {
            "QoSProfile": _QoSProfile,
            "qos_profile_sensor_data": _QoSProfile(depth=5, reliability=best_effort),
        },
        "rclpy.parameter": {"Parameter": _Parameter},
        "rclpy.callback_groups": {group: type(group, (), {}) for group in groups},
    }


def offer_modules(*, even_if_installed: bool = False) -> None:
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
        sys.modules["cv_bridge"] = importlib.import_module(course.cv_bridge)
