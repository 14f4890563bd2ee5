"""The first directory of a TIFF, checked before libtiff decodes it.

Accepted is what OpenCV writes and most programs do: pixels in strips, channels interleaved, without
compression or with LZW, deflate or PackBits.
"""

import struct

from .errors import ConversionError
from .image_limits import DAMAGED, check_claim

TIFF_SIGNATURES = (b"II*\0", b"MM\0*")
_WIDTH, _HEIGHT, _BITS, _COMPRESSION, _COLORS, _STRIP_OFFSETS = 256, 257, 258, 259, 262, 273
_CHANNELS, _ROWS_PER_STRIP, _STRIP_BYTES, _PLANES = 277, 278, 279, 284
_DEFAULTS = {_BITS: (1,), _COMPRESSION: (1,), _CHANNELS: (1,), _ROWS_PER_STRIP: (2**32 - 1,), _PLANES: (1,)}
# Compression -> bytes that one byte can become at most: none, LZW (a code of 12 bits), deflate, PackBits.
TIFF_EXPANSION = {1: 1, 5: 4096, 8: 1032, 32946: 1032, 32773: 64}
_FORMATS = {3: "H", 4: "I"}  # of a field's values, by their type in the file
_REMEDY = "write it as cv2.imwrite does (strips, LZW), or use PNG"


def check_tiff(data):
    """Checks that a TIFF is of the kind described above and that its strips can hold its pixels.

    Parameters
    ----------
    data : contiguous memoryview of bytes that begins with one of TIFF_SIGNATURES

    Raises
    ------
    ConversionError : cut short, another kind of TIFF, or a header that claims more pixels than the bytes hold
    """
    fields = {**_DEFAULTS, **_fields(data)}
    missing = {_WIDTH, _HEIGHT, _COLORS, _STRIP_OFFSETS, _STRIP_BYTES} - fields.keys()
    if missing:
        raise ConversionError(f"TIFF without field {min(missing)}, or with tiles; {_REMEDY}")
    height, width, channels = (fields[tag][0] for tag in (_HEIGHT, _WIDTH, _CHANNELS))
    bits, compression = fields[_BITS][0], fields[_COMPRESSION][0]
    is_interleaved = fields[_PLANES][0] == 1 and fields[_COLORS][0] <= 3
    has_known_values = 1 <= channels <= 4 and fields[_BITS] == (bits,) * channels and bits in (8, 16, 32, 64)
    if not is_interleaved or not has_known_values or compression not in TIFF_EXPANSION:
        raise ConversionError(
            f"TIFF of {channels} channels of {bits} bits, compression {compression}: expected 1 to 4 "
            f"interleaved channels of 8, 16, 32 or 64 bits, compression 1, 5, 8 or 32773; {_REMEDY}"
        )
    pixel_bytes = channels * bits // 8
    is_possible = height * width * pixel_bytes <= TIFF_EXPANSION[compression] * len(data)
    check_claim("TIFF", height, width, is_possible, len(data))
    _check_strips(fields, height, len(data))


def _check_strips(fields, height, file_bytes):
    rows = min(fields[_ROWS_PER_STRIP][0], height)
    offsets, sizes = fields[_STRIP_OFFSETS], fields[_STRIP_BYTES]
    strips = -(-height // rows) if rows else 0
    ends = [offset + size for offset, size in zip(offsets, sizes, strict=False)]
    if not strips == len(offsets) == len(sizes) or max(ends) > file_bytes:
        raise ConversionError(f"TIFF whose strips do not lie within its {file_bytes} bytes; {DAMAGED}")


def _fields(data):
    """{tag: tuple of ints} of the first directory: the fields that are unsigned integers of 16 or 32 bits."""
    order = "<" if data[:2] == b"II" else ">"
    try:
        (directory,) = struct.unpack_from(order + "I", data, 4)
        (count,) = struct.unpack_from(order + "H", data, directory)
        entries = [struct.unpack_from(order + "HHI", data, directory + 2 + 12 * i) for i in range(count)]
        tags = [tag for tag, _, _ in entries]
        if tags != sorted(set(tags)):
            raise ConversionError(f"TIFF whose fields are not in order; {_REMEDY}")
        fields = {}
        for i, (tag, kind, values) in enumerate(entries):
            if kind not in _FORMATS or not values:
                continue
            if values > len(data):
                raise struct.error
            layout = struct.Struct(f"{order}{values}{_FORMATS[kind]}")
            at = directory + 2 + 12 * i + 8
            if layout.size > 4:
                (at,) = struct.unpack_from(order + "I", data, at)
            fields[tag] = layout.unpack_from(data, at)
    except struct.error:
        raise ConversionError(f"TIFF of {len(data)} bytes that ends within its header; {DAMAGED}") from None
    return fields
