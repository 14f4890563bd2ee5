"""Canny fast enough for a camera; `canny_stages` is the version to read.

The stages and their rules are those of canny.py; a test checks that both give the same edges. Three things
make this version fast:

* It processes the image in blocks of rows that fit a core's cache. On the whole image at once, the same steps
  wait for memory most of the time.
* It stores every gradient and every L1 magnitude as int16. That takes half the memory of int32, and one
  instruction of the processor handles twice as many numbers.
* Only 5 to 15 percent of the pixels are above the low threshold. Only for those does it compute a direction
  and compare neighbours.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .array_types import Gray
from .canny import APERTURE_7_SCALE, check_thresholds, threshold_in_unit
from .filters import gaussian_blur
from .gradients import TAN_22, TAN_SHIFT, check_aperture
from .row_blocks import pad_border, row_blocks
from .validation import check_gray, check_number


def canny(
    gray: Gray, low: float, high: float, *, sigma: float = 0, aperture: int = 3, l2_gradient: bool = False
) -> Gray:
    """Canny's edges, equal to cv2.Canny on every pixel.

    Parameters
    ----------
    gray : (H, W) uint8
    low, high : numbers, low <= high, in the unit of the gradient's norm: with aperture 3 and L1 a straight
        step of h gray levels has magnitude 4 h
    sigma, aperture, l2_gradient : as in `canny_stages`

    Returns
    -------
    (H, W) uint8, 255 on edges, 0 elsewhere

    Raises
    ------
    ValueError : another shape, dtype or aperture; low above high (OpenCV swaps them silently)

    Source: J. Canny, 1986, doi:10.1109/TPAMI.1986.4767851, in the arithmetic of OpenCV's canny.cpp.

    Examples
    --------
    >>> gray = np.array([[0, 0, 100, 100]] * 3, np.uint8)
    >>> print(canny(gray, 100, 200))
    [[  0 255   0   0]
     [  0 255   0   0]
     [  0 255   0   0]]
    """
    gray, aperture = check_gray(gray), check_aperture(aperture)
    low, high = check_thresholds(low, high)
    # An integer is above t if it is above floor(t), so integers are compared with integers.
    low = int(threshold_in_unit(low, aperture, l2_gradient))
    high = int(threshold_in_unit(high, aperture, l2_gradient))
    if check_number(sigma, "sigma", minimum=0) > 0:
        gray = gaussian_blur(gray, sigma)

    # One pixel more than Sobel needs: then every pixel has eight neighbours with a magnitude.
    margin = aperture // 2 + 1
    padded = pad_border(gray, margin, "replicate")
    # The indices below count the pixels of an image with a frame of one pixel, row by row.
    rows, row_length = gray.shape[0], gray.shape[1] + 2
    weak, strong = [], []
    for top, bottom in row_blocks(gray):
        grad_row, grad_col = _gradient(padded[top : bottom + 2 * margin], aperture)
        magnitude = _magnitude(grad_row, grad_col, l2_gradient)
        magnitude[:, 0] = magnitude[:, -1] = 0  # outside the image the magnitude is 0
        if top == 0:
            magnitude[0] = 0
        if bottom == rows:
            magnitude[-1] = 0
        index, is_strong = _suppress(magnitude, grad_row, grad_col, low, high)
        index += top * row_length
        weak.append(index.compress(~is_strong))
        strong.append(index.compress(is_strong))
    edges = _hysteresis(np.concatenate(weak), np.concatenate(strong), (rows + 2, row_length))
    return edges[1:-1, 1:-1].copy()


def _gradient(padded, aperture):
    """Gradient of a block, with one more row and column on each side, as int16.

    Sobel's kernels are sums of two neighbours, again and again: 1 2 1 is 1 1 correlated with 1 1, and -1 0 1
    is -1 1 correlated with 1 1. Both gradients share all sums but the last.
    """
    total = padded.astype(np.int16 if aperture < 7 else np.int32)
    for _ in range(aperture - 2):
        total = total[:-1] + total[1:]
        total = total[:, :-1] + total[:, 1:]
    falling = total[1:, 1:] - total[:-1, :-1]  # the differences along both diagonals
    rising = total[1:, :-1] - total[:-1, 1:]
    gradient = falling + rising, falling - rising
    if aperture < 7:
        return gradient
    return tuple(np.rint(grad / APERTURE_7_SCALE).astype(np.int16) for grad in gradient)


def _magnitude(grad_row, grad_col, l2_gradient):
    """L1 norm as int16 (at most 24480, at aperture 5), squared L2 norm as int32 (at most 3·10⁸)."""
    if l2_gradient:
        return np.square(grad_row, dtype=np.int32) + np.square(grad_col, dtype=np.int32)
    return np.abs(grad_row) + np.abs(grad_col)


def _suppress(magnitude, grad_row, grad_col, low, high):
    """Flat indices of the local maxima above `low`, and which are above `high`.

    The outermost rows and columns are only compared with.
    """
    row_length = magnitude.shape[1]
    magnitude = magnitude.ravel()
    index = np.flatnonzero(magnitude[row_length:-row_length] > low)
    index += row_length
    # `take` picks from a flat array in half the time of square brackets.
    down, right, middle = (array.ravel().take(index) for array in (grad_row, grad_col, magnitude))
    leans_left = (down ^ right) < 0
    down, right = np.abs(down).astype(np.int32), np.abs(right).astype(np.int32)
    down <<= TAN_SHIFT
    down_at_22 = right * TAN_22
    is_horizontal, is_vertical = down < down_at_22, down > down_at_22 + (right << TAN_SHIFT + 1)

    # Distance in the flat array to the neighbour ahead; the one behind is as far in the other direction.
    sector = leans_left + 2 * is_horizontal.view(np.int8) + 4 * is_vertical.view(np.int8)
    steps = np.array([row_length + 1, row_length - 1, 1, 1, row_length, row_length])
    step = steps.take(sector)
    ahead = magnitude.take(index + step)
    behind = magnitude.take(index - step)
    # On a diagonal the pixel must be greater than both; an integer is greater than n if it is >= n + 1.
    ahead += sector < 2
    maxima = np.flatnonzero((middle > behind) & (middle >= ahead))
    return index.take(maxima), middle.take(maxima) > high


def _hysteresis(weak, strong, shape):
    """Edges as an image of this shape, from the flat indices of the weak and the strong pixels.

    The nodes of a graph are the runs of weak pixels along a row, its links join neighbours of two rows. Few
    pixels are weak: to find its components takes half the time of labelling every pixel of the image.
    """
    edges = np.zeros(shape, np.uint8)
    flat = edges.ravel()
    flat[strong] = 255
    run = np.cumsum(np.diff(weak, prepend=0) != 1, dtype=np.int32)  # of each weak pixel, counted from 1
    run_at = np.zeros(edges.size, np.int32)
    run_at[weak] = run
    touches_strong = flat.take(weak - 1) | flat.take(weak + 1)
    above, below = [], []
    for distance in (shape[1] - 1, shape[1], shape[1] + 1):
        touches_strong |= flat.take(weak - distance) | flat.take(weak + distance)
        neighbour = run_at.take(weak + distance)
        linked = np.flatnonzero(neighbour)
        above.append(run.take(linked))
        below.append(neighbour.take(linked))
    links = np.concatenate(above), np.concatenate(below)
    nodes = run.max(initial=0) + 1
    graph = coo_array((np.ones(links[0].size), links), shape=(nodes, nodes))
    components, component = connected_components(graph, directed=False)
    level = np.zeros(components, np.uint8)
    level[component.take(run[touches_strong > 0])] = 255
    flat[weak] = level.take(component).take(run)
    return edges
