"""The node of the lesson "Object tracking", as a program of its own: what the lesson defines, and no more.

    python tests/ros/follow_ball.py SECONDS     ends after so many seconds of the robot's stamps

It takes the imports, functions and classes of the lesson's master, and the numbers that they read; no cell
that opens a camera runs. It sees published topics alone. At its end it prints how often it looked.
"""

import ast
import sys
from pathlib import Path

import cv2
import numpy as np

from imgproc_course.authoring.masters import read_master
from imgproc_course.ros import dds_profile  # chooses the profile, before rclpy is imported

MASTER = Path(__file__).parents[2] / "notebooks" / "masters" / "13_object_tracking.py"
DEFINITIONS = ast.Import | ast.ImportFrom | ast.FunctionDef | ast.ClassDef


def lesson_definitions():
    """The names that the lesson's cells define; of `if ros_available():`, what stands in it."""
    names = {"weights": ball_histogram()}
    for cell in read_master(MASTER).cells:
        if cell.kind != "code" or cell.role not in ("", "given"):
            continue
        for node in ast.parse(cell.source).body:
            inner = node.body if isinstance(node, ast.If) else [node]
            definitions = [statement for statement in inner if isinstance(statement, DEFINITIONS)]
            exec(compile(ast.Module(definitions, []), cell.id, "exec"), names)
    return names


def ball_histogram():
    """The weights of 18 bins of the hue that the lesson computes from the drive's first frame."""
    from imgproc_course.recording import open_recording

    recording = open_recording("drive")
    hsv = cv2.cvtColor(recording.frame(0)[::2, ::2].copy(), cv2.COLOR_BGR2HSV)
    col, row, width, height = cv2.boundingRect((recording.labels(0)[::2, ::2] == 9).astype(np.uint8))
    patch = hsv[row : row + height, col : col + width]
    counts = np.bincount(patch[patch[:, :, 1] > 140][:, 0] // 10, minlength=18)
    return (255 * counts / counts.max()).astype(np.uint8)


def main():
    lesson = lesson_definitions()
    import rclpy

    rclpy.init()
    node = lesson["FollowNode"]()
    first = newest = None
    try:
        while rclpy.ok() and (first is None or newest - first < float(sys.argv[1])):
            rclpy.spin_once(node, timeout_sec=1.0)
            if node.looks:
                stamp = node.image.header.stamp
                newest = stamp.sec + stamp.nanosec / 1e9
                first = newest if first is None else first
    except KeyboardInterrupt:
        pass
    finally:
        print(node.looks, flush=True)
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    print(f"{dds_profile()}", file=sys.stderr)
    main()
