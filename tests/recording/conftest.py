"""A recording of the drive, and bags that the tests write themselves."""

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from imgproc_course.recording import open_recording

TYPES = get_typestore(Stores.ROS2_JAZZY)
START = 1_700_000_000_000_000_000


@pytest.fixture(scope="session")
def drive():
    with open_recording("drive") as recording:
        yield recording


def header(stamp_ns, frame_id="lens"):
    stamp = TYPES.types["builtin_interfaces/msg/Time"](sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
    return TYPES.types["std_msgs/msg/Header"](stamp=stamp, frame_id=frame_id)


def gray_pixels(k):
    """(4, 5) uint8: each test image differs from every other in every pixel."""
    return (np.arange(20, dtype=np.uint8).reshape(4, 5) + 40 * k).astype(np.uint8)


def raw_image(k, stamp_ns):
    return TYPES.types["sensor_msgs/msg/Image"](
        header=header(stamp_ns),
        height=4,
        width=5,
        encoding="mono8",
        is_bigendian=0,
        step=5,
        data=gray_pixels(k).ravel(),
    )


def compressed(data, stamp_ns, format="png"):
    return TYPES.types["sensor_msgs/msg/CompressedImage"](
        header=header(stamp_ns), format=format, data=np.frombuffer(data, np.uint8)
    )


class BagWriter:
    """Writes a small bag: `write(topic, message, log time)`."""

    def __init__(self, path, storage="mcap", compression=None):
        plugin = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}[storage]
        self.path = path
        self.writer = Writer(path, version=8, storage_plugin=plugin)
        if compression:
            self.writer.set_compression(*compression)
        self.connections = {}

    def __enter__(self):
        self.writer.open()
        return self

    def __exit__(self, *exception):
        self.writer.close()

    def topic(self, name, kind):
        if name not in self.connections:
            self.connections[name] = self.writer.add_connection(name, kind, typestore=TYPES)
        return self.connections[name]

    def write(self, name, message, time):
        connection = self.topic(name, message.__msgtype__)
        self.writer.write(connection, time, TYPES.serialize_cdr(message, message.__msgtype__))


def write_raw_bag(path, storage="mcap", images=6, topic="/my/cam", **options):
    """A bag of gray images, ten a second, recorded 5 ms after they were taken."""
    with BagWriter(path, storage, **options) as bag:
        for k in range(images):
            stamp = START + k * 10**8
            bag.write(topic, raw_image(k, stamp), stamp + 5_000_000)
    return path
