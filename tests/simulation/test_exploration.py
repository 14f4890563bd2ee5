"""Exploring: which cells count, what is found, and the score."""

import math

import numpy as np
import pytest

from imgproc_course.simulation import furnished
from imgproc_course.simulation.exploration import DURATION, ROOMS, exploration_score, scenario_of
from imgproc_course.simulation.room_env import RoomEnv, reachable_cells


@pytest.fixture(scope="module")
def env():
    made = RoomEnv(())
    yield made
    made.close()


def begin(env, room=31, seed=5):
    scenario = scenario_of(room, seed)
    env.reset(seed=scenario.pop("seed"), options=scenario)


def cells_to_reach(room):
    return {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y in reachable_cells(room).tolist()}


def in_odometry(env, name):
    """Where a marker is, in the frame of the robot's start."""
    (x, y, yaw), (u, v) = env.path[0], env.room.poses[name][:2].tolist()
    turn = np.exp(-1j * yaw) * complex(u - x, v - y)
    return float(turn.real), float(turn.imag)


def test_a_scenario_is_the_option_of_an_environment(env):
    assert len(set(ROOMS)) == 10 and scenario_of(33, 2) == {
        **{"seed": 2, "room": 33, "start": None, "lighting": "day", "movers": [], "duration": DURATION}
    }
    begin(env, 33, 2)
    first = env.path[0]
    begin(env, 33, 3)
    assert env.room.name == "room 33" and env.path[0] != first
    begin(env, 33, 2)
    assert env.path[0] == first


@pytest.mark.parametrize("number", ROOMS)
def test_the_cells_of_a_room_have_free_floor_and_hold_its_start(number):
    room = furnished(number)
    cells = cells_to_reach(room)
    assert 50 <= len(cells) <= 90
    x, y, _ = room.start
    assert (math.floor(x / 0.5), math.floor(y / 0.5)) in cells
    for col, row in cells:
        points = [
            (0.5 * col + a, 0.5 * row + b) for a in np.arange(0, 0.5, 0.02) for b in np.arange(0, 0.5, 0.02)
        ]
        assert max(room.free_space.distance(*point) for point in points) > 0.4


def test_the_score_of_a_drive_counted_by_hand(env):
    begin(env)
    for speeds in [(0.3, 0.0)] * 40 + [(0.0, 1.0)] * 15 + [(0.3, 0.0)] * 100:
        env.step(speeds)
    cells = cells_to_reach(env.room)
    entered = {(math.floor(x / 0.5), math.floor(y / 0.5)) for x, y, _ in env.path}
    assert len(entered & cells) >= 3 and len(env.bump_places) >= 1
    right, left = in_odometry(env, "marker"), in_odometry(env, "wall_marker")
    numbers = (env.room.markers["marker"], env.room.markers["wall_marker"])
    score = exploration_score(
        env, {"markers": dict(zip(numbers, (right, left), strict=True)), "word": env.room.word.lower() + " "}
    )
    coverage = round(len(entered & cells) / len(cells), 4)
    bumps = len(env.bump_places)
    assert score == {
        **{"coverage": coverage, "markers": 2, "word": 1, "bumps": bumps, "time": 15.5},
        "score": round(100 * coverage + 20 + 20 - 5 * bumps),
    }
    for nothing in ({}, None):
        assert exploration_score(env, nothing)["score"] == max(0, round(100 * coverage - 5 * bumps))


def test_the_place_of_a_marker_is_right_within_30_centimetres(env):
    begin(env)
    x, y = in_odometry(env, "marker")
    marker, wall_marker = env.room.markers["marker"], env.room.markers["wall_marker"]
    for away, count in ((0.29, 1), (0.31, 0)):
        for angle in (0.0, 2.0, 4.0):
            place = [x + away * math.cos(angle), y + away * math.sin(angle)]
            assert exploration_score(env, {"markers": {marker: place}})["markers"] == count
    assert exploration_score(env, {"markers": {wall_marker: (x, y), 7: (x, y)}})["markers"] == 0


def test_bumps_cannot_make_a_score_negative(env):
    begin(env)
    env.bump_places = [(1, env.path[0])] * 3
    assert exploration_score(env, {})["score"] == 0
