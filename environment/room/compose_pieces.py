"""Files of furnished rooms, of what bake_pieces.py baked.

    python compose_pieces.py BAKED imgproc_course/simulation/room/pieces      needs bpy (see README.md); a minute

imgproc_course/simulation/room_light.py says what is in pieces.npz; images have their first row at the top.
"""

import argparse
import json
from pathlib import Path

import bpy
import compose
import cv2
import numpy as np
from bake_pieces import PROBES, WOOD, WORDS
from denoise import denoise
from scene import drive

FIXED = -1  # the number of the piece of what cannot be placed
LIGHTINGS = ("day", "evening")
TEXELS = {"furniture": 512, "signs": 256, "room": 512}  # at which the light is computed when a room is made
FLOOR_TEXELS, SUN_TEXELS = (512, 256), (1024, 512)
BRIGHTEST = {"direct": 2.0, "indirect": 2.0, "sun": 8.0}  # of the light's images, whose codes are square roots
ON_WALL = 0.12  # metres: skirting and door belong to the wall behind
WALLS = {"X0": (0, drive.X0, 1), "X1": (0, drive.X1, -1), "Y0": (1, drive.Y0, 1), "Y1": (1, drive.Y1, -1)}
CURVE_LIGHT = np.geomspace(2.0**-13, 64, 1024, dtype=np.float32)  # of the tone curve
GAIN = {"floor": compose.GAIN["floor"], "room": 1.0}
STEP = 16  # texels of the floor: the part in the sun begins and ends at whole texels of smaller images
LEAF_DIRECTIONS, BODY_DIRECTIONS = 14, 46


# geometry


def piece_numbers(description, objects):
    """The piece of each triangle, an index into the names of `origins`, or FIXED."""
    names, owner = list(description["origins"]), description["piece_of"]
    of_object = [names.index(owner[name]) if owner[name] in names else FIXED for name in description["objects"]]
    return np.array(of_object, np.int8)[objects]


def moved_to_origins(raw, description):
    """The triangles as baked, but pieces from their origins; and the piece of each triangle of an atlas."""
    origins = np.array([*description["origins"].values(), (0, 0)], np.float32)
    moved, pieces = dict(raw), {}
    for atlas in compose.ATLASES:
        pieces[atlas] = piece_numbers(description, raw[f"{atlas}_object"])
        moved[f"{atlas}_vertices"] = raw[f"{atlas}_vertices"].copy()
        moved[f"{atlas}_vertices"][..., :2] -= origins[pieces[atlas]][:, None]
    return moved, pieces


def geometry_of_pieces(moved, pieces):
    """The arrays of a RoomModel, and `piece` of each triangle."""
    numbered, labels = dict(moved), np.concatenate([moved[f"{atlas}_label"] for atlas in compose.ATLASES])
    first = 0
    for atlas in compose.ATLASES:
        numbered[f"{atlas}_label"] = first + np.arange(len(pieces[atlas]))
        first += len(pieces[atlas])
    drawn = compose.as_drawn(numbered)
    rows = drawn["label"]
    return drawn | {"label": labels[rows], "piece": np.concatenate(list(pieces.values()))[rows]}


def write_geometry(description, moved, pieces, out):
    np.savez_compressed(out / "geometry.npz", **geometry_of_pieces(moved, pieces))
    kept = {name: description[name] for name in ("labels", "joints", "markers", "marker_side", "origins")}
    kept |= {"joint_tree": compose.parents_first(description["joint_tree"]), "atlases": compose.ATLASES}
    (out / "scene.json").write_text(json.dumps(kept, indent=0))


# parts: convex bodies that cast shadows


