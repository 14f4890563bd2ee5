"""Filters against noise, with OpenCV's borders and OpenCV's rounding."""

import math
from fractions import Fraction

import numpy as np

from imgproc_course.imaging.pictures import (
    bands,
    checked_frame,
    checked_gray,
    checked_number,
    checked_size,
    padded,
)
from imgproc_course.imaging.weighing import weighed

# A Gaussian's weights are whole numbers that add up to 2**8, as in OpenCV's arithmetic for uint8.
WEIGHT_SHIFT = 8

# OpenCV's weights when a size is given and no sigma, in units of 1/256.
WEIGHTS_OF_SIZE = {
    1: (256,),
    3: (64, 128, 64),
    5: (16, 64, 96, 64, 16),
    7: (8, 28, 56, 72, 56, 28, 8),
    9: (4, 13, 30, 51, 60, 51, 30, 13, 4),
}


def box_blur(picture, size=3):
    """Mean of the size × size pixels around each pixel.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) uint8, every channel by itself
    size : odd side of the window in pixels

    Returns
    -------
    uint8 array of the same shape, rounded to the nearest (an odd number of pixels leaves no half)

    Raises
    ------
    ValueError : another shape or dtype; an even size

    Source: cv2.blur, with its border BORDER_REFLECT_101.
    """
    return box_mean(checked_frame(picture, "picture"), checked_size(size), "reflect_101")


def box_mean(picture, size, border):
    """`box_blur` with the border of the caller's choice; `adaptive_threshold` needs "replicate"."""
    margin, count = size // 2, size * size
    wide = padded(picture, margin, border)
    blurred = np.empty(picture.shape, np.uint8)
    # Multiplying is several times as fast as dividing whole numbers, and as exact here: the mean of an odd
    # number of levels is at least 1 / (2 count) from a half, and the error of a float far below that.
    share = np.float32(1 / count) if size < 100 else np.float64(1 / count)
    for top, bottom in bands(picture, least_rows=4 * size):
        total = _window_sum(wide[top : bottom + 2 * margin].astype(np.uint32), size, axis=0)
        mean = _window_sum(total, size, axis=1).astype(share.dtype)
        mean *= share
        mean += share.dtype.type(0.5)
        blurred[top:bottom] = mean  # the cast to uint8 drops the fraction
    return blurred


