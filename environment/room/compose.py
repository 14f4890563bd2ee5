"""Textures of the baked colours and light, and the map of the free floor.

    python compose.py BAKED OUT [--quality 88]      needs bpy (see README.md); a minute

Reads what bake.py wrote; OUT is imgproc_course/simulation/room.
"""

import argparse
import json
from pathlib import Path

import bpy
import cv2
import numpy as np
from bake import COLOR_SIZE
from denoise import denoise
from scene import drive

SPECULAR = 0.04  # what a rough dielectric adds to its diffuse reflection
# Against the recorded drive, class by class: the floor is a little too light without its polish.
GAIN = {"floor": 0.95}
EXPOSURE = {"day": 1.0, "evening": 1.0}
QUALITY = {"signs": 94}
BALL_LABEL = 9
CELL = 0.01  # metres
BODY_HEIGHTS = (0.02, 0.22)  # metres: the robot with its camera
FLOOR_LABELS = (1, 14)  # floor and rug
ATLASES = ("floor", "rug", "room", "furniture", "signs", "outside", "movers")  # in the order of drawing
NO_JOINT = -1  # of what stands still
# The renderer's texture coordinates and depths are true over short distances only.
LONGEST_EDGE = {"floor": 0.3, "rug": 0.35, "room": 0.4}  # metres


def owned_texels(uv, size, oversampling=4):
    """Texels that triangles cover by more than half, or at all on thin islands: (height, width) bool."""
    width, height = size
    fine = np.zeros((height * oversampling, width * oversampling), np.uint8)
    coarse = np.zeros((height, width), np.uint8)
    for corners in uv * size - 0.5:
        fine_corners = (corners + 0.5) * oversampling - 0.5
        cv2.fillConvexPoly(fine, np.round(fine_corners * 16).astype(np.int32), 1, shift=4)
        cv2.fillConvexPoly(coarse, np.round(corners * 16).astype(np.int32), 1, shift=4)
    mostly = cv2.resize(fine * 255, size, interpolation=cv2.INTER_AREA) > 140
    _, islands = cv2.connectedComponents(coarse, connectivity=4)
    thin = ~np.isin(islands, np.unique(islands[mostly]))
    return mostly | (thin & (coarse > 0))


def seen_texels(baked, geometry, atlas, size):
    """Texels of the light that triangles cover and that no other body hides, (height, width) bool."""
    owned, buried = owned_texels(geometry[f"{atlas}_uv"], size), baked / f"{atlas}_buried.npy"
    if not buried.exists():
        return owned
    inside = np.load(buried)
    inside &= owned_texels(geometry[f"{atlas}_uv"], inside.shape[::-1])
    return owned & (cv2.resize(inside.astype(np.float32), size, interpolation=cv2.INTER_AREA) < 0.25)


def nearest(light, known):
    """Every texel of its nearest known one: (H, W, 3)."""
    _, owner = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 3, labelType=cv2.DIST_LABEL_PIXEL
    )
    source = np.zeros(owner.max() + 1, np.int64)
    source[owner[known]] = np.flatnonzero(known)
    return light.reshape(-1, 3)[source[owner]]


def island_means(light, known, sigma=4):
    """Mean of the known texels around each, of its own island only."""
    count, islands, boxes, _ = cv2.connectedComponentsWithStats(known.astype(np.uint8), connectivity=4)
    means = np.zeros_like(light)
    for k in range(1, count):
        x, y, width, height = boxes[k, :4]
        region = np.s_[y : y + height, x : x + width]
        mine = (islands[region] == k).astype(np.float32)
        total = cv2.GaussianBlur(
            light[region] * mine[..., None], (0, 0), sigma, borderType=cv2.BORDER_CONSTANT
        )
        weight = cv2.GaussianBlur(mine, (0, 0), sigma, borderType=cv2.BORDER_CONSTANT)
        means[region][mine > 0] = (total / np.maximum(weight, 1e-6)[..., None])[mine > 0]
    return means


def clean_light(light, known):
    """Light without noise. Texels that nobody sees take a mean: single noisy ones would look like edges."""
    filled = np.where(known[..., None], light, nearest(island_means(light, known), known))
    return nearest(without_grain(denoise(filled)), known)


