"""The floor's polish: what it mirrors of the window or the lamp, as a veil that depends on the view."""

from typing import NamedTuple

import numpy as np

COLUMNS, ROWS = 40, 28
AREA = ((-0.9, 5.6), (-2.1, 2.3))  # the floor, x and y in metres
HEIGHT = 0.001


class Source(NamedTuple):
    """A bright rectangle across an axis (1: y, 2: z), and how strong it and the walls are in the mirror."""

    axis: int
    at: float  # metres
    across: tuple[tuple[float, float], tuple[float, float]]  # low and high along the two other axes, metres
    strength: float
    walls: float


SOURCES = {
    "day": Source(1, 2.3, ((1.7, 3.5), (0.85, 2.15)), 9.0, 0.04),  # the window in the wall
    "evening": Source(2, 2.4, ((1.35, 1.85), (-0.45, 0.05)), 6.0, 0.02),  # the lamp below the ceiling
}
COLOR = {"day": (235, 228, 220), "evening": (236, 196, 148)}  # red, green, blue
ROUGHNESS = 0.12  # the mirrored edge is this soft, in metres on each metre of the ray


class Sheen:
    """A grid of vertices over the floor; `colors` gives each its color and cover."""

    def __init__(self, lighting):
        (x0, x1), (y0, y1) = AREA
        x, y = np.meshgrid(np.linspace(x0, x1, COLUMNS + 1), np.linspace(y0, y1, ROWS + 1))
        self.vertices = np.stack([x, y, np.full_like(x, HEIGHT)], -1).reshape(-1, 3)
        first = (np.arange(ROWS)[:, None] * (COLUMNS + 1) + np.arange(COLUMNS)).ravel()
        above = first + COLUMNS + 1
        self.indices = np.stack([first, first + 1, above + 1, first, above + 1, above], 1)
        self._source, self._color = SOURCES[lighting], COLOR[lighting]

    def colors(self, eye):
        """(N, 4) uint8, red, green, blue, alpha, for an eye at (3,): Schlick's Fresnel × light."""
        rays = self.vertices - np.asarray(eye)
        rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
        grazing = 1 + rays[:, 2]  # 1 - cosine of the angle of incidence
        squared = grazing * grazing
        fresnel = 0.04 + 0.96 * squared * squared * grazing
        rays[:, 2] *= -1
        source, axis = self._source, self._source.axis
        ahead = rays[:, axis] > 1e-3
        way = np.where(ahead, (source.at - self.vertices[:, axis]) / np.where(ahead, rays[:, axis], 1), 1e9)
        soft = ROUGHNESS * np.maximum(way, 0.3)
        light = np.where(ahead, 1.0, 0.0)
        for other, (low, high) in zip([k for k in range(3) if k != axis], source.across, strict=True):
            hit = self.vertices[:, other] + way * rays[:, other]
            light *= step((hit - low) / soft) * step((high - hit) / soft)
        cover = fresnel * (source.walls + source.strength * light)
        alpha = np.clip(cover * 255, 0, 200)
        return np.column_stack([np.tile(self._color, (len(alpha), 1)), alpha]).astype(np.uint8)


def step(x):
    """From 0 to 1, soft around 0: 1/2 + x / (2 √(4 + x²)). Square roots are the same on every processor."""
    return 0.5 + x / (2 * np.sqrt(4 + x * x))
