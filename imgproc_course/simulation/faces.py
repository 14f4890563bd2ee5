"""Faces drawn from twelve numbers each: their identity, light and turn are known, and they are of nobody.

The head is an ellipsoid that is turned about its vertical axis and lit by one lamp (Lambert's law). Eyes,
nose and mouth are soft ellipses on its front. Only + - * / and square roots: the pixels are the same on every
processor.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

# What the twelve numbers mean, and their ranges; lengths in half heights of the head, rows downwards.
RANGES = {
    "width": (0.68, 0.80),
    "eye distance": (0.27, 0.34),  # from the middle of the face to the middle of an eye
    "eye row": (-0.16, -0.06),
    "eye size": (0.075, 0.105),
    "brow gap": (0.13, 0.19),  # above the eye
    "brow thickness": (0.025, 0.05),
    "nose length": (0.28, 0.38),
    "nose width": (0.10, 0.16),
    "mouth row": (0.46, 0.56),
    "mouth width": (0.20, 0.30),
    "hairline": (-0.68, -0.52),
    "skin": (0.55, 1.0),  # brightness
}
SPAN = 2.1  # side of the image
DEPTH = 0.85  # half an axis of the head from front to back
SKIN, HAIR, LIP, IRIS = np.array([[140, 175, 225], [30, 38, 50], [95, 95, 165], [35, 40, 55]]) / 255  # bgr
BACKGROUND = 120  # gray level of draw_face
# The box that a detector marks: left, top, width and height, as shares of the image's side.
FACE = (0.13, 0.13, 0.74, 0.74)


def random_identity(rng: np.random.Generator) -> NDArray[np.float64]:
    """The twelve numbers of a face, uniform in RANGES: (12,) float64."""
    return rng.uniform(*np.array(list(RANGES.values())).T)


def draw_face(
    identity: ArrayLike, size: int = 64, side_light: float = 0.0, yaw: float = 0.0
) -> NDArray[np.uint8]:
    """A face on a gray background.

    Parameters
    ----------
    identity : (12,) float, as `random_identity` gives
    size : side of the image, in pixels
    side_light : -1..1; 0 is light from the front, 1 a lamp far to the right, -1 to the left
    yaw : how far the head is turned, in radians; positive to the right

    Returns
    -------
    (size, size, 3) uint8, bgr
    """
    background = np.full((size, size, 3), BACKGROUND, np.uint8)
    return put_face(background, identity, 0, 0, size, side_light, yaw)[0]


def put_face(
    frame: NDArray[np.uint8],
    identity: ArrayLike,
    left: int,
    top: int,
    size: int,
    side_light: float = 0.0,
    yaw: float = 0.0,
) -> tuple[NDArray[np.uint8], tuple[int, int, int, int]]:
    """A frame with a face drawn over it.

    Parameters
    ----------
    frame : (H, W, 3) uint8, bgr; it stays as it is
    left, top : pixel of the upper left corner of the drawn square; the square must lie in the frame
    identity, size, side_light, yaw : as for `draw_face`

    Returns
    -------
    ((H, W, 3) uint8, (left, top, width, height)): the new frame, and the box of the face, from brows to chin

    Raises
    ------
    ValueError : the square does not lie in the frame
    """
    height, width = frame.shape[:2]
    if not (0 <= left <= width - size and 0 <= top <= height - size):
        raise ValueError(
            f"a face of {size} pixels at column {left} and row {top} does not lie in a frame of "
            f"{width} × {height}; choose left up to {width - size} and top up to {height - size}"
        )
    colors, mask = _rendered(identity, size, side_light, yaw)
    frame = frame.copy()
    part = frame[top : top + size, left : left + size]
    part[:] = np.round(255 * mask * colors + part * (1 - mask)).astype(np.uint8)
    share_left, share_top, *_ = FACE
    side = round(FACE[2] * size)
    return frame, (left + round(share_left * size), top + round(share_top * size), side, side)


def _rendered(identity, size, side_light, yaw):
    """(colors (size, size, 3) in 0..1, mask (size, size, 1) in 0..1) of a head."""
    x, y, normal, mask = _head(identity[0], size, yaw)
    height = _height_map(identity, x, y)
    slope_row, slope_col = np.gradient(height, SPAN / size)
    normal = normal - np.stack([slope_col, slope_row, np.zeros_like(x)])
    lamp = np.array([2.0 * side_light, -0.35, 1.0])
    squared_lengths = (normal**2).sum(axis=0) * (lamp**2).sum()
    brightness = (normal * lamp[:, None, None]).sum(axis=0) / np.sqrt(squared_lengths)
    shade = 0.3 + 0.75 * np.clip(brightness, 0, 1)
    return np.clip(_albedo(identity, x, y) * shade[..., None], 0, 1), mask[..., None]


def _head(width, size, yaw):
    """Where each pixel's ray meets the turned ellipsoid: x (right) and y (down) on the head, normal, mask."""
    y, u = (np.mgrid[:size, :size] + 0.5) * (SPAN / size) - SPAN / 2
    cos, sin = math.cos(yaw), math.sin(yaw)
    a, b = 1 / width**2, 1 / DEPTH**2
    # The ray at (u, y) runs along w: (x, z) = (u cos - w sin, u sin + w cos); a x² + y² + b z² = 1.
    A, B = a * sin * sin + b * cos * cos, u * sin * cos * (b - a)
    C = u * u * (a * cos * cos + b * sin * sin) + y * y - 1
    discriminant = B * B - A * C
    w = (np.sqrt(np.maximum(discriminant, 0)) - B) / A
    x, z = u * cos - w * sin, u * sin + w * cos
    normal = np.stack([a * x * cos + b * z * sin, y, b * z * cos - a * x * sin])
    normal = normal / np.sqrt((normal**2).sum(axis=0))
    return x, y, normal, np.clip(0.5 + discriminant / A * size / 5, 0, 1)