def without_grain(light, strongest=0.6, reach=3):
    """Light without the grain that the denoiser left: changes below `strongest`, a natural logarithm, go."""
    logarithm = np.log(np.maximum(light, 1e-3))
    for _ in range(2):
        logarithm = cv2.bilateralFilter(logarithm, 4 * reach + 1, strongest, reach)
    return np.exp(logarithm)


def ball_texels(geometry, size):
    mask = np.zeros(size[::-1], np.uint8)
    for corners in geometry["movers_uv"][geometry["movers_label"] == BALL_LABEL]:
        cv2.fillConvexPoly(mask, np.round(corners * size).astype(np.int32), 1)
    return cv2.dilate(mask, np.ones((7, 7))) > 0


def texture(baked, geometry, atlas, lighting):
    """Linear colours times light, (H, W, 3) float32, first row at the bottom."""
    albedo = np.load(baked / f"{atlas}_albedo.npy").astype(np.float32) + SPECULAR
    light = np.minimum(np.load(baked / f"{atlas}_{lighting}.npy").astype(np.float32), 40)
    light = clean_light(light, seen_texels(baked, geometry, atlas, light.shape[1::-1]))
    light = cv2.resize(light, albedo.shape[1::-1], interpolation=cv2.INTER_LINEAR)
    light *= GAIN.get(atlas, 1.0) * EXPOSURE[lighting]
    if atlas == "movers":  # the ball turns: its light is the renderer's
        ball = ball_texels(geometry, albedo.shape[1::-1])
        light[ball], albedo[ball] = 0.8, albedo[ball] - 0.035
    return np.maximum(albedo * light, 0)


def save(linear, path, quality):
    """Through the scene's film-like tone curve, as JPEG."""
    image = bpy.data.images.new("texture", linear.shape[1], linear.shape[0], float_buffer=True)
    image.colorspace_settings.name = "Linear Rec.709"
    pixels = np.ones((*linear.shape[:2], 4), np.float32)
    pixels[..., :3] = linear
    image.pixels.foreach_set(pixels.ravel())
    bpy.context.scene.render.image_settings.file_format = "PNG"
    bpy.context.scene.render.image_settings.color_mode = "RGB"
    bpy.context.scene.render.image_settings.color_depth = "8"
    image.save_render(str(path.with_suffix(".png")), scene=bpy.context.scene)
    bpy.data.images.remove(image)
    cv2.imwrite(str(path), cv2.imread(str(path.with_suffix(".png"))), [cv2.IMWRITE_JPEG_QUALITY, quality])
    path.with_suffix(".png").unlink()


def occupied(geometry, shape, origin):
    """Cells of which something between the heights of the robot's body stands above."""
    grid = np.zeros(shape, np.uint8)
    low, high = BODY_HEIGHTS
    for atlas in ("room", "furniture", "signs"):
        for triangle, label in zip(geometry[f"{atlas}_vertices"], geometry[f"{atlas}_label"], strict=True):
            if label in FLOOR_LABELS or triangle[:, 2].min() > high or triangle[:, 2].max() < low:
                continue
            edges = np.linalg.norm(triangle - np.roll(triangle, 1, 0), axis=1)
            count = max(2, int(edges.max() / (CELL / 2)) + 1)
            s, t = np.meshgrid(np.linspace(0, 1, count), np.linspace(0, 1, count))
            inside = s + t <= 1 + 1e-9
            points = (
                triangle[0]
                + s[inside][:, None] * (triangle[1] - triangle[0])
                + t[inside][:, None] * (triangle[2] - triangle[0])
            )
            points = points[(points[:, 2] > low) & (points[:, 2] < high)]
            cells = ((points[:, :2] - origin) / CELL).astype(int).clip(0, np.array(shape[::-1]) - 1)
            grid[cells[:, 1], cells[:, 0]] = 1
    return grid


