"""A node around a function: it subscribes to images, processes each one, and publishes the results.

    def process(frame):
        return {"gray": to_gray(frame)}

    def main(args=None):
        return run_processor(lambda: ImageProcessor("image_gray_processor", process, ["gray"]), args)

The node translates and never computes; `process` computes and knows nothing about ROS.
"""

import time
from collections.abc import Callable, Sequence
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_policy_name_from_kind

from imgproc_course.learner_errors import RepeatedErrors, advice_on
from imgproc_course.messages import ConversionError
from imgproc_course.ros.diagnostics import explain_missing_messages
from imgproc_course.ros.numeric_parameter import NumericParameter
from imgproc_course.ros.process_function import OutputPublishers, SkippedImageError, call_process
from imgproc_course.ros.robot_topics import TOPIC
from imgproc_course.ros.session import RosSession, Throttle, spin_once
from imgproc_course.ros.stream_statistics import SILENCE, ProcessingStatistics, SilenceMonitor
from imgproc_course.ros.subscriber import QOS, image_type

# BEST_EFFORT, VOLATILE, depth 5: what cameras offer. A late image is worth nothing, so a lost one is not sent
# again. If more than five images wait, the oldest are dropped.
SENSOR_DATA = QOS["sensor_data"]

REPORT_PERIOD = 1.0  # seconds between two looks at what the node logs
DUPLICATE_NAME_PERIOD = 60.0  # seconds without a second node of the same name until it is news again


class ImageProcessor(Node):
    """Calls a function for every image of the camera, and publishes what the function returns.

    Parameters
    ----------
    name : of the node, unless it is remapped (`-r __node:=other`)
    process : function(frame, **parameters) -> {"gray": array, ...}. The frame is (H, W, 3) uint8, bgr8; the
        function may draw on it. A value may also be a function without arguments that returns the array: it
        is called only if that topic has a subscriber
    outputs : the keys that `process` returns; each is a private topic of sensor_msgs/Image: `~/gray`
    parameters : sequence of NumericParameter; each is a ROS parameter
    check : function(**parameters) that raises ValueError, with the reason, if the values do not fit together
    node_options : of rclpy.node.Node, such as `context`, `namespace`, `cli_args`

    The node subscribes to /kachaka/front_camera/image_raw, which can be remapped (`-r FROM:=TO`). If the
    topic ends in /compressed, the node reads sensor_msgs/CompressedImage. It copies the header of an image to
    its results. Without a subscriber it processes nothing.

    No image stops the node: a failure is counted, and each cause is logged once. In a
    RosSession, the node replaces the one of the same name.

    Raises
    ------
    ValueError : `check` refuses the initial values of the parameters
    rclpy.exceptions.ParameterException : an initial value is out of its range, or has another type
    """

    def __init__(
        self,
        name: str,
        process: Callable[..., dict[str, Any]],
        outputs: Sequence[str],
        *,
        parameters: Sequence[NumericParameter] = (),
        check: Callable[..., None] | None = None,
        **node_options: Any,
    ):
        RosSession().remove_namesake(name, node_options.get("namespace"), node_options.get("context"))
        super().__init__(name, **node_options)
        self._process = process
        self._statistics = ProcessingStatistics()
        self._silence = SilenceMonitor()
        self._log = NodeLog(self)
        self._errors = RepeatedErrors()
        self._node_parameters = NodeParameters(self, parameters, check)
        self._outputs = OutputPublishers(self, outputs, SENSOR_DATA, self._log)
        self._subscribe()
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # reports must go on when the system clock is set
        self._timer = self.create_timer(REPORT_PERIOD, self._report, clock=steady)

    def statistics(self) -> dict[str, Any]:
        """What happened so far.

        Returns
        -------
        dict
            - received, processed, failed : images
            - ignored : images that were not processed, because no output had a subscriber
            - lost : images that the camera's process sent and this node never received, by the publisher's
              own numbers; None while several nodes publish the topic
            - last_error : the cause of the latest failure in one line, or None
        """
        return self._statistics.as_dict()

    @property
    def last_error(self) -> str | None:
        """The cause of the latest failure in one line, or None."""
        return self._statistics.last_error

    def spin(self, should_stop: Callable[[], bool] = lambda: False) -> None:
        """Runs the node until `should_stop()`, which is called ten times per second, returns True."""
        executor = SingleThreadedExecutor(context=self.context)
        executor.add_node(self)
        try:
            while not should_stop():
                spin_once(executor, timeout_sec=0.1)
        finally:
            executor.shutdown()

    def _subscribe(self):
        self._topic = self.resolve_topic_name(TOPIC)
        message_type, self._convert = image_type(self._topic)
        on_message: Any = self._on_message  # rclpy gives the info to those who take two arguments
        events = SubscriptionEventCallbacks(matched=self._on_matched)
        self._subscription = self.create_subscription(
            message_type, TOPIC, on_message, SENSOR_DATA, event_callbacks=events
        )
        self._log.info(f"subscribed to {self._topic} ({message_type.__name__})")

    def _on_matched(self, event):
        self._statistics.losses.on_matched(event)
        self._log.count_changed(self._topic, event.current_count, "publisher")

    def _on_message(self, msg, info):
        if not self.context.ok():
            return  # an image that was waiting when ROS was shut down
        start = time.perf_counter()
        self._statistics.received += 1
        self._statistics.losses.receive(info.get("publication_sequence_number"))
        if pause := self._silence.observe():
            self._log.info(f"images arrive again, after {pause:.1f} s without")
        outputs = self._outputs.subscribed()
        if not outputs:
            self._statistics.ignored += 1
        elif self._process_message(msg, outputs):
            self._statistics.processed += 1
        self._statistics.busy += time.perf_counter() - start

    def _process_message(self, msg, outputs):
        try:
            frame = self._frame_of(msg)
            arrays = call_process(self._process, frame, self._node_parameters.values, outputs)
            return self._outputs.publish(arrays, msg.header)
        except SkippedImageError as error:
            self._count_failure(str(error), error.__cause__)
            return False

    def _frame_of(self, msg):
        try:
            frame = self._convert(msg, "bgr8")
        except ConversionError as error:
            raise SkippedImageError(f"an image on {self._topic} cannot be converted: {error}") from error
        if frame.size == 0:
            raise SkippedImageError(
                f"an empty image on {self._topic} ({frame.shape[1]}×{frame.shape[0]}); is the camera "
                "switched on? A Kachaka's depth camera sends such images on its charger"
            )
        # If nothing has to be converted, the frame is a read-only view of the message.
        return frame if frame.flags.writeable else frame.copy()

    def _count_failure(self, text, cause):
        statistics = self._statistics
        statistics.failed += 1
        statistics.last_error = text
        count = f" (skipped; {statistics.failed} of {statistics.received} failed)"
        if cause is None or isinstance(cause, ConversionError):
            self._log.warn("failure", text, count)
        elif news := self._errors.news(cause, "\n".join(filter(None, [text + count, advice_on(cause)]))):
            self.get_logger().warning(news)

    def _report(self):
        losses = self._statistics.new_losses()
        if losses:
            self._log.warn("losses", *losses)
        if self._silence.has_become_silent():
            received = self._statistics.received
            topics = [publisher.topic_name for publisher in self._outputs.publishers.values()]
            reason = explain_missing_messages(self, self._subscription, SILENCE, received, own_topics=topics)
            self.get_logger().warning(reason)
        self._log.warn_about_duplicate_name()


