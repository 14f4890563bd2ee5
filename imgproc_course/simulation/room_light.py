"""The light of a furnished room: textures of the empty room and of its pieces, lit where they stand.

Floor, rug and walls are stored in the empty room's light, in parts: of window and lamp (direct), of everything
that they shine on (indirect), of the sun. Each part is weakened by what stands in its way. Furniture and signs
are stored in one light, and get that of small cubes (probes) in the empty room, and of the sun.

What decides a byte is done in whole numbers, or in sums, products, quotients and square roots written out:
these are the same on every processor.
"""

import functools
import itertools
import math
from typing import NamedTuple

import cv2
import numpy as np

from .room_model import FILES as ROOM_FILES

FILES = ROOM_FILES / "pieces"
ATLASES = ("floor", "rug", "room", "furniture", "signs")
BRIGHTEST = {"direct": 2.0, "indirect": 2.0, "sun": 8.0}  # light of the code 255 in the images of light
X0, X1, Y0, Y1, HEIGHT = -0.9, 5.6, -2.1, 2.3, 2.45  # metres: the room
WINDOW = ((1.7, 3.5), (0.85, 2.15))  # metres, x and z
LAMP, LAMP_RADIUS = (1.6, -0.2, 2.4), 0.25  # metres
POWER = {"day": (110.0, 26.0), "evening": (1.2, 60.0)}  # of window and lamp
SUN = (0.0698, 0.6978, 0.7118)  # the unit vector towards it
SUN_RADIUS = 0.009  # of SUN's components
SKY_SHARE = 0.85  # of the indirect light that a body in its way takes
GOLDEN_ANGLE = 2.399963
PLAIN, BRIGHT = 256, 128  # what stands for the ratio 1: floor and walls only get darker
STEPS = 1024  # of the square root of a ratio of light, up to 4
INK = 26


class Plane(NamedTuple):
    """A floor or wall as an image of cells: how its columns, rows and heights follow from x, y, z."""

    column: tuple[int, float, int]  # axis, origin in metres, direction
    row: tuple[int, float, int]
    height: tuple[int, float, int]
    size: tuple[float, float]  # metres
    shape: tuple[int, int]  # rows, columns

    def of(self, points):
        """Columns and rows in cells, and heights in metres, of points (N, 3)."""
        column, row, height = (way * (points[:, axis] - at) for axis, at, way in self[:3])
        return column * (self.shape[1] / self.size[0]), row * (self.shape[0] / self.size[1]), height


def wall(along, across, way):
    """The Plane of a wall along axis 0 or 1; `across`: where it stands on the other axis."""
    length, first = ((X1 - X0, X0), (Y1 - Y0, Y0))[along]
    shape = (round(HEIGHT / 0.025), round(length / 0.025))
    return Plane((along, first, 1), (2, 0, 1), (1 - along, across, way), (length, HEIGHT), shape)


FLOOR = Plane((0, X0, 1), (1, Y1, -1), (2, 0, 1), (X1 - X0, Y1 - Y0), (256, 512))
SUNNY = FLOOR._replace(shape=(512, 1024))
WALLS = (wall(1, X0, 1), wall(1, X1, -1), wall(0, Y0, 1), wall(0, Y1, -1))  # numbered from 1 in light.npz


@functools.cache
def stored():
    """{name: array} of light.npz, which environment/room/compose_pieces.py writes."""
    with np.load(FILES / "light.npz") as file:
        return dict(file)


def words():
    """The words that the sign can have."""
    return tuple(name.removeprefix("word_") for name in stored() if name.startswith("word_"))


def textures(poses, lighting, word=None):
    """The textures of a lighting, for pieces at {name: (x, y, yaw)}: {atlas: (H, W, 3) uint8 BGR}.

    Parameters
    ----------
    poses : of every piece: where its origin is, in metres, and its turn against the recorded room, in radians
    lighting : "day" or "evening"
    word : of the sign's first line, one of `words()`; if omitted, the recorded room's
    """
    placed = Placed(poses)
    images = {atlas: read(f"{atlas}_{lighting}.jpg") for atlas in ATLASES}
    small = {atlas: reduced(image, SMALL[atlas]) for atlas, image in images.items()}
    write(images["signs"], word or words()[0])
    floor = FloorLight(placed, lighting)
    light = {
        "floor": floor.shaded / floor.empty,
        "rug": rug_light(floor, placed) / reference(lighting),
        "room": wall_shares(placed, lighting),
    }
    ratio = {atlas: ratios(atlas, lighting, small[atlas], light[atlas]) for atlas in light}
    for atlas in ("furniture", "signs"):
        light = light_on_pieces(atlas, placed, floor, lighting) / reference(lighting)
        known = stored()[f"{atlas}_known"]
        ratio[atlas] = as_image(ratios(atlas, lighting, small[atlas][known], light), known)
    lit = {atlas: times(images[atlas], ratio[atlas], SCALE[atlas]) for atlas in ATLASES}
    if lighting == "day":
        add_sun(lit["floor"], floor)
    return lit


