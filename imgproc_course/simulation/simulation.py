"""The simulated robot in the room of the recorded drive."""

import contextlib
import math
from collections.abc import Collection, Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from ..geometry import CameraModel, Pose
from ..geometry.poses import product, rotation_about
from .laser import MOUNT, LaserScan
from .movers import Movers
from .renderer import NEAR, NEAREST
from .room import BALLS, MOVERS, Room, recorded_room
from .scene import Scene
from .sensor import Sensor
from .wheels import Odometry, WheelOdometry, Wheels, clearance, gap

# The recorded drive's camera: 1280×720, and where it stands on the robot.
CAMERA = CameraModel(1280, 720, 705.0, 705.0, 639.5, 359.5, (-0.170, 0.035, 0.0004, -0.0003, 0.0))
OPTICAL = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])  # columns: the optical frame's axes in the body's
CAMERA_MOUNT = Pose(OPTICAL, np.array([0.21, 0, 0.20]))  # of the optical frame in base_link, metres
# The depth camera below it, tilted up by 45 degrees: at this tilt it does not see the floor.
TOF_CAMERA = CameraModel(160, 120, 80.0, 80.0, 79.5, 59.5)
TOF_MOUNT = Pose(product(OPTICAL, rotation_about("x", math.pi / 4)), np.array([0.221, 0, 0.0418]))
LASER_MOUNT = Pose.planar(MOUNT[0], 0, math.pi / 2, MOUNT[1])  # its messages' frame is turned to the left
LONGEST_STEP = 0.02  # seconds
LONGEST_HELD, PLAY = 1.0, 0.01  # seconds that the body cannot move; metres per second: see _blocked
LONGEST_PINNED = 3.0  # seconds in which it only moves to and fro in some centimetres, as before the car
DEPTH_WIDTH = 640


