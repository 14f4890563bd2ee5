"""A rosbag2 recording, MCAP or sqlite3, read lazily: message k of a topic without reading the rest."""

import os
import struct
import sys
import threading
import weakref
from contextlib import ExitStack, contextmanager
from pathlib import Path

import apsw
from backports.zstd import ZstdError
from rosbags.highlevel import AnyReader
from rosbags.highlevel.anyreader import AnyReaderError
from rosbags.rosbag2 import Reader, ReaderError
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_typestore

from .errors import FrameIndexError, NotRecordedError, RecordingError

STORAGE_SUFFIXES = (".mcap", ".db3")
# What rosbags lets through on damaged bytes; tests/recording flips and cuts bytes to hold this list complete.
READ_ERRORS = (
    AnyReaderError,
    ReaderError,
    SerdeError,
    TypesysError,
    ZstdError,
    apsw.Error,
    struct.error,
    ArithmeticError,
    AssertionError,
    EOFError,
    LookupError,
    MemoryError,
    OSError,
    RuntimeError,
    TypeError,
    ValueError,
)


# The types whose fields this package reads by name.
READ_TYPES = {
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/CameraInfo",
    "geometry_msgs/msg/PoseStamped",
    "std_msgs/msg/String",
}


def _table_of_contents(reader):
    """{topic: (message type, number of messages)}, in the order in which the recorder met the topics."""
    contents = {}
    for topic, info in sorted(reader.topics.items(), key=lambda item: item[1].connections[0].id):
        if not 0 <= info.msgcount <= sys.maxsize:
            raise ReaderError(f"it claims {info.msgcount} messages on {topic}")
        contents[str(topic)] = (str(info.connections[0].msgtype), info.msgcount)
    return contents


def _check_types(kinds, types):
    """A bag brings its own message definitions: those that we read must be ROS's own."""
    ros = get_typestore(Stores.ROS2_JAZZY)
    for kind in sorted(READ_TYPES & kinds):
        if types.hash_rihs01(kind) != ros.hash_rihs01(kind):
            raise ReaderError(f"its definition of {kind} is not that of ROS")


def find_bag(path):
    """The folder or file that a reader opens for what the user named.

    Raises
    ------
    RecordingError : nothing is there, or what is there is no rosbag2 recording
    """
    path = Path(path).expanduser()
    if path.name == "metadata.yaml":
        path = path.parent
    if not path.exists():
        raise RecordingError(
            f"there is no recording {path}; give the path of a rosbag2 folder, .mcap or .db3"
        )
    if not os.access(path, os.R_OK):
        raise RecordingError(f"{path} may not be read by you; change its rights: chmod -R u+rwX {path}")
    if path.is_dir():
        return _find_in_folder(path)
    if path.suffix == ".bag":
        raise RecordingError(
            f"{path} is a ROS 1 bag; convert it: rosbags-convert --src {path} --dst {path.stem}"
        )
    if path.suffix == ".zstd":
        raise RecordingError(
            f"{path} is compressed as a file; open its folder, or unpack it first: zstd -d {path}"
        )
    if path.suffix not in STORAGE_SUFFIXES:
        raise RecordingError(
            f"{path} is no rosbag2 recording; give a folder with metadata.yaml, .mcap or .db3"
        )
    if path.stat().st_size == 0:
        raise RecordingError(
            f"{path} is empty; the recording was cut off before its first message: record again"
        )
    return path


def _find_in_folder(folder):
    if (folder / "metadata.yaml").is_file():
        return folder
    files = sorted(file for file in folder.iterdir() if file.suffix in STORAGE_SUFFIXES)
    if len(files) == 1:
        return find_bag(files[0])
    if files:
        raise RecordingError(
            f"{folder} has {len(files)} files and no metadata.yaml; write it: ros2 bag reindex {folder}"
        )
    raise RecordingError(
        f"{folder} holds no recording: no metadata.yaml, no .mcap, no .db3; name another folder"
    )


def _cure(path, error):
    words = str(error)
    if "ompression" in words or "ecompress" in words:
        return "write it again with a compression that rosbags knows (none, zstd, lz4): ros2 bag convert"
    if path.is_dir() and ("metadata" in words or "missing" in words):
        return f"its metadata.yaml is broken or a file is missing: ros2 bag reindex {path}"
    if path.suffix == ".db3" or (path.is_dir() and any(path.glob("*.db3"))):
        return "it is cut short or no bag; try: sqlite3 broken.db3 .recover | sqlite3 mended.db3"
    return (
        "it is cut short or no bag; try: ros2 bag reindex FOLDER, or: mcap recover broken.mcap -o mended.mcap"
    )


@contextmanager
def reading(path):
    """Turns whatever a reader raises on damaged bytes into a RecordingError of one line."""
    try:
        yield
    except RecordingError:
        raise
    except PermissionError as error:
        raise RecordingError(
            f"{path} may not be read: {error.strerror}; change its owner or its rights"
        ) from error
    except READ_ERRORS as error:
        what = " ".join(str(error).split()) or type(error).__name__
        raise RecordingError(f"{path} cannot be read ({what[:200]}); {_cure(Path(path), error)}") from error


