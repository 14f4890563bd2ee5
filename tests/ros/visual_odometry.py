"""The node of the lesson "Where am I?", as a program of its own: what the lesson defines, and no more.

    python tests/ros/visual_odometry.py SECONDS     ends after so many seconds of the robot's stamps

It takes the imports, functions and classes of the lesson's master, and the numbers that they read. It sees
published topics alone: image, camera info, depth, and the odometry at its start. At its end it prints how
often it looked.
"""

import sys

import numpy as np
from lesson_nodes import lesson_definitions, looked_for, spin

from imgproc_course.geometry import Pose

MOUNT = Pose(np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]]), np.array([0.21, 0, 0.20]))  # camera on robot


def where_am_i():
    return lesson_definitions("where_am_i", mount=MOUNT, detector=None)


if __name__ == "__main__":
    spin(where_am_i()["VisualOdometryNode"], looked_for(float(sys.argv[1])), lambda node: node.looks)
