"""What a robot has seen around it: scans and low points of rooms small enough to check, and routes."""

import math

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt
from skimage.graph import MCP_Geometric

from imgproc_course.geometry import LocalMap, compose_poses

CELL = 0.05


def room_scan(x, y, yaw, offset, half=1.0):
    """Of a scanner `offset` before the axle at (x, y, yaw), in a square room around 0."""
    x, y = x + offset * math.cos(yaw), y + offset * math.sin(yaw)
    angles = yaw + np.radians(np.arange(360))
    with np.errstate(divide="ignore"):
        ways = [
            np.where(c > 0, (half - place) / c, np.where(c < 0, (-half - place) / c, np.inf))
            for place, c in ((x, np.cos(angles)), (y, np.sin(angles)))
        ]
    return np.minimum(*ways)


def occupied(local_map):
    return local_map.log_odds > 0


@pytest.mark.parametrize("pose", [(0.0, 0.0, 0.0), (0.31, -0.22, 0.7), (-0.4, 0.5, -2.8)])
def test_a_scan_of_a_square_room_gives_its_walls(pose):
    local_map = LocalMap((-1.225, -1.225), (49, 49))  # the walls are in the middle of cells 4 and 44
    for _ in range(2):
        local_map.add_scan(pose, 0.1, room_scan(*pose, 0.1))
    rows, cols = np.indices((49, 49)) - 24
    ring = np.maximum(np.abs(rows), np.abs(cols))
    assert not occupied(local_map)[ring != 20].any()
    assert occupied(local_map)[ring == 20].mean() > 0.9  # from near, rays leave out cells of the far wall
    assert (local_map.log_odds[ring < 19] < 0).mean() > 0.9
    assert (local_map.log_odds[ring > 20] == 0).all()
    assert local_map.log_odds.dtype == np.float64 and not local_map.low.any()


def test_a_long_ray_and_one_without_a_hit_end_free():
    ranges = np.zeros(360)
    for distance, is_hit in ((3.9, True), (4.1, False), (math.inf, False)):
        local_map = LocalMap((0.0, 0.0), (10, 120))
        ranges[0] = distance
        local_map.add_scan((0.025, 0.225, 0.0), 0.0, ranges)
        assert occupied(local_map)[4, 1:].sum() == is_hit
        assert (local_map.log_odds[4, 1:78] < 0).all() and (local_map.log_odds[4, 82:] == 0).all()


SIGHT = {"near": 0.5, "far": 1.5, "slope": 0.5}


def low_places(local_map, pose=(0.0, 0.0, 0.0)):
    return sorted(local_map.low_points(pose).round(3).tolist())


def test_nan_in_a_scan_or_a_point_is_no_measurement():
    local_map, expected = LocalMap((-1.225, -1.225), (49, 49)), LocalMap((-1.225, -1.225), (49, 49))
    pose, ranges = (0.1, 0.2, 0.3), room_scan(0.1, 0.2, 0.3, 0.1)
    expected.add_scan(pose, 0.1, ranges)
    ahead = (np.arange(360) + 5) % 360 < 10
    local_map.add_scan(pose, 0.1, np.where(ahead, np.nan, ranges))
    assert (local_map.log_odds != expected.log_odds).any()  # the rays ahead are missing
    local_map.add_scan(pose, 0.1, np.where(ahead, ranges, np.nan))
    assert (occupied(local_map) == occupied(expected)).all() and occupied(local_map).any()
    local_map.add_low_points(pose, [(np.nan, 0.1), (0.5, np.nan), (0.5, 0.1)], near=0.3, far=1, slope=1)
    assert local_map.low.sum() == 1


def test_low_points_are_in_the_frame_of_the_robot():
    local_map = LocalMap((-2.0, -2.0), (80, 80))
    pose = (0.5, 0.25, math.pi / 2)
    local_map.add_low_points(pose, [(1.01, 0.03), (1.02, 0.04), (0.7, -0.11), (9.0, 0.0)], **SIGHT)
    assert local_map.low.sum() == 2  # two points are in one cell, and one is outside of the map
    for cell in ((65, 49), (59, 52)):
        assert local_map.low[cell]
    np.testing.assert_allclose(
        compose_places(pose, local_map.low_points(pose)), [(0.625, 0.975), (0.475, 1.275)]
    )


def compose_places(pose, points):
    poses = np.column_stack([points, np.zeros(len(points))])
    return compose_poses(np.array(pose), poses)[:, :2]


