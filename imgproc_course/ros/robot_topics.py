"""The robot's topics beside those of its camera, with the names that the real robot's bridge gives them."""

COMMANDS = "/kachaka/manual_control/cmd_vel"
ENABLED = "/kachaka/manual_control/set_enabled"
ODOMETRY = "/kachaka/odometry/odometry"
WHEEL_ODOMETRY = "/kachaka/wheel_odometry/wheel_odometry"
SCAN = "/kachaka/lidar/scan"
TOF = "/kachaka/tof_camera"
ROOM_NODE = "room"  # of the simulated robot alone: its parameters
