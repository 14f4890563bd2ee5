"""A rosbag2 recording, MCAP or sqlite3, read lazily: message k of a topic without the messages after it."""

import itertools
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
from rosbags.rosbag2 import ReaderError
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_typestore

from ..messages.message_classes import message_types
from .errors import FrameIndexError, NotRecordedError, RecordingError
from .mcap import CutReader, damaged_spans

STORAGE_SUFFIXES = (".mcap", ".db3")
# The exceptions of rosbags on damaged bytes. tests/recording flips and cuts bytes to check this list.
READ_ERRORS = (
    *(AnyReaderError, ReaderError, SerdeError, TypesysError, ZstdError, apsw.Error, struct.error),
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


def _table_of_contents(reader):
    """{topic: (message type, number of messages)}, in the order in which the recorder added the topics."""
    contents = {}
    for topic, info in sorted(reader.topics.items(), key=lambda item: item[1].connections[0].id):
        if not 0 <= info.msgcount <= sys.maxsize:
            raise ReaderError(f"it claims {info.msgcount} messages on {topic}")
        contents[str(topic)] = (str(info.connections[0].msgtype), info.msgcount)
    return contents


def _check_types(kinds, types):
    """Checks the message definitions in the bag: those that this package reads must be the ones of ROS."""
    for kind in sorted(READ_TYPES & kinds):
        if types.hash_rihs01(kind) != message_types().hash_rihs01(kind):
            raise ReaderError(f"its definition of {kind} differs from that of ROS")


def find_bag(path):
    """The folder or file of the recording at a path."""
    path = Path(path).expanduser()
    if path.name == "metadata.yaml":
        path = path.parent
    if not path.exists():
        raise RecordingError(
            f"there is no recording {path}; give the path of a rosbag2 folder, .mcap or .db3"
        )
    if not os.access(path, os.R_OK):
        raise RecordingError(f"you may not read {path}; change its permissions: chmod -R u+rwX {path}")
    if path.is_dir():
        return _find_in_folder(path)
    if path.suffix not in STORAGE_SUFFIXES:
        reasons = {
            ".bag": f"a ROS 1 bag; convert it: rosbags-convert --src {path} --dst {path.stem}",
            ".zstd": f"compressed as a file; open its folder, or unpack it first: zstd -d {path}",
        }
        other = "not a rosbag2 recording; give a folder with metadata.yaml, a .mcap or a .db3"
        raise RecordingError(f"{path} is {reasons.get(path.suffix, other)}")
    if path.stat().st_size == 0:
        raise RecordingError(f"{path} is empty; the recording stopped before its first message: record again")
    return path


def _find_in_folder(folder):
    if (folder / "metadata.yaml").is_file():
        return folder
    files = sorted(file for file in folder.iterdir() if file.suffix in STORAGE_SUFFIXES)
    if len(files) == 1:
        return find_bag(files[0])
    if files:
        raise RecordingError(
            f"{folder} has {len(files)} files and no metadata.yaml; create it: ros2 bag reindex {folder}"
        )
    raise RecordingError(
        f"{folder} holds no recording: no metadata.yaml, no .mcap, no .db3; give another folder"
    )


def _remedy(path, error):
    text = str(error)
    if "ompression" in text or "ecompress" in text:
        return "write it again with a compression that rosbags knows (none, zstd, lz4): ros2 bag convert"
    if path.is_dir() and ("metadata" in text or "missing" in text):
        return f"its metadata.yaml is damaged or a file is missing: ros2 bag reindex {path}"
    if path.suffix == ".db3" or (path.is_dir() and any(path.glob("*.db3"))):
        return "it is cut short or not a bag; try: sqlite3 damaged.db3 .recover | sqlite3 repaired.db3"
    return (
        "it is cut short or not a bag; try: ros2 bag reindex FOLDER, "
        "or: mcap recover damaged.mcap -o repaired.mcap"
    )


def _damage(path):
    """When an MCAP recording is damaged, in seconds after its first message; "" if no chunk is."""
    files = sorted(path.glob("*.mcap")) if path.is_dir() else [path]
    if path.suffix != ".mcap" and len(files) != 1:
        return ""
    try:
        spans, first = damaged_spans(files[0])
    except READ_ERRORS:
        return ""
    return " and ".join(
        f"from {(start - first) / 1e9:.1f} to {(end - first) / 1e9:.1f} s after its first message"
        for start, end in spans[:3]
    )


@contextmanager
def reading(path):
    """Turns every error that a reader raises on damaged bytes into a RecordingError of one line."""
    try:
        yield
    except RecordingError:
        raise
    except PermissionError as error:
        raise RecordingError(
            f"you may not read {path}: {error.strerror}; change its owner or its permissions"
        ) from error
    except READ_ERRORS as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        if damage := _damage(Path(path)):
            raise RecordingError(
                f"{path} is damaged {damage} ({reason[:200]}); read what lies before, and copy it again"
            ) from error
        raise RecordingError(
            f"{path} cannot be read ({reason[:200]}); {_remedy(Path(path), error)}"
        ) from error


def _opened(path, stack):
    any_reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
    any_reader.readers = [CutReader(path)]
    return stack.enter_context(any_reader)


def _missing(path, any_reader):
    """What a recording lacks that was cut off, in a sentence; None if it is complete, or in several files."""
    storage = any_reader.readers[0].storage
    storages = getattr(storage, "storages", [storage])
    if len(storages) != 1 or getattr(storages[0], "missing", None) is None:
        return None
    (file,) = storages
    count, chunks = file.statistics.message_count, file.chunks
    seconds = (max(chunk[1] for chunk in chunks) - min(chunk[0] for chunk in chunks)) / 1e9
    stated = f"{any_reader.message_count - count} of {any_reader.message_count} messages are missing"
    lost = stated if path.is_dir() else "how many messages are missing is not known"
    tail = f", and its last {file.missing / 1e6:.2f} MB cannot be read" if file.missing else ""
    return f"{path.name} was cut off: it has {count} messages of {seconds:.1f} s; {lost}{tail}"


class TopicIndex:
    """The time of each message of a topic, read from the recording only as far as needed."""

    def __init__(self, messages):
        self._messages = messages  # iterator of (log time in ns, serialized message)
        self._error = None  # raised again later: after it the iterator would look as if the bag ended
        self.times = []  # log time in ns
        self.stamps = []  # header stamp in ns, or the log time if the header's stamp is zero

    def read_to(self, k=None):
        """Reads until message k is known, or to the end."""
        while k is None or len(self.times) <= k:
            if self._error is not None:
                raise self._error
            try:
                entry = next(self._messages, None)
            except READ_ERRORS as error:
                self._error = error
                raise
            if entry is None:
                return
            time, raw = entry
            self.times.append(time)
            self.stamps.append(header_stamp(raw) or time)


def _messages(reader, topic, start=None, stop=None):
    connections = [connection for connection in reader.connections if connection.topic == topic]
    for _, time, raw in reader.messages(connections, start, stop):
        yield time, raw


def header_stamp(raw):
    """Stamp in ns of a serialized message that begins with a header; 0 if it is not set or has no header."""
    if len(raw) < 12:
        return 0
    order = "<" if raw[1] & 1 else ">"
    sec, nanosec = struct.unpack_from(order + "iI", raw, 4)
    return sec * 10**9 + nanosec if sec >= 0 and nanosec < 10**9 else 0


class Bag:
    """One open recording. Any thread may call any method."""

    def __init__(self, source):
        self.path = find_bag(source)
        self._lock = threading.RLock()
        self._indexes = {}
        stack = ExitStack()
        self._close = weakref.finalize(self, stack.close)
        with reading(self.path):
            any_reader = _opened(self.path, stack)
            self.missing = _missing(self.path, any_reader)
            if self.missing and self.path.is_dir():
                # The counts of metadata.yaml are those of the complete file.
                self.path = any_reader.readers[0].storage.storages[0].path
                any_reader = _opened(self.path, stack)
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
        if not 0 <= k < len(index.times):
            self._raise_no_message(topic, k, len(index.times))
        time = index.times[k]
        earlier = index.times[:k].count(time)
        with self._lock, reading(self.path):
            for _, raw in itertools.islice(_messages(self._reader, topic, time, time + 1), earlier, None):
                return bytes(raw)
        raise RecordingError(
            f"message {k} of {topic} is no longer in {self.path}; if the file was changed, open it again"
        )

    def message(self, topic, k):
        """Message k of a topic, of the classes of rosbags."""
        return self.deserialize(self.raw(topic, k), self.topics[topic][0])

    def index(self, topic, k=None):
        """The topic's index, read to message k, or to the end."""
        self.check_open()
        with self._lock, reading(self.path):
            if topic not in self._indexes:
                if topic not in self.topics:
                    raise NotRecordedError(
                        f"{self.path.name} has no topic {topic}; it has {', '.join(self.topics)}"
                    )
                # A separate reader: its position in the file must not move when another message is read.
                reader = self._stack.enter_context(CutReader(self.path))
                messages = _messages(reader, topic)
                # Runs first: sqlite does not close a file that is being read.
                self._stack.callback(messages.close)
                self._indexes[topic] = TopicIndex(messages)
            index = self._indexes[topic]
            index.read_to(k)
            return index

    def read(self):
        """Yields (topic, serialized message, message type) in the order of recording."""
        self.check_open()
        with reading(self.path), CutReader(self.path) as reader:
            for connection, _, raw in reader.messages():
                yield connection.topic, bytes(raw), connection.msgtype

    def deserialize(self, raw, kind):
        with reading(self.path):
            return self.types.deserialize_cdr(raw, kind)

    def _raise_no_message(self, topic, k, actual_count):
        stated_count = self.count(topic)
        if k < stated_count:
            raise RecordingError(
                f"{self.path} should hold {stated_count} messages on {topic} and holds {actual_count}; "
                f"it is cut short: ros2 bag reindex {self.path.parent}"
            )
        raise FrameIndexError(f"{topic} has messages 0 to {actual_count - 1}, got {k}; choose one of these")
