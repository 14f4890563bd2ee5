"""Poses: rigid transforms, a rotation and a position; the one between two point sets; the error of a path."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a frame stands in another: `pose.apply(points)` takes points from the frame to the other.

    rotation : (3, 3), its columns the frame's axes
    position : (3,), metres
    """

    rotation: NDArray[np.float64]
    position: NDArray[np.float64]

    @classmethod
    def from_vector(cls, vector: ArrayLike) -> Pose:
        """Of [x, y, z, qx, qy, qz, qw], as geometry_msgs/Pose orders it.

        Raises
        ------
        ValueError : not 7 finite numbers, or a quaternion of length 0
        """
        vector = np.asarray(vector, float)
        if vector.shape != (7,) or not np.isfinite(vector).all():
            raise ValueError(f"a pose is 7 finite numbers, x y z qx qy qz qw, got {vector.tolist()}")
        x, y, z, w = vector[3:]
        squared = x * x + y * y + z * z + w * w
        if squared < 1e-12:
            raise ValueError("a pose needs a quaternion of length 1, got 0 0 0 0; no rotation is 0 0 0 1")
        s = 2 / squared
        rotation = [
            [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
        ]
        return cls(np.array(rotation), vector[:3].copy())

    @classmethod
    def planar(cls, x: float, y: float, yaw: float, z: float = 0.0) -> Pose:
        """Of a body on the floor that is turned left by yaw."""
        return cls(rotation_about("z", yaw), np.array([x, y, z], float))

    @property
    def vector(self) -> NDArray[np.float64]:
        """[x, y, z, qx, qy, qz, qw], rounded to 1e-9, qw not negative."""
        r = self.rotation
        # The products of the quaternion with itself, times 4: row k is the quaternion times 4 q[k].
        products = np.array(
            [
                [1 + r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[2, 0] + r[0, 2], r[2, 1] - r[1, 2]],
                [r[1, 0] + r[0, 1], 1 - r[0, 0] + r[1, 1] - r[2, 2], r[2, 1] + r[1, 2], r[0, 2] - r[2, 0]],
                [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], 1 - r[0, 0] - r[1, 1] + r[2, 2], r[1, 0] - r[0, 1]],
                [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], 1 + r[0, 0] + r[1, 1] + r[2, 2]],
            ]
        )
        k = products.diagonal().argmax()
        quaternion = products[k] / (2 * math.sqrt(products[k, k]))
        sign = -1 if quaternion[3] < 0 else 1
        return np.round([*self.position, *(sign * quaternion)], 9) + 0.0

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(product(self.rotation, other.rotation), self.apply(other.position))

    def inverse(self) -> Pose:
        """The pose of the reference frame in this one."""
        return Pose(self.rotation.T, -rotate(self.rotation.T, self.position))

    def apply(self, points: ArrayLike) -> NDArray[np.float64]:
        """Points (..., 3) of the frame, in the other frame."""
        return rotate(self.rotation, points) + self.position


def rotate(rotation, vectors):
    """Vectors (..., 3) turned by a rotation (3, 3)."""
    x, y, z = np.moveaxis(np.asarray(vectors), -1, 0)  # faster than a product and a sum of all points
    return np.stack([row[0] * x + row[1] * y + row[2] * z for row in rotation], -1)


def product(first, second):
    """The rotation that turns by `second`, then by `first`: first · second, (3, 3)."""
    return first[:, :1] * second[:1] + first[:, 1:2] * second[1:2] + first[:, 2:] * second[2:]


def rotation_about(axis, angle):
    """(3, 3) rotation about "x", "y" or "z", rounded to 1e-12: processors differ in sines."""
    c, s = round(math.cos(angle), 12), round(math.sin(angle), 12)
    if axis == "x":
        return np.array([[1, 0, 0], [0, c, -s], [0, s, c]], float)
    if axis == "y":
        return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]], float)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], float)


def rigid_motion(before: ArrayLike, after: ArrayLike) -> Pose:
    """The Pose whose `apply` takes the points before to those after, with the smallest sum of squares.

    before, after : (N, 3), at least 3 pairs that do not lie on one line; metres. Flat sets are no exception:
        the rotation is never a reflection.

    Raises
    ------
    ValueError : other shapes, NaN or infinity, or points on one line

    Source: Kabsch, A solution for the best rotation to relate two sets of vectors, 1976; as
    scipy.spatial.transform.Rotation.align_vectors of the points less their means.
    """
    before, after = corresponding_points(before, after, columns=3, least=3)
    center, center_after = before.mean(0), after.mean(0)
    u, sizes, vt = np.linalg.svd((after - center_after).T @ (before - center))
    if sizes[1] <= 1e-9 * sizes[0]:
        raise ValueError(f"these {len(before)} points lie on one line: turning about it changes nothing")
    u[:, 2] *= np.sign(np.linalg.det(u) * np.linalg.det(vt))
    rotation = u @ vt
    return Pose(rotation, center_after - rotate(rotation, center))


def ate(positions: ArrayLike, true_positions: ArrayLike) -> float:
    """Absolute trajectory error in metres: root mean square of the distances of paths (N, 2) or (N, 3).

    The paths are not aligned before, unlike in many tables: both must be given in one frame.

    Raises
    ------
    ValueError : other shapes, NaN or infinity

    Source: Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, 2012, equation 3.
    """
    columns = 2 if np.shape(true_positions)[-1:] == (2,) else 3
    positions, true_positions = corresponding_points(positions, true_positions, columns, least=1)
    return float(np.sqrt(((positions - true_positions) ** 2).sum(1).mean()))


def corresponding_points(
    first: ArrayLike, second: ArrayLike, columns: int, least: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both as (N, columns) float64, N at least `least`; ValueError for what is not."""
    first, second = np.asarray(first, float), np.asarray(second, float)
    if first.shape != second.shape or first.shape[1:] != (columns,) or len(first) < least:
        raise ValueError(
            f"needs two point sets of one shape (N, {columns}) with N >= {least}, "
            f"got {first.shape} and {second.shape}"
        )
    if not (np.isfinite(first).all() and np.isfinite(second).all()):
        raise ValueError("points must be finite numbers; leave out the pairs that hold NaN or infinity")
    return first, second
