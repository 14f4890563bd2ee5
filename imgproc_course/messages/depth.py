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
from .image_headers import BLANK_PIXELS, PIXELS_PER_BYTE, check_claim
from .rvl import rvl_decode

_HEADER = struct.Struct("<iff")
_SIZE = struct.Struct("<II")


def decode_depth(format, data):
    """(array, EncodingInfo) of a contiguous memoryview; `format` is such as "16UC1; compressedDepth png"."""
    info = encoding_info(format.partition(";")[0].strip())
    if info.name not in ("16UC1", "mono16", "32FC1"):
        raise ConversionError(
            f"compressedDepth knows '16UC1', 'mono16' and '32FC1', got {quoted(info.name)}; "
            "use array_to_compressed for other images"
        )
    if len(data) <= _HEADER.size:
        raise ConversionError(
            f"compressedDepth needs a header of {_HEADER.size} bytes and an image, got {len(data)} bytes; "
            "the message is cut short"
        )
    _, a, b = _HEADER.unpack_from(data)
    body = data[_HEADER.size :]
    values = _decode_rvl(body) if format.rstrip().endswith("rvl") else _decode_png(body)
    if info.dtype == np.uint16:
        return values, info
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        metres = np.float32(a) / (values - np.float32(b))
    metres[values == 0] = np.nan
    return metres, info


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
        raise ConversionError(
            f"RVL of {len(body)} bytes is too short to hold its size; the message is cut short"
        )
    columns, rows = _SIZE.unpack_from(body)
    stream = body[_SIZE.size :]
    check_claim("RVL", rows, columns, len(stream), BLANK_PIXELS + PIXELS_PER_BYTE * len(stream))
    return rvl_decode(stream, rows * columns).reshape(rows, columns)
