"""Canny's edge detector, one plain function per stage; equal to cv2.Canny on every pixel.

`canny_stages` runs the stages one after another and returns the result of each: the lesson shows these.
`canny`, in canny_fast, computes the same edges in a fraction of the time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import ndimage

from .array_types import Direction, Gradient, Gray, Magnitude, Mask
from .filters import gaussian_blur
from .gradients import DOWN, DOWN_LEFT, DOWN_RIGHT, RIGHT, check_aperture, direction, magnitude, sobel
from .validation import check_gray, check_number

# OpenCV divides the gradient of aperture 7, and the thresholds with it, by this, so that int16 can hold it.
APERTURE_7_SCALE = 16

# No magnitude reaches this; OpenCV clips thresholds to it before it squares them.
LARGEST_THRESHOLD = 32767

# direction -> step in (row, col) to the neighbour that the gradient points at
STEP = {RIGHT: (0, 1), DOWN_RIGHT: (1, 1), DOWN: (1, 0), DOWN_LEFT: (1, -1)}

EIGHT_CONNECTIVITY = np.ones((3, 3), bool)


class CannyStages(NamedTuple):
    """The result of every stage of Canny; all arrays are (H, W).

    Attributes
    ----------
    smoothed : uint8 gray levels, the image after the Gaussian filter; with sigma=0 a copy of the image
    grad_row, grad_col : int32, Sobel's gradient downwards and to the right, in gray levels times the sum of
        the smoothing kernel (aperture 3: a straight step of h gray levels gives 4 h); aperture 7: divided by
        16 and rounded, halves to even, as OpenCV does
    magnitude : L1: int32, |grad_row| + |grad_col|, in the unit of the gradient;
        L2: int64, grad_row² + grad_col², the *square* of that unit, as OpenCV compares it
    direction : uint8, 0 right or left, 1 down-right or up-left, 2 down or up, 3 down-left or up-right
    thinned : dtype and unit of magnitude; the magnitude after non-maximum suppression: kept where it is the
        largest along its direction, 0 elsewhere
    weak : bool, low < thinned <= high: weak edge pixels, which are edges only if they are connected to a
        strong one
    strong : bool, thinned > high: strong edge pixels, which are always edges; no pixel is both weak
        and strong
    edges : uint8, 255 on the strong pixels and on the weak pixels connected to them, 0 elsewhere
    """

    smoothed: Gray
    grad_row: Gradient
    grad_col: Gradient
    magnitude: Magnitude
    direction: Direction
    thinned: Magnitude
    weak: Mask
    strong: Mask
    edges: Gray


def canny_stages(
    gray: Gray, low: float, high: float, *, sigma: float = 0, aperture: int = 3, l2_gradient: bool = False
) -> CannyStages:
    """Canny's edges, with the result of every stage.

    Parameters
    ----------
    gray : (H, W) uint8
    low, high : numbers, low <= high, in the unit of the gradient's norm: with aperture 3 and L1 a straight
        step of h gray levels has magnitude 4 h. A threshold below 0 counts as 0; above 32767 there are no
        edges.
    sigma : pixels, standard deviation of the Gaussian filter before the gradient, as cv2.GaussianBlur(gray,
        (0, 0), sigma); 0: no smoothing, as cv2.Canny
    aperture : 3, 5 or 7, side of Sobel's kernel
    l2_gradient : compare the L2 norm of the gradient instead of the L1 norm |grad_row| + |grad_col|

    Returns
    -------
    CannyStages; its `edges` equals cv2.Canny(smoothed, low, high, apertureSize=aperture,
    L2gradient=l2_gradient)

    Raises
    ------
    ValueError : another shape, dtype or aperture; low above high (OpenCV swaps them silently)

    Source: J. Canny, 1986, doi:10.1109/TPAMI.1986.4767851, in the arithmetic of OpenCV's canny.cpp.

    Examples
    --------
    >>> stages = canny_stages(np.array([[0, 0, 100, 100]], np.uint8), 100, 200)
    >>> print(stages.magnitude, stages.thinned, stages.edges)
    [[  0 400 400   0]] [[  0 400   0   0]] [[  0 255   0   0]]
    """
    low, high = check_thresholds(low, high)
    low_in_unit = threshold_in_unit(low, aperture, l2_gradient)
    high_in_unit = threshold_in_unit(high, aperture, l2_gradient)

    sigma = check_number(sigma, "sigma", minimum=0)
    smoothed = gaussian_blur(gray, sigma) if sigma else check_gray(gray).copy()
    grad_row, grad_col = canny_gradient(smoothed, aperture)
    magnitudes = magnitude(grad_row, grad_col, "L2 squared" if l2_gradient else "L1")
    directions = direction(grad_row, grad_col)
    thinned = suppress(magnitudes, directions)
    weak, strong = double_threshold(thinned, low_in_unit, high_in_unit)
    edges = hysteresis(weak, strong)
    return CannyStages(smoothed, grad_row, grad_col, magnitudes, directions, thinned, weak, strong, edges)


def canny_gradient(smoothed, aperture):
    """Sobel's gradient; at aperture 7 a sixteenth of it, halves to even, as in cv2.Canny."""
    grad_row, grad_col = sobel(smoothed, aperture)
    if aperture == 7:
        grad_row = np.rint(grad_row / APERTURE_7_SCALE).astype(np.int32)
        grad_col = np.rint(grad_col / APERTURE_7_SCALE).astype(np.int32)
    return grad_row, grad_col


