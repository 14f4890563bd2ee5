"""The encodings of sensor_msgs/Image: what one pixel is made of, and what its numbers mean.

An encoding is a name in the message's `encoding` field. Some names say what the numbers mean ("bgr8": blue,
green, red); the others ("16UC1") only say how they are stored. Names are those of
sensor_msgs/image_encodings, matched whole and case-sensitively, as ROS matches them.
"""

import difflib
import re
from typing import NamedTuple

import numpy as np

from .errors import ConversionError, quoted

MAX_CHANNELS = 512  # as OpenCV 4 counts them


class EncodingInfo(NamedTuple):
    """What an encoding says about the array that holds its picture.

    Attributes
    ----------
    name : the encoding as it was asked for
    dtype : NumPy dtype of one value, in the machine's own byte order
    channels : values per pixel in the array; 1 means an array of two dimensions
    color : what the values mean: "gray", "rgb", "bgr", "rgba", "bgra", "bayer_rggb" (and the other three,
        named by the first two rows), "uyvy", "yuyv", "nv12", "nv21", "nv24"; None where the name does not say
    """

    name: str
    dtype: np.dtype
    channels: int
    color: str | None

    @property
    def pixel_bytes(self):
        """Bytes from one pixel of a row to the next."""
        return self.dtype.itemsize * self.channels

    @property
    def is_planar(self):
        """True where whole planes follow each other: all of Y first, then U and V in pairs."""
        return self.color in _ROWS_PER_PIXEL_ROW

    def rows(self, height):
        """Rows of the array that holds `height` rows of pixels (more only where planes are stacked)."""
        numerator, denominator = _ROWS_PER_PIXEL_ROW.get(self.color, (1, 1))
        return height * numerator // denominator

    def height(self, rows):
        """Rows of pixels in an array of so many rows: the inverse of `rows`."""
        numerator, denominator = _ROWS_PER_PIXEL_ROW.get(self.color, (1, 1))
        return rows * denominator // numerator

    def shape(self, height, width):
        """Shape of the array for a picture of `height` × `width` pixels.

        (H, W) or (H, W, channels); the planar ones as OpenCV lays them out: nv12 and nv21 (H * 3 / 2, W),
        nv24 (H * 3, W).
        """
        size = (self.rows(height), width)
        return size if self.channels == 1 else (*size, self.channels)


_ROWS_PER_PIXEL_ROW = {"nv12": (3, 2), "nv21": (3, 2), "nv24": (3, 1)}
_DEPTHS = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_GENERIC = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)(?:C(\d{1,9}))?", re.ASCII)


def _table():
    table = {}

    def add(name, dtype, channels, color):
        table[name] = EncodingInfo(name, np.dtype(dtype), channels, color)

    for bits, dtype in ((8, "u1"), (16, "u2")):
        for color in ("rgb", "bgr"):
            add(f"{color}{bits}", dtype, 3, color)
            add(f"{color}a{bits}", dtype, 4, f"{color}a")
        add(f"mono{bits}", dtype, 1, "gray")
        for pattern in ("rggb", "bggr", "gbrg", "grbg"):
            add(f"bayer_{pattern}{bits}", dtype, 1, f"bayer_{pattern}")
    for name, color in {"uyvy": "uyvy", "yuyv": "yuyv", "yuv422": "uyvy", "yuv422_yuy2": "yuyv"}.items():
        add(name, "u1", 2, color)
    for name in _ROWS_PER_PIXEL_ROW:
        add(name, "u1", 1, name)
    for depth, dtype in _DEPTHS.items():
        for channels in (1, 2, 3, 4):
            add(f"{depth}C{channels}", dtype, channels, None)
    return table


ENCODINGS = _table()  # name -> EncodingInfo; any other count of channels ("8UC7") is known all the same


def encoding_info(name):
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
    ConversionError : no such encoding; the text offers the nearest names
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
    return EncodingInfo(name, np.dtype(_DEPTHS[depth]), channels, None)


def generic_name(dtype, channels):
    """The name that only says how values are stored: ("uint8", 3) gives "8UC3"."""
    dtype = np.dtype(dtype)
    depth = _DEPTH_OF.get(dtype.newbyteorder("=").str)
    if depth is None:
        raise ConversionError(f"a message cannot hold dtype {dtype}; {cast_hint(dtype)}")
    return f"{depth}C{channels}"


_DEPTH_OF = {np.dtype(code).str: depth for depth, code in _DEPTHS.items()}
_CASTS = {
    "bool": "array.astype('uint8') * 255 makes a mask of 0 and 255",
    "int64": "array.astype('int32') if the values fit; np.clip(array, 0, 255).astype('uint8') for gray",
    "uint32": "array.astype('int32') if the values fit",
    "uint64": "array.astype('int32') if the values fit",
    "float16": "array.astype('float32') keeps every value",
}


def cast_hint(dtype):
    """What to do with an array whose dtype no message can hold."""
    known = "uint8, int8, uint16, int16, int32, float32 or float64"
    return f"expected {known}: {_CASTS.get(dtype.name, 'convert it with array.astype(...)')}"


_OTHER_WORDS = re.compile("gr[ae]y(scale)?|luma|^[yl](?=8|16)")


def _nearest(name):
    folded = {known.casefold(): known for known in ENCODINGS}
    wanted = _OTHER_WORDS.sub("mono", name[:40].casefold().strip().removesuffix("c"))
    near = difflib.get_close_matches(wanted, folded, n=3, cutoff=0.6)
    if near:
        return f"did you mean {' or '.join(repr(folded[n]) for n in near)}?"
    return "expected a name such as 'bgr8', 'rgb8', 'mono8', '16UC1' or '32FC1' (names are case-sensitive)"
