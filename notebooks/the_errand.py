"""The robot of the lesson "The errand": what its sections show in parts, in the order in which it is used.

    Place        where the robot is          Errand       what it does next
    nearest_marker, low_points, ...          run_errand   a run in simulated time, with points
                 what the sensors see        run_live     a run in ROS

A number in capital letters may be changed from the notebook: the_errand.VOTES = 3.
"""

import csv
import math
import os
import time
from collections import Counter, deque
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
import rapidocr
from matplotlib.figure import Figure
from nbclassroom.exercises.progress import TEST_VARIABLE

from imgproc_course import geometry
from imgproc_course.display import show_figure
from imgproc_course.geometry import (
    CameraModel,
    LocalMap,
    Pose,
    compose_poses,
    free_way,
    relative_pose,
    safe_speed,
)
from imgproc_course.ros import Robot, RosSession, ros_available
from imgproc_course.simulation import Simulation

START = (2.45, 1.75, -1.8)  # the corner by the sofa
LOOKOUT = (1.4, -0.1)  # from here, the robot looks around
NAMES = ("KITCHEN", "BATHROOM", "OFFICE")
VOTES = 2  # so many looks must agree
LIMIT = 0.25  # m/s, the highest speed
REACTION = 0.4  # s
WIDTH = 0.30  # m, of the corridor
FRONT = 0.237  # m from the axle to the front of the robot
MARGIN = 0.10  # m to keep in front of it


# ---------------------------------------------------------------- the three functions


def is_near(text, name):
    """Whether at most one character was inserted, deleted or replaced."""
    pairs = enumerate(zip(text, name, strict=False))
    same = next((k for k, (a, b) in pairs if a != b), min(len(text), len(name)))
    return any(text[same + i :] == name[same + j :] for i in (0, 1) for j in (0, 1))


def count_votes(readings, names, votes):
    """As `believe`, with a Counter. It counts name after name, so of equals the first in names wins."""
    counter = Counter(
        name for name in names for look in readings if any(is_near(text.upper(), name) for text in look)
    )
    best = counter.most_common(1)
    return best[0][0] if best and best[0][1] >= votes else None


class Parts(NamedTuple):
    """The three functions of the exercises."""

    map_to_odom: Callable
    choose_direction: Callable
    believe: Callable


course_parts = Parts(geometry.map_to_odom, geometry.choose_direction, count_votes)


# ---------------------------------------------------------------- where the robot is


class Place:
    """Where the robot is: the odometry, corrected by markers."""

    def __init__(self, start, parts, believes_all=False):
        self.parts = parts
        self.odom = parts.map_to_odom(start, (0.0, 0.0, 0.0))  # of the odometry's frame, in the map
        self.believes_all = believes_all
        # How wrong x, y (metres) and yaw (radians) may be: the roots of the Kalman filter's P
        self.spread = np.array([0.02, 0.02, 0.02])
        self.counted = (0.0, 0.0, 0.0)
        self.refused = 0

    @property
    def pose(self):
        return tuple(compose_poses(self.odom, self.counted).round(6).tolist())

    def count(self, counted):
        """The wheels have counted on: each metre and each turn makes the pose less sure."""
        way = math.dist(counted[:2], self.counted[:2])
        turn = abs(math.remainder(counted[2] - self.counted[2], 2 * math.pi))
        # Chosen by trying: 5 cm and 0.1 radians for the first metre, 0.02 for the first radian
        grows = np.array([0.05, 0.05, 0.1]) ** 2 * way + np.array([0.0, 0.0, 0.02]) ** 2 * turn
        self.spread = np.sqrt(self.spread**2 + grows)
        self.counted = counted

    def correct(self, marker_pose, distance):
        """A marker says: the robot is at marker_pose. How much of it is believed?"""
        change = np.array(marker_pose) - self.pose
        change[2] = math.remainder(change[2], 2 * math.pi)
        # Twice as far is four times as unsure
        marker_spread = np.array([0.03, 0.03, 0.025]) * distance**2 + (0.01, 0.01, 0.02)
        together = np.sqrt(self.spread**2 + marker_spread**2)
        gain = self.spread**2 / together**2  # 1: take the marker's value, 0: keep the old one
        if self.believes_all:
            gain = np.ones(3)
        elif (np.abs(change) > 3 * together).any():
            self.refused += 1
            return
        self.spread = np.sqrt(1 - gain) * self.spread
        corrected = tuple((self.pose + gain * change).tolist())
        self.odom = self.parts.map_to_odom(corrected, self.counted)


