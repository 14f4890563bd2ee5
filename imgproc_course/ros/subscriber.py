"""Frames from a camera topic, as arrays: the latest, the next, or all of them in a loop."""

import collections
import threading
import time
import traceback
import weakref

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSPolicyKind,
    QoSProfile,
    ReliabilityPolicy,
)
from sensor_msgs.msg import CompressedImage, Image

from imgproc_course.messages import ConversionError, compressed_to_array, encoding_info, image_to_array
from imgproc_course.ros.session import RCLError, RosSession, Throttle, log
from imgproc_course.ros.silence import why_nothing_came

# What cameras offer (rclpy.qos.qos_profile_sensor_data): a late frame is worth nothing, so a lost one is not
# sent again. A reliable subscriber would hear nothing from such a publisher.
QOS = {
    "sensor_data": QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=5,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
    ),
    "reliable": QoSProfile(depth=10),  # what a plain 10 in create_subscription means
}
RATE_WINDOW = 2.0  # seconds over which the rate is measured

_QOS_REMEDIES = {
    QoSPolicyKind.RELIABILITY: (
        'this subscriber asks for RELIABLE, the publisher offers BEST_EFFORT; use qos="sensor_data"'
    ),
    QoSPolicyKind.DURABILITY: (
        "this subscriber asks for TRANSIENT_LOCAL (old messages too), the publisher offers VOLATILE "
        '(new ones only); use qos="sensor_data"'
    ),
}


