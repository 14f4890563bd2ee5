import numpy as np
import pytest
from image_edge_detection.image_edge_detection import check, process

from imgproc_course.imaging import canny, to_gray


def step_of(height):
    """Black on the left, `height` gray levels brighter on the right; its gradient is 4 * height."""
    frame = np.zeros((5, 8, 3), np.uint8)
    frame[:, 4:] = height
    return frame


@pytest.mark.parametrize("height, is_edge", [(37, False), (38, True)])
def test_a_step_is_an_edge_when_four_times_its_height_is_above_the_threshold(height, is_edge):
    edges = process(step_of(height), low=50, high=150, sigma=0.0)["edges"]
    columns = np.flatnonzero(edges[2]).tolist()
    assert columns == ([3] if is_edge else [])


def test_the_view_holds_the_original_gray_and_edges_side_by_side():
    frame = step_of(200)
    result = process(frame, low=50, high=150, sigma=0.0)
    view = result["view"]()
    assert (view.shape, view.dtype) == ((5, 24, 3), np.uint8)
    assert (view[:, :8] == frame).all()
    assert (view[:, 8:16] == result["gray"][..., None]).all()
    assert (view[:, 16:] == result["edges"][..., None]).all()


def test_thresholds_in_the_wrong_order_are_refused_with_both_values():
    with pytest.raises(ValueError, match=r"low \(200\) must not be above high \(150\)"):
        check(200, 150, 0.0)
    check(150, 150, 0.0)


@pytest.mark.parametrize("low, high, sigma", [(50, 150, 0.0), (20, 60, 1.5), (0, 1530, 0.4), (120, 120, 4.0)])
def test_gray_and_edges_are_those_computed_by_hand(low, high, sigma):
    frame = np.random.default_rng(8).integers(0, 256, (12, 16, 3), np.uint8).repeat(5, 0).repeat(5, 1)
    result = process(frame, low=low, high=high, sigma=sigma)
    assert (result["gray"] == to_gray(frame)).all()
    assert (result["edges"] == canny(to_gray(frame), low, high, sigma=sigma)).all()
