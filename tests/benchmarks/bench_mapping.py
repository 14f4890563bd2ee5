"""Mapping and SLAM: grids and pose graphs by hand against the field's tools, the map of the recorded drive, a
loop in the room before and after its closure, and the lesson's node for a minute in the room with each seed.

Required: what is computed by hand equals the tool; true poses give the best map of the drive, and a pose that
is never updated the worst; in the room the loop is closed with each seed, no closure is wrong, and path and
map err less than with the wheels; live there is no bump, and the subscriber receives what the node published.

Run it with `environment/test --benchmarks mapping`; SECONDS_IN_THE_ROOM=20 is shorter, and 0 leaves the live
minutes out.
"""

import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import cv2
import gtsam
import numpy as np
from bench_where_am_i import drive_frames, odometry_poses
from rich.console import Console
from rich.table import Table
from scipy.special import expit, logit
from skimage.draw import line
from tqdm import tqdm

from imgproc_course.geometry import (
    ate,
    compose_poses,
    grid_precision_recall,
    grid_ray,
    log_odds,
    optimize_pose_graph,
    probability,
    relative_pose,
    update_grid,
    wrap_angle,
)
from imgproc_course.recording import open_recording
from imgproc_course.simulation import Simulation
from imgproc_course.simulation.laser import MOUNT, cut
from imgproc_course.simulation.room_model import load_room

NODES = Path(__file__).parents[1] / "ros"
SECONDS = float(os.environ.get("SECONDS_IN_THE_ROOM", "60"))
SEEDS = (1, 2, 3)
START = (0.45, -1.0, 0.0)
LINEAR, ANGULAR = 0.25, 0.25  # m/s and rad/s: a circle of 1 m radius, to the left
CELL, CORNER, SHAPE = 0.05, np.array([-1.5, -2.7]), (110, 150)
HEIGHTS = np.arange(0.06, 0.5, 0.02)  # metres: what the camera's depth takes for an obstacle
FARTHEST = 4.0  # metres: a longer depth is a ray without a hit
BEARINGS = np.radians(np.linspace(-41, 41, 181))  # the limits of 180 beams of the depth camera
TRIES = 3000
ODOMETRY = "/kachaka/odometry/odometry"


def cells_of(points):
    """The cells (N, 2) of points (N, 2), x and y, in metres."""
    return np.floor((np.asarray(points) - CORNER) / CELL).astype(int)[:, ::-1]


def room_cells(heights, origin=(0.0, 0.0, 0.0)):
    """Where what stands still crosses one of the heights, SHAPE bool; origin: the map's, in the room."""
    room, real = load_room(), np.zeros(SHAPE, bool)
    still = room.triangles[room.joint < 0]
    shares = np.linspace(0, 1, 41)[:, None, None]  # no segment is longer than 2 m
    for height in heights:
        walls = cut(still, height)
        points = (walls[:, 0] + shares * (walls[:, 1] - walls[:, 0])).reshape(-1, 2)
        places = relative_pose(origin, np.column_stack([points, np.zeros(len(points))]))[:, :2]
        row, col = cells_of(places).T
        inside = (row >= 0) & (row < SHAPE[0]) & (col >= 0) & (col < SHAPE[1])
        real[row[inside], col[inside]] = True
    return real


def score(grid, real):
    return "{:.2f}, {:.2f}".format(*grid_precision_recall(grid, real))


# by hand and by the tool


def noisy_loop(random, count=40):
    """(poses as odometry adds them up, edges) of a circle, with edges between poses of the same place."""
    motion = np.array([0.2, random.uniform(-0.05, 0.05), 2 * np.pi / count])
    truth = [np.array([1.0, -2.0, 3.0])]
    for _ in range(count):
        truth.append(compose_poses(truth[-1], motion))
    pairs = [(k, k + 1) for k in range(count)] + [(count, 0), (3, count - 2), (10, 30)]
    edges = [
        (i, j, relative_pose(truth[i], truth[j]) + random.normal(scale=(0.005, 0.005, 0.01)), (1e4, 1e4))
        for i, j in pairs
    ]
    poses = [truth[0]]
    for i, _, motion, _ in edges[:count]:
        poses.append(compose_poses(poses[i], motion))
    return np.array(poses), edges


