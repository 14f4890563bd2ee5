"""A node around a function: subscribe to pictures, process each, publish what comes out.

    def process(frame):
        return {"gray": to_gray(frame)}

    def main(args=None):
        return run_processor(lambda: ImageProcessor("image_gray_processor", process, ["gray"]), args)

The node translates and never computes; `process` computes and knows nothing of ROS.
"""

import collections
import contextlib
import json
import signal
import sys
import threading
import time
import traceback
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import rclpy
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_policy_name_from_kind
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import String

from imgproc_course.messages import ConversionError, array_to_image, compressed_to_array, image_to_array
from imgproc_course.ros.camera import TOPIC
from imgproc_course.ros.session import Throttle, spin_once
from imgproc_course.ros.silence import why_nothing_came
from imgproc_course.ros.stream_watch import SILENCE, Stream, Tally, in_words
from imgproc_course.ros.subscriber import QOS
from imgproc_course.ros.windows import close_windows, show_windows, window_problem

# BEST_EFFORT, VOLATILE, depth 5. Best effort is what cameras offer: a late picture is worth nothing, so a
# lost one is not sent again. Of more than five that wait, the oldest are dropped first.
SENSOR_DATA = QOS["sensor_data"]

LOOK_AROUND = 1.0  # seconds between two looks at what goes on around the node


