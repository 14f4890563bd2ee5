"""A controller that looks at nothing passes no scenario of a key: fixed speeds, a drive repeated."""

from pathlib import Path

import pytest

from imgproc_course.classroom.authoring.masters import find_masters
from imgproc_course.classroom.autograder.draw_scenarios import drive_here
from imgproc_course.classroom.exercises import read_exercises
from imgproc_course.classroom.exercises.drive import passes

MASTERS = find_masters(Path(__file__).parents[2] / "notebooks" / "masters")
DRIVES = [each for path in MASTERS for each in read_exercises(path) if each.subject == "drive"]
KEY_SEED = 1
OPEN = pytest.mark.xfail(strict=True, reason="the ball rolls in few ways: a repeated drive can follow it")


def scenario_of(exercise, *seed):
    ((scenario,),) = exercise.arguments(exercise.public[0], *seed)
    return scenario


def repeated(actions):
    """A controller that counts its looks, and drives these actions."""
    left = iter(actions)
    return lambda observation, memory: next(left, (0.0, 0.0))


@pytest.mark.parametrize(
    "exercise",
    [pytest.param(each, id=each.id, marks=[OPEN] * (each.id == "tracking-drive")) for each in DRIVES],
)
def test_a_blind_controller_passes_no_other_scenario(exercise):
    scenario = scenario_of(exercise)
    solution = exercise.function_of(exercise.solution, "solution")
    record, _ = drive_here(solution, exercise.sensors, scenario)
    assert passes(record, scenario)
    other = scenario_of(exercise, KEY_SEED)
    for actions in (record["actions"], [(0.3, 0.0)] * 1000, [(0.0, 0.5)] * 1000):
        drive, _ = drive_here(repeated(actions), exercise.sensors, other)
        assert not drive["ended"] and not passes(drive, other), (actions[0], drive["metrics"])
