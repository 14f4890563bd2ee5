"""A camera for a notebook: the recorded drive, the room or a webcam, on the topics of the robot's camera."""

import importlib
import logging
import math
import numbers
import os
import threading
import weakref
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from imgproc_course.ros.entities import Stoppable, weak_callback
from imgproc_course.ros.robot_process import SHAREABLE, RobotConnection, running_robot
from imgproc_course.ros.robot_topics import TOPIC, camera_topics, is_room_number
from imgproc_course.ros.session import RosSession

SOURCES = ("recording", "room", "webcam", "topic")
# The room, if nothing else is asked.
ROOM: dict[str, Any] = {"seed": 0, "size": (640, 360), "lighting": "day", "start": None, "room": None}
RATES = (30, 10)  # images per second of the room, up to this width in pixels and above
FAST_WIDTH = 640
robot_log = logging.getLogger("imgproc_course.ros.robot")  # the robot's warnings; display.drive shows them
ROBOT_MODULE = "imgproc_course.ros.robot_body"  # imported only in the process that publishes


def open_camera(
    source: str = "recording",
    *,
    topic: str = TOPIC,
    speed: float = 1.0,
    loop: bool = True,
    recording: str | Path = "drive",
    camera_topic: str | None = None,
    stamps: str = "now",
    seed: int | None = None,
    size: Sequence[int] | None = None,
    lighting: str | None = None,
    start: Sequence[float] | None = None,
    rate: float | None = None,
    room: int | None = None,
    switch: bool = False,
) -> "Camera":
    """Opens this machine's camera, which has the topics, headers and QoS of the robot's own camera.

    There is one camera for all your notebooks and programs in a ROS domain, as there is one on a robot. It
    publishes in a process of its own. The first `open_camera` starts it, each other joins it wherever its
    recording is, and it ends with the last program that uses it.

    Parameters
    ----------
    source : "recording"; "room" (a simulated robot, which can be driven through the room of the recorded
        drive or a furnished one: see `Robot`); "webcam" (the first camera of this machine); or "topic" (a
        robot already publishes, so nothing is published here)
    topic : name of the topic of raw images
    speed : factor on the recorded rate: 3.0 plays a drive of 10 Hz at 30 Hz
    loop : whether the recording starts again at its end
    recording : "drive", or the path of your own recording
    camera_topic : which topic of the recording is played; None as in `open_recording`
    stamps : "now", or "recorded" for the stamps of the recording (they jump back when it starts again)
    seed, size, lighting, start : of the room, as in `Simulation`; 0, (640, 360), "day", and the room's own
        start, if omitted
    rate : images per second of the room; 30 if omitted, 10 for images more than 640 pixels wide
    room : a whole number: the room with its furniture elsewhere, as `furnished` draws it from that number
    switch : if other programs use the camera in another way: True switches it for all of them

    Raises
    ------
    ValueError : an unknown source or stamps, a bad speed, topic name or option of the room
    RecordingError : the recording cannot be opened, or has no images on that topic
    RobotInUseError : other programs use the camera in another way; the text names them
    RuntimeError : no webcam answers, panda3d is missing for the room, or the camera's process does not start
    """
    _check_arguments(source, speed, stamps)
    options = {"seed": seed, "size": size, "lighting": lighting, "start": start, "rate": rate, "room": room}
    asked = {name: value for name, value in options.items() if value is not None}
    _check_room(source, asked)
    request: dict[str, Any] = {"source": source, "topic": RosSession.current().resolve_topic(topic)}
    if source == "recording":
        path = recording if recording == "drive" else Path(recording).absolute()
        request |= {"recording": str(path), "camera_topic": camera_topic, "speed": float(speed)}
        request |= {"loop": bool(loop), "stamps": stamps}
    if source == "room":
        request |= _room_request(**asked)
    return Camera(request, switch)


def _check_arguments(source, speed, stamps):
    if source not in SOURCES:
        raise ValueError(f"unknown source {source!r}; use 'recording', 'room', 'webcam' or 'topic'")
    if not (_is_number(speed) and speed > 0):
        raise ValueError(f"speed must be a positive number, got {speed!r}; 1.0 plays at the recorded rate")
    if source != "recording" and speed != 1.0:
        raise ValueError(f"speed {speed!r} with source {source!r}: only a recording can change its speed")
    if stamps not in ("now", "recorded"):
        raise ValueError(f"stamps must be 'now' or 'recorded', got {stamps!r}")


def _check_room(source, options):
    if source != "room" and options:
        name, value = next(iter(options.items()))
        raise ValueError(
            f"{name} {value!r} with source {source!r}: only the room, open_camera('room'), has it"
        )
    for name, count in (("size", 2), ("start", 3)):
        value = options.get(name, (0,) * count)
        if not (isinstance(value, (tuple, list)) and len(value) == count and all(map(_is_number, value))):
            expected = "(width, height)" if name == "size" else "(x, y, yaw) in metres and radians"
            raise ValueError(f"{name} must be {expected}, got {value!r}")
    rate = options.get("rate", 1)
    if not (_is_number(rate) and 1 <= rate <= 60):
        raise ValueError(f"rate must be 1 to 60 images per second, got {rate!r}")
    number = options.get("room", 0)
    if not is_room_number(number):
        raise ValueError(f"room must be a whole number from 0 on, such as 17, got {number!r}")


