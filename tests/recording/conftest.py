"""Bags that the tests write themselves."""

import struct
import zlib
from collections import Counter

import lz4.frame
import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

TYPES = get_typestore(Stores.ROS2_JAZZY)
START = 1_700_000_000_000_000_000


def header(stamp_ns, frame_id="lens"):
    stamp = TYPES.types["builtin_interfaces/msg/Time"](sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
    return TYPES.types["std_msgs/msg/Header"](stamp=stamp, frame_id=frame_id)


def gray_pixels(k):
    """(4, 5) uint8: each test image differs from every other in every pixel."""
    return (np.arange(20, dtype=np.uint8).reshape(4, 5) + 40 * k % 256).astype(np.uint8)


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


def image_channel(topic="/my/cam", kind="sensor_msgs/msg/Image"):
    """(topic, type, encoding, language, definition) for `write_mcap`."""
    return topic, kind, "cdr", "ros2msg", TYPES.generate_msgdef(kind, ros_version=2)[0]


def write_mcap(path, messages, profile="ros2", per_chunk=2, indexed=9, repeated=True, packed=""):
    """Writes an MCAP file, record by record, with what other writers leave out.

    `messages`: (channel, log time, bytes or message); `per_chunk` 0: no chunks; `indexed`: how many channels
    of a chunk have an index behind it; `repeated`: the summary repeats schemas and channels, and states how
    many messages there are; `packed`: name of the compression.
    """

    def record(kind, *parts):
        data = b"".join(part if isinstance(part, bytes) else text(part) for part in parts)
        return struct.pack("<BQ", kind, len(data)) + data

    def text(value):
        return struct.pack("<I", len(value)) + (value.encode() if isinstance(value, str) else bytes(value))

    channels = list(dict.fromkeys(channel for channel, _, _ in messages))
    definitions = {}
    for number, (topic, kind, encoding, language, definition) in enumerate(channels, 1):
        schema = record(3, struct.pack("<H", number), kind, language, text(definition))
        definitions[number] = schema + record(4, struct.pack("<HH", number, number), topic, encoding, "")
    written = [b"\x89MCAP0\r\n", record(1, profile, "test")]
    known = set()
    for first in range(0, len(messages), per_chunk or 1):
        data, counts, times = b"", Counter(), []
        for channel, time, message in messages[first : first + (per_chunk or 1)]:
            number = channels.index(channel) + 1
            if number not in known:
                data += definitions[number]
                known.add(number)
            raw = (
                message
                if isinstance(message, bytes)
                else bytes(TYPES.serialize_cdr(message, message.__msgtype__))
            )
            data += record(5, struct.pack("<HIQQ", number, 0, time, time), raw)
            counts[number] += 1
            times.append(time)
        if per_chunk:
            head = struct.pack("<QQQI", min(times), max(times), len(data), zlib.crc32(data))
            stored = lz4.frame.compress(data) if packed == "lz4" else data
            data = record(6, head, packed, struct.pack("<Q", len(stored)), stored)
        written.append(data)
        for number, count in list(counts.items())[:indexed] if per_chunk else ():
            written.append(record(7, struct.pack("<HI", number, 16 * count), bytes(16 * count)))
    statistics = record(11, struct.pack("<QHIIIIQQI", len(messages), *[0] * 8))
    written += [record(15, bytes(4)), *([statistics, *definitions.values()] if repeated else ())]
    path.write_bytes(b"".join([*written, record(2, bytes(20)), b"\x89MCAP0\r\n"]))
    return path


def write_gray_mcap(path, foreign=(), **options):
    """Six gray images, ten a second; before each, a message on each foreign channel."""
    messages = []
    for k in range(6):
        time = START + k * 10**8
        messages += [(channel, time, b'{"a": 1}') for channel in foreign]
        messages.append((image_channel(), time, raw_image(k, time)))
    return write_mcap(path, messages, **options)
