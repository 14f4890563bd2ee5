# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""The size in the header of an image file, checked before a decoder allocates memory for it.

A header of a few bytes can claim an image of gigabytes. So the size that it claims is compared with the size
that so many bytes can hold. The table _FORMATS holds the accepted file formats.
"""

import re
import struct
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from .errors import ConversionError

MAX_PIXELS = 2**27  # 134 million: more than any camera on a robot has
# RVL, WebP and JPEG 2000 write a blank image of any size in a few bytes: so many pixels are accepted of any
# file, and PIXELS_PER_BYTE in addition. JPEG needs at least 1 bit for 8 × 8 pixels, half of PIXELS_PER_BYTE.
BLANK_PIXELS = 2**22
PIXELS_PER_BYTE = 1024
DAMAGED = "the message is cut short or damaged; publish it again"
PNG_EXPANSION = 1032  # bytes that one byte of a deflate stream can become: 258 from 2 bits
_UNCOMPRESSED = "it is cut short, damaged or compressed; use PNG, which compresses without loss"
_ONE_TILE = "it is cut short, damaged or not of one tile with default options; encode it so, or use PNG"
_STRIPS = "it is cut short, damaged or of another kind; write it as cv2.imwrite does, or use PNG"
_TEXT_HEADER_BYTES = 4096


def check_claim(name, height, width, file_bytes, limit):
    """ConversionError if a header claims no pixels at all, or more than `limit` or MAX_PIXELS."""
    limit = min(limit, MAX_PIXELS)
    if height == 0 or width == 0:
        raise ConversionError(f"{name} of {height} rows × {width} columns has no pixel; {DAMAGED}")
    if height * width > limit:
        raise ConversionError(
            f"{name} of {file_bytes} bytes claims {height} rows × {width} columns, more than the {limit} "
            "pixels accepted from so many bytes; the message is damaged or made to exhaust the memory"
        )


class FileFormat(NamedTuple):
    """A file format that is accepted, and how many pixels its files hold at most."""

    name: str  # such as "JPEG"
    signature: bytes  # regular expression of the first bytes
    read_size: Callable  # of a contiguous memoryview; gives (width, height), or None
    pixels_per_byte: int
    blank_pixels: int = 0  # in addition, for any file
    remedy: str = DAMAGED  # for a header that cannot be read

    def check(self, data):
        """Refuses a file whose header cannot be read, or claims more than so many bytes can hold."""
        size = self.read_size(data)
        if size is None:
            raise ConversionError(
                f"{self.name} of {len(data)} bytes without a readable header; {self.remedy}"
            )
        width, height = size
        limit = self.blank_pixels + self.pixels_per_byte * len(data)
        check_claim(self.name, abs(height), width, len(data), limit)  # a BMP can have a negative height


def file_format(data):
    """FileFormat of a contiguous memoryview of bytes, by its first bytes; None if it is not accepted."""
    return next((known for known in _FORMATS if re.match(known.signature, data, re.DOTALL)), None)


def refused_format(data):
    """Name of a file format that is known but not accepted; None if it is unknown."""
    return next((name for start, name in _REFUSED.items() if re.match(start, data, re.DOTALL)), None)


def _binary(pattern, layout, data):
    """The size that the pattern's group holds, two numbers as `struct` lays them out."""
    header = re.match(pattern, data, re.DOTALL)
    return header and struct.unpack(layout, header[1])


def _text(pattern, data):
    """The size in a text header, in the groups `width` and `height`."""
    header = re.match(pattern, data[:_TEXT_HEADER_BYTES])
    return header and (int(header["width"]), int(header["height"]))


def _jpeg_size(data):
    at = 2
    while at + 9 <= len(data) and data[at] == 0xFF:
        marker = data[at + 1]
        if marker in _JPEG_FRAME_HEADERS:
            height, width = struct.unpack_from(">HH", data, at + 5)
            return width, height
        # A fill byte, or a segment to skip
        at += 1 if marker == 0xFF else 2 + int.from_bytes(data[at + 2 : at + 4], "big")
    return None


_JPEG_FRAME_HEADERS = set(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}


def _webp_size(data):
    kind, start = bytes(data[12:16]), bytes(data[20:30]).ljust(10, b"\0")
    if kind == b"VP8X":
        if start[0] & 2:
            raise ConversionError("an animated WebP holds many images; publish one image per message")
        return tuple(1 + int.from_bytes(start[at : at + 3], "little") for at in (4, 7))
    if kind == b"VP8L":
        numbers = int.from_bytes(start[1:5], "little")
        return 1 + (numbers & 0x3FFF), 1 + (numbers >> 14 & 0x3FFF)
    if kind == b"VP8 ":
        return tuple(number & 0x3FFF for number in struct.unpack_from("<HH", start, 6))
    return None


_WIDTH, _HEIGHT, _COLORS, _PLANES, _TILE_WIDTH = 256, 257, 262, 284, 322
_TIFF_NUMBERS = {3: "H", 4: "I"}  # of a field's value, by its type in the file


def _tiff_size(data):
    """(width, height); None if the TIFF is cut short, or not gray, RGB or palette, interleaved, in strips."""
    try:
        fields = _tiff_fields(data)
    except struct.error:
        return None
    is_plain = fields.get(_COLORS, 9) <= 3 and fields.get(_PLANES, 1) == 1 and _TILE_WIDTH not in fields
    return (fields[_WIDTH], fields[_HEIGHT]) if is_plain and {_WIDTH, _HEIGHT} <= fields.keys() else None