# ---------------------------------------------------------------- what the sensors see


class Seen(NamedTuple):
    """What the robot knows at one look; frame and depth are functions, called only if needed."""

    counted: tuple  # (x, y, yaw) of the odometry
    ranges: np.ndarray  # (360,) of the laser scan
    is_standing: bool
    frame: Callable
    depth: Callable
    camera: CameraModel
    rays: np.ndarray  # (360, 640, 3), of the depth image


@cache
def marker_detector():
    settings = cv2.aruco.DetectorParameters()
    settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX  # to parts of a pixel
    return cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), settings)


SQUARE = 0.125 * np.array([(-1, 1, 0), (1, 1, 0), (1, -1, 0), (-1, -1, 0)])  # a marker's corners, metres
# The camera, as the robot sees it; the columns: right, down and ahead of the camera
MOUNT = Pose(np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]]), np.array([0.21, 0.0, 0.20]))


def nearest_marker(gray, camera, markers):
    """(distance, the robot's (x, y, yaw) by it) of the nearest marker; None without one."""
    corners, numbers, _ = marker_detector().detectMarkers(gray)
    seen = []
    for four, number in zip(corners, [] if numbers is None else numbers.ravel().tolist(), strict=True):
        if number in markers:
            distortion = np.array(camera.distortion)
            _, turn, shift = cv2.solvePnP(
                SQUARE, four[0], camera.matrix, distortion, flags=cv2.SOLVEPNP_IPPE_SQUARE
            )
            marker = Pose(cv2.Rodrigues(turn)[0], shift.ravel())
            robot = markers[number] @ marker.inverse() @ MOUNT.inverse()
            yaw = math.atan2(robot.rotation[1, 0], robot.rotation[0, 0])
            # Rounded to centimetres: no digit after that is sure.
            pose = (round(robot.position[0], 2), round(robot.position[1], 2), round(yaw, 2))
            seen.append((round(float(np.linalg.norm(shift)), 2), pose))
    return min(seen, default=None)


def flat_markers(robot):
    """The poses of both markers in the map: x to the right, y up, z out of the front."""
    poses = {}
    for number, name in ((7, "marker"), (12, "wall_marker")):
        right, back, up = Pose.from_vector(robot.pose(name)).rotation.T
        poses[number] = Pose(np.column_stack([right, up, -back]), robot.pose(name)[:3])
    return poses


def low_points(depth, rays):
    """Places (N, 2), ahead and left, of what is 3 to 15 cm high: a laser scan may miss it."""
    z = depth[::6, ::6] / 1000  # each sixth pixel is enough
    points = rays[::6, ::6] * z[:, :, np.newaxis]
    height = 0.20 - points[:, :, 1]
    mask = (height > 0.03) & (height < 0.15) & (z > 0.1) & (z < 2)
    return np.column_stack([0.21 + points[mask][:, 2], -points[mask][:, 0]])


def scan_points(ranges):
    """Places (N, 2), ahead and left of the axle, of what a turn of the laser scanner hits."""
    angles = np.radians(np.arange(360))[np.isfinite(ranges)]
    hits = ranges[np.isfinite(ranges)]
    return np.column_stack([0.156 + hits * np.cos(angles), hits * np.sin(angles)])


@cache
def text_reader():
    threads = {f"EngineConfig.onnxruntime.{name}_op_num_threads": 1 for name in ("intra", "inter")}
    return rapidocr.RapidOCR(params={"Global.log_level": "error", **threads})


def read_with_places(frame):
    """The texts in a frame, each with the pixel (column, row) of its middle."""
    result = text_reader()(frame, use_det=True, use_cls=False, use_rec=True)
    if not result.txts:
        return []
    return [(text, box.mean(axis=0)) for text, box in zip(result.txts, result.boxes, strict=True)]


# ---------------------------------------------------------------- what it does next


