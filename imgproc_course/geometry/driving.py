"""From what a robot sees to a direction and a speed: free ways, a safe speed, the frame of the odometry."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .pose_graph import compose_poses, relative_pose


def map_to_odom(place: ArrayLike, counted: ArrayLike) -> NDArray[np.float64]:
    """(x, y, yaw) float64 of the odometry's frame in the map, with the yaw between -π and π.

    place : (x, y, yaw) of the robot in the map; counted : of the odometry at the same moment, in metres and
        radians. compose_poses(result, counted) is the place.

    Source: the frames map and odom of ROS, REP 105, https://www.ros.org/reps/rep-0105.html
    """
    return compose_poses(place, relative_pose(counted, np.zeros(3)))


def free_way(points: ArrayLike, direction: float, width: float) -> float:
    """Metres (float) from the robot to the nearest point in a corridor, inf if there is none.

    points : (N, 2), metres ahead and to the left of the robot's axle
    direction : of the corridor, radians to the left of straight ahead; it begins at the axle
    width : of the corridor in metres

    Raises
    ------
    ValueError : points of another shape
    """
    points = np.asarray(points, float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"points are (N, 2), ahead and left, got an array of shape {points.shape}")
    c, s = math.cos(direction), math.sin(direction)
    ahead, left = points[:, 0] * c + points[:, 1] * s, points[:, 1] * c - points[:, 0] * s
    return float(ahead[(ahead > 0) & (np.abs(left) <= width / 2)].min(initial=np.inf))


def safe_speed(free: float, reaction: float, deceleration: float, limit: float) -> float:
    """The highest speed in m/s (float) at which a robot still stops in its free way, from 0 to limit.

    free : metres; 0 or less gives 0.0
    reaction : seconds from what is seen to the brakes
    deceleration : m/s², above 0
    limit : m/s

    Raises
    ------
    ValueError : a reaction below 0, or a deceleration that is not above 0

    Source: speed · reaction + speed² / (2 · deceleration) = free, solved for the speed.
    """
    if not (reaction >= 0 and deceleration > 0):
        raise ValueError(
            "needs a reaction of at least 0 s and a deceleration above 0 m/s², "
            f"got {reaction} and {deceleration}"
        )
    if free <= 0:
        return 0.0
    if math.isinf(free):
        return float(limit)
    half = reaction * deceleration
    return float(min(limit, math.sqrt(half * half + 2 * deceleration * free) - half))


def choose_direction(directions: ArrayLike, ways: ArrayLike, goal: float, need: float) -> float | None:
    """The direction (float, radians) nearest to the goal's with enough free way, or None if there is none.

    directions : (N,) radians; ways : (N,) metres of free way in each; goal : radians; need : metres
    Of two that are equally near, the first.

    Raises
    ------
    ValueError : directions and ways of other shapes
    """
    directions, ways = np.asarray(directions, float), np.asarray(ways, float)
    if directions.ndim != 1 or directions.shape != ways.shape:
        raise ValueError(f"directions and ways are (N,), got shapes {directions.shape} and {ways.shape}")
    free = directions[ways >= need].tolist()
    return min(free, key=lambda angle: abs(math.remainder(angle - goal, 2 * math.pi)), default=None)
