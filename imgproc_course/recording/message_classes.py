"""The installed message classes: those of ROS if it is installed, otherwise those of rosbags."""

import array
import dataclasses

import numpy as np

from ..messages.message_classes import installed_class


def to_installed(msg):
    """A copy of a message of rosbags in ROS's class, which publishers accept; itself where ROS is missing."""
    cls = installed_class(msg.__msgtype__)
    if cls is None:
        return msg
    ros_msg = cls()
    for field in dataclasses.fields(msg):
        if field.name != "__msgtype__":
            _set_field(ros_msg, field.name, getattr(msg, field.name))
    return ros_msg


def _set_field(ros_msg, name, value):
    default = getattr(ros_msg, name)
    if isinstance(default, array.array):
        # ROS would check a list or an ndarray element by element: 0.2 s for one image.
        default.frombytes(np.ascontiguousarray(value, default.typecode).view(np.uint8).data)
    elif isinstance(default, list):
        setattr(ros_msg, name, [_element(item) for item in value])
    else:
        setattr(ros_msg, name, _element(value))


def _element(value):
    return to_installed(value) if dataclasses.is_dataclass(value) else value
