# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""compressedDepth: the depth images of ROS's compressed_depth_image_transport, as PNG or RVL.

The data begin with a header of 12 bytes (int32 kind, float32 A, float32 B, little-endian). Then follows a PNG
of 16 bits, or uint32 columns, uint32 rows and an RVL stream. "16UC1" holds the values themselves, usually in
millimetres, with 0 for "not measured". "32FC1" holds q = A / depth + B, depth in metres, with 0 for NaN.
"""

import struct

import numpy as np

from .encodings import encoding_info
from .errors import ConversionError, quoted
from .image_files import decode_image_file
from .image_headers import BLANK_PIXELS, PIXELS_PER_BYTE, check_claim, file_format

_ENCODINGS = ("16UC1", "mono16", "32FC1")
_HEADER = struct.Struct("<iff")
_SIZE = struct.Struct("<II")
_MAX_NIBBLES = 11  # of a number of 32 bits in an RVL stream


def is_depth(format, data):
    """Whether `format` names compressedDepth, or names nothing, and a PNG follows a header of 12 bytes."""
    return "compressedDepth" in format or (bytes(data[13:16]) == b"PNG" and file_format(data) is None)


def decode_depth(format, data):
    """(array, EncodingInfo) of a contiguous memoryview; `format` is such as "16UC1; compressedDepth png"."""
    if len(data) <= _HEADER.size:
        raise ConversionError(
            f"compressedDepth needs a header of {_HEADER.size} bytes and an image, got {len(data)} bytes; "
            "the message is cut short"
        )
    _, a, b = _HEADER.unpack_from(data)
    info, decode = _parsed(format, a, b)
    values = decode(data[_HEADER.size :])
    if info.dtype == np.uint16:
        return values, info
    if not (0 < a < np.inf and np.isfinite(b)):
        raise ConversionError(
            f"no depth follows from A = {a:g} and B = {b:g} in the header of compressedDepth; set the "
            "publisher's parameters depth_quantization and depth_max above 0, or subscribe to the raw topic"
        )
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        metres = np.float32(a) / (values - np.float32(b))
    metres[values == 0] = np.nan
    return metres, info


def _parsed(format, a, b):
    """(EncodingInfo, function that decodes the values); PNG if the format names no codec."""
    name, semicolon, codec = map(str.strip, format.partition(";"))
    codec = codec.partition("compressedDepth")[2].strip() or "png"
    if not semicolon and name not in _ENCODINGS:
        name = "16UC1"
        if a > 0 and b < 1 and 1 <= a / (1 - b) <= 100:  # limits of the publisher's depth_max, metres
            raise ConversionError(
                f"format {quoted(format)} names no encoding, and the header has A and B; set msg.format to "
                "'32FC1; compressedDepth png' for metres, else to '16UC1; compressedDepth png'"
            )
    if encoding_info(name).name not in _ENCODINGS or codec not in ("png", "rvl"):
        raise ConversionError(
            f"compressedDepth knows '16UC1', 'mono16' and '32FC1' as 'png' or 'rvl', got {quoted(format)}; "
            "subscribe to the raw topic"
        )
    return encoding_info(name), _decode_rvl if codec == "rvl" else _decode_png


def _decode_png(body):
    if bytes(body[1:4]) != b"PNG":
        raise ConversionError(
            f"expected a PNG after the header of compressedDepth, got {quoted(bytes(body[:8]))}; "
            "the format is mislabelled, or the message damaged"
        )
    values = decode_image_file(body, "compressedDepth png")
    if values.dtype != np.uint16 or values.ndim != 2:
        raise ConversionError(
            f"compressedDepth needs a gray PNG of 16 bits, got {values.dtype.name} of shape {values.shape}; "
            "its format is mislabelled"
        )
    return values


def _decode_rvl(body):
    if len(body) < _SIZE.size:
        raise ConversionError(f"RVL of {len(body)} bytes cannot hold its size; the message is cut short")
    columns, rows = _SIZE.unpack_from(body)
    stream = body[_SIZE.size :]
    check_claim("RVL", rows, columns, len(stream), BLANK_PIXELS + PIXELS_PER_BYTE * len(stream))
    return rvl_decode(stream, rows * columns).reshape(rows, columns)


def rvl_decode(stream, pixels):
    """(pixels,) uint16 of an RVL stream, which must hold exactly this number of pixels.

    Source: A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017, doi:10.1145/3132272.3134144.

    The pixels are stored as runs: the number of zero pixels, the number of nonzero pixels, then for each
    nonzero pixel the difference to the previous nonzero pixel. The sign of a difference is in its lowest bit:
    0, -1, 1, -2 become 0, 1, 2, 3. A number is written in nibbles with 3 bits each, lowest bits first; bit 3
    of a nibble is set if more nibbles follow. Eight nibbles, the first one highest, make a little-endian word
    of 32 bits.
    """
    numbers = _from_words(stream)
    runs = _runs(numbers, pixels)
    signed_low = np.concatenate([numbers[:0], *(numbers[first : first + count] for first, _, count in runs)])
    differences = (signed_low >> 1).astype(np.uint16) ^ -(signed_low & 1).astype(np.uint16)
    values = np.cumsum(differences, dtype=np.uint16)
    flat, start = np.zeros(pixels, np.uint16), 0
    for _, position, count in runs:
        flat[position : position + count] = values[start : start + count]
        start += count
    return flat


def _runs(numbers, pixels):
    """(index of its first difference, index of its first pixel, length) of each run of nonzero pixels."""
    runs: list[tuple[int, int, int]] = []
    at, position = 0, 0
    while position < pixels:
        if at + 2 > numbers.size:
            raise ConversionError(f"RVL ends after {position} of {pixels} pixels; the message is cut short")
        zeros, nonzeros = numbers.item(at), numbers.item(at + 1)
        first, position = at + 2, position + zeros
        is_empty = (zeros == 0 and runs) or (nonzeros == 0 and position < pixels)
        if is_empty or position + nonzeros > pixels or first + nonzeros > numbers.size:
            raise ConversionError(f"RVL whose runs do not make {pixels} pixels; the message is damaged")
        runs.append((first, position, nonzeros))
        at, position = first + nonzeros, position + nonzeros
    return runs


def _from_words(stream):
    groups = np.frombuffer(stream, "<u4", len(stream) // 4)
    highest_first = groups.astype(">u4").view(np.uint8)
    nibbles = np.column_stack([highest_first >> 4, highest_first & 15]).ravel()
    ends = np.flatnonzero(nibbles < 8)
    starts = np.concatenate([[0], ends[:-1] + 1])[: ends.size]
    lengths = ends - starts + 1
    if lengths.max(initial=0) > _MAX_NIBBLES:
        raise ConversionError("RVL stream with a number of more than 32 bits; the message is damaged")
    numbers = np.zeros(ends.size, np.uint32)
    for nibble in range(lengths.max(initial=0)):
        longer = lengths > nibble
        numbers[longer] |= (nibbles[starts[longer] + nibble] & 7).astype(np.uint32) << np.uint32(3 * nibble)
    return numbers