def test_low_points_are_kept_out_of_view_and_forgotten_in_view():
    local_map = LocalMap((-2.0, -2.0), (80, 80))
    here = (0.0, 0.0, 0.0)
    places = [(1.025, 0.025), (0.325, 0.025), (1.725, 0.025), (1.025, 0.625), (1.025, -0.625)]
    local_map.add_low_points(here, places, **SIGHT)
    assert low_places(local_map) == sorted(map(list, places))
    local_map.add_low_points((0.0, 0.0, math.pi), [], **SIGHT)  # it looks away
    assert low_places(local_map) == sorted(map(list, places))
    local_map.add_low_points(here, [(0.925, 0.025)], **SIGHT)  # the first one is at another place now
    assert low_places(local_map) == sorted(map(list, [(0.925, 0.025), *places[1:]]))
    local_map.add_low_points((0.0, 0.0, 0.5), [], **SIGHT)  # turned to the left
    assert low_places(local_map) == sorted(map(list, [(0.925, 0.025), *places[1:3], places[4]]))


def with_wall(gap, size=(40, 40)):
    """A map with a wall along x = 1, with a gap in y."""
    local_map = LocalMap((0.0, 0.0), size)
    y = np.arange(0.025, size[0] * CELL, CELL)
    is_wall = (y < gap[0]) | (y > gap[1])
    points = np.column_stack([np.full(is_wall.sum(), 1.01), y[is_wall]])
    local_map.add_low_points((0.0, 0.0, 0.0), points, near=0.0, far=0.0, slope=0.0)
    return local_map


def test_a_route_goes_through_the_gap_of_a_wall():
    local_map = with_wall((1.4, 1.9))
    route = local_map.route((0.5, 0.5), (1.5, 0.5))
    np.testing.assert_allclose(route[[0, -1]], [(0.525, 0.525), (1.525, 0.525)])
    assert np.abs(np.diff(route, axis=0)).max() < CELL + 1e-9  # from each cell to a neighbor
    in_wall = route[np.abs(route[:, 0] - 1.0) < 0.05]
    assert len(in_wall) and (abs(in_wall[:, 1] - 1.65) < 0.051).all()  # in the middle of the gap
    assert route.dtype == np.float64 and route.shape[1] == 2


def test_an_empty_map_has_the_straight_route():
    route = LocalMap((0.0, 0.0), (30, 30)).route((0.1, 0.2), (1.3, 0.2))
    np.testing.assert_allclose(route, [(0.125 + CELL * k, 0.225) for k in range(25)])


def test_the_cost_of_a_route_is_the_smallest():
    rng = np.random.default_rng(4)
    for _ in range(10):
        local_map = LocalMap((-0.5, 0.3), (15, 20))
        local_map.low[rng.integers(0, 15, 12), rng.integers(0, 20, 12)] = True
        local_map.log_odds[rng.integers(0, 15, 4), rng.integers(0, 20, 4)] = 0.8
        free = ~(local_map.low | occupied(local_map))
        distance = CELL * distance_transform_edt(free)
        cost = 1 + 32 * np.clip(1 - distance / 0.4, 0, None) + 200 * (distance < 0.15)
        start, end = rng.integers(0, 15, 2), rng.integers(0, 20, 2)
        cells = np.column_stack([start, end])  # row and column of each
        places = np.array([-0.5, 0.3]) + CELL * (cells[:, ::-1] + 0.5)
        route = local_map.route(*places)
        np.testing.assert_allclose(route[[0, -1]], places)
        rows, cols = np.round((route - (-0.5, 0.3)) / CELL - 0.5).astype(int).T[::-1]
        steps = np.hypot(np.diff(rows), np.diff(cols))
        total = (steps * (cost[rows, cols][1:] + cost[rows, cols][:-1]) / 2).sum()
        costs, _ = MCP_Geometric(cost).find_costs([cells[0]])
        assert total == pytest.approx(costs[tuple(cells[1])])


def test_ends_outside_of_the_map_are_moved_in():
    route = LocalMap((0.0, 0.0), (20, 30)).route((-3.0, 0.5), (9.0, 5.0))
    np.testing.assert_allclose(route[[0, -1]], [(0.025, 0.525), (1.475, 0.975)])


def test_there_is_always_a_route():
    local_map = with_wall((5.0, 5.0))  # no gap
    route = local_map.route((0.5, 0.5), (1.5, 0.5))
    np.testing.assert_allclose(route[[0, -1]], [(0.525, 0.525), (1.525, 0.525)])
    assert (np.abs(route[:, 0] - 1.025) < 0.01).any()  # through the wall
    local_map.low[:] = True
    np.testing.assert_allclose(
        local_map.route((0.5, 0.5), (0.61, 0.5)), [(0.525, 0.525), (0.575, 0.525), (0.625, 0.525)]
    )
    np.testing.assert_allclose(local_map.route((0.5, 0.5), (0.5, 0.5)), [(0.525, 0.525)])
