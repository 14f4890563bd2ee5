"""Depth and labels of an image of triangle numbers, exact along each pixel's ray through the lens."""

import numpy as np

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
        room, count = self._room, len(self._label)
        visible = np.zeros(count, bool)
        visible[numbers] = True
        visible[0] = False
        visible_numbers = np.flatnonzero(visible)
        rotation, position = self._to_camera(self._joint[visible_numbers], camera, joint_poses)
        per_depth = np.zeros((3, count), np.float32)
        nearest, farthest = np.zeros(count, np.float32), np.zeros(count, np.float32)
        normals = [dot(row, room.normals[visible_numbers - 1].T) for row in rotation]
        offsets = room.offsets[visible_numbers - 1] + dot(normals, position)
        with np.errstate(divide="ignore", invalid="ignore"):
            per_depth[:, visible_numbers] = np.nan_to_num(np.stack(normals) / offsets)
        a, b, c = (dot(rotation[2], room.triangles[visible_numbers - 1, k].T) + position[2] for k in range(3))
        nearest[visible_numbers] = np.minimum(np.minimum(a, b), c) * 0.98 - 0.005
        farthest[visible_numbers] = np.maximum(np.maximum(a, b), c) * 1.02 + 0.005
        return per_depth, nearest, farthest

    def _to_camera(self, joint, camera, joint_poses):
        """Rotations (3, 3, N) and positions (3, N) into the optical frame, of triangles of joints (N,)."""
        names, to_camera = self._room.joint_names, camera.inverse()
        rotations, positions = np.zeros((len(names) + 1, 3, 3)), np.zeros((len(names) + 1, 3))
        for k in np.unique(joint):  # NO_JOINT is -1: the last one
            pose = to_camera if k == NO_JOINT else to_camera @ joint_poses[names[k]]
            rotations[k], positions[k] = pose.rotation, pose.position
        return np.moveaxis(rotations[joint], 0, -1), positions[joint].T


def dot(first, second):
    """Scalar products of vectors (3, N), (N,)."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2]
