"""A drive in a scenario: what a learner's two numbers do, what it gives, and what is said about it."""

import json
import math

import numpy as np
import pytest
from nbclassroom.exercises.kinds.drive.drive import Drive, decisive_moment, metric_text, passes, speeds_of
from nbclassroom.exercises.kinds.drive.scenario import read_scenario
from nbclassroom.exercises.kinds.drive.sentences import behaviours, drives_alike, sentences_of
from plane_env import PlaneEnv, driving_on_a_plane

SCENARIO = {
    "seed": 3,
    "title": "a wall",
    "duration": 3.0,
    "thresholds": {"bumps": ["<=", 0], "clearance": [">=", 0.25], "reach": [">=", 0.5]},
}


@pytest.fixture(autouse=True)
def on_a_plane():
    with driving_on_a_plane():
        yield


def driven(speeds, **changes):
    """The record of a drive at constant speeds, or at those of a function of time, and its scenario."""
    scenario = SCENARIO | changes
    drive = Drive(PlaneEnv(("scan", "odometry")), scenario)
    while not drive.over:
        drive.act(speeds(drive.steps / 10) if callable(speeds) else speeds)
    return drive.record(), scenario


def test_a_drive_gives_observations_until_its_end():
    drive = Drive(PlaneEnv(("scan", "odometry")), SCENARIO)
    assert drive.layout == [["scan", "<f4", [360]], ["odometry", "<f8", [3]], ["time", "<f8", []]]
    assert drive.observation["scan"][0] == 2.0 and drive.observation["time"] == 0.0
    drive.act((0.2, 0.0))
    assert drive.observation["odometry"].tolist() == pytest.approx([0.02, 0, 0]) and drive.steps == 1
    for _ in range(40):
        drive.act((0.2, 0.0))
    assert drive.over and drive.steps == 30


def test_the_environment_gets_the_options_of_the_scenario_alone():
    env = PlaneEnv()
    Drive(env, SCENARIO | {"room": 17, "lighting": "evening"})
    assert (env.seed, env.options) == (3, {"duration": 3.0, "room": 17, "lighting": "evening"})


def test_a_record_is_data_and_says_what_was_kept():
    record, scenario = driven((0.2, 0.0))
    assert json.loads(json.dumps(record)) == record
    assert passes(record, scenario) and sentences_of(record, scenario) == []
    assert record["steps"] == 30 and record["path"][-1] == [0.6, 0, 0] and record["actions"][7] == [0.2, 0.0]
    assert record["metrics"]["reach"] == 0.6 and record["decisive"] == 30


def test_a_bump_is_the_decisive_moment():
    record, scenario = driven((0.3, 0.0), room=10)
    assert record["missed"] == [["bumps", 1, "<=", 0], ["clearance", 0.0, ">=", 0.25]]
    assert record["decisive"] == 27 and record["bumps"] == [[27, 0.8, 0.0]] and not passes(record, scenario)
    assert sentences_of(record, scenario) == ["The robot bumped into the wall at 2.7 s."]
    some_bumps, _ = driven((0.3, 0.0), room=10, thresholds={"bumps": ["<=", 0], "reach": [">=", 0.85]})
    assert sentences_of(some_bumps, scenario) == [
        "The robot bumped into the wall at 2.7 s.",
        "The robot got 0.80 m away from its start; the task asks for at least 0.85 m.",
    ]


def test_the_first_bump_decides_also_where_the_clearance_is_larger():
    env = PlaneEnv(())
    drive = Drive(env, SCENARIO)
    for _ in range(20):
        drive.act((0.2, 0.0))
    env.bump_places.append((4, env.path[4]))  # into what moves
    assert drive.record()["decisive"] == 4


def test_a_robot_that_comes_too_near_is_told():
    record, scenario = driven((0.19, 0.0), room=10)
    assert sentences_of(record, scenario) == [
        "The robot came as near as 0.23 m to the wall at 3.0 s; the task asks for at least 0.25 m."
    ]


def test_a_robot_that_stands_has_no_clearance():
    record, scenario = driven((0.0, 0.4))
    assert sentences_of(record, scenario) == [
        "The robot never drove.",
        "The robot got 0.00 m away from its start; the task asks for at least 0.50 m.",
        "The time was over while the robot still drove or turned.",
    ]


@pytest.mark.parametrize(
    ("speeds", "is_over"), [((0.3, 0.0), True), ((0.0, 0.4), True), ((0.01, -0.05), False)]
)
def test_a_robot_that_still_moves_at_the_end_is_told_that_the_time_is_over(speeds, is_over):
    record, scenario = driven(speeds)
    record["missed"] = [["answer_error", 80.0, "<=", 15]]
    assert ("the time is over" in behaviours(record, scenario)) == is_over
    assert "error of the answer" in behaviours(record, scenario)


def test_a_metric_that_looks_like_its_limit_has_more_digits():
    cases = [("clearance", 0.0799), ("clearance", 0.076), ("clearance", 0.08), ("clearance", 0.3)]
    assert [metric_text(*case, 0.08) for case in cases] == ["0.0799 m", "0.076 m", "0.08 m", "0.30 m"]
    assert [metric_text("ball_angle", 15.3, limit) for limit in (15, 20)] == ["15.3°", "15°"]


