"""Both versions of Canny equal cv2.Canny on every pixel; each stage follows its rule on small arrays."""

import itertools

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from imgproc_course.imaging import (
    CannyStages,
    canny,
    canny_stages,
    double_threshold,
    gaussian_blur,
    hysteresis,
    suppress,
)
from imgproc_course.imaging.canny import canny_gradient, threshold_in_unit

APERTURES = (3, 5, 7)
STRONGEST = {3: 1020, 5: 12240, 7: 163200}  # gradient of a step from black to white

# Pairs of thresholds, as shares of the strongest gradient of the aperture.
SHARES = [(0, 0), (0, 0.1), (0.05, 0.15), (0.1, 0.2), (0.3, 0.3), (0.5, 1), (1, 2), (-0.1, 0.1), (-1, -0.5)]
ODD_THRESHOLDS = [
    (99.5, 100.5),
    (99.999, 100),
    (3, 3),
    (0.4, 0.6),
    (180.5, 181.5),
    (-0.5, 0),
    (32766.5, 32767),
]
HUGE_THRESHOLDS = [(100, 32768), (40000, 50000), (100, 1e9), (-1e9, 200)]


def opencvs_canny(gray, low, high, sigma, aperture, l2_gradient):
    if sigma > 0:
        gray = cv2.GaussianBlur(gray, (0, 0), sigma)
    return cv2.Canny(gray, low, high, apertureSize=aperture, L2gradient=l2_gradient)


def compare_both(gray, low, high, count, case, **options):
    truth = opencvs_canny(gray.copy(), low, high, **options)
    count.compare(canny(gray, low, high, **options), truth, (case, low, high, options))
    count.compare(canny_stages(gray, low, high, **options).edges, truth, (case, low, high, options, "stages"))


def apertures_and_norms():
    return itertools.product(APERTURES, (False, True))


def test_canny_equals_opencvs_on_samples(grays, opencv_threads, count):
    for (name, gray), (aperture, l2) in itertools.product(grays.items(), apertures_and_norms()):
        before = gray.copy()
        for low, high in SHARES:
            low, high = low * STRONGEST[aperture], high * STRONGEST[aperture]
            compare_both(gray, low, high, count, name, sigma=0, aperture=aperture, l2_gradient=l2)
        assert np.array_equal(gray, before), name
    count.report(f"canny and canny_stages on samples ({opencv_threads} threads)")


def test_canny_equals_opencvs_for_odd_thresholds(grays, count):
    for (name, gray), (aperture, l2) in itertools.product(grays.items(), apertures_and_norms()):
        for low, high in ODD_THRESHOLDS + HUGE_THRESHOLDS:
            compare_both(gray, low, high, count, name, sigma=0, aperture=aperture, l2_gradient=l2)
    count.report("canny and canny_stages, thresholds with fractions, below zero, huge")


def test_canny_equals_opencvs_after_a_gaussian(grays, count):
    for (name, gray), (aperture, l2) in itertools.product(grays.items(), apertures_and_norms()):
        for sigma in (0.3, 0.84, 1.4, 3):
            low, high = 0.05 * STRONGEST[aperture], 0.15 * STRONGEST[aperture]
            compare_both(gray, low, high, count, name, sigma=sigma, aperture=aperture, l2_gradient=l2)
    count.report("canny and canny_stages, smoothed")


def test_canny_equals_opencvs_on_the_drive(gray_frames, opencv_threads, count):
    for k, gray in enumerate(gray_frames):
        for low, high, sigma in ((50, 150, 0), (100, 200, 0), (20, 60, 1.4)):
            compare_both(gray, low, high, count, k, sigma=sigma, aperture=3, l2_gradient=False)
    for aperture, l2 in apertures_and_norms():
        low, high = 0.05 * STRONGEST[aperture], 0.15 * STRONGEST[aperture]
        compare_both(gray_frames[2], low, high, count, 2, sigma=0, aperture=aperture, l2_gradient=l2)
    count.report(f"canny and canny_stages on the drive ({opencv_threads} threads)")