class ImageSubscriber:
    """Subscribes to pictures and keeps the newest one, as a frame.

    Parameters
    ----------
    topic : sensor_msgs/Image, or sensor_msgs/CompressedImage where it ends in /compressed or /compressedDepth
    on_image : function(frame, msg), called for every frame in ROS's thread: keep it shorter than the camera's
        period, or iterate instead, which skips to the newest frame
    qos : "sensor_data" (best effort, depth 5: what cameras offer), "reliable" (what a plain 10 means: hears
        nothing of a best-effort camera), or an rclpy QoSProfile
    encoding : what the frames shall be; "passthrough" for as sent (then a read-only view of the message)

    Attributes
    ----------
    received : messages that arrived
    failed : those that did not convert, or on which `on_image` raised; they are logged and skipped
    last_error : what the last of those failed on, in one line; None
    dropped : messages lost on the way, or overwritten while ROS's thread was busy, by the gaps in the
        publisher's own count; None where the middleware does not count, or while several publish the topic
    skipped : frames that a loop over this subscriber passed over to get to the newest
    incompatible_qos : what does not match, with the remedy; None
    measured_rate : frames a second, by time of arrival, over the last two seconds

    Any thread may use it. It stops with `.stop()`, at the end of its `with`, with the RosSession, or when
    nobody holds it any more. One with an `on_image` is held until it is stopped; in a notebook, another one
    on the same topic with a function of the same name replaces it, so that running a cell again does not
    call the function twice.

    Raises
    ------
    ValueError : no topic name, no such qos, no such encoding

    Examples
    --------
    >>> with ImageSubscriber("/kachaka/front_camera/image_raw") as subscriber:
    ...     frame = subscriber.wait()
    """

    _held = {}  # noqa: RUF012  key -> subscriber with an on_image

    def __init__(self, topic, on_image=None, *, qos="sensor_data", encoding="bgr8"):
        if encoding != "passthrough":
            encoding_info(encoding)
        self.qos = _qos(qos)
        self.encoding = encoding
        self._on_image = on_image
        self._change = threading.Condition()
        self._arrivals = collections.deque()
        self._complain = Throttle()
        self._latest = (None, None)
        self._converted = 0
        self._sequence = None
        self._counts = True
        self._dropped = 0
        self._stopped = False
        self._key = None
        self.received = self.failed = self.skipped = 0
        self.last_error = self.incompatible_qos = None
        self.session = RosSession.current()
        self.topic = self.session.resolve_topic(topic)
        is_compressed = self.topic.rpartition("/")[2] in ("compressed", "compressedDepth")
        self.message_type = CompressedImage if is_compressed else Image
        self._convert = compressed_to_array if is_compressed else image_to_array
        if on_image is not None:
            self._replace_former()
        self._subscription = subscription = self._subscribe()
        self.session.at_stop(subscription, _weak(self.stop))
        self._finalizer = weakref.finalize(self, _unsubscribe, self.session, self.session.node, subscription)
        self._finalizer.atexit = False  # the session sees to that

    def _subscribe(self):
        # Weak, so that a subscriber that nobody holds any more goes, and its subscription with it.
        events = SubscriptionEventCallbacks(
            incompatible_qos=_weak(self._on_incompatible_qos), matched=_weak(self._on_matched)
        )
        on_message = _weak(self._on_message)
        try:
            return self.session.node.create_subscription(
                self.message_type,
                self.topic,
                lambda msg, info: on_message(msg, info),
                self.qos,
                event_callbacks=events,
            )
        except RCLError as error:
            kind = self.message_type.__name__
            raise ValueError(
                f"{self.topic} cannot be subscribed as {kind}: this process has it with another type; "
                "pictures come as Image, and as CompressedImage where the name ends in /compressed"
            ) from error

    def _replace_former(self):
        function = getattr(self._on_image, "__func__", self._on_image)
        # Only what a notebook or script defines: running a cell again makes no module's function anew.
        in_notebook = getattr(function, "__module__", None) == "__main__"
        name = getattr(function, "__qualname__", repr(function))
        self._key = (self.topic, name) if in_notebook else id(self)
        former = self._held.get(self._key)
        self._held[self._key] = self
        if former is not None:
            former.stop()
            log.warning("replaced the subscriber that called %s on %s", name, self.topic)

    def latest(self):
        """The newest frame, or None before the first."""
        return self._latest[0]

    def latest_message(self):
        """The newest message that converted, or None before the first."""
        return self._latest[1]

    def wait(self, timeout=5.0):
        """A frame that arrives after this call.

        Parameters
        ----------
        timeout : seconds

        Raises
        ------
        TimeoutError : none came; the text says why (nobody publishes, QoS does not match, frames do not
            convert, ...) and the remedy
        RuntimeError : the subscriber is stopped, or the caller is a ROS callback, during which none can come
        """
        return self._wait(timeout)[0]

    def wait_message(self, timeout=5.0):
        """The message of a frame that arrives after this call; raises as `wait` does."""
        return self._wait(timeout)[1]

    def _wait(self, timeout):
        if self.session.is_spinning_thread():
            raise RuntimeError(
                "no frame can arrive while a ROS callback waits for it; use on_image or latest()"
            )
        with self._change:
            seen, failed = self._converted, self.failed
            self._change.wait_for(self._newer_than(seen), timeout)
            if self._converted > seen:
                return self._latest
        if self._stopped:
            raise RuntimeError(f"the subscriber of {self.topic} is stopped; make a new ImageSubscriber")
        raise TimeoutError(why_nothing_came(self, timeout, self.failed - failed))

    def __iter__(self):
        """Yields each new frame; when several came meanwhile, the newest. Ends when the subscriber stops."""
        seen = self._converted
        while True:
            with self._change:
                self._change.wait_for(self._newer_than(seen))
                if self._converted == seen:
                    return
                self.skipped += self._converted - seen - 1
                seen = self._converted
                frame = self._latest[0]
            yield frame

    def _newer_than(self, seen):
        return lambda: self._converted > seen or self._stopped

    @property
    def measured_rate(self):
        with self._change:
            self._forget_old_arrivals()
            if len(self._arrivals) < 2:
                return 0.0
            return (len(self._arrivals) - 1) / (self._arrivals[-1] - self._arrivals[0])

    @property
    def dropped(self):
        return self._dropped if self._counts else None

    @property
    def matched(self):
        """How many publishers this subscriber hears, QoS and type agreeing."""
        return 0 if self._stopped else self._subscription.get_publisher_count()

    @property
    def stopped(self):
        """Whether the subscriber is stopped."""
        return self._stopped

    def stop(self):
        """Ends the subscription, and every wait and loop over it. A second stop does nothing."""
        with self._change:
            self._stopped = True
            self._change.notify_all()
        if self._held.get(self._key) is self:
            del self._held[self._key]
        self._finalizer()

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.stop()

    def __repr__(self):
        state = "stopped" if self._stopped else f"{self.measured_rate:.1f} Hz, {self.received} received"
        return f"<ImageSubscriber {self.topic}: {state}>"

    def _on_message(self, msg, info):
        if self._stopped:
            return
        with self._change:
            self.received += 1
            self._count_gap(info.get("publication_sequence_number"))
        try:
            frame = self._convert(msg, self.encoding)
        except ConversionError as error:
            self._fail(f"a message of {self.topic} does not convert: {error}")
            return
        with self._change:
            self._latest = (frame, msg)
            self._converted += 1
            self._arrivals.append(time.monotonic())
            self._forget_old_arrivals()
            self._change.notify_all()
        if self._on_image is not None:
            self._call_on_image(frame, msg)

    def _call_on_image(self, frame, msg):
        try:
            self._on_image(frame, msg)
        except Exception as error:  # noqa: BLE001  it is the learner's code; the graph must live on
            where = traceback.extract_tb(error.__traceback__)[-1]
            what = traceback.format_exception_only(error)[-1].strip()
            self._fail(f"on_image failed in line {where.lineno} ({where.line}): {what}")

    def _fail(self, text):
        with self._change:
            self.failed += 1
            self.last_error = text
        if self._complain():
            log.warning("%s (skipped; %d failed so far)", text, self.failed)

    def _count_gap(self, sequence):
        """The publisher numbers its messages; a number left out is a message that never came."""
        if not sequence:
            self._counts = False
        elif self._counts and self._sequence is not None and sequence > self._sequence:
            self._dropped += sequence - self._sequence - 1
        self._sequence = sequence

    def _on_matched(self, event):
        with self._change:
            self._sequence = None  # another publisher counts anew
            self._counts = event.current_count <= 1

    def _on_incompatible_qos(self, event):
        remedy = _QOS_REMEDIES.get(
            event.last_policy_kind,
            f"the policy {event.last_policy_kind.name} differs; compare both sides' QoS",
        )
        text = f"{self.topic} is published with a QoS that does not match: {remedy}"
        if text != self.incompatible_qos:
            self.incompatible_qos = text
            log.warning("%s", text)

    def _forget_old_arrivals(self):
        horizon = time.monotonic() - RATE_WINDOW
        while self._arrivals and self._arrivals[0] < horizon:
            self._arrivals.popleft()


def _qos(qos):
    if isinstance(qos, QoSProfile):
        return qos
    if not isinstance(qos, str) or qos not in QOS:
        raise ValueError(f"qos {qos!r} is neither 'sensor_data' nor 'reliable' nor an rclpy.qos.QoSProfile")
    return QOS[qos]


def _weak(method):
    """A function that calls the method for as long as its object lives."""
    reference = weakref.WeakMethod(method)

    def call(*arguments):
        alive = reference()
        return alive(*arguments) if alive is not None else None

    return call


def _unsubscribe(session, node, subscription):
    session.at_stop(subscription, None)
    session.post(lambda: node.destroy_subscription(subscription))
