"""A recorded drive: frames, messages, camera info, depth, labels, poses."""

import array
import contextlib
import dataclasses
import json
import re
import warnings
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..messages import ConversionError, compressed_to_array, encoding_info, image_to_array
from ..messages.message_classes import Message, installed_class
from . import topics as names
from .errors import FrameIndexError, NotRecordedError, RecordingError

DRIVE = Path(__file__).parent / "drive"
IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
MOST_UNREADABLE = 100  # messages or frames in a row; what follows is not tried
CLOCK_JUMP = 600 * 10**9  # ns between two frames, from which on the clock was set rather than the camera slow
COLOR, GRAY, UNKNOWN, DEPTH = range(4)  # types of images, the likeliest camera first
# Images that a camera's driver or another program computes, and transports for a few programs only.
OTHER_IMAGES = re.compile(
    r"depth|disparity|infra|/ir\d*(/|$)|label|mask|segment|truth|debug|annotat|overlay|result|/zstd$|/ffmpeg$",
    re.IGNORECASE,
)
ALIGNED_DEPTH = re.compile("aligned_depth|depth_registered")  # as drivers name depth in the camera's pixels


def open_recording(source: str | Path = "drive", *, camera_topic: str | None = None) -> "Recording":
    """Opens a recording and reads its table of contents.

    Parameters
    ----------
    source : "drive" for the course's own recording, or the path of your own rosbag2 recording: its folder,
        its .mcap or its .db3
    camera_topic : the topic of the images that are the frames; if omitted, it is chosen by the images and the
        name: color before gray before depth

    Returns
    -------
    Recording

    Raises
    ------
    RecordingError : the recording is missing, empty, not a recording, or has no images; the text is one line
        that says what to do
    UserWarning : the recording is not complete, and opens with what it has; see `Recording.missing`

    Examples
    --------
    >>> with open_recording("drive") as drive:
    ...     frame = drive.frame(0)
    >>> frame.shape
    (720, 1280, 3)
    """
    return Recording(source, camera_topic=camera_topic)