class Errand:
    """Decides at each look what the robot does next. It knows only what `seen` tells."""

    def __init__(self, markers, read, parts, start=START, believes_all=False, sees_low=True):
        self.place = Place(start, parts, believes_all)
        self.start, self.markers, self.read, self.parts = start, markers, read, parts
        self.map = LocalMap((-1.5, -3.2), (130, 170))
        self.task, self.goal = self.to_lookout, LOOKOUT
        self.readings, self.name, self.sign = [], None, None
        self.looks = self.standing = 0
        self.sees_low = sees_low
        self.route, self.been, self.back_off = None, [], 0
        self.headings = [math.radians(degrees) for degrees in (0, 60, -60, 120, -120, 180)]
        self.diary, self.album = [], []  # tasks with the look at which each ended; images

    def command(self, seen):
        """One look: where am I, what is around me, and what does the task say? (m/s, rad/s)"""
        self.looks += 1
        self.standing = self.standing + 1 if seen.is_standing else 0
        self.place.count(seen.counted)
        if self.looks % 8 == 0 or self.standing == 1:  # each 1.6 s; and when it stops, for a sharp image
            gray = cv2.cvtColor(self.image(seen), cv2.COLOR_BGR2GRAY)
            found = nearest_marker(gray, seen.camera, self.markers)
            if found is not None:
                self.place.correct(found[1], found[0])
        # In the frame of its map, which is odom, moved to START: this pose never jumps
        self.drawn = tuple(compose_poses(self.start, seen.counted).tolist())
        if self.looks % 2 == 0:
            self.map.add_scan(self.drawn, 0.156, seen.ranges)
        if self.sees_low and self.looks % 3 == 0:
            self.map.add_low_points(
                self.drawn, low_points(seen.depth(), seen.rays), near=0.7, far=2.0, slope=0.7
            )
        linear, angular = self.task(seen)
        return round(linear, 3), round(angular, 3)

    def image(self, seen):
        """The camera's image, which also goes to the album."""
        if not self.album or self.album[-1][0] != self.looks / 5:
            self.frame = seen.frame()
            self.album.append((self.looks / 5, self.frame[::2, ::2].copy()))
        return self.frame

    def begin(self, task, goal=None):
        """Ends the current task and begins another one. The robot stands meanwhile."""
        self.diary.append((self.task.__name__, self.looks))
        self.task, self.goal, self.route, self.been = task, goal, None, []
        return 0.0, 0.0

    # The tasks. `towards` and `turn_to` return None if the robot is there: then comes what stands after `or`.
    def to_lookout(self, seen):
        return self.towards(seen, self.goal) or self.begin(self.look_around)

    def look_around(self, seen):
        turn = self.turn_to(self.headings[0])
        if turn or self.standing < 3:
            return turn or (0.0, 0.0)
        for text, (col, row) in self.read(self.image(seen)):
            if self.parts.believe([[text]], NAMES, 1):
                self.sign = self.place_of(seen, int(col), int(row))
                way = self.place.pose[:2] - self.sign
                return self.begin(self.to_sign, tuple((self.sign + 1.6 * way / math.hypot(*way)).tolist()))
        self.headings = [*self.headings[1:], self.headings[0]]
        return 0.0, 0.0

    def to_sign(self, seen):
        return self.towards(seen, self.goal) or self.begin(self.read_sign)

    def read_sign(self, seen):
        x, y, _ = self.place.pose
        turn = self.turn_to(math.atan2(self.sign[1] - y, self.sign[0] - x))
        if turn or self.standing < 3:
            return turn or (0.0, 0.0)
        self.readings.append([text for text, _ in self.read(self.image(seen))])
        self.name = self.parts.believe(self.readings, NAMES, VOTES)
        if self.name or len(self.readings) == 8:
            return self.begin(self.come_back, self.start[:2])
        return 0.0, 0.0

    def come_back(self, seen):
        return self.towards(seen, self.goal) or self.begin(self.finished)

    def finished(self, seen):
        return 0.0, 0.0

    # how it drives
    def place_of(self, seen, col, row):
        """The place (x, y) in the map of what a pixel of the image shows, by the depth image."""
        k = seen.camera.width // seen.rays.shape[1]  # the depth image is smaller
        right, _, far = seen.rays[row // k, col // k] * (seen.depth()[row // k, col // k] / 1000)
        return compose_poses(self.place.pose, (0.21 + far, -right, 0.0))[:2].round(2)

    def turn_to(self, yaw):
        """The command of a turn on the spot; None if the robot looks there."""
        rest = math.remainder(yaw - self.place.pose[2], 2 * math.pi)
        return None if abs(rest) < 0.06 else (0.0, min(max(1.5 * rest, -0.8), 0.8))

    def towards(self, seen, goal):
        """The command on the way to the goal; None if the robot is there."""
        far = math.dist(goal, self.place.pose[:2])
        if far < 0.12:
            return None
        points = np.concatenate([scan_points(seen.ranges), self.map.low_points(self.drawn)])
        has_room_behind = free_way(points, math.pi, WIDTH) > 0.30
        if self.is_stuck():
            self.back_off, self.been = self.looks + 10, []
        if self.looks < self.back_off:
            return (-0.15, 0.0) if has_room_behind else (0.0, 0.0)
        direction = self.free_direction(points, self.direction_of_route(goal), min(far, 0.2))
        if direction is None:
            return 0.0, 0.0
        turn = min(max(2 * direction, -0.8), 0.8)
        if abs(direction) > math.radians(35):  # on the spot, if the corners of the body have room
            nearest = np.hypot(*points.T).min()
            return (-0.1 if nearest < 0.28 and has_room_behind else 0.0), turn if nearest > 0.27 else 0.0
        speed = safe_speed(free_way(points, 0.0, WIDTH) - FRONT - MARGIN, REACTION, 0.6, LIMIT)
        return min(speed * math.cos(direction), max(0.06, far)), turn

    def free_direction(self, points, wanted, need):
        """The free direction nearest to the wanted one, radians; None if there is none."""
        directions = np.radians(np.arange(-180, 180, 10))
        ways = np.array([free_way(points, direction, WIDTH) for direction in directions])
        direction = self.parts.choose_direction(directions, ways, wanted, FRONT + MARGIN + need)
        if direction is not None and abs(math.remainder(direction - wanted, 2 * math.pi)) < math.radians(10):
            return wanted  # free, and finer than steps of 10 degrees
        return direction

    def is_stuck(self):
        """Whether it has hardly moved in 15 looks: then something waits for the robot, as it waits."""
        self.been = [*self.been[-14:], self.place.pose]
        (x, y, yaw), (u, v, now) = self.been[0], self.been[-1]
        moved = math.dist((x, y), (u, v)) > 0.05 or abs(math.remainder(now - yaw, 2 * math.pi)) > 0.3
        return len(self.been) == 15 and not moved

    def direction_of_route(self, goal):
        """The direction, seen from the robot, of the route's point half a metre ahead."""
        here = np.array(self.drawn[:2])
        if self.route is None or self.looks % 5 == 0:
            in_odom = relative_pose(self.place.odom, (*goal, 0.0))
            self.route = self.map.route(here, compose_poses(self.start, in_odom)[:2])
        far = np.hypot(*(self.route - here).T)
        rest = np.flatnonzero(far[far.argmin() :] > 0.45)
        x, y = self.route[far.argmin() + rest[0] if len(rest) else -1] - here
        return math.remainder(math.atan2(y, x) - self.drawn[2], 2 * math.pi)


# ---------------------------------------------------------------- a run, and its points


class Result(NamedTuple):
    """What a referee says of a run."""

    points: int
    name: str  # the name of the sign, or None
    back: float  # metres from the start, at the end
    seconds: int
    bumps: int
    kept: float  # the smallest distance to the person, metres
    path: np.ndarray  # (N, 2), the truth
    believed: np.ndarray  # (N, 2), where the robot believed it was
    bump_times: list  # seconds


def points_of(name, back, seconds, bumps, kept):
    is_back = back < 0.5
    for_time = min(max(10 - (seconds - 60) / 6, 0), 10) if is_back else 0
    return round(
        40 * (name == "KITCHEN") + 30 * is_back + for_time + 10 * (kept > 0.5) + max(0, 10 - 5 * bumps)
    )


class Referee:
    """Watches a run with the truth. The robot knows nothing of it."""

    def __init__(self, errand):
        self.errand = errand
        self.path, self.believed, self.bump_times = [], [], []
        self.kept, self.touched = math.inf, -math.inf

    def bump(self, second):
        """The robot touches something; within a second this is the same bump."""
        if second > self.touched + 1:
            self.bump_times.append(round(second, 1))
        self.touched = second

    def see(self, robot, person):
        self.path.append(robot)
        self.believed.append(self.errand.place.pose[:2])
        self.kept = min(self.kept, math.dist(robot, person))

    def result(self, seconds):
        back, bumps = round(math.dist(self.path[-1], START[:2]), 2), len(self.bump_times)
        points = points_of(self.errand.name, back, round(seconds), bumps, self.kept)
        about = points, self.errand.name, back, round(seconds), bumps, round(self.kept, 2)
        return Result(*about, np.array(self.path), np.array(self.believed), self.bump_times)


def run_errand(seed, lighting="day", limit=180, **options):
    """(Result, Errand) of one errand in simulated time; five looks in a second."""
    robot = Simulation(seed=seed, start=START, time=10.0 * seed, size=(1280, 720), lighting=lighting)
    errand = Errand(flat_markers(robot), read_with_places, **{"parts": course_parts, **options})
    referee, rays, begin = Referee(errand), robot.depth_camera().rays(), robot.time
    while errand.task != errand.finished and robot.time < begin + limit:
        sensors = robot.odometry()[:3], np.array(robot.scan().ranges), robot.speeds == (0, 0)
        linear, angular = errand.command(Seen(*sensors, robot.frame, robot.depth, robot.camera, rays))
        for _ in range(10):
            robot.step(linear, angular, dt=0.02)
            if robot.bumped:
                referee.bump(robot.time - begin)
        referee.see(robot.pose("robot")[:2], robot.pose("person")[:2])
    robot.close()
    return referee.result(robot.time - begin), errand


def print_run(result, errand):
    print("tasks done:", [task for task, _ in errand.diary])
    for reading in errand.readings:
        print(reading)
    print(f"name: {result.name}   back: {result.back} m from the start after {result.seconds} s")
    print(f"bumps: {result.bumps}   distance to the person: {result.kept} m   points: {result.points}")


def draw_run(result, errand, text):
    """The path of a run, where the robot believed it was, and what its map shows."""
    to_map = compose_poses(errand.place.odom, relative_pose(errand.start, (0.0, 0.0, 0.0)))
    rows, cols = np.nonzero((errand.map.log_odds > 0) | errand.map.low)
    places = np.column_stack([0.05 * cols - 1.5, 0.05 * rows - 3.2, np.zeros(len(rows))])
    x, y, _ = compose_poses(to_map, places).T
    figure = Figure(figsize=(8, 4.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(x.round(2), y.round(2), ".", color="0.6", markersize=2, label="its map")
    axes.plot(*result.path.round(2).T, "C1", linewidth=5, alpha=0.6, label="truth")
    axes.plot(*result.believed.round(2).T, "b.-", linewidth=1, markersize=3, label="believed")
    axes.plot(*START[:2], "go", label="start")
    axes.plot(5.59, -0.29, "rs", label="sign")
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal", xlim=(-1.6, 6.6), ylim=(-2.5, 2.7))
    axes.legend(loc="upper left", ncols=2)
    show_figure(figure, text=text)


RUNS = Path("errand_runs.csv")  # beside the notebook
COLUMNS = ("points", "seed", "light", "name", "back", "seconds", "bumps", "kept", "note")


def keep_run(result, seed, lighting, note):
    """Adds a run to the file of your runs, and prints all of them, the best first."""
    is_new = not RUNS.exists()
    with RUNS.open("a", newline="") as file:
        rows = csv.writer(file)
        if is_new:
            rows.writerow(COLUMNS)
        rows.writerow([result.points, seed, lighting, *result[1:6], note])
    with RUNS.open(newline="") as file:
        header, *runs = csv.reader(file)
    for run in (header, *sorted(runs, key=lambda run: -int(run[0]))):
        print("".join(f"{value:>9}" for value in run[:-1]), "", run[-1])


# ---------------------------------------------------------------- in ROS

if ros_available():
    from geometry_msgs.msg import PoseStamped, Twist
    from nav_msgs.msg import Odometry
    from rclpy.node import Node
    from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
    from sensor_msgs.msg import CameraInfo, Image, LaserScan
    from std_msgs.msg import String

    from imgproc_course.messages import image_to_array

    NEWEST_ONLY = QoSProfile(
        history=HistoryPolicy.KEEP_LAST, depth=1, reliability=ReliabilityPolicy.BEST_EFFORT
    )

    def seconds_of(msg):
        return msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9

    class ErrandNode(Node):
        """Does the errand with what the topics bring."""

        def __init__(self, errand, context=None):
            super().__init__("errand", context=context)
            self.errand = errand
            self.camera = self.rays = None
            self.newest, self.odometry = {}, deque(maxlen=60)
            self.looks = 0
            for name, kind, topic in (
                ("info", CameraInfo, "front_camera/camera_info"),
                ("odometry", Odometry, "odometry/odometry"),
                ("image", Image, "front_camera/image_raw"),
                ("depth", Image, "front_camera/depth"),
                ("scan", LaserScan, "lidar/scan"),
            ):
                callback = partial(self.on_message, name)
                self.create_subscription(kind, f"/kachaka/{topic}", callback, NEWEST_ONLY)
            self.commands = self.create_publisher(Twist, "/kachaka/manual_control/cmd_vel", NEWEST_ONLY)
            self.names = self.create_publisher(String, "~/name", 10)

        def on_message(self, name, msg):
            """Keeps a message; gives a command as soon as image, depth and scan of one moment are there."""
            self.newest[name] = msg
            if name == "odometry":
                self.odometry.append(msg)
            if name not in ("image", "depth", "scan") or len(self.newest) < 5:
                return
            if len({seconds_of(self.newest[name]) for name in ("image", "depth", "scan")}) > 1:
                return
            command = Twist()
            command.linear.x, command.angular.z = self.errand.command(self.seen())
            self.commands.publish(command)
            if self.errand.name is not None:
                self.names.publish(String(data=self.errand.name))
            self.looks += 1

        def seen(self):
            info, image, depth = (self.newest[name] for name in ("info", "image", "depth"))
            if self.camera is None:
                matrix = info.k[0], info.k[4], info.k[2], info.k[5]
                self.camera = CameraModel(info.width, info.height, *matrix, tuple(info.d))
                self.rays = self.camera.every(self.camera.width // depth.width).rays()
            odometry = min(self.odometry, key=lambda msg: abs(seconds_of(msg) - seconds_of(image)))
            place, turn = odometry.pose.pose.position, odometry.pose.pose.orientation
            speed = odometry.twist.twist
            return Seen(
                counted=(place.x, place.y, 2 * math.atan2(turn.z, turn.w)),
                ranges=np.roll(self.newest["scan"].ranges, -90),  # straight ahead is ray 90
                is_standing=max(abs(speed.linear.x), abs(speed.angular.z)) < 0.001,
                frame=lambda: image_to_array(image, "bgr8"),
                depth=lambda: image_to_array(depth),
                camera=self.camera,
                rays=self.rays,
            )


def run_live(camera, parts, seconds, lighting="day"):
    """(Result, Errand) of one errand in ROS, in the room of this camera; at most so many seconds."""
    robot, session, places = Robot(), RosSession.current(), {}
    robot.restart(start=START, seed=1, lighting=lighting)
    errand = Errand(flat_markers(Simulation()), read_with_places, parts)
    referee = Referee(errand)
    referee.see(START[:2], (math.inf, math.inf))  # until the truth of the room arrives
    nodes = ErrandNode(errand, context=session.context), Node("referee", context=session.context)
    for name in ("robot", "person"):
        keep = partial(places.__setitem__, name)
        nodes[1].create_subscription(PoseStamped, f"/truth/pose/{name}", keep, NEWEST_ONLY)
    for node in nodes:
        session.add_node(node)
    is_test = TEST_VARIABLE in os.environ  # build and tests: only until the robot has left the corner
    begin, second, touches, told = time.monotonic(), 0.0, camera.bumps, 0
    try:
        while errand.task != errand.finished and second < (60 if is_test else seconds):
            time.sleep(0.1)
            second, before, touches = time.monotonic() - begin, touches, camera.bumps
            if touches > before:
                referee.bump(second)
            if len(places) == 2:
                positions = (places[name].pose.position for name in ("robot", "person"))
                referee.see(*((position.x, position.y) for position in positions))
            for task, _ in errand.diary[told:]:
                print(f"{second:3.0f} s: {task} is done")
            told = len(errand.diary)
            if is_test and math.dist(referee.path[-1], START[:2]) > 0.2:
                print("This stored run ends here, on the way. Run the cell to see the whole errand.")
                break
    finally:
        for node in nodes:
            session.remove_node(node)
        robot.close()
    return referee.result(second), errand
