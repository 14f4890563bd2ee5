"""Records topics into a file, as `ros2 bag record` does: in a notebook, or in a terminal until Ctrl-C."""

import difflib
import math
import threading
import time
from pathlib import Path
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from imgproc_course.messages.message_classes import installed_class, message_types
from imgproc_course.recording import RecordingError, RecordingWriter
from imgproc_course.recording.topics import POSE_PREFIX, POSES
from imgproc_course.recording.writer import offered_qos
from imgproc_course.ros.entities import Entities, Stoppable
from imgproc_course.ros.robot_process import running_robot
from imgproc_course.ros.robot_topics import COMMANDS, ODOMETRY, SCAN, TOPIC, camera_topics
from imgproc_course.ros.session import RosSession, log
from imgproc_course.ros.stop_signals import stop_signals
from imgproc_course.ros.stream_statistics import LossCounter

# What a drive is made of. Of these, what nobody publishes is left out.
ROBOT_TOPICS = (
    camera_topics(TOPIC)[0],
    camera_topics(TOPIC)[1][0],
    f"{TOPIC.rpartition('/')[0]}/depth",
    ODOMETRY,
    SCAN,
    COMMANDS,
    *(POSE_PREFIX + name for name in ("robot", *POSES)),
)
TF = "tf2_msgs/msg/TFMessage"  # which the ROS from pip lacks; rosbags knows it
QUEUE = 30  # messages that may wait while the disk is busy: a second of images
DISCOVERY_TIMEOUT = 10.0
SETTLING = 0.5  # seconds without another topic of the robot, until its topics are known
MATCHING = 3.0  # seconds that the robot process may take to find our subscriptions
STATUS_SECONDS = 2.0


class Recorder(Stoppable):
    """Records topics into a new recording in MCAP, until it is stopped.

    It stops with `stop`, at the end of its `with`, with the RosSession, or at the end of the program.

    Parameters
    ----------
    topics : a name, or a list of names; None for those of the robot (camera, depth, odometry, scan, commands,
        true poses), as far as they are published. With the odometry of the room come /tf and /tf_static, by
        which viewers draw camera, scan and robot in place
    path : the new folder, which must not exist

    Attributes
    ----------
    path : the folder
    topics : {topic: message type} of what is recorded
    counts : {topic: messages so far}
    last_error : why it stopped by itself, in one line; None
    running : whether it records

    Raises
    ------
    RecordingError : the folder exists or cannot be made
    ValueError : a topic that nobody publishes, or whose type cannot be recorded; then no folder is made

    Examples
    --------
    >>> with open_camera("room"), Robot() as robot, record(path="my_drive"):
    ...     robot.drive(0.2, 0.3, seconds=5)
    >>> frame = open_recording("my_drive").frame(0)
    """

    def __init__(self, topics: str | list[str] | None, path: str | Path):
        self._session = RosSession.current()
        self._lock = threading.Lock()
        self._writer = RecordingWriter(path)
        self.path = self._writer.path
        try:
            self.topics = self._types_of([topics] if isinstance(topics, str) else topics)
        except ValueError:
            self._writer.close()  # without messages it leaves no folder
            raise
        self.counts = dict.fromkeys(self.topics, 0)
        self._losses = {topic: LossCounter() for topic in self.topics}
        self.last_error: str | None = None
        self.running = True
        counts = self._robots_subscribers()
        self._mounts = self._sensor_mounts()
        self._offers: dict[str, list[Any]] = {}  # topic: QoS of its publishers
        self._entities = Entities(self, self.stop)  # this also keeps a Recorder that is bound to no name
        for topic in self.topics:
            self._subscribe(topic)
        self._wait_for_robot(counts)

    @property
    def bytes(self) -> int:
        """Size of all messages so far."""
        return self._writer.bytes

    @property
    def lost(self) -> int:
        """Messages that were lost on the way, as far as it is known."""
        return sum(losses.total for losses in self._losses.values())

    def stop(self) -> None:
        """Completes the recording. A second call does nothing."""
        with self._lock:
            if not self.running:
                return
            self.running = False
            try:
                self._writer.close()
            except RecordingError as error:
                if not self.last_error:
                    log.warning("%s", error)
                self.last_error = str(error)
        self._entities.close()

    def __repr__(self):
        state = "" if self.running else ", stopped"
        return f"<Recorder {self.path}: {sum(self.counts.values())} messages{state}>"

    def _types_of(self, requested):
        """{topic: type} of the requested topics; of those of the robot that are published, if None is."""
        names = [self._session.resolve_topic(topic) for topic in requested or ROBOT_TOPICS]
        end = time.monotonic() + DISCOVERY_TIMEOUT
        known_topics: set[str] = set()
        settled = 0.0
        while True:
            published = dict(self._session.node.get_topic_names_and_types())
            missing = [topic for topic in names if topic not in published]
            if published.keys() & {*names} != known_topics:
                known_topics, settled = published.keys() & {*names}, time.monotonic() + SETTLING
            # A robot's topics appear one after another; commands alone are those of a client.
            is_settled = not requested and known_topics - {COMMANDS} and time.monotonic() > settled
            if not missing or (is_settled and self._robots_subscribers().keys().isdisjoint(missing)):
                break
            if time.monotonic() > end:
                raise ValueError(f"nobody publishes {missing[0]}; {_hint(missing[0], published)}")
            time.sleep(0.05)
        types = {}
        for topic in (topic for topic in names if topic in published):
            (kind, *other_kinds) = published[topic]
            if other_kinds or installed_class(kind) is None:
                problem = "has several types" if other_kinds else f"is a {kind}, which is not installed here"
                raise ValueError(f"{topic} cannot be recorded: it {problem}; record other topics")
            types[topic] = kind
        return types

    def _robots_subscribers(self):
        """{topic: subscribers} of the robot process; empty if there is none, or before it publishes."""
        return running_robot(self._session.context.get_domain_id()).get("subscribers", {})

    def _sensor_mounts(self):
        """{frame: its pose on the robot} of the room's robot; empty for another one."""
        if "seed" not in running_robot(self._session.context.get_domain_id()):
            return {}
        from imgproc_course.ros.room_messages import MOUNTS  # here: a room takes a while to import

        return {frame: pose.vector.tolist() for frame, pose in MOUNTS.items()}

    def _wait_for_robot(self, counts):
        """Waits until the robot process, which had `counts` subscribers, sends to our subscriptions."""
        end = time.monotonic() + MATCHING
        while time.monotonic() < end:
            now = self._robots_subscribers()
            if all(now.get(topic, math.inf) > counts.get(topic, -1) for topic in self.topics):
                break
            time.sleep(0.02)

    def _subscribe(self, topic):
        offers = [info.qos_profile for info in self._session.node.get_publishers_info_by_topic(topic)]
        is_reliable = offers and all(offer.reliability == ReliabilityPolicy.RELIABLE for offer in offers)
        is_kept = offers and all(offer.durability == DurabilityPolicy.TRANSIENT_LOCAL for offer in offers)
        qos = QoSProfile(
            depth=QUEUE,
            reliability=ReliabilityPolicy.RELIABLE if is_reliable else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if is_kept else DurabilityPolicy.VOLATILE,
        )
        self._offers[topic] = [offered_qos(offer.reliability.name, offer.durability.name) for offer in offers]
        events = SubscriptionEventCallbacks(matched=self._losses[topic].on_matched)
        message_type = installed_class(self.topics[topic])
        options = {"event_callbacks": events, "raw": True}
        self._entities.subscribe(message_type, topic, qos, self._on_message, topic, **options)

    def _on_message(self, topic, serialized, info):
        with self._lock:
            if not self.running:
                return
            try:
                now, kind = time.time_ns(), self.topics[topic]
                if topic == ODOMETRY and self._mounts:
                    self._write_frames(message_types().deserialize_cdr(serialized, kind), now)
                self._writer.write(topic, kind, serialized, now, self._offers[topic])
            except RecordingError as error:
                self.last_error = str(error)
            else:
                self.counts[topic] += 1
                self._losses[topic].receive(info.get("publication_sequence_number"))
        if self.last_error:
            log.warning("the recording stopped: %s", self.last_error)
            self.stop()

    def _write_frames(self, odometry, now):
        header, base = odometry.header, odometry.child_frame_id
        place, turn = odometry.pose.pose.position, odometry.pose.pose.orientation
        if not self.counts[ODOMETRY]:
            kept = offered_qos("RELIABLE", "TRANSIENT_LOCAL")
            self._writer.write("/tf_static", TF, _transforms(header.stamp, base, self._mounts), now, [kept])
        pose = place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w
        frames = _transforms(header.stamp, header.frame_id, {base: pose})
        self._writer.write("/tf", TF, frames, now, [offered_qos("RELIABLE")])


