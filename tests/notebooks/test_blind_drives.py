"""A controller that looks at nothing passes hardly a scenario: fixed speeds, a repeated drive."""

from itertools import islice
from pathlib import Path

import pytest

from imgproc_course.classroom.authoring.masters import find_masters
from imgproc_course.classroom.autograder.draw_scenarios import is_passed_by_repeating, public_drives
from imgproc_course.classroom.exercises import read_exercises

MASTERS = find_masters(Path(__file__).parents[2] / "notebooks" / "masters")
DRIVES = [each for path in MASTERS for each in read_exercises(path) if each.subject == "drive"]
FIXED_SPEEDS = [[(0.3, 0.0)] * 1000, [(0.0, 0.5)] * 1000]
KEY_SEED = 1
DRAWS = 3


@pytest.mark.parametrize("exercise", DRIVES, ids=lambda exercise: exercise.id)
def test_a_blind_controller_passes_few_scenarios(exercise):
    """A key draws again what a repeated drive passes, at most 20 times; fixed speeds are never right."""
    repeated = next(public_drives(exercise))
    drawn = [scenario for ((scenario,),) in islice(exercise.draws(exercise.hidden[0], KEY_SEED), DRAWS)]
    passed = [is_passed_by_repeating([repeated], scenario) for scenario in drawn]
    assert sum(passed) <= (exercise.id == "tracking-drive")  # a ball rolls in few ways
    assert not any(is_passed_by_repeating(FIXED_SPEEDS, scenario) for scenario in drawn)
    assert is_passed_by_repeating([repeated], exercise.arguments(exercise.public[0])[0][0])
