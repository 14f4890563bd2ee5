"""Artificial noise. It is drawn from a seed, so every reader gets the same noise."""

from __future__ import annotations

import numpy as np

from .array_types import GrayOrBgr
from .validation import check_image, check_number


def add_gaussian_noise(image: GrayOrBgr, sigma: float, *, seed: int | np.random.Generator = 0) -> GrayOrBgr:
    """Add Gaussian noise, as a sensor does in the dark: to each value a normally distributed random number.

    Parameters
    ----------
    image : (H, W) or (H, W, 3) uint8
    sigma : standard deviation in gray levels, 0 or more
    seed : int, or a numpy.random.Generator to draw from; the same seed gives the same noise

    Returns
    -------
    uint8 array of the same shape, rounded to the nearest and clipped to 0..255

    Raises
    ------
    ValueError : another shape or dtype, a negative sigma

    Examples
    --------
    >>> print(add_gaussian_noise(np.full((2, 4), 100, np.uint8), 5))
    [[101  99 103 101]
     [ 97 102 107 105]]
    """
    image = check_image(image)
    sigma = check_number(sigma, "sigma", minimum=0)
    noise = np.random.default_rng(seed).normal(0, sigma, image.shape)
    return np.rint(image + noise).clip(0, 255).astype(np.uint8)


def add_salt_and_pepper(
    image: GrayOrBgr, fraction: float, *, seed: int | np.random.Generator = 0
) -> GrayOrBgr:
    """Add impulse noise: make random pixels white or black, as dead pixels and lost bits do.

    Parameters
    ----------
    image : (H, W) or (H, W, 3) uint8
    fraction : 0..1, fraction of the pixels that change; on average half of them become white (salt), half
        black (pepper)
    seed : int, or a numpy.random.Generator to draw from; the same seed gives the same noise

    Returns
    -------
    uint8 array of the same shape; a pixel of a colour image changes in all its channels

    Raises
    ------
    ValueError : another shape or dtype, a fraction outside 0..1

    Examples
    --------
    >>> print(add_salt_and_pepper(np.full((2, 4), 100, np.uint8), 0.3))
    [[100   0 255 255]
     [100 100 100 100]]
    """
    noisy = check_image(image).copy()
    fraction = check_number(fraction, "fraction", minimum=0)
    if fraction > 1:
        raise ValueError(f"fraction must be from 0 to 1, got {fraction:g}; 5 percent are 0.05")
    chance = np.random.default_rng(seed).random(noisy.shape[:2])
    noisy[chance < fraction] = 0
    noisy[chance < fraction / 2] = 255
    return noisy
