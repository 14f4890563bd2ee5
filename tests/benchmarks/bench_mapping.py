"""Mapping and SLAM: a loop in the room before and after its closure, and the lesson's node for a minute in
the room, with each seed.

Required: each loop is closed, and path and map err less than with the wheels; live there is no bump, and the
subscriber receives what the node published.

Run it with `environment/test --benchmarks mapping`; SECONDS_IN_THE_ROOM=20 is shorter, and 0 leaves the live
minutes out.
"""

import math
import time

import numpy as np
from geometry_msgs.msg import PoseStamped
from in_the_room import (
    ODOMETRY,
    SECONDS,
    TRUTH,
    Topics,
    drive_circles,
    nanoseconds,
    nearest,
    print_rows,
    program,
    room,
    verdict,
    wait_for,
)
from mapping import mapping_and_slam
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.msg import Path as PathMessage
from tqdm import tqdm

from imgproc_course.geometry import Pose, ate, compose_poses, grid_precision_recall
from imgproc_course.simulation import Simulation
from imgproc_course.simulation.laser import MOUNT, cut
from imgproc_course.simulation.room_model import load_room

SEEDS = (1, 2, 3)
START = (0.45, -1.0, 0.0)
LINEAR, ANGULAR = 0.25, 0.25  # m/s and rad/s: a circle of 1 m radius, to the left
CELL, CORNER, SHAPE = 0.05, np.array([-1.5, -2.7]), (110, 150)
MAP, PATH = "/map", "/mapping/path"


def room_cells():
    """Where what stands still crosses the plane of the scanner, SHAPE bool."""
    model, real = load_room(), np.zeros(SHAPE, bool)
    walls = cut(model.triangles[model.joint < 0], MOUNT[1])
    shares = np.linspace(0, 1, 41)[:, None, None]  # no segment is longer than 2 m
    points = (walls[:, 0] + shares * (walls[:, 1] - walls[:, 0])).reshape(-1, 2)
    col, row = np.floor((points - CORNER) / CELL).astype(int).T
    inside = (row >= 0) & (row < SHAPE[0]) & (col >= 0) & (col < SHAPE[1])
    real[row[inside], col[inside]] = True
    return real


def loop_in_the_room(seed, lesson):
    """The lesson's Mapper after a circle and 1.5 m, the true and counted poses (N, 3) of the keyframes."""
    mapper, true_poses, wheels = lesson["Mapper"](), [], []
    with Simulation(seed=seed, start=START) as simulation:
        for _ in tqdm(range(round(10 * (2 * math.pi / ANGULAR + 6))), f"loop, seed {seed}", leave=False):
            counted = compose_poses(START, simulation.odometry()[:3])
            if mapper.add(tuple(counted), lesson["scan_points"](simulation.scan())):
                x, y, _, _, _, qz, qw = simulation.pose("robot")
                true_poses.append((x, y, 2 * math.atan2(qz, qw)))
                wheels.append(counted)
            simulation.step(LINEAR, ANGULAR, dt=0.1)
    return mapper, np.array(true_poses), np.array(wheels)


def print_loops(lesson):
    """Prints the loop of each seed, before and after its closure; whether one was not closed, or wrongly."""
    real, rows, failed = room_cells(), [], False
    for seed in SEEDS:
        mapper, truth, wheels = loop_in_the_room(seed, lesson)
        errors, shares = [], []
        for name, poses in (("wheels", wheels), ("loop closed", mapper.poses)):
            errors.append(100 * ate(poses[:, :2], truth[:, :2]))
            shares.append(grid_precision_recall(lesson["make_map"](poses, mapper.scans), real))
            rows.append((seed, name, f"{errors[-1]:.1f}", "{:.2f}, {:.2f}".format(*shares[-1])))
        failed |= not mapper.loops or errors[1] > errors[0] or sum(shares[1]) < sum(shares[0])
    print_rows(rows, "loop, seed", "poses", "ATE in cm", "precision, recall of the map")
    return failed


def path_errors(topics):
    """(metres of the true way, ATE in cm by the wheels, ATE of the node) of the keyframes."""
    true, counted, paths = topics.poses(TRUTH), topics.poses(ODOMETRY), topics.messages[PATH]
    stamps = {len(path.poses) - 1: nanoseconds(path) for path in paths}  # the newest pose of each
    known = [k for k, stamp in stamps.items() if stamp in true]
    truth = np.array([true[stamps[k]].position for k in known])
    start, newest = Pose.planar(*START), [pose.pose.position for pose in paths[-1].poses]
    mapped = start.apply([(newest[k].x, newest[k].y, 0.0) for k in known])
    wheels = start.apply([nearest(counted, stamps[k]).position for k in known])
    way = np.linalg.norm(np.diff(truth, axis=0), axis=1).sum()
    return way, *(100 * ate(places[:, :2], truth[:, :2]) for places in (wheels, mapped))


def print_live(seed):
    """Prints a minute of circles in the room, with the node in another process; whether it failed."""
    with room(START, seed, rate=10) as live:
        topics = Topics({MAP: OccupancyGrid, PATH: PathMessage, ODOMETRY: Odometry, TRUTH: PoseStamped})
        with program("mapping.py") as node:
            wait_for(lambda: topics.node.count_publishers(PATH), node)
            drive_circles(live.robot, LINEAR, ANGULAR)
            time.sleep(2.0)  # for the last keyframe's map
        bumps = live.bumps()
    _, keyframes, loops = map(int, node.printed.split())
    way, before, after = path_errors(topics)
    print(
        f"{SECONDS:.0f} s live, seed {seed}, way {way:.1f} m: {keyframes} keyframes, {loops} loops; "
        f"received: {topics.count(MAP)} OccupancyGrid, {topics.count(PATH)} Path; {bumps} bumps; ATE of the "
        f"keyframes {after:.1f} cm, by the wheels {before:.1f} cm"
    )
    lost = max(abs(topics.count(topic) - keyframes) for topic in (MAP, PATH))
    return bumps > 0 or lost > 0.05 * keyframes or not loops or after > before


if __name__ == "__main__":
    has_failed = print_loops(mapping_and_slam())
    for number in SEEDS if SECONDS else ():
        has_failed |= print_live(number)
    raise SystemExit(verdict(has_failed))
