"""The first directory of a TIFF, checked before libtiff decodes it.

Accepted is what OpenCV writes and most programs do: pixels in strips, channels interleaved, without
compression or with LZW, deflate or PackBits.
"""

import struct

from .errors import ConversionError
from .image_limits import DAMAGED, check_claim

_WIDTH, _HEIGHT, _BITS, _COMPRESSION, _COLORS, _STRIP_OFFSETS = 256, 257, 258, 259, 262, 273
_CHANNELS, _PLANES = 277, 284
_DEFAULTS = {_BITS: (1,), _COMPRESSION: (1,), _CHANNELS: (1,), _PLANES: (1,)}
# Compression -> bytes that one byte can become at most: none, LZW (a code of 12 bits), deflate, PackBits.
TIFF_EXPANSION = {1: 1, 5: 4096, 8: 1032, 32946: 1032, 32773: 64}
_FORMATS = {3: "H", 4: "I"}  # of a field's values, by their type in the file
_REMEDY = "write it as cv2.imwrite does (strips, LZW), or use PNG"


def check_tiff(data):
    """Checks that the bytes of a TIFF are of the kind described above and can hold as many pixels."""
    try:
        fields = _DEFAULTS | _fields(data)
    except struct.error:
        raise ConversionError(f"TIFF of {len(data)} bytes that ends within its header; {DAMAGED}") from None
    missing = {_WIDTH, _HEIGHT, _COLORS, _STRIP_OFFSETS} - fields.keys()
    if missing:
        raise ConversionError(f"TIFF without field {min(missing)}, or with tiles; {_REMEDY}")
    bits, channels, compression = (fields[tag][0] for tag in (_BITS, _CHANNELS, _COMPRESSION))
    is_interleaved = fields[_PLANES][0] == 1 and fields[_COLORS][0] <= 3
    has_known_values = 1 <= channels <= 4 and fields[_BITS] == (bits,) * channels and bits in (8, 16, 32, 64)
    if not is_interleaved or not has_known_values or compression not in TIFF_EXPANSION:
        raise ConversionError(
            f"TIFF of {channels} channels of {bits} bits, compression {compression}: expected 1 to 4 "
            f"interleaved channels of 8, 16, 32 or 64 bits, compression 1, 5, 8 or 32773; {_REMEDY}"
        )
    pixels = TIFF_EXPANSION[compression] * len(data) // (channels * bits // 8)
    check_claim("TIFF", fields[_HEIGHT][0], fields[_WIDTH][0], len(data), pixels)


def _fields(data):
    """{tag: tuple of ints} of the first directory: the fields that are unsigned integers of 16 or 32 bits."""
    order = "<" if data[:2] == b"II" else ">"
    (directory,) = struct.unpack_from(order + "I", data, 4)
    (count,) = struct.unpack_from(order + "H", data, directory)
    fields: dict[int, tuple[int, ...]] = {}
    for at in range(directory + 2, directory + 2 + 12 * count, 12):
        tag, kind, values = struct.unpack_from(order + "HHI", data, at)
        if kind not in _FORMATS or not values:
            continue
        layout = struct.Struct(f"{order}{values}{_FORMATS[kind]}")
        start = at + 8 if layout.size <= 4 else struct.unpack_from(order + "I", data, at + 8)[0]
        fields.setdefault(tag, layout.unpack_from(data, start))  # of two equal tags libtiff takes the first
    return fields
