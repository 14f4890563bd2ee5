# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""Converts the values of a frame to another encoding: first the colors, then the depth, as cv_bridge does.

Both steps give the same bytes as cv_bridge, except where cv_bridge itself is wrong (it turns a float beyond
the range of int32 into the other end of the range).
"""

import functools

import cv2
import numpy as np

from .encodings import ENCODINGS
from .errors import ConversionError

_CHANNEL_ORDERS = {"gray", "rgb", "bgr", "rgba", "bgra"}
_BAYER_IN_OPENCV = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}  # OpenCV names the second row
_PACKED_YUV = ("uyvy", "yuyv")  # two pixels share one pair of U and V
_YUV_IN_OPENCV = {"uyvy": "UYVY", "yuyv": "YUY2", "nv12": "NV12", "nv21": "NV21"}


def converter(source, desired, field="msg.encoding"):
    """The function that makes a fresh frame of one EncodingInfo from one of another; None if no byte changes.

    The colors change at the depth of `source`. Then the depth changes: from 8 to 16 bits × 257, from 16 to 8
    bits / 257 and rounded; every other pair saturates without scaling. Float to integer rounds half to even,
    and NaN becomes the lowest value. An error calls the encoding of the message `field`.
    """
    if source[1:] == desired[1:]:
        return None
    keeps_values = desired.color is None and desired.channels == source.channels
    keeps_meaning = desired.color is not None and desired.color == source.color
    if keeps_values or keeps_meaning:
        recolor = None
    elif source.color and desired.color:
        recolor = _recolor(source, desired)
    else:
        raise ConversionError(_why_not(source, desired, field))
    rescale = _rescale(source.dtype, desired.dtype)

    def convert(frame):
        height, width = source.height(frame.shape[0]), frame.shape[1]
        if frame.size == 0:
            return np.empty(desired.shape(height, width) if recolor else frame.shape, desired.dtype)
        if recolor:
            _check_size(source, height, width)
            frame = recolor(frame)
        return rescale(frame) if rescale else frame

    return convert


def _recolor(source, desired):
    """Function of a frame that converts its colors and keeps its depth."""
    a, b = source.color, desired.color
    if b not in _CHANNEL_ORDERS:
        raise ConversionError(_why_not(source, desired))
    if source.is_planar and b == "gray":
        return lambda planes: planes[: source.height(planes.shape[0])].copy()
    if a == "nv24":
        return functools.partial(_from_nv24, color=b)
    if a in _CHANNEL_ORDERS:
        code = f"{a}2{b}".upper()
    elif a in _YUV_IN_OPENCV:
        code = f"YUV2{b.upper()}_{_YUV_IN_OPENCV[a]}"
    elif b in {"gray", "rgb", "bgr"}:
        code = f"Bayer{_BAYER_IN_OPENCV[a.removeprefix('bayer_')]}2{b.upper()}"
    else:
        raise ConversionError(_why_not(source, desired))
    code = getattr(cv2, f"COLOR_{code}")
    return lambda frame: cv2.cvtColor(frame, code)


def _from_nv24(planes, color):
    """The colors of nv24 (one U and one V per pixel): OpenCV converts them as yuyv with doubled pixels."""
    height, width = planes.shape[0] // 3, planes.shape[1]
    luma, chroma = planes[:height], planes[height:].reshape(height, width, 2)
    twice = np.empty((height, 2 * width, 2), np.uint8)
    twice[:, 0::2, 0] = twice[:, 1::2, 0] = luma
    twice[:, 0::2, 1], twice[:, 1::2, 1] = chroma[..., 0], chroma[..., 1]
    wide = cv2.cvtColor(twice, getattr(cv2, f"COLOR_YUV2{color.upper()}_YUY2"))
    return np.ascontiguousarray(wide[:, ::2])


def _check_size(source, height, width):
    """Refuses sizes for which OpenCV reads beyond the row, or returns black, without an error."""
    if source.color in _PACKED_YUV and width % 2:
        raise ConversionError(
            f"width {width} is odd, but in {source.name!r} two neighbouring pixels share their color; "
            "crop the width to an even number, or take the bytes with 'passthrough'"
        )
    if source.color.startswith("bayer_") and min(height, width) < 3:
        raise ConversionError(
            f"a {source.name!r} image of {height} rows × {width} columns is too small: colors come from "
            "neighbouring pixels, so both sides need at least 3; take the mosaic with 'passthrough'"
        )


def _rescale(source, target):
    """Function of a frame that changes its depth; None if both are equal."""
    if source == target:
        return None
    if (source, target) == (np.uint16, np.uint8):
        return _gray_levels_16_to_8
    if target.kind == "f":
        rescale = _to_float
    elif source.kind == "f":
        rescale = _float_to_integer
    else:
        bits = {(1, 2): _8_to_16_bits, (2, 1): _16_to_8_bits}
        rescale = bits.get((source.itemsize, target.itemsize), _saturate)
    return functools.partial(rescale, dtype=target)


def _to_float(frame, dtype):
    with np.errstate(over="ignore", invalid="ignore"):  # a float64 beyond float32 is infinite
        return frame.astype(dtype)


def _float_to_integer(frame, dtype):
    lowest, highest = np.iinfo(dtype).min, np.iinfo(dtype).max
    exact = np.float64 if dtype.itemsize == 4 else frame.dtype  # float32 cannot hold 2**31 - 1
    with np.errstate(invalid="ignore"):  # a signalling NaN is treated like any other
        rounded = np.rint(frame, dtype=exact)
    np.clip(rounded, lowest, highest, out=rounded)
    np.copyto(rounded, lowest, where=np.isnan(rounded))
    return rounded.astype(dtype)


def _8_to_16_bits(frame, dtype):
    if frame.dtype == np.uint8 and dtype == np.uint16:
        return np.multiply(frame, 257, dtype=np.uint16)
    return _saturate(np.multiply(frame, 257, dtype=np.int32), dtype)


def _gray_levels_16_to_8(frame):
    flat = frame.reshape(frame.shape[0], -1)  # OpenCV 5 takes at most 128 channels
    return cv2.convertScaleAbs(flat, alpha=1 / 257).reshape(frame.shape)  # right on all 65536 values


def _16_to_8_bits(frame, dtype):
    # The divisor is odd: no value lies exactly between two integers.
    return _saturate(np.add(frame, 128, dtype=np.int32) // 257, dtype)


def _saturate(frame, dtype):
    narrow, wide = np.iinfo(dtype), np.iinfo(frame.dtype)
    lowest, highest = max(narrow.min, wide.min), min(narrow.max, wide.max)
    return np.clip(frame, lowest, highest).astype(dtype)


def _why_not(source, desired, field=""):
    """Why a pair of encodings has no conversion, and the remedy."""
    problem = f"no conversion from {source.name!r} to {desired.name!r}: "
    if source.color is None and desired.color:
        return problem + _meaning_missing(source, field)
    if desired.color is None:
        return problem + (
            f"{desired.name!r} keeps the values as they are, so it needs {source.channels} channel(s) like "
            f"the source, and has {desired.channels}; ask for {source.name!r} or 'passthrough', then select "
            "channels with NumPy"
        )
    if desired.color not in _CHANNEL_ORDERS:
        return problem + f"only cameras produce {desired.name!r}; ask for 'bgr8', 'rgb8' or 'mono8'"
    bits = 8 * source.dtype.itemsize
    return problem + f"a Bayer mosaic has no alpha; ask for 'bgr{bits}', 'rgb{bits}' or 'mono{bits}'"


def _meaning_missing(source, field):
    problem = f"{source.name!r} says how values are stored, not what they mean; "
    candidates = [
        name for name, info in ENCODINGS.items() if info.color in _CHANNEL_ORDERS and info[1:3] == source[1:3]
    ]
    relabel = ""
    if candidates:
        relabel = f"if you know what they mean, set {field} to {' or '.join(map(repr, candidates))} first"
    if source.channels == 1 and source.name not in {"8U", "8UC1"}:
        # Unmeasured depth in metres is NaN or infinite: scaled by that maximum, every pixel would be black.
        largest = "a[np.isfinite(a)].max()" if source.dtype.kind == "f" else "a.max()"
        values = "a" if source.dtype.kind == "u" else "a.clip(0)"  # -5 would become 5
        remedy = (
            "take 'passthrough' and scale it yourself, as in "
            f"cv2.convertScaleAbs({values}, alpha=255 / {largest})"
        )
        return problem + remedy + (f"; {relabel}" if relabel else "")
    return problem + (relabel or "take 'passthrough' and select channels with NumPy")
