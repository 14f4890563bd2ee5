"""A camera for a notebook: publishes the recorded drive, or a webcam, as the robot publishes its camera."""

import atexit
import difflib
import numbers
import threading
import time

from builtin_interfaces.msg import Time
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import Header

from imgproc_course.recording import open_recording
from imgproc_course.ros.pictures import RecordedPictures, Webcam
from imgproc_course.ros.session import RosSession, log

TOPIC = "/kachaka/front_camera/image_raw"
NAME_UNKNOWN = "_NODE_NAME_UNKNOWN_"  # what rclpy calls a node whose name has not arrived yet
SOURCES = ("recording", "webcam", "topic")
LOOK_AROUND = 1.0  # seconds between two looks for others who publish the same topic


def open_camera(
    source="recording",
    *,
    topic=TOPIC,
    speed=1.0,
    loop=True,
    recording="drive",
    camera_topic=None,
    stamps="now",
):
    """Publishes pictures on a topic, with the topics, headers and QoS of the robot's own camera.

    Parameters
    ----------
    source : "recording", "webcam" (the first camera of this machine), or "topic" (a robot publishes already:
        nothing is published here)
    topic : name of the raw picture's topic
    speed : times the recording's own rate: 3.0 plays a drive of 10 Hz at 30 Hz
    loop : whether the recording starts again at its end
    recording : "drive", or the path of a recording of yours
    camera_topic : which of the recording's topics is played; None as in `open_recording`
    stamps : "now", or "recorded" for the stamps of the recording (which jump back where it starts again)

    Returns
    -------
    Camera

    Raises
    ------
    ValueError : no such source, speed, stamps or topic name
    RecordingError : the recording does not open, or holds no pictures on that topic
    RuntimeError : no webcam answers

    Opening a camera on the topic of another one of this process replaces that one.
    """
    _check(source, speed, stamps)
    if source == "topic":
        return Camera(topic)
    if source == "webcam":
        pictures = Webcam()
    else:
        pictures = RecordedPictures(open_recording(recording, camera_topic=camera_topic), speed, loop, stamps)
    return Camera(topic, pictures)


def _check(source, speed, stamps):
    if source not in SOURCES:
        meant = difflib.get_close_matches(str(source), SOURCES, 1)
        raise ValueError(
            f"source {source!r} is none of 'recording', 'webcam', 'topic'"
            + (f"; did you mean {meant[0]!r}?" if meant else "")
        )
    if not (isinstance(speed, numbers.Real) and 0 < speed < float("inf")):
        raise ValueError(f"speed {speed!r} is no positive number; 1.0 is the recording's own speed")
    if source != "recording" and speed != 1.0:
        raise ValueError(
            f"speed {speed!r} with source {source!r}: only a recording has another speed than 1.0"
        )
    if stamps not in ("now", "recorded"):
        raise ValueError(f"stamps {stamps!r} is neither 'now' nor 'recorded'")