class ImageProcessor(Node):
    """Calls a function for every picture of the camera, and publishes what it returns.

    Parameters
    ----------
    name : of the node, unless remapped (`-r __node:=other`)
    process : function(frame, **settings) -> {"gray": array, ...}. The frame is (H, W, 3) uint8, bgr8, and may
        be drawn on. A value may also be a function without arguments that returns the array: it is called
        only when somebody listens to that topic
    outputs : the keys that `process` returns; each is a private topic of sensor_msgs/Image: `~/gray`
    settings : of Setting; each is a ROS parameter
    check : function(**settings) that raises ValueError, with the reason, for values that do not go together
    node_options : of rclpy.node.Node, such as `context`, `namespace`, `cli_args`

    Pictures come from /kachaka/front_camera/image_raw, or from where it is remapped to (`-r FROM:=TO`); a
    topic that ends in /compressed is read as sensor_msgs/CompressedImage. A published picture has the header
    of the picture that it was made of. While nobody listens, nothing is processed.

    `statistics()` are published once a second on `~/statistics` (std_msgs/String, JSON) while somebody
    listens. The parameter `display` shows the pictures in windows of OpenCV, where it has any.

    Whatever arrives, the node goes on: what fails is counted, and logged with its cause at most every 5 s.

    Raises
    ------
    ValueError : first values of settings that `check` refuses
    rclpy.exceptions.ParameterException : a first value out of its range, or of another type
    """

    def __init__(self, name, process, outputs, *, settings=(), check=None, **node_options):
        super().__init__(name, **node_options)
        self._process = process
        self._check = check
        self._has_main_thread = False  # windows need it, and only `spin` has it
        self._has_windows = False
        self._to_show = {}
        self._throttles = collections.defaultdict(Throttle)
        self._tally = Tally()
        self._stream = Stream()
        self._declare(settings)
        self._publishers_of = {key: self._publish_on(f"~/{key}") for key in outputs}
        self._statistics = self.create_publisher(String, "~/statistics", 1)
        self._subscribe()
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # a clock that is set must not stop the looks around
        self._timer = self.create_timer(LOOK_AROUND, self._look_around, clock=steady)

    def statistics(self):
        """What happened so far.

        Returns
        -------
        dict of
            received, processed, failed : pictures
            unheard : pictures that were not processed, since nobody listened
            lost : pictures that the camera's process sent and this one never got, by the camera's own count;
                None while several publish the topic
            rate : pictures received a second
            latency_ms : median and 99th percentile of the time from the moment the camera's process sent a
                picture until its results were published (across machines: as far as their clocks agree)
            process_ms : the same two of the time spent on a picture in this node
            last_error : the cause of the latest failure in one line, or None
        Rate and times are of the latest 600 pictures; None before there are any.
        """
        return self._tally.as_dict()

    def spin(self, leaving=lambda: False):
        """Runs the node in the main thread, and shows the windows between two callbacks.

        Parameters
        ----------
        leaving : function without arguments, asked ten times a second; True ends it

        Raises
        ------
        rclpy.executors.ExternalShutdownException : ROS was shut down meanwhile
        """
        self._has_main_thread = threading.current_thread() is threading.main_thread()
        if self._display:
            problem = self._window_problem()
            if problem:
                self.get_logger().warning(f"{problem}; going on without windows")
                self.set_parameters([Parameter("display", value=False)])
        executor = SingleThreadedExecutor(context=self.context)
        executor.add_node(self)
        try:
            while not leaving():
                spin_once(executor, timeout_sec=0.05 if self._display else 0.1)
                self._show()
        finally:
            executor.shutdown()
            self._close_windows()

    # What comes in

    def _subscribe(self):
        self._topic = self.resolve_topic_name(TOPIC)
        is_compressed = self._topic.rpartition("/")[2] in ("compressed", "compressedDepth")
        self._kind = CompressedImage if is_compressed else Image
        self._convert = compressed_to_array if is_compressed else image_to_array
        self._subscription = self.create_subscription(
            self._kind,
            TOPIC,
            self._on_message,
            SENSOR_DATA,
            event_callbacks=SubscriptionEventCallbacks(matched=self._on_cameras),
        )
        self.get_logger().info(f"listening to {self._topic} ({self._kind.__name__})")

    def _on_message(self, msg, info):
        if not self.context.ok():
            return  # a picture that was waiting when ROS was shut down
        began = time.perf_counter()
        self._tally.arrived(info.get("publication_sequence_number"))
        self._stream.see(msg)
        wanted = self._wanted()
        if not wanted:
            self._tally.unheard += 1
        elif self._handle(msg, wanted):
            sent = info.get("source_timestamp") or time.time_ns()
            self._tally.done((time.time_ns() - sent) / 1e9, time.perf_counter() - began)
        self._tally.busy += time.perf_counter() - began

    def _wanted(self):
        if self._display:
            return list(self._publishers_of)
        return [key for key, publisher in self._publishers_of.items() if publisher.get_subscription_count()]

    def _handle(self, msg, wanted):
        try:
            frame = self._convert(msg, "bgr8")
        except ConversionError as error:
            return self._fail(f"a picture on {self._topic} does not convert: {error}")
        if frame.size == 0:
            return self._fail(
                f"an empty picture on {self._topic} ({frame.shape[1]}×{frame.shape[0]}); is the camera "
                "switched on? A Kachaka's depth camera sends such ones on its charger"
            )
        # What does not have to be converted is a read-only view of the message.
        frame = frame if frame.flags.writeable else frame.copy()
        try:
            results = self._process(frame, **self._settings)
            arrays = {key: _computed(results[key]) for key in wanted} if _has(results, wanted) else None
        except Exception as error:  # noqa: BLE001  process is other people's code, and the node must live on
            return self._fail(f"process failed {_where(error, self._process)}")
        if arrays is None:
            found = list(results) if isinstance(results, dict) else f"a {type(results).__name__}"
            return self._fail(f"process must return a dict with the keys {wanted}, and returned {found}")
        return self._publish(arrays, msg.header)

    def _publish(self, arrays, header):
        try:
            messages = {key: array_to_image(array, _encoding(array), header) for key, array in arrays.items()}
        except ConversionError as error:
            return self._fail(f"process returned no picture: {error}")
        try:
            for key, message in messages.items():
                self._publishers_of[key].publish(message)
        except RuntimeError as error:
            if not self.context.ok():
                return False  # ROS was shut down meanwhile
            return self._fail(f"the middleware does not take the pictures: {error}")
        if self._display:
            self._to_show = arrays
        return True

    def _fail(self, text):
        self._tally.failed += 1
        self._tally.last_error = text
        self._warn("failure", f"{text} (skipped; {self._tally.failed} of {self._tally.received} failed)")
        return False

    # Parameters

    def _declare(self, settings):
        self._types = {setting.name: type(setting.default) for setting in settings}
        values = {
            setting.name: self.declare_parameter(setting.name, setting.default, setting.descriptor()).value
            for setting in settings
        }
        about = ParameterDescriptor(description="show the pictures in windows, where OpenCV has any")
        self._display = self.declare_parameter("display", False, about).value
        self._settings = self._checked(values)
        self.add_on_set_parameters_callback(self._may_set)
        self.add_post_set_parameters_callback(self._after_set)

    def _checked(self, values):
        """The settings in their own types, once they go together. Raises ValueError with the reason."""
        for name, value in values.items():
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise ValueError(f"{name} must be a number, got {value!r}")
        values = {name: self._types[name](value) for name, value in values.items()}
        if self._check is not None:
            self._check(**values)
        return values

    def _changed(self, parameters):
        return {**self._settings, **{p.name: p.value for p in parameters if p.name in self._settings}}

    def _may_set(self, parameters):
        """Called once for all parameters of a request: all are taken, or none."""
        try:
            self._checked(self._changed(parameters))
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        if any(p.name == "display" and p.value for p in parameters) and not self._display:
            problem = self._window_problem()
            if problem:
                return SetParametersResult(successful=False, reason=problem)
        return SetParametersResult(successful=True)

    def _after_set(self, parameters):
        # One assignment: a picture is processed with all old settings or all new ones, never some of each.
        self._settings = self._checked(self._changed(parameters))
        for parameter in parameters:
            if parameter.name == "display":
                self._display = parameter.value
                self._to_show = {}

    # Windows

    def _window_problem(self):
        if not self._has_main_thread:
            return (
                "display needs a process of the node's own (ros2 run), for windows belong to the main thread"
            )
        return window_problem()

    def _show(self):
        if not self._display:
            self._close_windows()
            return
        self._has_windows = True
        arrays, self._to_show = self._to_show, {}
        try:
            show_windows({f"{self.get_fully_qualified_name()}/{key}": array for key, array in arrays.items()})
        except cv2.error as error:
            self._warn("windows", f"OpenCV cannot show the pictures ({error.err}); display is switched off")
            self.set_parameters([Parameter("display", value=False)])

    def _close_windows(self):
        if self._has_windows:
            self._has_windows = False
            with contextlib.suppress(cv2.error):  # the screen may be gone
                close_windows()

    # What the node says

    def _publish_on(self, topic):
        def on_incompatible(event):
            policy = qos_policy_name_from_kind(event.last_policy_kind)
            self._warn(
                f"{topic} qos",
                f"somebody asks for {name} with a QoS that does not match ({policy}), "
                "and gets nothing; pictures are sent BEST_EFFORT: subscribe with qos_profile_sensor_data",
            )

        def on_matched(event):
            count = event.current_count
            self.get_logger().info(f"{name} has {count or 'no'} listener{'' if count == 1 else 's'}")

        name = self.resolve_topic_name(topic)
        events = PublisherEventCallbacks(incompatible_qos=on_incompatible, matched=on_matched)
        return self.create_publisher(Image, topic, SENSOR_DATA, event_callbacks=events)

    def _on_cameras(self, event):
        self._tally.cameras(event.current_count)
        count = event.current_count
        self.get_logger().info(f"{self._topic} has {count or 'no'} publisher{'' if count == 1 else 's'}")

    def _look_around(self):
        if self._statistics.get_subscription_count():
            self._statistics.publish(String(data=json.dumps(self.statistics())))
        for news in self._stream.news():
            self.get_logger().info(news)
        losses = self._tally.new_losses()
        if losses:
            self._warn("losses", losses)
        if self._stream.has_fallen_silent():
            self.get_logger().warning(self._why_silent())
        own = (self.get_name(), self.get_namespace())
        if self.get_node_names_and_namespaces().count(own) > 1:
            self._warn(
                "name",
                f"another node is named {self.get_fully_qualified_name()} too (or was, and was killed just "
                "now): both publish on the same topics; name one otherwise: --ros-args -r __node:=another",
                seconds=60.0,
            )

    def _why_silent(self):
        topics = self.get_topic_names_and_types
        own = {publisher.topic_name for publisher in self._publishers_of.values()}
        others = SimpleNamespace(
            context=self.context,
            count_publishers=self.count_publishers,
            get_publishers_info_by_topic=self.get_publishers_info_by_topic,
            get_topic_names_and_types=lambda: [found for found in topics() if found[0] not in own],
        )
        as_subscriber = SimpleNamespace(
            topic=self._topic,
            message_type=self._kind,
            qos=SENSOR_DATA,
            received=self._tally.received,
            matched=self._subscription.get_publisher_count(),
            incompatible_qos=None,
            last_error=None,
            session=SimpleNamespace(node=others),
        )
        return why_nothing_came(as_subscriber, SILENCE, failed=0)

    def _warn(self, kind, text, seconds=None):
        if seconds is not None:
            self._throttles.setdefault(kind, Throttle(seconds))
        if self._throttles[kind]():
            self.get_logger().warning(text)


