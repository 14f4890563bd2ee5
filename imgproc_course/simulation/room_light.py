"""The light of a furnished room: the textures of its floor, walls and pieces, lit where the pieces stand.

Floor and walls are stored in the light of the empty room, and this light in parts: from window and lamp
(direct), from all that they shine on (indirect), and from the sun. Each part is weakened where pieces stand
in its way. The pieces are stored in one light; they get that of small cubes (probes) in the empty room, and
the sun's. How much brighter or darker a value then is, the tone curve says.

What decides a byte is done in whole numbers, or in sums, products, quotients and square roots, one by one:
these are the same on every processor. environment/room/compose_pieces.py writes the files.
"""

import functools
import itertools
import math
from typing import NamedTuple

import cv2
import numpy as np

from .room_model import FILES as ROOM_FILES
from .room_model import read_image

FILES = ROOM_FILES / "pieces"
X0, X1, Y0, Y1, HEIGHT = -0.9, 5.6, -2.1, 2.3, 2.45  # metres: the room
SKY_SHARE = 0.85  # of the indirect light that a body in its way takes
BRIGHTEST = {"direct": 2.0, "indirect": 2.0, "sun": 8.0}  # light of the code 255 in the images of light
MARKERS = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
# Of the sign; the first one is the recorded room's.
WORDS = (
    *("KITCHEN", "OFFICE", "BEDROOM", "GARAGE", "LIBRARY"),
    *("STUDIO", "PANTRY", "LAUNDRY", "NURSERY", "CELLAR"),
)
INK = 26  # the value of the sign's writing
# Row and column of each marker's upper left corner on the signs' texture, where it lies on its left side.
MARKER_CORNERS, MARKER_SIDE = {"marker": (348, 709), "wall_marker": (709, 709)}, 268


class Atlas(NamedTuple):
    """The image of ratios for a texture: its size, what stands for 1; the step of the light's ratio 1."""

    size: tuple[int, int]  # width, height
    one: int
    step: int


ATLASES = {
    "floor": Atlas((1024, 512), 256, 511),  # floor and walls only get darker
    "rug": Atlas((256, 256), 128, 128),
    "room": Atlas((512, 512), 256, 511),
    "furniture": Atlas((512, 512), 128, 128),
    "signs": Atlas((256, 256), 128, 128),
}


class Plane(NamedTuple):
    """A floor or wall as an image of cells: how its columns, rows and heights follow from x, y, z."""

    column: tuple[int, float, int]  # axis, origin in metres, direction
    row: tuple[int, float, int]
    height: tuple[int, float, int]
    size: tuple[float, float]  # metres
    shape: tuple[int, int]  # rows, columns

    @property
    def cells(self):
        """Cells on a metre, across and along."""
        return self.shape[1] / self.size[0], self.shape[0] / self.size[1]

    def of(self, points):
        """Columns and rows in cells, and heights in metres, of points (N, 3)."""
        column, row, height = (way * (points[:, axis] - at) for axis, at, way in self[:3])
        return column * self.cells[0], row * self.cells[1], height


def wall(along, across, way):
    """The Plane of a wall along axis 0 or 1; `across`: where it stands on the other axis."""
    length, first = ((X1 - X0, X0), (Y1 - Y0, Y0))[along]
    shape = (round(HEIGHT / 0.025), round(length / 0.025))
    return Plane((along, first, 1), (2, 0, 1), (1 - along, across, way), (length, HEIGHT), shape)


FLOOR = Plane((0, X0, 1), (1, Y1, -1), (2, 0, 1), (X1 - X0, Y1 - Y0), (256, 512))
SUNNY_FLOOR = FLOOR._replace(shape=(512, 1024))
WALLS = (wall(1, X0, 1), wall(1, X1, -1), wall(0, Y0, 1), wall(0, Y1, -1))  # in the order of light.npz


@functools.cache
def stored():
    """{name: array} of light.npz."""
    with np.load(FILES / "light.npz") as file:
        return dict(file)


