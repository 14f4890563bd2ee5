# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""New messages: of sensor_msgs if ROS is installed, otherwise of rosbags, whose classes have the same fields.

Neither is imported before the first message is made.
"""

import functools
import importlib
from typing import Any

import numpy as np

from .errors import ConversionError, quoted

# In annotations: a message, or its header. No class is named, since any object with its fields is accepted.
Message = Any


@functools.cache
def installed_class(name):
    """The class of a message type such as "sensor_msgs/msg/Image"; None if its package is not installed."""
    package, _, kind = name.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.msg"), kind, None)
    except ImportError:
        return None


@functools.cache
def message_types():
    """The message definitions of ROS 2 Jazzy, which rosbags brings."""
    try:
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise ImportError(
            "a new message needs the message classes of ROS 2, and sensor_msgs is not installed here; "
            "source ROS (source /opt/ros/jazzy/setup.bash), or pip install rosbags"
        ) from None
    return get_typestore(Stores.ROS2_JAZZY)


def new_message(kind, header, data, **fields):
    """An Image or a CompressedImage with a copy of `data`, a C-contiguous buffer of bytes."""
    name = f"sensor_msgs/msg/{kind}"
    ros_class = installed_class(name)
    if ros_class is None:
        types = message_types().types
        if header is None:
            time = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
            header = types["std_msgs/msg/Header"](stamp=time, frame_id="")
        return types[name](header=header, data=np.frombuffer(data, np.uint8).copy(), **fields)
    msg = ros_class(**fields)
    if header is not None:
        try:
            msg.header = header
        except AssertionError:  # raised only if ROS_PYTHON_CHECK_FIELDS is on
            raise ConversionError(
                f"header must be a std_msgs/Header such as msg.header, got {quoted(header)}"
            ) from None
    msg.data.frombytes(data)  # the only way that is fast with and without ROS_PYTHON_CHECK_FIELDS
    return msg
