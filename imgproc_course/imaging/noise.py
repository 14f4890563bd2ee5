"""Noise to practise on: drawn from a seed, so that everybody sees the same."""

import numpy as np

from imgproc_course.imaging.pictures import checked_frame, checked_number


def add_gaussian_noise(picture, sigma, *, seed=0):
    """Adds to every value a random number from a normal distribution: what a sensor does in the dark.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) uint8
    sigma : standard deviation in gray levels, 0 or more
    seed : int, or a numpy.random.Generator, which is drawn from; the same seed gives the same noise

    Returns
    -------
    uint8 array of the same shape, rounded to the nearest, what passes 0 or 255 set to 0 or 255

    Raises
    ------
    ValueError : another shape or dtype, a negative sigma
    """
    picture = checked_frame(picture, "picture")
    sigma = checked_number(sigma, "sigma", least=0)
    noise = np.random.default_rng(seed).normal(0, sigma, picture.shape)
    return np.rint(picture + noise).clip(0, 255).astype(np.uint8)


def add_salt_and_pepper(picture, fraction, *, seed=0):
    """Makes random pixels white or black: what dead pixels and lost bits do.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) uint8
    fraction : 0..1, share of the pixels that are hit, half of them white (salt), half black (pepper), on
        average
    seed : int, or a numpy.random.Generator, which is drawn from; the same seed gives the same noise

    Returns
    -------
    uint8 array of the same shape; a pixel of a colour frame is hit in all its channels

    Raises
    ------
    ValueError : another shape or dtype, a fraction outside 0..1
    """
    noisy = checked_frame(picture, "picture").copy()
    fraction = checked_number(fraction, "fraction", least=0)
    if fraction > 1:
        raise ValueError(f"fraction must be from 0 to 1, got {fraction:g}; 5 percent are 0.05")
    chance = np.random.default_rng(seed).random(noisy.shape[:2])
    noisy[chance < fraction] = 0
    noisy[chance < fraction / 2] = 255
    return noisy
