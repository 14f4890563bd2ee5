"""Hands in green gloves, drawn from random numbers, and the ways in which they move: their truth is known.

Sines and powers are rounded before use: every processor draws the same pixels.
"""

import functools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GREEN = (60, 150, 70)  # bgr8
# Of an upright hand, in units of its size, seen from the palm's center: x to the right, y up.
PALM = ((-0.12, -0.02), (0.12, -0.02), 0.44)  # a capsule: two points and a radius
ARM = ((0.0, -0.3), (0.0, -8.0), 0.34)
# In the order in which they are raised: x, y of the root, degrees to the right of upright, length, radius.
FINGERS = (
    (-0.38, 0.30, -15, 1.00, 0.12),  # index finger
    (-0.13, 0.40, -4, 1.15, 0.125),
    (0.14, 0.38, 9, 1.05, 0.12),
    (0.38, 0.25, 24, 0.85, 0.11),
    (-0.38, -0.12, -55, 0.85, 0.15),  # thumb
)
GESTURES = ("swipe left", "swipe right", "raise", "wave", "circle", "stop")


class Hand(NamedTuple):
    """A hand in an image: 0 to 5 fingers are raised, at first the index finger and at last the thumb.

    row, col : of the palm's center, in pixels
    size : in pixels, about the palm's diameter
    turn : in radians, clockwise
    bends : how far each of the five fingers leans to the right, in degrees
    """

    fingers: int
    row: float
    col: float
    size: float
    turn: float = 0.0
    bends: tuple[float, ...] = (0, 0, 0, 0, 0)


def random_hand(rng: np.random.Generator, fingers: int, shape: tuple[int, int] = (180, 240)) -> Hand:
    """A hand with so many raised fingers, which an image of this shape shows whole."""
    height, width = shape
    row, col = rng.uniform(0.56, 0.64) * height, rng.uniform(0.4, 0.6) * width
    bends = tuple(rng.uniform(-3, 3, 5).round(2).tolist())
    return Hand(fingers, row, col, rng.uniform(0.18, 0.24) * height, rng.uniform(-0.4, 0.4), bends)


def hand_mask(hand: Hand, shape: tuple[int, int] = (180, 240)) -> NDArray[np.bool_]:
    """(H, W) bool: the pixels of a hand."""
    return _distance(hand, shape) < 0


def draw_hand(
    frame: NDArray[np.uint8], hand: Hand, noise: float = 0.0, rng: np.random.Generator | None = None
) -> NDArray[np.uint8]:
    """A frame (H, W, 3) uint8, bgr8, with a hand in a green glove before it.

    Parameters
    ----------
    noise : standard deviation, in gray levels, of what is added to the whole frame
    rng : draws the noise
    """
    distance = _distance(hand, frame.shape[:2])[..., None]
    cover = np.clip(0.5 - distance, 0, 1)
    shade = 0.75 + 0.25 * np.clip(-distance / (0.4 * hand.size), 0, 1)  # darker at the outline
    image = frame * (1 - cover) + np.array(GREEN) * shade * cover
    if noise:
        if rng is None:
            raise ValueError("noise needs an rng that draws it, such as np.random.default_rng(1)")
        image = image + noise * rng.standard_normal(image.shape)
    return np.rint(np.clip(image, 0, 255)).astype(np.uint8)


def _distance(hand, shape):
    """(H, W) float32: signed distance of each pixel to the outline of a hand, in pixels, negative inside."""
    rows, cols = np.indices(shape, np.float32, sparse=True)
    right, down = (cols - float(hand.col)) / float(hand.size), (rows - float(hand.row)) / float(hand.size)
    sine, cosine = _direction(hand.turn)
    x, y = right * cosine + down * sine, right * sine - down * cosine
    return hand.size * functools.reduce(np.minimum, (_to_capsule(x, y, *part) for part in _capsules(hand)))


def _capsules(hand):
    """The parts of an upright hand, each the points within a radius of the line between two points."""
    yield PALM
    yield ARM
    for number, ((x, y, degrees, length, radius), bend) in enumerate(zip(FINGERS, hand.bends, strict=True)):
        length *= number < hand.fingers  # of a folded finger only the knuckle is seen
        sine, cosine = _direction(math.radians(degrees + bend))
        yield (x, y), (x + length * sine, y + length * cosine), radius


def _to_capsule(x, y, start, end, radius):
    along_x, along_y = end[0] - start[0], end[1] - start[1]
    x, y = x - start[0], y - start[1]
    share = (x * along_x + y * along_y) / max(along_x * along_x + along_y * along_y, 1e-9)
    share = np.clip(share, 0, 1)
    x, y = x - share * along_x, y - share * along_y
    return np.sqrt(x * x + y * y) - radius


def _direction(angle):
    return round(math.sin(angle), 9), round(math.cos(angle), 9)


def gesture_track(
    gesture: str, rng: np.random.Generator, noise: float = 0.08, uneven: float = 0.4
) -> NDArray[np.float64]:
    """Where the hand is during a gesture, at equal times: (N, 2) float, with N from 18 to 39.

    x to the right, y down, as points of OpenCV; 1 is about half the way of a swipe.

    Parameters
    ----------
    gesture : one of GESTURES
    noise : standard deviation of each number
    uneven : how much the speed changes during the gesture; 0 is a constant speed, and always the same size

    Raises
    ------
    ValueError : an unknown gesture
    """
    if gesture not in GESTURES:
        raise ValueError(f"unknown gesture {gesture!r}; use one of {', '.join(GESTURES)}")
    count = int(rng.integers(18, 40))
    t = np.linspace(0, 1, count) ** (1 + uneven) ** rng.uniform(-1, 1)
    zero, angle = 0 * t, 2 * np.pi * t
    x, y = {
        "swipe left": (1 - 2 * t, zero),
        "swipe right": (2 * t - 1, zero),
        "raise": (zero, 1 - 2 * t),
        "wave": (0.6 * np.sin(3 * angle), zero),
        "circle": (np.cos(angle), np.sin(angle)),
        "stop": (zero, zero),
    }[gesture]
    track = (rng.uniform(0.7, 1.3) if uneven else 1) * np.column_stack([x, y])
    return (track + noise * rng.standard_normal(track.shape)).round(6)
