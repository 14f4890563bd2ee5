"""Files of furnished rooms, of what bake_pieces.py baked.

    python compose_pieces.py BAKED OUT      needs bpy (see README.md); a minute

OUT is imgproc_course/simulation/room/pieces. Images have their first row at the top.
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
from relight import finer_probes, ratio_tables, sources
from scene import drive
from texels import TEXELS, bodies_of, frame_of_rug, texel_maps, texels_of_pieces, texels_of_walls

FIXED = -1  # the number of the piece of what cannot be placed
LIGHTINGS = ("day", "evening")
FLOOR_TEXELS, SUN_TEXELS = (512, 256), (1024, 512)  # of the images of light
# Of the images of light, whose codes are square roots.
BRIGHTEST = {"direct": 2.0, "indirect": 2.0, "sun": 8.0}
SKY_BEHIND = 0.13  # metres behind the wall's face: seen at any angle through the window
RUG_LIGHT = 1.5  # in which the rug is stored, of the reference: it looks up
GAIN = {"floor": compose.GAIN["floor"], "room": 1.0}
STEP = 16  # texels of the floor: the part in the sun begins and ends at whole texels of smaller images


# geometry


def piece_numbers(description, objects):
    """The piece of each triangle, an index into the names of `origins`, or FIXED."""
    names, owner = list(description["origins"]), description["piece_of"]
    of_object = [
        names.index(owner[name]) if owner[name] in names else FIXED for name in description["objects"]
    ]
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
    numbered["outside_vertices"] = moved["outside_vertices"].copy()
    numbered["outside_vertices"][..., 1] = drive.Y1 + SKY_BEHIND
    drawn = compose.as_drawn(numbered)
    rows = drawn["label"]
    return drawn | {"label": labels[rows], "piece": np.concatenate(list(pieces.values()))[rows]}


def write_geometry(description, moved, pieces, out):
    np.savez_compressed(out / "geometry.npz", **geometry_of_pieces(moved, pieces))
    kept = {name: description[name] for name in ("labels", "joints", "markers", "marker_side", "origins")}
    kept |= {"joint_tree": compose.parents_first(description["joint_tree"]), "atlases": compose.ATLASES}
    (out / "scene.json").write_text(json.dumps(kept, indent=0))


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
            size = (
                {"floor": FLOOR_TEXELS, "room": (TEXELS["room"],) * 2}[atlas] if kind != "sun" else SUN_TEXELS
            )
            light = cv2.resize(light[::-1], size, interpolation=cv2.INTER_AREA)
            code = np.round(np.sqrt(np.clip(light / BRIGHTEST[kind], 0, 1)) * 255).astype(np.uint8)
            path = out / f"{atlas}_{kind}_{lighting}.jpg"
            cv2.imwrite(str(path), code[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 94])


def reference_light(probes):
    """The light in which furniture and signs are stored: that of the room's middle."""
    middle = np.median(probes[2:-2, 2:-2, :2].reshape(-1, 6, 3), 0)
    return 0.6 * middle[:4].mean(0) + 0.4 * middle[4]


def write_textures(baked, parts, occluded, reference, lighting, out):
    """Returns what light.npz must know of them."""
    found = {}
    brightest = parts["floor"].get("sun", np.zeros((1, 1, 3))).max((0, 1))
    for atlas in ("floor", "room", "furniture", "rug", "signs"):
        albedo = load(baked, f"{atlas}_albedo") + compose.SPECULAR
        light = reference * (RUG_LIGHT if atlas == "rug" else 1)
        found[f"reference_{atlas}_{lighting}"] = light[::-1].astype(np.float32)
        if atlas == "furniture":
            light = light * resized(occluded, albedo.shape[1::-1])
        if atlas in parts:
            kinds = {
                kind: resized(light, albedo.shape[1::-1]) * GAIN[atlas]
                for kind, light in parts[atlas].items()
            }
            light = kinds["direct"] + kinds["indirect"]
        found |= write_texture(albedo * light, f"{atlas}_{lighting}", out, compose.QUALITY.get(atlas, 88))
        if lighting == "day" and atlas == "floor":
            corner, box = box_of(kinds["sun"])
            found |= write_texture((albedo * (light + kinds["sun"]))[box], "floor_sunny", out, 88)
            found |= {"sunny_corner": corner, "sunlight": brightest[::-1].astype(np.float32)}
        if lighting == "day" and atlas == "rug":
            found |= write_texture(albedo * (light + brightest), "rug_sunny", out, 88)
    return found


def write_texture(linear, name, out, quality):
    linear = np.maximum(linear, 0).astype(np.float32)
    compose.save(linear, out / f"{name}.jpg", quality)
    return {f"ratios_{name}": ratio_tables(linear, name, out)}


def box_of(sun):
    """First row, counted from the top, and column of the part that the sun reaches, and its slices."""
    rows, cols = np.nonzero(sun.max(2) > 0)
    bottom, left = (int(v.min()) // STEP * STEP for v in (rows, cols))
    top, right = (-(-int(v.max() + 1) // STEP) * STEP for v in (rows, cols))
    return np.array([sun.shape[0] - top, left]), np.s_[bottom:top, left:right]


def words_of(baked):
    """The ink of each word, 0 to 255, in their common box on the signs; the box's first row and column."""
    ink = {word: np.load(baked / f"word_{word}.npy")[::-1] for word in WORDS}
    rows, cols = np.nonzero(np.max(list(ink.values()), 0))
    top, left, bottom, right = rows.min(), cols.min(), rows.max() + 1, cols.max() + 1
    boxed = {f"word_{word}": page[top:bottom, left:right] for word, page in ink.items()}
    return boxed | {"sign_corner": np.array([top, left])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("baked", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--geometry", action="store_true", help="stop before the light")
    arguments = parser.parse_args()
    baked, out = arguments.baked, arguments.out
    out.mkdir(parents=True, exist_ok=True)
    geometry, description = (
        dict(np.load(baked / "geometry.npz")),
        json.loads((baked / "scene.json").read_text()),
    )
    moved, pieces = moved_to_origins(geometry, description)
    write_geometry(description, moved, pieces, out)
    if arguments.geometry:
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    drive.settings(4, 2)
    bodies, body_of = bodies_of(moved, pieces, description)
    arrays = {"pieces": np.array(list(description["origins"]))} | bodies | words_of(baked)
    arrays |= texels_of_walls(moved) | frame_of_rug(moved, pieces)
    for atlas in ("furniture", "signs"):
        arrays |= texels_of_pieces(moved, pieces, atlas, body_of)
    arrays["probes_from_to"] = np.array([(grid[0], grid[-1]) for grid in PROBES])
    occluded = occlusion(baked, geometry, moved)
    for lighting in LIGHTINGS:
        probes = load(baked, f"probes_{lighting}_direct") + load(baked, f"probes_{lighting}_indirect")
        reference = reference_light(probes)
        arrays |= {f"probes_{lighting}": finer_probes(probes)} | sources(lighting)
        parts = light_of_empty_room(baked, geometry, lighting)
        write_light(parts, lighting, out)
        arrays |= write_textures(baked, parts, occluded, reference, lighting, out)
    np.savez_compressed(out / "light.npz", **arrays)
    for path in sorted(out.iterdir()):
        print(f"{path.name}: {path.stat().st_size // 1024} kB")


if __name__ == "__main__":
    main()
