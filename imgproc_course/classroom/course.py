"""What the course tells the classroom; nothing else in the classroom names a package of the course."""

NAME = "imgproc_course"
TITLE = "Image processing in ROS 2"
# Packages that an exercise may allow in its answers.
PACKAGES = ("messages", "imaging", "geometry", "recording", "simulation", "ros")
# What nobody's answer may read there: a controller in grading must see the room with its sensors.
HIDDEN_FOLDERS = ("simulation/room",)
# Every answer may use these.
ALWAYS_ALLOWED = (f"{NAME}.display", f"{NAME}.exercises")
# Modules that only show something, such as a progress bar: every answer may use them, and in grading a silent
# one stands in their place.
DISPLAY_ONLY = ("tqdm", "rich", "ipywidgets", "alive_progress", "progressbar", "seaborn", "plotly")
# What a node may import: rclpy, these packages of messages, and cv_bridge, or what stands for it.
ROS_MESSAGES = ("builtin_interfaces", "rcl_interfaces", "sensor_msgs", "std_msgs")
NODE_MODULES = ("rclpy", *ROS_MESSAGES, "cv_bridge")
CV_BRIDGE = f"{NAME}.messages.cv_bridge"
# What a driving exercise drives in: a Gymnasium environment, what of its observation a controller gets, the
# room of a scenario, and a map of it with the path. They are imported when a drive begins.
DRIVE_ENVIRONMENT = f"{NAME}.simulation.room_env:RoomEnv"
DRIVE_OBSERVATION = f"{NAME}.simulation.room_env:controller_observation"
DRIVE_ROOM = f"{NAME}.simulation.furnished:room_of"
DRIVE_MAP = f"{NAME}.simulation.room_map:draw_map"
# The list of functions that give advice on an error of a learner's function, wherever it is called.
ERROR_ADVISERS = f"{NAME}.learner_errors:advisers"
# The league: the scenario of a room by two secret numbers, what a drive in it is worth, and the packages that
# a controller may use.
LEAGUE_SCENARIO = f"{NAME}.simulation.exploration:scenario_of"
LEAGUE_SCORE = f"{NAME}.simulation.exploration:exploration_score"
LEAGUE_ALLOWED = ("cv2", "scipy", "rapidocr", f"{NAME}.geometry", f"{NAME}.imaging", f"{NAME}.messages")
