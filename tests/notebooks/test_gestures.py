"""The lesson "Gestures": its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
from scipy.ndimage import label

from imgproc_course.simulation import hand_mask, random_hand


def all_points_of_outline(mask):
    contours, _ = cv2.findContours(mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    return max(contours, key=cv2.contourArea)[:, 0]


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
