"""Where the texels of pieces and walls lie, so that they can be lit; and the bodies that cast shadows."""

import numpy as np
from scene import drive

TEXELS = {"furniture": 512, "signs": 256, "room": 512}  # at which the light is computed when a room is made
ON_WALL = 0.12  # metres: skirting and door belong to the wall behind
WALLS = ((0, drive.X0, 1), (0, drive.X1, -1), (1, drive.Y0, 1), (1, drive.Y1, -1))  # axis, place, way inward
WITHOUT_SHADOW = ("picture", "sign", "wall_marker", "rug")
LEAF_DIRECTIONS, BODY_DIRECTIONS = 14, 46


# bodies


def spread_directions(count):
    """Unit vectors over half the sphere, their opposites, and the axes."""
    k = np.arange(count // 2)
    z, angle = 1 - (k + 0.5) / (count // 2), 2.399963 * k
    r = np.sqrt(1 - z * z)
    half = np.column_stack([r * np.cos(angle), r * np.sin(angle), z])
    return np.concatenate([half, -half, np.eye(3), -np.eye(3)])


def outer_points(triangles, directions):
    """The corners that are farthest along directions, whole millimetres."""
    corners = np.unique(triangles.reshape(-1, 3).round(3), axis=0)
    return np.round(corners[np.unique((corners @ directions.T).argmax(0))] * 1000).astype(np.int16)


def bodies_of(moved, pieces, description):
    """What casts shadows, one convex body an object: points from the piece's origin; each object's body."""
    names, objects = list(description["origins"]), moved["furniture_object"]
    points, owners, body_of = [], [], np.full(len(description["objects"]), -1)
    for k in np.unique(objects):
        name, piece = description["objects"][k], pieces["furniture"][objects == k][0]
        is_leaf = name.startswith("leaf")
        if (
            piece < 0 or names[piece] in WITHOUT_SHADOW or (is_leaf and k % 2)
        ):  # half of the leaves are enough
            continue
        if names[piece] == "shelf" and piece in owners:  # one body with its books
            body_of[k] = owners.index(piece)
            continue
        mine = pieces["furniture"] == piece if names[piece] == "shelf" else objects == k
        directions = spread_directions(LEAF_DIRECTIONS if is_leaf else BODY_DIRECTIONS)
        points.append(outer_points(moved["furniture_vertices"][mine], directions))
        body_of[k] = len(owners)
        owners.append(piece)
    arrays = {"body_points": np.concatenate(points), "body_ends": np.cumsum([len(p) for p in points])}
    return arrays | {"body_piece": np.array(owners, np.int8)}, body_of


# texels


def corner_normals(triangles, objects):
    """Directions of the surface at each corner, rounded over edges below 53 degrees, (N, 3, 3)."""
    edges = triangles[:, 1:] - triangles[:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    area = np.linalg.norm(normals, axis=1)
    normals /= area[:, None] + 1e-20
    keys = np.column_stack([triangles.reshape(-1, 3).round(5), np.repeat(objects, 3)])
    _, vertex = np.unique(keys, axis=0, return_inverse=True)
    vertex = vertex.ravel()
    order = np.argsort(vertex, kind="stable")
    result = np.zeros((len(vertex), 3))
    for corners in np.split(order, np.flatnonzero(np.diff(vertex[order])) + 1):
        around = corners // 3
        near = (normals[around] @ normals[around].T > 0.6) * area[around]
        result[corners] = near @ normals[around]
    result /= np.linalg.norm(result, axis=1, keepdims=True) + 1e-20
    return result.reshape(-1, 3, 3)


def texel_maps(moved, atlas, size):
    """Place and normal (size, size, 3), triangle (-1: none) of each texel, and of one around the islands."""
    triangles, objects = moved[f"{atlas}_vertices"].astype(float), moved[f"{atlas}_object"]
    normals = corner_normals(triangles, objects)
    place, normal = np.zeros((size, size, 3)), np.zeros((size, size, 3))
    owner, nearest = np.full((size, size), -1), np.full((size, size), np.inf)
    for k, (a, b, c) in enumerate(moved[f"{atlas}_uv"].astype(float) * size - 0.5):
        low = np.maximum(np.floor(np.min([a, b, c], 0)).astype(int) - 1, 0)
        high = np.minimum(np.ceil(np.max([a, b, c], 0)).astype(int) + 2, size)
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if abs(area) < 1e-9:
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
        s = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        t = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        outside = np.maximum(np.maximum(-s, -t), s + t - 1) * np.sqrt(abs(area))
        box = np.s_[low[1] : high[1], low[0] : high[0]]
        mine = (outside < 0.9) & (outside < nearest[box])
        weights = np.stack([1 - s - t, s, t], -1)[mine].clip(0, 1)
        nearest[box][mine], owner[box][mine] = outside[mine], k
        place[box][mine], normal[box][mine] = weights @ triangles[k], weights @ normals[k]
    normal /= np.linalg.norm(normal, axis=2, keepdims=True) + 1e-9
    return place[::-1], normal[::-1], owner[::-1]


def texels_of_pieces(moved, pieces, atlas, body_of):
    """The known texels of furniture or signs: which they are, piece, body, place, normal."""
    place, normal, triangle = texel_maps(moved, atlas, TEXELS[atlas])
    known = triangle >= 0
    triangle = triangle[known]
    return {
        f"{atlas}_known": known,
        f"{atlas}_piece": pieces[atlas][triangle],
        f"{atlas}_body": body_of[moved[f"{atlas}_object"][triangle]].astype(np.int8),
        f"{atlas}_place": np.round(place[known] * 1000).astype(np.int16),
        f"{atlas}_normal": np.round(normal[known] * 127).astype(np.int8),
    }


def texels_of_walls(moved):
    """The texels of the room on walls, wall after wall: where in the image, where on the wall."""
    place, normal, triangle = texel_maps(moved, "room", TEXELS["room"])
    texels, across = [], []
    for axis, at, inward in WALLS:
        mine = (
            (triangle >= 0) & (normal[..., axis] * inward > 0.5) & (np.abs(place[..., axis] - at) < ON_WALL)
        )
        along = place[..., 1 - axis] - (drive.Y0, drive.X0)[axis]
        texels.append(np.flatnonzero(mine).astype(np.int32))
        across.append(np.round(np.stack([along, place[..., 2]], -1)[mine] * 1000).astype(np.int16))
    ends = np.cumsum([len(t) for t in texels])
    return {"wall_texels": np.concatenate(texels), "wall_across": np.concatenate(across), "wall_ends": ends}


def frame_of_rug(moved, pieces):
    """Where the texture's corners (0, 0), (1, 0), (0, 1) lie, metres from the rug's origin; its number."""
    top = moved["rug_vertices"][..., 2] > 0.011
    uv, places = moved["rug_uv"][top], moved["rug_vertices"][top][:, :2]
    affine = np.linalg.lstsq(np.column_stack([uv, np.ones(len(uv))]), places, rcond=None)[0]
    corners = np.array([(0, 0, 1), (1, 0, 1), (0, 1, 1)]) @ affine
    return {"rug_frame": corners.round(6), "rug_piece": pieces["rug"][0]}
