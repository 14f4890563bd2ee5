"""A controller that looks at nothing passes hardly a scenario: fixed speeds, a repeated drive."""

from dataclasses import replace
from itertools import islice

import pytest
from all_masters import PATHS, all_masters
from nbclassroom.exercises.kinds.drive.draw_scenarios import is_passed_by_repeating, public_drives
from nbclassroom.exercises.kinds.drive.drive import environment

FIXED_SPEEDS = [[(0.3, 0.0)] * 1000, [(0.0, 0.5)] * 1000]
KEY_SEED = 1
DRAWS = 2


DRIVING = [path for path in PATHS if 'subject="drive"' in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", DRIVING, ids=lambda path: path.stem)
def test_a_blind_controller_passes_few_scenarios(path):
    """A key draws again what a repeated drive passes, at most 20 times; fixed speeds are never right."""
    environment.cache_clear()  # it may be that of another course, in which an earlier test has driven
    (master,) = (master for master in all_masters().values() if master.path == path)
    drives = [exercise for exercise in master.exercises if exercise.subject == "drive"]
    assert drives
    for exercise in drives:
        (repeated,) = public_drives(replace(exercise, cases=exercise.public[:1]))
        drawn = [scenario for ((scenario,),) in islice(exercise.draws(exercise.hidden[0], KEY_SEED), DRAWS)]
        passed = [is_passed_by_repeating(exercise, [repeated], scenario) for scenario in drawn]
        assert sum(passed) <= (exercise.id == "tracking-drive")  # a ball rolls in few ways
        assert not any(is_passed_by_repeating(exercise, FIXED_SPEEDS, scenario) for scenario in drawn[:1])
        first = exercise.arguments(exercise.public[0])[0][0]
        assert is_passed_by_repeating(exercise, [repeated], first)
