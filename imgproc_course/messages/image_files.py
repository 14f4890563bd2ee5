# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""Image files in memory, decoded and encoded by OpenCV: the header is checked before a decoder sees it."""

import zlib

import cv2
import numpy as np

from .encodings import ENCODINGS
from .errors import ConversionError, quoted
from .image_headers import DAMAGED, file_format, refused_format
from .wrong_arrays import call_for_values

MAX_VALUES = 2**30  # what OpenCV's encoders take
_INTEGERS = ("uint8", "uint16")
_ANY = ("uint8", "int8", "uint16", "int16", "int32", "float32", "float64")
# Extension -> (dtypes, channels) that OpenCV writes. JPEG and Sun raster drop an alpha channel, WebP and HDR
# return three channels for one, PBM stores only whether a value is 0, and GIF has 256 colors.
FILE_EXTENSIONS = {
    **dict.fromkeys(("jpg", "jpeg", "jpe", "sr", "ras", "bmp", "dib", "webp"), (("uint8",), (1, 3, 4))),
    **dict.fromkeys(("png", "jp2"), (_INTEGERS, (1, 3, 4))),
    **dict.fromkeys(("tif", "tiff"), (_ANY, (1, 3, 4))),
    "pbm": (("uint8",), (1,)),
    "pgm": (_INTEGERS, (1,)),
    "ppm": (_INTEGERS, (3,)),
    "pnm": (_INTEGERS, (1, 3)),
    "pfm": (("float32",), (1, 3)),
    "pam": (("uint8",), (1, 3)),
    **dict.fromkeys(("hdr", "pic"), (("float32",), (1, 3))),
    "gif": (("uint8",), (3, 4)),
}


def decode_image_file(data, described_as):
    """The image in a file (a contiguous memoryview), as OpenCV decodes it: a fresh array, blue, green, red.

    `described_as` is what the message says of the bytes, for errors.
    """
    file_kind = file_format(data)
    if file_kind is None:
        raise ConversionError(_not_an_image(data, described_as))
    file_kind.check(data)
    pixels = np.frombuffer(_pixel_chunks(data) if file_kind.name == "PNG" else data, np.uint8)
    # A gray Sun raster without a color map is decoded right in this one mode.
    is_gray_raster = file_kind.name == "Sun raster" and (data[15], data[27]) == (8, 0)
    try:
        frame = cv2.imdecode(pixels, cv2.IMREAD_COLOR if is_gray_raster else cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise ConversionError(
            f"OpenCV cannot decode {len(data)} bytes of {quoted(described_as)}: {error.err}"
        ) from error
    if frame is None:
        raise ConversionError(
            f"{len(data)} bytes of {quoted(described_as)} do not decode; the message is cut short or damaged"
        )
    return frame[..., 0].copy() if is_gray_raster else frame


def _pixel_chunks(data):
    """The bytes of a whole PNG without texts, times, animation and color profiles.

    libpng prints warnings about these to stderr. ConversionError if the PNG is cut short, or if the checksum
    of a chunk is wrong.
    """
    chunks, at, kind = [data[:8]], 8, b""
    while kind != b"IEND":
        length = int.from_bytes(data[at : at + 4], "big")
        chunk = data[at : at + 12 + length]
        kind = bytes(chunk[4:8])
        if len(chunk) < 12 + length:
            raise ConversionError(f"PNG that ends within its chunk {quoted(kind)}; {DAMAGED}")
        if zlib.crc32(chunk[4:-4]) != int.from_bytes(chunk[-4:], "big"):
            raise ConversionError(f"PNG with a wrong checksum in its chunk {quoted(kind)}; {DAMAGED}")
        if kind[:1].isupper() or kind == b"tRNS":  # a decoder must know chunks in upper case
            chunks.append(chunk)
        at += 12 + length
    return b"".join(chunks)


def encode_image_file(array, extension, options=()):
    """The bytes of an image file of the array (blue, green, red); options are those of cv2.imencode."""
    if extension not in FILE_EXTENSIONS:
        raise ConversionError(
            f"expected one of the formats {', '.join(FILE_EXTENSIONS)}, got {quoted(extension)}; "
            "'png' loses nothing"
        )
    check_value_count(array)
    channels = array.shape[2] if array.ndim == 3 else 1
    dtypes, channel_counts = FILE_EXTENSIONS[extension]
    if array.dtype.name not in dtypes or channels not in channel_counts:
        raise ConversionError(
            f"{extension} holds {_listed(channel_counts)} channels of {_listed(dtypes)}, not {channels} of "
            f"{array.dtype.name}; {_remedy(array, channels)}"
        )
    pixels = np.ascontiguousarray(array, array.dtype.newbyteorder("="))
    try:
        is_encoded, data = cv2.imencode(f".{extension}", pixels, options)
    except cv2.error as error:
        raise ConversionError(
            f"OpenCV cannot write shape {array.shape} as {extension}: {error.err}"
        ) from error
    if not is_encoded:
        raise ConversionError(
            f"OpenCV cannot write shape {array.shape} as {extension}; a JPEG has at most 65500 rows, "
            "a WebP 16383, and a JPEG 2000 needs at least 32"
        )
    return data.tobytes()


def check_value_count(array):
    """Raises ConversionError where OpenCV's encoders take no array of this size."""
    if not 0 < array.size <= MAX_VALUES:
        raise ConversionError(f"expected 1 to {MAX_VALUES} values to compress, got shape {array.shape}")


def _listed(values):
    *first, last = map(str, values)
    return f"{', '.join(first)} or {last}" if first else last


def _remedy(array, channels):
    if channels not in (1, 3, 4):
        return "convert it to 1, 3 or 4 channels"
    if array.dtype.name in _INTEGERS:
        return "'png' holds 8 and 16 bits"
    return f"'tiff' holds every dtype of a message; else call {call_for_values(array, ENCODINGS['mono8'])}"


def _not_an_image(data, described_as):
    if len(data) == 0:
        return (
            f"field 'data' is empty, although 'format' is {quoted(described_as)}; the camera sent no image, "
            "or its transport cannot store this encoding: subscribe to the raw topic"
        )
    name = refused_format(data)
    content = f"holds {name}" if name else f"begins with {quoted(bytes(data[:8]))}"
    return (
        f"expected a JPEG, PNG or other image file, and 'data' ({len(data)} bytes) {content}; "
        "subscribe to the raw topic, or set the parameter 'format' of compressed_image_transport to 'jpeg'"
    )
