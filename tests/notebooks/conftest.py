"""The lesson that a module is named after: test_faces tests the lesson "faces"."""

from pathlib import Path

import pytest
from nbclassroom.exercises import read_exercises

MASTERS = Path(__file__).parents[2] / "notebooks" / "masters"


@pytest.fixture(scope="module")
def master(request):
    """The path of the lesson's master."""
    (path,) = MASTERS.glob(f"[0-9]*_{request.path.stem.removeprefix('test_')}.py")
    return path


@pytest.fixture(scope="module")
def solutions(master):
    """The function of each exercise's solution, by its name."""
    return {
        exercise.function: exercise.function_of(exercise.solution, "solution")
        for exercise in read_exercises(master)
        if exercise.function
    }
