"""The robot's body: a differential drive with the real one's limits, and its wheel odometry."""

import math
from dataclasses import dataclass
from typing import NamedTuple

# Of the Kachaka: the limits of its ROS bridge, and the sizes of its description.
MAX_LINEAR = 0.3  # m/s
MAX_ANGULAR = 1.57  # rad/s
LINEAR_ACCELERATION = 0.6  # m/s²; this and the next are assumed
ANGULAR_ACCELERATION = 4.0  # rad/s²
WHEEL_DISTANCE = 0.20  # m
BODY_LENGTH, BODY_WIDTH = 0.387, 0.240  # m
BODY_CENTER = 0.0435  # m before the axle
# Discs (x, y, radius) that no obstacle can pass between: three in the middle, small ones along the border.
RIM = 0.02
_LONG, _WIDE = BODY_LENGTH / 2 - RIM, BODY_WIDTH / 2 - RIM
DISCS = tuple(
    [(BODY_CENTER + k * (BODY_LENGTH - BODY_WIDTH) / 2, 0.0, BODY_WIDTH / 2) for k in (0, -1, 1)]
    + [(BODY_CENTER + _LONG * k / 5, side * _WIDE, RIM) for k in range(-5, 6) for side in (-1, 1)]
    + [(BODY_CENTER + side * _LONG, _WIDE * k / 3, RIM) for k in range(-2, 3) for side in (-1, 1)]
)
BODY_REACH = math.hypot(BODY_LENGTH / 2, BODY_WIDTH / 2)
TURNING = 0.28  # metres from the axle's center: who has so much room can turn on the spot


class Odometry(NamedTuple):
    """Where the wheels say that the robot is, in the frame of its start: metres, radians, m/s, rad/s."""

    x: float
    y: float
    yaw: float
    linear: float
    angular: float


@dataclass
class Wheels:
    """The true motion of the robot's axle in the map."""

    place: tuple[float, float, float]  # x, y, yaw
    linear: float = 0.0
    angular: float = 0.0

    def accelerate(self, linear, angular, dt):
        """Speeds after dt seconds towards the commanded ones, within the limits."""
        linear = min(max(linear, -MAX_LINEAR), MAX_LINEAR)
        angular = min(max(angular, -MAX_ANGULAR), MAX_ANGULAR)
        self.linear = round(approach(self.linear, linear, LINEAR_ACCELERATION * dt), 9)
        self.angular = round(approach(self.angular, angular, ANGULAR_ACCELERATION * dt), 9)

    def moved(self, linear, angular, dt):
        """(x, y, yaw) after dt seconds at these speeds, rounded to 1e-9."""
        x, y, yaw = self.place
        heading = yaw + angular * dt / 2
        return (
            round(x + linear * math.cos(heading) * dt, 9),
            round(y + linear * math.sin(heading) * dt, 9),
            round(math.remainder(yaw + angular * dt, 2 * math.pi), 9),
        )


def approach(value, target, step):
    return min(value + step, target) if value < target else max(value - step, target)


def clearance(distance, x, y, yaw):
    """Metres as `gap` gives them; far from everything, where that takes long, a lower bound."""
    c, s = math.cos(yaw), math.sin(yaw)
    center = distance(x + BODY_CENTER * c, y + BODY_CENTER * s) - BODY_REACH
    return center if center > 0 else gap(distance, x, y, yaw)


def gap(distance, x, y, yaw):
    """Metres from the body at (x, y, yaw) to what stands still, to 2 mm, by those of a point; inside < 0."""
    c, s = math.cos(yaw), math.sin(yaw)
    return min(distance(x + a * c - b * s, y + a * s + b * c) - radius for a, b, radius in DISCS)


def nearest_on_body(place, px, py):
    """The point of the body at (x, y, yaw) that is nearest to (px, py), and its distance; 0 inside."""
    x, y, yaw = place
    c, s = math.cos(yaw), math.sin(yaw)
    along, aside = (px - x) * c + (py - y) * s - BODY_CENTER, -(px - x) * s + (py - y) * c
    along = min(max(along, -BODY_LENGTH / 2), BODY_LENGTH / 2) + BODY_CENTER
    aside = min(max(aside, -BODY_WIDTH / 2), BODY_WIDTH / 2)
    nearest = (x + along * c - aside * s, y + along * s + aside * c)
    return nearest, math.hypot(px - nearest[0], py - nearest[1])


class WheelOdometry:
    """Counts the wheels' turns: each wheel's size is a little wrong, and the wheels slip, more on the rug.

    The sizes are wrong by 1 % (standard deviation); the slip grows with the root of the way, 2 mm on a metre.
    If they are `uneven`, one wheel is by this share larger than written down, the other one smaller.
    """

    SIZE_ERROR, SLIP, SLIP_ON_RUG = 0.01, 0.002, 0.005

    def __init__(self, random, uneven=0.0):
        self._random = random
        self._scale = [1 + self.SIZE_ERROR * e for e in random.standard_normal(2).tolist()]
        if uneven:
            error = random.choice([-uneven, uneven])
            self._scale = [1 + error, 1 - error]
        self.state = Odometry(0.0, 0.0, 0.0, 0.0, 0.0)

    def step(self, linear, angular, dt, on_rug):
        slip = self.SLIP_ON_RUG if on_rug else self.SLIP
        across = angular * WHEEL_DISTANCE / 2
        ways = (linear - across) * dt, (linear + across) * dt
        errors = self._random.standard_normal(2).tolist()
        left, right = (
            way * scale + slip * math.sqrt(abs(way)) * error
            for way, scale, error in zip(ways, self._scale, errors, strict=True)
        )
        way, turn = (left + right) / 2, (right - left) / WHEEL_DISTANCE
        heading = self.state.yaw + turn / 2
        self.state = Odometry(
            round(self.state.x + way * math.cos(heading), 9),
            round(self.state.y + way * math.sin(heading), 9),
            round(math.remainder(self.state.yaw + turn, 2 * math.pi), 9),
            round(way / dt, 9),
            round(turn / dt, 9),
        )
