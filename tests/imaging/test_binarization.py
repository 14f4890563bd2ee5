"""The thresholds equal OpenCV's, also with ties and rounding."""

from fractions import Fraction

import cv2
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imgproc_course.imaging import adaptive_threshold, otsu_threshold, threshold

MEAN = cv2.ADAPTIVE_THRESH_MEAN_C


def opencvs_otsu(gray, *, ipp=False):
    """By OpenCV's own code, or by Intel's IPP, which its wheels call on x86-64 unless it is switched off."""
    was_used = cv2.ipp.useIPP()
    cv2.ipp.setUseIPP(ipp)
    try:
        return int(cv2.threshold(gray.copy(), 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)[0])
    finally:
        cv2.ipp.setUseIPP(was_used)


def exact_variance(gray, level):
    """The between-class variance as a fraction, without rounding."""
    values = gray.ravel().tolist()
    dark, bright = [v for v in values if v <= level], [v for v in values if v > level]
    if not dark or not bright:
        return Fraction(0)
    difference = Fraction(sum(dark), len(dark)) - Fraction(sum(bright), len(bright))
    return Fraction(len(dark) * len(bright), len(values) ** 2) * difference**2


def test_fixed_threshold_equals_opencvs(grays, gray_frames, count):
    for name, gray in {**grays, "frame": gray_frames[0]}.items():
        before = gray.copy()
        for level in (-1, 0, 0.5, 76, 77, 127, 127.9, 254, 254.9, 255, 300):
            truth = cv2.threshold(before, level, 255, cv2.THRESH_BINARY)[1]
            count.compare(threshold(gray, level), truth, (name, level))
        assert np.array_equal(gray, before), name
    count.report("threshold")


def test_a_level_outside_the_integer_range_is_still_compared_correctly():
    # OpenCV casts the level to an int. It wraps here, so that every pixel counts as brighter than 1e20.
    gray = np.array([[0, 255]], np.uint8)
    assert threshold(gray, 1e20).tolist() == threshold(gray, np.inf).tolist() == [[0, 0]]
    assert threshold(gray, -1e20).tolist() == [[255, 255]]


def test_otsu_equals_opencvs(grays, gray_frames, count):
    for name, gray in [*grays.items(), *enumerate(gray_frames)]:
        before = gray.copy()
        count.compare(otsu_threshold(gray), opencvs_otsu(gray), name)
        count.compare(otsu_threshold(gray), opencvs_otsu(gray, ipp=True), (name, "IPP"))
        assert np.array_equal(gray, before), name
    count.report("otsu_threshold on images")


def test_otsu_equals_opencvs_where_levels_tie(count):
    rng = np.random.default_rng(5)
    for k in range(3000):
        levels = rng.integers(0, 256, rng.integers(1, 6))
        gray = rng.choice(levels, rng.integers(1, 40, 2)).astype(np.uint8)
        count.compare(otsu_threshold(gray), opencvs_otsu(gray), k)
    count.report("otsu_threshold with ties")


@settings(max_examples=200)
@given(gray=arrays.arrays(np.uint8, st.tuples(st.integers(1, 30), st.integers(1, 30))))
def test_otsu_equals_opencvs_on_any_image(gray):
    assert otsu_threshold(gray) == opencvs_otsu(gray)


def test_ipp_decides_another_way_only_between_equally_good_levels():
    triples = [
        np.array([[low, low + step, low + 2 * step]], np.uint8) for low in range(100) for step in (9, 50, 77)
    ]
    for gray in triples:  # both levels between the three pixels are equally good
        level, ipps_level = otsu_threshold(gray), opencvs_otsu(gray, ipp=True)
        assert level == opencvs_otsu(gray)
        assert exact_variance(gray, level) == exact_variance(gray, ipps_level) > 0
    gray = np.array([[20, 30, 200]], np.uint8)
    assert exact_variance(gray, otsu_threshold(gray)) > exact_variance(gray, 20)


def test_adaptive_threshold_equals_opencvs(grays, gray_frames, count):
    for name, gray in {**grays, "frame": gray_frames[0]}.items():
        before = gray.copy()
        for size in (3, 7, 9, 11, 31, 101):
            for offset in (-300, -7.5, -1, 0, 0.5, 2, 7, 300):
                truth = cv2.adaptiveThreshold(before, 255, MEAN, cv2.THRESH_BINARY, size, offset)
                count.compare(adaptive_threshold(gray, size, offset), truth, (name, size, offset))
        assert np.array_equal(gray, before), name
    count.report("adaptive_threshold")
