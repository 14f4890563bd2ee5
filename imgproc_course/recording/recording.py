"""A recorded drive: frames, messages, camera info, depth, labels, poses."""

import json
from pathlib import Path

import numpy as np

from ..messages import ConversionError, compressed_to_array, encoding_info, image_to_array
from . import topics as names
from .bag import Bag, with_stamp
from .errors import FrameIndexError, NotRecordedError, RecordingError
from .message_classes import to_installed

DRIVE = Path(__file__).parent / "drive"
IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
STRING = "std_msgs/msg/String"


def open_recording(source="drive", *, camera_topic=None):
    """Opens a recording; little but its table of contents is read.

    Parameters
    ----------
    source : "drive" for the course's own recording, or the path of a rosbag2 recording of yours:
        its folder, its .mcap or its .db3
    camera_topic : the topic whose pictures are the frames; without it the first topic of colour or gray
        pictures

    Returns
    -------
    Recording

    Raises
    ------
    RecordingError : missing, empty, cut short, no recording, no pictures; one line that says what to do

    Examples
    --------
    >>> with open_recording("drive") as drive:
    ...     frame = drive.frame(0)
    >>> frame.shape
    (720, 1280, 3)
    """
    return Recording(source, camera_topic=camera_topic)


class Recording:
    """An open recording: see `open_recording`.

    Iterating yields (topic, message) lazily, in the order of recording; `len()` is the number of pictures.
    Messages are of the classes that ROS's publishers take (sensor_msgs.msg.CompressedImage and so on) where
    ROS is installed, and else of rosbags' classes, which have the same fields. To publish a message cheaply,
    hand `raw(k)` to the publisher: rclpy takes serialized messages as they are.
    A number k counts from 0, a negative one from the end. Any thread may call any method.
    """

    def __init__(self, source="drive", *, camera_topic=None):
        own = source == "drive"
        try:
            self._bag = Bag(DRIVE if own else source)
        except RecordingError as error:
            if not own:
                raise
            raise RecordingError(
                "the course's own recording is missing or damaged; bring it back: "
                f"git checkout -- imgproc_course/recording/drive ({error})"
            ) from error
        self.name = "drive" if own else self._bag.path.name
        try:
            self._camera = self._find_camera(camera_topic)
        except RecordingError:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def close(self):
        """Closes the files. A second close does nothing."""
        self._bag.close()

    def __len__(self):
        return self._bag.count(self._camera)

    def __iter__(self):
        for topic, raw, kind in self._bag.read():
            yield topic, to_installed(self._bag.deserialize(raw, kind))

    def __repr__(self):
        return f"<Recording {self.name!r}: {len(self)} pictures on {self._camera}, {len(self.topics)} topics>"

    @property
    def topics(self):
        """Every topic of the recording and its message type: {"/topic": "package/msg/Type"}."""
        return {topic: kind for topic, (kind, _) in self._bag.topics.items()}

    @property
    def camera_topic(self):
        """The topic whose pictures are the frames."""
        return self._camera

    def frame(self, k, encoding="bgr8"):
        """Picture k, decoded.

        Parameters
        ----------
        k : which picture, 0 to len() - 1
        encoding : what the frame shall be: "bgr8", "rgb8", "mono8", or "passthrough" for as recorded

        Returns
        -------
        (720, 1280, 3) uint8 for "bgr8" and the course's own recording

        Raises
        ------
        FrameIndexError : there is no picture k
        ConversionError : the message is malformed, or not of a kind that becomes `encoding`
        """
        return self._decode(self._camera, self._number(k), encoding)

    def message(self, k):
        """Picture k as it was recorded: a CompressedImage, or an Image in a recording of raw pictures."""
        return self._message(self._camera, self._number(k))

    def raw(self, k, topic=None, *, stamp=None):
        """Message k of a topic, serialized (CDR): rclpy's `publisher.publish` takes such bytes as they are.

        Parameters
        ----------
        k : which message of the topic
        topic : without it, the camera's
        stamp : int, ns: replaces the header's stamp; only for messages that begin with a header

        Returns
        -------
        bytes
        """
        topic = topic or self._camera
        raw = self._bag.raw(topic, self._number(k, topic))
        return raw if stamp is None else with_stamp(raw, stamp)

    @property
    def camera_info(self):
        """The camera's first CameraInfo: matrix k, distortion d (plumb_bob), r, p."""
        base = self._camera.removesuffix("/compressed").rsplit("/", 1)[0]
        wanted = (f"{base}/camera_info", f"{self._camera.removesuffix('/compressed')}/camera_info")
        found = [topic for topic, kind in self.topics.items() if kind == CAMERA_INFO]
        for topic in [*wanted, *(found if len(found) == 1 else [])]:
            if topic in found and self._bag.count(topic):
                return self._message(topic, 0)
        raise NotRecordedError(
            f"{self.name} holds no camera info of {self._camera}; record {wanted[0]} with it"
        )

    def depth(self, k):
        """Depth along the optical axis at picture k.

        Returns
        -------
        (360, 640) uint16, millimetres, 0 where nothing was measured; pixel (row, col) belongs to pixel
        (2 row, 2 col) of the frame

        Raises
        ------
        NotRecordedError : the recording holds no depth
        """
        return self._decode(self._beside(names.DEPTH, "depth"), self._number(k), "passthrough")

    def labels(self, k):
        """What each pixel of picture k shows: (720, 1280) uint8, numbers of `label_names`."""
        return self._decode(self._beside(names.LABELS, "labels"), self._number(k), "mono8")

    @property
    def label_names(self):
        """The meaning of each number in `labels`: {0: "background", 1: "floor", ...}."""
        return {int(number): name for number, name in self.scene["label_names"].items()}

    @property
    def scene(self):
        """Facts about the scene: label_names, marker (ArUco dictionary, id, side in metres), made_by."""
        topic = self._beside(names.SCENE, "facts about the scene")
        return json.loads(self._bag.deserialize(self._bag.raw(topic, 0), STRING).data)

    def pose(self, name, k):
        """Where something was at picture k, in the world (ROS axes: x forward, y left, z up).

        Parameters
        ----------
        name : "camera" (its optical frame), "person", "ball", "toycar" or "marker"
        k : which picture

        Returns
        -------
        (7,) float64: x, y, z in metres, and the quaternion qx, qy, qz, qw
        """
        known = [topic.removeprefix(names.POSE_PREFIX) for topic in self.topics if names.POSE_PREFIX in topic]
        if name not in known:
            raise NotRecordedError(
                f"{self.name} holds no pose {name!r}; it holds {', '.join(known) or 'none'}"
            )
        topic = names.POSE_PREFIX + name
        pose = self._bag.deserialize(self._bag.raw(topic, self._number(k)), self.topics[topic]).pose
        p, q = pose.position, pose.orientation
        return np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w])

    @property
    def stamps(self):
        """When each picture was taken: (n,) int64, ns since 1970, from the headers.

        Where a header's stamp is zero, the time of recording stands in.
        """
        return np.array(self._bag.index(self._camera).stamps, np.int64)

    @property
    def rate(self):
        """Pictures a second, the mean over the recording; 0.0 for a single picture."""
        stamps = self.stamps
        lasted = int(stamps[-1] - stamps[0])
        return (len(stamps) - 1) * 1e9 / lasted if lasted > 0 else 0.0

    def _find_camera(self, wanted):
        pictures = {t: self._bag.count(t) for t, kind in self.topics.items() if kind in (IMAGE, COMPRESSED)}
        if wanted is not None and wanted not in pictures:
            raise NotRecordedError(
                f"{self.name} holds no pictures on {wanted}, but on: {', '.join(pictures) or 'no topic'}"
            )
        if not pictures:
            held = ", ".join(self.topics) or "nothing"
            raise RecordingError(
                f"{self.name} holds no camera topic, only {held}; record one: ros2 bag record TOPIC"
            )
        # Depth and labels are pictures too, and may have been recorded first.
        colour = [t for t in pictures if not t.endswith("/compressedDepth") and not t.startswith("/truth/")]
        held = [t for t in dict.fromkeys([*colour, *pictures]) if pictures[t]]
        seen = filter(self._is_to_look_at, held) if len(held) > 1 else ()
        chosen = wanted or next(iter(seen), held[0] if held else None)
        if chosen is None or not pictures[chosen]:
            raise RecordingError(
                f"{self.name} holds no message on {wanted or ', '.join(pictures)}; a reliable recorder hears "
                "nothing of a best-effort camera: record again with --qos-profile-overrides-path"
            )
        return chosen

    def _is_to_look_at(self, topic):
        """Whether a topic's first picture is one in colour or gray, and no depth in 16UC1 or 32FC1."""
        if self.topics[topic] == COMPRESSED:
            return True
        try:
            msg = self._bag.deserialize(self._bag.raw(topic, 0), IMAGE)
            return encoding_info(msg.encoding).color is not None
        except (RecordingError, ConversionError):
            return False

    def _beside(self, topic, what):
        if topic not in self.topics:
            raise NotRecordedError(f"{self.name} holds no {what} ({topic}); open_recording('drive') does")
        return topic

    def _number(self, k, topic=None):
        count = self._bag.count(topic) if topic in self._bag.topics else len(self)
        try:
            number = k.__index__()
        except AttributeError:
            raise FrameIndexError(f"a picture has a whole number, {k!r} was given") from None
        if not -count <= number < count:
            raise FrameIndexError(f"{self.name} has pictures 0 to {count - 1}, {number} was asked for")
        return number % count

    def _message(self, topic, k):
        return to_installed(self._bag.deserialize(self._bag.raw(topic, k), self.topics[topic]))

    def _decode(self, topic, k, encoding):
        kind = self.topics[topic]
        msg = self._bag.deserialize(self._bag.raw(topic, k), kind)
        return (compressed_to_array if kind == COMPRESSED else image_to_array)(msg, encoding)
