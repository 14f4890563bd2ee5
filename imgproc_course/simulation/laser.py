"""A laser scanner: rays in a horizontal plane, cast in the room's triangles."""

import math
from typing import NamedTuple

import numpy as np

from ..geometry import Pose

RAYS = 360
RANGE_MIN, RANGE_MAX = 0.05, 8.0  # metres
MOUNT = (0.156, 0.105)  # x and z in base_link, metres: the Kachaka's
NOISE = 0.005  # metres, standard deviation
NOWHERE = Pose(np.eye(3), np.array([0, 0, -np.inf]))  # of who does not take part


class LaserScan(NamedTuple):
    """Ranges (RAYS,) float32 in metres, counterclockwise from straight ahead; inf where nothing is hit."""

    angle_min: float
    angle_increment: float
    range_min: float
    range_max: float
    ranges: np.ndarray


def crosses(triangles, height):
    """Which of the triangles (N, 3, 3) cross the plane at this height, (N,) bool."""
    return ((triangles[..., 2] > height).sum(1) % 3) != 0


def cut(triangles, height):
    """Segments (M, 2, 2), x and y, in which triangles (N, 3, 3) cross the plane at this height."""
    crossing = triangles[crosses(triangles, height)].astype(float)
    above = crossing[..., 2] > height
    alone = np.where(above.sum(1) == 1, above.argmax(1), (~above).argmax(1))  # one corner on its side
    rows = np.arange(len(crossing))
    ends = []
    for step in (1, 2):
        a, b = crossing[rows, alone], crossing[rows, (alone + step) % 3]
        share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
        ends.append(a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2]))
    return np.stack(ends, 1)


def cast(segments, x, y, yaw):
    """Distance (RAYS,) float64 to the first segment on each ray from (x, y), the first ray towards yaw."""
    angles = [yaw + k * 2 * math.pi / RAYS for k in range(RAYS)]
    c, s = (np.array([round(f(a), 12) for a in angles]) for f in (math.cos, math.sin))
    first, second = segments[:, 0] - (x, y), segments[:, 1] - (x, y)
    edge = second - first
    segment, ray = candidates(first, second, yaw)
    c, s = c[ray], s[ray]
    side_first = c * first[segment, 1] - s * first[segment, 0]
    side_second = c * second[segment, 1] - s * second[segment, 0]
    hit = (side_first > 0) != (side_second > 0)
    segment, ray, c, s = segment[hit], ray[hit], c[hit], s[hit]
    across = (first[:, 0] * edge[:, 1] - first[:, 1] * edge[:, 0])[segment]
    along = across / (c * edge[segment, 1] - s * edge[segment, 0])
    distance = np.full(RAYS, np.inf)
    np.minimum.at(distance, ray[along > 0], along[along > 0])
    return distance


def candidates(first, second, yaw):
    """Pairs (segment, ray): the rays in the angle of each segment, and those beside it.

    Processors differ in the last bit of an angle; which of these rays hit is decided without angles.
    """
    begin, end = (np.arctan2(points[:, 1], points[:, 0]) for points in (first, second))
    turn = (end - begin + math.pi) % (2 * math.pi) - math.pi
    low = np.where(turn < 0, end, begin)
    per_radian = RAYS / (2 * math.pi)
    first_ray = np.floor((low - yaw) * per_radian).astype(int) - 1
    count = np.ceil(np.abs(turn) * per_radian).astype(int) + 4
    segment = np.repeat(np.arange(len(count)), count)
    within = np.arange(len(segment)) - np.repeat(np.cumsum(count) - count, count)
    return segment, (first_ray[segment] + within) % RAYS


class Laser:
    """A scanner in a room; each scan stands alone."""

    def __init__(self, room):
        self._still = cut(room.triangles[room.joint < 0], MOUNT[1])
        self._names, moves = room.joint_names, room.joint >= 0
        self._joint = room.joint[moves]
        # Of the movers' triangles, in the frames of their joints: each corner's x y z (3, 3, N).
        self._moving = np.ascontiguousarray(np.moveaxis(room.triangles[moves], 0, -1), float)

    def scan(self, robot, joint_poses, seed, step):
        """A LaserScan of the robot whose base_link is at (x, y, yaw); without `seed` it has no noise."""
        moving = cut(self._near(joint_poses, MOUNT[1]), MOUNT[1]) if joint_poses else np.zeros((0, 2, 2))
        x, y, yaw = robot
        x, y = x + MOUNT[0] * math.cos(yaw), y + MOUNT[0] * math.sin(yaw)
        distance = cast(np.concatenate([self._still, moving]), round(x, 9), round(y, 9), yaw)
        if seed is not None:
            distance = distance + NOISE * np.random.default_rng([seed, 4, step]).standard_normal(RAYS)
        distance[(distance < RANGE_MIN) | (distance > RANGE_MAX)] = np.inf
        ranges = np.round(distance, 6).astype(np.float32)
        return LaserScan(0.0, 2 * math.pi / RAYS, RANGE_MIN, RANGE_MAX, ranges)

    def _near(self, joint_poses, height):
        """Those triangles (N, 3, 3) of movers, in the map, that reach above and below a height."""
        poses = [joint_poses.get(name, NOWHERE) for name in self._names]
        positions = np.stack([pose.position for pose in poses])
        rotations = np.stack([pose.rotation for pose in poses])
        (x, y, z), lift = np.take(rotations[:, 2].T, self._joint, 1), np.take(positions[:, 2], self._joint)
        a, b, c = (x * corner[0] + y * corner[1] + z * corner[2] + lift for corner in self._moving)
        lowest, highest = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        rows = np.flatnonzero((lowest <= height) & (highest > height))
        joint, corners = self._joint[rows], np.take(self._moving, rows, 2)
        rotation = np.moveaxis(rotations[joint], 0, -1)  # (3, 3, N)
        placed = [[row[0] * x + row[1] * y + row[2] * z for row in rotation] for x, y, z in corners]
        return np.moveaxis(np.array(placed), -1, 0) + positions[joint][:, None]
