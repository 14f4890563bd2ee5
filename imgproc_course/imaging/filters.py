"""Filters that remove noise, with OpenCV's border handling and rounding."""

from __future__ import annotations

import functools
import math

import numpy as np

from .array_types import Gray, GrayOrBgr
from .correlation import correlate1d
from .row_blocks import filter_blocks
from .validation import check_gray, check_image, check_number, check_size

# A fixed-point Gaussian kernel consists of integers that add up to 2**8, as in OpenCV's arithmetic for uint8.
KERNEL_SHIFT = 8

# OpenCV's kernels for a size without a sigma, in units of 1/256.
KERNEL_OF_SIZE = {
    1: (256,),
    3: (64, 128, 64),
    5: (16, 64, 96, 64, 16),
    7: (8, 28, 56, 72, 56, 28, 8),
    9: (4, 13, 30, 51, 60, 51, 30, 13, 4),
}


def box_blur(image: GrayOrBgr, size: int = 3) -> GrayOrBgr:
    """Box (mean) filter: the mean of the size × size pixels around each pixel.

    Parameters
    ----------
    image : (H, W) or (H, W, 3) uint8, each channel separately
    size : odd side of the window in pixels

    Returns
    -------
    uint8 array of the same shape, rounded to the nearest (a mean of an odd number of levels is never
    halfway)

    Raises
    ------
    ValueError : another shape or dtype; an even size

    Source: cv2.blur, with its border BORDER_REFLECT_101.

    Examples
    --------
    >>> print(box_blur(np.array([[0, 0, 90, 0, 0]], np.uint8)))
    [[ 0 30 30 30  0]]
    """
    return box_mean(check_image(image), check_size(size), "reflect_101")


