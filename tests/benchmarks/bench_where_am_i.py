"""Where am I: geometry by hand against the field's tools, visual odometry over the recorded drive and over a
loop in the room, the marker's pose, and the lesson's node for a minute in the room.

Required: what is computed by hand equals the tool; each marker is read; keyframes err less than every frame
in the drive with ORB and rigid motions; in the room the lesson's odometry errs less than the wheels
with each seed; live there is no bump, and the subscriber receives what the node publishes once it is one.

Run it with `environment/test --benchmarks where_am_i`; SECONDS_IN_THE_ROOM=20 is shorter, and 0 leaves the
live minute out.
"""

import math
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.spatial.transform import Rotation
from tqdm import tqdm

from imgproc_course.geometry import CameraModel, Pose, ate, homography, homography_pose, rigid_motion
from imgproc_course.recording import open_recording
from imgproc_course.simulation import Simulation

NODE = Path(__file__).parents[1] / "ros" / "visual_odometry.py"
SECONDS = float(os.environ.get("SECONDS_IN_THE_ROOM", "60"))
SEEDS = (1, 2, 3)
START = (0.3, -0.7, 0.0)
LINEAR, ANGULAR = 0.25, 0.3  # m/s and rad/s: a circle of 1.7 m, to the left
RATE = 10  # images per second in the loop
SIDE, MARKER = 0.25, 7  # of the marker in the drive: metres, id
SQUARE = SIDE * np.array([(-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)])
SOLID_SQUARE = np.column_stack([SQUARE, np.zeros(4)])
MOUNT = Pose(np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]]), np.array([0.21, 0, 0.20]))  # camera on robot
DRAWS, TOLERANCE = 100, 0.02  # of RANSAC; TOLERANCE is a share of the distance
# The camera is lost with fewer pairs, or after more metres in one step. It is taken to go on as before.
LEAST, FARTHEST = 6, 0.5
NEAR, FAR = 0.2, 6.0  # metres: depths outside are not used


@dataclass
class Frames:
    """Images, depth and truth of one drive; depth[row, col] is that of pixel (row, col) · scale."""

    grays: list
    depths: list
    camera: CameraModel
    poses: list
    scale: int = 1
    wheels: list = None

    def points(self, k, pixels):
        """Points (N, 3) of pixels (N, 2) in the optical frame of frame k, in metres; NaN without a depth."""
        col, row = np.rint(pixels / self.scale).astype(int).T
        rows, cols = self.depths[k].shape
        depth = self.depths[k][row.clip(0, rows - 1), col.clip(0, cols - 1)] / 1000
        depth[(depth < NEAR) | (depth > FAR)] = np.nan
        return self.camera.unproject(pixels) * depth[:, None]


