"""Frames from a camera topic, as arrays: the latest, the next, or all of them in a loop."""

import collections
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import QoSPolicyKind, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import CompressedImage, Image

from imgproc_course.learner_errors import RepeatedErrors, describe, failed_line
from imgproc_course.messages import ConversionError, compressed_to_array, encoding_info, image_to_array
from imgproc_course.messages.compressed import TRANSPORTS
from imgproc_course.ros.diagnostics import explain_missing_messages
from imgproc_course.ros.entities import Entities, Stoppable, weak_callback
from imgproc_course.ros.session import RCLError, RosSession, Throttle, log
from imgproc_course.ros.stream_statistics import LossCounter

QOS = {
    # What cameras offer (best effort, depth 5): a late frame is worth nothing, so a lost one is not sent
    # again. A reliable subscription would receive nothing from such a publisher.
    "sensor_data": qos_profile_sensor_data,
    "reliable": QoSProfile(depth=10),  # what a plain 10 in create_subscription means
}
RATE_WINDOW = 2.0  # seconds over which the rate is measured, of at most RECENT frames
RECENT = 1000

_QOS_REMEDIES = {
    QoSPolicyKind.RELIABILITY: (
        'this subscription requests RELIABLE, the publisher offers BEST_EFFORT; use qos="sensor_data"'
    ),
    QoSPolicyKind.DURABILITY: (
        "this subscription requests TRANSIENT_LOCAL (old messages too), the publisher offers VOLATILE "
        '(new ones only); use qos="sensor_data"'
    ),
}


def image_type(topic):
    """The message type of an image topic, and the function that converts a message to an array."""
    if topic.rpartition("/")[2] in TRANSPORTS:
        return CompressedImage, compressed_to_array
    return Image, image_to_array


