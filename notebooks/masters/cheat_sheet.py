"""The names that the examples of cheat_sheet.html use."""

import numpy as np

from imgproc_course.imaging import canny_stages
from imgproc_course.messages import array_to_image, encoding_info

# ---------------------------------------------------------------- page 1: arrays

tiny = np.array(
    [[10, 10, 200, 10, 10],
     [10, 10, 200, 10, 10],
     [90, 90, 200, 90, 90],
     [10, 10, 200, 10, 10],
     [10, 10, 200, 10, 0]],
    dtype=np.uint8)  # fmt: skip
# Indexed like tiny, it says which pixels of tiny an index or a slice selects.
pixel_numbers = np.arange(25).reshape(5, 5)
row = np.array([10, 10, 10, 200, 200, 200])
original = tiny.copy()

colour = np.zeros((5, 5, 3), np.uint8)
colour[:2, :, 0] = 255  # two blue rows, a green one, two red ones
colour[2, :, 1] = 255
colour[3:, :, 2] = 255

DTYPES = ["bool", "uint8", "uint16", "int16", "int32", "float64"]


def dtype_range(name):
    """The smallest and the largest number of an integer dtype."""
    limits = np.iinfo(name)
    return f"{limits.min:,} to {limits.max:,}".replace("-", "−")


# ---------------------------------------------------------------- page 2: messages and Canny

frame = np.zeros((720, 1280, 3), np.uint8)
message = array_to_image(frame, "bgr8")
ENCODINGS = {
    "mono8": "gray image",
    "mono16": "gray image with 65,536 levels",
    "bgr8": "colour; OpenCV's order of the channels",
    "rgb8": "colour; order of most cameras",
    "bgra8": "bgr8 and a fourth channel, the opacity",
    "16UC1": "depth in millimetres",
    "32FC1": "depth in metres",
}

gray = np.array(
    [[50, 50, 75, 100, 100],
     [50, 50, 65, 80, 80],
     [50, 50, 70, 90, 90],
     [50, 50, 50, 50, 50],
     [50, 50, 55, 60, 60]],
    dtype=np.uint8)  # fmt: skip
stages = canny_stages(gray, 50, 150)
arrows = np.where(stages.magnitude > 0, np.array(list("→↘↓↙"))[stages.direction], "·")
letters = np.where(stages.strong, "S", np.where(stages.weak, "w", "·"))
