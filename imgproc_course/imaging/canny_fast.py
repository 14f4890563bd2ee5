"""Canny in the form that keeps up with a camera; `canny_stages` is the form to read.

The stages and their rules are those of canny.py; a test holds the two equal. What makes this one fast:

* The picture is worked through in bands of rows that stay in a core's cache; on the whole picture at once the
  same steps wait for memory most of the time.
* int16 holds every gradient and every L1 magnitude: half the memory of int32, twice the numbers an
instruction. * Few pixels pass the low threshold, 5 to 15 of 100. Only those get a direction and are compared
with neighbours.
"""

import numpy as np
from scipy import ndimage

from imgproc_course.imaging.canny import (
    APERTURE_7_SCALE,
    EIGHT_NEIGHBOURS,
    checked_thresholds,
    smooth,
    threshold_in_unit,
)
from imgproc_course.imaging.gradients import TAN_22, TAN_SHIFT, checked_aperture, gradient_of_padded
from imgproc_course.imaging.pictures import bands, checked_gray, checked_number, padded


def canny(gray, low, high, *, sigma=0, aperture=3, l2_gradient=False):
    """Canny's edges, equal to cv2.Canny on every pixel.

    Parameters
    ----------
    gray : (H, W) uint8
    low, high : numbers, low <= high, in the unit of the gradient's norm: with aperture 3 and L1 a straight
        step of h gray levels has magnitude 4 h. Below 0 counts as 0; above 32767 there is nothing.
    sigma : pixels, standard deviation of the Gaussian that smooths first, as cv2.GaussianBlur(gray, (0, 0),
        sigma); 0: no smoothing, as cv2.Canny
    aperture : 3, 5 or 7, side of Sobel's window
    l2_gradient : compare the length of the gradient instead of |grad_row| + |grad_col|

    Returns
    -------
    (H, W) uint8, 255 on edges, 0 elsewhere

    Raises
    ------
    ValueError : another shape, dtype or aperture; low above high (OpenCV swaps them in silence)

    Source: J. Canny, 1986, doi:10.1109/TPAMI.1986.4767851, in the arithmetic of OpenCV's canny.cpp.
    """
    gray, aperture = checked_gray(gray), checked_aperture(aperture)
    low, high = checked_thresholds(low, high)
    # A whole number is above t when it is above floor(t): the comparisons stay among integers.
    low = int(threshold_in_unit(low, aperture, l2_gradient))
    high = int(threshold_in_unit(high, aperture, l2_gradient))
    if checked_number(sigma, "sigma", least=0) > 0:
        gray = smooth(gray, sigma)

    # One pixel more than Sobel needs: every pixel then has eight neighbours with a magnitude.
    margin = aperture // 2 + 1
    wide = padded(gray, margin, "replicate")
    rows, row_length = gray.shape[0], gray.shape[1] + 2
    thinned, seeds = [], []
    for top, bottom in bands(gray):
        grad_row, grad_col = _gradient(wide[top : bottom + 2 * margin], aperture)
        size = _magnitude(grad_row, grad_col, l2_gradient)
        size[:, 0] = size[:, -1] = 0  # outside the picture there is no magnitude
        if top == 0:
            size[0] = 0
        if bottom == rows:
            size[-1] = 0
        place = _suppress(size, grad_row, grad_col, low)
        is_seed = size.ravel().take(place) > high
        place += (top - 1) * row_length
        thinned.append(place)
        seeds.append(place[is_seed])
    edges = _hysteresis(np.concatenate(thinned), np.concatenate(seeds), (rows, row_length))
    return edges[:, 1:-1].copy()


def _gradient(wide, aperture):
    """Gradient of a band, with one row and column around it, as int16."""
    if aperture < 7:
        return gradient_of_padded(wide.astype(np.int16), aperture)
    gradient = gradient_of_padded(wide.astype(np.int32), aperture)
    return tuple(np.rint(grad / APERTURE_7_SCALE).astype(np.int16) for grad in gradient)


def _magnitude(grad_row, grad_col, l2_gradient):
    """L1 as int16 (at most 24480, at aperture 5), L2 squared as int32 (at most 3·10⁸)."""
    if not l2_gradient:
        size = np.abs(grad_row)
        size += np.abs(grad_col)
        return size
    size = np.square(grad_row, dtype=np.int32)
    size += np.square(grad_col, dtype=np.int32)
    return size


def _suppress(size, grad_row, grad_col, low):
    """Flat places in `size`, its frame of one pixel left out, of what stays and is above `low`."""
    row_length = size.shape[1]
    place = np.flatnonzero(size[1:-1].ravel() > low)
    place += row_length
    # `take` picks from a flat array in half the time of square brackets.
    down, right, here = (array.ravel().take(place) for array in (grad_row, grad_col, size))
    leans_left = (down ^ right) < 0
    down, right = np.abs(down).astype(np.int32), np.abs(right).astype(np.int32)
    down <<= TAN_SHIFT
    flat = right * TAN_22
    is_right = down < flat
    right <<= TAN_SHIFT + 1
    right += flat
    is_down = down > right

    # The neighbour ahead is this many places further on, the one behind as many back.
    step = np.where(leans_left, row_length - 1, row_length + 1)
    step[is_right] = 1
    step[is_down] = row_length
    ahead = size.ravel().take(place + step)
    behind = size.ravel().take(place - step)
    # On a diagonal the pixel must be greater than both; a whole number is greater than n if it is >= n + 1.
    ahead += ~(is_right | is_down)
    return place[(here > behind) & (here >= ahead)]


def _hysteresis(thinned, seeds, shape):
    """Edges as a picture of this shape, from flat places of thinned pixels and of the seeds among them."""
    edges = np.zeros(shape, np.uint8)
    edges.ravel()[thinned] = 1
    group, groups = ndimage.label(edges, EIGHT_NEIGHBOURS)
    group = group.ravel()
    level = np.zeros(groups + 1, np.uint8)
    level[group.take(seeds)] = 255
    edges.ravel()[thinned] = level.take(group.take(thinned))
    return edges
