"""How far a picture is from its reference, as one number."""

import math

import numpy as np
from scipy import ndimage

from imgproc_course.imaging.pictures import checked_number, checked_pair, checked_size

# Constants that keep SSIM's divisions from dividing by almost nothing, as shares of the largest level.
K1, K2 = 0.01, 0.03


def psnr(reference, picture):
    """Peak signal-to-noise ratio: by how much the largest level outweighs the mean squared error.

    Parameters
    ----------
    reference, picture : uint8 arrays of one shape, (H, W) or (H, W, 3)

    Returns
    -------
    float, decibels: 10 log10(255² / mean squared error); infinity for equal pictures. 10 dB more is a tenth
    of the squared error; above 40 dB few people see a difference.

    Raises
    ------
    ValueError : another dtype, different shapes
    """
    reference, picture = checked_pair(reference, picture)
    error = np.mean((reference.astype(np.float64) - picture) ** 2)
    return math.inf if error == 0 else float(10 * np.log10(255**2 / error))


def ssim(reference, picture, *, size=7, gaussian_weights=False, sigma=1.5):
    """Structural similarity: do both pictures have the same mean, contrast and pattern around each pixel?

    Parameters
    ----------
    reference, picture : (H, W) uint8 of one shape, at least as large as the window
    size : odd side of the window in pixels; not used with gaussian_weights
    gaussian_weights : weigh the window by a Gaussian of `sigma` pixels, 3.5 sigma wide, as the paper does
    sigma : pixels, used with gaussian_weights only

    Returns
    -------
    float, mean over all windows that lie inside the picture: 1 for equal pictures, near 0 for unrelated ones

    Raises
    ------
    ValueError : another shape or dtype, different shapes, a window larger than the picture

    Source: Z. Wang et al., 2004, doi:10.1109/TIP.2003.819861; as skimage.metrics.structural_similarity with
    win_size=size, gaussian_weights, sigma, data_range=255.
    """
    reference, picture = checked_pair(reference, picture)
    if gaussian_weights:
        size = 2 * int(3.5 * checked_number(sigma, "sigma", least=0.15) + 0.5) + 1
    size = checked_size(size, smallest=3)
    if reference.ndim != 2 or size > min(reference.shape):
        raise ValueError(
            f"ssim needs gray pictures of at least {size}×{size} pixels, got {reference.shape}; "
            f"make them gray with to_gray, or take a smaller window"
        )

    def local_mean(values):
        if gaussian_weights:
            return ndimage.gaussian_filter(values, sigma, truncate=3.5)
        return ndimage.uniform_filter(values, size)

    a, b = reference.astype(np.float64), picture.astype(np.float64)
    mean_a, mean_b = local_mean(a), local_mean(b)
    unbiased = size * size / (size * size - 1)  # the mean of each window was taken from that window
    variance_a = unbiased * (local_mean(a * a) - mean_a**2)
    variance_b = unbiased * (local_mean(b * b) - mean_b**2)
    covariance = unbiased * (local_mean(a * b) - mean_a * mean_b)

    c1, c2 = (K1 * 255) ** 2, (K2 * 255) ** 2
    brightness = (2 * mean_a * mean_b + c1) / (mean_a**2 + mean_b**2 + c1)
    structure = (2 * covariance + c2) / (variance_a + variance_b + c2)
    inside = slice(size // 2, -(size // 2))
    return float((brightness * structure)[inside, inside].mean())
