"""The lesson "Mapping and SLAM": its solutions give what the field's tools give, on many inputs."""

import numpy as np
from skimage.draw import line

from imgproc_course.geometry import (
    grid_ray,
    log_odds,
    relative_pose,
    update_grid,
    wrap_angle,
)


def test_ray_cells_is_scikit_images_line_and_the_packages(solutions):
    rng = np.random.default_rng(0)
    for _ in range(1000):
        start, end = rng.integers(0, 60, (2, 2)).tolist()
        cells = solutions["ray_cells"](tuple(start), tuple(end))
        assert cells == list(zip(*(axis.tolist() for axis in line(*start, *end)), strict=True))
        assert cells == [tuple(cell) for cell in grid_ray(start, end).tolist()]


def test_a_ray_of_one_cell(solutions):
    assert solutions["ray_cells"]((3, 4), (3, 4)) == [(3, 4)] == [tuple(grid_ray((3, 4), (3, 4))[0].tolist())]


def test_add_scan_is_the_packages_update_grid(solutions):
    rng = np.random.default_rng(1)
    for _ in range(100):
        grid, robot = rng.uniform(-6, 6, (12, 15)), rng.integers(0, 12, 2)
        ends = rng.integers(0, 12, (20, 2))
        ends = ends[(ends != robot).any(axis=1)]
        rays = [[tuple(cell) for cell in grid_ray(robot, end).tolist()] for end in ends]
        before = grid.copy()
        result = solutions["add_scan"](grid, rays, 0.7, 0.4)
        package = update_grid(grid, robot, ends, occupied=log_odds(0.7), free=log_odds(0.4))
        np.testing.assert_allclose(result, package, rtol=0, atol=1e-12)
        np.testing.assert_array_equal(grid, before)


def test_edge_error_is_relative_pose_less_the_measured_motion(solutions):
    rng = np.random.default_rng(2)
    for _ in range(200):
        first, second, measured = rng.uniform(-3, 3, (3, 3))
        package = relative_pose(first, second) - measured
        package[2] = wrap_angle(package[2])
        np.testing.assert_allclose(
            solutions["edge_error"](first, second, measured), package, rtol=0, atol=1e-12
        )