def spread_directions(count):
    """Unit vectors over half the sphere, and their opposites."""
    k = np.arange(count // 2)
    z, angle = 1 - (k + 0.5) / (count // 2), 2.399963 * k
    r = np.sqrt(1 - z * z)
    half = np.column_stack([r * np.cos(angle), r * np.sin(angle), z])
    return np.concatenate([half, -half, np.eye(3), -np.eye(3)])


def parts_of(moved, pieces, description):
    """(points (N, 3) millimetres from the piece's origin, ends of parts, their pieces, part of each object)."""
    names, flat = list(description["origins"]), ("picture", "sign", "wall_marker", "rug")
    points, owners, part_of = [], [], np.full(len(description["objects"]), -1)
    objects = moved["furniture_object"]
    shelf = names.index("shelf")
    for k in np.unique(objects):
        piece = pieces["furniture"][objects == k][0]
        if piece == FIXED or names[piece] in flat:
            continue
        if piece == shelf and shelf in owners:  # one body with its books
            part_of[k] = owners.index(shelf)
            continue
        mine = pieces["furniture"] == shelf if piece == shelf else objects == k
        corners = np.unique(moved["furniture_vertices"][mine].reshape(-1, 3).round(3), axis=0)
        is_leaf = description["objects"][k].startswith("leaf")
        outer = spread_directions(LEAF_DIRECTIONS if is_leaf else BODY_DIRECTIONS)
        part_of[k] = len(owners)
        owners.append(piece)
        points.append(np.round(corners[np.unique((corners @ outer.T).argmax(0))] * 1000))
    ends = np.cumsum([len(p) for p in points])
    return np.concatenate(points).astype(np.int16), ends, np.array(owners, np.int8), part_of


# texels: place and direction of what is seen there


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
    """Place and normal (size, size, 3), and triangle (-1: none), first row at the top; a texel around islands, too."""
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


def texels_of_pieces(moved, pieces, atlas, part_of):
    """The known texels of furniture or signs: their place in the image, piece, part, place, normal."""
    place, normal, triangle = texel_maps(moved, atlas, TEXELS[atlas])
    known = triangle >= 0
    triangle = triangle[known]
    return {
        f"{atlas}_known": known,
        f"{atlas}_piece": pieces[atlas][triangle],
        f"{atlas}_part": part_of[moved[f"{atlas}_object"][triangle]].astype(np.int8),
        f"{atlas}_place": np.round(place[known] * 1000).astype(np.int16),
        f"{atlas}_normal": np.round(normal[known] * 127).astype(np.int8),
    }


def texels_of_walls(moved):
    """For each texel of the room: the wall that it belongs to, counted from 1, and where on it, millimetres."""
    place, normal, triangle = texel_maps(moved, "room", TEXELS["room"])
    wall = np.zeros(triangle.shape, np.uint8)
    across = np.zeros((*triangle.shape, 2), np.int16)
    for number, (axis, at, inward) in enumerate(WALLS.values(), 1):
        mine = (triangle >= 0) & (normal[..., axis] * inward > 0.5) & (np.abs(place[..., axis] - at) < ON_WALL)
        wall[mine] = number
        along = place[..., 1 - axis] - (drive.Y0, drive.X0)[axis]
        across[mine] = np.round(np.stack([along, place[..., 2]], -1)[mine] * 1000)
    return {"room_wall": wall, "room_across": across}


def frame_of_rug(moved, pieces):
    """Where the texture's corners (0, 0), (1, 0), (0, 1) lie on the rug, metres from its origin; and its number."""
    top = moved["rug_vertices"][..., 2] > 0.011
    uv, places = moved["rug_uv"][top], moved["rug_vertices"][top][:, :2]
    affine = np.linalg.lstsq(np.column_stack([uv, np.ones(len(uv))]), places, rcond=None)[0]
    corners = np.array([(0, 0, 1), (1, 0, 1), (0, 1, 1)]) @ affine
    return {"rug_frame": corners.round(6), "rug_piece": pieces["rug"][0]}


# light and colours


def load(baked, name):
    return np.load(baked / f"{name}.npy").astype(np.float32)


def resized(image, size):
    return cv2.resize(image, size, interpolation=cv2.INTER_LINEAR)


def occlusion(baked, geometry, moved):
    """How much of a white sky each texel of the furniture sees, against a surface alone: (H, W, 3)."""
    light = load(baked, "furniture_dome")
    size = light.shape[1]
    light = compose.clean_light(light, compose.seen_texels(baked, geometry, "furniture", (size, size)))
    _, normal, triangle = texel_maps(moved, "furniture", size)
    up = normal[::-1, :, 2:]
    alone = (1 + up) / 2 + (1 - up) / 2 * np.array(WOOD)
    share = np.clip(light / np.maximum(alone, 0.05), 0.03, 1.25).astype(np.float32)
    return compose.nearest(share, triangle[::-1] >= 0)


def light_of_empty_room(baked, geometry, lighting):
    """{atlas: {direct, indirect, sun}}, each (H, W, 3) linear; the sun of the floor alone."""
    parts = {}
    for atlas in ("floor", "room"):
        for kind in ("direct", "indirect"):
            light = np.minimum(load(baked, f"{atlas}_{lighting}_{kind}"), 40)
            if atlas == "room":
                known = compose.seen_texels(baked, geometry, atlas, light.shape[1::-1])
                light = compose.clean_light(light, known)
            else:
                light = denoise(light)
            parts.setdefault(atlas, {})[kind] = light
    if lighting == "day":
        sunny = denoise(np.minimum(load(baked, "floor_day_sunny"), 40))
        shade = resized(parts["floor"]["direct"], sunny.shape[1::-1])
        parts["floor"]["sun"] = patch_of_sun(np.maximum(sunny - shade, 0))
    return parts


def patch_of_sun(sun):
    """The sun's light without what noise puts elsewhere."""
    patch = cv2.dilate((sun.max(2) > 0.5).astype(np.uint8), np.ones((7, 7)))
    return sun * patch[..., None]


def write_light(parts, lighting, out):
    """Images of the light; a code is 255 √(light / brightest)."""
    for atlas, kinds in parts.items():
        for kind, light in kinds.items():
            size = SUN_TEXELS if kind == "sun" else FLOOR_TEXELS if atlas == "floor" else (TEXELS["room"],) * 2
            light = cv2.resize(light[::-1], size, interpolation=cv2.INTER_AREA)
            code = np.sqrt(np.clip(light / BRIGHTEST[kind], 0, 1)) * 255
            path = out / f"{atlas}_{kind}_{lighting}.png"
            cv2.imwrite(str(path), np.round(code[..., ::-1]).astype(np.uint8))


def reference_light(probes):
    """The light in which furniture, rug and signs are stored: that of the room's middle, from above."""
    middle = np.median(probes[2:-2, 2:-2, :2].reshape(-1, 6, 3), 0)
    return 0.6 * middle[:4].mean(0) + 0.4 * middle[4]


def write_textures(baked, parts, occluded, reference, lighting, out):
    """Returns what light.npz must know of them."""
    found = {}
    for atlas in ("floor", "room", "furniture", "rug", "signs"):
        albedo = load(baked, f"{atlas}_albedo") + compose.SPECULAR
        size = albedo.shape[1::-1]
        path, quality = out / f"{atlas}_{lighting}.jpg", compose.QUALITY.get(atlas, 88)
        if atlas in parts:
            kinds = {kind: resized(light, size) * GAIN[atlas] for kind, light in parts[atlas].items()}
            light = kinds["direct"] + kinds["indirect"]
            if "sun" in kinds:
                found |= write_sunny_part(albedo, light, kinds["sun"], out)
        else:
            light = reference * (resized(occluded, size) if atlas == "furniture" else 1)
        linear = np.maximum(albedo * light, 0).astype(np.float32)
        compose.save(linear, path, quality)
        found[f"curve_{atlas}_{lighting}"] = tone_curve(linear, out)
    return found


def write_sunny_part(albedo, light, sun, out):
    """The part of the floor that the sun reaches, in all light; returns where it begins."""
    rows, cols = np.nonzero(sun[::-1].max(2) > 0)
    top, left = (int(v.min()) // STEP * STEP for v in (rows, cols))
    bottom, right = (-(-int(v.max() + 1) // STEP) * STEP for v in (rows, cols))
    sunny = (albedo * (light + sun))[::-1][top:bottom, left:right][::-1]
    compose.save(np.ascontiguousarray(sunny, np.float32), out / "floor_sunny.jpg", 88)
    return {"sunny_corner": np.array([top, left])}


def tone_curve(image, out):
    """What the scene's tone curve makes of the mean colour of a linear image: (1024, 3) uint16, blue, green, red."""
    color = image.reshape(-1, 3).mean(0, dtype=float)
    strip = np.ones((len(CURVE_LIGHT), 4), np.float32)
    strip[:, :3] = CURVE_LIGHT[:, None] * (color / color.max())
    strip_image = bpy.data.images.new("curve", len(strip), 1, float_buffer=True)
    strip_image.colorspace_settings.name = "Linear Rec.709"
    strip_image.pixels.foreach_set(strip.ravel())
    settings, path = bpy.context.scene.render.image_settings, out / "curve.png"
    settings.file_format, settings.color_mode, settings.color_depth = "PNG", "RGB", "16"
    strip_image.save_render(str(path), scene=bpy.context.scene)
    values = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[0]
    path.unlink()
    return np.maximum.accumulate(values)


def words_of(baked):
    """The ink of each word within their common box on the signs, first row at the top: rows, columns of the box."""
    ink = {word: np.load(baked / f"word_{word}.npy")[::-1] for word in WORDS}
    rows, cols = np.nonzero(np.max(list(ink.values()), 0))
    top, left, bottom, right = rows.min(), cols.min(), rows.max() + 1, cols.max() + 1
    boxed = {f"word_{word}": page[top:bottom, left:right] for word, page in ink.items()}
    return boxed | {"word_corner": np.array([top, left])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("baked", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--geometry", action="store_true", help="stop before the light")
    arguments = parser.parse_args()
    baked, out = arguments.baked, arguments.out
    out.mkdir(parents=True, exist_ok=True)
    geometry, description = dict(np.load(baked / "geometry.npz")), json.loads((baked / "scene.json").read_text())
    moved, pieces = moved_to_origins(geometry, description)
    write_geometry(description, moved, pieces, out)
    if arguments.geometry:
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    drive.settings(4, 2)
    points, ends, owners, part_of = parts_of(moved, pieces, description)
    arrays = {"pieces": np.array(list(description["origins"])), "part_points": points, "part_ends": ends, "part_piece": owners}
    for atlas in ("furniture", "signs"):
        arrays |= texels_of_pieces(moved, pieces, atlas, part_of)
    arrays |= texels_of_walls(moved) | frame_of_rug(moved, pieces) | words_of(baked)
    arrays["curve_light"] = CURVE_LIGHT
    arrays |= {f"probe_{axis}": grid for axis, grid in zip("xyz", PROBES, strict=True)}
    occluded = occlusion(baked, geometry, moved)
    for lighting in LIGHTINGS:
        probes = load(baked, f"probes_{lighting}_direct") + load(baked, f"probes_{lighting}_indirect")
        reference = reference_light(probes)
        arrays |= {f"probes_{lighting}": probes.astype(np.float32), f"reference_{lighting}": reference}
        parts = light_of_empty_room(baked, geometry, lighting)
        write_light(parts, lighting, out)
        arrays |= write_textures(baked, parts, occluded, reference, lighting, out)
    np.savez_compressed(out / "light.npz", **arrays)
    for path in sorted(out.iterdir()):
        print(f"{path.name}: {path.stat().st_size // 1024} kB")


if __name__ == "__main__":
    main()
