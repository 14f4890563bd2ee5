"""The room as a Gymnasium environment: a controller gets observations, and the true metrics stay outside."""

import math
from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from ..extras import naming_extra
from .furnished import room_of
from .laser import RAYS
from .metrics import Metrics
from .movers import Movers
from .room import Room
from .room_map import draw_map
from .scene import Scene
from .simulation import Simulation, check_size, checked_movers
from .wheels import MAX_ANGULAR, MAX_LINEAR, TURNING, gap

with naming_extra():
    import gymnasium
    from gymnasium import spaces

STEP = 0.1  # seconds from one observation to the next
NO_RANGE = 10.0  # metres, in `scan`: the ray meets nothing. A Box is bounded, so it cannot be inf as in ROS
SENSORS = ("scan", "depth", "image", "odometry")
# A scenario: what `reset` takes as options, and what counts where one of them is left out.
OPTIONS: dict[str, Any] = {
    "room": None,
    "start": None,
    "time": 0.0,
    "lighting": "day",
    "movers": [],
    "duration": 40.0,
    "balls": [],
    "goal": None,
    "answer": None,
    "uneven": 0.0,
}
START_CLEARANCE = 0.45  # metres around the body at a start that is drawn
KEPT_ROOMS = 2  # so many rooms stay ready for the next drive: up to 220 MB each, if images are drawn


