"""Depth and labels of an image of triangle numbers, exact along each pixel's ray through the lens."""

import numpy as np

GRAZING = np.float32(1e-6)  # 1 / depth of a point 1000 km away


class TriangleDepth:
    """For one camera: the pixel of the drawn image that each ray meets, and how deep its triangle lies."""

    def __init__(self, room, model, pinhole):
        """model : the camera with its lens; pinhole : the model of the drawn image of numbers"""
        self._names = room.joint_names
        rays = model.rays()
        pixels = np.rint(pinhole.project(rays))
        col = np.clip(pixels[..., 0], 0, pinhole.width - 1).astype(np.intp)
        row = np.clip(pixels[..., 1], 0, pinhole.height - 1).astype(np.intp)
        row = pinhole.height - 1 - row  # the drawn image's first row is at the bottom
        self._pixels = row * pinhole.width + col
        self._rays = np.ascontiguousarray(np.moveaxis(rays, -1, 0)[:2], np.float32)
        self._label = np.concatenate([[0], room.label]).astype(np.uint8)
        # Columns of all triangles, so that some of them are taken quickly: the joint, the plane (normal and
        # offset), and the corners (x y z, x y z, x y z).
        self._joint = room.joint
        self._plane = room.planes
        self._corners = np.ascontiguousarray(room.triangles.reshape(-1, 9).T, float)
        # By triangle number, of what the newest image shows: as _update_planes says.
        self._planes = np.zeros((5, len(self._label)), np.float32)

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
        self._update_planes(numbers, camera, joint_poses)
        a, b, c, nearest, farthest = self._planes
        x, y = self._rays
        slope = np.take(a, numbers) * x + np.take(b, numbers) * y + np.take(c, numbers)
        depth = 1 / np.maximum(slope, GRAZING)  # below 0 too it is the triangle's far end that counts
        return np.maximum(np.minimum(depth, np.take(farthest, numbers)), np.take(nearest, numbers))

    def _update_planes(self, numbers, camera, joint_poses):
        """Computes of each triangle in the image (a, b, c) with 1 / depth = a x + b y + c, and its depths.

        Of the number 0 all stay 0; of triangles that are not in the image they are old, and not read.
        """
        visible = np.zeros(len(self._label), bool)
        visible[numbers] = True
        visible[0] = False
        visible_numbers = np.flatnonzero(visible)
        rows = visible_numbers - 1
        rotation, position = self._to_camera(np.take(self._joint, rows), camera, joint_poses)
        *normal, offset = np.take(self._plane, rows, 1)
        normals = [dot(row, normal) for row in rotation]
        offsets = offset + dot(normals, position)
        corners = np.take(self._corners, rows, 1).reshape(3, 3, -1)
        a, b, c = (dot(rotation[2], corner) + position[2] for corner in corners)
        with np.errstate(divide="ignore", invalid="ignore"):
            self._planes[:3, visible_numbers] = np.nan_to_num(np.stack(normals) / offsets)
        self._planes[3, visible_numbers] = np.minimum(np.minimum(a, b), c) * 0.98 - 0.005
        self._planes[4, visible_numbers] = np.maximum(np.maximum(a, b), c) * 1.02 + 0.005

    def _to_camera(self, joint, camera, joint_poses):
        """Rotations (3, 3, N) and positions (3, N) into the optical frame, of triangles of joints (N,)."""
        to_camera = camera.inverse()
        poses = [to_camera] * (len(self._names) + 1)  # NO_JOINT is -1; who does not take part is not seen
        for number, name in enumerate(self._names):
            if name in joint_poses:
                poses[number] = to_camera @ joint_poses[name]
        rotations = np.stack([pose.rotation.ravel() for pose in poses], 1)
        positions = np.stack([pose.position for pose in poses], 1)
        return np.take(rotations, joint, 1).reshape(3, 3, -1), np.take(positions, joint, 1)


def dot(first, second):
    """Scalar products of vectors (3, N), (N,)."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2]
