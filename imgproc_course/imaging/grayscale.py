"""Grayscale: from three colour channels to one. Luma as OpenCV computes it, and other formulas to compare."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .array_types import Bgr, Gray
from .row_blocks import row_blocks
from .validation import check_bgr

# ITU-R BT.601 weights of blue, green, red: 0.114, 0.587, 0.299 times 2**15, rounded; their sum is 2**15.
LUMA_WEIGHTS = (3735, 19235, 9798)
LUMA_SHIFT = 15

# Weights of linear blue, green, red in luminance Y, for the primaries of sRGB (ITU-R BT.709).
LUMINANCE_WEIGHTS = (0.0722, 0.7152, 0.2126)


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


def linear_light(levels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Decode the gray levels of an sRGB image: the amount of light that each level stands for.

    A camera stores levels that look evenly spaced to the eye, not levels proportional to light: level 128 is
    half of 255, but stands for only 22 % of the light of white. A sum of *light* (the blur of a lens, the
    light of a second lamp, luminance) is correct only after this function. `to_gray` weights the stored
    levels without decoding them (luma): this is fast, and OpenCV does the same.

    Parameters
    ----------
    levels : uint8 array of any shape, 0..255, encoded as sRGB

    Returns
    -------
    float64 array of the same shape, 0 (no light) to 1 (as much as white)

    Raises
    ------
    ValueError : any other dtype

    Source: IEC 61966-2-1 (sRGB), decoding curve.

    Examples
    --------
    >>> print(linear_light(np.array([0, 128, 255], np.uint8)).round(2))
    [0.   0.22 1.  ]
    """
    levels = np.asarray(levels)
    if levels.dtype != np.uint8:
        raise ValueError(
            f"levels must be uint8, got {levels.dtype}; "
            f"scale values 0..1 first: np.rint(levels * 255).astype(np.uint8)"
        )
    encoded = np.arange(256) / 255
    curve = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return curve[levels]


def srgb_levels(light: ArrayLike) -> NDArray[np.uint8]:
    """Encode amounts of light as gray levels of an sRGB image; the inverse of `linear_light`.

    Parameters
    ----------
    light : real array of any shape; values are clipped to 0..1

    Returns
    -------
    uint8 array of the same shape, rounded to the nearest

    Raises
    ------
    ValueError : a value that is NaN

    Source: IEC 61966-2-1 (sRGB), encoding curve.

    Examples
    --------
    >>> print(srgb_levels([0, 0.5, 1]))
    [  0 188 255]
    """
    light = np.asarray(light, np.float64)
    if np.isnan(light).any():
        raise ValueError("light must be numbers from 0 to 1, got NaN; replace it first: np.nan_to_num(light)")
    light = light.clip(0, 1)
    encoded = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.rint(encoded * 255).astype(np.uint8)


def linear_light_gray(bgr: Bgr) -> Gray:
    """Gray of the same luminance as the colour: the weights apply to light, not to the stored levels.

    Compared with `to_gray` this shows the effect of gamma. On neutral colours both agree; for saturated
    colours luma is too dark (pure red has luma 76, but the luminance of gray 127).

    Parameters
    ----------
    bgr : (H, W, 3) uint8, channel order blue, green, red, 0..255, encoded as sRGB

    Returns
    -------
    (H, W) uint8, encoded as sRGB, rounded to the nearest

    Raises
    ------
    ValueError : any other shape or dtype

    Source: luminance Y of ITU-R BT.709 on light decoded by IEC 61966-2-1.

    Examples
    --------
    >>> print(linear_light_gray(np.array([[[0, 0, 255]]], np.uint8)))
    [[127]]
    """
    return srgb_levels(linear_light(check_bgr(bgr)) @ np.array(LUMINANCE_WEIGHTS))
