"""Writes compressedDepth, as ROS's compressed_depth_image_transport does; the package only reads it.

`imgproc_course.messages.depth` describes the format.
"""

import struct
from types import SimpleNamespace

import cv2
import numpy as np

MAX_NIBBLES = 11  # of a number of 32 bits
LARGEST_DEPTH = 10.0  # metres that the 65535 steps of 1 / depth reach


def depth_to_compressed(array, encoding="16UC1", format="png"):
    """A message of (H, W) uint16 as "16UC1" (stored exactly), or of float32 metres as "32FC1"."""
    a = b = 0.0
    if encoding == "32FC1":
        array, a, b = quantized(array)
    values = np.ascontiguousarray(array.reshape(array.shape[:2]), np.uint16)
    if format == "png":
        body = cv2.imencode(".png", values)[1].tobytes()
    else:
        body = struct.pack("<II", values.shape[1], values.shape[0]) + rvl_encode(values)
    return SimpleNamespace(
        format=f"{encoding}; compressedDepth {format}", data=struct.pack("<iff", 0, a, b) + body
    )


def quantized(metres):
    """(values uint16, A, B), with the quantization of 100, as in ROS; 0 for what cannot be measured."""
    a = np.float32(100.0 * 101.0)
    b = np.float32(1.0 - a / LARGEST_DEPTH)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        q = np.rint(a / metres + b)
    is_measured = (metres > 0) & (metres < LARGEST_DEPTH) & (q >= 1) & (q <= 65535)
    return np.where(is_measured, q, 0).astype(np.uint16), a, b


def rvl_encode(depth):
    """RVL stream of a depth image.

    Parameters
    ----------
    depth : array of uint16, any shape

    Returns
    -------
    bytes; their number is a multiple of 4
    """
    flat = np.ascontiguousarray(depth, np.uint16).ravel()
    present = np.concatenate([[False], flat != 0, [False]])
    edges = np.flatnonzero(present[1:] != present[:-1])
    starts, ends = edges[0::2], edges[1::2]
    zeros, nonzeros = starts - np.concatenate([[0], ends[:-1]]), ends - starts
    tail = flat.size - (ends[-1] if ends.size else 0)

    pixels = np.diff(flat[flat != 0].astype(np.int32), prepend=np.int32(0))
    signed_low = (pixels << 1) ^ (pixels >> 31)
    numbers = np.empty(2 * zeros.size + pixels.size + (2 if tail else 0), np.uint32)
    pixels_before = np.concatenate([[0], np.cumsum(nonzeros)])  # nonzero pixels before each run
    run_starts = 2 * np.arange(zeros.size) + pixels_before[:-1]
    numbers[run_starts], numbers[run_starts + 1] = zeros, nonzeros
    numbers[np.arange(pixels.size) + 2 * np.repeat(np.arange(1, zeros.size + 1), nonzeros)] = signed_low
    if tail:
        numbers[-2:] = tail, 0
    return to_words(numbers)


def to_words(numbers):
    lengths = np.ones(numbers.size, np.int64)
    for nibble in range(1, MAX_NIBBLES):
        lengths += (numbers >> np.uint32(3 * nibble)) != 0
    starts = np.cumsum(lengths) - lengths
    nibbles = np.zeros(-(-int(lengths.sum()) // 8) * 8, np.uint8)
    for nibble in range(lengths.max(initial=0)):
        longer = lengths > nibble
        more = (lengths[longer] > nibble + 1) * np.uint8(8)
        nibbles[starts[longer] + nibble] = (numbers[longer] >> np.uint32(3 * nibble)) & 7 | more
    highest_first = nibbles[0::2] << 4 | nibbles[1::2]
    return highest_first.view(">u4").astype("<u4").tobytes()
