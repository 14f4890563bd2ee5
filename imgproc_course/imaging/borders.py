"""Border handling: the values that a filter reads outside the image."""

from typing import Literal

import numpy as np

# Our word for a border -> NumPy's. OpenCV calls them BORDER_REFLECT_101 (dcb|abcd|cba) and BORDER_REPLICATE.
NUMPY_PAD_MODES: dict[str, Literal["reflect", "edge"]] = {"reflect_101": "reflect", "replicate": "edge"}


def pad_border(image, margin, border):
    """Return the image with `margin` more pixels on each of its four sides.

    Parameters
    ----------
    image : (H, W, ...) array
    margin : pixels to add on each side
    border : "reflect_101" mirrors the image about its outermost pixels, as OpenCV's filters do: dcb|abcd|cba;
        "replicate" repeats the outermost pixels: aaa|abcd|ddd

    Returns
    -------
    (H + 2 margin, W + 2 margin, ...) array of the same dtype
    """
    widths = [(margin, margin)] * 2 + [(0, 0)] * (image.ndim - 2)
    return np.pad(image, widths, mode=NUMPY_PAD_MODES[border])
