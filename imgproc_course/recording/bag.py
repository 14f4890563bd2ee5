"""A rosbag2 recording, MCAP or SQLite, read lazily: message k of a topic without the messages after it.

Its files say what is in it. Of metadata.yaml, only the files' names and the number of messages are used.
"""

import heapq
import os
import re
import shutil
import struct
import sys
import tempfile
import threading
import weakref
from contextlib import ExitStack, contextmanager, suppress
from operator import itemgetter
from pathlib import Path, PurePath
from typing import Any, NamedTuple

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from .channels import READ_ERRORS, Channel, deserialized, typestores_of, zstd
from .errors import FrameIndexError, RecordingError
from .mcap import McapFile
from .sqlite import SqliteFile

FILE_CLASSES = {".mcap": McapFile, ".db3": SqliteFile}
ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
TIMED_PART = re.compile(r"(\d+)_(.+)_\d{4}_\d\d_\d\d-\d\d_\d\d_\d\d(\.\w+)")


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
    if path.is_dir() or _storage_suffix(path):
        return path
    reason = "not a rosbag2 recording; give a folder with metadata.yaml, a .mcap or a .db3"
    if path.suffix == ".bag":
        reason = f"a ROS 1 bag; convert it: rosbags-convert --src {path} --dst {path.stem}"
    raise RecordingError(f"{path} is {reason}")


def _storage_suffix(path):
    """ ".mcap" or ".db3", also if the file is compressed as a whole; None for others, as macOS's ._a.mcap."""
    suffix = PurePath(path.name.removesuffix(".zstd")).suffix.lower()
    return suffix if suffix in FILE_CLASSES and not path.name.startswith("._") else None


def _stated(folder):
    """(names of the files, number of messages) in a folder's metadata.yaml; ([], 0) if it cannot be read."""
    try:
        text = (folder / "metadata.yaml").read_text(errors="replace")
        information = YAML(typ="safe").load(text)["rosbag2_bagfile_information"]
        names = [PurePath(name).name for name in information["relative_file_paths"]]
        return names, int(information["message_count"])
    except (YAMLError, OSError, LookupError, TypeError, ValueError, AttributeError):
        return [], 0


def _part(name):
    """(recording, part of it) by a file's name: name_number, or number_name_time as rosbag2 writes it now."""
    if timed := TIMED_PART.fullmatch(name):
        return timed[2] + timed[3], timed[1]
    return re.sub(r"_\d+(?=\.\w+$)", "", name), name


def _files_of(folder, names):
    """(the files of a folder, the names of missing ones), as metadata.yaml names them, or else all."""
    files = {path.name.removesuffix(".zstd"): path for path in sorted(folder.iterdir(), reverse=True)}
    files = {name: path for name, path in files.items() if _storage_suffix(path)}
    names = [name.removesuffix(".zstd") for name in names]
    if present := [files[name] for name in names if name in files]:
        return present, [name for name in names if name not in files]
    if not files:
        reason = "holds no recording: no metadata.yaml, no .mcap, no .db3; give another folder"
        if names:
            reason = f"lacks {', '.join(names)}, which its metadata.yaml names; copy the whole folder again"
        raise RecordingError(f"{folder} {reason}")
    parts = {_part(name) for name in files}
    if len(parts) < len(files) or len({recording for recording, _ in parts}) > 1:
        listed = ", ".join(sorted(files))
        raise RecordingError(f"{folder} holds several recordings; give the path of one of them: {listed}")
    return [files[name] for name in sorted(files, key=lambda name: (len(name), name))], []


def _opened(path, stack):
    """A file of a recording; one that is compressed as a whole is unpacked first, as far as it goes."""
    name, storage_class = path.name, FILE_CLASSES[_storage_suffix(path)]
    if path.stat().st_size == 0:
        raise RecordingError(f"{path} is empty; the recording stopped before its first message: record again")
    if path.suffix == ".zstd":
        unpacked = Path(stack.enter_context(tempfile.TemporaryDirectory()), "unpacked")
        with zstd.open(path) as packed, unpacked.open("wb") as copy, suppress(EOFError, zstd.ZstdError):
            shutil.copyfileobj(packed, copy)
        path = unpacked
    return storage_class(path, name, stack)


@contextmanager
def readable(path):
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
        raise RecordingError(
            f"{path} cannot be read ({_reason(error)}); it is cut short or not a bag: "
            "copy it again from where it was recorded"
        ) from error


def _reason(error):
    return " ".join(str(error).split())[:200] or type(error).__name__


def _unpacked(raw):
    """A serialized message, which may be compressed on its own."""
    return zstd.decompress(raw) if raw[:4] == ZSTD_MAGIC else raw


