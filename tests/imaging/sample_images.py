"""Gray and colour images that reveal mistakes: each of them provokes one kind."""

import numpy as np


def gray_samples():
    """Return a dict: name -> (H, W) uint8."""
    rng = np.random.default_rng(7)
    row, col = np.mgrid[:48, :64]
    distance = np.hypot(row - 23.5, col - 31.5)
    noise = rng.integers(0, 256, (48, 64), dtype=np.uint8)
    frozen = noise.copy()
    frozen.flags.writeable = False
    return {
        "flat": np.full((20, 30), 77, np.uint8),
        "black": np.zeros((9, 9), np.uint8),
        "white": np.full((9, 9), 255, np.uint8),
        "one step right": np.where(col < 32, 40, 200).astype(np.uint8),
        "one step down": np.where(row < 24, 200, 40).astype(np.uint8),
        "faint step": np.where(col < 32, 100, 101).astype(np.uint8),
        "diagonal step": np.where(row + col < 50, 30, 220).astype(np.uint8),
        "steep step": np.where(2 * row + 5 * col < 180, 30, 220).astype(np.uint8),
        "step at the border": np.where(col < 1, 0, 255).astype(np.uint8),
        "ring": np.where(np.abs(distance - 15) < 4, 220, 30).astype(np.uint8),
        "soft ring": (128 + 100 * np.exp(-(((distance - 15) / 3) ** 2))).astype(np.uint8),
        "checkerboard": ((row // 5 + col // 5) % 2 * 255).astype(np.uint8),
        "finest checkerboard": ((row + col) % 2 * 255).astype(np.uint8),
        "ramp": (3 * col + row).astype(np.uint8),
        "noise": noise,
        "noise of few levels": rng.choice(np.array([10, 90, 91, 250], np.uint8), (48, 64)),
        "dark noise": rng.integers(0, 5, (48, 64), dtype=np.uint8),
        "white square": np.pad(np.full((12, 12), 255, np.uint8), 10),
        "single white pixel": np.pad(np.full((1, 1), 255, np.uint8), 7),
        "weak edge that ends in a strong one": _fading_edge(),
        "padded view": np.pad(noise, 3)[3:-3, 3:-3],
        "every second pixel": np.repeat(np.repeat(noise, 2, axis=0), 2, axis=1)[::2, ::2],
        "transposed": np.asfortranarray(noise).T,
        "upside down": noise[::-1, ::-1],
        "read-only": frozen,
        "1×1": np.full((1, 1), 200, np.uint8),
        "1×2": np.array([[0, 255]], np.uint8),
        "1×N": noise[:1].copy(),
        "N×1": noise[:, :1].copy(),
        "2×2": np.array([[0, 255], [255, 0]], np.uint8),
        "2×N": noise[:2].copy(),
        "3×3": noise[:3, :3].copy(),
        "31 columns": noise[:40, :31].copy(),
    }


def _fading_edge():
    """A wavy edge whose step fades from strong to faint along its length; its pixels touch at corners."""
    row, col = np.mgrid[:60, :60]
    border = 30 + np.round(6 * np.sin(row / 4.0))
    return np.where(col < border, 100, 100 + 120 - 2 * row).astype(np.uint8)


def bgr_samples():
    """Return a dict: name -> (H, W, 3) uint8."""
    rng = np.random.default_rng(8)
    noise = rng.integers(0, 256, (40, 50, 3), dtype=np.uint8)
    primaries = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255] * 3, [0] * 3]], np.uint8)
    frozen = noise.copy()
    frozen.flags.writeable = False
    return {
        "noise": noise,
        "primaries": primaries,
        "white": np.full((5, 5, 3), 255, np.uint8),
        "dark": rng.integers(0, 8, (40, 50, 3), dtype=np.uint8),
        "1×1": np.array([[[1, 2, 250]]], np.uint8),
        "padded view": np.pad(noise, ((2, 2), (3, 3), (0, 0)))[2:-2, 3:-3],
        "rgb reversed to bgr": noise[..., ::-1],
        "upside down": noise[::-1],
        "read-only": frozen,
    }