def _transforms(stamp, parent, poses):
    """A serialized TFMessage; {frame: (x, y, z, qx, qy, qz, qw) in its parent}."""
    types = message_types().types
    header = types["std_msgs/msg/Header"](stamp, parent)
    vector, quaternion = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    transform, stamped = types["geometry_msgs/msg/Transform"], types["geometry_msgs/msg/TransformStamped"]
    frames = [
        stamped(header, frame, transform(vector(*pose[:3]), quaternion(*pose[3:])))
        for frame, pose in poses.items()
    ]
    return bytes(message_types().serialize_cdr(types[TF](frames), TF))


def record_until_signal(topics, path, *, status_seconds=STATUS_SECONDS, say=print):
    """Records until a signal or an error, and reports. Exit code 1: after an error, or without messages."""
    with stop_signals() as stopping, RosSession():
        with Recorder(topics, path) as recorder:
            say(f"recording {len(recorder.topics)} topics into {recorder.path} (Ctrl-C stops)")
            start = time.monotonic()
            while not stopping.wait(status_seconds) and recorder.running:
                say(f"{time.monotonic() - start:.0f} s: {_progress(recorder)}")
        return _report(recorder, say)


def _report(recorder, say):
    for topic, count in recorder.counts.items():
        say(f"{count:7d} {topic}")
    if recorder.last_error:
        say(f"stopped by an error: {recorder.last_error}")
    elif not sum(recorder.counts.values()):
        say("nothing was recorded: no message arrived")
    else:
        say(f"recorded {_progress(recorder)}; open_recording({str(recorder.path)!r}) reads it")
        return 0
    return 1


def _progress(recorder):
    return f"{sum(recorder.counts.values())} messages, {recorder.bytes / 1e6:.1f} MB, {recorder.lost} lost"


def _hint(topic, published):
    close_matches = difflib.get_close_matches(topic, published, 1)
    return f"did you mean {close_matches[0]}?" if close_matches else 'open_camera("room") starts a robot'
