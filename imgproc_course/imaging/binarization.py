"""From gray to black and white: one threshold for all, Otsu's choice, and one for each neighbourhood."""

import math

import numpy as np

from imgproc_course.imaging.filters import box_mean, gaussian_shares
from imgproc_course.imaging.pictures import bands, checked_gray, checked_number, checked_size, padded

# Otsu: a class with a smaller share of the pixels than this counts as empty (FLT_EPSILON in OpenCV).
SMALLEST_SHARE = 2.0**-23


def threshold(gray, level):
    """White where the gray level is above `level`, black elsewhere.

    Parameters
    ----------
    gray : (H, W) uint8
    level : gray level; a pixel of just this level becomes black

    Returns
    -------
    (H, W) uint8, 0 or 255

    Raises
    ------
    ValueError : another shape or dtype; a level that is no number

    Source: cv2.threshold(gray, level, 255, cv2.THRESH_BINARY).
    """
    level = checked_number(level, "level", infinite=True)
    # A whole number is above a level when it is above its floor: bytes are compared with bytes.
    level = math.floor(min(max(level, -1), 255))
    return (checked_gray(gray) > level).view(np.uint8) * np.uint8(255)


def otsu_threshold(gray):
    """The level that parts the pixels into the two classes that differ most: Otsu's threshold.

    Of all levels, the one with the largest variance *between* the classes, share_dark · share_bright ·
    (mean_dark - mean_bright)²; of equal ones, the lowest. Use it as threshold(gray, otsu_threshold(gray)).

    Parameters
    ----------
    gray : (H, W) uint8

    Returns
    -------
    int, 0..255; pixels up to it are the dark class. A picture of one level gives 0.

    Raises
    ------
    ValueError : another shape or dtype

    Source: N. Otsu, 1979, doi:10.1109/TSMC.1979.4310076; cv2.threshold with cv2.THRESH_OTSU, in its order of
    operations, so that rounding decides ties alike.
    """
    counts = np.bincount(checked_gray(gray).ravel(), minlength=256).tolist()
    pixels = sum(counts)
    mean = sum(level * count for level, count in enumerate(counts)) * (1 / pixels)
    best_level, best_variance = 0, 0.0
    share_dark = mean_dark = 0.0
    for level, count in enumerate(counts):
        share = count * (1 / pixels)
        weighed_dark = mean_dark * share_dark
        share_dark += share
        share_bright = 1 - share_dark
        if (
            min(share_dark, share_bright) < SMALLEST_SHARE
            or max(share_dark, share_bright) > 1 - SMALLEST_SHARE
        ):
            mean_dark = weighed_dark
            continue
        mean_dark = (weighed_dark + level * share) / share_dark
        mean_bright = (mean - share_dark * mean_dark) / share_bright
        variance = share_dark * share_bright * (mean_dark - mean_bright) * (mean_dark - mean_bright)
        if variance > best_variance:
            best_level, best_variance = level, variance
    return best_level


def adaptive_threshold(gray, size, offset, *, weights="mean"):
    """White where the gray level is above a local mean minus `offset`: a threshold for each neighbourhood.

    One threshold for all fails when one half of the floor lies in the sun; against its own surroundings a
    dark line is dark in either half.

    Parameters
    ----------
    gray : (H, W) uint8
    size : odd side of the neighbourhood in pixels, at least 3; larger than what is to be told apart
    offset : gray levels below the local mean that still count as white (OpenCV's C); rounded up
    weights : "mean": all neighbours weigh the same; "gaussian": near ones more (OpenCV's sigma for the size)

    Returns
    -------
    (H, W) uint8, 255 where gray > local mean - offset, 0 elsewhere; the local mean is rounded to whole
    levels first

    Raises
    ------
    ValueError : another shape or dtype, an even size, other weights

    Source: cv2.adaptiveThreshold with cv2.THRESH_BINARY and its border BORDER_REPLICATE. Its Gaussian mean
    adds float32 numbers, here as on a processor with fused multiply-add; on others about one
    local mean in 50 000 comes out one level apart, and the pixel differs if its level is just on the border.
    """
    gray, size = checked_gray(gray), checked_size(size, smallest=3)
    offset = math.ceil(checked_number(offset, "offset"))
    if weights not in ("mean", "gaussian"):
        raise ValueError(f'weights must be "mean" or "gaussian", got {weights!r}; try "mean" first')
    mean = box_mean(gray, size, "replicate") if weights == "mean" else _gaussian_mean(gray, size)
    # Beyond ±256 an offset changes nothing any more, and int16 holds the rest.
    offset = min(max(offset, -256), 256)
    return (gray > mean.astype(np.int16) - offset).view(np.uint8) * np.uint8(255)


def _gaussian_mean(gray, size):
    """Gaussian mean with replicated border, rounded to the nearest, halves to even.

    In float32, in OpenCV's order: along rows from left to right, down columns from the middle outwards.
    """
    half = size // 2
    shares = gaussian_shares(0, size)
    wide = padded(gray, half, "replicate")
    mean = np.empty(gray.shape, np.uint8)
    cols = gray.shape[1]
    for top, bottom in bands(gray, least_rows=4 * size):
        band = wide[top : bottom + 2 * half].astype(np.float32)
        along = _fused_sum([band[:, k : k + cols] for k in range(size)], shares)
        down = [along[k : k + bottom - top] for k in range(size)]
        pairs = [down[half - k] + down[half + k] for k in range(1, half + 1)]
        mean[top:bottom] = np.rint(_fused_sum([down[half], *pairs], shares[half:]))
    return mean


def _fused_sum(pictures, shares):
    """Weighted sum of float32 pictures; a product is added before it is rounded (fused multiply-add)."""
    shares = np.array(shares, np.float32).astype(np.float64)
    total = pictures[0] * np.float32(shares[0])
    for picture, share in zip(pictures[1:], shares[1:], strict=True):
        # float64 holds the product of two float32 exactly, as the processor's wide register does.
        total = (picture * share + total).astype(np.float32)
    return total
