"""A running ROS 2 graph in a notebook: cameras, subscribers, nodes, and the session that spins them.

Importing this package chooses the Fast DDS profile (unless you set one). The import never fails: without
ROS, `ros_available()` is False, and everything that needs a graph raises RosMissingError with the remedy.
"""

import functools
import logging
from pathlib import Path
from typing import TYPE_CHECKING

from imgproc_course.ros.availability import (
    RosMissingError,
    class_stub,
    import_problem,
    refuse_to_run,
    say_what_is_skipped,
)
from imgproc_course.ros.numeric_parameter import NumericParameter
from imgproc_course.ros.profile import DdsProfile, choose_profile
from imgproc_course.ros_domain import choose_domain

# Before rclpy is imported: the middleware reads its profile only once in a process.
_profile = choose_profile()
choose_domain(logging.getLogger(__name__).warning)
_problem = import_problem()

if TYPE_CHECKING or _problem is None:
    from imgproc_course.ros.camera import Camera, open_camera
    from imgproc_course.ros.node_process import run_processor
    from imgproc_course.ros.processor import ImageProcessor
    from imgproc_course.ros.robot import Robot
    from imgproc_course.ros.robot_process import RobotInUseError
    from imgproc_course.ros.session import RosSession
    from imgproc_course.ros.subscriber import ImageSubscriber

    if TYPE_CHECKING:
        from imgproc_course.ros.recorder import Recorder
else:
    Camera, ImageProcessor, ImageSubscriber, Robot, RosSession, open_camera = (
        class_stub(name, _problem)
        for name in ("Camera", "ImageProcessor", "ImageSubscriber", "Robot", "RosSession", "open_camera")
    )
    RobotInUseError = RosMissingError  # so that `except RobotInUseError` is no mistake
    run_processor = functools.partial(refuse_to_run, _problem)


def ros_available() -> bool:
    """Whether a ROS graph can run here; a notebook without one says once what its cells then do."""
    if _problem is not None:
        say_what_is_skipped()
    return _problem is None


def ros_problem() -> str | None:
    """Why no ROS graph can run here, with the remedy, in one line; None if one can run."""
    return _problem


def dds_profile() -> DdsProfile:
    """The Fast DDS profile that this process uses; its `str()` is one readable line."""
    return _profile


def record(topics: str | list[str] | None = None, path: str | Path = "my_drive") -> "Recorder":
    """Records topics into a new recording in MCAP, until it is stopped: see `Recorder`, which it returns."""
    if _problem is not None:
        raise RosMissingError(_problem)
    # Not before: what reads and writes recordings takes a while to import.
    from imgproc_course.ros.recorder import Recorder

    return Recorder(topics, path)


__all__ = [
    "Camera",
    "DdsProfile",
    "ImageProcessor",
    "ImageSubscriber",
    "NumericParameter",
    "Robot",
    "RobotInUseError",
    "RosMissingError",
    "RosSession",
    "dds_profile",
    "open_camera",
    "record",
    "ros_available",
    "ros_problem",
    "run_processor",
]
