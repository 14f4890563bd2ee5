"""The filters against OpenCV's, on every sample, border and size."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imgproc_course.imaging import (
    bilateral_filter,
    box_blur,
    gaussian_blur,
    gaussian_shares,
    gaussian_weights,
    median_blur,
)

SIZES = (1, 3, 5, 7, 9, 15, 31)
SIGMAS = (0.05, 0.3, 0.5, 0.84, 1, 1.4, 2, 3.7, 8, 25)
PICTURES = arrays.arrays(np.uint8, st.tuples(st.integers(1, 20), st.integers(1, 40)))


def layouts(grays, colours, frames, gray_frames):
    return {
        **grays,
        **{f"colour {k}": v for k, v in colours.items()},
        "frame": gray_frames[1],
        "bgr": frames[2],
    }


def test_box_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, picture in layouts(grays, colours, frames, gray_frames).items():
        before = picture.copy()
        for size in SIZES:
            count.compare(box_blur(picture, size), cv2.blur(before, (size, size)), (name, size))
        assert np.array_equal(picture, before), name
    count.report("box_blur")


def test_gaussian_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, picture in layouts(grays, colours, frames, gray_frames).items():
        before = picture.copy()
        for sigma in SIGMAS:
            count.compare(
                gaussian_blur(picture, sigma), cv2.GaussianBlur(before, (0, 0), sigma), (name, sigma)
            )
        assert np.array_equal(picture, before), name
    count.report("gaussian_blur by sigma")


def test_gaussian_of_a_size_equals_opencvs(grays, count):
    for name, picture in grays.items():
        before = picture.copy()
        for size in SIZES:
            for sigma in (0, 2.2):
                truth = cv2.GaussianBlur(before, (size, size), sigma)
                count.compare(gaussian_blur(picture, sigma, size), truth, (name, size, sigma))
    count.report("gaussian_blur by size")


def test_gaussian_weights_equal_opencvs_for_many_sigmas(count):
    for sigma in [*np.arange(0.05, 40, 0.043), *np.random.default_rng(0).uniform(0.1, 8, 1000)]:
        weights = gaussian_weights(sigma)
        lone = np.zeros((1, 2 * len(weights) + 1), np.uint8)
        lone[0, len(weights)] = 255
        seen = np.zeros(lone.shape, np.uint8)
        middle = slice(len(weights) - len(weights) // 2, len(weights) + len(weights) // 2 + 1)
        seen[0, middle] = [(weight * 255 + 128) >> 8 for weight in weights]
        assert sum(weights) == 256
        count.compare(seen, cv2.GaussianBlur(lone, (0, 0), sigma), sigma)
    count.report("gaussian_weights")


def test_gaussian_shares_equal_opencvs_kernel_in_float32(count):
    for size in range(1, 202, 2):
        for sigma in (0, 0.7, 1.3, 5, 20):
            truth = cv2.getGaussianKernel(size, sigma, cv2.CV_32F).ravel()
            count.compare(np.array(gaussian_shares(sigma, size), np.float32), truth, (size, sigma))
    count.report("gaussian_shares")


def test_median_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, picture in layouts(grays, colours, frames, gray_frames).items():
        before = picture.copy()
        for size in (3, 5, 7) if picture.size > 100_000 else SIZES:
            count.compare(median_blur(picture, size), cv2.medianBlur(before, size), (name, size))
        assert np.array_equal(picture, before), name
    count.report("median_blur")


@settings(max_examples=150, deadline=None)
@given(picture=PICTURES, size=st.sampled_from(SIZES), sigma=st.floats(0.05, 10))
def test_filters_equal_opencvs_on_any_picture(picture, size, sigma):
    assert np.array_equal(box_blur(picture, size), cv2.blur(picture, (size, size)))
    assert np.array_equal(median_blur(picture, size), cv2.medianBlur(picture, size))
    assert np.array_equal(gaussian_blur(picture, sigma), cv2.GaussianBlur(picture, (0, 0), sigma))


def test_one_wild_pixel_moves_the_mean_but_not_the_median():
    picture = np.full((3, 3), 100, np.uint8)
    picture[1, 1] = 255
    assert box_blur(picture)[1, 1] == round((8 * 100 + 255) / 9) == 117
    assert median_blur(picture)[1, 1] == 100
    assert gaussian_blur(picture, 0, 3)[1, 1] == (12 * 100 + 4 * 255 + 8) // 16


@pytest.fixture
def without_ipp():
    """OpenCV's own code: its wheels for x86 hand some filters to Intel's IPP."""
    before = cv2.ipp.useIPP()
    cv2.ipp.setUseIPP(False)
    yield
    cv2.ipp.setUseIPP(before)


BILATERAL = [(25, 3, None), (10, 1, None), (30, 2, 5), (60, 3, 3), (60, 3, 7), (20, 5, 9), (40, 1.5, None)]


def test_bilateral_equals_opencvs_but_for_ties(grays, gray_frames, without_ipp):
    pixels = loose = 0
    for name, picture in {**grays, "frame": gray_frames[0][:300]}.items():
        before = picture.copy()
        for sigma_color, sigma_space, size in BILATERAL:
            truth = cv2.bilateralFilter(before, size or 0, sigma_color, sigma_space).astype(int)
            off = np.abs(bilateral_filter(picture, sigma_color, sigma_space, size) - truth)
            assert off.max() <= 1, name
            pixels, loose = pixels + off.size, loose + (off > 0).sum()
        assert np.array_equal(picture, before), name
    print(f"bilateral_filter: {pixels:,} pixels, one level off in {loose}")
    assert loose <= pixels / 10_000


def test_bilateral_is_at_most_one_level_brighter_than_with_ipp(grays):
    for name, picture in grays.items():
        for sigma_color, sigma_space, size in BILATERAL:
            truth = cv2.bilateralFilter(picture.copy(), size or 0, sigma_color, sigma_space).astype(int)
            off = bilateral_filter(picture, sigma_color, sigma_space, size) - truth
            assert off.min() >= -1 and off.max() <= 1, name
            # IPP drops the fraction where others round: it is never the brighter one, but for ties.
            assert (off < 0).sum() <= off.size / 1000, name


def test_bilateral_keeps_a_step_that_a_gaussian_loses():
    step = np.where(np.arange(20) < 10, 50, 200).astype(np.uint8)[None].repeat(9, axis=0)
    assert np.array_equal(bilateral_filter(step, 10, 3), step)
    assert gaussian_blur(step, 3)[4, 9] > 100
