"""Poses in the plane, (x, y, yaw) in metres and radians, and the graph that holds them together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def wrap_angle(angle: ArrayLike) -> NDArray[np.float64]:
    """The same angle between -π and π, of any shape."""
    return (np.asarray(angle, float) + np.pi) % (2 * np.pi) - np.pi


def relative_pose(first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
    """(dx, dy, dyaw) of the second pose in the frame of the first: poses (..., 3), dyaw between -π and π."""
    (x, y, yaw), (u, v, turned) = (np.moveaxis(np.asarray(p, float), -1, 0) for p in (first, second))
    c, s, dx, dy = np.cos(yaw), np.sin(yaw), u - x, v - y
    return np.stack([c * dx + s * dy, c * dy - s * dx, wrap_angle(turned - yaw)], -1)


def compose_poses(pose: ArrayLike, motion: ArrayLike) -> NDArray[np.float64]:
    """The pose (..., 3) after a motion (..., 3) that is given in the pose's frame: undoes `relative_pose`."""
    (x, y, yaw), (dx, dy, turn) = (np.moveaxis(np.asarray(p, float), -1, 0) for p in (pose, motion))
    c, s = np.cos(yaw), np.sin(yaw)
    return np.stack([x + c * dx - s * dy, y + s * dx + c * dy, wrap_angle(yaw + turn)], -1)


def optimize_pose_graph(
    poses: ArrayLike, edges: Sequence[tuple[int, int, ArrayLike, ArrayLike]], iterations: int = 20
) -> NDArray[np.float64]:
    """Poses (N, 3) float64 with the smallest weighted sum of squared edge errors; the first stays as it is.

    Parameters
    ----------
    poses : (N, 3), x, y, yaw: the first guess, near enough to the result
    edges : of (i, j, motion, weights): pose j was measured at motion (dx, dy, dyaw) in the frame of pose i;
        weights are two: of the position (1 / m²) and of the yaw (1 / rad²), 1 / standard deviation²
    iterations : at most so many; it ends earlier when no value changes by more than 1e-10

    Raises
    ------
    ValueError : other shapes, NaN, an edge between poses that do not exist, weights that are not positive,
        or poses that no edges connect with the first

    Source: Gauss-Newton as in Grisetti et al., A Tutorial on Graph-Based SLAM, 2010; as GTSAM's
    BetweenFactorPose2, up to the square of the edges' errors in yaw: it measures them along an arc.
    """
    poses = np.array(poses, float)
    i, j, motions, weights = _checked(poses, edges)
    for _ in range(iterations):
        errors = relative_pose(poses[i], poses[j]) - motions
        errors[:, 2] = wrap_angle(errors[:, 2])
        by_edge = _jacobians(poses[i], poses[j])
        blocks = np.zeros((len(i), 3, len(poses), 3))
        for pose, block in zip((i, j), by_edge, strict=True):
            blocks[np.arange(len(i)), :, pose] = block
        jacobian = blocks[:, :, 1:].reshape(3 * len(i), -1)  # without the first pose
        weighted = jacobian * weights.reshape(-1, 1)
        step = -np.linalg.solve(jacobian.T @ weighted, weighted.T @ errors.ravel())
        poses[1:] += step.reshape(-1, 3)
        if np.abs(step).max() < 1e-10:
            break
    return np.column_stack([poses[:, :2], wrap_angle(poses[:, 2])])


def _jacobians(first, second):
    """Derivatives (N, 3, 3) of relative_pose(first, second): by the first pose, and by the second."""
    yaw, zero, one = first[:, 2], np.zeros(len(first)), np.ones(len(first))
    c, s = np.cos(yaw), np.sin(yaw)
    dx, dy, _ = relative_pose(first, second).T
    by_first = np.array([[-c, -s, dy], [s, -c, -dx], [zero, zero, -one]])
    by_second = np.array([[c, s, zero], [-s, c, zero], [zero, zero, one]])
    return by_first.transpose(2, 0, 1), by_second.transpose(2, 0, 1)


def _checked(poses, edges):
    """Indices (M,) and (M,), motions (M, 3) and weights (M, 3) of edges; ValueError for what is none."""
    if poses.ndim != 2 or poses.shape[1] != 3 or len(poses) < 2 or not np.isfinite(poses).all():
        raise ValueError(f"needs finite poses (N, 3), x, y, yaw, with N >= 2, got shape {poses.shape}")
    for edge in edges:
        i, j, motion, weights = edge
        numbers = np.array([*motion, *weights], float)
        if not (0 <= i < len(poses) and 0 <= j < len(poses) and i != j):
            raise ValueError(f"an edge joins two of the poses 0 to {len(poses) - 1}, got {i} and {j}")
        if numbers.shape != (5,) or not np.isfinite(numbers).all() or not (numbers[3:] > 0).all():
            raise ValueError(f"an edge is 3 numbers of motion and 2 weights above 0, got {motion}, {weights}")
    reached = np.arange(len(poses)) == 0
    for _ in poses:
        for i, j, *_ in edges:
            reached[[i, j]] |= reached[i] or reached[j]
    if not reached.all():
        raise ValueError(f"no edges connect pose {int(reached.argmin())} with pose 0; leave it out")
    i, j, motions, weights = zip(*edges, strict=True)
    return np.array(i), np.array(j), np.array(motions, float), np.array(weights, float)[:, [0, 0, 1]]
