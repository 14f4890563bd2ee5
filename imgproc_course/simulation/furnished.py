"""Rooms with the recorded room's furniture, each of which stands elsewhere: drawn by a seed."""

import contextlib
import functools
import math
from dataclasses import dataclass

import cv2
import numpy as np

from ..geometry import Pose
from .pieces import load_pieces, turned, turned_to_each
from .placement import AREA, DOOR, ORIGIN, SMALL, Placement, cells, painted, squared_distances
from .room import CAR_TIME, WALK_LENGTH, BallWay, CarWay, PersonWay, Room, Rug, recorded_room
from .room_light import WORDS, textures
from .room_model import FreeSpace, read_image
from .wheels import TURNING

CELL = 0.01  # metres: of the free space
SHAPE = (460, 670)
BEHIND_DOOR = (AREA[1, 0] - 0.45, sum(DOOR) / 2)  # always free, and every free place is reached from there
CONNECTED = 0.985  # least share of the places to turn around that are reached from one another
DRAWS = 20  # of a whole room
BATCHES, BATCH = 10, 400  # of places that are tried for what moves
PERSON_ROOM, CAR_ROOM, START_ROOM, BALL_ROOM = 300, 170, 350, 200  # millimetres to what stands still
APART = 0.6  # metres between the ways, the start and the ball
AHEAD = np.stack([np.linspace(0, 1, 20), np.zeros(20)], 1)  # free before the robot, metres
AHEAD_ROOM = 200
NUMBERS = [number for number in range(50) if number not in (7, 12)]  # of markers: not the recorded room's
LOW = ("rug", "sign", "picture", "wall_marker", *SMALL)  # pieces that hide nothing, from above or below
# Distances (m) and angles (rad) from which sign and markers are looked at; of so many places they are seen.
LOOKS = {"sign": (1.4, 2.4), "wall_marker": (0.9, 1.9), "marker": (0.9, 1.9)}
LOOK_ANGLES, LEAST_LOOKS = (-0.5, -0.25, 0.0, 0.25, 0.5), 8
AIMS = ((0.1, -0.15), (0.1, 0.0), (0.1, 0.15))  # metres before and beside the middle: all three are seen


def furnished(seed: int) -> Room:
    """The living room with its furniture, sign and markers elsewhere, another word and other markers.

    The same seed always gives the same room. The last few are kept.

    Parameters
    ----------
    seed : a whole number from 0 on

    Raises
    ------
    ValueError : seed is something else
    """
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ValueError(f"a furnished room has a whole number from 0 on, such as 17, got {seed!r}")
    return _furnished(int(seed))


def room_of(number):
    """The Room of this number; that of the recorded drive for None."""
    return recorded_room() if number is None else furnished(number)


@functools.lru_cache(maxsize=4)
def _furnished(seed):
    for draw in range(DRAWS):
        with contextlib.suppress(NoPlaceError):
            return _drawn(np.random.default_rng([seed, 77, draw]), f"room {seed}")
    raise RuntimeError(f"no furniture fits into room {seed}; take another number")  # seen in none of 1,000


class NoPlaceError(Exception):
    """Something does not fit into a room: another one is drawn."""


def _drawn(random, name):
    """A Room; NoPlaceError if something does not fit."""
    pieces = load_pieces()
    placement = Placement(random, pieces)
    if not placement.draw():
        raise NoPlaceError
    places = placement.places
    floor = Floor.of(pieces, places)
    poses = pieces.poses(places)
    if not (floor.is_connected and all(floor.shows(poses[shown], *LOOKS[shown]) for shown in LOOKS)):
        raise NoPlaceError
    ways = floor.ways(random)
    x, y, yaw = places["rug"]
    word = WORDS[int(random.integers(len(WORDS)))]
    marker, wall_marker = random.choice(NUMBERS, 2, replace=False).tolist()
    markers = {"marker": marker, "wall_marker": wall_marker}
    return Room(
        name=name,
        model=pieces.placed(places),
        free_space=FreeSpace(floor.millimetres, ORIGIN, CELL),
        rug=Rug((x, y), round(yaw + 0.06, 6)),
        textures=functools.cache(
            lambda lighting: (
                textures(places, lighting, word, markers) | {"movers": read_image(f"movers_{lighting}.jpg")}
            )
        ),
        word=word,
        markers=markers,
        poses=poses,
        places=places,
        **ways,
    )