def textures(poses, lighting, word=WORDS[0], markers=None):
    """The textures of a lighting, {atlas: (H, W, 3) uint8 BGR}, with pieces at {name: (x, y, yaw)}.

    The sign has one of the WORDS, and the markers {name: number, 0 to 49}; else the recorded room's.
    """
    images = {atlas: read_image(f"pieces/{atlas}_{lighting}.jpg") for atlas in ATLASES}
    for name, number in (markers or {}).items():
        print_marker(images["signs"], name, number)
    small = {atlas: reduced(images[atlas], ATLASES[atlas].size) for atlas in ATLASES}
    write(images["signs"], word)
    placed = Placed(poses)
    floor = FloorLight(placed, lighting)
    light = {
        "floor": floor.shaded / floor.empty,
        "rug": of_rug(floor.shaded, placed) / stored()[f"reference_rug_{lighting}"],
        "room": wall_shares(placed, lighting),
    }
    ratio = {atlas: ratios(f"{atlas}_{lighting}", small[atlas], light[atlas]) for atlas in light}
    for atlas in ("furniture", "signs"):
        ratio[atlas] = ratios_of_pieces(atlas, small[atlas], placed, floor, lighting)
    lit = {atlas: times(images.pop(atlas), ratio[atlas], ATLASES[atlas].one) for atlas in ATLASES}
    if lighting == "day":
        add_sun_to_floor(lit["floor"], floor)
        add_sun_to_rug(lit["rug"], floor, placed)
    return lit


def reduced(image, size):
    """An image by a whole factor smaller."""
    return cv2.resize(image, size, interpolation=cv2.INTER_AREA)


def enlarged(image, size):
    return cv2.resize(image, size, interpolation=cv2.INTER_LINEAR)


def times(image, ratio, one):
    """An image times a smaller image of ratios, of which `one` stands for 1."""
    return cv2.multiply(image, enlarged(ratio, image.shape[1::-1]), scale=1 / one)


def ratios(name, values, light):
    """How values (..., 3) of a stored texture change where its light does by the ratios `light` (..., 3)."""
    tables, step = stored()[f"ratios_{name}"], np.float32(ATLASES[name.split("_")[0]].step)
    steps = np.minimum(np.sqrt(light) * step + np.float32(0.5), tables.shape[2] - 1).astype(np.uint16)
    return np.stack([tables[k][values[..., k] >> 2, steps[..., k]] for k in range(3)], -1)


def ratios_of_pieces(atlas, small, placed, floor, lighting):
    """The image of ratios of furniture or signs: of the texels that have a place, and beside them."""
    known = stored()[f"{atlas}_known"]
    light = light_on_pieces(atlas, placed, floor, lighting) / stored()[f"reference_{atlas}_{lighting}"]
    image = np.zeros_like(small)
    image[known] = ratios(f"{atlas}_{lighting}", small[known], light)
    return np.where(known[..., None], image, cv2.dilate(image, np.ones((3, 3), np.uint8)))


