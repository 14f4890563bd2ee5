"""Writes a rosbag2 recording in MCAP, which `open_recording`, Foxglove and ROS read."""

import contextlib
import shutil
from binascii import crc32
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray
from rosbags import interfaces
from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError
from rosbags.rosbag2.storage_mcap import McapWriter

from ..messages import array_to_compressed
from ..messages.message_classes import message_types
from .errors import RecordingError
from .mcap import HEAD

METADATA_VERSION: Final = 8  # the newest that `ros2 bag` of both Humble and Jazzy reads
CRC_PLACE = HEAD.size + 24  # in a chunk
NO_LIMIT = interfaces.QosTime(9223372036, 854775807)  # ROS's own, in seconds and ns


class _CheckedMcapWriter(McapWriter):
    """Writes a CRC into each chunk, where rosbags writes 0."""

    def close_chunk(self):
        start, crc = self.bio.tell(), crc32(self.chunk.bio.getvalue())
        super().close_chunk()
        end = self.bio.tell()
        self.bio.seek(start + CRC_PLACE)
        self.bio.write(crc.to_bytes(4, "little"))
        self.bio.seek(end)


class _CheckedWriter(Writer):
    STORAGE_PLUGINS = MappingProxyType({**Writer.STORAGE_PLUGINS, StoragePlugin.MCAP: _CheckedMcapWriter})


def offered_qos(reliability: str = "BEST_EFFORT", durability: str = "VOLATILE") -> Qos:
    """The QoS of a publisher, as `ros2 bag record` stores it for those who play the recording."""
    return Qos(
        history=interfaces.QosHistory.UNKNOWN,
        depth=0,
        reliability=interfaces.QosReliability[reliability],
        durability=interfaces.QosDurability[durability],
        deadline=NO_LIMIT,
        lifespan=NO_LIMIT,
        liveliness=interfaces.QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=NO_LIMIT,
        avoid_ros_namespace_conventions=False,
    )


class RecordingWriter(contextlib.AbstractContextManager["RecordingWriter"]):
    """A new recording: a folder that gets metadata.yaml and one .mcap file.

    It can be read after `close`; a recording without messages leaves no folder behind.

    Parameters
    ----------
    path : the folder, which must not exist

    Attributes
    ----------
    path : Path of the folder
    messages, bytes : how many were written

    Raises
    ------
    RecordingError : the folder exists, or cannot be made

    Examples
    --------
    >>> with RecordingWriter("my_drive") as writer:
    ...     writer.write("/camera/image_raw", "sensor_msgs/msg/Image", serialized_message, stamp)
    """

    def __init__(self, path: str | Path):
        self.path = Path(path).expanduser()
        self.messages = self.bytes = 0
        self._connections: dict[str, Connection] = {}  # by topic
        if self.path.suffix in (".mcap", ".db3"):
            raise RecordingError(
                f"{self.path} is the name of a file, but a recording is a folder; give {self.path.stem}"
            )
        try:
            self._writer = _CheckedWriter(
                self.path, version=METADATA_VERSION, storage_plugin=StoragePlugin.MCAP
            )
            self._writer.open()
        except WriterError as error:
            raise RecordingError(
                f"{self.path} exists already and is not overwritten; choose another name, or remove it"
            ) from error
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be written: {error.strerror}") from error
        self._is_open = True

    def write(
        self, topic: str, kind: str, serialized: bytes, stamp: int, qos: Sequence[Qos] = (offered_qos(),)
    ) -> None:
        """Adds a message.

        Parameters
        ----------
        topic : its name
        kind : its type, such as "sensor_msgs/msg/Image", of `message_types()`
        serialized : bytes, CDR
        stamp : time of recording in ns since 1970
        qos : of its publishers, by `offered_qos`; that of a topic's first message counts

        Raises
        ------
        RecordingError : the writer is closed, ROS has no such type, or the disk is full
        """
        if not self._is_open:
            raise RecordingError(f"the recording {self.path} is closed; make a new one")
        try:
            if topic not in self._connections:
                if kind not in message_types().types:
                    raise RecordingError(f"{topic} cannot be recorded: {kind} is no message type of ROS")
                self._connections[topic] = self._writer.add_connection(
                    topic, kind, typestore=message_types(), offered_qos_profiles=qos
                )
            self._writer.write(self._connections[topic], stamp, serialized)
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be written: {error.strerror}") from error
        self.messages += 1
        self.bytes += len(serialized)

    def write_image(self, topic: str, image: NDArray[np.uint8], stamp: int) -> None:
        """Adds an image as a CompressedImage in JPEG, without ROS.

        Parameters
        ----------
        topic : its name
        image : (H, W, 3) uint8 BGR, or (H, W) uint8 gray
        stamp : time of the image and of recording in ns since 1970

        Raises
        ------
        ConversionError : another shape or dtype; RecordingError : as in `write`
        """
        compressed = array_to_compressed(image, "mono8" if np.ndim(image) == 2 else "bgr8")
        types = message_types().types
        time = types["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
        header = types["std_msgs/msg/Header"](stamp=time, frame_id="")
        data = np.frombuffer(bytes(compressed.data), np.uint8)
        msg = types["sensor_msgs/msg/CompressedImage"](header, compressed.format, data)
        kind = "sensor_msgs/msg/CompressedImage"
        self.write(topic, kind, bytes(message_types().serialize_cdr(msg, kind)), stamp)

    def close(self) -> None:
        """Writes the index and the metadata. A second call does nothing.

        Raises
        ------
        RecordingError : the disk is full
        """
        if not self._is_open:
            return
        self._is_open = False
        if not self.messages:
            self._writer.abort()
            shutil.rmtree(self.path)
            return
        try:
            self._writer.close()
        except OSError as error:
            with contextlib.suppress(OSError):  # of what waits for the disk
                self._writer.abort()  # closes the file
            raise RecordingError(
                f"{self.path} cannot be completed: {error.strerror}; open_recording opens what it has"
            ) from error

    def __exit__(self, *exception):
        self.close()
