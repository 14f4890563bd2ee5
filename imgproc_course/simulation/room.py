"""A room to drive through: what stands in it, where things move in it, and where the robot begins."""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .room_model import BALLS, FreeSpace, RoomModel, load_room, read_image

WALK_TIME, WALK_LENGTH, STAND_TIME, TURN_TIME = 6.5, 2.35, 4.5, 1.5
CAR_TIME, CAR_REST, CAR_SPEED, CAR_SWING = 9.0, 1.0, 0.30, 0.30
ROLL_TIME = 3.5  # seconds in which the ball loses all but 1/e of its speed
ROLLED = 0.88  # of its direction, the way that it rolls in all
SIGN = (5.594, -0.29, 0.72, 0.0, 0.0, -0.707106781, 0.707106781)  # of the recorded room
MOVERS = ("person", "toycar", BALLS[0])


@dataclass(frozen=True)
class Rug:
    """Center (x, y) and size in metres, yaw in radians."""

    center: tuple[float, float]
    yaw: float
    size: tuple[float, float] = (1.7, 1.2)
    height: float = 0.012

    def holds(self, x, y):
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = x - self.center[0], y - self.center[1]
        return abs(dx * c + dy * s) <= self.size[0] / 2 and abs(-dx * s + dy * c) <= self.size[1] / 2


@dataclass(frozen=True)
class Way:
    """A straight way from (x, y), metres, in the direction of the heading, radians."""

    x: float
    y: float
    heading: float

    @functools.cached_property
    def direction(self):
        return round(math.cos(self.heading), 12), round(math.sin(self.heading), 12)


class PersonWay(Way):
    """The person walks WALK_LENGTH metres, turns, and walks back."""

    def at(self, time):
        """The person at a time: (x, y, yaw), phase of the gait in radians, and its amplitude 0 to 1."""
        half, within = divmod(time + 0.4, WALK_TIME + STAND_TIME)
        u = min(within / WALK_TIME, 1.0)
        way, speed = WALK_LENGTH * u * u * (3 - 2 * u), WALK_LENGTH * 6 * u * (1 - u) / WALK_TIME
        back = half % 2 == 1
        along = WALK_LENGTH - way if back else way
        turn = max(0.0, within - (WALK_TIME + STAND_TIME - TURN_TIME)) / TURN_TIME
        yaw = self.heading + math.pi * ((1 if back else 0) + turn * turn * (3 - 2 * turn))
        c, s = self.direction
        place = self.x + along * c, self.y + along * s, yaw
        return place, 2 * math.pi * way / 1.05, min(1.0, speed / 0.45)


@dataclass(frozen=True)
class CarWay(Way):
    """The toy car drives along a wave, and back; after `rug_from` metres it is on the rug."""

    rug_from: float | None = None  # None: on the rug where the rug is

    def at(self, time, rug):
        """The car at a time: (x, y, z, yaw), and the turn of its wheels in radians."""
        half, within = CAR_TIME + CAR_REST, time % (2 * (CAR_TIME + CAR_REST))
        t = min(within, CAR_TIME) if within < half else max(half + CAR_TIME - within, 0.0)
        c, s = self.direction
        along, aside = CAR_SPEED * t, -CAR_SWING * math.sin(0.45 * t)
        x, y = self.x + along * c - aside * s, self.y + along * s + aside * c
        turn = -0.135 * math.cos(0.45 * t)
        yaw = math.atan2(CAR_SPEED * s + turn * c, CAR_SPEED * c - turn * s)
        on_rug = rug.holds(x, y) if self.rug_from is None else along > self.rug_from
        return (x, y, rug.height if on_rug else 0.0, yaw), 0.33 * t / 0.028


@dataclass(frozen=True)
class BallWay:
    """The ball rolls from `start` along `direction`, 0.88 of it in all; by default it rests."""

    start: tuple[float, float]
    direction: tuple[float, float] = (0.0, 0.0)

    def at(self, time):
        """(x, y) and (vx, vy) at a time, metres and m/s."""
        decay = math.exp(-time / ROLL_TIME)
        (x, y), (dx, dy) = self.start, self.direction
        way, speed = ROLLED * (1 - decay), ROLLED / ROLL_TIME * decay
        return (x + dx * way, y + dy * way), (round(dx * speed, 9), round(dy * speed, 9))


@dataclass(frozen=True, eq=False)
class Room:
    """What a Simulation drives through; its arrays are not to be changed.

    start : (x, y, yaw) of the robot in the map, metres and radians
    textures : of a lighting, {atlas: (H, W, 3) uint8 BGR}, H and W powers of two
    word : what is written large on the sign
    markers : {"marker": ..., "wall_marker": ...}, the numbers that they show, of the dictionary 4x4_50
    poses : {"sign": ..., "marker": ..., "wall_marker": ...}, each [x, y, z, qx, qy, qz, qw] float64
    places : of each piece of furniture, (x, y, yaw), the turn against the recorded room; there it is empty
    """

    name: str
    model: RoomModel
    free_space: FreeSpace
    start: tuple[float, float, float]
    rug: Rug
    person: PersonWay
    car: CarWay
    ball: BallWay
    textures: Callable[[str], dict[str, NDArray[np.uint8]]]
    word: str = "KITCHEN"
    markers: dict[str, int] = field(default_factory=lambda: {"marker": 7, "wall_marker": 12})
    poses: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    places: dict[str, tuple[float, float, float]] = field(default_factory=dict)


@functools.cache
def recorded_room() -> Room:
    """The living room of the recorded drive: each simulation's, unless it is given another."""
    model = load_room()
    return Room(
        name="recorded",
        model=model,
        free_space=FreeSpace.load(),
        start=(-0.2067, -0.0367, 0.1757),  # its camera stands where the recorded drive begins
        rug=Rug((2.55, 0.35), 0.06),
        person=PersonWay(4.93, -1.72, math.pi / 2),
        car=CarWay(2.25, -1.35, math.pi / 2, rug_from=1.10),
        ball=BallWay((2.45, 0.78), (0.45, -1.0)),
        textures=lambda lighting: {
            name: read_image(f"{name}_{lighting}.jpg") for name in model.atlas_names if name != "outside"
        },
        poses=model.markers | {"sign": np.array(SIGN)},
    )
