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
from imgproc_course.ros.image_sources import RecordedImages, Webcam
from imgproc_course.ros.session import RosSession, log

TOPIC = "/kachaka/front_camera/image_raw"
UNKNOWN_NODE_NAME = "_NODE_NAME_UNKNOWN_"  # rclpy's name for a node whose name has not arrived yet
SOURCES = ("recording", "webcam", "topic")
CHECK_PERIOD = 1.0  # seconds between two checks for other publishers of the topic


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
    """Publishes images on a topic, with the topics, headers and QoS of the robot's own camera.

    Parameters
    ----------
    source : "recording"; "webcam" (the first camera of this machine); or "topic" (a robot already publishes,
        so nothing is published here)
    topic : name of the topic of raw images
    speed : factor on the recorded rate: 3.0 plays a drive of 10 Hz at 30 Hz
    loop : whether the recording starts again at its end
    recording : "drive", or the path of your own recording
    camera_topic : which topic of the recording is played; None as in `open_recording`
    stamps : "now", or "recorded" for the stamps of the recording (they jump back when it starts again)

    Returns
    -------
    Camera

    Raises
    ------
    ValueError : an unknown source or stamps, a bad speed or topic name
    RecordingError : the recording cannot be opened, or has no images on that topic
    RuntimeError : no webcam answers

    If this process already has a camera on the same topic, the new camera replaces it.
    """
    _check_arguments(source, speed, stamps)
    if source == "topic":
        return Camera(topic)
    if source == "webcam":
        images = Webcam()
    else:
        images = RecordedImages(open_recording(recording, camera_topic=camera_topic), speed, loop, stamps)
    return Camera(topic, images)


def _check_arguments(source, speed, stamps):
    if source not in SOURCES:
        close_matches = difflib.get_close_matches(str(source), SOURCES, 1)
        raise ValueError(
            f"unknown source {source!r}; use 'recording', 'webcam' or 'topic'"
            + (f"; did you mean {close_matches[0]!r}?" if close_matches else "")
        )
    if not (isinstance(speed, numbers.Real) and 0 < speed < float("inf")):
        raise ValueError(f"speed must be a positive number, got {speed!r}; 1.0 plays at the recorded rate")
    if source != "recording" and speed != 1.0:
        raise ValueError(f"speed {speed!r} with source {source!r}: only a recording can change its speed")
    if stamps not in ("now", "recorded"):
        raise ValueError(f"stamps must be 'now' or 'recorded', got {stamps!r}")