def gaussian_shares(sigma, size=None):
    """Weights of a Gaussian along one axis, as shares of 1.

    Parameters
    ----------
    sigma : standard deviation in pixels; 0 or less: OpenCV's choice for the size, 0.3 ((size - 1) / 2 - 1) +
        0.8, and its table for sizes up to 9
    size : odd number of weights; None: OpenCV's choice for the sigma, 6 sigma + 1 rounded and made odd

    Returns
    -------
    list of `size` floats, symmetric, of sum 1

    Raises
    ------
    ValueError : an even size; neither sigma nor size

    Source: cv2.getGaussianKernel.
    """
    sigma = checked_number(sigma, "sigma")
    if size is None:
        if sigma <= 0:
            raise ValueError(
                f"sigma must be above 0 when no size is given, got {sigma:g}; give sigma=1.5 or size=5"
            )
        size = round(sigma * 6 + 1) | 1
    size = checked_size(size)
    if sigma <= 0 and size in WEIGHTS_OF_SIZE:
        return [weight / (1 << WEIGHT_SHIFT) for weight in WEIGHTS_OF_SIZE[size]]
    if sigma <= 0:
        # Rounded once, as a fused multiply-add does: the last bit of the shares depends on it.
        sigma = float(Fraction(0.15) * size + Fraction(0.35))
    scale = -0.5 / (sigma * sigma)
    heights = [math.exp(distance**2 * scale) for distance in range(size // 2, 0, -1)]
    share = 1 / (2 * sum(heights) + 1)
    rim = [height * share for height in heights]
    return [*rim, share, *reversed(rim)]


def gaussian_weights(sigma, size=None):
    """Weights of a Gaussian along one axis, in whole units of 1/256, as OpenCV rounds them.

    Each weight is rounded to a whole number and hands its rounding error on to the next, from the rim
    inwards; the one in the middle takes what is left, so that the sum is exactly 256 and a flat picture
    stays as it is.

    Parameters
    ----------
    sigma, size : as for `gaussian_shares`

    Returns
    -------
    list of `size` ints, symmetric, of sum 256

    Raises
    ------
    ValueError : an even size; neither sigma nor size

    Source: the fixed-point kernel of cv2.GaussianBlur for uint8 (OpenCV's smooth.dispatch.cpp).
    """
    shares = gaussian_shares(sigma, size)
    rim, error = [], 0.0
    for share in shares[: len(shares) // 2]:
        exact = share * (1 << WEIGHT_SHIFT) + error
        rim.append(round(exact))
        error = exact - rim[-1]
    return [*rim, (1 << WEIGHT_SHIFT) - 2 * sum(rim), *reversed(rim)]


def gaussian_blur(picture, sigma, size=None):
    """Weighted mean around each pixel; the weights fall off with the distance like a bell.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) uint8, every channel by itself
    sigma : standard deviation in pixels; the larger, the smoother. 0 with a size: OpenCV's choice for that
        size
    size : odd side of the window in pixels; None: OpenCV's choice for the sigma

    Returns
    -------
    uint8 array of the same shape; sums are exact in units of 2**-16, then rounded half up once

    Raises
    ------
    ValueError : another shape or dtype; an even size; neither sigma nor size

    Source: cv2.GaussianBlur(picture, (0, 0), sigma), in its fixed-point arithmetic for uint8, with its border
    BORDER_REFLECT_101.
    """
    picture = checked_frame(picture, "picture")
    weights = gaussian_weights(sigma, size)
    margin = len(weights) // 2
    wide = padded(picture, margin, "reflect_101")
    blurred = np.empty_like(picture, order="C")
    for top, bottom in bands(picture, least_rows=4 * margin):
        # 255 · 256 just fits 16 bits: along the rows half the memory of 32 bits is enough.
        along = weighed(wide[top : bottom + 2 * margin].astype(np.uint16), weights, axis=1)
        total = weighed(along.astype(np.uint32), weights, axis=0)
        total += 1 << (2 * WEIGHT_SHIFT - 1)
        total >>= 2 * WEIGHT_SHIFT
        blurred[top:bottom] = total
    return blurred


def median_blur(picture, size=3):
    """The middle one of the size × size gray levels around each pixel, sorted.

    One wild pixel among nine moves a mean, but not the middle: the filter against salt and pepper.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) uint8, every channel by itself
    size : odd side of the window in pixels

    Returns
    -------
    uint8 array of the same shape; every level in it was there before

    Raises
    ------
    ValueError : another shape or dtype; an even size

    Source: cv2.medianBlur, with its border BORDER_REPLICATE.
    """
    picture, size = checked_frame(picture, "picture"), checked_size(size)
    margin = size // 2
    wide = padded(picture, margin, "replicate")
    filtered = np.empty(picture.shape, np.uint8)
    for top, bottom in bands(picture, least_rows=4 * size):
        band = wide[top : bottom + 2 * margin]
        filtered[top:bottom] = _median_of_nine(band) if size == 3 else _median_of_window(band, size)
    return filtered


def _median_of_nine(wide):
    """Median of every 3×3 window: columns sorted first, so that neighbouring windows share the sorting.

    Of nine levels in sorted columns, the median is the middle one of three: the largest of the lowest, the
    middle one of the middle ones, and the smallest of the highest.
    """
    low, middle, high = _sorted_three(wide[:-2], wide[1:-1], wide[2:])
    of_low = np.maximum(np.maximum(low[:, :-2], low[:, 1:-1]), low[:, 2:])
    of_middle = _sorted_three(middle[:, :-2], middle[:, 1:-1], middle[:, 2:])[1]
    of_high = np.minimum(np.minimum(high[:, :-2], high[:, 1:-1]), high[:, 2:])
    return _sorted_three(of_low, of_middle, of_high)[1]


def _sorted_three(a, b, c):
    """At every place the lowest, the middle and the highest of three levels."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    middle = np.maximum(low, np.minimum(high, c))
    return np.minimum(low, c), middle, np.maximum(high, c)


def _median_of_window(wide, size):
    """Median of every window, found one binary digit at a time instead of by sorting: a fifth of the time.

    The median of n levels is the largest level that at most n // 2 of them are below. So, from the highest
    digit to the lowest, each is set if the level with it is still not above the median.
    """
    rows, cols = wide.shape[0] - size + 1, wide.shape[1] - size + 1
    window = [wide[down : down + rows, right : right + cols] for down in range(size) for right in range(size)]
    median = np.zeros_like(window[0], order="C")
    for digit in (128, 64, 32, 16, 8, 4, 2, 1):
        trial = median | np.uint8(digit)
        below = np.zeros(trial.shape, np.uint8 if len(window) < 256 else np.uint32)
        for level in window:
            below += (level < trial).view(np.uint8)
        np.copyto(median, trial, where=below <= len(window) // 2)
    return median


def bilateral_filter(gray, sigma_color, sigma_space, size=None):
    """Weighted mean of the neighbours that are near *and* look alike: smooths, but keeps steps sharp.

    Parameters
    ----------
    gray : (H, W) uint8
    sigma_color : gray levels; neighbours this far off in level weigh exp(-1/2), farther ones less
    sigma_space : pixels; neighbours this far away weigh exp(-1/2), farther ones less
    size : odd side of the round window in pixels; None: OpenCV's choice, a radius of 1.5 sigma_space

    Returns
    -------
    (H, W) uint8, rounded to the nearest, halves to even

    Raises
    ------
    ValueError : another shape or dtype; an even size; a sigma that is not above 0

    Source: cv2.bilateralFilter(gray, size, sigma_color, sigma_space), with its border BORDER_REFLECT_101. It
    adds float32 numbers, and in what order and with what rounding depends on the processor: OpenCV's own
    results differ from one another, and from these, by one gray level in a few of 100 000 pixels. Where it
    hands windows of 3 and 5 to Intel's IPP (wheels for x86), it drops the fraction instead of rounding: half
    the pixels come out one darker.
    """
    gray = checked_gray(gray)
    sigma_color, sigma_space = (
        _checked_sigma(value, name)
        for value, name in ((sigma_color, "sigma_color"), (sigma_space, "sigma_space"))
    )
    radius = max(1, round(sigma_space * 1.5) if size is None else checked_size(size) // 2)
    alike = np.exp(np.arange(256) ** 2 * (-0.5 / sigma_color**2)).astype(np.float32)
    wide = padded(gray, radius, "reflect_101").astype(np.int16)
    filtered = np.empty(gray.shape, np.uint8)
    for top, bottom in bands(gray, least_rows=4 * radius):
        filtered[top:bottom] = _bilateral_band(wide[top : bottom + 2 * radius], radius, alike, sigma_space)
    return filtered


def _bilateral_band(wide, radius, alike, sigma_space):
    rows, cols = wide.shape[0] - 2 * radius, wide.shape[1] - 2 * radius
    here = wide[radius : radius + rows, radius : radius + cols]
    total, weights = np.zeros((2, rows, cols), np.float32)
    for down in range(-radius, radius + 1):
        for right in range(-radius, radius + 1):
            distance = math.hypot(down, right)
            if distance > radius:
                continue
            near = np.float32(math.exp(-0.5 * distance**2 / sigma_space**2))
            there = wide[radius + down : radius + down + rows, radius + right : radius + right + cols]
            weight = near * alike.take(np.abs(there - here))
            weights += weight
            total += there * weight
    return np.rint(total / weights)


def _window_sum(values, size, axis):
    """Sum of `size` neighbours along an axis, from running totals: the same effort for every size."""
    running = np.cumsum(values, axis=axis, dtype=values.dtype)
    before = (slice(None),) * axis
    sums = running[(*before, slice(size - 1, None))].copy()
    sums[(*before, slice(1, None))] -= running[(*before, slice(None, -size))]
    return sums


def _checked_sigma(value, name):
    if checked_number(value, name) <= 0:
        raise ValueError(f"{name} must be above 0, got {value!r}; try 25 gray levels and 3 pixels")
    return float(value)
