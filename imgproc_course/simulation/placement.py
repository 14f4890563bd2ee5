"""Where the pieces of furniture stand in a room that is drawn by chance: rules, and tries until they hold.

What decides is exact on every processor: whole numbers, rounded cosines, and squared distances in cells.
"""

import math

import cv2
import numpy as np

from .pieces import direction, turned

WALLS = (
    (0, -0.9, 0.0),
    (0, 5.6, math.pi),
    (1, -2.1, math.pi / 2),
    (1, 2.3, -math.pi / 2),
)  # axis, at, inwards
AREA = np.array([(-0.9, -2.1), (5.6, 2.3)])  # lowest and highest x and y of the floor, metres
ORIGIN = AREA[0] - 0.1
GRID = 0.02  # metres: the cells in which pieces keep their distance
SHAPE = (230, 335)  # rows and columns of the grid
# Which way those pieces look that stand or hang at walls, in the recorded room; and the stand with a marker.
FRONTS = {"sofa": -math.pi / 2, "shelf": math.pi, "sign": math.pi, "wall_marker": 0.0, "picture": math.pi}
STAND_FRONT = math.pi
LARGE, SHOWN, SMALL = ("sofa", "shelf"), ("sign", "wall_marker"), ("slippers", "blocks")
FREE = ("table", "cartons", "stand", "plant", "carton", "bin", "chair", "slippers", "blocks")
BESIDE_WALLS = ("plant", "bin", "cartons", "carton")
ON_RUG = ("table", "chair")
# Stretches of walls that some pieces do not cover: number of the wall, from, to, and the pieces that may.
DOOR = (-1.55, -0.72)
BLOCKED = (
    (1, DOOR[0] - 0.15, DOOR[1] + 0.15, ()),
    (3, 1.58, 3.62, ("sofa",)),  # the window
    (2, 2.84, 2.96, ("sofa", "sign", "picture")),  # the socket
)
TRIES = 300
PASSAGE = 0.5  # metres between pieces
TO_WALL = (0.03, 0.12)  # metres between a wall and a piece that stands at it
BESIDE_RUG = 0.04
SEEN_FROM, BORDER = 0.8, 0.05  # metres before and beside sign and markers, where nothing tall stands
DOORWAY = 0.9  # metres before the door, where nothing stands


def cells(points, cell=GRID):
    """Columns and rows (N,) of the points (N, 2)."""
    return np.floor((points - ORIGIN) / cell).astype(int).T


def painted(grid, polygons, cell=GRID, filled=True):
    """Sets the cells of polygons (K, 2), metres, to 1."""
    for polygon in polygons:
        corners = np.rint(((polygon - ORIGIN) / cell - 0.5) * 256).astype(np.int32)
        if filled and len(corners) > 2:
            cv2.fillPoly(grid, [corners], 1, 8, 8)
        cv2.polylines(grid, [corners], True, 1, 1, 8, 8)
    return grid