def gtsam_poses(poses, edges):
    graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    loose = gtsam.noiseModel.Diagonal.Sigmas(np.full(3, 1e-3))  # nothing else pulls at the first pose
    graph.add(gtsam.PriorFactorPose2(0, gtsam.Pose2(*poses[0]), loose))
    for i, j, motion, weights in edges:
        noise = gtsam.noiseModel.Diagonal.Sigmas(1 / np.sqrt(np.take(weights, [0, 0, 1])))
        graph.add(gtsam.BetweenFactorPose2(i, j, gtsam.Pose2(*motion), noise))
    for k, pose in enumerate(poses):
        values.insert(k, gtsam.Pose2(*pose))
    best = gtsam.LevenbergMarquardtOptimizer(graph, values).optimize()
    found = [best.atPose2(k) for k in range(len(poses))]
    return np.array([(pose.x(), pose.y(), pose.theta()) for pose in found])


def print_tools():
    """Prints what is computed by hand beside the tool; whether they differ."""
    random = np.random.default_rng(1)
    rays = random.integers(-60, 60, (TRIES, 2, 2))
    odds, chances = random.uniform(-6, 6, TRIES), random.uniform(0.001, 0.999, TRIES)
    pairs = random.uniform(-3, 3, (TRIES, 2, 3))
    relative = [gtsam.Pose2(*a).between(gtsam.Pose2(*b)) for a, b in pairs]
    relative = relative_pose(*pairs.swapaxes(0, 1)) - [(p.x(), p.y(), p.theta()) for p in relative]
    relative[:, 2] = wrap_angle(relative[:, 2])
    graphs = [noisy_loop(random) for _ in range(100)]
    different_rays = sum(not np.array_equal(grid_ray(a, b), np.stack(line(*a, *b), -1)) for a, b in rays)
    graph_errors = [np.abs(optimize_pose_graph(*g) - gtsam_poses(*g))[:, :2].max() for g in graphs]
    errors = {
        ("cells of a ray", "skimage.draw.line: rays that differ"): (TRIES, 0, different_rays),
        ("log-odds", "scipy.special.logit"): (TRIES, 1e-12, np.abs(log_odds(chances) - logit(chances)).max()),
        ("probability", "scipy.special.expit"): (TRIES, 1e-12, np.abs(probability(odds) - expit(odds)).max()),
        ("relative pose", "gtsam.Pose2.between"): (TRIES, 1e-12, np.abs(relative).max()),
        ("pose graph, 41 poses, 43 edges", "gtsam.LevenbergMarquardtOptimizer: m"): (
            len(graphs),
            1e-6,
            max(graph_errors),
        ),
    }
    table = Table("by hand", "tool", "cases", "limit", "largest difference")
    for names, (cases, limit, largest) in errors.items():
        table.add_row(*names, str(cases), f"{limit:.0e}", f"{largest:.1e}")
    Console(width=110).print(table)
    return any(largest > limit for _, limit, largest in errors.values())


# the recorded drive


def depth_scan(frames, k, pose):
    """(cell of the camera, end cells (N, 2), hits (N,)) of frame k's depth, taken at a Pose of the camera."""
    rows, cols = np.mgrid[0 : frames.depths[k].shape[0], 0 : frames.depths[k].shape[1]]
    pixels = np.stack([cols, rows], -1).reshape(-1, 2) * frames.scale
    points = pose.apply(frames.points(k, pixels))
    obstacle = (points[:, 2] > HEIGHTS[0]) & (points[:, 2] < HEIGHTS[-1])
    ahead, center = pose.rotation[:, 2], pose.position[:2]
    way = points[obstacle, :2] - center
    bearing = np.arctan2(ahead[0] * way[:, 1] - ahead[1] * way[:, 0], way @ ahead[:2])
    beam = np.digitize(bearing, BEARINGS) - 1
    inside = (beam >= 0) & (beam < len(BEARINGS) - 1)
    distance = np.full(len(BEARINGS) - 1, FARTHEST)
    np.minimum.at(distance, beam[inside], np.linalg.norm(way[inside], axis=1))
    middle = math.atan2(ahead[1], ahead[0]) + (BEARINGS[1:] + BEARINGS[:-1]) / 2
    ends = center + distance[:, None] * np.column_stack([np.cos(middle), np.sin(middle)])
    return cells_of(center[None])[0], cells_of(ends), distance < FARTHEST


