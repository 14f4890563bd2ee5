"""Planes n · x = d."""

import numpy as np


def triangle_planes(triangles):
    """Unit normals (N, 3) and offsets (N,) of the planes of triangles (N, 3, 3): normal · x = offset on each.

    The normal points to where the corners turn counterclockwise. A triangle without area has the normal 0.
    """
    triangles = np.asarray(triangles, float)
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normals = np.stack(
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        -1,
    )
    length = np.sqrt(normals[:, 0] ** 2 + normals[:, 1] ** 2 + normals[:, 2] ** 2)
    normals /= np.where(length > 0, length, 1)[:, None]
    corner = triangles[:, 0]
    return normals, normals[:, 0] * corner[:, 0] + normals[:, 1] * corner[:, 1] + normals[:, 2] * corner[:, 2]
