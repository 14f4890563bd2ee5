"""A node that drives the robot by the depth image alone: straight on, and a stop before what is in its way.

It drives until it has stood still for a second of messages, prints the distance that it measures, and ends.
"""

import math

import cv2
import numpy as np
from geometry_msgs.msg import Twist, Vector3
from lesson_nodes import spin
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image

from imgproc_course.messages import image_to_array

CAMERA = "/kachaka/front_camera"
CAMERA_HEIGHT = 0.20  # m above the floor
HALF_WIDTH = 0.16  # m: the robot's, and 4 cm
SPEED = 0.3  # m/s
STOP_AHEAD = 0.45  # m before the camera: what is as high as a book can still be seen there
STANDING = 20  # messages in a row at which the robot is told to stand


class BrakeByDepth(Node):
    """Decides on each message, and says so; without messages the robot stops by itself."""

    def __init__(self):
        super().__init__("brake_by_depth")
        self._commands = self.create_publisher(Twist, "/kachaka/manual_control/cmd_vel", 10)
        for kind, topic, callback in (
            (CameraInfo, f"{CAMERA}/camera_info", self._on_camera_info),
            (Image, f"{CAMERA}/depth", self._on_depth),
        ):
            self.create_subscription(kind, topic, callback, qos_profile_sensor_data)
        self._lens = self._rays = self.distance = None
        self.standing = 0

    def _on_camera_info(self, msg):
        self._lens = np.reshape(msg.k, (3, 3)), np.array(msg.d)

    def _on_depth(self, msg):
        if self._lens is None:
            return
        depth = image_to_array(msg) / 1000
        if self._rays is None:
            col, row = np.meshgrid(
                np.arange(msg.width, dtype=np.float32), np.arange(msg.height, dtype=np.float32)
            )
            pixels = np.stack([col, row], -1).reshape(-1, 1, 2)
            self._rays = cv2.undistortPoints(pixels, *self._lens).reshape(*depth.shape, 2)
        right, down = self._rays[..., 0] * depth, self._rays[..., 1] * depth
        height = CAMERA_HEIGHT - down
        in_the_way = (np.abs(right) < HALF_WIDTH) & (height > 0.03) & (height < 0.15)
        depths = np.sort(depth[in_the_way & (depth > 0)])
        self.distance = float(depths[20]) if len(depths) > 20 else math.inf
        free = self.distance - STOP_AHEAD
        speed = 0.0 if free < 0.01 else min(SPEED, 0.08 + free)
        self._commands.publish(Twist(linear=Vector3(x=speed)))
        self.standing = 0 if speed else self.standing + 1


if __name__ == "__main__":
    spin(BrakeByDepth, lambda node: node.standing > STANDING, lambda node: node.distance)
