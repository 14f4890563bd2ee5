"""What a robot's drive is judged by: bumps, clearance, ways and times, from the truth."""

import math
from statistics import fmean
from typing import Any

from ..geometry import compose_poses
from .room_model import BALLS

BALL_DISTANCE, BALL_AFTER = 0.6, 5.0  # metres from the camera to the ball's center, seconds
PLACE = 0.5  # metres: the size of the cells that `places` counts
NEAR = 0.2  # metres: what is nearer gets its name
MOVING = 0.02  # m/s: who is slower stands, and is not judged by what is near
LOW = ("building blocks", "slippers")  # what the laser scanner does not see
BESIDE, TURNS = (5.0, 90.0), 0.1  # degrees, rad/s: a ball that is not in the middle, and a robot that turns
LOOKS = 20.0, 30.0  # degrees on average: a robot that looks at a ball, and one that does not


class Metrics:
    """Counts, step after step, what the robot of a Simulation does."""

    def __init__(self, simulation, goal=None, answer=None):
        self._simulation, self._goal, self._answer = simulation, goal, answer
        self._place, self._touching = simulation.place, False
        self._start, self._places = self._place, {cell_of(self._place)}
        self._gaps: list[float] = []  # to the ball, and degrees from where the robot looks to each ball
        self._angles: list[list[float]] = []
        self._turns: list[bool] = []  # whether it turned away from the ball, where it turned
        self._values: dict[str, Any] = {"bumps": 0, "places": 1, "answer_error": self._error_of_answer}
        self._values |= dict.fromkeys(("distance", "reach", "time", "home"), 0.0)
        self._values |= dict.fromkeys(("clearance", "goal_time", "ball_gap", "ball_angle"))
        self._values |= dict.fromkeys(("bumped_into", "nearest_to"), "")

    def update(self, time):
        """After a step, `time` seconds after the start: (metres driven in it, whether a bump began)."""
        before, place = self._place, self._simulation.place
        self._place, values = place, self._values
        metres = math.dist(before[:2], place[:2])
        self._places.add(cell_of(place))
        values["time"], values["places"] = time, len(self._places)
        values["distance"] += metres
        values["home"] = math.dist(self._start[:2], place[:2])
        values["reach"] = max(values["reach"], values["home"])
        values["answer_error"] = self._error_of_answer
        if values["goal_time"] is None and self._goal is not None:
            x, y, _ = compose_poses(self._start, self._simulation.odometry()[:3])
            if math.dist((x, y), self._goal[:2]) < self._goal[2]:
                values["goal_time"] = time
        self._note_ball(time)
        return metres, self._note_contact()

    @property
    def _error_of_answer(self):
        """Degrees from where the robot looks to where it would look for the right answer."""
        if self._answer is None:
            return None
        x, y, yaw = self._place
        sign_x, sign_y = self._simulation.pose("sign")[:2]
        right = math.atan2(sign_y - y, sign_x - x) + math.radians(self._answer)
        return abs(math.degrees(math.remainder(yaw - right, 2 * math.pi)))

    def _note_contact(self):
        bumped = self._simulation.bumped
        began, self._touching = bumped and not self._touching, bumped
        if began:
            self._values["bumps"] += 1
            self._values["bumped_into"] = self._values["bumped_into"] or self._simulation.nearest_thing()
        if bumped or abs(self._simulation.speeds[0]) > MOVING:
            clearance = max(0.0, self._simulation.gaps()[""])
            known = self._values["clearance"]
            if known is None or clearance < known:
                self._values["clearance"] = clearance
                near = clearance < NEAR
                self._values["nearest_to"] = self._simulation.thing_at(self._place) if near else ""
        return began

    def _note_ball(self, time):
        names = [name for name in BALLS if name in self._simulation.movers]
        ways = [self._simulation.pose(name)[:2] - self._simulation.pose("camera")[:2] for name in names]
        yaws = [math.atan2(left, ahead) - self._place[2] for ahead, left in ways]
        sides = [math.degrees(math.remainder(yaw, 2 * math.pi)) for yaw in yaws]
        speed = self._simulation.speeds[1]
        if sides and BESIDE[0] < abs(sides[0]) < BESIDE[1] and abs(speed) > TURNS:
            self._turns.append(sides[0] * speed < 0)
        if sides and time > BALL_AFTER:
            self._gaps.append(math.hypot(*ways[0]) - BALL_DISTANCE)
            self._angles.append(list(map(abs, sides)))
            self._values["ball_gap"] = fmean(map(abs, self._gaps))
            self._values["ball_angle"] = fmean(angles[0] for angles in self._angles)

    def _remarks(self):
        """{behaviour: a sentence}, of what only the truth shows."""
        remarks, angles = {}, [fmean(own) for own in zip(*self._angles, strict=True)] or [180.0]
        seen = angles.index(min(angles))
        if self._turns and angles[seen] < LOOKS[0] < LOOKS[1] < angles[0]:
            remarks["another ball"] = (
                f"It looked at the {BALLS[seen]}: {angles[seen]:.0f}° past it, on average."
            )
        elif len(self._turns) > 2 and all(self._turns[:3]):
            remarks["it turns away from the ball"] = "When it began to turn, it turned away from the ball."
        gap, follows = fmean(self._gaps or [0.0]), self._values["distance"] > BALL_DISTANCE
        if self._values["bumped_into"] == BALLS[0]:
            remarks["it is too near"] = ""
        elif follows and angles[0] < LOOKS[1] and abs(gap) > BALL_DISTANCE / 4:
            text = "too far away" if gap > 0 else "too near"
            remarks[f"it is {text}"] = f"On average it was {abs(gap):.2f} m {text}."
        return remarks

    def info(self):
        """All metrics, rounded to 1e-4, as RoomEnv names them."""
        low = (self._values["bumped_into"] or self._values["nearest_to"]) in LOW
        values = (self._values | {"low": low, "remarks": self._remarks()}).items()
        return {name: round(value, 4) if isinstance(value, float) else value for name, value in values}


def cell_of(place):
    return math.floor(place[0] / PLACE), math.floor(place[1] / PLACE)