def print_marker(image, name, number):
    """Prints another marker of the dictionary 4x4_50 on the signs' texture, in place."""
    top, left = MARKER_CORNERS[name]
    box = image[top : top + MARKER_SIDE, left : left + MARKER_SIDE]
    ink, paper = box[20, 20].copy(), image[top - 12, left + MARKER_SIDE // 2].copy()
    cells = cv2.aruco.generateImageMarker(MARKERS, number, 6)
    is_paper = cv2.resize(np.rot90(cells), (MARKER_SIDE, MARKER_SIDE), interpolation=cv2.INTER_NEAREST) > 0
    inside = np.s_[MARKER_SIDE // 6 : -(MARKER_SIDE // 6)]  # the frame around the cells stays
    box[inside, inside] = np.where(is_paper[inside, inside, None], paper, ink)


def write(image, word):
    """Prints a word on the signs' texture, in place."""
    ink = stored()[f"word_{word}"][..., None].astype(np.uint16)
    top, left = stored()["sign_corner"]
    box = image[top : top + ink.shape[0], left : left + ink.shape[1]]
    box[:] = (box * (255 - ink) + INK * ink + 127) // 255


def add_sun_to_floor(image, floor):
    """Lights the floor's texture where the sun reaches it, in place."""
    sunny = read_image("pieces/floor_sunny.jpg")
    height, width = sunny.shape[:2]
    top, left = stored()["sunny_corner"].tolist()
    box = np.s_[top // 4 : (top + height) // 4, left // 4 : (left + width) // 4]
    light = (floor.shaded[box] + floor.sun[box]) / (floor.empty[box] + floor.sun[box])
    blend(image[top : top + height, left : left + width], "floor_sunny", sunny, light, floor.sun_share[box])


def add_sun_to_rug(image, floor, placed):
    brightest, here = stored()["sunlight"], of_rug(floor.sun, placed)
    light = (of_rug(floor.shaded, placed) + here) / (stored()["reference_rug_day"] + brightest)
    share = of_rug(floor.sun_share, placed) * np.minimum(here[..., 1] * (4 / brightest[1]), 1)
    blend(image, "rug_sunny", read_image("pieces/rug_sunny.jpg"), light, share.astype(np.uint8))


def blend(image, name, sunny, light, share):
    """Mixes into a texture, in place, a sunny one, whose light has changed by ratios; share (H, W) of 255."""
    ratio = ratios(name, reduced(sunny, light.shape[1::-1]), light)
    sunny = times(sunny, ratio, ATLASES[name.split("_")[0]].one)
    share = enlarged(share, image.shape[1::-1])[..., None].astype(np.uint16)
    image[:] = (image * (255 - share) + sunny * share + 127) // 255


class Placed:
    """The places and turns of the pieces; and the bodies that cast shadows, each a cloud of points."""

    def __init__(self, poses):
        data = stored()
        ordered = [poses[name] for name in data["pieces"].tolist()]
        values = [(round(math.cos(yaw), 12), round(math.sin(yaw), 12), x, y) for x, y, yaw in ordered]
        self._turns = np.array([*values, (1, 0, 0, 0)], np.float32)  # the last one, -1: of what does not move
        self.ends = data["body_ends"]
        self.starts = np.concatenate([[0], self.ends[:-1]])
        pieces = np.repeat(data["body_piece"], self.ends - self.starts)
        self.points = self.places(data["body_points"] * np.float32(0.001), pieces)
        low, high = (edge.reduceat(self.points[:, 2], self.starts) for edge in (np.minimum, np.maximum))
        self.middles = (low + high) / 2

    def places(self, points, pieces):
        """Points (N, 3) of pieces, in the room."""
        return self.directions(points, pieces) + np.insert(self._turns[pieces, 2:], 2, 0, axis=1)

    def directions(self, vectors, pieces):
        """Directions (N, 3) of pieces, in the room."""
        cosine, sine = self._turns[pieces, :2].T
        x, y, z = vectors.T
        return np.column_stack([cosine * x - sine * y, sine * x + cosine * y, z])

    def paint(self, shape, columns, rows, order=None):
        """An image of the bodies' outlines: 255, or in an `order` their numbers, from 1."""
        image, line = np.zeros(shape, np.uint8), cv2.LINE_AA if order is None else cv2.LINE_8
        points = np.round(np.column_stack([columns, rows]) * 16 - 8).astype(np.int32)
        low, high = (edge.reduceat(points, self.starts) for edge in (np.minimum, np.maximum))
        inside = np.all((high > -16) & (low < np.array(shape[::-1]) * 16), axis=1)
        for k in np.flatnonzero(inside) if order is None else order[inside[order]]:
            outline = cv2.convexHull(points[self.starts[k] : self.ends[k]])
            cv2.fillConvexPoly(image, outline, 255 if order is None else int(k) + 1, line, 4)
        return image


def lamp_light(plane, lighting):
    """Of each point of light before a plane: its column, row and height, and its light on each cell."""
    columns, rows = (np.arange(n, dtype=np.float32) + np.float32(0.5) for n in plane.shape[::-1])
    across, along = (np.float32(1 / count) for count in plane.cells)
    for *place, dx, dy, dz, power in stored()[f"lamps_{lighting}"].tolist():
        (column,), (row,), (height,) = plane.of(np.array([place]))
        if height < 0.02:
            continue
        right, down, up = (np.float32(way * (dx, dy, dz)[axis]) for axis, _, way in plane[:3])
        x, y = (columns - np.float32(column)) * across, (rows[:, None] - np.float32(row)) * along
        squared = (x * x) + (y * y + np.float32(height * height))
        leaving = np.maximum(x * right + (y * down - up * np.float32(height)), 0)
        yield (column, row, height), leaving * np.float32(height * power) / (squared * squared)


def direct_share(plane, placed, lighting):
    """The share of the direct light that reaches each cell of a plane, uint8 of 255."""
    columns, rows, heights = plane.of(placed.points)
    blocked, total = np.zeros(plane.shape, np.float32), np.full(plane.shape, 1e-9, np.float32)
    for (column, row, height), light in lamp_light(plane, lighting):
        stretch = height / (height - np.minimum(heights, height - 0.08))
        right, down = column + (columns - column) * stretch, row + (rows - row) * stretch
        total += light
        blocked += light * placed.paint(plane.shape, right, down)
    return (np.float32(255.5) - blocked / total).astype(np.uint8)


def sky_share(plane, placed):
    """The share of the indirect light that reaches each cell of a plane, uint8 of 255."""
    columns, rows, heights = plane.of(placed.points)
    across, along = (np.maximum(heights, 0) * count for count in plane.cells)
    covered = np.zeros(plane.shape, np.uint16)
    for x, y in stored()["sky"].tolist():
        covered += placed.paint(plane.shape, columns - across * x, rows - along * y)
    return (255 - covered * np.float32(SKY_SHARE / len(stored()["sky"]))).astype(np.uint8)


def light_image(atlas, kind, lighting):
    """An image of light, (H, W, 3) float32."""
    image = enlarged(read_image(f"pieces/{atlas}_{kind}_{lighting}.jpg"), ATLASES[atlas].size)
    steps = np.arange(256, dtype=np.float32)
    return (steps * steps * np.float32(BRIGHTEST[kind] / 65025))[image]


class FloorLight:
    """The light on the floor, (512, 1024, 3) float32: `empty` and `shaded` without the sun, by day the `sun`.

    sun_share (512, 1024) uint8 of 255: how much of it the bodies let through. _maps: points of the sun, as
    slopes, and the body (from 1) that their light to each cell meets.
    """

    def __init__(self, placed, lighting):
        direct, indirect = (light_image("floor", kind, lighting) for kind in ("direct", "indirect"))
        coarse = direct_share(FLOOR, placed, lighting), sky_share(FLOOR, placed)
        shares = [enlarged(share, ATLASES["floor"].size)[..., None] for share in coarse]
        self.empty = direct + indirect + np.float32(1e-6)
        self.shaded = (direct * shares[0] + indirect * shares[1]) * np.float32(1 / 255)
        self._middles, self.sun = placed.middles, None
        if lighting == "day":
            self.sun = light_image("floor", "sun", lighting)
            order = np.argsort(placed.middles, kind="stable")
            self._maps = [
                (slope, placed.paint(SUNNY_FLOOR.shape, *below(slope, placed.points), order))
                for slope in stored()["sun_slopes"].tolist()
            ]
            free = sum((above == 0).astype(np.uint16) for _, above in self._maps)
            self.sun_share = (free * 255 // len(self._maps)).astype(np.uint8)

    def sun_on(self, points, normals, bodies):
        """The sun's light on points (N, 3) of bodies, (N, 3); none shades itself."""
        light = np.zeros((len(points), 3), np.float32)
        if self.sun is None:
            return light
        x, y, z = stored()["sun"].tolist()
        facing = sum(normals[:, k] * np.float32(way) for k, way in enumerate((x, y, z)))
        sun = at_cells(self.sun, *below((x / z, y / z), points))
        rows = np.flatnonzero((facing > 0) & (sun[:, 1] > 0))
        points, own, free = points[rows], bodies[rows] + 1, np.zeros(len(rows), np.float32)
        middles = np.array([-1, *self._middles], np.float32)
        for slope, above in self._maps:
            body = at_cells(above, *below(slope, points))
            free += (middles[body] <= points[:, 2]) | (body == own)
        weight = facing[rows] * free * np.float32(1 / (len(self._maps) * z))
        light[rows] = sun[rows] * weight[:, None]
        return light


def below(slope, points):
    """Columns and rows of the floor's cells to which the sun casts the shadows of points (N, 3)."""
    columns, rows, heights = SUNNY_FLOOR.of(points)
    across, along = (np.float32(way * count) for way, count in zip(slope, SUNNY_FLOOR.cells, strict=True))
    return columns - heights * across, rows + heights * along


def at_cells(image, columns, rows):
    height, width = image.shape[:2]
    rows, columns = np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)
    return image[rows.astype(np.int32), columns.astype(np.int32)]


def of_rug(image, placed):
    """An image of the floor, (512, 1024, …), at the texels of the rug, (256, 256, …)."""
    corner, right, up = stored()["rug_frame"].astype(np.float32)
    steps = ((np.arange(256, dtype=np.float32) + np.float32(0.5)) / 256)[:, None]
    flat = (steps * (right - corner))[None] + (corner + (1 - steps) * (up - corner))[:, None]
    points = np.insert(flat.reshape(-1, 2), 2, 0, axis=1)
    columns, rows, _ = SUNNY_FLOOR.of(placed.places(points, np.full(len(points), stored()["rug_piece"])))
    return at_cells(image, columns, rows).reshape(256, 256, *image.shape[2:])


def wall_shares(placed, lighting):
    """How much of its light in the empty room each texel of the room has, (512, 512, 3) float32."""
    direct, indirect = (light_image("room", kind, lighting).reshape(-1, 3) for kind in ("direct", "indirect"))
    result = np.ones_like(direct)
    ends, texels, across = (stored()[f"wall_{name}"] for name in ("ends", "texels", "across"))
    for plane, first, last in zip(WALLS, [0, *ends[:-1]], ends, strict=True):
        finer = 2 * plane.shape[1], 2 * plane.shape[0]
        columns, rows = (across[first:last] * np.float32(2 / 25)).T
        coarse = direct_share(plane, placed, lighting), sky_share(plane, placed)
        shares = [at_cells(enlarged(share, finer), columns, rows) for share in coarse]
        changed = np.flatnonzero((shares[0] < 255) | (shares[1] < 255))
        mine = texels[first:last][changed]
        lit = direct[mine] * shares[0][changed, None] + indirect[mine] * shares[1][changed, None]
        result[mine] = lit / ((direct[mine] + indirect[mine] + np.float32(1e-6)) * 255)
    return np.minimum(result, 1).reshape(*ATLASES["room"].size, 3)


def light_on_pieces(atlas, placed, floor, lighting):
    """The light on the texels of furniture or signs that have a place, (N, 3) float32."""
    kinds = ("piece", "body", "place", "normal")
    pieces, bodies, places, normals = (stored()[f"{atlas}_{kind}"] for kind in kinds)
    points = placed.places(places * np.float32(0.001), pieces)
    normals = placed.directions(normals * np.float32(1 / 127), pieces)
    return irradiance(points, normals, lighting) + floor.sun_on(points, normals, bodies)


def irradiance(points, normals, lighting):
    """The light of the empty room on points (N, 3), without the sun, from the probes around each."""
    light = stored()[f"probes_{lighting}"].astype(np.float32)
    _, rows, levels = light.shape[:3]
    flat, squares = light.reshape(-1, 3), normals * normals
    sides = [2 * axis + (normals[:, axis] < 0) for axis in range(3)]
    (x, right), (y, up), (level, _) = (between(points[:, k], k, light.shape[k]) for k in range(3))
    result = np.zeros((len(points), 3), np.float32)
    for (i, across), (k, along) in itertools.product(((0, 1 - right), (1, right)), ((0, 1 - up), (1, up))):
        cell = (((x + i) * rows + y + k) * levels + level) * 6
        for axis in range(3):
            result += flat[cell + sides[axis]] * (across * along * squares[:, axis])[:, None]
    return result


def between(values, axis, count):
    """Index of the probe before each value along an axis, and the share of the way to the next."""
    low, high = stored()["probes_from_to"][axis].tolist()
    steps = np.clip((values - np.float32(low)) * np.float32((count - 1) / (high - low)), 0, count - 1)
    first = np.minimum(steps.astype(np.int32), count - 2)
    return first, steps - first.astype(np.float32)
