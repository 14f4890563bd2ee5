"""Border handling: the values that a filter reads outside the image."""

from typing import Literal

import numpy as np

# Our word for a border -> NumPy's. BORDER_REFLECT_101 in OpenCV mirrors the image about its outermost pixels
# (dcb|abcd|cba), BORDER_REPLICATE repeats them (aaa|abcd|ddd).
NUMPY_PAD_MODES: dict[str, Literal["reflect", "edge"]] = {"reflect_101": "reflect", "replicate": "edge"}


def pad_border(image, margin, border):
    """The image with `margin` more pixels on each of its four sides."""
    widths = [(margin, margin)] * 2 + [(0, 0)] * (image.ndim - 2)
    return np.pad(image, widths, mode=NUMPY_PAD_MODES[border])
