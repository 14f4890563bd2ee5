"""Grayscale: from three colour channels to one. Luma as OpenCV computes it, and other formulas to compare."""

from __future__ import annotations

import numpy as np

from .array_types import Bgr, Gray
from .row_blocks import row_blocks
from .validation import check_bgr

# ITU-R BT.601 weights of blue, green, red: 0.114, 0.587, 0.299 times 2**15, rounded; their sum is 2**15.
LUMA_WEIGHTS = (3735, 19235, 9798)
LUMA_SHIFT = 15


def to_gray(bgr: Bgr) -> Gray:
    """Luma of a BGR frame, bit for bit as OpenCV computes it.

    gray = (3735 blue + 19235 green + 9798 red + 2**14) >> 15, in integer arithmetic.

    Parameters
    ----------
    bgr : (H, W, 3) uint8, channel order blue, green, red, 0..255

    Returns
    -------
    (H, W) uint8, rounded half up

    Raises
    ------
    ValueError : any other shape or dtype

    Source: ITU-R BT.601 weights scaled by 2**15, as cv2.COLOR_BGR2GRAY.

    Examples
    --------
    >>> print(to_gray(np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255]]], np.uint8)))
    [[ 29 150  76]]
    """
    bgr = check_bgr(bgr)
    # Every sum is an integer below 2**24, which float32 holds exactly. A matrix product of floats is twice as
    # fast as one of integers, and dividing by 2**15 only moves the binary point.
    weights = np.array(LUMA_WEIGHTS, np.float32) / (1 << LUMA_SHIFT)
    gray = np.empty(bgr.shape[:2], np.uint8)
    for top, bottom in row_blocks(bgr):
        luma = bgr[top:bottom].astype(np.float32) @ weights
        luma += 0.5
        gray[top:bottom] = luma  # the cast to uint8 drops the fraction
    return gray


def average_gray(bgr: Bgr) -> Gray:
    """Mean of the three channels: simple, but it ignores how bright each colour looks to the eye.

    Parameters
    ----------
    bgr : (H, W, 3) uint8, channels in any order, 0..255

    Returns
    -------
    (H, W) uint8, (blue + green + red) / 3 rounded to the nearest (a third is never halfway)

    Raises
    ------
    ValueError : any other shape or dtype

    Examples
    --------
    >>> print(average_gray(np.array([[[10, 20, 60]]], np.uint8)))
    [[30]]
    """
    wide = check_bgr(bgr).astype(np.uint16)
    return ((wide[..., 0] + wide[..., 1] + wide[..., 2] + 1) // 3).astype(np.uint8)


def lightness_gray(bgr: Bgr) -> Gray:
    """Mean of the largest and the smallest channel: the L of HSL.

    Parameters
    ----------
    bgr : (H, W, 3) uint8, channels in any order, 0..255

    Returns
    -------
    (H, W) uint8, (max + min) / 2, rounded half up

    Raises
    ------
    ValueError : any other shape or dtype

    Examples
    --------
    >>> print(lightness_gray(np.array([[[10, 20, 60]]], np.uint8)))
    [[35]]
    """
    blue, green, red = np.moveaxis(check_bgr(bgr), 2, 0)
    largest = np.maximum(np.maximum(blue, green), red).astype(np.uint16)
    smallest = np.minimum(np.minimum(blue, green), red)
    return ((largest + smallest + 1) >> 1).astype(np.uint8)


def linear_light_gray(bgr: Bgr) -> Gray:
    """Gray of the same luminance as the colour: the weights apply to light, not to the stored levels.

    `bgr` is (H, W, 3) uint8, encoded as sRGB; the result is (H, W) uint8, rounded to the nearest. Pure red
    becomes 127, and its luma is 76. ValueError: any other shape or dtype.

    Source: luminance Y of ITU-R BT.709 on light decoded by IEC 61966-2-1 (sRGB).

    >>> print(linear_light_gray(np.array([[[0, 0, 255]]], np.uint8)))
    [[127]]
    """
    encoded = np.arange(256) / 255
    light = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    luminance = light[check_bgr(bgr)] @ np.array([0.0722, 0.7152, 0.2126])
    levels = np.where(luminance <= 0.0031308, luminance * 12.92, 1.055 * luminance ** (1 / 2.4) - 0.055)
    return np.rint(255 * levels).astype(np.uint8)
