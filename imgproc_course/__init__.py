"""Image processing in ROS 2: the helper package of the course.

messages   sensor_msgs/Image <-> NumPy             imaging     the mathematics, by hand
recording  the recorded drive                      ros         a running graph
display    what a notebook shows                   exercises   what an answer is
grading    the teacher's wing                      cli         imgproc-course
"""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("imgproc-course")  # pyproject.toml holds the one number
except PackageNotFoundError:  # a copy of the folder beside a robot's own code
    __version__ = "0+unknown"
