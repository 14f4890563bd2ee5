"""The gradient of the gray levels by Sobel's kernels, its magnitude and its direction."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .array_types import Direction, Gradient, Gray, Magnitude
from .correlation import correlate1d
from .row_blocks import pad_border
from .validation import check_gray

# aperture -> the two one-dimensional kernels of the separable Sobel filter
SMOOTHING = {3: (1, 2, 1), 5: (1, 4, 6, 4, 1), 7: (1, 6, 15, 20, 15, 6, 1)}
DIFFERENCE = {3: (-1, 0, 1), 5: (-1, -2, 0, 2, 1), 7: (-1, -4, -5, 0, 5, 4, 1)}

# The gradient's direction, in four sectors: one for each pair of opposite neighbours.
# Sector k is around the angle 45° k; rows grow downwards, so 90° points down.
RIGHT, DOWN_RIGHT, DOWN, DOWN_LEFT = 0, 1, 2, 3

# tan 22.5° in units of 2**-15, as OpenCV rounds it; tan 67.5° is exactly 2 more.
TAN_22 = 13573
TAN_SHIFT = 15


def check_aperture(aperture):
    """Return the aperture as an int; raise ValueError if Sobel has no kernel of this side."""
    if not isinstance(aperture, int | np.integer) or aperture not in SMOOTHING:
        raise ValueError(f"aperture must be 3, 5 or 7 pixels, got {aperture!r}; use 3 if unsure")
    return int(aperture)


def sobel(gray: Gray, aperture: int = 3) -> tuple[Gradient, Gradient]:
    """Gradient of an image by Sobel's kernels: a difference along one axis, smoothing along the other.

    Aperture 3: grad_col correlates the image with -1 0 1 / -2 0 2 / -1 0 1, grad_row with the transpose.
    A straight step of h gray levels gives at most 4 h (aperture 3), 48 h (5), 640 h (7).

    Parameters
    ----------
    gray : (H, W) uint8
    aperture : 3, 5 or 7, side of the kernel in pixels

    Returns
    -------
    grad_row : (H, W) int32, positive where the levels rise from one row to the next (downwards)
    grad_col : (H, W) int32, positive where the levels rise from one column to the next (to the right)

    Raises
    ------
    ValueError : any other shape, dtype or aperture

    Source: cv2.Sobel with BORDER_REPLICATE; grad_row is its dy, grad_col its dx.

    Examples
    --------
    >>> grad_row, grad_col = sobel(np.array([[0, 0, 10, 10]], np.uint8))
    >>> print(grad_row, grad_col)
    [[0 0 0 0]] [[ 0 40 40  0]]
    """
    aperture = check_aperture(aperture)
    padded = pad_border(check_gray(gray).astype(np.int32), aperture // 2, "replicate")
    smoothing, difference = SMOOTHING[aperture], DIFFERENCE[aperture]
    grad_row = correlate1d(correlate1d(padded, difference, axis=0), smoothing, axis=1)
    grad_col = correlate1d(correlate1d(padded, smoothing, axis=0), difference, axis=1)
    return grad_row, grad_col


def magnitude(
    grad_row: Gradient, grad_col: Gradient, norm: Literal["L1", "L2", "L2 squared"] = "L1"
) -> Magnitude:
    """Gradient magnitude at every pixel.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them
    norm : "L1" is |grad_row| + |grad_col|, the default of cv2.Canny;
        "L2" is the Euclidean norm sqrt(grad_row² + grad_col²);
        "L2 squared" is grad_row² + grad_col², which cv2.Canny compares with L2gradient=True: no root, no
        rounding

    Returns
    -------
    (H, W) int32 for "L1", float64 for "L2", int64 for "L2 squared"; L1 and L2 in the unit of the gradient

    Raises
    ------
    ValueError : another norm, gradients that differ in shape or are not integers

    Examples
    --------
    >>> print(magnitude(np.array([[3, -3, 0]]), np.array([[4, -4, -5]])))
    [[7 7 5]]
    """
    grad_row, grad_col = _check_gradient(grad_row, grad_col)
    if norm == "L1":
        return (abs(grad_row) + abs(grad_col)).astype(np.int32)
    squared = grad_row**2 + grad_col**2
    if norm == "L2 squared":
        return squared
    if norm == "L2":
        return np.sqrt(squared)
    raise ValueError(f'norm must be "L1", "L2" or "L2 squared", got {norm!r}; cv2.Canny takes "L1"')


def direction(grad_row: Gradient, grad_col: Gradient) -> Direction:
    """Gradient direction at every pixel, rounded to one of four sectors.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them

    Returns
    -------
    (H, W) uint8, the number k of the nearest angle 45° k (opposite directions count as one):
    0 right or left, 1 down-right or up-left, 2 down or up, 3 down-left or up-right.
    Halfway between two sectors OpenCV's approximation 13573 / 2**15 of tan 22.5° decides. A gradient of zero
    has no direction and gets 1.

    Raises
    ------
    ValueError : gradients that differ in shape or are not integers

    Source: the sector test in OpenCV's canny.cpp, in integer arithmetic.

    Examples
    --------
    >>> print(direction(np.array([[0, 5, 5, -5]]), np.array([[9, 0, 5, 5]])))
    [[0 2 1 3]]
    """
    grad_row, grad_col = _check_gradient(grad_row, grad_col)
    down, right = abs(grad_row) << TAN_SHIFT, abs(grad_col) << TAN_SHIFT
    down_at_22 = abs(grad_col) * TAN_22  # the value of `down` if the angle is 22.5°
    down_at_67 = down_at_22 + 2 * right  # and if it is 67.5°
    diagonal = np.where((grad_row < 0) != (grad_col < 0), DOWN_LEFT, DOWN_RIGHT)
    return np.where(down < down_at_22, RIGHT, np.where(down > down_at_67, DOWN, diagonal)).astype(np.uint8)


def gradient_angle(grad_row: Gradient, grad_col: Gradient) -> NDArray[np.float64]:
    """Angle of the gradient, to draw it as a hue or an arrow.

    Parameters
    ----------
    grad_row, grad_col : (H, W) integers, as `sobel` returns them

    Returns
    -------
    (H, W) float64 degrees, -180 < angle <= 180: 0 to the right, 90 down (rows grow downwards); 0 where the
    gradient is zero

    Raises
    ------
    ValueError : gradients that differ in shape or are not integers

    Examples
    --------
    >>> print(gradient_angle(np.array([[0, 5, 5]]), np.array([[9, 0, 5]])))
    [[ 0. 90. 45.]]
    """
    grad_row, grad_col = _check_gradient(grad_row, grad_col)
    return np.degrees(np.arctan2(grad_row, grad_col))


def _check_gradient(grad_row, grad_col):
    grad_row, grad_col = np.asarray(grad_row), np.asarray(grad_col)
    for name, grad in (("grad_row", grad_row), ("grad_col", grad_col)):
        if grad.dtype.kind != "i" or grad.ndim != 2:
            raise ValueError(
                f"{name} must be (H, W) signed integers, got {grad.shape} {grad.dtype}; "
                f"take both gradients from sobel(gray)"
            )
    if grad_row.shape != grad_col.shape:
        raise ValueError(
            f"grad_row and grad_col must have the same shape, got {grad_row.shape} and {grad_col.shape}; "
            f"take both from one call of sobel(gray)"
        )
    return grad_row.astype(np.int64), grad_col.astype(np.int64)
