"""Publishes a recording or a webcam, as the robot's camera publishes its images."""

import threading
import time

from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import Header

from imgproc_course.messages import ConversionError
from imgproc_course.recording.recording import MOST_UNREADABLE, RecordingError
from imgproc_course.ros.entities import Entities
from imgproc_course.ros.robot_topics import TOPIC, camera_topics
from imgproc_course.ros.session import RCLError, log

UNKNOWN_NODE_NAME = "_NODE_NAME_UNKNOWN_"  # rclpy's name for a node whose name has not arrived yet
CHECK_PERIOD = 1.0  # seconds between two checks for other publishers of the topic
CHECKS = 25  # that find others before the warning: ROS lists those of a killed process for 20 seconds more


class CameraPublisher:
    """Publishes RecordedImages or a Webcam on the topics of a camera, until it is stopped or they end."""

    def __init__(self, topic, images, description=""):
        self.topic, self.description = topic, description
        self._images = images
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._play, name=f"camera on {topic}", daemon=True)
        self._checks_with_others = 0
        self.running = False
        self.played = self.published = 0
        self.last_error: str | None = None

    def start(self, on_end=lambda: None):
        """Creates the publishers and begins to publish; calls `on_end` if the images end."""
        self._on_end = on_end
        self._entities = Entities(self, self.stop)
        try:
            self._create_publishers()
        except RCLError as error:
            self._destroy_publishers()
            self._images.close()
            raise ValueError(
                f"cannot publish images on {self.topic}: the camera uses this name, or one beside it, for "
                f"another type of message; choose another topic, such as {TOPIC}"
            ) from error
        self.running = True
        self._thread.start()

    def _create_publishers(self):
        self._node = self._entities.node
        self._raw = self._create_publisher(Image, self.topic)
        compressed_topic, info_topics = camera_topics(self.topic)
        topics = [(CompressedImage, compressed_topic, lambda image, header: image.compressed(header))]
        for topic in info_topics:
            topics.append((CameraInfo, topic, lambda image, header: image.camera_info(header)))
        topics += self._images.other_topics(self.topic.rpartition("/")[0])
        self._others = [(self._create_publisher(kind, topic), make) for kind, topic, make in topics]

    def _create_publisher(self, message_type, topic):
        # Without rclpy's default callbacks: on a mismatch of QoS it is the subscriber that gives the reason.
        events = PublisherEventCallbacks(use_default_callbacks=False)
        qos = qos_profile_sensor_data
        publisher = self._node.create_publisher(message_type, topic, qos, event_callbacks=events)
        return self._entities.add(publisher)

    def stop(self):
        """Stops publishing and removes the publishers. A second call does nothing."""
        if self._stopping.is_set():
            return
        self._stopping.set()
        if self._thread is not threading.current_thread():
            self._thread.join()
        self._destroy_publishers()

    def _destroy_publishers(self):
        self._entities.close()

    def status(self):
        """What a `Camera` shows of it: a dict."""
        publishers = self._entities.all if self.running else ()
        return {
            "running": self.running,
            "topic": self.topic,
            "rate": self._images.rate,
            "played": self.played,
            "published": self.published,
            "last_error": self.last_error,
            "subscribers": {one.topic_name: one.get_subscription_count() for one in publishers},
        }

    def _play(self):
        next_check = time.monotonic() + CHECK_PERIOD
        unreadable, named = 0, set()  # images: how many in a row, and all in the log
        try:
            for due, image in self._images:
                try:
                    if self._raw.get_subscription_count():
                        image.message  # noqa: B018  decoded before it is due, so that it is sent on time
                    if self._stopping.wait(max(0.0, due - time.monotonic())):
                        return
                    self._publish(image)
                    self.played, unreadable = self.played + 1, 0
                except (ConversionError, RecordingError) as error:
                    unreadable += 1
                    if unreadable == MOST_UNREADABLE:
                        raise
                    if str(image) not in named:
                        log.warning("the camera on %s goes on after %s: %s", self.topic, image, error)
                    named.add(str(image))
                if time.monotonic() > next_check:
                    next_check += CHECK_PERIOD
                    self._look_at_the_graph()
        except (ValueError, OSError, RuntimeError) as error:
            # If the context was shut down meanwhile (Ctrl-C), this is a normal end and not a failure.
            if not self._stopping.is_set() and self._node.context.ok():
                self.last_error = str(error)
                log.warning("the camera on %s stopped: %s", self.topic, error)
        finally:
            self._images.close()
            self.running = False
            if not self._stopping.is_set():
                self._on_end()

    def _publish(self, image):
        if self._raw.get_subscription_count():
            image.message  # noqa: B018  decoded before the stamp is taken, if a subscriber is new
        now = self._node.get_clock().now()
        stamp = now if image.stamp is None else Time(nanoseconds=image.stamp)
        header = Header(stamp=stamp.to_msg(), frame_id=image.frame_id)
        # Decoding and copying an image costs milliseconds: done only for subscribers, as on the robot.
        if self._raw.get_subscription_count():
            image.message.header = header
            self._raw.publish(image.message)
            self.published += 1
        for publisher, make in self._others:
            if publisher.get_subscription_count():
                publisher.publish(make(image, header))

    def _look_at_the_graph(self):
        """Warns about other publishers of the topic, which stay."""
        publishers = self._node.get_publishers_info_by_topic(self.topic)
        other_nodes = {info.node_name for info in publishers} - {self._node.get_name(), UNKNOWN_NODE_NAME}
        self._checks_with_others = self._checks_with_others + 1 if other_nodes else 0
        if self._checks_with_others == CHECKS:
            log.warning(
                "%s is also published by %s, which is no camera of yours: subscribers receive the images of "
                'both; use open_camera("topic", switch=True), or another ROS_DOMAIN_ID (0 to 101)',
                self.topic,
                ", ".join(sorted(other_nodes)),
            )
