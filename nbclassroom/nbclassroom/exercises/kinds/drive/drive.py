"""A drive: a scenario in which a learner's `control` drives the robot, and what the robot did, as plain data.

`check` and grading use it: `Drive` where the environment is, `Cost` where the learner's code is. A scenario
is a dict, see `scenario`; what a drive gives is the dict of `Drive.record`.
"""

import contextlib
import math
import numbers
import os
import re
import reprlib
import time
from dataclasses import dataclass
from functools import lru_cache
from operator import ge, le
from pathlib import Path

import numpy as np

from nbclassroom import course

STEP = 0.1  # seconds from one observation to the next
STEP_SECONDS = 0.5  # how long one call of `control` may take
MEAN_STEP_SECONDS = 0.05  # of processor time, how long it may take on average of a whole drive
_MOST_SLOW = 20  # steps that take longer than they may while the drive does so on average
_MOST_MEMORY = 1_000_000_000  # bytes by which this process may grow
SLOW = f"takes longer than {MEAN_STEP_SECONDS} s for a step on average: do less in each call, do not sleep"
SLOW += ", or keep results in memory"
LARGE = "takes more than 1 GB of memory: keep only what later steps need"
SENSORS = ("scan", "depth", "image", "odometry")
DURATION = 40.0  # seconds, of a scenario that does not say it
_ADDRESS = re.compile(r"0x[0-9a-fA-F]{6,}")
_REPR = reprlib.Repr()
_REPR.maxother = 80  # characters: an address is not cut
COUNTS = {"<=": ("≤", "at most", le), ">=": ("≥", "at least", ge)}
_EXPECTED = "expected two numbers, (linear, angular)"


@dataclass(frozen=True)
class _Metric:
    """How texts name a metric, its format, and a sentence about its value."""

    title: str
    format: str
    sentence: str


METRICS = {
    "bumps": _Metric("bumps", "{:.0f}", "The robot bumped {} times"),
    "clearance": _Metric("clearance", "{:.2f} m", "The robot came as near as {}"),
    "distance": _Metric("distance driven", "{:.2f} m", "The robot drove {}"),
    "reach": _Metric("reach", "{:.2f} m", "The robot got {} away from its start"),
    "places": _Metric("places", "{:.0f}", "The places that the robot came to (cells of 0.5 m): {}"),
    "time": _Metric("time", "{:.1f} s", "The robot drove for {}"),
    "goal_time": _Metric("time to the goal", "{:.1f} s", "The robot reached the goal after {}"),
    "home": _Metric(
        "from the start, at the end", "{:.2f} m", "At the end, the robot was {} away from its start"
    ),
    "answer_error": _Metric(
        "error of the answer", "{:.0f}°", "At the end, the robot looked {} beside the right answer"
    ),
    "ball_gap": _Metric(
        "error of the distance", "{:.2f} m", "The robot's distance to the ball was wrong by {}"
    ),
    "ball_angle": _Metric(
        "ball beside the middle", "{:.0f}°", "The robot looked {} past the ball, on average"
    ),
}


def metric_text(name, value, limit=None):
    """A metric with its unit; with more digits where it would look like a limit, and is not."""
    if value is None:
        return "–"
    shape = METRICS[name].format
    while limit not in (None, value) and shape.format(value) == shape.format(limit):
        shape = re.sub(r"\d+", lambda digits: str(int(digits[0]) + 1), shape)
    return shape.format(value)


@lru_cache(maxsize=2)
def environment(sensors):
    """This process's environment for these sensors: the next drive in it begins at once."""
    return course.load(course.drive_environment)(sensors)


