"""Image processing in ROS 2: the Python package of the course.

messages    sensor_msgs/Image <-> NumPy      imaging     the mathematics, by hand
recording   the recorded drive               ros         a running graph
simulation  the room, without ROS            geometry    from pixels to the room
display     what a notebook shows            exercises   what lessons import of nbclassroom
cli         the command imgproc-course       doctor      checks of the machine
"""


def __getattr__(name):
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    # Imported here: it takes longer than importing most of our packages.
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("imgproc-course")  # the only version number is in pyproject.toml
    except PackageNotFoundError:  # a copy of the folder in a robot's own code
        return "0+unknown"
