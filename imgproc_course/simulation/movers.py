"""What moves besides the robot: a person who walks, a toy car, and a ball that rolls and can be pushed.

For the first nine seconds they move as in the recorded drive, unless the robot meets them. Then the person
and the car go back and forth; each of them waits while the robot is in its way.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from ..geometry import Pose
from ..geometry.poses import product, rotation_about
from .drive import nearest_on_body

PERSON_RADIUS, CAR_RADIUS, BALL_RADIUS = 0.25, 0.13, 0.11
RUG_CENTER, RUG_YAW, RUG_SIZE, RUG_HEIGHT = (2.55, 0.35), 0.06, (1.7, 1.2), 0.012
WALK_TIME, WALK_LENGTH, STAND_TIME, TURN_TIME = 6.5, 2.35, 4.5, 1.5
WALK_START = (4.93, -1.72)
CAR_TIME, CAR_REST = 9.0, 1.0
ROLL_TIME = 3.5  # seconds in which the ball loses all but 1/e of its speed
BOUNCE = 0.4  # share of its speed that the ball keeps when it meets something
SLIDE, ESCAPE = 0.12, 0.6  # metres: how far a ball slides that is pushed, and one that holds the robot
HOLD = 3.0  # seconds in which who gave way does not come back
DIRECTIONS = [(round(math.cos(a), 12), round(math.sin(a), 12)) for a in np.arange(16) * math.pi / 8]


def is_on_rug(x, y):
    """Whether (x, y) is on the rug."""
    c, s = math.cos(RUG_YAW), math.sin(RUG_YAW)
    dx, dy = x - RUG_CENTER[0], y - RUG_CENTER[1]
    return abs(dx * c + dy * s) <= RUG_SIZE[0] / 2 and abs(-dx * s + dy * c) <= RUG_SIZE[1] / 2


def walk(time):
    """The person at a time: (x, y, yaw), phase of the gait in radians, and its amplitude 0 to 1."""
    half, within = divmod(time + 0.4, WALK_TIME + STAND_TIME)
    u = min(within / WALK_TIME, 1.0)
    way, speed = WALK_LENGTH * u * u * (3 - 2 * u), WALK_LENGTH * 6 * u * (1 - u) / WALK_TIME
    back = half % 2 == 1
    x, y = WALK_START[0], WALK_START[1] + (WALK_LENGTH - way if back else way)
    turn = max(0.0, within - (WALK_TIME + STAND_TIME - TURN_TIME)) / TURN_TIME
    yaw = math.pi / 2 + math.pi * ((1 if back else 0) + turn * turn * (3 - 2 * turn))
    return (x, y, yaw), 2 * math.pi * way / 1.05, min(1.0, speed / 0.45)


def car_path(time):
    """The car at a time: (x, y, z, yaw), and the turn of its wheels in radians."""
    within = time % (2 * (CAR_TIME + CAR_REST))
    t = min(within, CAR_TIME) if within < CAR_TIME + CAR_REST else max(2 * CAR_TIME + CAR_REST - within, 0.0)
    x, y = 2.25 + 0.30 * math.sin(0.45 * t), -1.35 + 0.30 * t
    yaw = math.atan2(0.30, 0.135 * math.cos(0.45 * t))
    return (x, y, RUG_HEIGHT if y > -0.25 else 0.0, yaw), 0.33 * t / 0.028


PATHS = (("person_time", walk, PERSON_RADIUS), ("car_time", car_path, CAR_RADIUS))


@dataclass
class Ball:
    """Rolls straight on and slows down: speed decays with ROLL_TIME, as in the recorded drive."""

    x: float
    y: float
    vx: float
    vy: float
    rotation: np.ndarray = field(default_factory=lambda: rotation_about("x", 0.9))

    @classmethod
    def at(cls, time):
        way = 0.88 * (1 - math.exp(-time / ROLL_TIME))
        speed = 0.88 / ROLL_TIME * math.exp(-time / ROLL_TIME)
        ball = cls(2.45, 0.78, 0.45 * speed, -speed)
        ball.place(2.45 + 0.45 * way, 0.78 - way)
        ball.vx, ball.vy = round(ball.vx, 9), round(ball.vy, 9)
        return ball

    @property
    def height(self):
        return BALL_RADIUS + (RUG_HEIGHT if is_on_rug(self.x, self.y) else 0.0)

    def place(self, x, y):
        """Rolls the ball to (x, y)."""
        dx, dy = x - self.x, y - self.y
        way = math.hypot(dx, dy)
        if way > 0:
            ax, ay = round(-dy / way, 12), round(dx / way, 12)
            align = np.array([[ax, -ay, 0], [ay, ax, 0], [0, 0, 1]])
            turn = product(product(align, rotation_about("x", way / BALL_RADIUS)), align.T)
            self.rotation = np.round(orthonormal(product(turn, self.rotation)), 9)
        self.x, self.y = round(x, 9), round(y, 9)

    def roll(self, dt, free_space, robot):
        """Rolls for dt seconds, and bounces off what stands still and the robot at (x, y, yaw)."""
        decay = round(math.exp(-dt / ROLL_TIME), 12)
        way = ROLL_TIME * (1 - decay)
        x, y = self.x + self.vx * way, self.y + self.vy * way
        self.vx, self.vy = round(self.vx * decay, 9), round(self.vy * decay, 9)
        if math.hypot(self.vx, self.vy) < 0.002:
            self.vx = self.vy = 0.0
            return
        still = free_space.distance(x, y)
        nearest, distance = nearest_on_body(robot, x, y)
        if min(still, distance) >= BALL_RADIUS:
            self.place(x, y)
        elif 0 < distance < still:
            self.bounce((x - nearest[0]) / distance, (y - nearest[1]) / distance)
        else:
            self.bounce(*free_space.away(x, y))

    def bounce(self, nx, ny, vx=0.0, vy=0.0):
        """Off something that moves with (vx, vy) and whose surface looks towards (nx, ny)."""
        towards = (self.vx - vx) * nx + (self.vy - vy) * ny
        if towards < 0:
            self.vx = round(self.vx - (1 + BOUNCE) * towards * nx, 9)
            self.vy = round(self.vy - (1 + BOUNCE) * towards * ny, 9)


def orthonormal(rotation):
    """The rotation again after rounding: its columns made perpendicular and of length 1."""
    x, y, _ = rotation.T
    x = x / np.sqrt((x * x).sum())
    y = y - (x * y).sum() * x
    y = y / np.sqrt((y * y).sum())
    return np.stack([x, y, np.cross(x, y)], 1)


class Movers:
    """Person, car and ball; each of the first two has a clock of its own, which stands while it waits."""

    def __init__(self, time, free_space):
        self.person_time = self.car_time = time
        self.ball = Ball.at(time)
        self._free_space, self._hold = free_space, 0.0

    def circles(self):
        """(x, y, radius) of person and car."""
        (x, y, _), _, _ = walk(self.person_time)
        (u, v, _, _), _ = car_path(self.car_time)
        return (x, y, PERSON_RADIUS), (u, v, CAR_RADIUS)

    def step(self, dt, robot):
        """dt seconds of person, car and ball; `robot` is (x, y, yaw)."""
        self._hold = max(0.0, self._hold - dt)
        for name, path, radius in () if self._hold else PATHS:
            now, later = getattr(self, name), round(getattr(self, name) + dt, 9)
            before, after = path(now)[0][:2], path(later)[0][:2]
            distance = nearest_on_body(robot, *after)[1]
            if distance >= radius or distance > nearest_on_body(robot, *before)[1]:
                setattr(self, name, later)
                self._strike(after, radius, [(b - a) / dt for a, b in zip(before, after, strict=True)])
        self.ball.roll(dt, self._free_space, robot)

    def _strike(self, center, radius, velocity):
        dx, dy = self.ball.x - center[0], self.ball.y - center[1]
        distance = math.hypot(dx, dy)
        if 0 < distance < radius + BALL_RADIUS:
            self.ball.bounce(dx / distance, dy / distance, *velocity)

    def push_ball(self, robot, velocity, before):
        """The robot, from (x, y, yaw) `before` to `robot`, at (linear, angular), pushes the ball.

        Returns (touched, the robot can move so).
        """
        distance = nearest_on_body(robot, self.ball.x, self.ball.y)[1]
        if distance >= BALL_RADIUS:
            return False, True
        spot = self._spot_beside(robot)
        if spot is None:  # wedged: away from it the robot can always move
            return True, distance > nearest_on_body(before, self.ball.x, self.ball.y)[1]
        self.ball.place(*spot)
        nearest, distance = nearest_on_body(robot, *spot)
        c, s = math.cos(robot[2]), math.sin(robot[2])
        linear, angular = velocity
        arm_x, arm_y = nearest[0] - robot[0], nearest[1] - robot[1]
        nx, ny = (spot[0] - nearest[0]) / distance, (spot[1] - nearest[1]) / distance
        self.ball.bounce(nx, ny, linear * c - angular * arm_y, linear * s + angular * arm_x)
        return True, True

    def _spot_beside(self, robot):
        """(x, y) where the ball has room straight before the body, or else beside that; None if wedged."""
        (near_x, near_y), distance = nearest_on_body(robot, self.ball.x, self.ball.y)
        if distance == 0:  # its center is under the body
            return None
        scale = BALL_RADIUS / distance
        straight = near_x + (self.ball.x - near_x) * scale, near_y + (self.ball.y - near_y) * scale
        if self._free_space.distance(*straight) >= BALL_RADIUS:
            return straight
        return self._spot_around(robot, SLIDE, BALL_RADIUS)

    def _spot_around(self, robot, reach, room):
        """The nearest (x, y) within `reach` metres with `room` metres to everything, or None."""
        x, y = self.ball.x, self.ball.y
        for r in np.arange(0.02, reach, 0.02).tolist():
            for c, s in DIRECTIONS:
                spot, middle = (x + r * c, y + r * s), (x + r * c / 2, y + r * s / 2)
                nearest = min(self._free_space.distance(*spot), nearest_on_body(robot, *spot)[1])
                if nearest >= room and self._free_space.distance(*middle) > 0:  # not through a wall
                    return spot
        return None

    def give_way(self, dt, robot):
        """Makes room for a robot that is held: person and car go back for dt seconds, the ball rolls away."""
        for name, path, radius in PATHS:
            earlier = round(getattr(self, name) - dt, 9)
            if nearest_on_body(robot, *path(getattr(self, name))[0][:2])[1] < radius + 0.05:
                setattr(self, name, earlier)
                self._hold = HOLD
        near = nearest_on_body(robot, self.ball.x, self.ball.y)[1] < BALL_RADIUS + 0.01
        spot = self._spot_around(robot, ESCAPE, BALL_RADIUS + 0.05) if near else None
        if spot is not None:
            self.ball.place(*spot)

    def joint_poses(self, tree):
        """The pose of every joint in the map, {name: Pose}, of a RoomModel's joint_tree."""
        (x, y, yaw), phase, amplitude = walk(self.person_time)
        (u, v, z, heading), turn = car_path(self.car_time)
        poses = {
            "person": rounded(Pose.planar(x, y, yaw)),
            "toycar": rounded(Pose.planar(u, v, heading, z)),
            "ball": Pose(self.ball.rotation, np.array([self.ball.x, self.ball.y, self.ball.height])),
        }
        angles = gait(phase, amplitude) | dict.fromkeys([n for n in tree if n.startswith("wheel")], turn)
        for name in tree:
            if name not in poses:
                offset = np.array(tree[name]["offset"])
                if name == "hip":
                    offset = np.array([0, 0, 0.915 - amplitude * (0.012 - 0.016 * math.cos(2 * phase))])
                joint_pose = Pose(rotation_about("y", angles.get(name, 0.0)), np.round(offset, 9))
                poses[name] = poses[tree[name]["parent"]] @ joint_pose
        return poses


def rounded(pose):
    return Pose(np.round(pose.rotation, 9), np.round(pose.position, 9))


def gait(phase, amplitude):
    """Angles about y of the person's joints, as in the recorded drive."""
    angles: dict[str, float] = {}
    for side, shift in (("L", 0.0), ("R", math.pi)):
        a = phase + shift
        angles |= {
            "thigh" + side: -0.42 * math.sin(a) * amplitude,
            "shin" + side: (0.18 + 0.55 * max(0.0, math.sin(a + 1.2)) ** 2) * amplitude,
            "foot" + side: (-0.1 + 0.1 * math.sin(a)) * amplitude,
            "arm" + side: 0.36 * math.sin(a) * amplitude,
            "fore" + side: -0.35,
        }
    return angles
