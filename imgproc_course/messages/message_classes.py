"""New messages: of sensor_msgs if ROS is installed, otherwise of rosbags, whose classes have the same fields.

Neither is imported before the first message is made.
"""

import functools
from typing import Any

import numpy as np

from .errors import ConversionError, quoted

# In annotations: a message, or its header. No class is named, since any object with its fields is accepted.
Message = Any


@functools.cache
def _ros_classes():
    """(Image, CompressedImage) of sensor_msgs, or None if it is not installed."""
    try:
        from sensor_msgs.msg import CompressedImage, Image
    except ImportError:
        return None
    return Image, CompressedImage


@functools.cache
def _rosbags_classes():
    """(Image, CompressedImage, function that returns an empty Header) of rosbags, as in ROS 2 Jazzy."""
    try:
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise ImportError(
            "a new message needs the message classes of ROS 2, and sensor_msgs is not installed here; "
            "source ROS (source /opt/ros/jazzy/setup.bash), or pip install rosbags"
        ) from None

    types = get_typestore(Stores.ROS2_JAZZY).types
    time, header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]

    def empty_header():
        return header(stamp=time(sec=0, nanosec=0), frame_id="")

    return types["sensor_msgs/msg/Image"], types["sensor_msgs/msg/CompressedImage"], empty_header


def new_image(header, height, width, encoding, is_bigendian, step, pixels):
    """An Image with a copy of `pixels`, a C-contiguous uint8 array of any shape."""
    if not _ros_classes():
        image, _, empty_header = _rosbags_classes()
        header = header if header is not None else empty_header()
        return image(header, height, width, encoding, is_bigendian, step, pixels.flatten())
    msg = _ros_classes()[0](
        height=height, width=width, step=step, encoding=encoding, is_bigendian=is_bigendian
    )
    _set_header(msg, header)
    msg.data.frombytes(pixels.data)  # the only way that is fast with and without ROS_PYTHON_CHECK_FIELDS
    return msg


def new_compressed_image(header, format, data):
    """A CompressedImage with a copy of `data`, any buffer of bytes."""
    if not _ros_classes():
        _, compressed_image, empty_header = _rosbags_classes()
        header = header if header is not None else empty_header()
        return compressed_image(header, format, np.frombuffer(data, np.uint8).copy())
    msg = _ros_classes()[1]()
    _set_header(msg, header)
    msg.format = format
    msg.data.frombytes(data)
    return msg


def _set_header(msg, header):
    if header is None:
        return
    try:
        msg.header = header
    except AssertionError:  # raised only if ROS_PYTHON_CHECK_FIELDS is on
        raise ConversionError(
            f"header must be a std_msgs/Header such as msg.header, got {quoted(header)}"
        ) from None
