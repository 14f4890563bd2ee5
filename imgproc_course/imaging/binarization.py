"""Binarization: a global threshold, Otsu's threshold, and an adaptive threshold."""

from __future__ import annotations

import math

import numpy as np

from .array_types import Gray
from .filters import box_mean
from .validation import check_gray, check_number, check_size

# Otsu: a class with a smaller share of the pixels counts as empty (FLT_EPSILON in OpenCV).
SMALLEST_SHARE = 2.0**-23


def threshold(gray: Gray, level: float) -> Gray:
    """Global threshold: white where the gray level is above `level`, black elsewhere.

    Parameters
    ----------
    gray : (H, W) uint8
    level : gray level; a pixel with exactly this level becomes black

    Returns
    -------
    (H, W) uint8, 0 or 255

    Raises
    ------
    ValueError : another shape or dtype; a level that is not a number

    Source: cv2.threshold(gray, level, 255, cv2.THRESH_BINARY).

    Examples
    --------
    >>> print(threshold(np.array([[99, 100, 101]], np.uint8), 100))
    [[  0   0 255]]
    """
    level = check_number(level, "level", allow_infinite=True)
    # An integer is above a level if it is above its floor, so bytes are compared with bytes.
    level = math.floor(min(max(level, -1), 255))
    return (check_gray(gray) > level).view(np.uint8) * np.uint8(255)


def otsu_threshold(gray: Gray) -> int:
    """Otsu's threshold: the level that splits the pixels into the two classes that differ most.

    This is the level with the largest between-class variance, share_dark · share_bright ·
    (mean_dark - mean_bright)²; if several levels have it, the lowest. Use it as
    threshold(gray, otsu_threshold(gray)).

    Parameters
    ----------
    gray : (H, W) uint8

    Returns
    -------
    int, 0..255; the dark class are the pixels up to this level. An image of one gray level gives 0.

    Raises
    ------
    ValueError : another shape or dtype

    Source: N. Otsu, 1979, doi:10.1109/TSMC.1979.4310076; cv2.threshold with cv2.THRESH_OTSU, in the same
    order of operations, so that rounding decides ties in the same way. Intel's IPP, which OpenCV's wheels
    call on x86-64, rounds otherwise: of two different splits that are equally good it may take the other one.

    Examples
    --------
    >>> otsu_threshold(np.array([[10, 11, 12], [200, 205, 210]], np.uint8))
    12
    """
    counts = np.bincount(check_gray(gray).ravel(), minlength=256).tolist()
    pixels = sum(counts)
    mean = sum(level * count for level, count in enumerate(counts)) * (1 / pixels)
    best_level, best_variance = 0, 0.0
    share_dark = mean_dark = 0.0
    for level, count in enumerate(counts):
        share = count * (1 / pixels)
        sum_dark = mean_dark * share_dark
        share_dark += share
        share_bright = 1 - share_dark
        shares = share_dark, share_bright
        if min(shares) < SMALLEST_SHARE or max(shares) > 1 - SMALLEST_SHARE:
            mean_dark = sum_dark
            continue
        mean_dark = (sum_dark + level * share) / share_dark
        mean_bright = (mean - share_dark * mean_dark) / share_bright
        variance = share_dark * share_bright * (mean_dark - mean_bright) * (mean_dark - mean_bright)
        if variance > best_variance:
            best_level, best_variance = level, variance
    return best_level


def adaptive_threshold(gray: Gray, size: int, offset: float) -> Gray:
    """Adaptive threshold: white where the gray level is above the local mean minus `offset`.

    A global threshold fails if one half of the floor lies in the sun. Compared with its own neighbourhood, a
    dark line is dark in both halves.

    Parameters
    ----------
    gray : (H, W) uint8
    size : odd side of the neighbourhood in pixels, at least 3; choose it larger than the details of interest
    offset : gray levels below the local mean that still count as white (OpenCV's C); rounded up

    Returns
    -------
    (H, W) uint8, 255 where gray > local mean - offset, 0 elsewhere; the local mean is rounded to whole
    levels first

    Raises
    ------
    ValueError : another shape or dtype, an even size

    Source: cv2.adaptiveThreshold with cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY and its border
    BORDER_REPLICATE.

    Examples
    --------
    >>> gray = np.array([[90, 30, 90, 250, 190, 250]], np.uint8)  # a dark line in shade, one in light
    >>> print(adaptive_threshold(gray, 3, 5))
    [[255   0   0 255   0 255]]
    """
    gray, size = check_gray(gray), check_size(size, minimum=3)
    offset = math.ceil(check_number(offset, "offset"))
    mean = box_mean(gray, size, "replicate")
    # An offset beyond ±256 has no further effect, and int16 can hold the smaller ones.
    offset = min(max(offset, -256), 256)
    return (gray > mean.astype(np.int16) - offset).view(np.uint8) * np.uint8(255)