class Simulation(contextlib.AbstractContextManager["Simulation"]):
    """A robot that drives through the room of the recorded drive; the same calls always give the same.

    There is no clock and no ROS: `step` moves robot, person, car and ball, everything else looks. Several
    simulations can be used side by side; one of them by one thread at a time. Only `depth` and `labels` can
    be called by a second thread, while the first does not call them or `step`, `look` and `close`.

    Parameters
    ----------
    seed : of the wheels' slip and the sensors' noise
    room : the `Room`; if omitted, the living room of the recorded drive. Or a Scene of a room: simulations
        that one thread uses, one after the other or in turns, share what their sensors need
    movers : whether person, car and ball take part; or the names of those that do
    balls : at most three (x, y, dx, dy): each begins at (x, y) in the map, and rolls along (dx, dy), 0.88 of
        it in all; the first one is "ball"; if omitted, the room's own
    start : (x, y, yaw) of the axle's center in the map, metres and radians; if omitted, the room's own
    uneven : one wheel is by this share larger than its odometry assumes, the other one smaller
    time : seconds after the recorded drive's start, for person, car and ball
    size : (width, height) of the image, of shape 16:9
    depth_size : (width, height) of depth and labels, of shape 16:9; if omitted, as `depth` says
    lens : with the recorded camera's distortion
    sensor : with blur, vignette and noise, also of the scan
    lighting : "day" or "evening"

    Attributes
    ----------
    room : the Room: what is written on the sign, where things move, and more
    camera : the CameraModel of `frame`
    movers : names of those who take part
    time : seconds after the recorded drive's start
    bumped : whether the body touched anything in the last step

    Raises
    ------
    ValueError : a start that is not free, or an argument outside of these
    RuntimeError : panda3d is not installed
    """

    def __init__(
        self,
        seed: int = 0,
        *,
        room: Room | Scene | None = None,
        movers: bool | Collection[str] = True,
        balls: Sequence[Sequence[float]] = (),
        start: Sequence[float] | None = None,
        uneven: float = 0.0,
        time: float = 0.0,
        size: tuple[int, int] = (640, 360),
        depth_size: tuple[int, int] | None = None,
        lens: bool = True,
        sensor: bool = True,
        lighting: str = "day",
    ):
        check_arguments(seed, time, size, lighting)
        self.camera = front_camera(size, lens)
        self._depth_model = self.camera.every(max(1, math.ceil(size[0] / DEPTH_WIDTH)))
        if depth_size is not None:
            check_size("depth_size", depth_size)
            self._depth_model = front_camera(depth_size, lens)
        self._seed, self._lighting = seed, lighting
        self._shares_scene = isinstance(room, Scene)
        self._scene = room if isinstance(room, Scene) else Scene(recorded_room() if room is None else room)
        self.room = self._scene.room
        self.movers = checked_movers(movers, balls)
        self._movers = Movers(round(float(time), 9), self.room, self.movers, balls)
        self.time, self._steps, self.bumped = round(float(time), 9), 0, False
        self._wheels = Wheels(checked_start(self.room.start if start is None else start))
        for name, distance in self._distances(self._wheels.place).items():
            if distance < 0:
                remedy = "time" if start is None else f"start, such as {self.room.start}"
                thing = f"the {name.replace('toy', 'toy ')}" if name else "a wall or furniture"
                raise ValueError(
                    f"the robot cannot start at {self._wheels.place}: {thing} is in its way; "
                    f"choose another {remedy}"
                )
        self._held: tuple[Any, float, frozenset[float]] = self._wheels.place, 0.0, frozenset()  # _small_step
        self._pinned = self._held
        self._odometry = WheelOdometry(np.random.default_rng([seed, 1]), uneven)
        self._sensor = Sensor(self.camera, seed, lighting) if sensor else None
        self._look: Pose | None = None
        self._drawn: dict[str, Any] = {}  # of a depth camera: what `_numbers` keeps
        self._joints: tuple[int, dict[str, Pose]] = (-1, {})  # and the number of their step

    # what the robot does

    def step(self, linear: float, angular: float, dt: float = 0.02) -> None:
        """Drives for dt seconds, towards the commanded speeds (m/s, rad/s), within the real robot's limits.

        Raises
        ------
        ValueError : a speed that is not finite, or dt not between 0 and 1 second
        """
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise ValueError(f"speeds must be finite numbers, got linear {linear}, angular {angular}")
        if not 0 < dt <= 1:
            raise ValueError(f"a step takes more than 0 and at most 1 second, got dt = {dt}")
        parts = math.ceil(round(dt / LONGEST_STEP, 9))
        bumped = [self._small_step(float(linear), float(angular), dt / parts) for _ in range(parts)]
        self.bumped = any(bumped)
        self._steps += 1
        self.time = round(self.time + dt, 9)

    def _small_step(self, linear, angular, dt):
        body = self._wheels
        body.accelerate(linear, angular, dt)
        touched = False
        # What blocks the way can leave room to turn.
        for speeds in ((body.linear, body.angular), (0.0, body.angular), (0.0, 0.0)):
            place = body.moved(*speeds, dt)
            if speeds == (0.0, 0.0) or not self._blocked(place):
                hit, gave_way = self._movers.push_balls(place, speeds, body.place)
                touched |= hit
                if gave_way or speeds == (0.0, 0.0):
                    break
            touched = True
        # For how long the body has hardly moved although it should, and which ways were tried.
        stands = linear == angular == 0
        self._held = _held_longer(self._held, place, linear, dt, -1 if stands else 0.01)
        self._pinned = _held_longer(self._pinned, place, linear, dt, -1 if stands else 0.1)
        if touched and (_is_stuck(self._held, LONGEST_HELD) or _is_stuck(self._pinned, LONGEST_PINNED)):
            self._movers.give_way(dt, place)
        body.place = place
        body.linear, body.angular = speeds
        self._odometry.step(*speeds, dt, self.room.rug.holds(*place[:2]))
        self._movers.step(dt, place)
        return touched

    def _blocked(self, place):
        """Whether the body at (x, y, yaw) would be in something, and not merely leave it.

        A body that is held gets some play, which grows until it moves.
        """
        limit = -PLAY * self._held[1] if _is_stuck(self._held, LONGEST_HELD) else 0.0
        after = self._distances(place)
        if min(after.values()) >= limit:
            return False
        before = self._distances(self._wheels.place)
        return any(after[name] < limit and after[name] <= before[name] for name in after)

    def _distances(self, place):
        """As `gaps`, at another (x, y, yaw), without balls and quickly."""
        still = clearance(self.room.free_space.distance, *place)
        return {"": still, **self._movers.gaps(place, balls=False)}

    # what it sees

    def look(self, camera_pose: Sequence[float] | np.ndarray | None) -> None:
        """Takes images from a pose of the optical frame, x y z qx qy qz qw; None: the robot's again."""
        self._look = None if camera_pose is None else Pose.from_vector(np.round(camera_pose, 9))

    def frame(self) -> NDArray[np.uint8]:
        """The front camera's image, (height, width, 3) uint8 BGR."""
        renderer, view, columns, rows = self._scene.color_view(self.camera, self._lighting)
        renderer.place(self._joint_poses())
        drawn = renderer.render(view, self._camera_pose("front"), self._near("front"))
        drawn = cv2.remap(drawn, columns, rows, cv2.INTER_LINEAR)
        image = np.asarray(cv2.cvtColor(drawn, cv2.COLOR_BGRA2BGR), np.uint8)
        if self._sensor is None:
            return image
        return self._sensor(image, self._steps, 0.0 if self._look else self._wheels.angular)

    def depth(self, camera: str = "front") -> NDArray[np.uint16]:
        """Depth along the optical axis in millimetres, (height, width) uint16, 0 where there is none.

        "front": of pixels (0, 0), (0, k), … of `frame`, 640 columns at most, or of the whole of a `frame` of
        size `depth_size`; "tof": the depth camera's.
        """
        numbers, rays = self._numbers(camera)
        metres = rays.depth(numbers, self._camera_pose(camera), self._joint_poses())
        return (metres * 1000 + 0.5).astype(np.uint16)

    def labels(self) -> NDArray[np.uint8]:
        """The class of each pixel of `depth`, (height, width) uint8; `label_names` has the names."""
        numbers, rays = self._numbers("front")
        return rays.labels(numbers)

    @property
    def label_names(self) -> dict[int, str]:
        """The name of each number in `labels()`."""
        return dict(self.room.model.label_names)

    def depth_camera(self, camera: str = "front") -> CameraModel:
        """The CameraModel of `depth`."""
        if camera == "tof":
            return TOF_CAMERA
        if camera != "front":
            raise ValueError(f'camera is "front" or "tof", got {camera!r}')
        return self._depth_model

    def _numbers(self, camera):
        """The triangle number of each pixel of a depth camera; kept until something moves."""
        view, rays = self._scene.number_view(self.depth_camera(camera))
        pose = self._camera_pose(camera)
        key = (self._steps, pose.position.tobytes(), pose.rotation.tobytes())
        if self._drawn.get(camera, [None])[0] != key:
            renderer = self._scene.number_renderer
            renderer.place(self._joint_poses())
            self._drawn[camera] = key, rays.numbers(renderer.render(view, pose, self._near(camera)))
        return self._drawn[camera][1], rays

    def scan(self) -> LaserScan:
        """One turn of the laser scanner."""
        seed = None if self._sensor is None else self._seed
        return self._scene.laser.scan(self._wheels.place, self._joint_poses(), seed, self._steps)

    def odometry(self) -> Odometry:
        """Where the wheels say that the robot is, since the start: with slip."""
        return self._odometry.state

    # the truth

    @property
    def speeds(self) -> tuple[float, float]:
        """(linear, angular) in m/s and rad/s: the true ones."""
        return self._wheels.linear, self._wheels.angular

    @property
    def place(self) -> tuple[float, float, float]:
        """The true (x, y, yaw) of the robot in the map, metres and radians."""
        return self._wheels.place

    def gaps(self) -> dict[str, float]:
        """Metres between the body and what stands still, by the name "", and each mover; negative inside."""
        still = gap(self.room.free_space.distance, *self.place)
        return {"": still, **self._movers.gaps(self.place)}

    def nearest_thing(self) -> str:
        """The name of what is nearest to the body: "wall", "sofa", "person", "toy car" …"""
        gaps = self.gaps()
        name = min(gaps, key=gaps.__getitem__)
        return name.replace("toycar", "toy car") or self.thing_at(self.place)

    def thing_at(self, place: tuple[float, float, float]) -> str:
        """The name of what stands still nearest to the body at (x, y, yaw)."""
        return self._scene.thing_at(place)

    def pose(self, name: str) -> NDArray[np.float64]:
        """The true pose in the map, [x, y, z, qx, qy, qz, qw], float64.

        Of "robot" (its axle's center on the floor), "camera" and "tof" (optical frames), "person", "toycar",
        "ball", "marker", "wall_marker" or "sign" (their -y points to those who look at them).
        """
        if name == "robot":
            return self._robot_pose().vector
        if name in ("camera", "tof"):
            return self._camera_pose("front" if name == "camera" else name).vector
        if name in self.room.poses:
            return self.room.poses[name].copy()
        if name not in self.movers:
            known_names = ["robot", "camera", "tof", *self.movers, *self.room.poses]
            raise ValueError(f"no pose of {name!r}; there are {', '.join(known_names)}")
        return self._joint_poses()[name].vector

    def _joint_poses(self):
        if self._joints[0] != self._steps:
            self._joints = self._steps, self._movers.joint_poses(self.room.model.joint_tree)
        return self._joints[1]

    def _near(self, camera):
        """How many metres before a camera of the robot its images begin."""
        if self._look is not None:
            return NEAR
        x, y, _ = self._camera_pose(camera).position
        gaps = self.room.free_space.distance(x, y) - 0.04, *self._movers.gaps(self._wheels.place).values()
        return NEAREST if min(gaps) < NEAR else NEAR

    def _robot_pose(self):
        return Pose.planar(*self._wheels.place)

    def _camera_pose(self, camera):
        if camera == "front" and self._look is not None:
            return self._look
        return self._robot_pose() @ (TOF_MOUNT if camera == "tof" else CAMERA_MOUNT)

    def close(self) -> None:
        """Frees the images; the simulation cannot be used any more."""
        if not self._shares_scene:
            self._scene.close()

    def __exit__(self, *exception):
        self.close()


