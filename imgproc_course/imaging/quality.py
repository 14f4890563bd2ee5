"""Image quality: how far an image is from its reference, as one number."""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy import ndimage

from .array_types import Gray, GrayOrBgr
from .validation import check_pair, check_size

# SSIM's constants, as fractions of the largest level. They keep its denominators away from zero.
K1, K2 = 0.01, 0.03


def psnr(reference: GrayOrBgr, image: GrayOrBgr) -> float:
    """Peak signal-to-noise ratio: the square of the largest level relative to the mean squared error.

    Parameters
    ----------
    reference, image : uint8 arrays of the same shape, (H, W) or (H, W, 3)

    Returns
    -------
    float, decibels: 10 log10(255² / mean squared error); infinity for equal images. 10 dB more mean a tenth
    of the squared error; above 40 dB few people see a difference.

    Raises
    ------
    ValueError : another dtype, different shapes

    Examples
    --------
    >>> black = np.zeros((2, 2), np.uint8)
    >>> round(psnr(black, black + np.uint8(1)), 1)
    48.1
    """
    reference, image = check_pair(reference, image)
    error = np.mean((reference.astype(np.float64) - image) ** 2)
    return math.inf if error == 0 else float(10 * np.log10(255**2 / error))


def ssim(reference: Gray, image: Gray, *, size: int = 7) -> float:
    """Structural similarity: do both images have the same mean, contrast and pattern around each pixel?

    Parameters
    ----------
    reference, image : (H, W) uint8 of the same shape, at least as large as the window
    size : odd side of the window in pixels

    Returns
    -------
    float, mean over all windows that lie inside the image: 1 for equal images, near 0 for unrelated ones

    Raises
    ------
    ValueError : another shape or dtype, different shapes, a window larger than the image

    Source: Z. Wang et al., 2004, doi:10.1109/TIP.2003.819861; as skimage.metrics.structural_similarity with
    win_size=size, data_range=255; it can also weight the window with a Gaussian, as the paper does.

    Examples
    --------
    >>> ramp = np.arange(49, dtype=np.uint8).reshape(7, 7)
    >>> ssim(ramp, ramp), round(ssim(ramp, ramp[::-1, ::-1]), 2)
    (1.0, -0.75)
    """
    reference, image = check_pair(reference, image)
    size = check_size(size, minimum=3)
    if reference.ndim != 2 or size > min(reference.shape):
        raise ValueError(
            f"ssim needs gray images of at least {size}×{size} pixels, got {reference.shape}; "
            f"make them gray with to_gray, or use a smaller window"
        )
    local_mean = functools.partial(ndimage.uniform_filter, size=size)
    a, b = reference.astype(np.float64), image.astype(np.float64)
    mean_a, mean_b = local_mean(a), local_mean(b)
    # Bessel's correction: the mean of each window is estimated from the same window.
    unbiased = size * size / (size * size - 1)
    variance_a = unbiased * (local_mean(a * a) - mean_a**2)
    variance_b = unbiased * (local_mean(b * b) - mean_b**2)
    covariance = unbiased * (local_mean(a * b) - mean_a * mean_b)

    c1, c2 = (K1 * 255) ** 2, (K2 * 255) ** 2
    luminance = (2 * mean_a * mean_b + c1) / (mean_a**2 + mean_b**2 + c1)
    structure = (2 * covariance + c2) / (variance_a + variance_b + c2)
    inside = slice(size // 2, -(size // 2))
    return float((luminance * structure)[inside, inside].mean())