@dataclass(frozen=True, eq=False)
class Floor:
    """Distances (H, W) in millimetres to what is in the robot's way; `tall`: to walls and furniture."""

    millimetres: np.ndarray
    tall: np.ndarray
    turnable: np.ndarray  # 1: where the robot can turn around, reached from the door
    is_connected: bool

    @classmethod
    def of(cls, pieces, places):
        walls = painted(np.zeros(SHAPE, np.uint8), pieces.bodies["room"], CELL, filled=False)
        bodies = [turned(body, place) for name, place in places.items() for body in pieces.bodies[name]]
        hulls = [turned(pieces.hulls[name], place) for name, place in places.items() if name not in LOW]
        tall = reached(painted(walls.copy(), hulls, CELL, filled=False))
        millimetres = reached(painted(walls, bodies, CELL, filled=False))
        can_turn = (millimetres > TURNING * 1000).astype(np.uint8)
        _, parts = cv2.connectedComponents(can_turn, connectivity=4)
        column, row = cells(np.array([BEHIND_DOOR]), CELL)[:, 0]
        turnable = (parts == parts[row, column]) & (can_turn > 0)
        share = turnable.sum() / max(1, can_turn.sum())
        return cls(millimetres, tall, turnable, bool(share >= CONNECTED))

    def _at(self, array, points):
        """Values at points (..., 2); 0 outside."""
        columns, rows = np.moveaxis(np.floor((points - ORIGIN) / CELL).astype(int), -1, 0)
        inside = (columns >= 0) & (rows >= 0) & (columns < SHAPE[1]) & (rows < SHAPE[0])
        return np.where(inside, array[np.where(inside, rows, 0), np.where(inside, columns, 0)], 0)

    def shows(self, pose, near, far):
        """Whether the robot can stand at enough places from which it sees what has this pose."""
        c, s = outwards(pose)
        angle = math.atan2(s, c)
        offsets = [(d, angle + a) for d in np.arange(near, far, 0.1).tolist() for a in LOOK_ANGLES]
        eyes = np.array([(d * math.cos(a), d * math.sin(a)) for d, a in offsets]) + pose[:2]
        aims = np.array([(u * c - v * s, u * s + v * c) for u, v in AIMS]) + pose[:2]
        share = np.linspace(0, 1, 80)[:, None, None, None]
        lines = aims[:, None] + share * (eyes - aims[:, None])  # (share, aim, eye, 2)
        sees = (self._at(self.tall, np.round(lines, 6)) > 0).all((0, 1))
        stands = self._at(self.turnable, np.round(eyes, 6))
        return np.count_nonzero(sees & stands) >= LEAST_LOOKS

    def ways(self, random):
        """Person, car, start and ball as a Room has them; NoPlaceError if one of them does not fit."""
        walk = np.stack([np.linspace(0, WALK_LENGTH, 60), np.zeros(60)], 1)
        car_way = CarWay(0.0, 0.0, 0.0, rug_from=math.inf)
        wave = np.array([car_way.at(time, None)[0][:2] for time in np.linspace(0, CAR_TIME, 60)])
        open_floor = np.minimum(self.millimetres, self.tall)
        robot = np.where(self.turnable, open_floor, 0)
        person, taken = self._fitting(random, walk, open_floor, PERSON_ROOM)
        car, more = self._fitting(random, wave, self.millimetres, CAR_ROOM)
        taken = np.concatenate([taken, more])
        start, place = self._fitting(random, AHEAD, robot, AHEAD_ROOM, START_ROOM, taken)
        ball, _ = self._fitting(random, np.zeros((1, 2)), robot, BALL_ROOM, BALL_ROOM, [*taken, *place])
        ways = {"person": PersonWay(*person), "car": CarWay(*car), "ball": BallWay(ball[:2])}
        return ways | {"start": start}

    def _fitting(self, random, curve, distance, room, first_room=0, taken=()):
        """A place (x, y, yaw) at which each point of the curve has `room` millimetres, and the curve there.

        The first point has `first_room`, and is APART from those that are taken. NoPlaceError if none fits.
        """
        for _ in range(BATCHES):
            places = np.round(random.uniform((*AREA[0], -3.14), (*AREA[1], 3.14), (BATCH, 3)), 3)
            curves = np.round(turned_to_each(curve, places), 6)
            distances = self._at(distance, curves)
            fits = (distances >= room).all(1) & (distances[:, 0] >= first_room)
            for index in np.flatnonzero(fits):
                x, y = curves[index, 0].tolist()
                if all((x - u) ** 2 + (y - v) ** 2 >= APART**2 for u, v in taken):
                    return tuple(places[index].tolist()), curves[index]
        raise NoPlaceError


def outwards(pose):
    """Unit vector (x, y) to which sign or marker with this pose (7,) looks, rounded."""
    u, v = -Pose.from_vector(pose).rotation[:2, 1]
    length = math.hypot(u, v)
    return round(float(u / length), 9), round(float(v / length), 9)


def reached(grid):
    """Millimetres (H, W) from each cell that is reached from the door to the nearest that is not."""
    grid = grid.copy()
    column, row = cells(np.array([BEHIND_DOOR]), CELL)[:, 0].tolist()
    cv2.floodFill(grid, None, (column, row), 2)
    return np.rint(np.sqrt(squared_distances(grid != 2)) * CELL * 1000).astype(np.uint16)