def drive_frames(recording, stride):
    """The recorded drive, every stride-th pixel."""
    info = recording.camera_info
    focal_center = (info.k[0], info.k[4], info.k[2], info.k[5])
    camera = CameraModel(info.width, info.height, *focal_center, tuple(info.d)).every(stride)
    grays = [
        cv2.cvtColor(recording.frame(k)[::stride, ::stride].copy(), cv2.COLOR_BGR2GRAY) for k in range(90)
    ]
    depths = [recording.depth(k) for k in range(90)]
    poses = [Pose.from_vector(recording.pose("camera", k)) for k in range(90)]
    return Frames(grays, depths, camera, poses, scale=2 // stride)


def loop_frames(seed):
    """A circle in the room, as its topics publish it: 640×360, depth of the same pixels; and the wheels."""
    with Simulation(seed=seed, start=START) as room:
        frames = Frames([], [], room.camera, [], wheels=[])
        for _ in tqdm(range(math.ceil(2 * math.pi / ANGULAR * RATE) + RATE // 2), f"loop, seed {seed}"):
            frames.grays.append(cv2.cvtColor(room.frame(), cv2.COLOR_BGR2GRAY))
            frames.depths.append(room.depth())
            frames.poses.append(Pose.from_vector(room.pose("camera")))
            odometry = room.odometry()
            wheels = Pose.planar(odometry.x, odometry.y, odometry.yaw)
            frames.wheels.append(Pose.planar(*START) @ wheels @ MOUNT)
            room.step(LINEAR, ANGULAR, dt=1 / RATE)
            if room.bumped:
                raise RuntimeError(f"the loop of seed {seed} bumps; choose another start")
    return frames


class Matches:
    """Pixels (N, 2) of the same points in two frames, by KLT or ORB; ORB's features are kept."""

    def __init__(self, frames, features):
        self._frames, self._features = frames, features
        self._orb, self._described = cv2.ORB_create(500 * frames.camera.width // 320), {}

    def __call__(self, a, b):
        return self._klt(a, b) if self._features == "KLT" else self._described_pairs(a, b)

    def _klt(self, a, b):
        old, new = self._frames.grays[a], self._frames.grays[b]
        corners = cv2.goodFeaturesToTrack(old, 800, 0.005, 8)
        found, status, _ = cv2.calcOpticalFlowPyrLK(old, new, corners, None)
        back, _, _ = cv2.calcOpticalFlowPyrLK(new, old, found, None)
        good = (status.ravel() > 0) & (np.linalg.norm((back - corners)[:, 0], axis=1) < 0.5)
        return corners[good, 0].astype(float), found[good, 0].astype(float)

    def _described_pairs(self, a, b):
        for k in (a, b):
            if k not in self._described:
                self._described[k] = self._orb.detectAndCompute(self._frames.grays[k], None)
        (points_a, words_a), (points_b, words_b) = self._described[a], self._described[b]
        pairs = cv2.BFMatcher(cv2.NORM_HAMMING).knnMatch(words_a, words_b, k=2)
        best = [first for first, second in pairs if first.distance < 0.8 * second.distance]
        pixels = [(points_a[match.queryIdx].pt, points_b[match.trainIdx].pt) for match in best]
        return tuple(np.reshape(pixels, (-1, 2, 2)).transpose(1, 0, 2))


def by_pnp(frames, a, b, matches):
    """Pose of camera a in the frame of camera b, from points of a and pixels of b; None: too few pairs."""
    pixels_a, pixels_b = matches(a, b)
    points = frames.points(a, pixels_a)
    good = np.isfinite(points[:, 2])
    if good.sum() < LEAST:
        return None
    camera = frames.camera
    _, turn, position, inliers = cv2.solvePnPRansac(
        points[good],
        pixels_b[good],
        camera.matrix,
        np.array(camera.distortion),
        reprojectionError=1.5,
        iterationsCount=3 * DRAWS,
        confidence=0.999,
    )
    return (
        Pose(cv2.Rodrigues(turn)[0], position.ravel())
        if len(inliers if inliers is not None else ()) >= LEAST
        else None
    )


def by_hand(frames, a, b, matches):
    """The same from points of both: RANSAC over rigid motions of three points."""
    pixels_a, pixels_b = matches(a, b)
    before, after = frames.points(a, pixels_a), frames.points(b, pixels_b)
    good = np.isfinite(before[:, 2]) & np.isfinite(after[:, 2])
    before, after = before[good], after[good]
    random, best = np.random.default_rng(0), np.zeros(len(before), bool)
    for _ in range(DRAWS if len(before) >= LEAST else 0):
        three = random.choice(len(before), 3, replace=False)
        try:
            motion = rigid_motion(before[three], after[three])
        except ValueError:  # on one line
            continue
        near = np.linalg.norm(motion.apply(before) - after, axis=1) < TOLERANCE * after[:, 2]
        best = near if near.sum() > best.sum() else best
    return rigid_motion(before[best], after[best]) if best.sum() >= LEAST else None


METHODS = {
    f"{features} + {name}": (features, motion)
    for name, motion in (("solvePnPRansac", by_pnp), ("rigid motion by hand", by_hand))
    for features in ("KLT", "ORB")
}


def odometry_poses(frames, method, every):
    """(poses of every so-many-th frame, times lost)."""
    features, motion = METHODS[method]
    matches, numbers = Matches(frames, features), range(0, len(frames.grays), every)
    poses, lost = [frames.poses[0]], 0
    step = Pose(np.eye(3), np.zeros(3))
    for a, b in pairwise(numbers):
        found = motion(frames, a, b, matches)
        is_lost = found is None or bool(np.linalg.norm(found.position) > FARTHEST)
        lost += is_lost
        step = step if is_lost else found.inverse()
        poses.append(poses[-1] @ step)
    return poses, lost


def odometry(frames, method, every):
    """(ATE in cm, error at the end in cm, ms per pair, times lost) of every so-many-th frame's pose."""
    started = time.process_time()
    poses, lost = odometry_poses(frames, method, every)
    milliseconds = 1000 * (time.process_time() - started) / (len(poses) - 1)
    return (*path_errors(poses, frames.poses[::every]), milliseconds, lost)


def path_errors(poses, true_poses):
    """(ATE, error at the end) in cm."""
    places, truth = (np.array([pose.position for pose in path]) for path in (poses, true_poses))
    return 100 * ate(places, truth), 100 * math.dist(places[-1], truth[-1])


def print_odometry(frames, title, steps):
    """Prints ATE, end error, time and times lost; {(method, every): ATE in cm}."""
    way = sum(math.dist(a.position, b.position) for a, b in pairwise(frames.poses))
    print(f"\n{title}: {len(frames.grays)} frames, way {way:.2f} m")
    table = Table("ATE, error at the end in cm; CPU ms per pair", *(f"every {step}" for step in steps))
    errors = {}
    for method in METHODS:
        cells = []
        for every in tqdm(steps, method, leave=False):
            errors[method, every], end, milliseconds, lost = odometry(frames, method, every)
            text = f"{errors[method, every]:.1f}, {end:.1f}; {milliseconds:.0f}"
            cells.append(text + f" (lost {lost})" * (lost > 0))
        table.add_row(method, *cells)
    Console(width=110).print(table)
    return errors


def lesson_odometry(frames, lesson):
    """(ATE, error at the end) in cm, and the number of keyframes, of the lesson's class."""
    odometry = lesson["VisualOdometry"](frames.poses[0])
    pairs = zip(frames.grays, frames.depths, strict=True)
    poses = [odometry.step(gray, depth, frames.camera) for gray, depth in pairs]
    return (*path_errors(poses, frames.poses), odometry.count)


def print_loops(lesson):
    """Prints the loop in the room, driven with three seeds; whether the lesson's odometry failed."""
    failed = False
    for seed in SEEDS:
        frames = loop_frames(seed)
        print_odometry(frames, f"loop in the room, seed {seed}", (1, 3, 5))
        error, end, count = lesson_odometry(frames, lesson)
        wheels = path_errors(frames.wheels, frames.poses)
        print(f"wheels: {wheels[0]:.1f}, {wheels[1]:.1f}")
        print(f"the lesson's class, {count} keyframes: {error:.1f}, {end:.1f}", flush=True)
        failed |= error > wheels[0]
    return failed


def print_tools():
    """Prints what is computed by hand beside the tool; whether they differ."""
    random = np.random.default_rng(1)
    camera = CameraModel(640, 360, 352.0, 352.0, 319.5, 179.5)
    errors = {name: [] for name in ("homography, 4 corners", "homography, 30 points", "pose", "rigid motion")}
    for _ in range(1000):
        tilt = Rotation.from_euler("xyz", [math.pi + random.uniform(-1, 1), *random.uniform(-1, 1, 2)])
        pose = Pose(tilt.as_matrix(), np.array([*random.uniform(-0.5, 0.5, 2), random.uniform(1, 4)]))
        for count, name in ((4, "homography, 4 corners"), (30, "homography, 30 points")):
            flat = SQUARE if count == 4 else random.uniform(-0.3, 0.3, (count, 2))
            pixels = camera.project(pose.apply(np.column_stack([flat, np.zeros(count)])))
            flat, pixels = flat.astype(np.float32), pixels.astype(np.float32)  # OpenCV computes with these
            expected = cv2.findHomography(flat, pixels, 0)[0]
            errors[name].append(np.abs(homography(flat, pixels) - expected).max() / np.abs(expected).max())
        pixels = camera.project(pose.apply(SOLID_SQUARE)) + random.normal(scale=0.2, size=(4, 2))
        found = homography_pose(homography(SQUARE, pixels), camera.matrix)
        _, turns, _, _ = cv2.solvePnPGeneric(
            SOLID_SQUARE, pixels, camera.matrix, None, flags=cv2.SOLVEPNP_IPPE
        )
        errors["pose"].append(min(np.abs(cv2.Rodrigues(t)[0] - found.rotation).max() for t in turns))
        before = random.normal(size=(random.integers(3, 50), 3))
        after = pose.apply(before) + random.normal(scale=0.01, size=before.shape)
        expected, _ = Rotation.align_vectors(after - after.mean(0), before - before.mean(0))
        errors["rigid motion"].append(
            np.abs(rigid_motion(before, after).rotation - expected.as_matrix()).max()
        )
    limits = dict(zip(errors, (1e-9, 1e-5, 1e-6, 1e-12), strict=True))
    table = Table("by hand", "tool", "cases", "largest difference", "limit")
    tools = ("cv2.findHomography, method 0",) * 2 + (
        "cv2.solvePnPGeneric, SOLVEPNP_IPPE: rotation, corners with 0.2 px of noise",
        "scipy Rotation.align_vectors",
    )
    for (name, values), tool in zip(errors.items(), tools, strict=True):
        table.add_row(name, tool, str(len(values)), f"{max(values):.1e}", f"{limits[name]:.0e}")
    Console(width=130).print(table)
    return any(max(values) > limits[name] for name, values in errors.items())


REFINEMENTS = {
    "none": cv2.aruco.CORNER_REFINE_NONE,
    "subpixel": cv2.aruco.CORNER_REFINE_SUBPIX,
    "AprilTag": cv2.aruco.CORNER_REFINE_APRILTAG,
}


def marker_poses(corners, camera):
    """Poses of the marker in the optical frame: by hand; OpenCV's better; OpenCV's other one."""
    rays = camera.unproject(corners)[:, :2]
    by_hand = homography_pose(homography(SQUARE, rays), np.eye(3))
    _, turns, positions, _ = cv2.solvePnPGeneric(
        SOLID_SQUARE,
        corners,
        camera.matrix,
        np.array(camera.distortion),
        flags=cv2.SOLVEPNP_IPPE_SQUARE,
    )
    poses = [Pose(cv2.Rodrigues(t)[0], p.ravel()) for t, p in zip(turns, positions, strict=True)]
    return by_hand, poses[0], poses[-1]


def read_cells(gray, corners):
    """The marker's 6 × 6 cells, 1 is white: the nearest pixel to the middle of each, by hand."""
    square = 6 * np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    middles = np.stack([*np.meshgrid(np.arange(6) + 0.5, np.arange(6) + 0.5), np.ones((6, 6))], -1)
    pixels = middles @ homography(square, corners).T
    col, row = np.rint(pixels[..., :2] / pixels[..., 2:]).astype(int).transpose(2, 0, 1)
    levels = gray[row, col].astype(int)
    return levels > (levels.min() + levels.max()) / 2


def angle(first, second):
    """Degrees between the normals of two planes."""
    return math.degrees(math.acos(min(1.0, float(first.rotation[:, 2] @ second.rotation[:, 2]))))


def print_marker(recording, frames):
    """Prints the marker's pose in the drive with each refinement; whether a marker was not read."""
    right, wall, up = Pose.from_vector(recording.pose("marker", 0)).rotation.T
    marker = Pose(np.column_stack([right, up, -wall]), recording.pose("marker", 0)[:3])
    truth = [pose.inverse() @ marker for pose in frames.poses]
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    expected_cells = cv2.aruco.generateImageMarker(dictionary, MARKER, 6) // 255
    table = Table(
        "refinement, pose",
        "found",
        "position in the camera's frame: median, max in cm",
        "place of the camera: median, max in cm",
        "normal: median, max in °",
        "flips",
        "cells read",
    )
    failed = False
    for refinement, method in REFINEMENTS.items():
        settings = cv2.aruco.DetectorParameters()
        settings.cornerRefinementMethod = method
        detector = cv2.aruco.ArucoDetector(dictionary, settings)
        found, cells = {}, 0
        for k, gray in enumerate(tqdm(frames.grays, f"marker, {refinement}", leave=False)):
            corners, ids, _ = detector.detectMarkers(gray)
            numbers = [] if ids is None else ids.ravel().tolist()
            if MARKER in numbers:
                found[k] = corners[numbers.index(MARKER)].reshape(4, 2).astype(float)
                cells += bool((read_cells(gray, found[k]) == expected_cells).all())
        failed |= cells < len(found) or (refinement == "subpixel" and len(found) < 90)
        poses = {k: marker_poses(corners, frames.camera) for k, corners in found.items()}
        for number, name in enumerate(("by hand", "IPPE_SQUARE")):
            seen = {k: three[number] for k, three in poses.items()}
            rows = (
                [100 * math.dist(seen[k].position, truth[k].position) for k in seen],
                [
                    100 * math.dist((marker @ seen[k].inverse()).position, frames.poses[k].position)
                    for k in seen
                ],
                [angle(seen[k], truth[k]) for k in seen],
            )
            # A flip: the other of OpenCV's two poses has the better normal, by much.
            others = {k: max(three[1:], key=lambda pose: angle(pose, seen[k])) for k, three in poses.items()}
            flips = sum(angle(seen[k], truth[k]) > angle(others[k], truth[k]) + 5 for k in seen)
            cols = [f"{np.median(values):.1f}, {max(values):.1f}" for values in rows]
            table.add_row(f"{refinement}, {name}", str(len(seen)), *cols, str(flips), str(cells))
    print(f"\nmarker {MARKER}, {SIDE} m, in the drive's {len(frames.grays)} frames of 1280×720")
    Console(width=130).print(table)
    return failed


class Topics:
    """Collects the poses that node, wheels and truth publish: stamp in ns -> place in the map.

    The publisher of each topic numbers its messages from 1 on; `numbers` has those that arrived.
    """

    NAMES = ("/visual_odometry/odometry", "/kachaka/odometry/odometry", "/truth/pose/robot")

    def __init__(self):
        from geometry_msgs.msg import PoseStamped
        from nav_msgs.msg import Odometry
        from nav_msgs.msg import Path as PathMessage
        from rclpy.qos import qos_profile_sensor_data

        from imgproc_course.ros import RosSession

        self.messages, self.numbers = {}, {}
        kinds = (Odometry, Odometry, PoseStamped, PathMessage)
        for topic, kind in zip((*self.NAMES, "/visual_odometry/path"), kinds, strict=True):
            self.messages[topic], self.numbers[topic] = [], []
            RosSession.current().node.create_subscription(
                kind, topic, partial(self._receive, topic), qos_profile_sensor_data
            )

    def _receive(self, topic, msg, info):
        self.messages[topic].append(msg)
        self.numbers[topic].append(info["publication_sequence_number"])

    def places(self):
        """Of each true pose from the node's first on: true places (N, 3), the node's, the wheels'."""
        by_stamp = []
        for topic in self.NAMES:
            origin = Pose.planar(*START) if topic != "/truth/pose/robot" else Pose.planar(0, 0, 0)
            by_stamp.append({})
            for msg in list(self.messages[topic]):
                p = (msg.pose if topic == "/truth/pose/robot" else msg.pose.pose).position
                stamp = msg.header.stamp.sec * 10**9 + msg.header.stamp.nanosec
                by_stamp[-1][stamp] = origin.apply([p.x, p.y, p.z])
        seen, counted, true = by_stamp
        stamps = [stamp for stamp in sorted(true) if stamp in seen]
        nearest = np.array(sorted(counted))
        wheels = [counted[nearest[np.abs(nearest - stamp).argmin()]] for stamp in stamps]
        return tuple(np.array(p) for p in ([true[s] for s in stamps], [seen[s] for s in stamps], wheels))


def drive_live():
    """Prints a minute of circles in the room, with the node in another process; whether it failed."""
    from imgproc_course.ros import Robot, open_camera

    with open_camera("room", rate=RATE, start=START, seed=SEEDS[0]) as camera, Robot() as robot:
        robot.restart(start=START, seed=SEEDS[0])
        topics, bumps = Topics(), camera.bumps
        with subprocess.Popen([sys.executable, NODE, "inf"], stdout=subprocess.PIPE, text=True) as node:
            try:
                while not topics.messages["/visual_odometry/path"]:  # it begins while the robot stands
                    time.sleep(0.1)
                for _ in tqdm(range(round(SECONDS)), "seconds in the room"):
                    robot.drive(LINEAR, ANGULAR, seconds=1.0)
            finally:
                node.send_signal(signal.SIGINT)
            looks = int(node.communicate(timeout=60)[0])
        true, seen, wheels = topics.places()
        way = np.linalg.norm(np.diff(true, axis=0), axis=1).sum()
        counts = {topic: len(messages) for topic, messages in topics.messages.items()}
        bumps = camera.bumps - bumps
    numbers = topics.numbers["/visual_odometry/odometry"]
    sent = looks - numbers[0] + 1  # since this process is a subscriber
    print(
        f"\n{SECONDS:.0f} s live, seed {SEEDS[0]}, way {way:.1f} m: {looks} looks; received: "
        f"{len(numbers)} Odometry from number {numbers[0]} on, {counts['/visual_odometry/path']} Path, of "
        f"{counts['/truth/pose/robot']} images; {bumps} bumps\n"
        f"ATE {100 * ate(seen, true):.1f} cm, at the end {100 * math.dist(seen[-1], true[-1]):.1f} cm; "
        f"wheels {100 * ate(wheels, true):.1f} cm, {100 * math.dist(wheels[-1], true[-1]):.1f} cm"
    )
    return bool(bumps) or sent - len(numbers) > 0.02 * sent


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "98")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    cv2.setNumThreads(1)
    sys.path.append(str(NODE.parent))
    from visual_odometry import where_am_i

    lesson, recording = where_am_i(), open_recording("drive")
    failed = print_tools()
    large = drive_frames(recording, 1)
    failed |= print_marker(recording, large)
    for frames, size in ((large, "1280×720"), (drive_frames(recording, 2), "640×360")):
        errors = print_odometry(frames, f"the recorded drive, {size}", (1, 3, 10))
        failed |= errors["ORB + rigid motion by hand", 10] > errors["ORB + rigid motion by hand", 1]
    error, end, count = lesson_odometry(frames, lesson)
    print(f"the lesson's class, {count} keyframes: {error:.1f}, {end:.1f}", flush=True)
    failed |= print_loops(lesson)
    if SECONDS:
        failed |= drive_live()
    print("FAILED" if failed else "as required")
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
