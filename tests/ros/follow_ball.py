"""The node of the lesson "Object tracking", as a program of its own: what the lesson defines, and no more.

    python tests/ros/follow_ball.py SECONDS     ends after so many seconds of the robot's stamps

It takes the imports, functions and classes of the lesson's master, and the numbers that they read. It sees
published topics alone. At its end it prints how often it looked.
"""

import sys

import cv2
import numpy as np
from lesson_nodes import lesson_definitions, looked_for, spin


def ball_histogram():
    """The weights of 18 bins of the hue that the lesson computes from the drive's first frame."""
    from imgproc_course.recording import open_recording

    recording = open_recording("drive")
    hsv = cv2.cvtColor(recording.frame(0)[::2, ::2].copy(), cv2.COLOR_BGR2HSV)
    col, row, width, height = cv2.boundingRect((recording.labels(0)[::2, ::2] == 9).astype(np.uint8))
    patch = hsv[row : row + height, col : col + width]
    counts = np.bincount(patch[patch[:, :, 1] > 140][:, 0] // 10, minlength=18)
    return (255 * counts / counts.max()).astype(np.uint8)


if __name__ == "__main__":
    lesson = lesson_definitions("object_tracking", weights=ball_histogram())
    spin(lesson["FollowNode"], looked_for(float(sys.argv[1])), lambda node: node.looks)
