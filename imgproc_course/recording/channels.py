"""Channels: what a recording says about the messages of a topic, and the classes that they are read with."""

import functools
import re
import sqlite3
import struct
import sys
from typing import NamedTuple

from rosbags.rosbag2 import ReaderError
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_types_from_idl, get_types_from_msg, get_typestore

from ..messages.message_classes import message_types
from .errors import RecordingError

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

# What damaged bytes raise in rosbags and Python. tests/recording flips and cuts bytes to check this list.
READ_ERRORS = (
    *(ReaderError, SerdeError, TypesysError, sqlite3.Error, struct.error, zstd.ZstdError),
    *(ArithmeticError, AssertionError, EOFError, LookupError, MemoryError, OSError, RuntimeError),
    *(TypeError, ValueError),
)
# The types whose fields this package reads by name.
READ_TYPES = {
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/CameraInfo",
    "geometry_msgs/msg/PoseStamped",
    "std_msgs/msg/String",
}
# The first two bytes of a message that is not in CDR: DDS-XTypes 1.3, 7.6.2.1.2.
NAMES = {2: "PL_CDR", 6: "CDR2", 8: "D_CDR2", 10: "PL_CDR2", 16: "CDR2", 18: "PL_CDR2", 20: "D_CDR2"}
OTHER_THAN_CDR = {bytes([0, k + le]): f"{NAMES[k]}_{'BL'[le]}E" for k in NAMES for le in (0, 1)}
# In a type's definition: what CDR2 aligns to 4 bytes in place of 8, and lists that have a head in it.
OTHERWISE_IN_CDR2 = re.compile(r"64[ \[]|(/\w+|string)(<=\d+)?\[")
IDL_HEADING = re.compile(r"^={80}\nIDL: .*\n", re.MULTILINE)


class Channel(NamedTuple):
    """A topic in a file: its message type, how messages are serialized, and the definition of the type."""

    topic: str
    kind: str
    encoding: str
    language: str = ""
    definition: str = ""

    @classmethod
    def of(cls, topic, kind, encoding, language="", definition=""):
        """A channel whose type has its full name: "std_msgs/String" is "std_msgs/msg/String"."""
        return cls(topic, re.sub(r"^(\w+)/(\w+)$", r"\1/msg/\2", kind), encoding, language, definition)


@functools.cache
def typestores_of(channel):
    """(typestores for a channel's messages, the likeliest first, ""), or ([], why none reads them)."""
    kind, types = channel.kind, message_types()
    if channel.encoding != "cdr":
        return [], f"its messages are in the format {channel.encoding!r}, and only 'cdr' can be read"
    own = _own_typestore(channel)
    if own and kind in READ_TYPES and own.hash_rihs01(kind) != types.hash_rihs01(kind):
        return [], f"its definition of {kind} differs from that of ROS"
    typestores = [*([own] if own else []), *([types] if kind in types.types else [])]
    return typestores, "" if typestores else f"its type {kind!r} has no usable definition"


def _own_typestore(channel):
    """A typestore with the definition in the channel, which may lack types that ROS has; None without."""
    if not channel.definition.strip() and channel.kind in message_types().types:
        return None
    for base in (Stores.EMPTY, Stores.ROS2_JAZZY):
        store = get_typestore(base)
        try:
            store.register(_definitions(channel))
            store.get_msgdef(channel.kind)
        except READ_ERRORS:
            continue
        return store
    return None


def _definitions(channel):
    definition = channel.definition.replace("\r\n", "\n")
    if channel.language == "ros2msg":
        return get_types_from_msg(definition, channel.kind)
    types = {}
    for text in filter(str.strip, IDL_HEADING.split(definition)):
        types.update(get_types_from_idl(text))
    return types


def deserialized(types, raw, kind):
    """A message by a typestore. Zeros may follow it: some recorders store the whole buffer that held it."""
    if name := OTHER_THAN_CDR.get(raw[:2]):
        if name not in ("CDR2_BE", "CDR2_LE") or OTHERWISE_IN_CDR2.search(types.generate_msgdef(kind)[0]):
            raise RecordingError(
                f"its messages are written in DDS's encapsulation {name}, and only CDR_LE and CDR_BE can be "
                "read; record again from a publisher with ROS's own types and the data representation XCDR1"
            )
        raw = bytes([0, raw[1] & 1]) + raw[2:]
    try:
        return types.deserialize_cdr(raw, kind)
    except SerdeError as error:
        if "size mismatch" not in str(error):
            raise
        definition = types.get_msgdef(kind)
        read = definition.deserialize_cdr_le if raw[1] else definition.deserialize_cdr_be
        message, end = read(raw[4:], 0, definition.cls, types)
        if any(raw[4 + end :]):
            raise
        return message
