"""The robot's topics, with the names that the real robot's bridge gives them."""

import numbers

TOPIC = "/kachaka/front_camera/image_raw"
COMMANDS = "/kachaka/manual_control/cmd_vel"
ENABLED = "/kachaka/manual_control/set_enabled"
ODOMETRY = "/kachaka/odometry/odometry"
WHEEL_ODOMETRY = "/kachaka/wheel_odometry/wheel_odometry"
SCAN = "/kachaka/lidar/scan"
TOF = "/kachaka/tof_camera"
ROOM_NODE = "room"  # of the simulated robot alone: its parameters


def camera_topics(topic: str) -> tuple[str, tuple[str, str]]:
    """The topics beside the raw images: (compressed, (camera info, camera info of the compressed images))."""
    return f"{topic}/compressed", (f"{topic.rpartition('/')[0]}/camera_info", f"{topic}/camera_info")


def is_room_number(value, least=0):
    """Whether it is the number of a furnished room that a ROS parameter can have."""
    is_whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    return is_whole and least <= value < 2**63
