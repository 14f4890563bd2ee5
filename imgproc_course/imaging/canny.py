"""Canny's edge detector, one plain function a stage; equal to cv2.Canny on every pixel.

`canny_stages` runs the stages one by one and returns what each of them made: it is what the lesson shows.
`canny`, in canny_fast, returns the same edges in a fraction of the time.
"""

from typing import NamedTuple

import numpy as np
from scipy import ndimage

from imgproc_course.imaging.filters import gaussian_blur
from imgproc_course.imaging.gradients import (
    DOWN,
    DOWN_LEFT,
    DOWN_RIGHT,
    RIGHT,
    checked_aperture,
    direction,
    magnitude,
    sobel,
)
from imgproc_course.imaging.pictures import checked_gray, checked_number

# OpenCV divides the gradient of aperture 7, and the thresholds with it, by this, so that int16 holds it.
APERTURE_7_SCALE = 16

# No magnitude reaches this; OpenCV lowers thresholds to it before it squares them.
LARGEST_THRESHOLD = 32767

# direction -> step in (row, col) to the neighbour that the gradient points at
STEP = {RIGHT: (0, 1), DOWN_RIGHT: (1, 1), DOWN: (1, 0), DOWN_LEFT: (1, -1)}

EIGHT_NEIGHBOURS = np.ones((3, 3), bool)


class CannyStages(NamedTuple):
    """What every stage of Canny made; all arrays are (H, W).

    Attributes
    ----------
    smoothed : uint8 gray levels, the picture after the Gaussian; with sigma=0 a copy of the picture
    grad_row, grad_col : int32, Sobel's gradient downwards and to the right, in gray levels times the sum of
        Sobel's weights (aperture 3: a straight step of h gray levels gives 4 h); aperture 7: divided by 16
        and rounded, halves to even, as OpenCV does
    magnitude : L1: int32, |grad_row| + |grad_col|, in the unit of the gradient;
        L2: int64, grad_row² + grad_col², the *square* of that unit, as OpenCV compares it
    direction : uint8, 0 right or left, 1 down-right or up-left, 2 down or up, 3 down-left or up-right
    thinned : dtype and unit of magnitude; the magnitude where it is the largest along its direction, 0
        elsewhere
    candidates : bool, thinned above `low`: may be an edge
    seeds : bool, thinned above `high`: is an edge; every seed is a candidate
    edges : uint8, 255 where a chain of candidates leads to a seed, 0 elsewhere
    """

    smoothed: np.ndarray
    grad_row: np.ndarray
    grad_col: np.ndarray
    magnitude: np.ndarray
    direction: np.ndarray
    thinned: np.ndarray
    candidates: np.ndarray
    seeds: np.ndarray
    edges: np.ndarray


def canny_stages(gray, low, high, *, sigma=0, aperture=3, l2_gradient=False):
    """Canny's edges, with every picture on the way to them.

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
    CannyStages; its `edges` equals cv2.Canny(smoothed, low, high, apertureSize=aperture,
    L2gradient=l2_gradient)

    Raises
    ------
    ValueError : another shape, dtype or aperture; low above high (OpenCV swaps them in silence)

    Source: J. Canny, 1986, doi:10.1109/TPAMI.1986.4767851, in the arithmetic of OpenCV's canny.cpp.
    """
    low, high = checked_thresholds(low, high)
    low_in_unit = threshold_in_unit(low, aperture, l2_gradient)
    high_in_unit = threshold_in_unit(high, aperture, l2_gradient)

    smoothed = smooth(gray, sigma)
    grad_row, grad_col = canny_gradient(smoothed, aperture)
    size = magnitude(grad_row, grad_col, "L2 squared" if l2_gradient else "L1")
    sector = direction(grad_row, grad_col)
    thinned = suppress(size, sector)
    candidates, seeds = double_threshold(thinned, low_in_unit, high_in_unit)
    edges = hysteresis(candidates, seeds)
    return CannyStages(smoothed, grad_row, grad_col, size, sector, thinned, candidates, seeds, edges)


def smooth(gray, sigma=0):
    """First stage: blur away noise that would look like edges; sigma=0 gives a copy.

    Parameters
    ----------
    gray : (H, W) uint8
    sigma : pixels, 0 or more

    Returns
    -------
    (H, W) uint8, a new array

    Raises
    ------
    ValueError : another shape or dtype, a negative sigma
    """
    if checked_number(sigma, "sigma", least=0) == 0:
        return checked_gray(gray).copy()
    return gaussian_blur(gray, sigma)


def canny_gradient(smoothed, aperture=3):
    """Second stage: Sobel's gradient, at aperture 7 in sixteenths as cv2.Canny takes it.

    Parameters
    ----------
    smoothed : (H, W) uint8
    aperture : 3, 5 or 7

    Returns
    -------
    grad_row, grad_col : (H, W) int32; aperture 7: divided by 16, rounded, halves to even

    Raises
    ------
    ValueError : another shape, dtype or aperture
    """
    grad_row, grad_col = sobel(smoothed, aperture)
    if aperture == 7:
        grad_row = np.rint(grad_row / APERTURE_7_SCALE).astype(np.int32)
        grad_col = np.rint(grad_col / APERTURE_7_SCALE).astype(np.int32)
    return grad_row, grad_col