def _tiff_fields(data):
    """{tag: int} of the first directory: the fields of one unsigned integer of 16 or 32 bits."""
    order = "<" if data[:2] == b"II" else ">"
    (directory,) = struct.unpack_from(order + "I", data, 4)
    (count,) = struct.unpack_from(order + "H", data, directory)
    fields: dict[int, int] = {}
    for at in range(directory + 2, directory + 2 + 12 * count, 12):
        tag, kind, values = struct.unpack_from(order + "HHI", data, at)
        if kind in _TIFF_NUMBERS and values == 1:
            (value,) = struct.unpack_from(order + _TIFF_NUMBERS[kind], data, at + 8)
            fields.setdefault(tag, value)  # of two equal tags libtiff takes the first
    return fields


# In each pattern the group in parentheses holds width and height.
_BMP = (
    rb"BM.{12}[\x28-\xff]\0\0\0"  # file header; the next header has 40 bytes or more
    rb"(.{3}[\0-\x7f].{4})\x01\0"  # width (not negative), height, one plane
    rb"(?:[\x01\x04\x08\x18]\0\0|[\x10\x20]\0[\0\x03])\0\0\0"  # bits per pixel, and no compression
)
_SUN_RASTER = (
    rb"\x59\xa6\x6a\x95(.{8})"
    rb"\0\0\0[\x01\x08\x18\x20].{4}"  # bits per pixel, and the number of bytes
    rb"\0\0\0[\0\x01].{8}"  # not compressed; the color map
)
_PNG = (
    rb"\x89PNG\r\n\x1a\n\0\0\0\rIHDR(.{8})"
    rb"(?:[\x01\x02\x04\x08\x10]\0|[\x08\x10][\x02\x04\x06]|[\x01\x02\x04\x08]\x03)"  # bits and color type
    rb"\0\0[\0\x01]"  # compression, filter, interlacing
)
# As OpenCV writes it: one tile, default precincts, at most 64 layers, the same coding for all channels.
# Anything else can make OpenJPEG allocate or compute far more than the size says.
_JPEG_2000 = (
    rb".*?jp2c\xff\x4f\xff\x51.{4}(.{8})\0{8}\1\0{8}"  # size of the image, and the same of its tile
    rb"\0[\x01\x03\x04](?:[\0-\x0f]\x01\x01){1,4}"  # channels: bits and no subsampling
    rb"\xff\x52..\0.\0[\x01-\x40].[\0-\x20]"  # coding: default precincts, layers, levels
)
_GAP = rb"(?:\s|#[^\n]*\n)+"  # between the numbers: whitespace and comments
_PNM = rb"P[1-6]" + _GAP + rb"(?P<width>\d{1,9})" + _GAP + rb"(?P<height>\d{1,9})\s"
_PFM = rb"P[Ff]\s(?P<width>\d{1,9})\s(?P<height>\d{1,9})\s"
_PAM = (
    rb"P7\nWIDTH (?P<width>\d{1,9})\nHEIGHT (?P<height>\d{1,9})\nDEPTH [1-4]\nMAXVAL \d{1,5}\n"
    rb"(?:TUPLTYPE [A-Z_]+\n)?ENDHDR\n"
)
_HDR = rb"#\?(?:RADIANCE|RGBE)\n(?:[^\n]+\n)*\n-Y (?P<height>\d{1,9}) \+X (?P<width>\d{1,9})\n"
_FORMATS = (
    FileFormat("JPEG", rb"\xff\xd8", _jpeg_size, PIXELS_PER_BYTE),
    FileFormat("PNG", rb"\x89PNG\r\n\x1a\n", partial(_binary, _PNG, ">II"), 8 * PNG_EXPANSION),
    FileFormat("BMP", rb"BM", partial(_binary, _BMP, "<ii"), 8, remedy=_UNCOMPRESSED),
    FileFormat(
        "Sun raster", rb"\x59\xa6\x6a\x95", partial(_binary, _SUN_RASTER, ">II"), 8, remedy=_UNCOMPRESSED
    ),
    FileFormat("TIFF", rb"II\*\0|MM\0\*", _tiff_size, 4096, remedy=_STRIPS),  # a code of LZW
    FileFormat("PNM", rb"P[1-6]", partial(_text, _PNM), 8),
    FileFormat("PFM", rb"P[Ff]", partial(_text, _PFM), 1),
    FileFormat("PAM", rb"P7\n", partial(_text, _PAM), 1),
    FileFormat("Radiance HDR", rb"#\?(?:RADIANCE|RGBE)\n", partial(_text, _HDR), 16),  # runs of 127 values
    FileFormat("GIF", rb"GIF8[79]a", partial(_binary, rb"GIF8[79]a(.{4})", "<HH"), 4096),  # a code of LZW
    FileFormat("WebP", rb"RIFF.{4}WEBP", _webp_size, PIXELS_PER_BYTE, BLANK_PIXELS),
    FileFormat(
        "JPEG 2000",
        rb"\0\0\0\x0cjP  \r\n\x87\n",
        partial(_binary, _JPEG_2000, ">II"),
        PIXELS_PER_BYTE,
        BLANK_PIXELS,
        _ONE_TILE,
    ),
)
# Regular expressions of the first bytes
_REFUSED = {
    rb".{4}ftypavi[fs]": "AVIF",
    rb"\x76\x2f\x31\x01": "OpenEXR",
    rb"II\+\0|MM\0\+": "BigTIFF",
    rb"\xff\x4f\xff\x51": "JPEG 2000 without a file header",
    rb"\0\0\0?\x01": "H.264 or H.265 video",
}