def box_mean(image, size, border):
    """`box_blur` with any border; `adaptive_threshold` needs "replicate"."""
    count = size * size

    def mean_of_block(block):
        total = _window_sum(_window_sum(block.astype(np.uint32), size, axis=0), size, axis=1)
        return (total + count // 2) // count

    return filter_blocks(image, size // 2, border, mean_of_block)


def gaussian_kernel(sigma, size=None):
    """The weights of cv2.GaussianBlur for uint8: integers of sum 256, as its smooth.dispatch.cpp rounds them.

    If the size is omitted, it is 6 sigma + 1, rounded and made odd. If sigma is 0 or less, a table has the
    kernel up to size 9; then sigma is 0.3 ((size - 1) / 2 - 1) + 0.8. The rounding error of each weight is
    added to the next one, from the ends inwards; the middle is the rest to 256.
    """
    sigma = check_number(sigma, "sigma")
    if size is None:
        if sigma <= 0:
            raise ValueError(
                f"sigma must be above 0 if size is omitted, got {sigma:g}; pass sigma=1.5 or size=5"
            )
        size = round(sigma * 6 + 1) | 1
    size = check_size(size)
    if sigma <= 0 and size in KERNEL_OF_SIZE:
        return KERNEL_OF_SIZE[size]
    if sigma <= 0:
        sigma = 0.15 * size + 0.35
    heights = [math.exp(distance**2 * -0.5 / (sigma * sigma)) for distance in range(size // 2, 0, -1)]
    scale = (1 << KERNEL_SHIFT) / (2 * sum(heights) + 1)
    outer, error = [], 0.0
    for height in heights:
        exact = height * scale + error
        outer.append(round(exact))
        error = exact - outer[-1]
    return [*outer, (1 << KERNEL_SHIFT) - 2 * sum(outer), *reversed(outer)]


def gaussian_blur(image: GrayOrBgr, sigma: float, size: int | None = None) -> GrayOrBgr:
    """Gaussian filter: a weighted mean around each pixel; the weights fall with the distance in a bell curve.

    Parameters
    ----------
    image : (H, W) or (H, W, 3) uint8, each channel separately
    sigma : standard deviation in pixels; the larger, the smoother. 0 with a size: OpenCV's choice for that
        size
    size : odd side of the window in pixels; if None, OpenCV's choice for the sigma

    Returns
    -------
    uint8 array of the same shape; sums are exact in units of 2**-16, then rounded half up once

    Raises
    ------
    ValueError : another shape or dtype; an even size; neither sigma nor size

    Source: cv2.GaussianBlur(image, (0, 0), sigma), in its fixed-point arithmetic for uint8, with its border
    BORDER_REFLECT_101.

    Examples
    --------
    >>> print(gaussian_blur(np.array([[0, 0, 100, 0, 0]], np.uint8), 0, 3))
    [[ 0 25 50 25  0]]
    """
    image = check_image(image)
    kernel = gaussian_kernel(sigma, size)

    def blur_block(block):
        # 255 · 256 fits 16 bits: along the rows uint16 is enough, with half the memory of uint32.
        row_sums = correlate1d(block.astype(np.uint16), kernel, axis=1)
        total = correlate1d(row_sums.astype(np.uint32), kernel, axis=0)
        return (total + (1 << (2 * KERNEL_SHIFT - 1))) >> (2 * KERNEL_SHIFT)

    return filter_blocks(image, len(kernel) // 2, "reflect_101", blur_block)


def median_blur(image: GrayOrBgr, size: int = 3) -> GrayOrBgr:
    """Median filter: the middle value of the size × size gray levels around each pixel, once sorted.

    One outlier among nine pixels changes their mean, but hardly their median. So this is the filter against
    impulse (salt-and-pepper) noise.

    Parameters
    ----------
    image : (H, W) or (H, W, 3) uint8, each channel separately
    size : odd side of the window in pixels

    Returns
    -------
    uint8 array of the same shape; every level in it occurs in the input

    Raises
    ------
    ValueError : another shape or dtype; an even size

    Source: cv2.medianBlur, with its border BORDER_REPLICATE.

    Examples
    --------
    >>> print(median_blur(np.array([[10, 10, 255, 10, 10]], np.uint8)))
    [[10 10 10 10 10]]
    """
    image, size = check_image(image), check_size(size)
    median = _median_of_nine if size == 3 else functools.partial(_median_of_window, size=size)
    return filter_blocks(image, size // 2, "replicate", median)


def _median_of_nine(padded):
    """Median of every 3×3 window: columns sorted first, because neighbouring windows share their columns.

    With nine levels in sorted columns, the median of all nine is the median of three: the maximum of the low
    ones, the median of the middle ones, and the minimum of the high ones.
    """
    low, middle, high = _sorted_three(padded[:-2], padded[1:-1], padded[2:])
    largest_low = np.maximum(np.maximum(low[:, :-2], low[:, 1:-1]), low[:, 2:])
    median_middle = _sorted_three(middle[:, :-2], middle[:, 1:-1], middle[:, 2:])[1]
    smallest_high = np.minimum(np.minimum(high[:, :-2], high[:, 1:-1]), high[:, 2:])
    return _sorted_three(largest_low, median_middle, smallest_high)[1]


def _sorted_three(a, b, c):
    """The lowest, the middle and the highest of three levels, pixel by pixel."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    middle = np.maximum(low, np.minimum(high, c))
    return np.minimum(low, c), middle, np.maximum(high, c)


def _median_of_window(padded, size):
    """Median of every window, one binary digit at a time instead of by sorting: a fifth of the time.

    The median of n levels is the largest level with at most n // 2 of the levels below it. So each digit,
    from the highest to the lowest, is set if the resulting level is not above the median.
    """
    rows, cols = padded.shape[0] - size + 1, padded.shape[1] - size + 1
    window = [
        padded[down : down + rows, right : right + cols] for down in range(size) for right in range(size)
    ]
    median = np.zeros_like(window[0], order="C")
    for digit in (128, 64, 32, 16, 8, 4, 2, 1):
        trial = median | np.uint8(digit)
        below = np.zeros(trial.shape, np.uint8 if len(window) < 256 else np.uint32)
        for level in window:
            below += (level < trial).view(np.uint8)
        np.copyto(median, trial, where=below <= len(window) // 2)
    return median


def bilateral_filter(gray: Gray, sigma_color: float, sigma_space: float, size: int | None = None) -> Gray:
    """Bilateral filter: a weighted mean of neighbours that are near *and* similar; it keeps steps sharp.

    Parameters
    ----------
    gray : (H, W) uint8
    sigma_color : gray levels; a neighbour that differs by this much has weight exp(-1/2), a more different
        one less
    sigma_space : pixels; a neighbour at this distance has weight exp(-1/2), a farther one less
    size : odd side of the round window in pixels; if None, OpenCV's choice, a radius of 1.5 sigma_space

    Returns
    -------
    (H, W) uint8, rounded to the nearest, halves to even

    Raises
    ------
    ValueError : another shape or dtype; an even size; a sigma that is not above 0

    Source: cv2.bilateralFilter(gray, size, sigma_color, sigma_space), with its border BORDER_REFLECT_101. It
    adds float32 numbers, in an order and with a rounding that depend on the processor: its own results
    differ between processors, and from these, by one gray level in a few of 100,000 pixels. On x86, OpenCV's
    wheels compute windows of 3 and 5 with Intel's IPP, which drops the fraction instead of rounding: half of
    the pixels are one level darker.

    Examples
    --------
    >>> print(bilateral_filter(np.array([[10, 20, 10, 200, 210, 200]], np.uint8), 30, 1))
    [[ 15  15  13 203 205 205]]
    """
    gray = check_gray(gray)
    sigma_color = _check_sigma(sigma_color, "sigma_color")
    sigma_space = _check_sigma(sigma_space, "sigma_space")
    radius = max(1, round(sigma_space * 1.5) if size is None else check_size(size) // 2)
    similarity = np.exp(np.arange(256) ** 2 * (-0.5 / sigma_color**2)).astype(np.float32)
    block = functools.partial(_bilateral_block, radius, similarity, sigma_space)
    return filter_blocks(gray, radius, "reflect_101", block)


def _bilateral_block(radius, similarity, sigma_space, padded):
    padded = padded.astype(np.int16)
    rows, cols = padded.shape[0] - 2 * radius, padded.shape[1] - 2 * radius
    middle = padded[radius : radius + rows, radius : radius + cols]
    total, total_weight = np.zeros((2, rows, cols), np.float32)
    for down in range(-radius, radius + 1):
        for right in range(-radius, radius + 1):
            distance = math.hypot(down, right)
            if distance > radius:
                continue
            closeness = np.float32(math.exp(-0.5 * distance**2 / sigma_space**2))
            neighbour = padded[radius + down : radius + down + rows, radius + right : radius + right + cols]
            weight = closeness * similarity.take(np.abs(neighbour - middle))
            total_weight += weight
            total += neighbour * weight
    return np.rint(total / total_weight)


def _window_sum(values, size, axis):
    """Sum of `size` neighbours along an axis, from cumulative sums: the cost does not depend on the size."""
    cumulative = np.cumsum(values, axis=axis, dtype=values.dtype)
    leading = (slice(None),) * axis
    sums = cumulative[(*leading, slice(size - 1, None))].copy()
    sums[(*leading, slice(1, None))] -= cumulative[(*leading, slice(None, -size))]
    return sums


def _check_sigma(value, name):
    if check_number(value, name) <= 0:
        raise ValueError(f"{name} must be above 0, got {value!r}; try 25 gray levels and 3 pixels")
    return float(value)
