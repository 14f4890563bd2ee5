"""What the tests of single lessons share."""

import pytest

from imgproc_course.classroom.exercises import read_exercises


@pytest.fixture(scope="module")
def solutions(request):
    """The function of each exercise's solution in the module's MASTER, by its name."""
    return {
        exercise.function: exercise.function_of(exercise.solution, "solution")
        for exercise in read_exercises(request.module.MASTER)
    }
