"""The header of a JPEG 2000 file, checked before OpenJPEG decodes it.

Accepted is what OpenCV writes: one tile in one part, default precincts, the same coding for all channels.
Everything else in the header can make OpenJPEG allocate or compute far more than the size in it says.
"""

import struct

from .errors import ConversionError
from .image_limits import DAMAGED, check_blank_claim

JPEG2000_SIGNATURE = b"\0\0\0\x0cjP  \r\n\x87\n"
_START, _SIZE, _CODING, _QUANTIZATION, _COMMENT = 0xFF4F, 0xFF51, 0xFF52, 0xFF5C, 0xFF64
_TILE_PART, _TILE_DATA = 0xFF90, 0xFF93
_MAX_LAYERS = 64
_REMEDY = "encode it with one tile and default options, or use PNG"
_UNKNOWN = f"JPEG 2000 of a kind that is not accepted here; {_REMEDY}"


def check_jpeg2000(data):
    """Checks the header of a JPEG 2000 file.

    Parameters
    ----------
    data : contiguous memoryview of bytes that begins with JPEG2000_SIGNATURE

    Raises
    ------
    ConversionError : cut short, another kind of JPEG 2000, or a header that claims more pixels than accepted
    """
    try:
        height, width = _check_segments(data, _codestream(data))
    except struct.error:
        raise ConversionError(
            f"JPEG 2000 of {len(data)} bytes that ends within its header; {DAMAGED}"
        ) from None
    check_blank_claim("JPEG 2000", height, width, len(data))


def _codestream(data):
    """Position of the codestream: the content of the box jp2c."""
    at = 0
    while True:
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"jp2c":
            return at + 8
        if length < 8:
            raise ConversionError(_UNKNOWN)
        at += length


def _check_segments(data, at):
    """(height, width) of the codestream; all segments up to the pixels are of the accepted kinds."""
    (marker,) = struct.unpack_from(">H", data, at)
    segments, at = [marker], at + 2
    size = None
    while segments[-1] != _TILE_DATA:
        marker, length = struct.unpack_from(">HH", data, at)
        if marker == _SIZE:
            size = _checked_size(data, at + 4)
        elif marker == _CODING:
            _check_coding(data, at + 4)
        elif marker == _TILE_PART:
            _check_tile_part(data, at)
        elif marker not in (_QUANTIZATION, _COMMENT, _TILE_DATA):
            raise ConversionError(_UNKNOWN)
        segments.append(marker)
        at += 2 + length
    order = [marker for marker in segments if marker != _COMMENT]
    if order != [_START, _SIZE, _CODING, _QUANTIZATION, _TILE_PART, _TILE_DATA]:
        raise ConversionError(_UNKNOWN)
    return size


def _checked_size(data, at):
    _, width, height, left, top, tile_width, tile_height, tile_left, tile_top, channels = struct.unpack_from(
        ">H8IH", data, at
    )
    samples = struct.unpack_from(">12B" if channels == 4 else f">{3 * min(channels, 4)}B", data, at + 36)
    is_one_tile = tile_width >= width and tile_height >= height
    is_plain = set(samples[1::3]) | set(samples[2::3]) == {1} and max(samples[0::3]) < 16
    if left or top or tile_left or tile_top or not is_one_tile or channels not in (1, 3, 4) or not is_plain:
        raise ConversionError(_UNKNOWN)
    return height, width


def _check_coding(data, at):
    style, _, layers, _, levels = struct.unpack_from(">BBHBB", data, at)
    if style or not 1 <= layers <= _MAX_LAYERS or levels > 32:
        raise ConversionError(_UNKNOWN)


def _check_tile_part(data, at):
    _, _, tile, length, part = struct.unpack_from(">HHHIB", data, at)
    is_last = length == 0 or at + length >= len(data) - 2
    if tile or part or not is_last:
        raise ConversionError(_UNKNOWN)
