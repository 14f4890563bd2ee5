"""A running ROS 2 graph in a notebook: the camera, a subscriber, and the session that they share.

Importing this chooses the Fast DDS profile (unless you set one), and never fails: where ROS is missing,
`ros_available()` is False, and what needs a graph raises RosMissingError, which says what to install.
"""

from imgproc_course.ros.missing import RosMissingError, import_problem, stand_in, stand_in_main
from imgproc_course.ros.profile import DdsProfile, choose_profile
from imgproc_course.ros.setting import Setting

# Before rclpy is imported: the middleware reads its profile once in the life of a process.
_profile = choose_profile()
_problem = import_problem()

if _problem is None:
    from imgproc_course.ros.camera import Camera, open_camera
    from imgproc_course.ros.processor import ImageProcessor, run_processor
    from imgproc_course.ros.session import RosSession
    from imgproc_course.ros.subscriber import ImageSubscriber
else:
    Camera, ImageSubscriber, RosSession, open_camera = (
        stand_in(name, _problem) for name in ("Camera", "ImageSubscriber", "RosSession", "open_camera")
    )
    ImageProcessor, run_processor = stand_in("ImageProcessor", _problem), stand_in_main(_problem)


def ros_available():
    """Whether a ROS graph can run here."""
    return _problem is None


def ros_problem():
    """Why no ROS graph can run here, with the remedy, in one line; None where one can."""
    return _problem


def dds_profile():
    """The Fast DDS profile in force in this process: a DdsProfile, whose `str()` is one line for people."""
    return _profile


__all__ = [
    "Camera",
    "DdsProfile",
    "ImageProcessor",
    "ImageSubscriber",
    "RosMissingError",
    "RosSession",
    "Setting",
    "dds_profile",
    "open_camera",
    "ros_available",
    "ros_problem",
    "run_processor",
]