def run_processor(make_node, args=None):
    """Runs an ImageProcessor as a process of its own until Ctrl-C, SIGTERM, or ROS's end.

    Parameters
    ----------
    make_node : function without arguments that returns the node
    args : for ROS; None for those of the command line, which must hold no others

    Returns
    -------
    int, the exit code: 0, or 2 when it could not start (said in one line on stderr)
    """
    node, leaving = None, _Leaving()
    try:
        try:
            if args is None:
                _refuse_what_is_not_for_ros(sys.argv)
            # ROS's own handlers would shut the context down from another thread, in the middle of a call.
            rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
            node = make_node()
        except (ValueError, RuntimeError, ParameterException) as error:
            print(f"cannot start: {' '.join(str(error).split())}", file=sys.stderr)
            return 2
        _say_profile(node)
        node.spin(leaving)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if node is not None:
            print(f"{node.get_name()}: {in_words(node.statistics())}", file=sys.stderr)
            node.destroy_node()
        rclpy.try_shutdown()
    return 0


def _refuse_what_is_not_for_ros(command_line):
    """ROS itself drops it in silence: `--low 40` would start a node with the low of every day."""
    others = remove_ros_args(command_line)[1:]
    if others:
        raise ValueError(
            f"'{' '.join(others)}' says nothing to a node; a parameter is given as "
            "--ros-args -p NAME:=VALUE, another topic as --ros-args -r FROM:=TO"
        )


