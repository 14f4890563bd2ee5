"""The node of the lesson "Recognising objects", as a program of its own, with what the lesson defines.

    python tests/ros/object_recogniser.py SECONDS     ends after so many seconds of the robot's stamps

It learns from the recorded drive as the lesson does. In the room it sees published topics alone: image,
camera info, depth and odometry. At its end it prints how often it looked.
"""

import sys

from lesson_nodes import lesson_definitions, looked_for, run_assignments, spin


def recognising_objects():
    """The lesson's functions and classes, and what its cells compute for them: crops, weights, limits."""
    needed = {
        "recording",
        "CLASSES",
        "thing_names",
        "train_crops",
        "train_classes",
        "train",
        "model",
        "weights",
    }
    needed |= {"bias", "FARTHEST", "JUMP", "SMALLEST", "WIDEST", "SURE", "mount"}
    return run_assignments("recognising_objects", needed, lesson_definitions("recognising_objects"))


if __name__ == "__main__":
    lesson = recognising_objects()
    spin(
        lambda: lesson["ObjectsNode"](lesson["class_of"]),
        looked_for(float(sys.argv[1])),
        lambda node: node.looks,
    )