class TopicIndex:
    """When each message of a topic was recorded: known as far as somebody has asked, and no further."""

    def __init__(self, messages):
        self._messages = messages  # iterator of (log time in ns, serialized message)
        self._broken = None  # what the iterator ended with: it would go on as if the bag ended here
        self._seen = {}  # log time -> how many of the topic's messages carry it
        self.places = []  # (log time, which of the messages of that time)
        self.stamps = []  # header stamp in ns, or the log time where the robot left it zero

    def reach(self, k=None):
        """Goes on until message k is known, or to the end."""
        while k is None or len(self.places) <= k:
            if self._broken is not None:
                raise self._broken
            try:
                found = next(self._messages, None)
            except READ_ERRORS as error:
                self._broken = error
                raise
            if found is None:
                return
            time, raw = found
            ordinal = self._seen.get(time, 0)
            self._seen[time] = ordinal + 1
            self.places.append((time, ordinal))
            self.stamps.append(header_stamp(raw) or time)


def _messages(reader, topic, start=None, stop=None):
    connections = [connection for connection in reader.connections if connection.topic == topic]
    for _, time, raw in reader.messages(connections, start, stop):
        yield time, raw


def header_stamp(raw):
    """Stamp in ns of a serialized message that begins with a header; 0 where it is unset or there is none."""
    if len(raw) < 12:
        return 0
    order = "<" if raw[1] & 1 else ">"
    sec, nanosec = struct.unpack_from(order + "iI", raw, 4)
    return sec * 10**9 + nanosec if sec >= 0 and nanosec < 10**9 else 0


def with_stamp(raw, stamp):
    """The serialized message with another header stamp (ns); everything else as it was."""
    order = "<" if raw[1] & 1 else ">"
    return b"".join([raw[:4], struct.pack(order + "iI", *divmod(stamp, 10**9)), raw[12:]])


class Bag:
    """One open recording. Any thread may call any method."""

    def __init__(self, source):
        self.path = find_bag(source)
        self._lock = threading.RLock()
        self._indexes = {}
        stack = ExitStack()
        self._close = weakref.finalize(self, stack.close)
        with reading(self.path):
            any_reader = AnyReader([self.path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            stack.enter_context(any_reader)
            self._stack = stack
            self._reader = any_reader.readers[0]
            self.types = any_reader.typestore
            self.topics = _table_of_contents(any_reader)
            _check_types({kind for kind, _ in self.topics.values()}, self.types)

    def close(self):
        with self._lock:
            self._close()

    def check_open(self):
        if not self._close.alive:
            raise RecordingError(
                f"the recording {self.path.name} is closed; open it again with open_recording"
            )

    def count(self, topic):
        return self.topics[topic][1]

    def raw(self, topic, k):
        """Message k of a topic, serialized (CDR)."""
        index = self.index(topic, k)
        if not 0 <= k < len(index.places):
            self._no_such_message(topic, k, len(index.places))
        time, ordinal = index.places[k]
        with self._lock, reading(self.path):
            for i, (_, raw) in enumerate(_messages(self._reader, topic, time, time + 1)):
                if i == ordinal:
                    return bytes(raw)
        raise RecordingError(
            f"message {k} of {topic} has gone from {self.path}; was the file changed? Open it again"
        )

    def index(self, topic, k=None):
        """The topic's index, known as far as message k, or to its end."""
        self.check_open()
        with self._lock, reading(self.path):
            if topic not in self._indexes:
                if topic not in self.topics:
                    raise NotRecordedError(
                        f"{self.path.name} holds no {topic}; it holds {', '.join(self.topics)}"
                    )
                # A reader of its own: its place in the file must not move while another message is read.
                reader = self._stack.enter_context(Reader(self.path))
                messages = _messages(reader, topic)
                self._stack.callback(messages.close)  # first: sqlite closes no file that is still read
                self._indexes[topic] = TopicIndex(messages)
            index = self._indexes[topic]
            index.reach(k)
            return index

    def read(self):
        """Yields (topic, serialized message, message type) in the order of recording."""
        self.check_open()
        with reading(self.path), Reader(self.path) as reader:
            for connection, _, raw in reader.messages():
                yield connection.topic, bytes(raw), connection.msgtype

    def deserialize(self, raw, kind):
        with reading(self.path):
            return self.types.deserialize_cdr(raw, kind)

    def _no_such_message(self, topic, k, found):
        promised = self.count(topic)
        if k < promised:
            raise RecordingError(
                f"{self.path} promises {promised} messages on {topic} and holds {found}; "
                f"it is cut short: ros2 bag reindex {self.path.parent}"
            )
        raise FrameIndexError(f"{topic} has messages 0 to {found - 1}, {k} was asked for")
