"""A scenario: what a case of an exercise that drives gives, a dict, read and checked.

Thresholds judge the drive, such as {"bumps": ["<=", 0], "clearance": [">=", 0.25]}.
"""

import json
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from nbclassroom.exercises.kinds.drive.drive import METRICS

_Number = Annotated[int, Meta(ge=0)]
_Metric: Any = Literal[tuple(METRICS)]  # made of data: no type that can be checked before it runs
_NEEDED = {"goal_time": "goal", "answer_error": "answer", "ball_gap": "balls", "ball_angle": "balls"}


class _Scenario(msgspec.Struct, forbid_unknown_fields=True):
    seed: _Number
    title: Annotated[str, Meta(pattern=r"\S")]
    thresholds: Annotated[dict[_Metric, tuple[Literal["<=", ">="], float]], Meta(min_length=1)]
    room: _Number | None = None
    start: tuple[float, float, float] | None = None
    time: Annotated[float, Meta(ge=0)] = 0.0
    lighting: Literal["day", "evening"] = "day"
    movers: list[Literal["person", "toycar", "ball"]] = []
    duration: Annotated[float, Meta(ge=0.1, le=120)] = 40.0
    balls: list[tuple[float, float, float, float]] = []
    goal: tuple[float, float, float] | None = None
    answer: float | None = None
    uneven: Annotated[float, Meta(gt=0, le=0.1)] | msgspec.UnsetType = msgspec.UNSET


def read_scenario(value):
    """A scenario as plain data, with what it leaves out; ValueError says what is wrong with it."""
    try:
        plain = json.loads(json.dumps(value, allow_nan=False, default=lambda array: array.tolist()))
        scenario = msgspec.to_builtins(msgspec.convert(plain, _Scenario))
    except (TypeError, ValueError, AttributeError) as error:
        raise ValueError(f"a scenario is wrong: {error}; got {value!r}"[:1000]) from error
    for metric, needed in _NEEDED.items():
        if metric in scenario["thresholds"] and scenario[needed] in (None, []):
            raise ValueError(f"a threshold of {metric} needs {needed!r} in the scenario, got none")
    return json.loads(json.dumps(scenario))