@settings(max_examples=400)
@given(
    gray=st.one_of(
        arrays.arrays(np.uint8, st.tuples(st.integers(1, 24), st.integers(1, 24))),
        arrays.arrays(
            np.uint8, st.tuples(st.integers(1, 24), st.integers(17, 70)), elements=st.integers(0, 3)
        ),
    ),
    gain=st.integers(1, 85),
    shares=st.tuples(st.floats(-0.1, 1.5), st.floats(-0.1, 1.5)).map(sorted),
    rounded=st.booleans(),
    sigma=st.sampled_from([0, 0.5, 1.0, 1.7]),
    aperture=st.sampled_from(APERTURES),
    l2=st.booleans(),
)
def test_canny_equals_opencvs_on_any_image(gray, gain, shares, rounded, sigma, aperture, l2):
    gray = (gray * np.uint8(gain)).astype(np.uint8)  # wraps around: this is also a valid image
    low, high = (share * STRONGEST[aperture] for share in shares)
    if rounded:
        low, high = round(low), round(high)
    options = {"sigma": sigma, "aperture": aperture, "l2_gradient": l2}
    truth = opencvs_canny(gray, low, high, **options)
    assert np.array_equal(canny(gray, low, high, **options), truth)
    assert np.array_equal(canny_stages(gray, low, high, **options).edges, truth)


def test_a_threshold_outside_the_integer_range_gives_no_edges():
    # cv2.Canny casts thresholds to int, which wraps from 2**31 on: with L1 every pixel is then an edge.
    rng = np.random.default_rng(0)
    noise = rng.integers(0, 256, (30, 30), dtype=np.uint8)
    for low, high in ((1e10, 1e11), (np.inf, np.inf), (2.0**31, 2.0**31)):
        assert not canny(noise, low, high).any()
        assert not canny_stages(noise, low, high).edges.any()
    assert np.array_equal(canny(noise, -np.inf, 100), canny(noise, 0, 100))


@pytest.mark.parametrize("aperture", APERTURES)
@pytest.mark.parametrize("l2_gradient", [False, True])
def test_the_stages_are_as_documented(gray_frames, aperture, l2_gradient):
    gray = gray_frames[1][200:400, 300:700]
    low, high = 0.05 * STRONGEST[aperture], 0.15 * STRONGEST[aperture]
    stages = canny_stages(gray, low, high, sigma=1.0, aperture=aperture, l2_gradient=l2_gradient)
    dtypes = {
        "smoothed": np.uint8,
        "grad_row": np.int32,
        "grad_col": np.int32,
        "magnitude": np.int64 if l2_gradient else np.int32,
        "direction": np.uint8,
        "thinned": np.int64 if l2_gradient else np.int32,
        "weak": np.bool_,
        "strong": np.bool_,
        "edges": np.uint8,
    }
    assert CannyStages._fields == tuple(dtypes)
    assert {name: getattr(stages, name).dtype.type for name in dtypes} == dtypes
    assert all(stage.shape == gray.shape for stage in stages)
    if l2_gradient:
        assert np.array_equal(
            stages.magnitude, stages.grad_row.astype(int) ** 2 + stages.grad_col.astype(int) ** 2
        )
    else:
        assert np.array_equal(stages.magnitude, abs(stages.grad_row) + abs(stages.grad_col))
    assert set(np.unique(stages.thinned[stages.thinned != stages.magnitude])) == {0}
    assert stages.weak.any() and stages.strong.any() and not (stages.weak & stages.strong).any()
    edges = stages.edges == 255
    assert edges[stages.strong].all() and (stages.weak | stages.strong)[edges].all()
    assert set(np.unique(stages.edges)) == {0, 255}
    # Every stage is the result of its function on the stages before it.
    assert np.array_equal(stages.smoothed, gaussian_blur(gray, 1.0))
    assert np.array_equal(stages.grad_row, canny_gradient(stages.smoothed, aperture)[0])
    assert np.array_equal(stages.thinned, suppress(stages.magnitude, stages.direction))
    in_unit = [threshold_in_unit(value, aperture, l2_gradient) for value in (low, high)]
    weak, strong = double_threshold(stages.thinned, *in_unit)
    assert np.array_equal(stages.weak, weak) and np.array_equal(stages.strong, strong)
    assert np.array_equal(stages.edges, hysteresis(stages.weak, stages.strong))