def print_drive(recording, lesson):
    """Prints the map of the recorded drive with poses of several sources; whether their order is wrong."""
    frames = drive_frames(recording, 2)
    odometry = lesson["VisualOdometry"](frames.poses[0])
    pairs = zip(frames.grays, frames.depths, strict=True)
    sources = {
        "true poses": frames.poses,
        "the class of the lesson Where am I?": [odometry.step(*pair, frames.camera) for pair in pairs],
        "KLT + solvePnPRansac, every frame": odometry_poses(frames, "KLT + solvePnPRansac", 1)[0],
        "ORB + rigid motion by hand, every frame": odometry_poses(frames, "ORB + rigid motion by hand", 1)[0],
        "pose never updated": frames.poses[:1] * len(frames.poses),
    }
    real, shares = room_cells(HEIGHTS), {}
    table = Table("recorded drive, 90 frames, depth: poses", "ATE in cm", "precision, recall of the grid")
    for name, poses in sources.items():
        grid = np.zeros(SHAPE)
        for k, pose in enumerate(tqdm(poses, f"grid: {name}", leave=False)):
            grid = update_grid(grid, *depth_scan(frames, k, pose))
        places, truth = (np.array([pose.position for pose in path]) for path in (poses, frames.poses))
        shares[name] = sum(grid_precision_recall(grid, real))
        table.add_row(name, f"{100 * ate(places, truth):.1f}", score(grid, real))
    Console(width=110).print(table)
    best, worst = max(shares, key=shares.get), min(shares, key=shares.get)
    return shares["true poses"] < shares[best] - 0.05 or worst != "pose never updated"


# the loop in the room


def loop_in_the_room(seed, lesson):
    """The lesson's Mapper after a circle and 1.5 m, the true and counted poses (N, 3) of the keyframes."""
    mapper, true_poses, wheels = lesson["Mapper"](), [], []
    with Simulation(seed=seed, start=START) as room:
        for _ in tqdm(range(round(10 * (2 * math.pi / ANGULAR + 6))), f"loop, seed {seed}", leave=False):
            counted = compose_poses(START, room.odometry()[:3])
            if mapper.add(tuple(counted), lesson["scan_points"](room.scan())):
                x, y, _, _, _, qz, qw = room.pose("robot")
                true_poses.append((x, y, 2 * math.atan2(qz, qw)))
                wheels.append(counted)
            room.step(LINEAR, ANGULAR, dt=0.1)
            if room.bumped:
                raise RuntimeError(f"the loop of seed {seed} bumps; choose another start")
    return mapper, np.array(true_poses), np.array(wheels)


def closure_errors(mapper, true_poses):
    """Of each loop that the Mapper closed: the error of its motion in metres."""
    return [
        float(np.linalg.norm((relative_pose(true_poses[i], true_poses[j]) - motion)[:2]))
        for i, j, motion, _ in mapper.edges
        if (i, j) in mapper.loops
    ]


def print_loops(lesson):
    """Prints the loop of each seed, before and after its closure; whether one was not closed, or wrongly."""
    real, failed = room_cells([MOUNT[1]]), False
    table = Table(
        "loop, seed", "way", "keyframes", "loops, error of the worst in cm", "poses", "ATE, at the end in cm"
    )
    table.add_column("precision, recall of the grid")
    for seed in SEEDS:
        mapper, truth, wheels = loop_in_the_room(seed, lesson)
        errors = closure_errors(mapper, truth)
        way = np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1).sum()
        closed = f"{len(errors)}, {100 * max(errors, default=0):.1f}"
        first = (str(seed), f"{way:.1f} m", str(len(truth)), closed)
        grids = []
        for name, poses in (("wheels", wheels), ("loop closed", mapper.poses), ("true", truth)):
            grids.append(lesson["make_map"](poses, mapper.scans))
            end = 100 * math.dist(poses[-1][:2], truth[-1][:2])
            error = f"{100 * ate(poses[:, :2], truth[:, :2]):.1f}, {end:.1f}"
            table.add_row(*first, name, error, score(grids[-1], real), end_section=name == "true")
            first = ("",) * 4
        failed |= not errors or max(errors) > 0.1 or len(mapper.poses) != len(truth)
        failed |= ate(mapper.poses[:, :2], truth[:, :2]) > ate(wheels[:, :2], truth[:, :2])
        failed |= sum(grid_precision_recall(grids[0], real)) > sum(grid_precision_recall(grids[1], real))
    Console(width=130).print(table)
    return failed


# live