def _held_longer(held, place, linear, dt, reach):
    """(place, seconds, ways that were tried) after a step; a body beyond the reach in metres begins again."""
    old, seconds, tried = held
    way = math.hypot(place[0] - old[0], place[1] - old[1])
    if way > reach or abs(math.remainder(place[2] - old[2], 2 * math.pi)) > 0.3:
        old, seconds, tried = place, 0.0, frozenset()
    return old, round(seconds + dt, 9), tried | {np.sign(linear)}


def _is_stuck(held, longest):
    """Whether a body has been held for longer, and has tried to move both forwards and backwards."""
    _, seconds, tried = held
    return seconds > longest and {-1, 1} <= tried


def front_camera(size, lens=True):
    """The recorded drive's CameraModel for images of a size (width, height)."""
    model = CAMERA.resized(*size)
    return model if lens else CameraModel(*size, *model.matrix[[0, 1, 0, 1], [0, 1, 2, 2]].tolist())


def check_arguments(seed, time, size, lighting):
    if not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ValueError(f"seed is a whole number from 0 on, got {seed!r}")
    if not (math.isfinite(time) and 0 <= time <= 86400):
        raise ValueError(f"time is between 0 and 86400 seconds, got {time}")
    if lighting not in ("day", "evening"):
        raise ValueError(f'lighting is "day" or "evening", got {lighting!r}')
    check_size("size", size)


def check_size(name, size):
    width, height = size
    if not (160 <= width <= 1920 and width * 9 == height * 16):
        raise ValueError(
            f"{name} is (width, height), 16:9, 160 to 1920 pixels wide, such as (640, 360), got {size}"
        )


def checked_movers(movers, balls=()):
    """The names of those that take part, in the order of MOVERS; a ball whose way is given does."""
    if len(balls) > len(BALLS):
        raise ValueError(f"balls are at most {len(BALLS)}, got {len(balls)}")
    names = MOVERS if movers is True else movers or ()
    if isinstance(names, str) or not isinstance(names, Collection) or not set(names) <= set(MOVERS):
        raise ValueError(f"movers is True, False, or names of {', '.join(MOVERS)}, got {movers!r}")
    return tuple(dict.fromkeys([*(name for name in MOVERS if name in names), *BALLS[: len(balls)]]))


def checked_start(start):
    values = tuple(start)
    if len(values) != 3 or not all(math.isfinite(v) for v in values):
        raise ValueError(f"start is three finite numbers, x and y in metres and yaw in radians, got {start}")
    return tuple(round(float(v), 9) for v in values)