def test_the_smoothed_stage_never_shares_memory_with_the_input():
    gray = np.full((5, 5), 9, np.uint8)
    assert not np.shares_memory(canny_stages(gray, 1, 2).smoothed, gray)


def test_aperture_7_gradients_are_sixteenths_with_halves_rounded_to_even():
    gray = np.zeros((1, 9), np.uint8)
    gray[0, 4] = 1
    # 64 (sum of the smoothing kernel) times 1 4 5 0 -5 -4 -1, over 16: exact. At a corner there are halves.
    assert canny_gradient(gray, 7)[1].tolist() == [[0, 4, 16, 20, 0, -20, -16, -4, 0]]
    corner = np.zeros((9, 9), np.uint8)
    corner[0, 0] = 1
    right = canny_gradient(corner, 7)[1]
    assert right[3].tolist() == [round(-k / 16) for k in (10, 10, 5, 1, 0, 0, 0, 0, 0)]
    assert round(-0.5) == 0 and round(-1.5) == -2


def test_magnitude_0_is_never_an_edge_even_if_thresholds_are_negative():
    assert not np.any(double_threshold(np.zeros((2, 2), int), -5, -3))
    weak, strong = double_threshold(np.array([[0, 1, 2]]), -5, 1)
    assert weak.tolist() == [[False, True, False]] and strong.tolist() == [[False, False, True]]


def test_the_stages_accept_lists_of_numbers():
    assert suppress([[1, 5, 1]], [[0, 0, 0]]).tolist() == [[0, 5, 0]]
    assert double_threshold([[1, 5, 1]], 2, 6)[0].tolist() == [[False, True, False]]
    assert hysteresis([[False, True, False]], [[True, False, False]]).tolist() == [[255, 255, 0]]


def test_hysteresis_follows_a_chain_of_any_length():
    spiral = np.zeros((61, 61), np.uint8)
    for ring in range(0, 30, 4):
        cv2.rectangle(spiral, (ring, ring), (60 - ring, 60 - ring), 1)
        spiral[ring + 1, ring] = 0
        spiral[ring + 2 : ring + 4, ring + 1] = 1
        spiral[ring + 2, ring : ring + 2] = 1
    strong = np.zeros(spiral.shape, bool)
    strong[0, 60] = True
    truth = cv2.connectedComponents(spiral, connectivity=8)[1]
    assert np.array_equal(hysteresis((spiral == 1) & ~strong, strong) == 255, truth == truth[0, 60])


def test_arrays_that_do_not_belong_together_are_refused():
    zeros = np.zeros((3, 3), int)
    with pytest.raises(ValueError, match="the same shape"):
        suppress(zeros, np.zeros((3, 2), np.uint8))
    with pytest.raises(ValueError, match="the same shape"):
        suppress([1, 2], [0, 0])
    with pytest.raises(ValueError, match="directions must be 0, 1, 2 or 3"):
        suppress(zeros, np.full((3, 3), 45))
    with pytest.raises(ValueError, match="low must not be above high"):
        double_threshold(zeros, 2, 1)
    with pytest.raises(ValueError, match="must be bool arrays of the same shape"):
        hysteresis(zeros, zeros)
    with pytest.raises(ValueError, match="a pixel cannot be both weak and strong"):
        hysteresis(np.ones((3, 3), bool), np.eye(3, dtype=bool))
