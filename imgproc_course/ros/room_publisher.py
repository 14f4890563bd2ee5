"""Publishes the room: a robot that can be driven, on the real robot's topics."""

import contextlib
import math
import time
from pathlib import Path

import psutil
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from std_msgs.msg import Header
from std_srvs.srv import SetBool

from imgproc_course.ros.camera_publisher import UNKNOWN_NODE_NAME, CameraPublisher
from imgproc_course.ros.diagnostics import process_of
from imgproc_course.ros.robot_topics import COMMANDS, ENABLED, ODOMETRY, ROOM_NODE, WHEEL_ODOMETRY
from imgproc_course.ros.room_images import RoomImages
from imgproc_course.ros.room_messages import ODOM_FRAME, odometry_message
from imgproc_course.ros.session import RosSession, Throttle, log
from imgproc_course.simulation.wheels import MAX_ANGULAR, MAX_LINEAR

QUIET = 10.0  # seconds without a fault until the same fault is reported again
TOLERANCE = 1.01  # of a limit: π/2 is a command within the limit 1.57
OPTIONS = ("seed", "lighting", "start", "room")  # the parameters of the node /room
RECORDED = -1  # the parameter `room` of the recorded drive's room; others are numbers of furnished ones


def open_room(request):
    """The body for a request of `open_camera("room")`."""
    options = {name: request[name] for name in ("size", *OPTIONS)}
    return RoomPublisher(request["topic"], RoomImages(request["rate"], **options))


class RoomPublisher(CameraPublisher):
    """A CameraPublisher of RoomImages that also publishes the robot's other topics, and follows commands.

    The node /room has the parameters `seed`, `lighting`, `start` (x, y, yaw) and `room` (the number of a
    furnished one; -1: the recorded drive's). Setting one begins again.
    """

    def __init__(self, topic, images):
        super().__init__(topic, images, _description(topic, images))
        self._may_log = Throttle(QUIET, while_it_lasts=True)
        self._commanded = -math.inf
        self._room = None

    def status(self):
        return super().status() | {"bumps": self._images.bumps, "seed": self._images.options["seed"]}

    def _create_publishers(self):
        super()._create_publishers()
        self._odometry = [self._create_publisher(Odometry, topic) for topic in (ODOMETRY, WHEEL_ODOMETRY)]
        self._images.on_motion = self._publish_odometry
        session = RosSession.current()
        session.remove_namesake(ROOM_NODE, context=session.context)  # of the body before
        self._room = Node(ROOM_NODE, context=session.context)
        self._room.create_subscription(Twist, COMMANDS, self._on_command, qos_profile_sensor_data)
        self._room.create_service(SetBool, ENABLED, self._on_enable)
        options = self._images.options
        for name in OPTIONS:
            value = RECORDED if options[name] is None else options[name]
            self._room.declare_parameter(name, [*value] if isinstance(value, tuple) else value)
        self._room.add_on_set_parameters_callback(self._on_parameters)
        session.add_node(self._room)

    def _destroy_publishers(self):
        super()._destroy_publishers()
        if self._room is not None:
            RosSession().remove_node(self._room)

    def _on_command(self, msg):
        linear, angular = msg.linear.x, msg.angular.z
        self._commanded = time.monotonic()
        if not (math.isfinite(linear) and math.isfinite(angular)):
            self._warn("not finite", f"a command of {linear} m/s and {angular} rad/s: the robot stops")
            linear = angular = 0.0
        elif abs(linear) > TOLERANCE * MAX_LINEAR or abs(angular) > TOLERANCE * MAX_ANGULAR:
            self._warn(
                "limit",
                f"a command of {linear:g} m/s and {angular:g} rad/s: the robot drives at most "
                f"{MAX_LINEAR} m/s and turns at most {MAX_ANGULAR} rad/s",
            )
        self._images.command(linear, angular)

    def _warn(self, fault, text):
        if self._may_log(fault):
            log.warning("%s", text)

    def _on_enable(self, request, response):
        """The next command switches manual control on again, as on the robot."""
        if not request.data:
            self._images.command(0.0, 0.0)
        response.success = True
        return response

    def _on_parameters(self, parameters):
        changes = {p.name: p.value for p in parameters if p.name in OPTIONS}
        if "start" in changes:
            changes["start"] = tuple(changes["start"])
        if changes.get("room") == RECORDED:
            changes["room"] = None
        try:
            if changes:
                self._images.restart(**changes)
                self.description = _description(self.topic, self._images)
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _look_at_the_graph(self):
        super()._look_at_the_graph()
        publishers = self._node.get_publishers_info_by_topic(COMMANDS)
        names = ", ".join(sorted(info.node_name for info in publishers))
        is_commanded = time.monotonic() - self._commanded < 1.0
        if len(publishers) > 1 and is_commanded and UNKNOWN_NODE_NAME not in names:
            programs = sorted(set(map(_program_of, publishers)))
            remedy = "" if len(programs) == 1 else "; shut one down, in JupyterLab: Kernel > Shut Down Kernel"
            senders = f"{len(publishers)} publishers" if len(programs) == 1 else " and ".join(programs)
            self._warn(
                f"publishers {names} {senders}",
                f"{senders} send commands on {COMMANDS} ({names}): the robot follows the newest command of "
                f"them all{remedy}",
            )

    def _publish_odometry(self, stamp):
        for publisher in self._odometry:
            if publisher.get_subscription_count():
                header = Header(stamp=Time(nanoseconds=stamp).to_msg(), frame_id=ODOM_FRAME)
                publisher.publish(odometry_message(self._images.simulation.odometry(), header))


def _program_of(publisher):
    """The notebook or the process that has a publisher, for people."""
    with contextlib.suppress(psutil.Error):
        if process := process_of(publisher):
            notebook = process.environ().get("JPY_SESSION_NAME")
            return f"the notebook {Path(notebook).name}" if notebook else f"process {process.pid}"
    return f"the node {publisher.node_name}"


def _description(topic, images):
    options = images.options
    width, height = options["size"]
    room = "the room" if options["room"] is None else f"the furnished room {options['room']}"
    return (
        f"{room} (seed {options['seed']}, {options['lighting']}, {width}×{height}) "
        f"at {images.rate:g} Hz on {topic}"
    )