class RoomEnv(gymnasium.Env):
    """A robot in the room of the recorded drive, or in a furnished one, as an environment of Gymnasium::

        import gymnasium

        name = "imgproc_course.simulation.room_env:imgproc_course/Room-v0"
        env = gymnasium.make(name, sensors=("scan",))
        observation, info = env.reset(seed=1, options={"duration": 10.0})
        over = False
        while not over:
            ahead = min(observation["scan"][:20].min(), observation["scan"][-20:].min())
            action = (0.2, 0.0) if ahead > 0.6 else (0.0, 0.8)
            observation, reward, _, over, info = env.step(action)
        print(info["bumps"], info["distance"])

    An action is the linear (m/s) and the angular speed (rad/s) for the next 0.1 s. An observation is a dict:
    the sensors that were asked for, and "time", (1,) float64, the seconds since the start.

    - "scan": (360,) float32, metres, counterclockwise from straight ahead; 10.0 where the ray meets nothing
    - "depth": (height, width) uint16, millimetres, 0 where there is none
    - "image": (height, width, 3) uint8 BGR, of the front camera
    - "odometry": (3,) float64, x, y and yaw in the frame of the start, metres and radians

    `info` has the metrics of the drive; None: nothing was measured.

    - "bumps": how often the robot began to touch something; "bumped_into": what it touched first, or ""
    - "clearance": the least distance of its body to what stands still, while it moved, metres;
      "nearest_to": what that was, if nearer than 0.2 m, or ""; "low": if the laser scanner looks over it
    - "distance": driven, metres; "reach": the greatest distance from the start, metres
    - "places": number of cells of 0.5 m that the robot has been in; "time": seconds
    - "goal_time": seconds until the odometry said that the robot was in the goal
    - "home": distance from the start now, metres
    - "answer_error": from where the robot looks now to where the answer is, degrees
    - "ball_gap": of | distance from camera to ball - 0.6 m |, the mean after 5 s, metres; "ball_angle": from
      where the robot looks to where the ball is, the mean after 5 s, degrees
    - "remarks": {what the robot does: a sentence}, of what only the truth shows

    The reward of a step is the distance driven in it, less 1 for a bump. An episode is truncated after its
    duration, and never terminated. `reset` takes a *scenario* as options; all of its keys may be left out:

    - "room": a whole number, of a furnished room; else the room of the recorded drive
    - "start": (x, y, yaw) in the map; else it is drawn from the seed
    - "lighting": "day" or "evening"; "duration": seconds, else 40
    - "movers": those of "person", "toycar" and "ball" that take part, else none; "time": where they begin
    - "balls": at most three (x, y, dx, dy), as a Simulation has them; the first one is judged
    - "goal": (x, y, radius)
    - "answer": degrees to the left of the sign: there the robot is to look at the end
    - "uneven": one wheel is by this share larger than its odometry assumes, the other one smaller; else the
      sizes of both are wrong by about 1 %

    `path` has the true (x, y, yaw) at the start and after each step, `bump_places` (step, (x, y, yaw)) of the
    bumps.

    Parameters
    ----------
    sensors : some of "scan", "depth", "image" and "odometry"
    image_size, depth_size : (width, height) in pixels, of shape 16:9, 160 to 1920 wide
    render_mode : "rgb_array": what the camera sees, beside the map with the path; for wrappers that film

    Raises
    ------
    ValueError : other sensors or sizes; of `reset`: other options, or a start that is not free; of `step`: an
        action that is not two numbers
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": round(1 / STEP)}  # noqa: RUF012

    def __init__(
        self,
        sensors: Sequence[str] = ("scan", "depth"),
        *,
        image_size: tuple[int, int] = (320, 180),
        depth_size: tuple[int, int] = (160, 90),
        render_mode: str | None = None,
    ):
        if isinstance(sensors, str) or not set(sensors) <= set(SENSORS):
            raise ValueError(f"sensors are a tuple of some of {', '.join(SENSORS)}, got {sensors!r}")
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f'render_mode is None or "rgb_array", got {render_mode!r}')
        check_size("image_size", image_size)
        check_size("depth_size", depth_size)
        self.render_mode = render_mode
        self._image_size, self._depth_size = image_size, depth_size
        boxes: dict[str, spaces.Space] = {
            "scan": spaces.Box(0.0, NO_RANGE, (RAYS,), np.float32),
            "depth": spaces.Box(0, 65535, tuple(depth_size)[::-1], np.uint16),
            "image": spaces.Box(0, 255, (*tuple(image_size)[::-1], 3), np.uint8),
            "odometry": spaces.Box(
                np.array([-1e3, -1e3, -math.pi]), np.array([1e3, 1e3, math.pi]), dtype=np.float64
            ),
        }
        self._sensors = [name for name in SENSORS if name in sensors]
        boxes["time"] = spaces.Box(0.0, 86400.0, (1,), np.float64)
        self.observation_space = spaces.Dict({name: boxes[name] for name in (*self._sensors, "time")})
        high = np.array([MAX_LINEAR, MAX_ANGULAR])
        self.action_space = spaces.Box(-high, high, dtype=np.float64)
        self._scenes: dict[int | None, Scene] = {}
        self._simulation: Simulation | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, NDArray], dict[str, Any]]:
        """Begins a drive: the first observation, and `info`."""
        super().reset(seed=seed)
        scenario = read_options(options or {})
        self._simulation = None  # if this drive cannot begin, the one before is over all the same
        self._scene = self._scene_of(scenario["room"])
        self._simulation = self._begin(scenario)
        self._goal, self._balls, self._duration = (scenario[name] for name in ("goal", "balls", "duration"))
        self.path = [self._simulation.place]
        self.bump_places: list[tuple[int, tuple[float, float, float]]] = []
        self._metrics = Metrics(self._simulation, self._goal, scenario["answer"])
        return self._observation(0.0), self._metrics.info()

    def step(self, action: Sequence[float]) -> tuple[dict[str, NDArray], float, bool, bool, dict[str, Any]]:
        """Drives for 0.1 s: the observation after it, reward, False, whether it was the last one, `info`."""
        simulation = self._started()
        if np.shape(action) != (2,):
            raise ValueError(f"an action is two numbers, (linear, angular), got {action!r}")
        simulation.step(*map(float, action), STEP)
        self.path.append(simulation.place)
        number = len(self.path) - 1
        time = round(number * STEP, 9)
        metres, bumped = self._metrics.update(time)
        if bumped:
            self.bump_places.append((number, simulation.place))
        over = time > self._duration - 1e-9
        return self._observation(time), metres - bumped, False, over, self._metrics.info()

    def frame(self) -> NDArray[np.uint8]:
        """What the front camera sees now, (height, width, 3) uint8 BGR of `image_size`."""
        return self._started().frame()

    def render(self) -> NDArray[np.uint8] | None:
        """What the camera sees, beside the map with the path, (height, width, 3) uint8 RGB."""
        if self.render_mode is None:
            return None
        bumps = [(number, x, y) for number, (x, y, _) in self.bump_places]
        drawn = draw_map(self.path, bumps, room=self._scene.room, goal=self._goal, balls=self._balls)
        height = drawn.shape[0]
        width = 2 * round(height * 8 / 9)  # 16:9, and even: videos need even sizes
        frame = cv2.resize(self.frame(), (width, height), interpolation=cv2.INTER_LINEAR)
        return np.ascontiguousarray(np.hstack([frame, drawn])[..., ::-1], np.uint8)

    def close(self) -> None:
        """Frees the images; the next `reset` makes them again."""
        for scene in self._scenes.values():
            scene.close()
        self._scenes.clear()
        self._simulation = None

    @property
    def room(self) -> Room:
        """The Room of this drive; a controller must not see it."""
        self._started()
        return self._scene.room

    def _started(self):
        if self._simulation is None:
            raise gymnasium.error.ResetNeeded("the drive has not begun: call reset() first")
        return self._simulation

    def _scene_of(self, number):
        """The Scene of a room; the KEPT_ROOMS that were used last are kept."""
        scene = self._scenes.pop(number, None) or Scene(room_of(number))
        self._scenes[number] = scene
        if len(self._scenes) > KEPT_ROOMS:
            self._scenes.pop(next(iter(self._scenes))).close()
        return scene

    def _begin(self, scenario):
        seed = int(self.np_random.integers(1 << 31))
        size, depth_size = self._image_size, self._depth_size
        options = {
            name: scenario[name] for name in ("start", "movers", "balls", "time", "lighting", "uneven")
        }
        if options["start"] is None:
            options["start"] = self._draw_start(scenario)
        return Simulation(seed, room=self._scene, size=size, depth_size=depth_size, **options)

    def _draw_start(self, scenario):
        """(x, y, yaw) with START_CLEARANCE around the body, in the part of the room where its start is."""
        room = self._scene.room
        movers = Movers(scenario["time"], room, checked_movers(scenario["movers"]), scenario["balls"])
        cells = reachable_cells(room)
        for _ in range(1000):
            x, y = cells[self.np_random.integers(len(cells))].tolist()
            start = x, y, float(self.np_random.uniform(-math.pi, math.pi))
            gaps = [gap(room.free_space.distance, *start), *movers.gaps(start).values()]
            if min(gaps) > START_CLEARANCE:
                return start
        raise ValueError(f"room {room.name} has no start with {START_CLEARANCE} m around it; choose one")

    def _observation(self, time):
        simulation, observation = self._started(), {}
        for name in self._sensors:
            if name == "scan":
                ranges = simulation.scan().ranges
                observation[name] = np.where(np.isinf(ranges), np.float32(NO_RANGE), ranges)
            elif name == "odometry":
                observation[name] = np.array(simulation.odometry()[:3])
            else:
                observation[name] = simulation.depth() if name == "depth" else simulation.frame()
        return observation | {"time": np.array([time])}


def controller_observation(observation):
    """An observation as a learner's `control` gets it: inf in the scan, as in ROS, and time as a float."""
    given = dict(observation)
    if "scan" in given:
        scan = given["scan"]
        given["scan"] = np.where(scan >= NO_RANGE, np.float32(np.inf), scan)
    return given | {"time": float(given["time"][0])}