@pytest.mark.parametrize(
    ("speeds", "behaviour", "sentence"),
    [
        ((0.1, 90.0), "its speeds are too large", "returned up to 90 rad/s; the robot can do 1.57 rad/s."),
        (
            (0.0, 0.05),
            "it stands",
            "From 0.0 s to the end the robot stood: the function returned hardly any speed.",
        ),
        (
            (0.0, 0.6),
            "it turns on the spot",
            "0.0 s to the end the robot turned on the spot, 1.9 times round.",
        ),
        ((0.0, 0.2), "it stays in one place", "From 0.0 s to the end the robot stayed in one place."),
        (
            lambda t: (0.3 * (t < 4), math.copysign(1, t % 4 - 2)),
            "it turns left and right",
            "the end the robot stayed in one place, and changed the side to which it turned 8 times.",
        ),
        ((0.3, 1.2), "it drives in circles", "In all, the robot turned 4 times round to the left."),
        ((0.3, -1.2), "it drives in circles", "In all, the robot turned 4 times round to the right."),
        ((0.3, -1.5), "it turns fast", "In 100% of the time the robot turned as fast as it can."),
        ((0.1, 0.0), "it is slow", "The robot never drove faster than 0.10 m/s; it can drive with 0.3 m/s."),
        (
            lambda t: (math.copysign(0.3, 3 - t % 6), 0.0),
            "it drives to the same places again",
            "The robot drove 6.0 m, and came to 3 places: often to the same ones again.",
        ),
    ],
)
def test_a_drive_shows_how_its_controller_behaves(speeds, behaviour, sentence):
    record, scenario = driven(speeds, duration=20.0, thresholds={"places": [">=", 9]})
    (name, text), *_ = behaviours(record, scenario).items()
    assert name == behaviour and text.endswith(sentence) and text in sentences_of(record, scenario)
    assert behaviours(record | {"missed": []}, scenario) == {}


def test_behaviours_depend_on_goal_bump_and_height():
    record, scenario = driven((0.0, 0.0), duration=9.0, goal=(0.5, 0.0, 0.3))
    assert next(iter(behaviours(record, scenario))) == "it stands at the goal"
    assert "stood, 0.5 m from the goal: the function" in sentences_of(record, scenario)[-1]
    far, away = ["ball_gap", 0.7, "<=", 0.25], ["ball_angle", 20.0, "<=", 15]
    has_ball, has_none = ({**record, "missed": missed} for missed in ([far], [far, away]))
    assert [*behaviours(has_ball, scenario)] == ["error of the distance"]
    assert next(iter(behaviours(has_none, scenario))) == "it stands at the goal"
    record, scenario = driven((0.3, 0.0), room=10)
    assert [*behaviours(record, scenario)] == ["it comes too near", "bumps", "clearance"]
    record["metrics"] |= {"low": True, "remarks": {"another ball": "It looked at the third ball."}}
    assert [*behaviours(record, scenario)][:3] == ["another ball", "something low seen", "it comes too near"]
    assert "something low" in behaviours(record | {"read": ["scan"]}, scenario)
    backward = record | {"actions": [[-0.2, 0.0]] * record["steps"]}
    assert any("while it drove backward" in said for said in sentences_of(backward, scenario))
    assert next(iter(behaviours(backward, scenario))) == "it drives backward"
    record, scenario = driven((0.3, 0.5), room=5)
    text = "at 1.1 s, while it drove with 0.30 m/s and turned to the left with 0.50 rad/s."
    assert sentences_of(record, scenario)[0].endswith(text)


def test_drives_are_alike_if_their_speeds_or_their_paths_are():
    longer = {"duration": 7.0, "room": 60}
    straight, turned = (driven((0.3, 0.0), **longer | {"start": (0, 0, yaw)})[0] for yaw in (0.0, 3.0))
    late, curve = (driven(lambda t, yaw=yaw: (0.3, yaw * (t > 6)), **longer)[0] for yaw in (0.1, 2.0))
    alike = [drives_alike([straight, one]) for one in (turned, late, curve)]
    assert alike == [True, True, False] and not drives_alike([straight])
    bumping = [driven(lambda t, last=last: (0.3, last), room=6)[0] for last in (0.0, 0.01)]
    assert not drives_alike(bumping) and drives_alike(bumping[:1] * 2)
    still = [driven((0.0, 0.5), room=room)[0] for room in (10, 20)]
    assert not drives_alike(still)


def test_speeds_beyond_the_robots_limits_are_cut():
    record, _ = driven((1e308, 0.0))
    assert record["path"][-1] == [0.9, 0, 0] and record["actions"][0] == [1e308, 0.0]


def test_a_drive_that_nobody_drove_to_its_end_does_not_pass():
    drive = Drive(PlaneEnv(), SCENARIO | {"thresholds": {"bumps": ["<=", 0]}})
    drive.act((0.2, 0.0))
    assert not drive.record()["missed"] and not passes(drive.record(), drive.scenario)
    assert sentences_of(drive.record(), drive.scenario) == ["The drive did not come to its end."]


