"""The node of the lesson "Mapping and SLAM", as a program of its own: what the lesson defines, and no more.

    python tests/ros/mapping.py     runs until Ctrl-C

It takes the imports, functions and classes of the lesson's master, and the numbers that they read. It sees
published topics alone: scan and odometry. At its end it prints how many scans it has seen, how many keyframes
it has, and how many loops it has closed.
"""

import numpy as np
from lesson_nodes import lesson_definitions, spin


def mapping_and_slam():
    return lesson_definitions("mapping_and_slam", cell_size=0.05, corner=np.array([-1.5, -2.7]))


def counts(node):
    return node.looks, len(node.mapper.poses), len(node.mapper.loops)


if __name__ == "__main__":
    spin(mapping_and_slam()["MappingNode"], lambda node: False, lambda node: "{} {} {}".format(*counts(node)))
