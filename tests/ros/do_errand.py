"""The node of the lesson "The errand", as a program of its own: what the lesson defines, and no more.

    python tests/ros/do_errand.py     ends when the errand is done, or with Ctrl-C

It sees published topics alone: image, depth, scan and odometry. At its end it prints one line, separated by
tabs: how often it looked, the tasks that are done, where it believes to be (x, y, yaw), and the name that it
has read, or nothing.
"""

from lesson_nodes import lesson_definitions, run_assignments, spin

from imgproc_course.simulation import Simulation


def the_errand():
    """The lesson's functions and classes, and what its cells compute for them: detector, network, places."""
    constants = {"START", "LOOKOUT", "NAMES", "VOTES", "LIMIT", "REACTION", "WIDTH", "FRONT", "MARGIN"}
    places = run_assignments("the_errand", constants, {})  # the definitions read them
    needed = {"settings", "detector", "square", "camera_axes", "mount", "reader", "course_parts"}
    return run_assignments("the_errand", needed, lesson_definitions("the_errand", **places))


def result(node):
    errand = node.errand
    tasks = ",".join(task for task, _ in errand.diary)
    x, y, yaw = errand.place.pose
    return f"{node.looks}\t{tasks}\t{x:.2f} {y:.2f} {yaw:.2f}\t{errand.name or ''}"


if __name__ == "__main__":
    lesson = the_errand()
    markers = lesson["flat_markers"](Simulation())
    errand = lesson["Errand"](markers, lesson["read_with_places"], lesson["course_parts"])
    spin(
        lambda: lesson["ErrandNode"](errand),
        lambda node: node.errand.task == node.errand.finished,
        result,
    )