@pytest.mark.parametrize("value", [(1, 2), [1.0, 2], np.array([1.0, 2.0]), (np.float32(1), np.int64(2))])
def test_two_numbers_are_speeds(value):
    speeds = speeds_of(value)
    assert speeds == (1.0, 2.0) and {*map(type, speeds)} == {float}


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "None"),
        (0.3, "0.3"),
        ("ab", "'ab'"),
        ((0.1, "x"), "(0.1, 'x')"),
        ((0.1, None), "(0.1, None)"),
        ((1, 2, 3), "(1, 2, 3)"),
        ({1, 2}, "{1, 2}"),
        (np.zeros((2, 2)), "array([[0., 0.], [0., 0.]])"),
        (np.array(1.0), "array(1.)"),
        ((0.1, object()), "(0.1, <object object at 0x…>)"),
        (dict, "<class 'dict'>"),
    ],
)
def test_anything_else_is_named(value, text):
    with pytest.raises(ValueError) as raised:
        speeds_of(value)
    assert str(raised.value) == f"control returned {text}: expected two numbers, (linear, angular)"


@pytest.mark.parametrize("value", [(float("nan"), 0), (0, float("inf")), (10**400, 0)])
def test_speeds_are_finite(value):
    with pytest.raises(ValueError, match=r"expected two numbers, \(linear, angular\), neither nan nor inf$"):
        speeds_of(value)


def test_a_scenario_becomes_plain_data():
    drawn = SCENARIO | {
        "seed": np.int64(5),
        "start": (np.float64(1), 2, 0),
        "goal": np.array([1.0, 2.0, 0.5]),
    }
    scenario = read_scenario(drawn)
    assert SCENARIO.items() <= (scenario | {"seed": 3}).items()
    parts = [scenario[key] for key in ("seed", "start", "goal", "room")]
    assert parts == [5, [1.0, 2, 0], [1.0, 2.0, 0.5], None] and type(scenario["seed"]) is int


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rooms": 3}, "Object contains unknown field `rooms`; got {'seed'"),
        ({"room": "17"}, r"Expected `int \| null`, got `str` - at `\$.room`"),
        ({"room": -1}, r"Expected `int` >= 0 - at `\$.room`"),
        ({"seed": 1.5}, r"Expected `int`, got `float` - at `\$.seed`"),
        ({"start": [1, 2]}, r"Expected `array` of length 3, got 2 - at `\$.start`"),
        ({"duration": 0}, r"Expected `float` >= 0.1 - at `\$.duration`"),
        ({"duration": 200}, r"Expected `float` <= 120.0 - at `\$.duration`"),
        ({"uneven": 0.2}, r"Expected `float` <= 0.1 - at `\$.uneven`"),
        ({"lighting": "night"}, r"Invalid enum value 'night' - at `\$.lighting`"),
        ({"movers": ["cat"]}, r"Invalid enum value 'cat' - at `\$.movers\[0\]`"),
        ({"title": " "}, r"Expected `str` matching regex .* - at `\$.title`"),
        ({"thresholds": {}}, r"Expected `object` of length >= 1 - at `\$.thresholds`"),
        ({"thresholds": {"speed": ["<=", 1]}}, "Invalid enum value 'speed' - at .*key.* in `.*thresholds`"),
        ({"thresholds": {"bumps": ["<", 1]}}, r"Invalid enum value '<' - at `\$.thresholds\[...\]\[0\]`"),
        ({"thresholds": {"bumps": 0}}, "Expected `array`, got `int`"),
        ({"thresholds": {"goal_time": ["<=", 9]}}, "a threshold of goal_time needs 'goal' in the scenario"),
        ({"thresholds": {"answer_error": ["<=", 9]}}, "answer_error needs 'answer' in the scenario"),
        ({"time": float("nan")}, "Out of range float values are not JSON compliant"),
        ({"goal": object()}, "no attribute 'tolist'"),
    ],
)
def test_what_is_wrong_with_a_scenario_is_said(change, message):
    with pytest.raises(ValueError, match=message):
        read_scenario(SCENARIO | change)


@pytest.mark.parametrize("key", ["seed", "title", "thresholds"])
def test_a_scenario_needs_these_keys(key):
    with pytest.raises(ValueError, match=f"missing required field `{key}`"):
        read_scenario({name: value for name, value in SCENARIO.items() if name != key})


def test_the_end_is_the_decisive_moment_of_a_drive_that_misses_its_way_alone():
    record, _ = driven((0.1, 0.0), thresholds={"bumps": ["<=", 0], "reach": [">=", 0.85]})
    assert record["missed"][0][0] == "reach" and decisive_moment(record) == "the end"
    assert record["decisive"] == record["steps"] == 30
    near, _ = driven((0.1, 0.0), thresholds={"clearance": [">=", 9.0], "reach": [">=", 0.85]})
    assert decisive_moment(near) == "the nearest place"