class Camera:
    """A camera that publishes until it is stopped: see `open_camera`.

    Attributes
    ----------
    topic, compressed_topic : sensor_msgs/Image (rgb8) and sensor_msgs/CompressedImage of the same pictures
    info_topics : the camera info beside the raw picture, and beside the compressed one
    rate : pictures a second, as intended; None where a robot or a webcam decides
    shown : pictures whose time has come; published : of these, the raw ones sent (none without a subscriber)
    last_error : why it stopped publishing by itself, in one line; None
    """

    _open = {}  # noqa: RUF012  topic -> the camera of this process that publishes it

    def __init__(self, topic=TOPIC, pictures=None):
        self._pictures = pictures
        self._stopping = threading.Event()
        self._thread = None
        self._warned = False
        self.rate = getattr(pictures, "rate", None)
        self.shown = self.published = 0
        self.last_error = None
        self.topic = topic
        if pictures is not None:
            self._session = RosSession.current()
            self.topic = self._session.resolve_topic(topic)
        self.compressed_topic = f"{self.topic}/compressed"
        self.info_topics = (f"{self.topic.rpartition('/')[0]}/camera_info", f"{self.topic}/camera_info")
        if pictures is not None:
            self._replace_former()
            self._advertise()
            self._session.at_stop(self, self.stop)
            atexit.register(self.stop)  # last come, first gone: before what it reads from is closed
            self._thread = threading.Thread(target=self._play, name=f"camera on {self.topic}", daemon=True)
            self._thread.start()

    def _replace_former(self):
        former = self._open.get(self.topic)
        if former is not None:
            former.stop()
            log.warning("replaced the camera that published %s", self.topic)
        self._open[self.topic] = self

    def _advertise(self):
        node = self._session.node
        self._node = node
        events = PublisherEventCallbacks(use_default_callbacks=False)  # a subscriber says what does not match

        def publisher(kind, topic):
            return node.create_publisher(kind, topic, qos_profile_sensor_data, event_callbacks=events)

        self._raw = publisher(Image, self.topic)
        self._compressed = publisher(CompressedImage, self.compressed_topic)
        self._infos = [publisher(CameraInfo, topic) for topic in self.info_topics]

    @property
    def running(self):
        """Whether pictures still come: False after `stop`, and after the end of a recording without loop."""
        return self._thread is not None and self._thread.is_alive()

    def stop(self):
        """Stops publishing, and takes the topics back. A second stop does nothing."""
        self._stopping.set()
        if self._thread is None:
            return
        if self._thread is not threading.current_thread():
            self._thread.join()
        if self._open.get(self.topic) is self:
            del self._open[self.topic]
        self._session.at_stop(self, None)
        atexit.unregister(self.stop)
        node, publishers = self._node, [self._raw, self._compressed, *self._infos]
        self._session.post(lambda: [node.destroy_publisher(publisher) for publisher in publishers])

    def wait(self, timeout=None):
        """Waits for the end of a recording without loop. True when it has come."""
        if self._thread is not None:
            self._thread.join(timeout)
        return not self.running

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.stop()

    def __repr__(self):
        rate = "" if self.rate is None else f" at {self.rate:g} Hz"
        state = "" if self._pictures is None else "" if self.running else ", stopped"
        return f"<Camera {self.topic}{rate}{state}>"

    def subscribers(self):
        """How many subscribers the raw and the compressed topic have: {topic: count}."""
        if not self.running:
            return {}
        pairs = ((self.topic, self._raw), (self.compressed_topic, self._compressed))
        return {topic: publisher.get_subscription_count() for topic, publisher in pairs}

    def _play(self):
        next_look = time.monotonic() + LOOK_AROUND
        try:
            for due, picture in self._pictures:
                if self._raw.get_subscription_count():
                    picture.image  # noqa: B018  decoded ahead, so that it leaves on time
                if self._stopping.wait(max(0.0, due - time.monotonic())):
                    return
                self._publish(picture)
                self.shown += 1
                if time.monotonic() > next_look:
                    next_look += LOOK_AROUND
                    self._look_around()
        except (ValueError, OSError, RuntimeError) as error:
            # A context that is shut down between two looks (Ctrl-C) is an end, and no failure.
            if not self._stopping.is_set() and self._node.context.ok():
                self.last_error = str(error)
                log.warning("the camera on %s stopped: %s", self.topic, error)
        finally:
            self._pictures.close()

    def _publish(self, picture):
        if self._raw.get_subscription_count():
            picture.image  # noqa: B018  before the stamp is taken, when a subscriber has come meanwhile
        stamp = picture.stamp if picture.stamp is not None else self._node.get_clock().now().nanoseconds
        seconds, nanoseconds = divmod(stamp, 1_000_000_000)
        header = Header(stamp=Time(sec=seconds, nanosec=nanoseconds), frame_id=picture.frame_id)
        # Decoding and copying a picture costs milliseconds: only for those who listen, as the robot does.
        if self._raw.get_subscription_count():
            picture.image.header = header
            self._raw.publish(picture.image)
            self.published += 1
        if self._compressed.get_subscription_count():
            self._compressed.publish(picture.compressed(header))
        for info in self._infos:
            if info.get_subscription_count():
                info.publish(picture.camera_info(header))

    def _look_around(self):
        if self._warned:
            return
        found = self._node.get_publishers_info_by_topic(self.topic)
        others = sorted({info.node_name for info in found} - {self._node.get_name(), NAME_UNKNOWN})
        if others:
            self._warned = True
            log.warning(
                "%s is published by %s too, in another process: subscribers get the pictures of both; "
                "stop one, or give each its own ROS_DOMAIN_ID (0 to 101)",
                self.topic,
                ", ".join(others),
            )
