"""The lesson "Faces": its solutions give what the field's tools give, on many inputs."""

import cv2
import numpy as np
import pytest

from imgproc_course.imaging import to_gray
from imgproc_course.simulation import draw_face, random_identity


@pytest.fixture(scope="module")
def faces():
    """Gray images of drawn people, of many sizes, lights and turns."""
    rng = np.random.default_rng(0)
    return [
        to_gray(draw_face(random_identity(rng), int(rng.integers(30, 90)), *rng.uniform(-0.5, 0.5, 2)))
        for _ in range(20)
    ]


def test_integral_image_is_opencvs(solutions, faces):
    for gray in faces:
        np.testing.assert_array_equal(solutions["integral_image"](gray), cv2.integral(gray))


def test_the_mosaic_is_opencvs_resize(solutions):
    rng = np.random.default_rng(2)
    for size in (2, 3, 5, 8):
        frame = rng.integers(0, 256, (60, 70, 3), dtype=np.uint8)
        left, top, columns, rows = rng.integers(1, 6, 4).tolist()
        result = solutions["hide_boxes"](frame, [(left, top, columns * size, rows * size)], size)
        part = np.s_[top : top + rows * size, left : left + columns * size]
        small = cv2.resize(frame[part], (columns, rows), interpolation=cv2.INTER_AREA)
        tool = frame.copy()
        tool[part] = cv2.resize(small, (columns * size, rows * size), interpolation=cv2.INTER_NEAREST)
        assert abs(result.astype(int) - tool).max() <= 1
        assert (result[part] != frame[part]).mean() > 0.9


def test_a_box_over_the_border_leaves_nothing_of_it_visible(solutions):
    frame = np.random.default_rng(3).integers(0, 256, (20, 30, 3), dtype=np.uint8)
    result = solutions["hide_boxes"](frame, [(-4, -6, 12, 11), (25, 15, 20, 20)], 100)
    np.testing.assert_array_equal(np.unique(result[:5, :8].reshape(-1, 3), axis=0).shape, (1, 3))
    np.testing.assert_array_equal(np.unique(result[15:, 25:].reshape(-1, 3), axis=0).shape, (1, 3))
    kept = np.ones((20, 30), bool)
    kept[:5, :8] = kept[15:, 25:] = False
    np.testing.assert_array_equal(result[kept], frame[kept])