# images and ratios

SMALL = {"floor": (1024, 512), "rug": (256, 256), "room": (512, 512), "furniture": (512, 512), "signs": (256, 256)}
SCALE = {"floor": PLAIN, "room": PLAIN, "rug": BRIGHT, "furniture": BRIGHT, "signs": BRIGHT}


def read(name):
    image = cv2.imread(str(FILES / name))
    if image is None:
        raise FileNotFoundError(
            f"the room's file {name} is missing or damaged; restore it: "
            "git checkout -- imgproc_course/simulation/room"
        )
    return image


def reduced(image, size):
    """An image by a whole factor smaller."""
    return cv2.resize(image, size, interpolation=cv2.INTER_AREA)


def times(image, ratio, one):
    """An image times a smaller image of ratios, of which `one` stands for 1."""
    large = cv2.resize(ratio, image.shape[1::-1], interpolation=cv2.INTER_LINEAR)
    return cv2.multiply(image, large, scale=1 / one)


def codes(ratio):
    """Ratios of light as rows of `ratio_table`."""
    return np.minimum(np.sqrt(ratio) * np.float32(STEPS / 4) + np.float32(0.5), STEPS - 1).astype(np.uint16)


@functools.cache
def ratio_tables(atlas, lighting):
    """Three of (256, STEPS) uint8: the ratio by which a value of blue, green, red changes with a ratio of light."""
    light, curve = stored()["curve_light"].astype(float), stored()[f"curve_{atlas}_{lighting}"] / 257
    value = np.arange(256)[:, None]
    ratio = (np.arange(STEPS) * (4 / STEPS)) ** 2
    tables = []
    for channel in curve.T:
        after = np.interp(np.interp(value, channel, light) * ratio, light, channel)
        tables.append(np.clip(np.round(SCALE[atlas] * (after + 1) / (value + 1)), 0, 255).astype(np.uint8))
    return tables


def ratios(atlas, lighting, values, light):
    """The ratios of values (..., 3) of an image, by which light changes by ratios of the same shape."""
    tables, steps = ratio_tables(atlas, lighting), codes(light)
    return np.stack([tables[k][values[..., k], steps[..., k]] for k in range(3)], -1)


def write(image, word):
    """Prints a word on the signs' texture, in place."""
    ink = stored()[f"word_{word}"][..., None].astype(np.uint16)
    top, left = stored()["word_corner"]
    box = image[top : top + ink.shape[0], left : left + ink.shape[1]]
    box[:] = (box * (255 - ink) + INK * ink + 127) // 255


def reference(lighting):
    """The light in which furniture, rug and signs are stored: blue, green, red."""
    return stored()[f"reference_{lighting}"][::-1].astype(np.float32)


# shadows


class Placed:
    """The pieces' turns and places, and the bodies that cast shadows, each a cloud of points in the room."""

    def __init__(self, poses):
        data = stored()
        ordered = [poses[name] for name in data["pieces"].tolist()]
        values = [(round(math.cos(yaw), 12), round(math.sin(yaw), 12), x, y) for x, y, yaw in ordered]
        self._turns = np.array([*values, (1, 0, 0, 0)], np.float32)  # the last one, -1, is of what does not move
        self.ends = data["part_ends"]
        pieces = np.repeat(data["part_piece"], np.diff(self.ends, prepend=0))
        self.points = self.places(data["part_points"] * np.float32(0.001), pieces)
        self.heights = np.array([self.points[first:last, 2].mean() for first, last in self.spans])

    @property
    def spans(self):
        return itertools.pairwise([0, *self.ends.tolist()])

    def places(self, points, pieces):
        """Points (N, 3) of pieces in the room."""
        cosine, sine, x, y = self._turns[pieces].T
        return np.column_stack(
            [cosine * points[:, 0] - sine * points[:, 1] + x, sine * points[:, 0] + cosine * points[:, 1] + y, points[:, 2]]
        )

    def directions(self, vectors, pieces):
        """Directions (N, 3) of pieces in the room."""
        cosine, sine = self._turns[pieces, :2].T
        x, y, z = vectors.T
        return np.column_stack([cosine * x - sine * y, sine * x + cosine * y, z])


