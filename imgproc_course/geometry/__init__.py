"""From pixels to the room: camera model, poses, planes, grids, routes. NumPy; for routes also skimage.

Frames follow ROS: a body or the map has x forward, y left, z up; a camera's optical frame has x right,
y down, z forward. Lengths in metres, angles in radians. Sums are written out: a matrix product of BLAS
differs in the last bit between processors, these do not. What needs a singular value decomposition
(homography, homography_pose, rigid_motion) agrees to rounding only.
"""

from .camera_model import CameraModel
from .driving import choose_direction, free_way, map_to_odom, safe_speed
from .grids import grid_precision_recall, grid_ray, log_odds, probability, update_grid
from .local_map import LocalMap
from .planes import homography, homography_pose, triangle_planes
from .pose_graph import compose_poses, optimize_pose_graph, relative_pose, wrap_angle
from .poses import Pose, ate, rigid_motion

__all__ = [
    "CameraModel",
    "LocalMap",
    "Pose",
    "ate",
    "choose_direction",
    "compose_poses",
    "free_way",
    "grid_precision_recall",
    "grid_ray",
    "homography",
    "homography_pose",
    "log_odds",
    "map_to_odom",
    "optimize_pose_graph",
    "probability",
    "relative_pose",
    "rigid_motion",
    "safe_speed",
    "triangle_planes",
    "update_grid",
    "wrap_angle",
]
