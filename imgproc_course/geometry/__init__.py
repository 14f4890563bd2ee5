"""From pixels to the room: camera model, poses, planes. Pure NumPy.

Frames follow ROS: a body or the map has x forward, y left, z up; a camera's optical frame has x right,
y down, z forward. Lengths in metres, angles in radians. Sums are written out: a matrix product of BLAS
differs in the last bit between processors, these do not.
"""

from .camera_model import CameraModel
from .planes import triangle_planes
from .poses import Pose

__all__ = ["CameraModel", "Pose", "triangle_planes"]
