"""How fast, and in which direction, the gray levels rise: Sobel's gradient, its size and its direction."""

import numpy as np

from imgproc_course.imaging.pictures import checked_gray, padded
from imgproc_course.imaging.weighing import weighed

# aperture -> weights across the difference, and weights of the difference itself
SMOOTHING = {3: (1, 2, 1), 5: (1, 4, 6, 4, 1), 7: (1, 6, 15, 20, 15, 6, 1)}
DIFFERENCE = {3: (-1, 0, 1), 5: (-1, -2, 0, 2, 1), 7: (-1, -4, -5, 0, 5, 4, 1)}

# The direction of the gradient, told apart by the pair of neighbours that it points at and away from.
# Number k stands for the angle 45° k; rows grow downwards, so 90° points down.
RIGHT, DOWN_RIGHT, DOWN, DOWN_LEFT = 0, 1, 2, 3

# tan 22.5° in units of 2**-15, as OpenCV rounds it; tan 67.5° is exactly 2 more.
TAN_22 = 13573
TAN_SHIFT = 15


def checked_aperture(aperture):
    """The aperture, once it is sure that Sobel has weights for it."""
    if not isinstance(aperture, int | np.integer) or aperture not in SMOOTHING:
        raise ValueError(
            f"aperture must be 3, 5 or 7 (the side of Sobel's window), got {aperture!r}; use 3 if unsure"
        )
    return int(aperture)


def sobel(gray, aperture=3):
    """Gradient of a picture by Sobel's weights: a difference along one axis, a smoothing across it.

    Aperture 3: grad_col weighs the eight neighbours by  -1 0 1 / -2 0 2 / -1 0 1, grad_row by its transpose.
    A straight step of h gray levels gives 4 h (aperture 3), 48 h (5), 640 h (7) at its steepest.

    Parameters
    ----------
    gray : (H, W) uint8
    aperture : 3, 5 or 7, side of the window in pixels

    Returns
    -------
    grad_row : (H, W) int32, positive where the levels rise from one row to the next (downwards)
    grad_col : (H, W) int32, positive where the levels rise from one column to the next (to the right)

    Raises
    ------
    ValueError : any other shape, dtype or aperture

    Source: cv2.Sobel with BORDER_REPLICATE; grad_row is its dy, grad_col its dx.
    """
    aperture = checked_aperture(aperture)
    wide = padded(checked_gray(gray).astype(np.int32), aperture // 2, "replicate")
    return gradient_of_padded(wide, aperture)


def gradient_of_padded(wide, aperture):
    """Sobel's two gradients of a picture that already has its border, aperture // 2 pixels on each side.

    Parameters
    ----------
    wide : (H + aperture - 1, W + aperture - 1) int16 or int32 (int32 for aperture 7: its sums pass 32767)
    aperture : 3, 5 or 7

    Returns
    -------
    grad_row, grad_col : (H, W) of the same dtype
    """
    smoothing, difference = SMOOTHING[aperture], DIFFERENCE[aperture]
    grad_row = weighed(weighed(wide, difference, axis=0), smoothing, axis=1)
    grad_col = weighed(weighed(wide, smoothing, axis=0), difference, axis=1)
    return grad_row, grad_col


def magnitude(grad_row, grad_col, norm="L1"):
    """Size of the gradient at every pixel.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them
    norm : "L1" is |grad_row| + |grad_col|, what cv2.Canny uses unless told otherwise;
        "L2" is the length sqrt(grad_row² + grad_col²);
        "L2 squared" is grad_row² + grad_col², what cv2.Canny compares when L2gradient is set: no root, no
        rounding

    Returns
    -------
    (H, W) int32 for "L1", float64 for "L2", int64 for "L2 squared"; L1 and L2 in the unit of the gradient

    Raises
    ------
    ValueError : another norm, gradients that differ in shape or are not integers
    """
    grad_row, grad_col = _checked_gradient(grad_row, grad_col)
    if norm == "L1":
        return (abs(grad_row) + abs(grad_col)).astype(np.int32)
    squared = grad_row**2 + grad_col**2
    if norm == "L2 squared":
        return squared
    if norm == "L2":
        return np.sqrt(squared)
    raise ValueError(
        f'norm must be "L1", "L2" or "L2 squared", got {norm!r}; cv2.Canny uses "L1" unless told otherwise'
    )


def direction(grad_row, grad_col):
    """Which two of the eight neighbours the gradient points at and away from.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them

    Returns
    -------
    (H, W) uint8, the number k of the angle 45° k that is nearest (opposite directions count as one):
    0 right or left, 1 down-right or up-left, 2 down or up, 3 down-left or up-right.
    Exactly between two, OpenCV's approximation 13573 / 2**15 of tan 22.5° decides; a gradient of zero, which
    has no direction, gets 1.

    Raises
    ------
    ValueError : gradients that differ in shape or are not integers

    Source: the sector test in OpenCV's canny.cpp, in whole numbers.
    """
    grad_row, grad_col = _checked_gradient(grad_row, grad_col)
    down, right = abs(grad_row) << TAN_SHIFT, abs(grad_col) << TAN_SHIFT
    flat = abs(grad_col) * TAN_22  # a gradient this far down for its way right has 22.5°
    steep = flat + 2 * right  # and this far down, 67.5°
    diagonal = np.where((grad_row < 0) != (grad_col < 0), DOWN_LEFT, DOWN_RIGHT)
    return np.where(down < flat, RIGHT, np.where(down > steep, DOWN, diagonal)).astype(np.uint8)


def gradient_angle(grad_row, grad_col):
    """Angle of the gradient, for drawing it as a hue or an arrow.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them

    Returns
    -------
    (H, W) float64 degrees, -180 < angle <= 180: 0 to the right, 90 down (rows grow downwards); 0 where there
    is no gradient

    Raises
    ------
    ValueError : gradients that differ in shape or are not integers
    """
    grad_row, grad_col = _checked_gradient(grad_row, grad_col)
    return np.degrees(np.arctan2(grad_row, grad_col))


def _checked_gradient(grad_row, grad_col):
    grad_row, grad_col = np.asarray(grad_row), np.asarray(grad_col)
    for name, grad in (("grad_row", grad_row), ("grad_col", grad_col)):
        if grad.dtype.kind != "i" or grad.ndim != 2:
            raise ValueError(
                f"{name} must be (H, W) signed integers, got {grad.shape} {grad.dtype}; "
                f"take both gradients from sobel(gray)"
            )
    if grad_row.shape != grad_col.shape:
        raise ValueError(
            f"grad_row and grad_col must have one shape, got {grad_row.shape} and {grad_col.shape}; "
            f"take both from one call of sobel(gray)"
        )
    return grad_row.astype(np.int64), grad_col.astype(np.int64)
