"""The topics and frames of the course's recording."""

CAMERA = "/kachaka/front_camera/image_raw/compressed"
CAMERA_INFO = "/kachaka/front_camera/camera_info"
DEPTH = "/truth/depth"
LABELS = "/truth/labels"
SCENE = "/truth/scene"  # one std_msgs/String, JSON: label names, the fiducial marker, how it was made
POSE_PREFIX = "/truth/pose/"
POSES = ("camera", "person", "ball", "toycar", "marker")
CAMERA_FRAME = "camera_front"
WORLD_FRAME = "world"