class Recording(contextlib.AbstractContextManager["Recording"]):
    """An open recording: see `open_recording`.

    Iterating yields (topic, message) lazily, in the order of recording; a warning names each topic of which
    messages are skipped, because nothing here reads them. `len()` is the number of frames.
    Messages are of ROS's classes (sensor_msgs.msg.CompressedImage and so on) if ROS is installed, otherwise
    of the classes of rosbags, which have the same fields.
    A number k counts from 0, a negative one from the end. Any thread may call any method.

    Attributes
    ----------
    name : "drive", or the name of the folder or file
    camera_topic : the topic of the images that are the frames
    missing : what a recording that is not complete lacks, in a sentence; None if it is complete
    """

    def __init__(self, source: str | Path = "drive", *, camera_topic: str | None = None):
        try:
            from .bag import Bag  # here: rosbags needs apsw, which some platforms lack
        except ModuleNotFoundError as error:
            remedy = 'pip install ".[ros]" in the checkout of the course installs it where it exists'
            raise RecordingError(f"recordings cannot be read: {error.name} is missing; {remedy}") from error

        is_drive = source == "drive"
        try:
            self._bag = Bag(DRIVE if is_drive else source)
        except RecordingError as error:
            if not is_drive:
                raise
            raise RecordingError(
                "the course's own recording is missing or damaged; restore it: "
                f"git checkout -- imgproc_course/recording/drive ({error})"
            ) from error
        self.missing = self._bag.missing
        if self.missing:
            warnings.warn(self.missing, stacklevel=3)
        self.name = "drive" if is_drive else self._bag.path.name
        self._skipped: set[str] = set()  # topics of messages that a warning named
        try:
            self.camera_topic = self._find_camera(camera_topic)
        except RecordingError:
            self.close()
            raise

    def __exit__(self, *exception):
        self.close()

    def close(self) -> None:
        """Closes the files. A second call does nothing."""
        self._bag.close()

    def __len__(self) -> int:
        return self._bag.count(self.camera_topic)

    def __iter__(self) -> Iterator[tuple[str, Message]]:
        for topic, message in self._bag.messages():
            if not isinstance(message, RecordingError):
                yield topic, to_installed(message)
            elif topic not in self._skipped:
                self._skipped.add(topic)
                warnings.warn(f"skipped: {message}", stacklevel=2)

    def __repr__(self):
        counts = f"{len(self)} frames on {self.camera_topic}, {len(self.topics)} topics"
        return f"<Recording {self.name!r}: {counts}>"

    @property
    def topics(self) -> dict[str, str]:
        """Every topic of the recording and its message type: {"/topic": "package/msg/Type"}."""
        return {topic: kind for topic, (kind, _) in self._bag.topics.items()}

    def frame(self, k: int, encoding: str = "bgr8") -> np.ndarray:
        """Frame k, decoded.

        Parameters
        ----------
        k : number of the frame, 0 to len() - 1
        encoding : the encoding of the result: "bgr8", "rgb8", "mono8"; "passthrough" for the recorded one

        Returns
        -------
        (720, 1280, 3) uint8 for "bgr8" and the course's own recording

        Raises
        ------
        FrameIndexError : there is no frame k
        ConversionError : the message is malformed, or cannot be converted to `encoding`
        """
        return self._decode(self.camera_topic, self._number(k), encoding)

    def message(self, k: int) -> Message:
        """The recorded message of frame k: a CompressedImage, or an Image in a recording of raw images."""
        return to_installed(self._bag.message(self.camera_topic, self._number(k)))

    @property
    def camera_info(self) -> Message:
        """The camera's first CameraInfo: matrix k, distortion d (plumb_bob), r, p."""
        base = self.camera_topic.removesuffix("/compressed").rsplit("/", 1)[0]
        usual_topics = (f"{base}/camera_info", f"{self.camera_topic.removesuffix('/compressed')}/camera_info")
        recorded_topics = [topic for topic, kind in self.topics.items() if kind == CAMERA_INFO]
        for topic in [*usual_topics, *(recorded_topics if len(recorded_topics) == 1 else [])]:
            if topic in recorded_topics and (count := self._bag.count(topic)):
                return to_installed(first_readable(partial(self._bag.message, topic), count))
        raise NotRecordedError(
            f"{self.name} holds no camera info of {self.camera_topic}; record {usual_topics[0]} with it"
        )

    def depth(self, k: int) -> NDArray[np.uint16]:
        """Depth image of frame k: the distance along the optical axis.

        Returns
        -------
        (360, 640) uint16, millimetres, 0 for pixels without a measurement; pixel (row, col) belongs to pixel
        (2 row, 2 col) of the frame, or to (row, col) if the frame has this size too

        Raises
        ------
        NotRecordedError : the recording holds no depth, or none at this frame
        """
        topic = self._checked_topic(self.depth_topic or names.DEPTH, "depth")
        return self._decode(topic, self._number_at_frame(topic, k), "passthrough")

    @property
    def depth_topic(self) -> str | None:
        """The topic of the depth images that belong to the frames; None without."""
        beside = f"{self.camera_topic.removesuffix('/compressed').rpartition('/')[0]}/depth"
        aligned = [t for t, kind in self.topics.items() if kind == IMAGE and ALIGNED_DEPTH.search(t)]
        return next((topic for topic in (names.DEPTH, beside, *aligned) if topic in self.topics), None)

    def labels(self, k: int) -> NDArray[np.uint8]:
        """Label image of frame k: (720, 1280) uint8, the numbers of `label_names`."""
        return self._decode(self._checked_topic(names.LABELS, "labels"), self._number(k), "mono8")

    @property
    def label_names(self) -> dict[int, str]:
        """The meaning of each number in `labels`: {0: "background", 1: "floor", ...}."""
        return {int(number): name for number, name in self.scene["label_names"].items()}

    @property
    def scene(self) -> dict[str, Any]:
        """Facts about the scene: label_names, marker (ArUco dictionary, id, side in metres), made_by."""
        topic = self._checked_topic(names.SCENE, "facts about the scene")
        return json.loads(self._bag.message(topic, 0).data)

    def pose(self, name: str, k: int) -> NDArray[np.float64]:
        """Pose of an object at frame k, in the world (ROS axes: x forward, y left, z up).

        Parameters
        ----------
        name : "camera" (its optical frame), "person", "ball", "toycar" or "marker"
        k : number of the frame

        Returns
        -------
        (7,) float64: x, y, z in metres, and the quaternion qx, qy, qz, qw
        """
        prefix = names.POSE_PREFIX
        objects = [topic.removeprefix(prefix) for topic in self.topics if prefix in topic]
        if name not in objects:
            raise NotRecordedError(
                f"{self.name} holds no pose of {name!r}; it holds {', '.join(objects) or 'none'}"
            )
        topic = prefix + name
        pose = self._bag.message(topic, self._number_at_frame(topic, k)).pose
        p, q = pose.position, pose.orientation
        return np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w])

    @property
    def stamps(self) -> NDArray[np.int64]:
        """Time of each frame: (n,) int64, ns since 1970, from the headers.

        If the stamp in a header is zero, the time of recording replaces it.
        """
        return np.array(self._bag.index(self.camera_topic).stamps, np.int64)

    @property
    def rate(self) -> float:
        """Frames per second, the mean, without jumps of the clock; 0.0 for a single frame."""
        intervals = np.diff(np.sort(self.stamps))
        intervals = intervals[intervals < CLOCK_JUMP]
        duration = int(intervals.sum())
        return len(intervals) * 1e9 / duration if duration > 0 else 0.0

    def _find_camera(self, requested):
        images = [topic for topic, kind in self.topics.items() if kind in (IMAGE, COMPRESSED)]
        reasons = {topic: self._bag.unreadable(topic) for topic in images}
        counts = {topic: self._bag.count(topic) for topic, reason in reasons.items() if not reason}
        if requested is not None and requested not in counts:
            raise NotRecordedError(
                f"{self.name} holds no images on {requested}, but on: {', '.join(counts) or 'no topic'}"
            )
        if not counts:
            topics = [f"{topic} ({reason})" for topic, reason in (reasons or self.topics).items()]
            listed = ", ".join(topics) or "nothing"
            raise RecordingError(
                f"{self.name} holds no camera topic, only {listed}; record one: ros2 bag record TOPIC"
            )
        candidates = [topic for topic in counts if counts[topic]]
        camera = requested or min(candidates, key=self._likeness, default=None)
        if camera is None or not counts[camera]:
            raise RecordingError(
                f"{self.name} holds no message on {requested or ', '.join(counts)}; a reliable recorder "
                "receives nothing from a best-effort camera: record again with --qos-profile-overrides-path"
            )
        return camera

    def _likeness(self, topic):
        """A key that sorts topics by their first images and their names, the likeliest camera first."""
        try:
            image = _image_type(first_readable(partial(self._bag.message, topic), self._bag.count(topic)))
        except (RecordingError, ConversionError):
            image = UNKNOWN
        return image >= UNKNOWN, bool(OTHER_IMAGES.search(topic)), image, topic

    def _checked_topic(self, topic, description):
        if topic not in self.topics:
            raise NotRecordedError(
                f"{self.name} holds no {description} ({topic}); open_recording('drive') does"
            )
        return topic

    def _number(self, k):
        count = len(self)
        try:
            number = k.__index__()
        except AttributeError:
            raise FrameIndexError(f"the number of a frame must be an int, got {k!r}") from None
        if not -count <= number < count:
            raise FrameIndexError(
                f"{self.name} has frames 0 to {count - 1}, got {number}; choose one of these"
            )
        return number % count

    def _number_at_frame(self, topic, k):
        """The number of the message of a topic whose stamp is nearest to frame k's, within half a period.

        In a recording of one's own each topic may begin at another time or be stamped later, and a message
        may be lost.
        """
        number = self._number(k)
        stamp = self._bag.index(self.camera_topic, number).stamps[number]
        if self._bag.count(topic) == len(self) and self._bag.index(topic, number).stamps[number] == stamp:
            return number
        periods = np.diff(np.sort(self.stamps))
        limit = np.median(periods) / 2 if periods.size else 50e6
        distances = np.abs(np.array(self._bag.index(topic).stamps, np.int64) - stamp)
        if distances.size and distances.min() <= limit:
            return int(distances.argmin())
        nearest = f"{distances.min() / 1e6:.0f} ms from it" if distances.size else "missing"
        raise NotRecordedError(
            f"{self.name} holds no message on {topic} at frame {number}: "
            f"the nearest is {nearest}, and half a period is {limit / 1e6:.0f} ms"
        )

    def _decode(self, topic, k, encoding):
        decode = compressed_to_array if self.topics[topic] == COMPRESSED else image_to_array
        return decode(self._bag.message(topic, k), encoding)


