"""Short names for the arrays in this package's signatures: the type says the dtype, the name the shape.

The modules that use them postpone annotations (__future__): so help() and a tooltip show the short name.
"""

import numpy as np
from numpy.typing import NDArray

Gray = NDArray[np.uint8]  # (H, W), gray levels; of a binary image 0 and 255
Bgr = NDArray[np.uint8]  # (H, W, 3), channel order blue, green, red
GrayOrBgr = NDArray[np.uint8]
Gradient = NDArray[np.signedinteger]  # (H, W), along one axis; int32 from `sobel`
Magnitude = NDArray[np.number]  # (H, W)
Direction = NDArray[np.uint8]  # (H, W), 0..3
Mask = NDArray[np.bool_]  # (H, W)
