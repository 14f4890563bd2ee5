"""The filters equal OpenCV's on every sample, border and size."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imgproc_course.imaging import bilateral_filter, box_blur, gaussian_blur, median_blur

SIZES = (1, 3, 5, 7, 9, 15, 31)
SIGMAS = (0.05, 0.3, 0.5, 0.84, 1, 1.4, 2, 3.7, 8, 25)
IMAGES = arrays.arrays(np.uint8, st.tuples(st.integers(1, 20), st.integers(1, 40)))


def all_images(grays, colours, frames, gray_frames):
    return {
        **grays,
        **{f"colour {k}": v for k, v in colours.items()},
        "frame": gray_frames[1],
        "bgr": frames[2],
    }


def test_box_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, image in all_images(grays, colours, frames, gray_frames).items():
        before = image.copy()
        for size in SIZES:
            count.compare(box_blur(image, size), cv2.blur(before, (size, size)), (name, size))
        assert np.array_equal(image, before), name
    count.report("box_blur")


def test_gaussian_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, image in all_images(grays, colours, frames, gray_frames).items():
        before = image.copy()
        for sigma in SIGMAS:
            count.compare(gaussian_blur(image, sigma), cv2.GaussianBlur(before, (0, 0), sigma), (name, sigma))
        assert np.array_equal(image, before), name
    count.report("gaussian_blur by sigma")


def test_gaussian_of_an_impulse_equals_opencvs_for_many_sigmas_and_sizes(count):
    impulse = np.zeros((1, 401), np.uint8)
    impulse[0, 200] = 255
    sigmas = [*np.arange(0.05, 40, 0.043), *np.random.default_rng(0).uniform(0.1, 8, 1000)]
    cases = [(sigma, 0) for sigma in sigmas]
    cases += [(sigma, size) for size in range(1, 202, 2) for sigma in (0, 0.7, 1.3, 5, 20)]
    for sigma, size in cases:
        truth = cv2.GaussianBlur(impulse, (size, size), sigma)
        count.compare(gaussian_blur(impulse, sigma, size or None), truth, (sigma, size))
    count.report("gaussian_blur of an impulse")


def test_median_equals_opencvs(grays, colours, frames, gray_frames, count):
    for name, image in all_images(grays, colours, frames, gray_frames).items():
        before = image.copy()
        for size in (3, 5, 7) if image.size > 100_000 else SIZES:
            count.compare(median_blur(image, size), cv2.medianBlur(before, size), (name, size))
        assert np.array_equal(image, before), name
    count.report("median_blur")


@settings(max_examples=150)
@given(image=IMAGES, size=st.sampled_from(SIZES), sigma=st.floats(0.05, 10))
def test_filters_equal_opencvs_on_any_image(image, size, sigma):
    assert np.array_equal(box_blur(image, size), cv2.blur(image, (size, size)))
    assert np.array_equal(median_blur(image, size), cv2.medianBlur(image, size))
    assert np.array_equal(gaussian_blur(image, sigma), cv2.GaussianBlur(image, (0, 0), sigma))


@pytest.fixture
def without_ipp():
    """Make OpenCV use its own code: its wheels for x86 compute some filters with Intel's IPP."""
    ipp_before = cv2.ipp.useIPP()
    cv2.ipp.setUseIPP(False)
    yield
    cv2.ipp.setUseIPP(ipp_before)


BILATERAL = [(25, 3, None), (10, 1, None), (30, 2, 5), (60, 3, 3), (60, 3, 7), (20, 5, 9), (40, 1.5, None)]


def test_bilateral_equals_opencvs_except_for_ties(grays, gray_frames, without_ipp):
    pixels = differing = 0
    for name, image in {**grays, "frame": gray_frames[0][:300]}.items():
        before = image.copy()
        for sigma_color, sigma_space, size in BILATERAL:
            truth = cv2.bilateralFilter(before, size or 0, sigma_color, sigma_space).astype(int)
            error = np.abs(bilateral_filter(image, sigma_color, sigma_space, size) - truth)
            assert error.max() <= 1, name
            pixels, differing = pixels + error.size, differing + (error > 0).sum()
        assert np.array_equal(image, before), name
    print(f"bilateral_filter: {pixels:,} pixels, one level off in {differing}")
    assert differing <= pixels / 10_000


def test_bilateral_is_at_most_one_level_brighter_than_with_ipp(grays):
    for name, image in grays.items():
        for sigma_color, sigma_space, size in BILATERAL:
            truth = cv2.bilateralFilter(image.copy(), size or 0, sigma_color, sigma_space).astype(int)
            error = bilateral_filter(image, sigma_color, sigma_space, size) - truth
            assert error.min() >= -1 and error.max() <= 1, name
            # IPP drops the fraction instead of rounding: except for ties it is never brighter.
            assert (error < 0).sum() <= error.size / 1000, name
