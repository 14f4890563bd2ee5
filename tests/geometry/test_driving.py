"""From what a robot sees to a direction and a speed: each function against a plain definition of it."""

import math

import numpy as np
import pytest

from imgproc_course.geometry import choose_direction, compose_poses, free_way, map_to_odom, safe_speed


def test_the_frame_of_the_odometry_composed_with_what_it_counts_is_the_place():
    assert map_to_odom((1.0, 3.0, math.pi), (2.0, 0.0, math.pi / 2)) == pytest.approx((1, 1, math.pi / 2))
    rng = np.random.default_rng(0)
    for _ in range(500):
        place, counted = rng.uniform((-5, -5, -math.pi), (5, 5, math.pi), (2, 3))
        frame = map_to_odom(place, counted)
        assert frame.dtype == np.float64 and -math.pi <= frame[2] <= math.pi
        x, y, yaw = compose_poses(frame, counted) - place
        assert math.hypot(x, y) < 1e-12 and abs(math.remainder(yaw, 2 * math.pi)) < 1e-12


def test_a_free_way_is_that_of_points_turned_one_by_one():
    rng = np.random.default_rng(1)
    ways = []
    for _ in range(300):
        points = rng.uniform(-3, 3, (12, 2))
        direction, width = float(rng.uniform(-math.pi, math.pi)), float(rng.uniform(0.1, 0.6))
        nearest = math.inf
        for x, y in points.tolist():
            turned = math.hypot(x, y) * np.exp(1j * (math.atan2(y, x) - direction))
            if turned.real > 0 and abs(turned.imag) <= width / 2:
                nearest = min(nearest, turned.real)
        ways.append(free_way(points, direction, width))
        assert ways[-1] == pytest.approx(nearest, abs=1e-12)
    assert 50 < ways.count(math.inf) < 250
    assert free_way(np.empty((0, 2)), 0.0, 0.3) == math.inf


@pytest.mark.parametrize("points", [(1.0, 2.0), [(1.0, 2.0, 3.0)], []])
def test_what_are_no_points(points):
    with pytest.raises(ValueError, match=r"points are \(N, 2\), ahead and left"):
        free_way(points, 0.0, 0.3)


def test_the_safe_speed_is_the_inverse_of_the_stopping_distance():
    rng = np.random.default_rng(2)
    for _ in range(1000):
        speed, reaction, deceleration = rng.uniform((0.01, 0, 0.2), (3, 1, 4)).tolist()
        free = reaction * speed + speed**2 / (2 * deceleration)
        assert safe_speed(free, reaction, deceleration, 5.0) == pytest.approx(speed, abs=1e-12)
        assert safe_speed(free, reaction, deceleration, 0.9 * speed) == 0.9 * speed


def test_the_safe_speed_at_both_ends():
    assert [safe_speed(free, 0.2, 0.6, 0.3) for free in (-1.0, 0.0, -math.inf)] == [0.0, 0.0, 0.0]
    assert safe_speed(1e-9, 0.2, 0.6, 0.3) == pytest.approx(5e-9, rel=1e-6)  # reaction alone
    assert [safe_speed(free, 0.2, 0.6, 0.3) for free in (100.0, math.inf)] == [0.3, 0.3]
    assert safe_speed(0.3, 0.0, 0.6, 5.0) == 0.6


@pytest.mark.parametrize(
    ("reaction", "deceleration"), [(-0.1, 0.6), (0.2, 0.0), (0.2, -1.0), (math.nan, 0.6)]
)
def test_a_robot_that_cannot_brake(reaction, deceleration):
    with pytest.raises(ValueError, match=f"above 0 m/s², got {reaction} and {deceleration}"):
        safe_speed(1.0, reaction, deceleration, 0.3)


def angle_between(first, second):
    """Of two directions, by the vectors that point to them: no angle is wrapped."""
    a, b = (np.array([math.cos(angle), math.sin(angle)]) for angle in (first, second))
    return math.atan2(abs(a[0] * b[1] - a[1] * b[0]), a @ b)


def test_the_direction_is_the_nearest_by_brute_force():
    rng = np.random.default_rng(3)
    chosen = []
    for _ in range(1000):
        directions = rng.uniform(-math.pi, math.pi, rng.integers(0, 13))
        ways = rng.choice([0.2, 0.5, 0.8, 1.3, math.inf], len(directions))
        goal, need = float(rng.uniform(-math.pi, math.pi)), float(rng.choice([0.5, 0.8, 1.5]))
        nearest = None
        for direction, way in zip(directions.tolist(), ways, strict=True):
            is_nearer = nearest is None or angle_between(direction, goal) < angle_between(nearest, goal)
            nearest = direction if way >= need and is_nearer else nearest
        chosen.append(choose_direction(directions, ways, goal, need))
        assert chosen[-1] == nearest
    assert 50 < chosen.count(None) < 500


def test_the_first_of_two_equally_near_directions():
    assert choose_direction([0.4, -0.4], [1.0, 1.0], 0.0, 1.0) == 0.4
    assert choose_direction([-0.4, 0.4], [1.0, 1.0], 0.0, 1.0) == -0.4
    assert choose_direction([0.4, -0.4], [1.0, 0.9], 0.0, 1.0) == 0.4


@pytest.mark.parametrize(
    ("directions", "ways", "shapes"),
    [([0.1, 0.2], [1.0], r"\(2,\) and \(1,\)"), ([[0.1]], [[1.0]], r"\(1, 1\) and \(1, 1\)")],
)
def test_directions_without_ways(directions, ways, shapes):
    with pytest.raises(ValueError, match=rf"directions and ways are \(N,\), got shapes {shapes}"):
        choose_direction(directions, ways, 0.0, 1.0)
