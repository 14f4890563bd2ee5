"""The floor's polish: what it mirrors of the window or the lamp, as a veil that depends on the view."""

import numpy as np

COLUMNS, ROWS = 40, 28
AREA = ((-0.9, 5.6), (-2.1, 2.3))  # the floor, x and y in metres
HEIGHT = 0.001
# Bright rectangles: the window in the wall at y = 2.3 (x and z), or the lamp below the ceiling (x and y).
SOURCES = {
    "day": {"axis": 1, "at": 2.3, "across": ((1.7, 3.5), (0.85, 2.15)), "strength": 9.0, "walls": 0.04},
    "evening": {
        "axis": 2,
        "at": 2.4,
        "across": ((1.35, 1.85), (-0.45, 0.05)),
        "strength": 6.0,
        "walls": 0.02,
    },
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
        """(red, green, blue, alpha) of the vertices for an eye at (3,): Schlick's Fresnel times light."""
        rays = self.vertices - np.asarray(eye)
        length = np.sqrt(rays[:, 0] ** 2 + rays[:, 1] ** 2 + rays[:, 2] ** 2)
        rays = rays / length[:, None]
        grazing = 1 + rays[:, 2]  # 1 - cosine of the angle of incidence
        squared = grazing * grazing
        fresnel = 0.04 + 0.96 * squared * squared * grazing
        rays[:, 2] *= -1
        axis, source = self._source["axis"], self._source
        ahead = rays[:, axis] > 1e-3
        way = np.where(
            ahead, (source["at"] - self.vertices[:, axis]) / np.where(ahead, rays[:, axis], 1), 1e9
        )
        soft = ROUGHNESS * np.maximum(way, 0.3)
        light = np.where(ahead, 1.0, 0.0)
        for other, (low, high) in zip([k for k in range(3) if k != axis], source["across"], strict=True):
            hit = self.vertices[:, other] + way * rays[:, other]
            light *= step((hit - low) / soft) * step((high - hit) / soft)
        cover = fresnel * (source["walls"] + source["strength"] * light)
        red, green, blue = (np.full(len(cover), c) for c in self._color)
        return red, green, blue, np.clip(cover * 255, 0, 200)


def step(x):
    """From 0 to 1, soft around 0: 1/2 + x / (2 √(4 + x²)). Square roots are the same on every processor."""
    return 0.5 + x / (2 * np.sqrt(4 + x * x))
