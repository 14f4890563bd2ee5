"""The node of the lesson "Faces", as a program of its own: what the lesson defines, and no more.

    python tests/ros/anonymiser.py TOPIC     runs until Ctrl-C

It sees the images of TOPIC alone, and publishes them with hidden faces. At its end it prints how many images
it has published, and how many faces it has found.
"""

import sys

from lesson_nodes import lesson_definitions, run_assignments, spin


def faces():
    """The lesson's functions and classes, and the detector that its cells open."""
    needed = {"HAAR_FOLDER", "HAAR_FILE", "HAS_HAAR", "haar"}
    return run_assignments("faces", needed, lesson_definitions("faces"))


if __name__ == "__main__":
    lesson = faces()
    spin(
        lambda: lesson["AnonymiserNode"](lesson["find_faces"], lesson["paint_over"], topic=sys.argv[1]),
        lambda node: False,
        lambda node: f"{node.frames} {node.faces}",
    )