def paint(image, spans, columns, rows, values=itertools.repeat(255), line=cv2.LINE_AA):
    """Fills the outlines of clouds of points, in cells."""
    points = np.round(np.column_stack([columns, rows]) * 16 - 8).astype(np.int32)
    for (first, last), value in zip(spans, values):
        cv2.fillConvexPoly(image, cv2.convexHull(points[first:last]), int(value), line, 4)
    return image


def lamps(lighting):
    """Points of light: place, direction, power."""
    window, lamp = POWER[lighting]
    (x0, x1), (z0, z1) = WINDOW
    columns, rows = (6, 4) if lighting == "day" else (1, 1)
    for i, k in itertools.product(range(columns), range(rows)):
        place = (x0 + (x1 - x0) * (i + 0.5) / columns, Y1 + 0.1, z0 + (z1 - z0) * (k + 0.5) / rows)
        yield place, (0, -1, 0), window / (columns * rows)
    count = 8 if lighting == "day" else 16
    for k in range(count):
        radius, angle = LAMP_RADIUS * math.sqrt((k + 0.5) / count), k * GOLDEN_ANGLE
        x, y = round(radius * math.cos(angle), 9), round(radius * math.sin(angle), 9)
        yield (LAMP[0] + x, LAMP[1] + y, LAMP[2]), (0, 0, -1), lamp / count


@functools.cache
def sky(count=28):
    """Directions from which as much light comes each: across and along a plane for each unit of height."""
    result = []
    for k in range(count):
        z = max(math.sqrt(1 - (k + 0.5) / count), 0.25)
        angle, r = k * GOLDEN_ANGLE, math.sqrt(1 - z * z) / z
        result.append((round(r * math.cos(angle), 9), round(r * math.sin(angle), 9)))
    return result


@functools.cache
def lamp_light(plane, lighting):
    """Of each lamp that shines on a plane: its place in cells and height, and its light on each cell."""
    columns, rows = (np.arange(n, dtype=np.float32) + np.float32(0.5) for n in plane.shape[::-1])
    cell = np.float32(plane.size[0] / plane.shape[1]), np.float32(plane.size[1] / plane.shape[0])
    result = []
    for place, direction, power in lamps(lighting):
        (column,), (row,), (height,) = plane.of(np.array([place]))
        if height < 0.02:
            continue
        towards = [np.float32(way * direction[axis]) for axis, _, way in plane[:3]]
        x, y = (columns[None] - np.float32(column)) * cell[0], (rows[:, None] - np.float32(row)) * cell[1]
        squared = x * x + y * y + np.float32(height * height)
        leaving = np.maximum(x * towards[0] + y * towards[1] - towards[2] * np.float32(height), 0)
        result.append(((column, row, height), leaving * np.float32(height * power) / (squared * squared)))
    return result


def direct_share(plane, placed, lighting):
    """The share of the direct light that reaches each cell of a plane, uint8, 255 for all."""
    columns, rows, heights = plane.of(placed.points)
    blocked, total = np.zeros(plane.shape, np.float32), np.full(plane.shape, 1e-9, np.float32)
    for (column, row, height), light in lamp_light(plane, lighting):
        stretch = height / (height - np.minimum(heights, height - 0.08))
        shadow = np.zeros(plane.shape, np.uint8)
        paint(shadow, placed.spans, column + (columns - column) * stretch, row + (rows - row) * stretch)
        total += light
        blocked += light * shadow
    return (np.float32(255.5) - blocked / total).astype(np.uint8)


def sky_share(plane, placed):
    """The share of the indirect light that reaches each cell of a plane, uint8, 255 for all."""
    columns, rows, heights = plane.of(placed.points)
    heights = np.maximum(heights, 0)
    across, along = plane.shape[1] / plane.size[0], plane.shape[0] / plane.size[1]
    covered = np.zeros(plane.shape, np.uint16)
    for x, y in sky():
        shadow = np.zeros(plane.shape, np.uint8)
        covered += paint(shadow, placed.spans, columns - heights * (x * across), rows - heights * (y * along))
    return (255 - covered * np.float32(SKY_SHARE / len(sky()))).astype(np.uint8)


# light


