"""An environment with the interface of `RoomEnv`: a robot, a point, in an empty square of 4 m."""

import math
from types import SimpleNamespace

import numpy as np

HALF, NEAR = 2.0, 0.1  # metres from the middle to a wall; how near the point may come
ANGLES = np.radians(np.arange(360))


class TinyRoom:
    """A scan of four walls; it ignores what it does not have, such as movers."""

    made = 0  # how many were made in this process

    def __init__(self, sensors=("scan",)):
        TinyRoom.made += 1
        self._sensors = sensors
        self.unwrapped = self
        self.action_space = SimpleNamespace(low=np.array([-0.3, -1.57]), high=np.array([0.3, 1.57]))

    def reset(self, *, seed=None, options=None):
        start = (options or {}).get("start") or [0.0, 0.0, float(np.random.default_rng(seed).uniform(-3, 3))]
        self.path, self.bump_places, self._touches, self._clearance = [tuple(start)], [], False, None
        return self._observation(), self._info()

    def step(self, action):
        x, y, yaw = self.path[-1]
        linear, angular = map(float, action)
        new_x, new_y = x + 0.1 * linear * math.cos(yaw), y + 0.1 * linear * math.sin(yaw)
        touches = max(abs(new_x), abs(new_y)) > HALF - NEAR
        x, y = (x, y) if touches else (new_x, new_y)
        self.path.append((x, y, yaw + 0.1 * angular))
        if touches and not self._touches:
            self.bump_places.append((len(self.path) - 1, self.path[-1]))
        self._touches = touches
        clearance = 0.0 if touches else round(HALF - NEAR - max(abs(x), abs(y)), 4)
        self._clearance = clearance if self._clearance is None else min(clearance, self._clearance)
        return self._observation(), 0.0, False, False, self._info()

    def _observation(self):
        x, y, yaw = self.path[-1]
        c, s = np.cos(ANGLES + yaw), np.sin(ANGLES + yaw)
        with np.errstate(divide="ignore"):
            ranges = np.minimum((np.sign(c) * HALF - x) / c, (np.sign(s) * HALF - y) / s)
        ranges[ranges > 3.0] = np.inf
        values = {"scan": ranges.astype(np.float32), "depth": np.full((90, 160), 7, np.uint16)}
        observation = {name: values[name] for name in self._sensors}
        return observation | {"time": round(0.1 * (len(self.path) - 1), 9)}

    def _info(self):
        steps = np.diff(np.array(self.path)[:, :2], axis=0)
        away = np.array(self.path)[:, :2] - self.path[0][:2]
        return {
            "bumps": len(self.bump_places),
            "clearance": self._clearance,
            "distance": round(float(np.hypot(*steps.T).sum()), 3),
            "reach": round(float(np.hypot(*away.T).max()), 3),
            "places": len({(math.floor(2 * x), math.floor(2 * y)) for x, y, _ in self.path}),
            "time": round(0.1 * (len(self.path) - 1), 1),
            "goal_time": None,
            "ball_gap": None,
            "bumped_into": "wall" if self.bump_places else "",
        }


class BrokenRoom(TinyRoom):
    """It fails in the middle of a drive."""

    def step(self, action):
        if len(self.path) > 5:
            raise ValueError("the room is broken")
        return super().step(action)


def controller_observation(observation):
    return observation