class Camera:
    """A camera that publishes until it is stopped: see `open_camera`.

    Attributes
    ----------
    topic, compressed_topic : sensor_msgs/Image (rgb8) and sensor_msgs/CompressedImage of the same images
    info_topics : the camera info beside the raw image, and beside the compressed one
    rate : the intended images per second; None for a robot, and for a webcam that does not know its rate
    played : images that were due so far
    published : raw images that were sent; without a subscriber none is sent
    last_error : why the camera stopped by itself, in one line; None otherwise
    """

    _cameras = {}  # noqa: RUF012  topic -> the camera of this process that publishes it

    def __init__(self, topic=TOPIC, images=None):
        self._images = images
        self._stopping = threading.Event()
        self._thread = None
        self._has_warned = False
        self.rate = getattr(images, "rate", None)
        self.played = self.published = 0
        self.last_error = None
        self.topic = topic
        if images is not None:
            self._session = RosSession.current()
            self.topic = self._session.resolve_topic(topic)
        self.compressed_topic = f"{self.topic}/compressed"
        self.info_topics = (f"{self.topic.rpartition('/')[0]}/camera_info", f"{self.topic}/camera_info")
        if images is not None:
            self._replace_previous()
            self._create_publishers()
            self._session.on_shutdown(self, self.stop)
            atexit.register(self.stop)  # registered last, so it runs first: before the recording is closed
            self._thread = threading.Thread(target=self._play, name=f"camera on {self.topic}", daemon=True)
            self._thread.start()

    def _replace_previous(self):
        previous = self._cameras.get(self.topic)
        if previous is not None:
            previous.stop()
            log.warning("replaced the camera that published %s", self.topic)
        self._cameras[self.topic] = self

    def _create_publishers(self):
        self._node = node = self._session.node
        # Without rclpy's default callbacks: on a mismatch of QoS it is the subscriber that gives the reason.
        events = PublisherEventCallbacks(use_default_callbacks=False)

        def publisher(message_type, topic):
            return node.create_publisher(message_type, topic, qos_profile_sensor_data, event_callbacks=events)

        self._raw = publisher(Image, self.topic)
        self._compressed = publisher(CompressedImage, self.compressed_topic)
        self._infos = [publisher(CameraInfo, topic) for topic in self.info_topics]

    @property
    def running(self):
        """Whether the camera publishes: False after `stop`, and after the end of a recording without loop."""
        return self._thread is not None and self._thread.is_alive()

    def stop(self):
        """Stops publishing and removes the publishers. A second call does nothing."""
        self._stopping.set()
        if self._thread is None:
            return
        if self._thread is not threading.current_thread():
            self._thread.join()
        if self._cameras.get(self.topic) is self:
            del self._cameras[self.topic]
        self._session.on_shutdown(self, None)
        atexit.unregister(self.stop)
        node, publishers = self._node, [self._raw, self._compressed, *self._infos]
        self._session.post(lambda: [node.destroy_publisher(publisher) for publisher in publishers])

    def wait(self, timeout=None):
        """Waits for the end of a recording without loop. Returns True if it has ended."""
        if self._thread is not None:
            self._thread.join(timeout)
        return not self.running

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.stop()

    def __repr__(self):
        rate = "" if self.rate is None else f" at {self.rate:g} Hz"
        state = "" if self._images is None else "" if self.running else ", stopped"
        return f"<Camera {self.topic}{rate}{state}>"

    def subscribers(self):
        """How many subscribers the raw and the compressed topic have: {topic: count}."""
        if not self.running:
            return {}
        pairs = ((self.topic, self._raw), (self.compressed_topic, self._compressed))
        return {topic: publisher.get_subscription_count() for topic, publisher in pairs}

    def _play(self):
        next_check = time.monotonic() + CHECK_PERIOD
        try:
            for due, image in self._images:
                if self._raw.get_subscription_count():
                    image.message  # noqa: B018  decoded before it is due, so that it is sent on time
                if self._stopping.wait(max(0.0, due - time.monotonic())):
                    return
                self._publish(image)
                self.played += 1
                if time.monotonic() > next_check:
                    next_check += CHECK_PERIOD
                    self._warn_about_other_publishers()
        except (ValueError, OSError, RuntimeError) as error:
            # If the context was shut down meanwhile (Ctrl-C), this is a normal end and not a failure.
            if not self._stopping.is_set() and self._node.context.ok():
                self.last_error = str(error)
                log.warning("the camera on %s stopped: %s", self.topic, error)
        finally:
            self._images.close()

    def _publish(self, image):
        if self._raw.get_subscription_count():
            image.message  # noqa: B018  decoded before the stamp is taken, if a subscriber is new
        stamp = image.stamp if image.stamp is not None else self._node.get_clock().now().nanoseconds
        seconds, nanoseconds = divmod(stamp, 1_000_000_000)
        header = Header(stamp=Time(sec=seconds, nanosec=nanoseconds), frame_id=image.frame_id)
        # Decoding and copying an image costs milliseconds: done only for subscribers, as on the robot.
        if self._raw.get_subscription_count():
            image.message.header = header
            self._raw.publish(image.message)
            self.published += 1
        if self._compressed.get_subscription_count():
            self._compressed.publish(image.compressed(header))
        for info in self._infos:
            if info.get_subscription_count():
                info.publish(image.camera_info(header))

    def _warn_about_other_publishers(self):
        if self._has_warned:
            return
        publishers = self._node.get_publishers_info_by_topic(self.topic)
        other_nodes = {info.node_name for info in publishers} - {self._node.get_name(), UNKNOWN_NODE_NAME}
        if other_nodes:
            self._has_warned = True
            log.warning(
                "%s is also published by %s, in another process: subscribers receive the images of both; "
                "stop one, or give each process its own ROS_DOMAIN_ID (0 to 101)",
                self.topic,
                ", ".join(sorted(other_nodes)),
            )
