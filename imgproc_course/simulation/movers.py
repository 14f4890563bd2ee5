"""What moves besides the robot: a person who walks, a toy car, and balls that roll and can be pushed.

For the first nine seconds they move as in the recorded drive, unless the robot meets them. Then the person
and the car go back and forth; each of them waits while the robot is in its way. Balls do not push each other.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ..geometry import Pose
from ..geometry.poses import product, rotation_about
from .room import BALLS, MOVERS, ROLL_TIME, BallWay
from .wheels import nearest_on_body

PERSON_RADIUS, CAR_RADIUS, BALL_RADIUS = 0.25, 0.13, 0.11
BOUNCE = 0.4  # share of its speed that the ball keeps when it meets something
SLIDE, ESCAPE = 0.12, 0.6  # metres: how far a ball slides that is pushed, and one that holds the robot
HOLD = 3.0  # seconds in which who gave way does not come back
DIRECTIONS = [(round(math.cos(a), 12), round(math.sin(a), 12)) for a in np.arange(16) * math.pi / 8]


@dataclass
class Ball:
    """Rolls straight on and slows down: speed decays with ROLL_TIME, as in the recorded drive."""

    x: float
    y: float
    vx: float
    vy: float
    rotation: np.ndarray = field(default_factory=lambda: rotation_about("x", 0.9))

    @classmethod
    def at(cls, time, way):
        place, speed = way.at(time)
        ball = cls(*way.start, *speed)
        ball.place(*place)
        return ball

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


@dataclass
class Walker:
    """The person or the car; its clock stands while it waits."""

    time: float
    radius: float
    place: Callable[[float], tuple[float, float]]  # of a time


class Movers:
    """Person, car and balls of a room that take part."""

    def __init__(self, time, room, present=MOVERS, balls=()):
        """present : names of MOVERS; balls : (x, y, dx, dy) of each, else "ball" is where the room's is"""
        self._room, self._free_space, self._hold = room, room.free_space, 0.0
        self.walkers = {
            "person": Walker(time, PERSON_RADIUS, lambda time: room.person.at(time)[0][:2]),
            "toycar": Walker(time, CAR_RADIUS, lambda time: room.car.at(time, room.rug)[0][:2]),
        }
        self.walkers = {name: walker for name, walker in self.walkers.items() if name in present}
        self.balls = {"ball": Ball.at(time, room.ball)} if "ball" in present and not balls else {}
        for name, ball in zip(BALLS, balls, strict=False):
            self.balls[name] = Ball.at(0.0, ball_way(ball, self._free_space))

    def gaps(self, robot, *, balls=True):
        """{name: metres} between the body at (x, y, yaw) and person, car and balls; negative inside."""
        circles = {name: (*w.place(w.time), w.radius) for name, w in self.walkers.items()}
        if balls:
            circles |= {name: (ball.x, ball.y, BALL_RADIUS) for name, ball in self.balls.items()}
        return {name: nearest_on_body(robot, x, y)[1] - radius for name, (x, y, radius) in circles.items()}

    def step(self, dt, robot):
        """dt seconds of person, car and balls; `robot` is (x, y, yaw)."""
        self._hold = max(0.0, self._hold - dt)
        for walker in () if self._hold else self.walkers.values():
            later = round(walker.time + dt, 9)
            before, after = walker.place(walker.time), walker.place(later)
            distance = nearest_on_body(robot, *after)[1]
            if distance >= walker.radius or distance > nearest_on_body(robot, *before)[1]:
                walker.time = later
                velocity = [(b - a) / dt for a, b in zip(before, after, strict=True)]
                self._strike(after, walker.radius, velocity)
        for ball in self.balls.values():
            ball.roll(dt, self._free_space, robot)

    def _strike(self, center, radius, velocity):
        for ball in self.balls.values():
            dx, dy = ball.x - center[0], ball.y - center[1]
            distance = math.hypot(dx, dy)
            if 0 < distance < radius + BALL_RADIUS:
                ball.bounce(dx / distance, dy / distance, *velocity)

    def push_balls(self, robot, velocity, before):
        """The robot, at (linear, angular) from `before` to `robot`, pushes balls: (touched, can move)."""
        pushes = [self._push(ball, robot, velocity, before) for ball in self.balls.values()]
        return any(touched for touched, _ in pushes), all(can_move for _, can_move in pushes)

    def _push(self, ball, robot, velocity, before):
        distance = nearest_on_body(robot, ball.x, ball.y)[1]
        if distance >= BALL_RADIUS:
            return False, True
        spot = self._spot_beside(ball, robot)
        if spot is None:  # wedged: away from it the robot can always move
            return True, distance > nearest_on_body(before, ball.x, ball.y)[1]
        ball.place(*spot)
        nearest, distance = nearest_on_body(robot, *spot)
        c, s = math.cos(robot[2]), math.sin(robot[2])
        linear, angular = velocity
        arm_x, arm_y = nearest[0] - robot[0], nearest[1] - robot[1]
        nx, ny = (spot[0] - nearest[0]) / distance, (spot[1] - nearest[1]) / distance
        ball.bounce(nx, ny, linear * c - angular * arm_y, linear * s + angular * arm_x)
        return True, True

    def _spot_beside(self, ball, robot):
        """(x, y) where a ball has room straight before the body, or else beside that; None if wedged."""
        (near_x, near_y), distance = nearest_on_body(robot, ball.x, ball.y)
        if distance == 0:  # its center is under the body
            return None
        scale = BALL_RADIUS / distance
        straight = near_x + (ball.x - near_x) * scale, near_y + (ball.y - near_y) * scale
        if self._free_space.distance(*straight) >= BALL_RADIUS:
            return straight
        return self._spot_around(ball, robot, SLIDE, BALL_RADIUS)

    def _spot_around(self, ball, robot, reach, room):
        """The nearest (x, y) within `reach` metres with `room` metres to everything, or None."""
        x, y = ball.x, ball.y
        for r in np.arange(0.02, reach, 0.02).tolist():
            for c, s in DIRECTIONS:
                spot, middle = (x + r * c, y + r * s), (x + r * c / 2, y + r * s / 2)
                nearest = min(self._free_space.distance(*spot), nearest_on_body(robot, *spot)[1])
                if nearest >= room and self._free_space.distance(*middle) > 0:  # not through a wall
                    return spot
        return None

    def give_way(self, dt, robot):
        """Makes room for a robot that is held: person and car go back for dt seconds, balls roll away."""
        for walker in self.walkers.values():
            if nearest_on_body(robot, *walker.place(walker.time))[1] < walker.radius + 0.05:
                walker.time = round(walker.time - dt, 9)
                self._hold = HOLD
        for ball in self.balls.values():
            if nearest_on_body(robot, ball.x, ball.y)[1] < BALL_RADIUS + 0.01:
                ball.place(*(self._spot_around(ball, robot, ESCAPE, BALL_RADIUS + 0.05) or (ball.x, ball.y)))

    def _time_of(self, name):
        return self.walkers[name].time if name in self.walkers else 0.0

    def joint_poses(self, tree):
        """The poses in the map, {name: Pose}, of the joints of a RoomModel's joint_tree that take part."""
        room = self._room
        (x, y, yaw), phase, amplitude = room.person.at(self._time_of("person"))
        (u, v, z, heading), turn = room.car.at(self._time_of("toycar"), room.rug)
        poses = {"person": rounded(Pose.planar(x, y, yaw)), "toycar": rounded(Pose.planar(u, v, heading, z))}
        poses = {name: pose for name, pose in poses.items() if name in self.walkers}
        for name, ball in self.balls.items():
            height = BALL_RADIUS + (room.rug.height if room.rug.holds(ball.x, ball.y) else 0.0)
            poses[name] = Pose(ball.rotation, np.array([ball.x, ball.y, height]))
        angles = gait(phase, amplitude) | dict.fromkeys([n for n in tree if n.startswith("wheel")], turn)
        for name in tree:
            if name not in poses and tree[name]["parent"] in poses:
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


def ball_way(ball, free_space):
    """The BallWay of (x, y, dx, dy)."""
    if len(ball) != 4 or not np.isfinite(ball).all():
        raise ValueError(f"a ball is four finite numbers, x, y, dx and dy in metres, got {ball}")
    x, y, dx, dy = (float(value) for value in ball)
    if free_space.distance(x, y) < BALL_RADIUS:
        raise ValueError(f"a ball cannot begin at {(x, y)}: there is no room; choose another place")
    return BallWay((x, y), (dx, dy))