class NodeParameters:
    """Declares the parameters, checks every request to change them, and holds their `values`."""

    def __init__(self, node, numeric_parameters, check):
        self._types = {p.name: type(p.default) for p in numeric_parameters}
        self._check = check
        declared = [(p.name, p.default, p.descriptor()) for p in numeric_parameters]
        self.values = self._checked({p.name: p.value for p in node.declare_parameters("", declared)})
        node.add_on_set_parameters_callback(self._validate)
        node.add_post_set_parameters_callback(self._apply)

    def _checked(self, values):
        """The values in their declared types; ValueError if they are refused."""
        for name, value in values.items():
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise ValueError(f"{name} must be a number, got {value!r}")
        values = {name: self._types[name](value) for name, value in values.items()}
        if self._check is not None:
            self._check(**values)
        return values

    def _merged(self, request):
        """All values as they are after the request."""
        changes = {parameter.name: parameter.value for parameter in request if parameter.name in self.values}
        return {**self.values, **changes}

    def _validate(self, request):
        """Called once for all parameters of a request: either all are accepted, or none."""
        try:
            self._checked(self._merged(request))
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _apply(self, request):
        # One assignment: an image is processed with all old values or with all new ones, never with a mix.
        self.values = self._checked(self._merged(request))


class NodeLog:
    """Logs in the name of a node: a warning once for each cause, and one of a kind every few seconds."""

    def __init__(self, node):
        self._node = node
        self._may_log = Throttle()
        self._causes = set()
        self._may_log_duplicate = Throttle(DUPLICATE_NAME_PERIOD, while_it_lasts=True)

    def info(self, text):
        self._node.get_logger().info(text)

    def warn(self, kind, cause, details=""):
        if cause not in self._causes and self._may_log(kind):
            self._causes.add(cause)
            self._node.get_logger().warning(f"{cause}{details}")

    def warn_about_duplicate_name(self):
        node = self._node
        own_name = (node.get_name(), node.get_namespace())
        if node.get_node_names_and_namespaces().count(own_name) > 1 and self._may_log_duplicate():
            node.get_logger().warning(
                f"another node has the name {node.get_fully_qualified_name()} too (or had it, and was killed "
                "just now): both publish on the same topics; rename one: --ros-args -r __node:=another",
            )

    def count_changed(self, topic, count, role):
        """Logs the new number of a topic's publishers or subscribers."""
        self.info(f"{topic} has {count or 'no'} {role}{'' if count == 1 else 's'}")

    def publisher_events(self, topic):
        """PublisherEventCallbacks that log who subscribes to the topic, and with which QoS in vain."""

        def on_incompatible_qos(event):
            policy = qos_policy_name_from_kind(event.last_policy_kind)
            self.warn(
                f"{topic} qos",
                f"a subscriber of {topic} requests an incompatible QoS policy ({policy}) and receives "
                "nothing; images are published BEST_EFFORT: subscribe with qos_profile_sensor_data",
            )

        def on_matched(event):
            self.count_changed(topic, event.current_count, "subscriber")

        return PublisherEventCallbacks(incompatible_qos=on_incompatible_qos, matched=on_matched)