def light_image(atlas, kind, lighting, size):
    """An image of light, (H, W, 3) float32."""
    image = cv2.resize(read(f"{atlas}_{kind}_{lighting}.png"), size, interpolation=cv2.INTER_LINEAR)
    steps = np.arange(256, dtype=np.float32)
    return (steps * steps * np.float32(BRIGHTEST[kind] / 65025))[image]


class FloorLight:
    """The light on the floor, (512, 1024, 3) float32, without the sun: empty, shaded; and the sun, also on pieces."""

    def __init__(self, placed, lighting):
        size = SUNNY.shape[::-1]
        direct, indirect = (light_image("floor", kind, lighting, size) for kind in ("direct", "indirect"))
        self.empty = direct + indirect + np.float32(1e-6)
        shares = direct_share(FLOOR, placed, lighting), sky_share(FLOOR, placed)
        shares = [cv2.resize(share, size, interpolation=cv2.INTER_LINEAR)[..., None] for share in shares]
        self.shaded = (direct * shares[0] + indirect * shares[1]) * np.float32(1 / 255)
        self._placed = placed
        self.sun, self._maps = None, []
        if lighting == "day":
            self.sun = light_image("floor", "sun", lighting, size)
            self._maps = [self._map_of_sun(k) for k in range(4)]
            self.sun_share = (sum((numbers == 0).astype(np.uint16) for _, numbers in self._maps) * 255 // 4).astype(np.uint8)

    def _map_of_sun(self, k):
        """A direction of the sun, for each unit of height, and which body (from 1) it meets above each cell."""
        x, y, z = SUN[0] + SUN_RADIUS * (k % 2 * 2 - 1), SUN[1], SUN[2] + SUN_RADIUS * (k // 2 * 2 - 1)
        order = np.argsort(self._placed.heights, kind="stable")
        spans = list(self._placed.spans)
        columns, rows = self._below((x / z, y / z), self._placed.points)
        numbers = paint(np.zeros(SUNNY.shape, np.uint8), [spans[k] for k in order], columns, rows, order + 1, cv2.LINE_8)
        return (x / z, y / z), numbers

    def _below(self, slope, points):
        """Columns and rows of the floor on which the sun casts the shadows of points (N, 3)."""
        columns, rows, heights = SUNNY.of(points)
        across, along = SUNNY.shape[1] / SUNNY.size[0], SUNNY.shape[0] / SUNNY.size[1]
        return columns - heights * np.float32(slope[0] * across), rows + heights * np.float32(slope[1] * along)

    def at(self, points):
        """The light on the floor at points (N, 3) on it, (N, 3)."""
        columns, rows, _ = SUNNY.of(points)
        cell = cells(rows, 512), cells(columns, 1024)
        light = self.shaded[cell]
        if self.sun is not None:
            light += self.sun[cell] * (self.sun_share[cell].astype(np.float32) * np.float32(1 / 255))[:, None]
        return light

    def sun_at(self, points, normals, parts):
        """The sun's light on points (N, 3) of pieces; no body shades its own."""
        light = np.zeros((len(points), 3), np.float32)
        if self.sun is None:
            return light
        slopes = normals[:, 0] * np.float32(SUN[0]) + normals[:, 1] * np.float32(SUN[1])
        slopes += normals[:, 2] * np.float32(SUN[2])
        columns, rows = self._below((SUN[0] / SUN[2], SUN[1] / SUN[2]), points)
        sun = self.sun[cells(rows, 512), cells(columns, 1024)]
        rows_in_sun = np.flatnonzero((slopes > 0) & (sun[:, 1] > 0))
        lit = np.zeros(len(rows_in_sun), np.float32)
        points, parts = points[rows_in_sun], parts[rows_in_sun] + 1
        for slope, numbers in self._maps:
            columns, rows = self._below(slope, points)
            body = numbers[cells(rows, 512), cells(columns, 1024)]
            above = np.array([-1, *self._placed.heights], np.float32)[body] > points[:, 2]
            lit += ~above | (body == parts)
        weight = slopes[rows_in_sun] * lit * np.float32(0.25 / SUN[2])
        light[rows_in_sun] = sun[rows_in_sun] * weight[:, None]
        return light


def cells(values, count):
    return np.clip(values, 0, count - 1).astype(np.int32)


def rug_light(floor, placed):
    """The floor's light on each texel of the rug, (256, 256, 3) float32."""
    corner, right, up = stored()["rug_frame"]
    steps = (np.arange(256) + 0.5) / 256
    x = corner + steps[None, :, None] * (right - corner) + (1 - steps)[:, None, None] * (up - corner)
    flat = np.column_stack([x.reshape(-1, 2), np.zeros(256 * 256)])
    piece = np.full(len(flat), stored()["rug_piece"])
    return floor.at(placed.places(flat, piece)).reshape(256, 256, 3)


def wall_shares(placed, lighting):
    """How much of its light in the empty room each texel of the room has, (512, 512, 3) float32."""
    size = SMALL["room"]
    direct, indirect = (light_image("room", kind, lighting, size) for kind in ("direct", "indirect"))
    result = np.ones(direct.shape, np.float32)
    number, across = stored()["room_wall"], stored()["room_across"]
    for k, plane in enumerate(WALLS, 1):
        mine = number == k
        columns, rows = (across[mine] * np.float32(2 / 25)).astype(np.int32).T
        shares = []
        for share in (direct_share(plane, placed, lighting), sky_share(plane, placed)):
            share = cv2.resize(share, None, fx=2, fy=2, interpolation=cv2.INTER_LINEAR)
            height, width = share.shape
            shares.append(share[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1), None])
        lit = direct[mine] * shares[0] + indirect[mine] * shares[1]
        result[mine] = lit / ((direct[mine] + indirect[mine] + np.float32(1e-6)) * np.float32(255))
    return np.minimum(result, 1)


def light_on_pieces(atlas, placed, floor, lighting):
    """The light on the known texels of furniture or signs, (N, 3) float32: blue, green, red."""
    data = stored()
    pieces = data[f"{atlas}_piece"]
    points = placed.places(data[f"{atlas}_place"] * np.float32(0.001), pieces)
    normals = placed.directions(data[f"{atlas}_normal"] * np.float32(1 / 127), pieces)
    return irradiance(points, normals, lighting) + floor.sun_at(points, normals, data[f"{atlas}_part"])


def irradiance(points, normals, lighting):
    """The light of the empty room on points (N, 3), without the sun, from the probes around each."""
    probes = stored()[f"probes_{lighting}"][..., ::-1]
    counts = probes.shape[:3]
    flat = np.ascontiguousarray(probes).reshape(-1, 3)
    grids = [stored()[f"probe_{axis}"] for axis in "xyz"]
    first, after = zip(*(between(points[:, k], grids[k]) for k in range(3)), strict=True)
    sides = [2 * axis + (normals[:, axis] < 0) for axis in range(3)]
    squares = normals * normals
    light = np.zeros((len(points), 3), np.float32)
    for corner in itertools.product((0, 1), repeat=3):
        weight = functools.reduce(np.multiply, [a if k else 1 - a for a, k in zip(after, corner, strict=True)])
        x, y, z = (a + k for a, k in zip(first, corner, strict=True))
        cell = ((x * counts[1] + y) * counts[2] + z) * 6
        for axis in range(3):
            light += flat[cell + sides[axis]] * (weight * squares[:, axis])[:, None]
    return light


def between(values, grid):
    """Index of the grid's value before each, and the share of the way to the next."""
    steps = (values - np.float32(grid[0])) * np.float32((len(grid) - 1) / (grid[-1] - grid[0]))
    steps = np.clip(steps, 0, np.float32(len(grid) - 1))
    first = np.minimum(steps.astype(np.int32), len(grid) - 2)
    return first, steps - first.astype(np.float32)


def add_sun(image, floor):
    """Lights the floor's texture where the sun reaches it, in place."""
    sunny = read("floor_sunny.jpg")
    height, width = sunny.shape[:2]
    top, left = stored()["sunny_corner"]
    box = np.s_[top // 4 : (top + height) // 4, left // 4 : (left + width) // 4]
    light = (floor.shaded[box] + floor.sun[box]) / (floor.empty[box] + floor.sun[box])
    small = reduced(sunny, (width // 4, height // 4))
    sunny = times(sunny, ratios("floor", "day", small, light), PLAIN)
    share = cv2.resize(floor.sun_share[box], (width, height), interpolation=cv2.INTER_LINEAR)
    share = share[..., None].astype(np.uint16)
    part = image[top : top + height, left : left + width]
    part[:] = (part * (255 - share) + sunny * share + 127) // 255


def as_image(ratio, known):
    """Ratios (N, 3) of the known texels as an image; around them those beside them."""
    image = np.zeros((*known.shape, 3), np.uint8)
    image[known] = ratio
    around = cv2.dilate(image, np.ones((3, 3), np.uint8))
    return np.where(known[..., None], image, around)
