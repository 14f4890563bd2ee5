"""The size in the first directory of a TIFF, read before libtiff decodes it."""

import struct

_WIDTH, _HEIGHT, _COLORS, _PLANES, _TILE_WIDTH = 256, 257, 262, 284, 322
_FORMATS = {3: "H", 4: "I"}  # of a field's value, by its type in the file


def tiff_size(data):
    """(width, height); None if the TIFF is cut short, or not gray, RGB or palette, interleaved, in strips."""
    try:
        fields = _fields(data)
    except struct.error:
        return None
    is_plain = fields.get(_COLORS, 9) <= 3 and fields.get(_PLANES, 1) == 1 and _TILE_WIDTH not in fields
    return (fields[_WIDTH], fields[_HEIGHT]) if is_plain and {_WIDTH, _HEIGHT} <= fields.keys() else None


def _fields(data):
    """{tag: int} of the first directory: the fields of one unsigned integer of 16 or 32 bits."""
    order = "<" if data[:2] == b"II" else ">"
    (directory,) = struct.unpack_from(order + "I", data, 4)
    (count,) = struct.unpack_from(order + "H", data, directory)
    fields: dict[int, int] = {}
    for at in range(directory + 2, directory + 2 + 12 * count, 12):
        tag, kind, values = struct.unpack_from(order + "HHI", data, at)
        if kind in _FORMATS and values == 1:
            (value,) = struct.unpack_from(order + _FORMATS[kind], data, at + 8)
            fields.setdefault(tag, value)  # of two equal tags libtiff takes the first
    return fields
