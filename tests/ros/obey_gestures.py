"""The node of the lesson "Gestures", as a program of its own: what the lesson defines, and no more.

    python tests/ros/obey_gestures.py     ends with Ctrl-C

It sees published topics alone: the images of a hand, and the robot's odometry. At its end it prints how often
it looked.
"""

from lesson_nodes import lesson_definitions, run_assignments, spin


def gestures():
    """The lesson's functions and classes, and the tracks that it compares with."""
    needed = {"recording", "background", "references", "FARTHEST"}
    return run_assignments("gestures", needed, lesson_definitions("gestures"))


if __name__ == "__main__":
    lesson = gestures()
    spin(
        lambda: lesson["GestureNode"](lesson["fingers_of"], lesson["gesture_of"]),
        lambda node: False,
        lambda node: node.looks,
    )
