"""The lesson "Obstacles ahead": a point without a depth is no obstacle, and hides none."""

import math

import numpy as np
import pytest


@pytest.mark.parametrize("missing", [0.0, math.nan])
def test_a_missing_depth_is_no_obstacle_and_hides_none(solutions, missing):
    nearest_obstacle = solutions["nearest_obstacle"]
    left, height = np.zeros(3), np.full(3, 0.2)
    assert nearest_obstacle(np.array([2.0, missing, 0.7]), left, height, 0.3) == 0.7
    assert nearest_obstacle(np.full(3, missing), left, height, 0.3) == math.inf
    point = np.array([missing, 0.9, 0.7])
    assert nearest_obstacle(point, point * 0, np.array([missing, 0.2, 0.2]), 0.3) == 0.7
