"""Depth and labels of an image of triangle numbers, exact along each pixel's ray through the lens."""

import numpy as np

from ..geometry.poses import rotate
from .room_model import NO_JOINT

UNSEEN = -2


class TriangleDepth:
    """For one camera: the pixel of the drawn image that each ray meets, and how deep its triangle lies."""

    def __init__(self, room, model, pinhole):
        """model : the camera with its lens; pinhole : the model of the drawn image of numbers"""
        self._room = room
        rays = model.rays()
        pixels = np.rint(pinhole.project(rays))
        col = np.clip(pixels[..., 0], 0, pinhole.width - 1).astype(np.intp)
        row = np.clip(pixels[..., 1], 0, pinhole.height - 1).astype(np.intp)
        self._pixels = (
            pinhole.height - 1 - row
        ) * pinhole.width + col  # the drawn image's first row is at the bottom
        self._rays = np.moveaxis(rays, -1, 0)[:2].astype(np.float32)
        self._joint = np.concatenate([[UNSEEN], room.joint])
        self._label = np.concatenate([[0], room.label]).astype(np.uint8)

    def numbers(self, image):
        """The triangle number of each of the camera's pixels, intp, of the drawn image of numbers."""
        return (np.take(image.view("<u4").ravel(), self._pixels) & 0xFFFFFF).astype(np.intp)

    def labels(self, numbers):
        """(height, width) uint8."""
        return np.take(self._label, numbers)

    def depth(self, numbers, camera, joint_poses):
        """Depth along the optical axis in metres, (height, width) float32; 0 where nothing was drawn.

        On a silhouette a ray can pass beside the triangle that its pixel shows, and would run far along its
        plane: the depth stays within the triangle's own, and 2 % more.
        """
        per_depth, nearest, farthest = self._planes(numbers, camera, joint_poses)
        x, y = self._rays
        slope = per_depth[0][numbers] * x
        slope += per_depth[1][numbers] * y
        slope += per_depth[2][numbers]
        with np.errstate(divide="ignore"):
            depth = 1 / slope
        depth[slope <= 0] = np.inf  # grazing: the triangle's far end
        np.minimum(depth, farthest[numbers], out=depth)
        np.maximum(depth, nearest[numbers], out=depth)
        return depth

    def _planes(self, numbers, camera, joint_poses):
        """Of each triangle in the image its plane, (a, b, c) with 1 / depth = a x + b y + c, and its depths.

        Arrays over all triangle numbers: 0 for triangles that are not in the image, and for the number 0.
        """
        room, to_camera, count = self._room, camera.inverse(), len(self._label)
        seen = np.zeros(count, bool)
        seen[numbers] = True
        seen[0] = False
        per_depth = np.zeros((3, count), np.float32)
        nearest, farthest = np.zeros(count, np.float32), np.zeros(count, np.float32)
        joint = np.where(seen, self._joint, UNSEEN)
        for k in np.unique(joint[seen]):
            pose = to_camera if k == NO_JOINT else to_camera @ joint_poses[room.joint_names[k]]
            mine = np.nonzero(joint == k)[0]
            normals = rotate(pose.rotation, room.normals[mine - 1])
            offsets = room.offsets[mine - 1] + sum(normals[:, i] * pose.position[i] for i in range(3))
            with np.errstate(divide="ignore", invalid="ignore"):
                per_depth[:, mine] = np.nan_to_num(normals / offsets[:, None]).T
            a, b, c = along(pose, room.triangles[mine - 1]).T
            nearest[mine] = np.minimum(np.minimum(a, b), c) * 0.98 - 0.005
            farthest[mine] = np.maximum(np.maximum(a, b), c) * 1.02 + 0.005
        return per_depth, nearest, farthest


def along(pose, triangles):
    """The z of triangles' corners after the pose, (N, 3)."""
    x, y, z = pose.rotation[2]
    return triangles[..., 0] * x + triangles[..., 1] * y + triangles[..., 2] * z + pose.position[2]
