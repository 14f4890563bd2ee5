# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""The encodings of sensor_msgs/Image: the dtype and channels of a pixel, and what its values mean.

An encoding is a name in the message's `encoding` field. Some names say what the values mean ("bgr8": blue,
green, red). The others ("16UC1") say only how the values are stored. The names are those of
sensor_msgs/image_encodings. They match as in ROS: whole, and case-sensitively.
"""

import difflib
import re
from typing import NamedTuple

import numpy as np

from .errors import ConversionError, quoted

MAX_CHANNELS = 512  # as OpenCV 4 counts them


class EncodingInfo(NamedTuple):
    """What an encoding says about the array of an image.

    Attributes
    ----------
    name : the encoding, as the caller wrote it
    dtype : NumPy dtype of one value, in the machine's byte order
    channels : values per pixel in the array; 1 means an array of two dimensions
    color : the meaning of the values: "gray", "rgb", "bgr", "rgba", "bgra", "bayer_rggb" (and the other three
        patterns, named by the first two rows), "uyvy", "yuyv", "nv12", "nv21", "nv24"; None if the name does
        not say it
    """

    name: str
    dtype: np.dtype
    channels: int
    color: str | None

    @property
    def pixel_bytes(self) -> int:
        """Bytes from one pixel to the next in a row."""
        return self.dtype.itemsize * self.channels

    @property
    def is_planar(self) -> bool:
        """True if the image is stored as planes: all of Y first, then U and V in pairs."""
        return self.color in _ROWS_PER_PIXEL_ROW

    def rows(self, height: int) -> int:
        """Rows of the array for `height` rows of pixels: more if planes are stacked, otherwise the same."""
        numerator, denominator = _ROWS_PER_PIXEL_ROW.get(self.color or "", (1, 1))
        return height * numerator // denominator

    def height(self, rows: int) -> int:
        """Rows of pixels in an array of `rows` rows: the inverse of the method `rows`."""
        numerator, denominator = _ROWS_PER_PIXEL_ROW.get(self.color or "", (1, 1))
        return rows * denominator // numerator

    def shape(self, height: int, width: int) -> tuple[int, ...]:
        """Shape of the array for an image of `height` × `width` pixels.

        (H, W) or (H, W, channels); the planar ones as OpenCV lays them out: nv12 and nv21 (H * 3 / 2, W),
        nv24 (H * 3, W).
        """
        size = (self.rows(height), width)
        return size if self.channels == 1 else (*size, self.channels)


_ROWS_PER_PIXEL_ROW = {"nv12": (3, 2), "nv21": (3, 2), "nv24": (3, 1)}
DEPTHS = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_GENERIC = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)(?:C(\d{1,9}))?", re.ASCII)
_CHANNELS = {"rgb": 3, "rgba": 4, "bgr": 3, "bgra": 4, "mono": 1}
_CHANNELS |= dict.fromkeys(("bayer_rggb", "bayer_bggr", "bayer_gbrg", "bayer_grbg"), 1)
_YUV = {"uyvy": "uyvy", "yuyv": "yuyv", "yuv422": "uyvy", "yuv422_yuy2": "yuyv"}


def _table():
    rows: list[tuple[str, str, int, str | None]] = [
        (f"{color}{8 * size}", f"u{size}", channels, "gray" if color == "mono" else color)
        for size in (1, 2)
        for color, channels in _CHANNELS.items()
    ]
    rows += [(name, "u1", 2, color) for name, color in _YUV.items()]
    rows += [(planar, "u1", 1, planar) for planar in _ROWS_PER_PIXEL_ROW]
    rows += [(f"{depth}C{n}", code, n, None) for depth, code in DEPTHS.items() for n in (1, 2, 3, 4)]
    return {name: EncodingInfo(name, np.dtype(code), n, color) for name, code, n, color in rows}


ENCODINGS = _table()  # name -> EncodingInfo; encoding_info knows other counts of channels ("8UC7"), too


def encoding_info(name: str) -> EncodingInfo:
    """What the encoding `name` says about its array.

    Parameters
    ----------
    name : a name of sensor_msgs/image_encodings, "nv12", or any "<depth>C<channels>" such as "8UC7" or
        "32FC1"; a depth alone ("8U") means one channel

    Returns
    -------
    EncodingInfo

    Raises
    ------
    ConversionError : no such encoding; the text suggests the nearest names

    Examples
    --------
    >>> encoding_info("bgr8").shape(2, 4)
    (2, 4, 3)
    """
    if not isinstance(name, str):
        raise ConversionError(f"an encoding is a name such as 'bgr8', got {quoted(name)}")
    if name in ENCODINGS:
        return ENCODINGS[name]
    generic = _GENERIC.fullmatch(name)
    if not generic:
        raise ConversionError(f"unknown encoding {quoted(name)}; {_nearest(name)}")
    depth, digits = generic.groups()
    channels = int(digits or 1)
    if not 1 <= channels <= MAX_CHANNELS:
        raise ConversionError(
            f"encoding {name!r} has {channels} channels; expected 1 to {MAX_CHANNELS}, as in '{depth}C3'"
        )
    return EncodingInfo(name, np.dtype(DEPTHS[depth]), channels, None)


def generic_name(dtype, channels):
    """The encoding that says only how values are stored: "8UC3" for ("uint8", 3)."""
    dtype = np.dtype(dtype)
    depth = _DEPTH_OF.get(dtype.newbyteorder("=").str)
    if depth is None:
        hint = _CASTS.get(dtype.name, "convert it with array.astype(...)")
        raise ConversionError(
            f"a message cannot hold dtype {dtype}; expected uint8, int8, uint16, int16, int32, float32 or "
            f"float64: {hint}"
        )
    return f"{depth}C{channels}"


_DEPTH_OF = {np.dtype(code).str: depth for depth, code in DEPTHS.items()}
_CASTS = {
    "bool": "array.astype('uint8') * 255 makes a mask of 0 and 255",
    "int64": "array.astype('int32') if the values fit; np.clip(array, 0, 255).astype('uint8') for gray",
    **dict.fromkeys(("uint32", "uint64"), "array.astype('int32') if the values fit"),
    "float16": "array.astype('float32') keeps every value",
}


_OTHER_WORDS = re.compile("gr[ae]y(scale)?|luma|^[yl](?=8|16)")
_OTHER_LAYOUTS = re.compile("i420|iyuv|yv12|yuv4(20|44)|yuv422p|nv(16|42|61)|[rb]g[br]565")


def _nearest(name):
    names = {name.casefold(): name for name in ENCODINGS}
    normalized = _OTHER_WORDS.sub("mono", name[:40].casefold().strip().removesuffix("c"))
    normalized = re.sub("(?<=yuyv|uyvy)422", "", normalized)  # FFmpeg's names
    if _OTHER_LAYOUTS.search(normalized):
        return "ROS has no name for this layout of bytes; set the camera's driver to 'bgr8', 'yuyv' or 'nv21'"
    matches = difflib.get_close_matches(normalized, names, n=3, cutoff=0.6)
    if matches:
        return f"did you mean {' or '.join(repr(names[match]) for match in matches)}?"
    return "expected a name such as 'bgr8', 'rgb8', 'mono8', '16UC1' or '32FC1' (names are case-sensitive)"