def free_space(geometry):
    """Distance in millimetres of each cell to the nearest that cannot be reached from the start, uint16."""
    origin = np.array([drive.X0 - 0.1, drive.Y0 - 0.1])
    shape = tuple(
        np.ceil([(drive.Y1 + 0.1 - origin[1]) / CELL, (drive.X1 + 0.1 - origin[0]) / CELL]).astype(int)
    )
    grid = occupied(geometry, shape, origin)
    start = tuple(int(v) for v in (np.array([0.0, 0.0]) - origin) / CELL)
    cv2.floodFill(grid, np.zeros((shape[0] + 2, shape[1] + 2), np.uint8), start, 2)
    distance = cv2.distanceTransform((grid == 2).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.round(distance * CELL * 1000).astype(np.uint16), origin


def as_drawn(geometry):
    """Arrays of all triangles, as RoomModel has them: no edge of an atlas is longer than LONGEST_EDGE."""
    parts = []
    for number, atlas in enumerate(ATLASES):
        triangles, texture, label = (geometry[f"{atlas}_{kind}"] for kind in ("vertices", "uv", "label"))
        if atlas in LONGEST_EDGE:
            triangles, texture, label = bisect(triangles, texture, label, LONGEST_EDGE[atlas])
        joint = np.full(len(label), NO_JOINT)
        if atlas == "movers":
            joint = geometry["movers_joint"].astype(int)
        parts.append((triangles, texture, label, joint, np.full(len(label), number)))
    names = ("triangles", "texture", "label", "joint", "atlas")
    return dict(zip(names, map(np.concatenate, zip(*parts, strict=True)), strict=True))


def bisect(triangles, texture, label, longest):
    """Cuts each triangle at the middle of its longest edge until no edge is longer than `longest` metres."""
    while True:
        edges = np.roll(triangles, -1, 1) - triangles
        squared = edges[..., 0] ** 2 + edges[..., 1] ** 2 + edges[..., 2] ** 2
        rows = np.nonzero(squared.max(1) > longest**2)[0]
        if not len(rows):
            return triangles, texture, label
        corner = squared[rows].argmax(1)
        keep = np.ones(len(triangles), bool)
        keep[rows] = False
        triangles = np.concatenate([triangles[keep], *halves(triangles[rows], corner)])
        texture = np.concatenate([texture[keep], *halves(texture[rows], corner)])
        label = np.concatenate([label[keep], label[rows], label[rows]])


def halves(corners, first):
    """The two halves of triangles (N, 3, K), cut between corner `first` and the one after it."""
    rows = np.arange(len(corners))
    a, b, c = (corners[rows, (first + k) % 3] for k in range(3))
    middle = (a + b) / 2
    return np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)


def parents_first(tree):
    """The tree of joints in the order in which their poses are computed."""

    def generation(name):
        parent = tree[name]["parent"]
        return 0 if parent is None else 1 + generation(parent)

    return {name: tree[name] for name in sorted(tree, key=generation)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("baked", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--quality", type=int, default=88, help="of the JPEG files")
    parser.add_argument("--lighting", nargs="*", default=["day", "evening"])
    parser.add_argument("--atlas", nargs="*", default=list(COLOR_SIZE))
    arguments = parser.parse_args()
    baked, out = arguments.baked, arguments.out
    out.mkdir(parents=True, exist_ok=True)
    geometry = dict(np.load(baked / "geometry.npz"))
    distance, origin = free_space(geometry)
    np.savez_compressed(out / "free_space.npz", distance=distance, origin=origin, cell=CELL)
    np.savez_compressed(out / "geometry.npz", **as_drawn(geometry))
    description = json.loads((baked / "scene.json").read_text())
    description["joint_tree"] = parents_first(description["joint_tree"])
    description["atlases"] = ATLASES
    (out / "scene.json").write_text(json.dumps(description, indent=0))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    drive.settings(4, 2)
    for lighting in arguments.lighting:
        for atlas in arguments.atlas:
            path = out / f"{atlas}_{lighting}.jpg"
            quality = QUALITY.get(atlas, arguments.quality)
            save(texture(baked, geometry, atlas, lighting), path, quality)
            print(f"{path.name}: {path.stat().st_size // 1024} kB", flush=True)


if __name__ == "__main__":
    main()
