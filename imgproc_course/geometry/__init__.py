"""From pixels to the room: camera model, poses, planes. Pure NumPy.

Frames follow ROS: a body or the map has x forward, y left, z up; a camera's optical frame has x right,
y down, z forward. Lengths in metres, angles in radians. Sums are written out: a matrix product of BLAS
differs in the last bit between processors, these do not. What needs a singular value decomposition
(homography, homography_pose, rigid_motion) agrees to rounding only.
"""

from .camera_model import CameraModel
from .planes import homography, homography_pose, triangle_planes
from .poses import Pose, ate, rigid_motion

__all__ = ["CameraModel", "Pose", "ate", "homography", "homography_pose", "rigid_motion", "triangle_planes"]