class TopicIndex(NamedTuple):
    """Where each message of a topic is, and its time, read from the recording only as far as needed."""

    entries: Any  # iterator of (log time in ns, place, serialized message or None)
    places: list
    stamps: list[int]  # header stamp in ns, or the log time if the header's stamp is zero


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
        self._files: list[Any] = []
        stack = ExitStack()
        self._close = weakref.finalize(self, stack.close)
        self.missing = self._open_files(stack)
        self._channels: dict[str, Channel] = {}  # by topic: the first in CDR, or the first
        channels = [channel for file in self._files for channel in file.channels.values()]
        for channel in sorted(channels, key=lambda channel: channel.encoding != "cdr"):
            self._channels.setdefault(channel.topic, channel)
        topics = dict.fromkeys(channel.topic for channel in channels)
        self.topics = {topic: (self._channels[topic].kind, self._count(topic)) for topic in topics}

    def _open_files(self, stack):
        """Opens each file that can be read, and says in a sentence what is missing; None if nothing is."""
        paths, absent, stated = [self.path], [], 0
        if self.path.is_dir():
            names, stated = _stated(self.path)
            paths, absent = _files_of(self.path, names)
        problems, errors = [f"{name} is missing" for name in absent], []
        for path in paths:
            try:
                self._files.append(_opened(path, stack))
            except READ_ERRORS as error:
                errors.append(error)
                problems.append(f"{path.name} cannot be read ({_reason(error)})")
        if not self._files:
            with readable(self.path if len(paths) > 1 else paths[0]):
                raise errors[0]
        return self._missing(problems, stated)

    def _missing(self, problems, stated):
        count = sum(file.counts.total() for file in self._files)
        for file in self._files:
            if file.problem:
                known = f"it has {file.counts.total()} messages of {file.seconds:.1f} s"
                problems.append(f"{file.name} {file.problem}: {known}")
        if not problems and count >= stated:
            return None
        stated_loss = f"{stated - count} of {stated} messages are missing"
        loss = stated_loss if stated >= count else "how many messages are missing is not known"
        tail = sum(file.missing for file in self._files)
        unread = f", and its last {tail / 1e6:.2f} MB cannot be read" if tail else ""
        return "; ".join([*(problems or [f"{self.path.name} is not complete"]), loss]) + unread

    def close(self):
        with self._lock:
            self._close()

    def check_open(self):
        if not self._close.alive:
            raise RecordingError(f"recording {self.path.name} is closed; open it again with open_recording")

    def count(self, topic):
        return self.topics[topic][1]

    def _count(self, topic):
        return sum(file.counts[number] for file in self._files for number in self._numbers(file, topic))

    def _numbers(self, file, topic):
        """The channels of a file with the messages of a topic, or of all topics."""
        if topic is None:
            return set(file.channels)
        serialized = self._channels[topic][:3]
        return {number for number, channel in file.channels.items() if channel[:3] == serialized}

    def unreadable(self, topic):
        """Why no message of a topic can be read; "" if they can."""
        return typestores_of(self._channels[topic])[1]

    def _entries(self, topic=None):
        """Yields (log time, place, serialized message or None if it is damaged) in the order of time."""
        entries = [self._entries_of(file, topic) for file in self._files]
        return (entry for entry in heapq.merge(*entries, key=itemgetter(0)) if entry[1])

    def _entries_of(self, file, topic):
        yield file.start, None, None  # so that no file is read before its time
        for time, place, number, raw in file.messages(self._numbers(file, topic)):
            with suppress(zstd.ZstdError, TypeError):  # of what is damaged, an error says later
                raw = _unpacked(raw)
            yield time, (file, place, file.channels[number]), raw

    def _raw_at(self, file, place, _):
        with self._lock, readable(self.path):
            return _unpacked(file.read(place))

    def message(self, topic, k):
        """Message k of a topic, of the classes of rosbags."""
        places = self.index(topic, k).places
        if not 0 <= k < len(places):
            raise FrameIndexError(f"{topic} has messages 0 to {len(places) - 1}, got {k}; take one of these")
        return self.deserialize(self._raw_at(*places[k]), places[k][-1])

    def index(self, topic, k=None):
        """The topic's index, read to message k, or to the end."""
        self.check_open()
        with self._lock, readable(self.path):
            # Kept only if reading ends well: after an error, the iterator would look as if the bag ended.
            index = self._indexes.pop(topic, None) or TopicIndex(self._entries(topic), [], [])
            while k is None or len(index.places) <= k:
                entry = next(index.entries, None)
                if entry is None:
                    break
                time, place, raw = entry
                index.places.append(place)
                index.stamps.append((raw and header_stamp(raw)) or min(time, sys.maxsize))
            self._indexes[topic] = index
            return index

    def messages(self):
        """Yields (topic, message), or (topic, error) if it cannot be read, in the order of recording."""
        entries = self._entries()
        while True:
            self.check_open()
            with self._lock, readable(self.path):
                entry = next(entries, None)
            if entry is None:
                return
            _, place, raw = entry
            try:
                message = self.deserialize(self._raw_at(*place) if raw is None else raw, place[-1])
            except RecordingError as error:
                message = error
            yield place[-1].topic, message

    def deserialize(self, raw, channel):
        typestores, reason = typestores_of(channel)
        for types in typestores:
            try:
                return deserialized(types, raw, channel.kind)
            except RecordingError as error:  # it is not damaged
                reason = error
            except READ_ERRORS as error:
                reason = f"a message is damaged ({_reason(error)}); read the others"
        raise RecordingError(f"{channel.topic} of {self.path.name} cannot be read: {reason}")
