"""A client of the robot's topics, for a notebook: send commands, read odometry and scan."""

import contextlib
import math
import threading
import time
from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from imgproc_course.ros.entities import Entities, weak_callback
from imgproc_course.ros.robot_process import robot_runs, running_robot
from imgproc_course.ros.robot_topics import COMMANDS, ODOMETRY, ROOM_NODE, SCAN, is_room_number
from imgproc_course.ros.session import RosSession

COMMAND_PERIOD = 0.1  # seconds between the commands of a drive that lasts
TIMEOUT = 10.0  # seconds that a message, or the room's robot, may take to appear
ANSWER = 0.9  # seconds that another robot may take to subscribe to commands and to send its odometry
SETTLING = 0.2  # seconds: see Robot._require_robot
FRESH = 1.0  # seconds: an older message is of a robot that is gone, so the next one is waited for
_START_IT = 'open_camera("room") starts a simulated robot'
_START_ANY = f"{_START_IT}, or start a real robot's bridge in this ROS domain"


class Robot(contextlib.AbstractContextManager["Robot"]):
    """The robot of this domain: the one in the room, or a real Kachaka.

    Commands go to the topic `COMMANDS`. The robot stops by itself if no command comes for 0.5 s. Any thread
    may use it, but a ROS callback cannot wait for the robot's messages.

    Parameters
    ----------
    namespace : of the robot's topics, "/kachaka"

    Examples
    --------
    >>> with open_camera("room"), Robot() as robot:
    ...     robot.drive(0.2, 0.0, seconds=1.0)
    ...     print(robot.odometry.pose.pose.position.x)
    """

    def __init__(self, namespace: str = "/kachaka"):
        self._session = RosSession.current()
        self._change = threading.Condition()
        self._messages: dict[str, tuple[float, Any]] = {}
        self._subscribed: set[str] = set()
        self.restarts = 0  # of this object: a map of the time before is of no use
        self._topics = {
            name: self._session.resolve_topic(f"/{namespace.strip('/')}/{topic.partition('/kachaka/')[2]}")
            for name, topic in (("commands", COMMANDS), ("odometry", ODOMETRY), ("scan", SCAN))
        }
        self._commands: Any = None
        self._client: Any = None
        self._entities = Entities(self, weak_callback(self.close))

    def drive(self, linear: float, angular: float, seconds: float | None = None) -> None:
        """Sends a command: for 0.5 s at most, unless the next one follows; or for `seconds`, then a stop.

        Parameters
        ----------
        linear : m/s, forwards; the robot's limit is 0.3
        angular : rad/s, to the left; its limit is 1.57
        seconds : if given, the call sends commands for so long, and returns after the stop

        Raises
        ------
        ValueError : a speed or duration that is not finite
        RuntimeError : no robot answers; this takes a second
        """
        for name, value in (("linear", linear), ("angular", angular), ("seconds", seconds or 0.0)):
            if not math.isfinite(value) or (name == "seconds" and value < 0):
                raise ValueError(f"{name} must be a finite number, got {value!r}")
        self._require_robot()
        if seconds is None:
            self._send(linear, angular)
            return
        end = time.monotonic() + seconds
        try:
            while (left := end - time.monotonic()) > 0:
                self._require_robot()
                self._send(linear, angular)
                time.sleep(min(left, COMMAND_PERIOD))
        finally:
            self._send(0.0, 0.0)

    def stop(self) -> None:
        """Sends the command to stand still, if this Robot has driven."""
        if not self._entities.closed and self._commands is not None:
            self._send(0.0, 0.0)

    @property
    def odometry(self) -> Odometry:
        """The newest nav_msgs/Odometry: where the wheels say that the robot is, since its start.

        Raises
        ------
        TimeoutError : none arrives; RuntimeError : the caller is a ROS callback, which cannot wait
        """
        return self._newest("odometry", Odometry)

    @property
    def scan(self) -> LaserScan:
        """The newest sensor_msgs/LaserScan; the robot computes scans from the first call on.

        Its frame, laser_frame, is turned to the left by 90 degrees: ahead is the angle -π/2.
        """
        return self._newest("scan", LaserScan)

    @property
    def pose(self) -> tuple[float, float, float]:
        """(x, y, yaw) of the odometry: metres, and radians to the left."""
        pose = self.odometry.pose.pose
        q = pose.orientation
        return pose.position.x, pose.position.y, 2 * math.atan2(q.z, q.w)

    @property
    def bumps(self) -> int | None:
        """How often the simulated robot has bumped into something; None if this is not known."""
        return self._status().get("bumps")

    def restart(
        self,
        *,
        seed: int | None = None,
        lighting: str | None = None,
        start: Sequence[float] | None = None,
        room: int | None = None,
    ) -> None:
        """Begins again in the room, in other light, at another place, or in another room.

        Its odometry begins at zero. With `seed` or `room`, or without any argument, person, car and ball
        begin again too, as in a new `Simulation`; otherwise they go on.

        Parameters
        ----------
        seed, lighting, start : as in `Simulation`; what is omitted stays, but in another room the robot
            starts where that room says
        room : the number of a furnished room, see `furnished`; -1: the room of the recorded drive

        Raises
        ------
        ValueError : the room refuses it; the text says why
        RuntimeError : this robot is not simulated
        """
        if start is not None:
            start = [float(value) for value in start]
        if room is not None:
            if not is_room_number(room, least=-1):
                raise ValueError(
                    f"room is a whole number from 0 on, or -1 for the recorded one, got {room!r}"
                )
            room = int(room)  # also one of NumPy
        changes = {"seed": seed, "lighting": lighting, "start": start, "room": room}
        if not any(value is not None for value in changes.values()):
            changes["seed"] = self._status().get("seed")
        parameters = [Parameter(name, value=value) for name, value in changes.items() if value is not None]
        result = self._set_parameters(parameters)
        if not result.successful:
            raise ValueError(result.reason)

    def _set_parameters(self, parameters):
        if self._client is None:
            service = f"/{ROOM_NODE}/set_parameters_atomically"
            client = self._entities.node.create_client(SetParametersAtomically, service)
            self._client = self._entities.add(client)
        if not self._client.wait_for_service(TIMEOUT):
            raise RuntimeError(f"no simulated robot answers: {_START_IT}")
        finished = threading.Event()
        request = SetParametersAtomically.Request(parameters=[p.to_parameter_msg() for p in parameters])
        future = self._client.call_async(request)
        future.add_done_callback(lambda _: finished.set())
        if not finished.wait(3 * TIMEOUT):
            raise RuntimeError(f"the simulated robot has not answered in {3 * TIMEOUT:g} s; {_START_IT}")
        with self._change:
            self._messages.clear()  # they are of the time before
            self.restarts += 1
        return future.result().result

    def close(self) -> None:
        """Stops the robot, and its use. A second call does nothing."""
        self.stop()
        self._entities.close()

    def __exit__(self, *exception):
        self.close()

    def __repr__(self):
        return f"<Robot {self._topics['commands']}>"

    def _send(self, linear, angular):
        self._require_open()
        linear, angular = Vector3(x=float(linear)), Vector3(z=float(angular))
        self._commands.publish(Twist(linear=linear, angular=angular))

    def _require_open(self):
        if self._entities.closed:
            raise RuntimeError("this Robot is closed; make a new one: Robot()")

    def _require_robot(self):
        self._require_open()
        is_new = self._commands is None
        if is_new:
            # Not before: the robot would warn of two publishers while another program drives it.
            publisher = self._entities.node.create_publisher(Twist, self._topics["commands"], 10)
            self._commands = self._entities.add(publisher)
        start = time.monotonic()
        while not self._entities.closed and not self._is_robot_there():
            waited = time.monotonic() - start
            is_room_starting = self._status().get("request", {}).get("source") == "room"
            if waited > TIMEOUT or (waited > ANSWER and not is_room_starting):
                raise RuntimeError(f"no robot answers on {self._topics['commands']}: {_START_ANY}")
            time.sleep(0.01)
        if is_new:
            # The robot notices this publisher a moment later, and would miss a command before.
            time.sleep(SETTLING)

    def _is_robot_there(self):
        """Whether one subscribes to the commands, and its process runs here or its odometry comes."""
        if not self._commands.get_subscription_count():
            return False
        # ROS lists the subscription of a robot that was killed for 20 s more.
        if self._is_of_the_room() and robot_runs(self._session.context.get_domain_id()):
            return True
        self._subscribe("odometry", Odometry)
        with self._change:
            arrival = self._messages.get("odometry", (-math.inf, None))[0]
        return self._session.is_spinning_thread() or time.monotonic() - arrival < FRESH

    def _status(self) -> dict[str, Any]:
        """What the robot process says of itself; empty without one."""
        return running_robot(self._session.context.get_domain_id()) if self._is_of_the_room() else {}

    def _is_of_the_room(self):
        return self._topics["commands"] == COMMANDS

    def _subscribe(self, name, message_type):
        if name not in self._subscribed:
            self._require_open()
            qos = qos_profile_sensor_data
            self._entities.subscribe(message_type, self._topics[name], qos, self._on_message, name)
            self._subscribed.add(name)

    def _newest(self, name, message_type):
        topic = self._topics[name]
        self._subscribe(name, message_type)
        with self._change:
            arrived = self._messages.get(name)
            if arrived is not None and time.monotonic() - arrived[0] < FRESH:
                return arrived[1]
            if self._session.is_spinning_thread():
                raise RuntimeError(f"no {name} can arrive while a ROS callback waits for it")
            # A restart forgets the messages meanwhile: no message is no newer one.
            if not self._change.wait_for(lambda: self._messages.get(name, arrived) is not arrived, TIMEOUT):
                raise TimeoutError(f"no {name} arrived on {topic} in {TIMEOUT:g} s: {_START_ANY}")
            return self._messages[name][1]

    def _on_message(self, name, msg, _):
        with self._change:
            self._messages[name] = (time.monotonic(), msg)
            self._change.notify_all()
