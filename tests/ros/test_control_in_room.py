"""The node of the lesson on obstacles: the same `control` drives the robot in ROS as in RoomEnv."""

import math
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

START = (3.6, 0.6, -2.6)
GOAL = (START[0] + 2.2 * math.cos(START[2]), START[1] + 2.2 * math.sin(START[2]), 0.6)
SCENARIO = {"room": 17, "start": START, "goal": GOAL, "duration": 12.0}
NEARER = (*GOAL[:2], 1.6)  # a whole drive in real time is a benchmark: a busy machine is too slow for it
LONGEST = 150  # seconds in the room


def test_the_lessons_node_sets_out_for_the_goal_as_in_the_environment(session, monkeypatch):
    monkeypatch.syspath_prepend(Path(__file__).parent)
    from control_in_room import drive_in_env, drive_in_ros, farthest, is_in

    path, info = drive_in_env(SCENARIO)
    assert info["bumps"] == 0 and info["goal_time"] is not None
    places, bumps = drive_in_ros(
        session, SCENARIO, lambda room: is_in(NEARER, room.place) or room.time > LONGEST
    )
    assert bumps == 0 and math.dist(places[-1][:2], GOAL[:2]) < NEARER[2] + 0.1
    assert farthest(places, path) < 0.5
