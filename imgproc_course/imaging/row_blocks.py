"""The values that a filter reads outside the image, and blocks of rows that fit a core's cache."""

from typing import Literal

import numpy as np

# Our word for a border -> NumPy's. BORDER_REFLECT_101 in OpenCV mirrors the image about its outermost pixels
# (dcb|abcd|cba), BORDER_REPLICATE repeats them (aaa|abcd|ddd).
NUMPY_PAD_MODES: dict[str, Literal["reflect", "edge"]] = {"reflect_101": "reflect", "replicate": "edge"}

# About ten arrays of int16 are alive at a time; with this many pixels each they stay in a core's cache.
BLOCK_PIXELS = 80_000


def pad_border(image, margin, border):
    """The image with `margin` more pixels on each of its four sides."""
    widths = [(margin, margin)] * 2 + [(0, 0)] * (image.ndim - 2)
    return np.pad(image, widths, mode=NUMPY_PAD_MODES[border])


def row_blocks(image, minimum_rows=8):
    """Yield (top, bottom), bottom excluded, of blocks; steps over a whole image would wait for memory."""
    rows, row_size = len(image), image[0].size
    block_rows = max(minimum_rows, BLOCK_PIXELS // row_size)
    for top in range(0, rows, block_rows):
        yield top, min(top + block_rows, rows)


def filter_blocks(image, margin, border, filter_block):
    """A uint8 image of the same shape, whose blocks of rows a function makes from those of `image`.

    The function receives a block with `margin` more pixels on each of its four sides.
    """
    padded = pad_border(image, margin, border)
    filtered = np.empty(image.shape, np.uint8)
    for top, bottom in row_blocks(image, minimum_rows=8 * margin):
        filtered[top:bottom] = filter_block(padded[top : bottom + 2 * margin])
    return filtered
