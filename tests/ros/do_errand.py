"""The node of the lesson "The errand", as a program of its own.

    python tests/ros/do_errand.py     ends when the errand is done, or with Ctrl-C

It sees published topics alone: image, depth, scan and odometry. At its end it prints one line, separated by
tabs: how often it looked, the tasks that are done, where it believes to be (x, y, yaw), and the name that it
has read, or nothing.
"""

import sys
from pathlib import Path

from lesson_nodes import spin

from imgproc_course.simulation import Simulation

sys.path.append(str(Path(__file__).parents[2] / "notebooks"))
from the_errand import Errand, ErrandNode, course_parts, flat_markers, read_with_places


def result(node):
    errand = node.errand
    tasks = ",".join(task for task, _ in errand.diary)
    x, y, yaw = errand.place.pose
    return f"{node.looks}\t{tasks}\t{x:.2f} {y:.2f} {yaw:.2f}\t{errand.name or ''}"


if __name__ == "__main__":
    errand = Errand(flat_markers(Simulation()), read_with_places, course_parts)
    spin(lambda: ErrandNode(errand), lambda node: node.errand.task == node.errand.finished, result)
