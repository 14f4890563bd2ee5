"""Occupancy grids: rays against scikit-image's lines, scans and scores on grids small enough to read."""

import math

import numpy as np
import pytest
from skimage.draw import line

from imgproc_course.geometry import grid_precision_recall, grid_ray, log_odds, probability, update_grid

OCTANTS = [(0, 0), *((r, c) for r in range(-7, 8) for c in range(-7, 8) if max(abs(r), abs(c)) == 7)]


def test_the_cells_of_a_ray_equal_scikit_images():
    ends = [((3, 4), (3 + r, 4 + c)) for r, c in OCTANTS]
    ends += list(np.random.default_rng(1).integers(-60, 60, (3000, 2, 2)))
    for start, end in ends:
        np.testing.assert_array_equal(grid_ray(start, end), np.stack(line(*start, *end), -1))


@pytest.mark.parametrize("end", [(1.0, 2.0), (1, 2, 3), 5])
def test_what_is_no_cell(end):
    with pytest.raises(ValueError, match="two cells"):
        grid_ray((0, 0), end)


def test_log_odds_and_back():
    values = log_odds([0.5, 0.7, 0.4, 0.001])
    np.testing.assert_allclose(values, (0, math.log(7 / 3), math.log(2 / 3), -math.log(999)), atol=1e-12)
    np.testing.assert_allclose(probability(values), (0.5, 0.7, 0.4, 0.001), atol=1e-12)
    np.testing.assert_allclose(probability([-1e6, 0, 1e6]), (0, 0.5, 1), atol=1e-300)


@pytest.mark.parametrize("p", [0, 1, -0.1, [0.5, math.nan]])
def test_probabilities_without_log_odds(p):
    with pytest.raises(ValueError, match="above 0 and below 1"):
        log_odds(p)


def test_one_scan_in_a_grid():
    grid = np.zeros((3, 5))
    # A hit on the right, a pass through that very cell to outside, and a short ray without a hit.
    scan = update_grid(grid, (1, 0), [(1, 3), (1, 7), (0, 0)], [True, False, False], occupied=2, free=-1)
    np.testing.assert_array_equal(scan, [[0, 0, 0, 0, 0], [-1, -1, -1, 2, -1], [0, 0, 0, 0, 0]])
    for _ in range(4):
        scan = update_grid(scan, (1, 0), [(1, 3)], occupied=2, free=-1, limit=3)
    np.testing.assert_array_equal(scan[1], [-3, -3, -3, 3, -1])
    assert not grid.any()


def test_a_scan_equals_one_cell_after_the_other():
    random = np.random.default_rng(2)
    ends, hits = random.integers(-4, 24, (200, 2)), random.random(200) < 0.7
    expected = np.zeros((20, 20))
    for at_end, value in ((False, -0.4), (True, 0.85)):
        for end, hit in zip(ends, hits, strict=True):
            cells = np.stack(line(9, 11, *end), -1)
            for row, col in cells[-1:] if at_end else cells[:-1]:
                if 0 <= row < 20 and 0 <= col < 20 and (hit or not at_end):
                    expected[row, col] = value
    np.testing.assert_array_equal(update_grid(np.zeros((20, 20)), (9, 11), ends, hits), expected)


@pytest.mark.parametrize(
    ("grid", "robot", "ends", "hits"),
    [
        (np.zeros(5), (0, 0), [(1, 1)], None),
        (np.zeros((5, 5)), (0, 0, 0), [(1, 1)], None),
        (np.zeros((5, 5)), (0, 0), [1, 1], None),
        (np.zeros((5, 5)), (0, 0), [(1, 1)], [True, True]),
        (np.zeros((5, 5)), (0, 0), [(1.5, 1.5)], None),
    ],
)
def test_what_is_no_scan(grid, robot, ends, hits):
    with pytest.raises(ValueError, match="needs a grid"):
        update_grid(grid, robot, ends, hits)


def test_precision_and_recall_of_a_grid():
    truth = np.zeros((6, 8), bool)
    truth[0, 0:4] = truth[5, 7] = True
    grid = np.full((6, 8), -1.0)
    grid[1, 0] = grid[1, 1] = grid[3, 6] = 1.0  # two beside the wall, one in the air
    assert grid_precision_recall(grid, truth) == (2 / 3, 3 / 5)
    grid[5, 7] = 0.0  # never seen: nothing to find there
    assert grid_precision_recall(grid, truth) == (2 / 3, 3 / 4)
    assert grid_precision_recall(grid, truth, tolerance=0) == (0, 0)
    assert grid_precision_recall(np.zeros((6, 8)), truth) == (0, 0)
    with pytest.raises(ValueError, match="one shape"):
        grid_precision_recall(grid, truth[:5])
