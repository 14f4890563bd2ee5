"""The lesson "Obstacles ahead": a point without a depth is no obstacle, and hides none."""

import math
from pathlib import Path

import numpy as np
import pytest

from imgproc_course.classroom.exercises import read_exercises

MASTER = Path(__file__).parents[2] / "notebooks" / "masters" / "12_obstacles_ahead.py"


@pytest.fixture(scope="module")
def nearest_obstacle():
    (exercise,) = [e for e in read_exercises(MASTER) if e.function == "nearest_obstacle"]
    return exercise.function_of(exercise.solution, "solution")


@pytest.mark.parametrize("missing", [0.0, math.nan])
def test_a_missing_depth_is_no_obstacle_and_hides_none(nearest_obstacle, missing):
    left, height = np.zeros(3), np.full(3, 0.2)
    assert nearest_obstacle(np.array([2.0, missing, 0.7]), left, height, 0.3) == 0.7
    assert nearest_obstacle(np.full(3, missing), left, height, 0.3) == math.inf
    point = np.array([missing, 0.9, 0.7])
    assert nearest_obstacle(point, point * 0, np.array([missing, 0.2, 0.2]), 0.3) == 0.7
