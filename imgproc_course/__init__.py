"""Image processing in ROS 2: the helper package of the course.

messages   sensor_msgs/Image <-> NumPy             imaging     the mathematics, by hand
recording  the recorded drive                      ros         a running graph
display    what a notebook shows                   exercises   what an answer is
grading    the teacher's wing                      cli         imgproc-course
"""


def __getattr__(name):
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    # Here, and not above: it takes longer to import than the rest of most rooms.
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("imgproc-course")  # pyproject.toml holds the one number
    except PackageNotFoundError:  # a copy of the folder beside a robot's own code
        return "0+unknown"
