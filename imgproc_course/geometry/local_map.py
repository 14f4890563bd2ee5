"""What a robot has seen around it, on a grid, and the cheapest route through it."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .grids import update_grid

RANGE = 4.0  # metres: a longer ray of a scan is cut off there
BODY, COMFORT = 0.15, 0.40  # metres from a route's cells to what is occupied: never less, better more
CLOSE_COST, COMFORT_COST = 200.0, 32.0


class LocalMap:
    """An occupancy grid of what scans hit, with the low points that no scan can see, for finding a route.

    Parameters
    ----------
    corner : (x, y) of the corner of cell (0, 0) in metres; size : (rows, columns); cell : metres
        Rows go along y, columns along x. The frame is any in which the robot's pose does not jump.

    Attributes
    ----------
    log_odds : (rows, columns) float64; above 0 a scan has hit something there
    low : (rows, columns) bool; True where there is something that no scan sees
    """

    def __init__(self, corner: ArrayLike, size: tuple[int, int], cell: float = 0.05) -> None:
        self._corner, self._cell = np.asarray(corner, float), cell
        self.log_odds, self.low = np.zeros(size), np.zeros(size, bool)
        rows, cols = np.indices(size)
        self._centers = self._corner + cell * (np.stack([cols, rows], -1) + 0.5)

    def add_scan(self, pose: Iterable[float], offset: float, ranges: ArrayLike) -> None:
        """Adds a turn of a laser scanner.

        pose : (x, y, yaw) of the robot; offset : metres from its axle ahead to the scanner
        ranges : (N,) metres, counterclockwise from straight ahead; inf: nothing is hit, NaN: nothing is known
        """
        x, y, yaw = pose
        lengths = np.asarray(ranges, float)
        angles = yaw + np.arange(len(lengths)) * (2 * math.pi / len(lengths))
        angles, lengths = angles[~np.isnan(lengths)], lengths[~np.isnan(lengths)]
        start = np.array([x + offset * math.cos(yaw), y + offset * math.sin(yaw)])
        rays = np.minimum(lengths, RANGE)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
        hits, ends = lengths < RANGE, self._cells(start + rays)
        self.log_odds = update_grid(self.log_odds, self._cells(start), ends, hits)

    def add_low_points(
        self, pose: Iterable[float], points: ArrayLike, *, near: float, far: float, slope: float
    ) -> None:
        """Adds what a camera sees and a scan does not; what was seen there before, and not now, is forgotten.

        pose : (x, y, yaw) of the robot; points : (N, 2), metres ahead and to the left of it; NaN is no point
        near, far, slope : the camera sees places from near to far ahead, and up to slope · ahead beside that
        """
        ahead, left = self._seen_from(pose)
        self.low &= ~((ahead > near) & (ahead < far) & (np.abs(left) < slope * ahead))
        x, y, yaw = pose
        c, s = math.cos(yaw), math.sin(yaw)
        points = np.asarray(points, float).reshape(-1, 2)
        ahead, left = points[np.isfinite(points).all(1)].T
        cells = self._cells(np.column_stack([x + c * ahead - s * left, y + s * ahead + c * left]))
        self.low[tuple(cells[((cells >= 0) & (cells < self.low.shape)).all(-1)].T)] = True

    def low_points(self, pose: Iterable[float]) -> NDArray[np.float64]:
        """The centers of the cells of `low`, (N, 2), metres ahead and to the left of the robot."""
        ahead, left = self._seen_from(pose)
        return np.column_stack([ahead[self.low], left[self.low]])

    def route(self, start: ArrayLike, end: ArrayLike) -> NDArray[np.float64]:
        """The cheapest route from (x, y) to (x, y), (N, 2) float64 in metres, both ends included.

        A cell costs more the nearer it is to something, and much more if the body does not fit there. There
        is always a route: ends outside of the map are moved to its border. Cells not yet seen count as free.

        Source: Dijkstra's shortest path, as skimage.graph.route_through_array computes it.
        """
        # Here, because their import takes most of a second and nothing else of this package needs them.
        from scipy.ndimage import distance_transform_edt

        try:
            from skimage.graph import route_through_array
        except ModuleNotFoundError as error:
            raise ModuleNotFoundError(
                "a route needs skimage: pip install scikit-image", name=error.name
            ) from error

        occupied = (self.log_odds > 0) | self.low
        distance = self._cell * distance_transform_edt(~occupied) if occupied.any() else np.inf
        cost = 1 + COMFORT_COST * np.clip(1 - distance / COMFORT, 0, None) + CLOSE_COST * (distance < BODY)
        cost = np.broadcast_to(cost, occupied.shape)
        limits = np.array(occupied.shape) - 1
        first, last = (np.clip(self._cells(np.asarray(place, float)), 0, limits) for place in (start, end))
        cells, _ = route_through_array(cost, first, last, fully_connected=True, geometric=True)
        return self._corner + self._cell * (np.array(cells)[:, ::-1] + 0.5)

    def _cells(self, places):
        """Row and column (..., 2) int64 of places (..., 2), x and y."""
        return np.floor((places - self._corner) / self._cell).astype(np.int64)[..., ::-1]

    def _seen_from(self, pose):
        """Metres ahead and to the left, (rows, columns) each, of the cells' centers."""
        x, y, yaw = pose
        c, s = math.cos(yaw), math.sin(yaw)
        dx, dy = self._centers[..., 0] - x, self._centers[..., 1] - y
        return c * dx + s * dy, c * dy - s * dx
