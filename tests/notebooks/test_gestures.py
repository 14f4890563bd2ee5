"""The lesson "Gestures": its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
import pytest
from scipy.ndimage import label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from imgproc_course.simulation import GESTURES, gesture_track, hand_mask, random_hand


def all_points_of_outline(mask):
    contours, _ = cv2.findContours(mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    return max(contours, key=cv2.contourArea)[:, 0]


def from_the_left(corners):
    """The corners of cv2.convexHull, with the first corner of the lesson first."""
    return np.roll(corners, -np.lexsort((corners[:, 1], corners[:, 0]))[0], axis=0).tolist()


def test_convex_hull_is_opencvs_in_its_order(solutions):
    rng = np.random.default_rng(0)
    sets = [np.unique(rng.integers(0, 100, (rng.integers(5, 60), 2)), axis=0) for _ in range(250)]
    sets += [np.unique(rng.integers(0, 6, (20, 2)), axis=0) for _ in range(40)]  # many on straight sides
    sets += [np.argwhere(hand_mask(random_hand(rng, i % 6)))[:, ::-1] for i in range(10)]
    for points in sets:
        tool = cv2.convexHull(points.astype(np.int32)[:, None])[:, 0]
        assert solutions["convex_hull"](rng.permutation(points)).tolist() == from_the_left(tool)


def test_deepest_points_are_opencvs_convexity_defects(solutions):
    rng = np.random.default_rng(1)
    compared = 0
    for i in range(30):
        contour = all_points_of_outline(hand_mask(random_hand(rng, i % 6, (90, 120)), (90, 120)))
        contour = np.roll(contour, int(rng.integers(len(contour))), axis=0)
        defects = cv2.convexityDefects(contour, cv2.convexHull(contour, returnPoints=False))
        for start, end, far, depth in defects.reshape(-1, 4):
            place, distance = solutions["deepest_point"](contour.astype(int), int(start), int(end))
            assert place == far and abs(distance - depth / 256) < 1 / 256
            compared += depth > 5 * 256
    assert compared > 60


def test_count_runs_counts_the_components_on_a_closed_way(solutions):
    rng = np.random.default_rng(2)
    counts = []
    for _ in range(200):
        values = rng.random(int(rng.integers(4, 40))) < 0.5
        values[rng.integers(len(values))] = False
        mask, rows, cols = (
            np.ones((6, 6), np.uint8),
            rng.integers(-3, 9, len(values)),
            rng.integers(-3, 9, len(values)),
        )
        inside = (rows >= 0) & (rows < 6) & (cols >= 0) & (cols < 6)
        rows[values], cols[values] = rng.integers(0, 6, (2, values.sum()))
        rows[~values & inside] = 6
        start = int(np.flatnonzero(~values)[0])  # an open way that begins with a zero has the same runs
        counts.append(label(np.roll(values, -start))[1])
        assert solutions["count_runs"](mask, rows, cols) == counts[-1]
    assert max(counts) > 6


def cheapest_path(track, other):
    """The cost of the cheapest pairing as the shortest path of a graph whose nodes are the pairs."""
    distances = np.linalg.norm(track[:, None] - other, axis=2)
    number = np.arange(distances.size).reshape(distances.shape)
    edges = [
        (
            number[: -row or None, : -col or None].ravel(),
            number[row:, col:].ravel(),
            distances[row:, col:].ravel(),
        )
        for row, col in ((1, 0), (0, 1), (1, 1))
    ]
    start, end, weight = (np.concatenate(part) for part in zip(*edges, strict=True))
    graph = coo_array((weight, (start, end)), (distances.size, distances.size)).tocsr()
    return distances[0, 0] + dijkstra(graph, indices=0)[-1]


def test_dtw_is_the_shortest_path_through_all_pairs(solutions):
    rng = np.random.default_rng(3)
    for i in range(30):
        tracks = gesture_track(GESTURES[i % 6], rng, uneven=1), gesture_track(GESTURES[i // 6 % 6], rng)
        assert solutions["dtw_cost"](*tracks) == pytest.approx(cheapest_path(*tracks), abs=1e-9)