def suppress(magnitudes: Magnitude, directions: Direction) -> Magnitude:
    """Non-maximum suppression: keep a magnitude only where it is the largest along its gradient.

    Each pixel is compared with two neighbours: the one that its gradient points at (ahead) and the opposite
    one (behind). Outside the image the magnitude is 0. If two neighbours have equal magnitudes, exactly one
    of them must remain. So in the directions right and down a pixel must be greater than the neighbour on its
    left (above it) and greater than *or equal to* the one on its right (below it): of two equal pixels the
    left (upper) one remains. On diagonals OpenCV requires greater on both sides.

    Parameters
    ----------
    magnitudes : (H, W) integers, 0 or more
    directions : (H, W) uint8, 0..3 as `direction` returns it

    Returns
    -------
    (H, W) of the dtype of magnitudes: the magnitude of each local maximum, 0 elsewhere

    Raises
    ------
    ValueError : arrays of different shapes, a direction that is not 0..3

    Source: OpenCV's canny.cpp, with its rules for equal neighbours.

    Examples
    --------
    >>> print(suppress(np.array([[1, 5, 3]]), np.array([[0, 0, 0]])))
    [[0 5 0]]
    """
    magnitudes, directions = np.asarray(magnitudes), np.asarray(directions)
    if magnitudes.ndim != 2 or magnitudes.shape != directions.shape:
        raise ValueError(
            f"magnitudes and directions must be (H, W) arrays of the same shape, got {magnitudes.shape} and "
            f"{directions.shape}; compute both from one gradient"
        )
    if not np.isin(directions, list(STEP)).all():
        raise ValueError("directions must be 0, 1, 2 or 3; compute them with direction(grad_row, grad_col)")
    rows, cols = magnitudes.shape
    padded = np.pad(magnitudes, 1)
    is_maximum = np.zeros(magnitudes.shape, bool)
    for sector, (down, right) in STEP.items():
        ahead = padded[1 + down : 1 + down + rows, 1 + right : 1 + right + cols]
        behind = padded[1 - down : 1 - down + rows, 1 - right : 1 - right + cols]
        beats_ahead = magnitudes >= ahead if sector in (RIGHT, DOWN) else magnitudes > ahead
        is_maximum |= (directions == sector) & (magnitudes > behind) & beats_ahead
    return np.where(is_maximum, magnitudes, 0)


def double_threshold(thinned: Magnitude, low: float, high: float) -> tuple[Mask, Mask]:
    """Double threshold: above `high` a pixel is a strong edge pixel, between `low` and `high` a weak one.

    Parameters
    ----------
    thinned : (H, W) numbers, magnitudes after `suppress`
    low, high : numbers in the unit of `thinned`, low <= high

    Returns
    -------
    weak : (H, W) bool, low < thinned <= high
    strong : (H, W) bool, thinned > high (greater, not equal, as in OpenCV)

    Raises
    ------
    ValueError : low above high

    Examples
    --------
    >>> weak, strong = double_threshold(np.array([[5, 15, 25]]), 10, 20)
    >>> print(weak, strong)
    [[False  True False]] [[False False  True]]
    """
    low, high = check_thresholds(low, high)
    thinned = np.asarray(thinned)
    strong = thinned > max(high, 0)
    weak = (thinned > max(low, 0)) & ~strong
    return weak, strong


def hysteresis(weak: Mask, strong: Mask) -> Gray:
    """Edge tracking by hysteresis: keep the strong pixels and the weak pixels connected to them.

    Weak and strong pixels form connected components; with 8-connectivity, all eight neighbours of a pixel
    touch it. A component is an edge if at least one of its pixels is strong; otherwise it is dropped.

    Parameters
    ----------
    weak : (H, W) bool
    strong : (H, W) bool, False where `weak` is True

    Returns
    -------
    (H, W) uint8, 255 on edges, 0 elsewhere

    Raises
    ------
    ValueError : arrays that are not bool or differ in shape; a pixel that is both weak and strong

    Examples
    --------
    >>> weak = np.array([[True, True, False, False, True]])
    >>> strong = np.array([[False, False, True, False, False]])
    >>> print(hysteresis(weak, strong))
    [[255 255 255   0   0]]
    """
    weak, strong = np.asarray(weak), np.asarray(strong)
    if weak.dtype != np.bool_ or strong.dtype != np.bool_ or weak.shape != strong.shape:
        raise ValueError(
            f"weak and strong must be bool arrays of the same shape, got {weak.shape} {weak.dtype} and "
            f"{strong.shape} {strong.dtype}; compute them with double_threshold(thinned, low, high)"
        )
    if (weak & strong).any():
        raise ValueError(
            "a pixel cannot be both weak and strong, but some are; weak pixels lie between the thresholds: "
            "low < thinned <= high"
        )
    component, components = ndimage.label(weak | strong, EIGHT_CONNECTIVITY)  # 0 is the background
    has_strong = np.zeros(components + 1, bool)
    has_strong[component[strong]] = True
    return np.where(has_strong[component], 255, 0).astype(np.uint8)


def check_thresholds(low, high):
    """Return both thresholds as floats; raise ValueError if they are not numbers or low > high."""
    low = check_number(low, "low", allow_infinite=True)
    high = check_number(high, "high", allow_infinite=True)
    if low > high:
        raise ValueError(f"low must not be above high, got low={low:g}, high={high:g}; swap them")
    return low, high


def threshold_in_unit(value, aperture, l2_gradient):
    """A threshold of canny in the unit in which cv2.Canny compares magnitudes, float."""
    if check_aperture(aperture) == 7:
        value = value / APERTURE_7_SCALE
    value = min(max(float(value), 0.0), float(LARGEST_THRESHOLD))
    return value**2 if l2_gradient else value