class Topics:
    """Collects what node, wheels and truth publish."""

    def __init__(self):
        from geometry_msgs.msg import PoseStamped
        from nav_msgs.msg import OccupancyGrid, Odometry
        from nav_msgs.msg import Path as PathMessage
        from rclpy.qos import qos_profile_sensor_data

        from imgproc_course.ros import RosSession

        kinds = {"/map": OccupancyGrid, "/mapping/path": PathMessage, ODOMETRY: Odometry}
        kinds["/truth/pose/robot"] = PoseStamped
        self.messages, self.node = {topic: [] for topic in kinds}, RosSession.current().node
        for topic, kind in kinds.items():
            self.node.create_subscription(kind, topic, self.messages[topic].append, qos_profile_sensor_data)

    def keyframes(self):
        """Poses (N, 3) of the node's keyframes in the room: the true, the node's newest, the counted ones."""
        paths = self.messages["/mapping/path"]
        stamps = {len(path.poses) - 1: nanoseconds(path) for path in paths}  # the newest pose of each
        truth, odometry = (list(self.messages[name]) for name in ("/truth/pose/robot", ODOMETRY))
        true = {nanoseconds(msg): planar(msg.pose) for msg in truth}
        counted = {nanoseconds(msg): planar(msg.pose.pose) for msg in odometry}
        times = np.array(sorted(counted))
        known = [k for k, stamp in stamps.items() if stamp in true]
        wheels = [counted[times[np.abs(times - stamps[k]).argmin()]] for k in known]
        mapped = [planar(paths[-1].poses[k].pose) for k in known]
        return (
            np.array([true[stamps[k]] for k in known]),
            compose_poses(START, mapped),
            compose_poses(START, wheels),
        )

    def grid(self):
        """The newest map as log-odds that have only a sign."""
        msg = self.messages["/map"][-1]
        percent = np.array(msg.data, float).reshape(msg.info.height, msg.info.width)
        return np.where(percent < 0, 0, percent - 50)


def nanoseconds(msg):
    return msg.header.stamp.sec * 10**9 + msg.header.stamp.nanosec


def planar(pose):
    return pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def drive_live(seed):
    """Prints a minute of circles in the room, with the node in another process; whether it failed."""
    from imgproc_course.ros import Robot, open_camera

    with open_camera("room", rate=10, start=START, seed=seed) as camera, Robot() as robot:
        robot.restart(start=START, seed=seed)
        topics, bumps = Topics(), camera.bumps
        program = [sys.executable, NODES / "mapping.py"]
        with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as node:
            try:
                while not topics.node.count_publishers("/mapping/path"):
                    time.sleep(0.1)
                for _ in tqdm(range(round(SECONDS)), "seconds in the room"):
                    robot.drive(LINEAR, ANGULAR, seconds=1.0)
                time.sleep(2.0)  # for the last keyframe's map
            finally:
                node.send_signal(signal.SIGINT)
            looks, keyframes, loops = map(int, node.communicate(timeout=60)[0].split())
        bumps = camera.bumps - bumps
    truth, mapped, wheels = topics.keyframes()
    way = np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1).sum()
    before, after = (100 * ate(poses[:, :2], truth[:, :2]) for poses in (wheels, mapped))
    counts = {topic: len(messages) for topic, messages in topics.messages.items()}
    print(
        f"\n{SECONDS:.0f} s live, seed {seed}, way {way:.1f} m: {looks} scans of "
        f"{counts['/truth/pose/robot']}; {keyframes} keyframes, {loops} loops; received: {counts['/map']} "
        f"OccupancyGrid, {counts['/mapping/path']} Path; {bumps} bumps\n"
        f"ATE of the keyframes: wheels {before:.1f} cm, node {after:.1f} cm; precision, recall of the newest "
        f"grid: {score(topics.grid(), room_cells([MOUNT[1]], START))}"
    )
    lost = max(abs(counts[topic] - keyframes) for topic in ("/map", "/mapping/path"))
    return bool(bumps) or lost > 0.05 * keyframes or not loops or after > before


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "99")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    cv2.setNumThreads(1)
    sys.path.append(str(NODES))
    from mapping import mapping_and_slam
    from visual_odometry import where_am_i

    failed = print_tools()
    failed |= print_drive(open_recording("drive"), where_am_i())
    failed |= print_loops(mapping_and_slam())
    for seed in SEEDS if SECONDS else ():
        failed |= drive_live(seed)
    print("FAILED" if failed else "as required")
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
