"""Writes compressedDepth, as ROS's compressed_depth_image_transport does; the package only reads it.

`imgproc_course.messages.depth` describes the format.
"""

import struct
from types import SimpleNamespace

import cv2
import numpy as np

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
        body = struct.pack("<II", values.shape[1], values.shape[0]) + rvl_encode(values.ravel().tolist())
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


def rvl_encode(pixels):
    """RVL stream of a list of pixels, as the paper describes it: one number and one nibble after another."""
    nibbles = []

    def write(number):
        while True:
            number, low = number >> 3, number & 7
            nibbles.append(low | (8 if number else 0))
            if not number:
                return

    at, previous = 0, 0
    while at < len(pixels):
        zeros = 0
        while at + zeros < len(pixels) and pixels[at + zeros] == 0:
            zeros += 1
        at += zeros
        nonzeros = 0
        while at + nonzeros < len(pixels) and pixels[at + nonzeros] != 0:
            nonzeros += 1
        write(zeros)
        write(nonzeros)
        for value in pixels[at : at + nonzeros]:
            difference = value - previous
            write(2 * difference if difference >= 0 else -2 * difference - 1)
            previous = value
        at += nonzeros
    nibbles += [0] * (-len(nibbles) % 8)
    words = [int("".join(f"{n:x}" for n in nibbles[i : i + 8]), 16) for i in range(0, len(nibbles), 8)]
    return struct.pack(f"<{len(words)}I", *words)