class ImageSubscriber(Stoppable):
    """Subscribes to images and keeps the newest one, as a frame.

    Parameters
    ----------
    topic : sensor_msgs/Image, or sensor_msgs/CompressedImage if it ends in /compressed, /compressedDepth,
        /zstd or /zlib
    on_image : function(frame, msg), called for every frame in ROS's thread. It must be faster than the
        camera's period; if it is not, iterate over the subscriber instead, which skips to the newest frame
    qos : "sensor_data" (best effort, depth 5: what cameras offer), "reliable" (what a plain 10 means; it
        receives nothing from a best-effort camera), or an rclpy QoSProfile
    encoding : of the frames; "passthrough" keeps the encoding of the message and gives a read-only view of it

    Attributes
    ----------
    received : messages that arrived
    failed : messages that could not be converted, or for which `on_image` raised; they are skipped, and each
        cause is logged once
    last_error : why the last of those failed, in one line; None
    incompatible_qos : the QoS policy that does not match, with the remedy; None
    stopped : whether `stop()` was called

    Any thread may use it. It stops with `.stop()`, at the end of its `with`, with the RosSession, or when no
    reference to it is left. A subscriber with an `on_image` is kept alive until it is stopped. In a notebook,
    a new one on the same topic with a function of the same name replaces it, so that a cell that runs again
    does not call the function twice.

    Raises
    ------
    ValueError : not a topic name, an unknown qos or encoding

    Examples
    --------
    >>> with ImageSubscriber("/kachaka/front_camera/image_raw") as subscriber:
    ...     frame = subscriber.wait()
    """

    _subscribers: ClassVar[dict[Any, "ImageSubscriber"]] = {}  # those with an on_image: it keeps them alive

    def __init__(
        self,
        topic: str,
        on_image: Callable[[np.ndarray, Any], Any] | None = None,
        *,
        qos: str | QoSProfile = "sensor_data",
        encoding: str = "bgr8",
    ):
        if encoding != "passthrough":
            encoding_info(encoding)
        self.qos = _qos_profile(qos)
        self.encoding = encoding
        self._on_image: Any = on_image
        self._change = threading.Condition()
        self._arrivals: collections.deque[float] = collections.deque(maxlen=RECENT)
        self._causes: set[str] = set()
        self._errors = RepeatedErrors()
        self._may_log = Throttle()
        self._latest: Any = None
        self._converted = 0
        self._losses = LossCounter()
        self.stopped = False
        self._key: Any = None
        self.received = self.failed = 0
        self.last_error: str | None = None
        self.incompatible_qos: str | None = None
        self.session = RosSession.current()
        self.topic = self.session.resolve_topic(topic)
        self.message_type, self._convert = image_type(self.topic)
        if on_image is not None:
            self._replace_previous()
        self._entities = Entities(self, weak_callback(self.stop))
        self._subscription = self._subscribe()

    def _subscribe(self):
        # Weak references, so that an unused subscriber is deleted, and its subscription with it.
        events = SubscriptionEventCallbacks(
            incompatible_qos=weak_callback(self._on_incompatible_qos), matched=self._losses.on_matched
        )
        try:
            return self._entities.subscribe(
                self.message_type, self.topic, self.qos, self._on_message, event_callbacks=events
            )
        except RCLError as error:
            raise ValueError(
                f"cannot subscribe to {self.topic} as {self.message_type.__name__}: this process already "
                "uses the topic with another type; images come as Image, or as CompressedImage if the name "
                "ends in /compressed"
            ) from error

    def _replace_previous(self):
        function = getattr(self._on_image, "__func__", self._on_image)
        # Only functions of a notebook or script: a cell that runs again redefines no function of a module.
        in_notebook = getattr(function, "__module__", None) == "__main__"
        name = getattr(function, "__qualname__", repr(function))
        self._key = (self.topic, name) if in_notebook else id(self)
        previous = self._subscribers.get(self._key)
        self._subscribers[self._key] = self
        if previous is not None:
            previous.stop()
            log.warning("replaced the subscriber that called %s on %s", name, self.topic)

    def latest(self) -> np.ndarray | None:
        """The newest frame, or None before the first."""
        return self._latest

    def wait(self, timeout: float = 5.0) -> np.ndarray:
        """A frame that arrives after this call, within `timeout` seconds.

        Raises
        ------
        TimeoutError : no frame arrived. The text gives the reason (no publisher, an incompatible QoS policy,
            frames that cannot be converted, ...) and the remedy
        RuntimeError : the subscriber is stopped, or the caller is a ROS callback; no frame can arrive then
        """
        if self.session.is_spinning_thread():
            raise RuntimeError("no frame can arrive while a callback waits for it; use on_image or latest()")
        with self._change:
            converted_before, failed_before = self._converted, self.failed
            self._change.wait_for(self._is_newer_than(converted_before), timeout)
            if self._converted > converted_before:
                return self._latest
        node = self.session.node
        if self.stopped or node is None:
            raise RuntimeError(f"the subscriber of {self.topic} is stopped; make a new ImageSubscriber")
        failed = self.failed - failed_before
        reason = explain_missing_messages(
            node,
            self._subscription,
            timeout,
            self.received,
            failure=f"{failed} arrived and failed; {self.last_error}" if failed else None,
            qos_problem=self.incompatible_qos,
            node_error=self.session.error_of_publisher(self.topic),
        )
        raise TimeoutError(reason)

    def wait_for_incompatible_qos(self, timeout: float = 20.0) -> str | None:
        """Waits until ROS reports a publisher whose QoS policies do not match; returns `incompatible_qos`.

        Raises
        ------
        TimeoutError : ROS reported none in `timeout` seconds
        """
        with self._change:
            if not self._change.wait_for(lambda: self.incompatible_qos or self.stopped, timeout):
                raise TimeoutError(f"ROS reports no incompatible QoS policy on {self.topic} in {timeout:g} s")
            return self.incompatible_qos

    def __iter__(self) -> Iterator[np.ndarray]:
        """Yields new frames; if several came meanwhile, only the newest. Ends when the subscriber stops."""
        count = self._converted
        while True:
            with self._change:
                self._change.wait_for(self._is_newer_than(count))
                if self._converted == count:
                    return
                count = self._converted
                frame = self._latest
            yield frame

    def _is_newer_than(self, count):
        return lambda: self._converted > count or self.stopped

    @property
    def measured_rate(self) -> float:
        """Frames per second that arrived during the last two seconds."""
        oldest = time.monotonic() - RATE_WINDOW
        with self._change:
            arrivals = [moment for moment in self._arrivals if moment >= oldest]
        return (len(arrivals) - 1) / (arrivals[-1] - arrivals[0]) if len(arrivals) > 1 else 0.0

    @property
    def dropped(self) -> int | None:
        """Messages lost on the way, or overwritten while ROS's thread was busy.

        By the publisher's own numbers; None if the middleware does not number them, or while several nodes
        publish the topic.
        """
        return self._losses.lost

    @property
    def matched(self) -> int:
        """The number of publishers whose QoS and type match this subscription."""
        return 0 if self.stopped else self._subscription.get_publisher_count()

    def stop(self) -> None:
        """Ends the subscription, and every wait and loop over it. A second call does nothing."""
        with self._change:
            self.stopped = True
            self._change.notify_all()
        if self._subscribers.get(self._key) is self:
            del self._subscribers[self._key]
        self._entities.close()

    def __repr__(self):
        state = "stopped" if self.stopped else f"{self.measured_rate:.1f} Hz, {self.received} received"
        return f"<ImageSubscriber {self.topic}: {state}>"

    def _on_message(self, msg, info):
        if self.stopped:
            return
        with self._change:
            self.received += 1
            self._losses.receive(info.get("publication_sequence_number"))
        try:
            frame = self._convert(msg, self.encoding)
        except ConversionError as error:
            self._count_failure(f"a message of {self.topic} cannot be converted: {error}")
            return
        with self._change:
            self._latest = frame
            self._converted += 1
            self._arrivals.append(time.monotonic())
            self._change.notify_all()
        if self._on_image is not None:
            self._call_on_image(frame, msg)

    def _call_on_image(self, frame, msg):
        try:
            self._on_image(frame, msg)
        except Exception as error:  # noqa: BLE001  it is the learner's code; the graph must live on
            self._count(f"on_image failed {failed_line(error)}")
            lines = describe(error) or failed_line(error)
            text = self._errors.news(error, f"on_image failed; the subscriber continues\n{lines}")
            if text:
                log.error("%s", text)

    def _count(self, failure):
        with self._change:
            self.failed += 1
            self.last_error = failure

    def _count_failure(self, text):
        self._count(text)
        if text not in self._causes and self._may_log():
            self._causes.add(text)
            log.warning("%s (skipped; %d failed so far)", text, self.failed)

    def _on_incompatible_qos(self, event):
        remedy = _QOS_REMEDIES.get(
            event.last_policy_kind,
            f"the policy {event.last_policy_kind.name} differs; compare the QoS profiles of both sides",
        )
        text = f"{self.topic} is published with an incompatible QoS policy: {remedy}"
        if text != self.incompatible_qos:
            # First: a cell that waits for the report must not end before the line is in its output.
            log.warning("%s", text)
            with self._change:
                self.incompatible_qos = text
                self._change.notify_all()


def _qos_profile(qos):
    if isinstance(qos, QoSProfile):
        return qos
    if not isinstance(qos, str) or qos not in QOS:
        raise ValueError(f"qos must be 'sensor_data', 'reliable' or an rclpy.qos.QoSProfile, got {qos!r}")
    return QOS[qos]
