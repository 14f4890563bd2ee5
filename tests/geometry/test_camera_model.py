"""The camera model against OpenCV's."""

import math

import cv2
import numpy as np
import pytest

from imgproc_course.geometry import CameraModel

LENS = CameraModel(1280, 720, 705.0, 700.0, 639.5, 359.5, (-0.17, 0.035, 0.0004, -0.0003, 0.01))
POINTS = np.random.default_rng(1).uniform((-1, -0.6, 0.8), (1, 0.6, 4), (200, 3))


def test_projection_equals_opencv():
    expected, _ = cv2.projectPoints(POINTS, np.zeros(3), np.zeros(3), LENS.matrix, np.array(LENS.distortion))
    np.testing.assert_allclose(LENS.project(POINTS), expected[:, 0], atol=1e-9)


def test_what_lies_behind_the_camera_has_no_pixel():
    assert np.isnan(LENS.project([(0.1, 0.2, -1.0), (0.1, 0.2, 0.0)])).all()


def test_rays_lead_back_to_their_pixels():
    pixels = np.array([(0.0, 0.0), (1279, 719), (640.25, 12.5)])
    rays = LENS.unproject(pixels)
    assert (rays[:, 2] == 1).all()
    np.testing.assert_allclose(LENS.project(rays * 2.5), pixels, atol=1e-6)


def test_every_second_pixel_and_a_resized_image():
    small = LENS.resized(320, 180)
    np.testing.assert_allclose(small.every(2).rays(), small.rays()[::2, ::2], atol=1e-12)
    half = LENS.resized(640, 360).unproject((0, 0))
    np.testing.assert_allclose(half, LENS.unproject((0.5, 0.5)), atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0, 720, 705.0, 700.0, 1, 1), "got 0×720 pixels"),
        ((1280, 720, -705.0, 700.0, 1, 1), "fx -705.0"),
        ((1280, 720, math.nan, 700.0, 1, 1), "finite numbers, got nan, 700.0, 1, 1, 0.0, 0.0, 0.0, 0.0, 0.0"),
        ((1280, 720, 705.0, math.inf, 1, 1), "finite numbers, got 705.0, inf"),
        ((1280, 720, 705.0, 700.0, 1, math.nan), "finite"),
        ((1280, 720, 705.0, 700.0, 1, 1, (0, 0, math.nan, 0, 0)), "finite"),
        ((1280, 720, 705.0, 700.0, 1, 1, (0.1, 0.2)), r"5 numbers \(k1, k2, p1, p2, k3\), got 2"),
    ],
)
def test_impossible_cameras(arguments, message):
    with pytest.raises(ValueError, match=message):
        CameraModel(*arguments)
