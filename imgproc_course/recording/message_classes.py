"""The message classes that are installed: sensor_msgs' own where ROS is, those of rosbags elsewhere."""

import array
import dataclasses
import functools
import importlib

import numpy as np


@functools.cache
def installed_class(name):
    """The class of a message type such as "sensor_msgs/msg/Image", or None where its package is missing."""
    package, _, kind = name.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.msg"), kind, None)
    except ImportError:
        return None


def to_installed(msg):
    """The same message in the class that ROS's own publishers take, or unchanged where ROS is not installed.

    Parameters
    ----------
    msg : a message that rosbags deserialized

    Returns
    -------
    a message of the same fields; its data are a copy
    """
    cls = installed_class(msg.__msgtype__)
    if cls is None:
        return msg
    out = cls()
    for field in dataclasses.fields(msg):
        if field.name != "__msgtype__":
            _fill(out, field.name, getattr(msg, field.name))
    return out


def _fill(out, name, value):
    default = getattr(out, name)
    if isinstance(default, array.array):
        # A list or an ndarray would be checked element by element: 0.2 s for one picture.
        default.frombytes(np.ascontiguousarray(value, default.typecode).view(np.uint8).data)
    elif isinstance(default, list):
        setattr(out, name, [_element(item) for item in value])
    else:
        setattr(out, name, _element(value))


def _element(value):
    return to_installed(value) if dataclasses.is_dataclass(value) else value