class Drive:
    """One drive, step after step, in an environment as `course.drive_environment` makes it.

    scenario     the dict
    observation  what `control` gets next, {name: array, or float for "time"}
    layout       [name, dtype, shape] of each of its values
    over         whether the drive is at its end; then `act` and `stop` do nothing
    """

    def __init__(self, env, scenario):
        self._env, self.scenario = env, scenario
        self._ended, self._actions, self._decisive = "", [], 0
        names = scenario.keys() - {"seed", "title", "thresholds"}
        self._read(*env.reset(seed=scenario["seed"], options={name: scenario[name] for name in names}))
        arrays = {name: np.asarray(value) for name, value in self.observation.items()}
        self.layout = [[name, array.dtype.str, list(array.shape)] for name, array in arrays.items()]

    @property
    def steps(self):
        return len(self._actions)

    @property
    def over(self):
        return bool(self._ended) or self.steps >= steps_of(self.scenario)

    def act(self, value):
        """Drive until the next step with what `control` returned: linear (m/s) and angular speed (rad/s)."""
        if self.over:
            return
        try:
            speeds = speeds_of(value)
        except ValueError as error:
            self.stop(str(error))
            return
        limits = self._env.action_space
        action = np.clip(np.array(speeds), limits.low.astype(float), limits.high.astype(float))
        self._actions.append(speeds)
        observation, _, _, _, info = self._env.step(action)
        self._read(observation, info)

    def stop(self, reason):
        """End the drive before its time, for a reason in one sentence."""
        if not self.over:
            self._ended = reason

    def record(self):
        """What the robot did, as data of JSON.

        metrics   the environment's `info`
        ended     why the drive ended before its time, "" if it did not
        steps     how many actions were driven
        path      [x, y, yaw] at the start and after each action, metres and radians
        bumps     [step, x, y] of each bump
        missed    [metric, value, operator, limit] of each threshold that is not kept
        decisive  the step of the `decisive_moment`
        actions   [linear, angular] of each step, as `control` returned them
        limits    the largest [linear, angular] of the robot
        """
        env = self._env.unwrapped
        record = {
            "metrics": dict(self._info),
            "ended": self._ended,
            "steps": self.steps,
            "path": [[round(float(value), 4) for value in place] for place in env.path],
            "bumps": [
                [int(step), round(float(x), 4), round(float(y), 4)] for step, (x, y, *_) in env.bump_places
            ],
            "missed": [
                [name, value, operator, limit]
                for name, (operator, limit) in self.scenario["thresholds"].items()
                if (value := self._info[name]) is None or not COUNTS[operator][2](value, limit)
            ],
            "actions": [list(speeds) for speeds in self._actions],
            "limits": [round(float(most), 4) for most in self._env.action_space.high],
        }
        steps = {"the nearest place": self._decisive, "the end": self.steps}
        step = steps.get(decisive_moment(record))
        return record | {"decisive": int(env.bump_places[0][0] if step is None else step)}

    def _read(self, observation, info):
        is_nearer = self._actions and info["clearance"] != self._info["clearance"]
        self._decisive = self.steps if is_nearer else self._decisive
        self._info: dict = info
        self.observation: dict = course.load(course.drive_observation)(observation)


class Cost:
    """What the calls of a controller have cost in one drive; it is made before the first drive."""

    def __init__(self):
        self._memory, self._calls, self._seconds, self._slow_calls = _memory(), 0, 0.0, 0

    @contextlib.contextmanager
    def of_call(self):
        """Add the call that is made meanwhile, if it returns."""
        began = _own_seconds()
        yield
        seconds = _own_seconds() - began
        self._calls += 1
        self._seconds += seconds
        self._slow_calls += seconds > MEAN_STEP_SECONDS < self._seconds / self._calls

    def excess(self, most_seconds=math.inf):
        """Why no further call is made, LARGE or SLOW; "" if one is."""
        if _memory() - self._memory > _MOST_MEMORY:
            return LARGE
        return SLOW if self._slow_calls >= _MOST_SLOW or self._seconds > most_seconds else ""


def _own_seconds():
    """A clock that stands still while this thread waits for a processor; seconds."""
    try:
        now = waited = math.nan
        while waited != (waited := int(Path("/proc/thread-self/schedstat").read_text().split()[1])):
            now = time.monotonic()  # between two reads that agree
        return now - waited / 1e9
    except (OSError, IndexError):
        return time.thread_time()


def _memory():
    """The memory of this process, bytes; 0 if the system does not say it."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0


def decisive_moment(record):
    """What texts call the moment of a drive that is shown: "the bump", "the nearest place" or "the end"."""
    missed = {name for name, *_ in record["missed"]}
    if record["bumps"]:
        return "the bump"
    return "the end" if missed and "clearance" not in missed else "the nearest place"


def steps_of(scenario):
    """How many steps a whole drive has."""
    return round(scenario.get("duration", DURATION) / STEP)


def seconds_of(scenario):
    """Processor time that a controller has for a whole drive, seconds."""
    return MEAN_STEP_SECONDS * steps_of(scenario)


def passes(record, scenario):
    """Whether a drive gives the points of its case."""
    return not record["ended"] and not record["missed"] and record["steps"] == steps_of(scenario)


def speeds_of(value):
    """The two speeds that `control` returned, as floats; ValueError: it returned something else."""
    is_sequence = isinstance(value, (tuple, list, np.ndarray)) and np.ndim(value) != 0
    numbers_only = is_sequence and all(isinstance(speed, numbers.Real) for speed in value)
    if not numbers_only or len(value) != 2:
        raise ValueError(f"control returned {_text_of(value)}: {_EXPECTED}")
    try:
        speeds = tuple(map(float, value))
    except OverflowError:
        speeds = (math.inf, math.inf)
    if not all(map(math.isfinite, speeds)):
        raise ValueError(f"control returned {_text_of(value)}: {_EXPECTED}, neither nan nor inf")
    return speeds


def _text_of(value):
    """A returned value in a line, without addresses, which differ from run to run."""
    return _ADDRESS.sub("0x…", " ".join(_REPR.repr(value).split()))