class _Leaving:
    """Whether Ctrl-C or SIGTERM came: then the picture at hand is finished, and no other begun."""

    # Under `ros2 launch` Ctrl-C comes twice, from the terminal and from launch; a third is impatience.
    PATIENT = 2

    def __init__(self):
        self._signals = 0
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)

    def __call__(self):
        return self._signals > 0

    def _on_signal(self, number, _):
        self._signals += 1
        if self._signals > self.PATIENT:
            raise KeyboardInterrupt


def _say_profile(node):
    from imgproc_course.ros import dds_profile  # it chooses before this module is imported

    profile = dds_profile()
    if profile.note:
        node.get_logger().warning(f"DDS profile: {profile}")
    else:
        node.get_logger().info(f"DDS profile: {profile}")


def _has(results, keys):
    return isinstance(results, dict) and results.keys() >= set(keys)


def _computed(value):
    return value() if callable(value) else value


def _encoding(array):
    if isinstance(array, np.ndarray) and array.dtype == np.uint8:
        return "mono8" if array.ndim == 2 else "bgr8" if array.shape[2:] == (3,) else "passthrough"
    return "passthrough"


def _where(error, process):
    # The last line in the learner's own file says more than the depths of a library that it called.
    own = getattr(getattr(process, "__code__", None), "co_filename", None)
    frames = traceback.extract_tb(error.__traceback__)
    at = next((frame for frame in reversed(frames) if frame.filename == own), frames[-1])
    what = traceback.format_exception_only(error)[-1].strip()
    return f"in line {at.lineno} of {Path(at.filename).name} ({at.line}): {what}"
