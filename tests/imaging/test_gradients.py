"""Sobel equals OpenCV's; magnitude and direction follow their definitions."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imgproc_course.imaging import direction, gradient_angle, magnitude, sobel

APERTURES = (3, 5, 7)


def opencvs_sobel(gray, aperture):
    gray = gray.copy()
    down = cv2.Sobel(gray, cv2.CV_32F, 0, 1, ksize=aperture, borderType=cv2.BORDER_REPLICATE)
    right = cv2.Sobel(gray, cv2.CV_32F, 1, 0, ksize=aperture, borderType=cv2.BORDER_REPLICATE)
    return down.astype(np.int32), right.astype(np.int32)


def test_sobel_equals_opencvs(grays, gray_frames, count):
    for name, gray in {**grays, "frame": gray_frames[0]}.items():
        before = gray.copy()
        for aperture in APERTURES:
            for result, truth in zip(sobel(gray, aperture), opencvs_sobel(before, aperture), strict=True):
                count.compare(result, truth, (name, aperture))
        assert np.array_equal(gray, before), name
    count.report("sobel")


@settings(max_examples=100)
@given(
    gray=arrays.arrays(np.uint8, st.tuples(st.integers(1, 20), st.integers(1, 20))),
    aperture=st.sampled_from(APERTURES),
)
def test_sobel_equals_opencvs_on_any_image(gray, aperture):
    for result, truth in zip(sobel(gray, aperture), opencvs_sobel(gray, aperture), strict=True):
        assert np.array_equal(result, truth)


@pytest.mark.parametrize(("aperture", "steepest"), [(3, 4), (5, 48), (7, 640)])
def test_a_step_of_h_levels_has_the_magnitude_in_the_docstring(aperture, steepest):
    step = np.where(np.arange(20) < 10, 50, 60).astype(np.uint8)[None].repeat(20, axis=0)
    grad_row, grad_col = sobel(step, aperture)
    assert (grad_row == 0).all()
    assert grad_col.max() == grad_col[10, 9] == grad_col[10, 10] == 10 * steepest
    grad_row, grad_col = sobel(step.T, aperture)
    assert (grad_col == 0).all() and grad_row.max() == 10 * steepest


def test_the_norms_of_a_known_gradient():
    grad_row, grad_col = np.array([[3, -3, 0]]), np.array([[4, -4, -5]])
    assert magnitude(grad_row, grad_col).tolist() == [[7, 7, 5]]
    assert magnitude(grad_row, grad_col, "L2").tolist() == [[5.0, 5.0, 5.0]]
    assert magnitude(grad_row, grad_col, "L2 squared").tolist() == [[25, 25, 25]]
    assert magnitude(np.int16([[-32768]]), np.int16([[-32768]])).tolist() == [[65536]]


def test_direction_is_the_nearest_multiple_of_45_degrees():
    down, right = np.mgrid[-60:61, -60:61]
    nearest = np.round(gradient_angle(down, right) / 45).astype(int) % 4
    nearest[(down == 0) & (right == 0)] = 1
    assert np.array_equal(direction(down, right), nearest)


def test_the_sectors_of_known_gradients():
    down = np.array([[0, 0, 5, 5, -5, 0]])
    right = np.array([[9, -9, 0, 5, 5, 0]])
    assert direction(down, right).tolist() == [[0, 0, 2, 1, 3, 1]]
    assert gradient_angle(down, right).tolist() == [[0.0, 180.0, 90.0, 45.0, -45.0, 0.0]]


def test_an_unsigned_or_float_gradient_is_refused():
    whole, real = np.zeros((2, 2), np.int32), np.zeros((2, 2))
    for function in (magnitude, direction, gradient_angle):
        for pair in ((real, whole), (whole, real), (whole.astype(np.uint8), whole), (whole[0], whole[0])):
            with pytest.raises(
                ValueError, match=r"must be .* signed integers, got .*; take both gradients from sobel"
            ):
                function(*pair)
        with pytest.raises(ValueError, match="the same shape"):
            function(whole, whole[:1])
    with pytest.raises(ValueError, match=r"got 'l1'; cv2\.Canny takes"):
        magnitude(whole, whole, "l1")