def _spot(x, y, half_width, half_height, softness):
    """1 inside an ellipse around (0, 0), 0 outside, with a soft border."""
    return np.clip((1 - np.sqrt((x / half_width) ** 2 + (y / half_height) ** 2)) / softness + 0.5, 0, 1)


def _height_map(identity, x, y):
    """How far nose, brows, sockets and lips stand out of the ellipsoid."""
    _, eye_x, eye_y, eye, _, _, nose, nose_width, mouth_y, mouth_width, *_ = identity
    ridge = _spot(x, y - eye_y - 0.5 * nose, 0.6 * nose_width, 0.75 * nose, 1.5)
    tip = _spot(x, y - eye_y - nose, nose_width, 0.1, 1.5)
    lips = _spot(x, y - mouth_y, mouth_width, 0.1, 1.5)
    sockets = sum(_spot(x - side * eye_x, y - eye_y, 2.2 * eye, 1.8 * eye, 1.5) for side in (-1, 1))
    return 0.10 * ridge + 0.08 * tip + 0.03 * lips - 0.07 * sockets


def _albedo(identity, x, y):
    """(H, W, 3): the color of each point of the head, without light."""
    _, eye_x, eye_y, eye, gap, thickness, nose, nose_width, mouth_y, mouth_width, hairline, skin = identity
    color = np.broadcast_to(skin * SKIN, (*x.shape, 3))

    def paint(mask, paint_color):
        nonlocal color
        color = color * (1 - mask[..., None]) + np.asarray(paint_color) * mask[..., None]

    for side in (-1, 1):
        eye_col = x - side * eye_x
        paint(0.45 * _spot(eye_col, y - eye_y + 0.03, 2.3 * eye, 1.9 * eye, 0.8), 0.3 * SKIN)
        paint(_spot(eye_col, y - eye_y, 1.5 * eye, 0.7 * eye, 0.3), (0.85, 0.85, 0.85))
        paint(_spot(eye_col, y - eye_y, 0.75 * eye, 0.75 * eye, 0.3), IRIS)
        arch = y - eye_y + gap + 0.8 * eye_col * eye_col - 0.02
        paint(0.9 * _spot(eye_col, arch, 2.2 * eye, 1.5 * thickness, 0.7), HAIR)
        nostril_col, nostril_row = x - 0.5 * side * nose_width, y - eye_y - nose - 0.03
        paint(0.7 * _spot(nostril_col, nostril_row, 0.4 * nose_width, 0.03, 0.8), IRIS)
    paint(0.8 * _spot(x, y - mouth_y, mouth_width, 0.065, 0.5), skin * LIP)
    paint(0.7 * _spot(x, y - mouth_y, 0.95 * mouth_width, 0.018, 0.8), IRIS)
    paint(np.clip(0.5 + (hairline + 0.35 * x * x - y) / 0.08, 0, 1), (0.5 + skin) * HAIR)
    return color
