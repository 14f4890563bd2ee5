"""What the course tells the classroom; nothing else in the classroom names a package of the course."""

NAME = "imgproc_course"
# Packages that an exercise may allow in its answers.
PACKAGES = ("messages", "imaging", "geometry", "recording", "simulation", "ros")
# Every answer may use these.
ALWAYS_ALLOWED = (f"{NAME}.display", f"{NAME}.exercises")
# What these give differs from run to run: they have to do with a running robot or with a screen.
LIVE_MODULES = ("rclpy", f"{NAME}.ros", f"{NAME}.display")
# What node exercises import: message packages of ROS, and cv_bridge, for which this stands if it is missing.
ROS_MESSAGES = ("builtin_interfaces", "rcl_interfaces", "sensor_msgs", "std_msgs")
CV_BRIDGE = f"{NAME}.messages.cv_bridge"