def suppress(magnitude, direction):
    """Non-maximum suppression: keep a magnitude only where it is the largest along its gradient.

    Each pixel is compared with two neighbours: the one that its gradient points at (ahead) and the opposite
    one (behind); outside the picture the magnitude is 0. Two equal magnitudes side by side must leave one
    edge, not two and not none: right and down, a pixel must be greater than the neighbour on its left (above
    it), but only not smaller than the one on its right (below it), so that of two equals the left (upper)
    one stays. On diagonals OpenCV asks for greater on both sides.

    Parameters
    ----------
    magnitude : (H, W) integers, 0 or more
    direction : (H, W) uint8, 0..3 as `direction` returns it

    Returns
    -------
    (H, W) of the dtype of magnitude: the magnitude where it stays, 0 elsewhere

    Raises
    ------
    ValueError : arrays of different shapes, a direction that is not 0..3

    Source: OpenCV's canny.cpp, with its rules for equal neighbours.
    """
    magnitude, direction = np.asarray(magnitude), np.asarray(direction)
    if magnitude.ndim != 2 or magnitude.shape != direction.shape:
        raise ValueError(
            f"magnitude and direction must be (H, W) arrays of one shape, got {magnitude.shape} and "
            f"{direction.shape}; make both from one gradient"
        )
    if not np.isin(direction, list(STEP)).all():
        raise ValueError("direction must hold 0, 1, 2 or 3 only; make it with direction(grad_row, grad_col)")
    rows, cols = magnitude.shape
    framed = np.pad(magnitude, 1)
    stays = np.zeros(magnitude.shape, bool)
    for sector, (down, right) in STEP.items():
        ahead = framed[1 + down : 1 + down + rows, 1 + right : 1 + right + cols]
        behind = framed[1 - down : 1 - down + rows, 1 - right : 1 - right + cols]
        not_beaten_ahead = magnitude >= ahead if sector in (RIGHT, DOWN) else magnitude > ahead
        stays |= (direction == sector) & (magnitude > behind) & not_beaten_ahead
    return np.where(stays, magnitude, 0)


def double_threshold(thinned, low, high):
    """Two thresholds: above the low one a pixel may be an edge, above the high one it is.

    Parameters
    ----------
    thinned : (H, W) numbers, magnitudes after `suppress`
    low, high : numbers in the unit of `thinned`, low <= high

    Returns
    -------
    candidates : (H, W) bool, thinned > low (greater, not equal, as OpenCV)
    seeds : (H, W) bool, thinned > high

    Raises
    ------
    ValueError : low above high
    """
    low, high = checked_thresholds(low, high)
    thinned = np.asarray(thinned)
    return thinned > max(low, 0), thinned > max(high, 0)


def hysteresis(candidates, seeds):
    """Keep the candidates that are joined to a seed, directly or from candidate to candidate.

    All eight neighbours of a pixel join it. Candidates that hang together make a group; a group with a seed
    in it is an edge as a whole, any other is dropped as a whole.

    Parameters
    ----------
    candidates : (H, W) bool
    seeds : (H, W) bool, every seed being a candidate

    Returns
    -------
    (H, W) uint8, 255 on edges, 0 elsewhere

    Raises
    ------
    ValueError : arrays that are not bool or differ in shape; a seed that is no candidate
    """
    candidates, seeds = np.asarray(candidates), np.asarray(seeds)
    if candidates.dtype != np.bool_ or seeds.dtype != np.bool_ or candidates.shape != seeds.shape:
        raise ValueError(
            f"candidates and seeds must be bool arrays of one shape, got {candidates.shape} "
            f"{candidates.dtype} and {seeds.shape} {seeds.dtype}; "
            f"make them with double_threshold(thinned, low, high)"
        )
    if (seeds & ~candidates).any():
        raise ValueError(
            "every seed must be a candidate, but some are not; keep low <= high in double_threshold"
        )
    group, groups = ndimage.label(candidates, EIGHT_NEIGHBOURS)  # 0 where there is no candidate
    has_seed = np.zeros(groups + 1, bool)
    has_seed[group[seeds]] = True
    return np.where(has_seed[group], 255, 0).astype(np.uint8)


def checked_thresholds(low, high):
    """Both thresholds as floats, once it is sure that they are numbers and in order."""
    low = checked_number(low, "low", infinite=True)
    high = checked_number(high, "high", infinite=True)
    if low > high:
        raise ValueError(f"low must not be above high, got low={low:g}, high={high:g}; swap them")
    return low, high


def threshold_in_unit(threshold, aperture=3, l2_gradient=False):
    """A threshold in the unit that cv2.Canny compares magnitudes in.

    Parameters
    ----------
    threshold : number in the unit of the gradient's norm, as the caller of canny gives it
    aperture, l2_gradient : as for canny

    Returns
    -------
    float: a sixteenth of it at aperture 7; its square with l2_gradient; below 0 it counts as 0, above 32767
    as 32767

    Raises
    ------
    ValueError : another aperture
    """
    if checked_aperture(aperture) == 7:
        threshold = threshold / APERTURE_7_SCALE
    threshold = min(max(float(threshold), 0.0), float(LARGEST_THRESHOLD))
    return threshold**2 if l2_gradient else threshold