def _is_number(value):
    return isinstance(value, numbers.Real) and math.isfinite(value)


def _room_request(rate=None, **options):
    request = ROOM | options
    request["size"] = tuple(int(length) for length in request["size"])
    request["room"] = None if request["room"] is None else int(request["room"])
    if request["start"] is not None:
        request["start"] = tuple(float(value) for value in request["start"])
    return request | {"rate": float(rate or RATES[request["size"][0] > FAST_WIDTH])}


class Camera(Stoppable):
    """This program's use of the camera, until it is stopped: see `open_camera`.

    It ends with the RosSession too, and when no reference to it is left; but the newest one is kept.
    """

    _newest: "Camera | None" = None  # keeps a camera that is bound to no name

    def __init__(self, request: dict[str, Any], switch: bool = False):
        self._ended = threading.Event()
        self._connection = _connect(request, switch, weak_callback(self._on_event))
        self._status = {"topic": request["topic"]}
        if self._connection is not None:
            session = RosSession.current()
            session.on_shutdown(self._connection, self._connection.leave)
            weakref.finalize(self, self._connection.leave_soon).atexit = False
            Camera._newest = self

    def _on_event(self, text, status):
        if text and Camera._newest in (self, None):  # once for the whole program
            robot_log.warning("%s", text)
        if status["running"]:
            self._ended.clear()
        else:
            self._ended.set()

    def _now(self):
        if self._connection is not None:
            self._status = self._connection.ask()
        return self._status

    @property
    def description(self) -> str | None:
        """What the camera is, for people: what it plays, at which rate, on which topic."""
        return self._now().get("description")

    @property
    def topic(self) -> str:
        """The topic of sensor_msgs/Image, rgb8."""
        return self._now()["topic"]

    @property
    def compressed_topic(self) -> str:
        """The topic of sensor_msgs/CompressedImage of the same images."""
        return camera_topics(self.topic)[0]

    @property
    def info_topics(self) -> tuple[str, str]:
        """The topics of the camera info beside the raw image, and beside the compressed one."""
        return camera_topics(self.topic)[1]

    @property
    def rate(self) -> float | None:
        """Intended images per second; None for a robot, and for a webcam that does not know its rate."""
        return self._now().get("rate")

    @property
    def played(self) -> int:
        """Images that were due since the camera was started."""
        return self._now().get("played", 0)

    @property
    def published(self) -> int:
        """Raw images that were sent; without a subscriber none is sent."""
        return self._now().get("published", 0)

    @property
    def last_error(self) -> str | None:
        """Why the camera stopped by itself, in one line; None otherwise."""
        return self._now().get("last_error")

    @property
    def bumps(self) -> int | None:
        """How often the robot in the room has touched something; None for other sources."""
        return self._now().get("bumps")

    @property
    def other_users(self) -> list[str]:
        """The other programs that use it: `<program> (pid <pid>)`."""
        return [str(user) for user in self._now().get("users", ()) if user.pid != os.getpid()]

    @property
    def running(self) -> bool:
        """Whether the camera publishes: False after `stop`, and after the end of a recording without loop."""
        return self._connection is not None and not self._connection.left and self._now()["running"]

    def stop(self) -> None:
        """Stops using the camera; it ends with its last user. A second call does nothing."""
        if self._connection is not None:
            self._connection.leave()
            RosSession().on_shutdown(self._connection, None)
            self._ended.set()
        if Camera._newest is self:
            Camera._newest = None

    def wait(self, timeout: float | None = None) -> bool:
        """Waits for the end of a recording without loop. Returns True if it has ended."""
        if self.running:
            self._ended.wait(timeout)
        return not self.running

    def __repr__(self):
        rate = "" if self.rate is None else f" at {self.rate:g} Hz"
        state = ", stopped" if rate and not self.running else ""
        return f"<Camera {self.topic}{rate}{state}>"

    def subscribers(self) -> dict[str, int]:
        """How many subscribers each topic of the robot has, in all programs: {topic: count}."""
        return self._now()["subscribers"] if self.running else {}


def _connect(request, switch, on_event):
    """A connection to the robot; None if nothing of ours publishes the topic of another node."""
    if not SHAREABLE:
        return _OwnRobot(request, on_event)
    domain = RosSession.current().context.get_domain_id()
    if request["source"] == "topic" and running_robot(domain).get("topic") != request["topic"]:
        return None
    return RobotConnection(domain, ROBOT_MODULE, request, switch=switch, on_event=on_event)


class _OwnRobot:
    """The robot of this program alone, in place of a RobotConnection where programs cannot share one."""

    def __init__(self, request, on_event):
        self.left = False
        self._body = importlib.import_module(ROBOT_MODULE).open_body(request)
        self._body.start(lambda: on_event(None, self._body.status()))

    def ask(self):
        return self._body.status() | {"description": self._body.description}

    def leave(self):
        self.left = True
        self._body.stop()

    leave_soon = leave