def squared_distances(grid):
    """Squared distance of each cell to the nearest cell that is not 0, in cells: whole numbers."""
    distance = cv2.distanceTransform((grid == 0).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.rint(distance.astype(float) ** 2)


def rectangle(ahead, aside):
    """Corners (4, 2) from 0 to `ahead` along x, and `aside` metres to both sides."""
    return np.array([(0, -aside), (ahead, -aside), (ahead, aside), (0, aside)])


class Placement:
    """Places of pieces: `draw` puts one after the other, and `places` has those that found theirs."""

    def __init__(self, random, pieces):
        self.places: dict[str, tuple[float, float, float]] = {}
        self._random, self._hulls, self._origins = random, pieces.hulls, pieces.origins
        self._borders = pieces.borders
        self._taken, self._kept, self._rug = (np.zeros(SHAPE, np.uint8) for _ in range(3))
        middle, half = (DOOR[0] + DOOR[1]) / 2, (DOOR[1] - DOOR[0]) / 2 + BORDER
        doorway = turned(rectangle(DOORWAY, half), (AREA[1, 0], middle, math.pi))
        self._doorway = painted(np.zeros(SHAPE, np.uint8), [doorway])
        self._to_taken = self._to_rug = np.full(SHAPE, np.inf)
        self._spans: list[list[tuple[float, float, str]]] = [[] for _ in WALLS]

    def draw(self):
        """Whether every piece found a place."""
        steps = [(self._at_wall, name) for name in FRONTS]
        steps += [(self._rug_place, "rug"), *((self._free_place, name) for name in FREE)]
        return all(any(step(name) for _ in range(TRIES)) for step, name in steps)

    def _uniform(self, low, high, digits=3):
        return round(float(self._random.uniform(low, high)), digits)

    def _is_far(self, squared, points, metres):
        """Whether no point is nearer than this, by squared distances."""
        columns, rows = cells(points)
        return squared[rows, columns].min() >= (metres / GRID) ** 2

    def _is_off(self, grid, points):
        columns, rows = cells(points)
        return not grid[rows, columns].any()

    def _put(self, name, place):
        self.places[name] = place
        painted(self._taken, [turned(self._hulls[name], place)])
        self._to_taken = squared_distances(self._taken)

    def _at_wall(self, name):
        wall = int(self._random.integers(len(WALLS)))
        axis, at, inwards = WALLS[wall]
        yaw = round(math.remainder(inwards - FRONTS[name], 2 * math.pi), 6)
        sides = np.round(turned(self._hulls[name], (0, 0, yaw))[:, 1 - axis], 3)
        low, high = float(sides.min()), float(sides.max())
        spot = self._uniform(AREA[0, 1 - axis] - low + 0.06, AREA[1, 1 - axis] - high - 0.06)
        depth = round(self._gap(name) * (1 if at == AREA[0, axis] else -1) + at, 3)
        place = (depth, spot, yaw) if axis == 0 else (spot, depth, yaw)
        span = (low + spot, high + spot, name)
        if not self._is_free_stretch(wall, span):
            return False
        if name in LARGE:
            border = turned(self._borders[name], place)
            if not self._is_far(self._to_taken, border, PASSAGE) or not self._is_off(self._doorway, border):
                return False
            self._put(name, place)
        elif name in SHOWN:
            zone = turned(rectangle(SEEN_FROM, (high - low) / 2 + BORDER), (*place[:2], inwards))
            if not self._keep(zone):
                return False
        self.places[name] = place
        self._spans[wall].append(span)
        return True

    def _gap(self, name):
        """Metres between the origin of a piece and the wall behind it."""
        axis, at = next(wall[:2] for wall in WALLS if wall[2] == FRONTS[name])
        return abs(at - self._origins[name][axis])

    def _is_free_stretch(self, wall, span):
        low, high, name = span
        blocked = any(
            number == wall and name not in allowed and low < end and high > begin
            for number, begin, end, allowed in BLOCKED
        )
        return not blocked and not any(
            low < end + 0.1 and high > begin - 0.1 and {name, other} != {"sofa", "picture"}
            for begin, end, other in self._spans[wall]
        )

    def _keep(self, zone):
        """Keeps a zone free of what is tall; False if something stands there."""
        cover = painted(np.zeros(SHAPE, np.uint8), [zone])
        if (cover & self._taken).any():
            return False
        self._kept |= cover
        return True

    def _rug_place(self, name):
        yaw = round(int(self._random.integers(2)) * math.pi / 2 + self._uniform(-0.1, 0.1), 6)
        place = (self._uniform(0.2, 4.6), self._uniform(-1.3, 1.5), yaw)
        border = turned(self._borders[name], place)
        if self._to_wall(border) < 0.2 or not self._is_far(self._to_taken, border, 0.03):
            return False
        self.places[name] = place
        painted(self._rug, [turned(self._hulls[name], place)])
        self._to_rug = squared_distances(self._rug)
        return True

    @staticmethod
    def _to_wall(points):
        """Metres between points and the nearest wall; negative outside."""
        return min((points - AREA[0]).min(), (AREA[1] - points).min())

    def _free_place(self, name):
        x, y = (self._uniform(*AREA[:, axis]) for axis in (0, 1))
        place = (x, y, self._free_yaw(name, x, y))
        beside = name in BESIDE_WALLS and self._random.random() < 0.7
        if beside:
            place = self._pushed_to_wall(name, place)
        border = turned(self._borders[name], place)
        wall = self._to_wall(border)
        if not (
            wall >= (TO_WALL[0] if beside else PASSAGE)
            and self._is_far(self._to_taken, border, PASSAGE)
            and self._is_off(self._doorway, border)
            and (name in ON_RUG or self._is_far(self._to_rug, border, BESIDE_RUG))
            and (name in SMALL or self._is_off(self._kept, border))
        ):
            return False
        if name == "stand" and not self._keep_before_stand(place):
            return False
        self._put(name, place)
        return True

    def _pushed_to_wall(self, name, place):
        axis, at, _ = WALLS[int(self._random.integers(len(WALLS)))]
        own = turned(self._hulls[name], (0, 0, place[2]))[:, axis]
        gap = self._uniform(*TO_WALL)
        spot = at + gap - own.min() if at == AREA[0, axis] else at - gap - own.max()
        return (*place[:axis], round(float(spot), 3), *place[axis + 1 :])

    def _free_yaw(self, name, x, y):
        if name == "table":  # nearly parallel to the walls
            return round(int(self._random.integers(4)) * math.pi / 2 + self._uniform(-0.14, 0.14), 6)
        if name == "stand":  # its marker looks about to the middle of the room
            middle = math.atan2(0.1 - y, 2.35 - x)
            return round(math.remainder(middle - STAND_FRONT + self._uniform(-0.5, 0.5), 2 * math.pi), 3)
        return self._uniform(-math.pi, math.pi)

    def _keep_before_stand(self, place):
        c, s = direction(place[2] + STAND_FRONT)
        begin = (place[0] + 0.06 * c, place[1] + 0.06 * s)
        zone = turned(rectangle(SEEN_FROM, 0.18 + BORDER), (*begin, place[2] + STAND_FRONT))
        return self._to_wall(zone) > 0 and self._keep(zone)