def reachable_cells(room: Room) -> NDArray[np.float64]:
    """Places (N, 2) of the axle with room around, in metres, that the robot can reach from its start."""
    space = room.free_space
    _, parts = cv2.connectedComponents((space.metres > TURNING).astype(np.uint8))
    x, y, _ = room.start
    col, row = (int((value - low) / space.cell) for value, low in zip((x, y), space.origin, strict=True))
    rows, cols = np.nonzero((parts == parts[row, col]) & (space.metres > START_CLEARANCE))
    first = np.array(space.origin) + space.cell / 2
    return np.column_stack([cols, rows]).astype(float) * space.cell + first


def read_options(options):
    """A whole scenario, with what `options` of it says; ValueError says what is wrong."""
    unknown = [name for name in options if name not in OPTIONS]
    if unknown:
        raise ValueError(f"unknown option {unknown[0]!r}; expected some of {', '.join(OPTIONS)}")
    scenario = OPTIONS | options
    duration = scenario["duration"]
    if not (math.isfinite(duration) and duration >= STEP):
        raise ValueError(f"duration is {STEP} seconds or more, got {duration}")
    goal = scenario["goal"]
    if goal is not None and not (len(goal) == 3 and np.isfinite(goal).all() and goal[2] > 0):
        raise ValueError(f"goal is (x, y, radius) in metres, got {goal}")
    return scenario


gymnasium.register("imgproc_course/Room-v0", entry_point="imgproc_course.simulation.room_env:RoomEnv")