def first_readable(read, count):
    """`read(k)` for the first number that can be read; if the first 100 cannot, the error of the first."""
    for k in range(min(count, MOST_UNREADABLE)):
        with suppress(ConversionError, RecordingError):
            return read(k)
    return read(0)


def _image_type(msg):
    """Color, gray or depth, by the encoding of an Image or the pixels of a CompressedImage."""
    if msg.__msgtype__ == COMPRESSED:
        pixels = compressed_to_array(msg)
        color, dtype, channels = None, pixels.dtype, 1 if pixels.ndim == 2 else pixels.shape[2]
    else:
        _, dtype, channels, color = encoding_info(msg.encoding)
    if color == "gray" or (color is None and channels == 1 and dtype == np.uint8):
        return GRAY
    return COLOR if color or (channels >= 3 and dtype.kind == "u") else DEPTH


def to_installed(msg):
    """A copy of a message of rosbags in ROS's class, which publishers accept.

    The message itself where ROS is missing, or has another version of its type.
    """
    cls = installed_class(msg.__msgtype__)
    if cls is None or not all(hasattr(msg, name) for name in cls.get_fields_and_field_types()):
        return msg
    ros_msg = cls()
    for name in cls.get_fields_and_field_types():
        _set_field(ros_msg, name, getattr(msg, name))
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
