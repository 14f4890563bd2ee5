"""Planes n · x = d, and a plane that a camera sees: homography and pose."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .poses import Pose, corresponding_points


def triangle_planes(triangles: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit normals (N, 3) and offsets (N,) of the planes of triangles (N, 3, 3): normal · x = offset on each.

    The normal points to where the corners turn counterclockwise. A triangle without area has the normal 0.
    """
    triangles = np.asarray(triangles, float)
    corner = triangles[:, 0]
    normals = np.cross(triangles[:, 1] - corner, triangles[:, 2] - corner)
    length = np.linalg.norm(normals, axis=1)
    normals /= np.where(length > 0, length, 1)[:, None]
    return normals, (normals * corner).sum(1)


def homography(points: ArrayLike, image_points: ArrayLike) -> NDArray[np.float64]:
    """(3, 3) float64, [2, 2] = 1: takes points of a plane to the image, as (column, row, 1) up to scale.

    points, image_points : (N, 2), at least 4 pairs, no three of any four on one line; more than four pairs
        give the smallest algebraic error. Undo the lens's distortion before, not after.

    Raises
    ------
    ValueError : other shapes, NaN or infinity, or points that leave the homography undetermined

    Source: direct linear transform with normalised points, Hartley and Zisserman, Multiple View Geometry,
    algorithm 4.2; on exact points as cv2.findHomography with method 0.
    """
    points, image_points = corresponding_points(points, image_points, columns=2, least=4)
    (x, y), to_normal = _normalised(points)
    (u, v), image_to_normal = _normalised(image_points)
    zero, one = np.zeros_like(x), np.ones_like(x)
    equations = np.concatenate(
        [
            np.stack([x, y, one, zero, zero, zero, -u * x, -u * y, -u], -1),
            np.stack([zero, zero, zero, x, y, one, -v * x, -v * y, -v], -1),
        ]
    )
    _, sizes, rows = np.linalg.svd(equations)
    normal_matrix = rows[-1].reshape(3, 3)
    matrix = np.linalg.inv(image_to_normal) @ normal_matrix @ to_normal
    determined = sizes[7] > 1e-9 * sizes[0] and abs(np.linalg.det(normal_matrix)) > 1e-9
    if not determined or abs(matrix[2, 2]) < 1e-12 * np.abs(matrix).max():
        raise ValueError(
            f"these {len(points)} pairs of points determine no homography: too many lie on one line, or the "
            "plane's origin lies on the horizon; give four corners of which no three lie on one line"
        )
    return matrix / matrix[2, 2]


def homography_pose(matrix: ArrayLike, camera_matrix: ArrayLike) -> Pose:
    """The Pose of a plane in the optical frame of the camera that sees it: x, y in the plane, z its normal.

    matrix : (3, 3), homography from points of the plane, in metres, to pixels without distortion
    camera_matrix : (3, 3), K in pixels

    Raises
    ------
    ValueError : other shapes, NaN, or a matrix that no plane before the camera has

    The image of the plane's origin and the derivatives there give position and slant. They leave two poses,
    mirrored at the line of sight; the one is taken whose perspective, the matrix's last row, is nearer. The
    other fits almost as well if the plane is small or distant.

    Source: infinitesimal plane-based pose estimation (IPPE), Collins and Bartoli, 2014,
    https://doi.org/10.1007/s11263-014-0725-5; the rotation as cv2.solvePnP, SOLVEPNP_IPPE, of four corners
    around the origin. OpenCV's position has the smallest error over the corners, this one is the origin's.
    """
    matrix, camera_matrix = np.asarray(matrix, float), np.asarray(camera_matrix, float)
    for name, values in (("homography", matrix), ("camera matrix", camera_matrix)):
        is_finite = values.shape == (3, 3) and np.isfinite(values).all()
        if not is_finite or values[2, 2] * np.linalg.det(values) == 0:
            raise ValueError(f"a {name} is 3×3 finite numbers with an inverse, got {values.tolist()}")
    normalised = np.linalg.inv(camera_matrix) @ matrix
    normalised /= normalised[2, 2]
    origin, perspective = normalised[:, 2], normalised[2, :2]
    derivatives = normalised[:2, :2] - np.outer(origin[:2], perspective)
    sight = origin / np.linalg.norm(origin)
    right = np.array([sight[2], 0, -sight[0]]) / np.hypot(sight[0], sight[2])
    across = np.column_stack([right, np.cross(sight, right)])
    slant = np.linalg.solve(across[:2] - np.outer(origin[:2], across[2]), derivatives)
    nearness = np.linalg.svd(slant, compute_uv=False)[0]  # 1 / depth
    slant /= nearness
    away = np.sqrt(np.maximum(1 - (slant**2).sum(0), 0)) * (1, -1 if slant[:, 0] @ slant[:, 1] > 0 else 1)
    axes = min(
        (across @ slant + np.outer(sight, sign * away) for sign in (1, -1)),
        key=lambda axes: np.linalg.norm(axes[2] * nearness - perspective),
    )
    return Pose(np.column_stack([axes, np.cross(axes[:, 0], axes[:, 1])]), origin / nearness)


def _normalised(points):
    """Columns of points moved and scaled to mean 0 and mean distance √2, and the (3, 3) that does it."""
    center = points.mean(0)
    scale = np.sqrt(2) / max(np.linalg.norm(points - center, axis=1).mean(), 1e-300)
    move = np.array([[scale, 0, -scale * center[0]], [0, scale, -scale * center[1]], [0, 0, 1]])
    return ((points - center) * scale).T, move
