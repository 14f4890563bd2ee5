"""Nodes that drive the robot by what its sensors publish, and by nothing else; each is a program of its own.

    python tests/ros/closed_loop_nodes.py depth     straight on, and a stop before what the depth image shows
    python tests/ros/closed_loop_nodes.py scan      the same by the laser scan
    python tests/ros/closed_loop_nodes.py marker    to the marker on the wall, by the camera's image alone

Each drives until it has stood still for a second of messages, prints the distance that it measures, and ends.
"""

import math
import sys

import cv2
import numpy as np
from geometry_msgs.msg import Twist, Vector3
from lesson_nodes import spin
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image, LaserScan

from imgproc_course.messages import image_to_array

CAMERA = "/kachaka/front_camera"
CAMERA_HEIGHT = 0.20  # m above the floor
HALF_WIDTH = 0.16  # m: the robot's, and 4 cm
SPEED = 0.3  # m/s
STOP_AHEAD = 0.45  # m before the camera: what is as high as a book can still be seen there
MARKER, SIDE, MARKER_STOP = 12, 0.25, 1.0  # its id; its side and the distance to keep, in metres
STANDING = 20  # messages in a row at which the robot is told to stand


class Loop(Node):
    """Decides on each message, and says so; without messages the robot stops by itself."""

    def __init__(self, name, message_type, topic):
        super().__init__(f"brake_by_{name}" if name != "marker" else "go_to_marker")
        self._commands = self.create_publisher(Twist, "/kachaka/manual_control/cmd_vel", 10)
        self.create_subscription(message_type, topic, self._on_message, qos_profile_sensor_data)
        self.standing, self._has_moved = 0, False
        self.distance = None

    def _on_message(self, msg):
        decision = self.decide(msg)
        if decision is None:
            return
        linear, angular = decision
        self._commands.publish(Twist(linear=Vector3(x=linear), angular=Vector3(z=angular)))
        is_standing = linear == 0 and angular == 0
        self.standing = self.standing + 1 if is_standing else 0


class CameraLoop(Loop):
    """Waits for the camera's matrix and distortion."""

    def __init__(self, name, topic):
        super().__init__(name, Image, topic)
        self.matrix = self.distortion = None
        self.create_subscription(
            CameraInfo, f"{CAMERA}/camera_info", self._on_camera_info, qos_profile_sensor_data
        )

    def _on_camera_info(self, msg):
        self.matrix, self.distortion = np.reshape(msg.k, (3, 3)), np.array(msg.d)


class BrakeByDepth(CameraLoop):
    def __init__(self):
        super().__init__("depth", f"{CAMERA}/depth")
        self._rays = None

    def decide(self, msg):
        if self.matrix is None:
            return None
        depth = image_to_array(msg) / 1000
        if self._rays is None:
            col, row = np.meshgrid(
                np.arange(msg.width, dtype=np.float32), np.arange(msg.height, dtype=np.float32)
            )
            pixels = np.stack([col, row], -1).reshape(-1, 1, 2)
            self._rays = cv2.undistortPoints(pixels, self.matrix, self.distortion).reshape(*depth.shape, 2)
        right, down = self._rays[..., 0] * depth, self._rays[..., 1] * depth
        in_the_way = (
            (np.abs(right) < HALF_WIDTH) & (CAMERA_HEIGHT - down > 0.03) & (CAMERA_HEIGHT - down < 0.15)
        )
        depths = np.sort(depth[in_the_way & (depth > 0)])
        self.distance = float(depths[20]) if len(depths) > 20 else math.inf
        return brake(self.distance - STOP_AHEAD), 0.0


class BrakeByScan(Loop):
    def __init__(self):
        super().__init__("scan", LaserScan, "/kachaka/lidar/scan")

    def decide(self, msg):
        # The scanner is turned to the left by 90 degrees, 5 cm behind the camera.
        angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment + math.pi / 2
        ranges = np.array(msg.ranges)
        with np.errstate(invalid="ignore"):
            ahead, left = ranges * np.cos(angles), ranges * np.sin(angles)
        in_the_way = np.isfinite(ranges) & (np.abs(left) < HALF_WIDTH) & (ahead > 0)
        self.distance = float(ahead[in_the_way].min(initial=math.inf)) - 0.05
        return brake(self.distance - STOP_AHEAD), 0.0


class GoToMarker(CameraLoop):
    def __init__(self):
        super().__init__("marker", f"{CAMERA}/image_raw")
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
        self._detector = cv2.aruco.ArucoDetector(dictionary)
        half = SIDE / 2
        self._corners = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]])

    def decide(self, msg):
        if self.matrix is None:
            return None
        corners, ids, _ = self._detector.detectMarkers(image_to_array(msg, "mono8"))
        numbers = [] if ids is None else ids.ravel().tolist()
        if MARKER not in numbers:
            return 0.0, 0.4  # look for it
        _, _, position = cv2.solvePnP(
            self._corners,
            corners[numbers.index(MARKER)][0],
            self.matrix,
            self.distortion,
            flags=cv2.SOLVEPNP_IPPE_SQUARE,
        )
        right, _, ahead = position.ravel()
        self.distance = float(ahead)
        angular = -1.5 * math.atan2(right, ahead)
        linear = brake(ahead - MARKER_STOP)
        return linear, angular if linear else 0.0


def brake(free):
    """The speed for so many metres of free way: 0 at its end, and before it as slow as is needed to stop."""
    return 0.0 if free < 0.01 else min(SPEED, 0.08 + free)


if __name__ == "__main__":
    nodes = {"depth": BrakeByDepth, "scan": BrakeByScan, "marker": GoToMarker}
    spin(nodes[sys.argv[1]], lambda node: node.standing > STANDING, lambda node: node.distance)
