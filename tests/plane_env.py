"""An environment like the room's, and quick: a robot on a plane with a wall across its way."""

import contextlib
import math
import re
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np

LOOK, BODY = 0.1, 0.2
KEYS = ("goal_time", "ball_gap", "ball_angle")


class PlaneEnv:
    """The wall is at x = 2 m, or where the scenario's room says, in decimetres; the robot starts at x = 0."""

    action_space = SimpleNamespace(low=np.float32([-0.3, -1.57]), high=np.float32([0.3, 1.57]))

    def __init__(self, sensors=("scan",)):
        self.sensors = sensors
        print("A library prints when it starts.", flush=True)

    @property
    def unwrapped(self):
        return self

    def reset(self, *, seed=None, options=None):
        options = options or {}
        self.seed, self.options = seed, options
        self.wall = (options.get("room") or 20) / 10
        self.path = [tuple(options.get("start") or (0.0, 0.0, 0.0))]
        self.bump_places, self._clearance, self._touches = [], None, False
        return self._observation(), self._info()

    def step(self, action):
        (x, y, yaw), (linear, angular) = self.path[-1], map(float, action)
        yaw += angular * LOOK
        x, y = x + linear * LOOK * math.cos(yaw), y + linear * LOOK * math.sin(yaw)
        touches = x > self.wall - BODY
        x = min(x, self.wall - BODY)
        self.path.append((x, y, yaw))
        if touches and not self._touches:
            self.bump_places.append((len(self.path) - 1, self.path[-1]))
        self._touches = touches
        if linear:
            self._clearance = min(
                self.wall - BODY - x, math.inf if self._clearance is None else self._clearance
            )
        return self._observation(), 0.0, False, False, self._info()

    def frame(self):
        return np.full((18, 32, 3), len(self.path) % 250, np.uint8)

    def _observation(self):
        x, y, yaw = self.path[-1]
        distance = (self.wall - x) / math.cos(yaw) if math.cos(yaw) > 1e-9 else 10.0
        values = {
            "scan": np.full(360, min(distance, 10.0), np.float32),
            "odometry": np.array([x, y, yaw]),
            "time": np.array([(len(self.path) - 1) * LOOK]),
        }
        return {name: value for name, value in values.items() if name in self.sensors or name == "time"}

    def _info(self):
        start, places = self.path[0], np.array(self.path)
        steps = np.hypot(*np.diff(places[:, :2], axis=0).T) if len(places) > 1 else np.zeros(1)
        return {
            "bumps": len(self.bump_places),
            "clearance": None if self._clearance is None else round(self._clearance, 4),
            "distance": round(float(steps.sum()), 4),
            "reach": round(float(np.hypot(*(places[:, :2] - start[:2]).T).max()), 4),
            "places": len({(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in self.path}),
            "time": round((len(self.path) - 1) * LOOK, 3),
            "bumped_into": "wall" if self.bump_places else "",
            "nearest_to": "wall",
        } | dict.fromkeys(KEYS)


def controller_observation(observation):
    values = dict(observation) | {"time": float(observation["time"][0])}
    if "scan" in values:
        values["scan"] = np.where(values["scan"] < 10, values["scan"], np.float32(np.inf))
    return values


def room_of(number):
    return number or 20


def draw_map(path, bumps=(), *, room=None, goal=None, balls=(), mark=None):
    """Columns: one for each look of the path, white up to the mark, else gray."""
    image = np.full((20, len(path), 3), 128, np.uint8)
    if mark:
        image[:, : [list(place) for place in path].index(list(mark)) + 1] = 255
    return image


# ---------------------------------------------------------------- an exercise that drives there


@contextlib.contextmanager
def driving_on_a_plane(environment="plane_env:PlaneEnv"):
    """Exercises that drive use this environment."""
    import pytest  # here, because kernels import this module
    from nbclassroom.exercises.kinds.drive.drive import environment as cached_environment

    try:
        with pytest.MonkeyPatch.context() as patch, course_on_a_plane(environment) as variables:
            for name, value in variables.items():
                patch.setenv(name, value)
            cached_environment.cache_clear()
            yield
    finally:
        cached_environment.cache_clear()


@contextlib.contextmanager
def course_on_a_plane(environment="plane_env:PlaneEnv"):
    """The environment variables of a course like this one, whose drives are in another environment."""
    places = {"environment": environment, "observation": "plane_env:controller_observation"}
    places |= {"room": "plane_env:room_of", "map": "plane_env:draw_map"}
    text = (TESTS.parent / "notebooks" / "course.toml").read_text(encoding="utf-8")
    for name, place in places.items():
        text = re.sub(rf"^drive_{name} = .*$", f'drive_{name} = "{place}"', text, flags=re.M)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "course.toml"
        path.write_text(text, encoding="utf-8")
        yield {"NBCLASSROOM_COURSE": str(path), "PYTHONPATH": str(TESTS)}


TESTS = Path(__file__).parent
BLIND = "def control(observation, memory):\n    return 0.3, 0.0\n"
STOPS = """def control(observation, memory):
    return (0.3 if observation["scan"][0] > {} else 0.0), 0.0
"""
RIGHT, LATE = STOPS.format(0.6), STOPS.format(0.3)
HINTS = 'hints=("a", "b", "c"), explanation="e", another_way="w"'
PARTS = {
    "given": "# %%\nimport numpy as np",
    "exercise": (
        '# %% role="exercise"\nexercise("test-drive", function="control", subject="drive",'
        f' sensors=("scan", "odometry"), hint="Look ahead.", {HINTS})\n'
        'LIMITS = {"bumps": ["<=", 0], "clearance": [">=", 0.25], "reach": [">=", 0.5]}\n'
        "def scenario(room):\n"
        '    return {"seed": 1, "room": room, "duration": 6.0, "thresholds": LIMITS}'
    ),
    "answer": f'# %% role="answer"\n{BLIND}',
    "solution": f'# %% role="solution"\n{RIGHT}',
    "check": '# %% role="check"\ncheck("test-drive", control)',
    "case": '# %% role="case" title="near" points=2\ndef inputs(rng):\n    return (scenario(12),)',
    "second": '# %% role="case" title="far"\ndef inputs(rng):\n    return [(scenario(16),)]',
    "third": '# %% role="case" title="nearest"\ndef inputs(rng):\n    return (scenario(11),)',
    "hidden": (
        '# %% role="hidden" title="any" points=3\ndef inputs(rng):\n'
        "    return (scenario(rng.integers(9, 99)),)"
    ),
    "mistake": f'# %% role="mistake" name="it comes too near" says="It brakes too late."\n{LATE}',
    "second mistake": (
        '# %% role="mistake" name="it is slow" says="It is too slow."\n'
        "def control(observation, memory):\n    return 0.05, 0.0"
    ),
}
