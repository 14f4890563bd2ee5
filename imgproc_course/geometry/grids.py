"""Occupancy grids: the cells of a ray, log-odds, one scan into a grid, and a grid's score against a truth."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

OCCUPIED, FREE, LIMIT = 0.85, -0.4, 6.0  # log-odds: of one hit (probability 0.7), one pass (0.4), at most


def grid_ray(start: ArrayLike, end: ArrayLike) -> NDArray[np.int64]:
    """The cells of a straight ray, both ends included: (N, 2) int64, row and column.

    start, end : (2,) whole numbers, row and column; they may lie outside of a grid

    Raises
    ------
    ValueError : other shapes, or no whole numbers

    Source: Bresenham, Algorithm for computer control of a digital plotter, 1965, without its loop: of two
    cells that are equally near, the one farther from the start's row or column; as skimage.draw.line.
    """
    start, end = (np.asarray(cell) for cell in (start, end))
    if not all(cell.shape == (2,) and np.issubdtype(cell.dtype, np.integer) for cell in (start, end)):
        raise ValueError(
            f"a ray needs two cells (row, column) of whole numbers, got {start.tolist()} and {end.tolist()}"
        )
    return _rays(start.astype(np.int64), end.astype(np.int64)[None])[1]


def _rays(start, ends):
    """Of rays from start (2,) to ends (N, 2): the number of each cell's ray (M,), and the cells (M, 2)."""
    way = ends - start
    steps = np.abs(way).max(1)
    ray = np.repeat(np.arange(len(ends)), steps + 1)
    k = np.arange(len(ray)) - np.repeat(np.cumsum(steps + 1) - steps - 1, steps + 1)
    length = np.maximum(steps, 1)[ray, None]
    return ray, start + np.sign(way[ray]) * ((2 * np.abs(way[ray]) * k[:, None] + length) // (2 * length))


def log_odds(probability: ArrayLike) -> NDArray[np.float64]:
    """log(p / (1 - p)) of probabilities between 0 and 1, both excluded; any shape, float64.

    Raises
    ------
    ValueError : a probability that is not between 0 and 1; at the ends the log-odds are infinite
    """
    probability = np.asarray(probability, float)
    if not ((probability > 0) & (probability < 1)).all():
        raise ValueError(f"a probability with log-odds is above 0 and below 1, got {probability.tolist()}")
    return np.log(probability / (1 - probability))


def probability(log_odds: ArrayLike) -> NDArray[np.float64]:
    """1 / (1 + exp(-l)) of log-odds: the inverse of `log_odds`; any shape, float64 from 0 to 1."""
    return 1 / (1 + np.exp(-np.clip(np.asarray(log_odds, float), -700, 700)))


def update_grid(
    grid: ArrayLike,
    robot_cell: ArrayLike,
    end_cells: ArrayLike,
    hits: ArrayLike | None = None,
    *,
    occupied: float = OCCUPIED,
    free: float = FREE,
    limit: float = LIMIT,
) -> NDArray[np.float64]:
    """A new grid, (rows, columns) float64, after one scan: free along the rays, occupied at their ends.

    Each cell changes once in a scan, and where one ray ends no other ray of the scan makes it free. Cells
    outside of the grid are left out.

    Parameters
    ----------
    grid : (rows, columns), log-odds; 0 is unknown
    robot_cell : (2,) whole numbers, row and column of the scanner
    end_cells : (N, 2) whole numbers, where the rays end
    hits : (N,) bool, whether there is something at the end; if omitted, all. A ray without a hit is free
        along its way, and its last cell stays as it is.
    occupied, free : added to a cell; limit : no cell leaves -limit..limit

    Raises
    ------
    ValueError : other shapes, or cells that are no whole numbers

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, table 9.1, with the inverse sensor model of a ray.
    """
    grid, robot_cell, end_cells = np.array(grid, float), np.asarray(robot_cell), np.asarray(end_cells)
    hits = np.ones(len(end_cells), bool) if hits is None else np.asarray(hits, bool)
    whole = all(np.issubdtype(cells.dtype, np.integer) for cells in (robot_cell, end_cells))
    if (grid.ndim, robot_cell.shape, end_cells.shape) != (2, (2,), (len(hits), 2)) or not whole:
        raise ValueError(
            "needs a grid (rows, columns), the robot's cell (2,), end cells (N, 2) of whole numbers and "
            f"hits (N,), got {grid.shape}, {robot_cell.shape} and {end_cells.shape}, {hits.shape}"
        )
    ray, cells = _rays(robot_cell.astype(np.int64), end_cells.astype(np.int64))
    is_end = np.append(ray[1:] != ray[:-1], True)
    change = np.zeros_like(grid)
    for chosen, value in ((~is_end, free), (is_end & hits[ray], occupied)):
        row, col = cells[chosen & ((cells >= 0) & (cells < grid.shape)).all(1)].T
        change[row, col] = value
    return np.clip(grid + change, -limit, limit)


def grid_precision_recall(grid: ArrayLike, truth: ArrayLike, tolerance: int = 1) -> tuple[float, float]:
    """(precision, recall) of the occupied cells of a grid, those with log-odds above 0.

    An occupied cell is right if the truth has one within `tolerance` cells, also diagonally. A cell of the
    truth is found if the grid has one so near; only those count that the grid knows, with log-odds not 0.
    Of no cells at all a share is 0.

    grid : (rows, columns), log-odds; truth : bool of the same shape

    Raises
    ------
    ValueError : shapes that differ
    """
    grid, truth = np.asarray(grid, float), np.asarray(truth, bool)
    if grid.ndim != 2 or grid.shape != truth.shape:
        raise ValueError(f"needs two grids of one shape (rows, columns), got {grid.shape} and {truth.shape}")
    occupied, known_truth = grid > 0, truth & (grid != 0)
    right, found = occupied & _grown(truth, tolerance), known_truth & _grown(occupied, tolerance)
    return float(right.sum() / max(occupied.sum(), 1)), float(found.sum() / max(known_truth.sum(), 1))


def _grown(mask, cells):
    """True where a cell of the mask (rows, columns) is within so many cells."""
    side = 2 * cells + 1
    return np.lib.stride_tricks.sliding_window_view(np.pad(mask, cells), (side, side)).any((2, 3))
