"""Ten rooms to explore, and what a drive through one of them is worth."""

import math
from typing import Any

from ..geometry import compose_poses
from .metrics import cell_of
from .room_env import STEP, RoomEnv, reachable_cells

ROOMS = tuple(range(31, 41))  # furnished rooms, by their numbers
DURATION = 60.0  # seconds
NEAR = 0.3  # metres: so far from the truth, the place of a marker is still right
FOR_MARKER, FOR_WORD, FOR_BUMP = 10, 20, -5  # points


def scenario_of(room: int, seed: int) -> dict[str, Any]:
    """The scenario of a RoomEnv that explores a furnished room; the start is drawn from the seed."""
    return {"seed": seed, "room": room, "start": None, "lighting": "day", "movers": [], "duration": DURATION}


def exploration_score(env: RoomEnv, found: Any) -> dict[str, Any]:
    """What a robot has reached in its drive, and the score::

        score = 100 * coverage + 10 * markers + 20 * word - 5 * bumps, at least 0, rounded to whole points

    Parameters
    ----------
    env : after the drive
    found : {"markers": {number: (x, y)}, "word": "TEXT"}, metres in the frame of the odometry, which begins
        at (0, 0, 0); what is missing or has another form was not found

    Returns
    -------
    dict
        "coverage" : of the cells of 0.5 m that the robot can reach, the share in which it was, 0 to 1
        "markers" : number of markers whose place is right within 0.3 m, 0 to 2
        "word" : 1 if it is the word of the room's sign, else 0
        "bumps" : how often the robot began to touch something; "time" : of the drive, seconds
        "score" : points
    """
    found = found if isinstance(found, dict) else {}
    word = found.get("word")
    cells = {cell_of(place) for place in reachable_cells(env.room).tolist()}
    values: dict[str, Any] = {
        "coverage": round(len(cells & {cell_of(place) for place in env.path}) / len(cells), 4),
        "markers": _count_markers(env, found.get("markers")),
        "word": int(isinstance(word, str) and word.strip().upper() == env.room.word),
        "bumps": len(env.bump_places),
        "time": round((len(env.path) - 1) * STEP, 1),
    }
    for_found = FOR_MARKER * values["markers"] + FOR_WORD * values["word"]
    points = 100 * values["coverage"] + for_found + FOR_BUMP * values["bumps"]
    return values | {"score": max(0, round(points))}


def _count_markers(env, markers):
    if not isinstance(markers, dict):
        return 0
    count = 0
    for name, number in env.room.markers.items():
        place = _in_map(env.path[0], markers.get(number))
        count += place is not None and math.dist(place, env.room.poses[name][:2].tolist()) <= NEAR
    return count


def _in_map(start, point):
    """A point (x, y) of the odometry's frame in the map; None if it is not two numbers."""
    try:
        forward, left = (float(value) for value in point)
    except (TypeError, ValueError, OverflowError):
        return None
    return compose_poses(start, (forward, left, 0.0))[:2].tolist()
