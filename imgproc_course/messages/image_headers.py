"""The size in the header of an image file, read and checked before a decoder allocates memory for it.

A header of a few bytes can claim an image of gigabytes. Each check compares the size that the header claims
with the size that so many bytes can hold. The table _FORMATS holds the accepted file formats.
"""

import re
import struct
from collections.abc import Callable
from typing import NamedTuple

from .errors import ConversionError
from .image_limits import DAMAGED, PIXELS_PER_BYTE, check_blank_claim, check_claim
from .jpeg2000 import JPEG2000_SIGNATURE, check_jpeg2000
from .png import PNG_SIGNATURE, checked_png
from .tiff import TIFF_SIGNATURES, check_tiff


class FileFormat(NamedTuple):
    """A file format that is accepted.

    Attributes
    ----------
    name : such as "JPEG"
    check : function of the bytes of a file (a contiguous memoryview); it returns the bytes to decode, or None
        if these are the same, and raises ConversionError if it refuses the file
    """

    name: str
    check: Callable


def file_format(data):
    """FileFormat of a contiguous memoryview of bytes, by its first bytes; None if it is not accepted."""
    start = bytes(data[:16])
    for signatures, candidate in _FORMATS.items():
        if start.startswith(signatures) and (candidate.name != "WebP" or start[8:12] == b"WEBP"):
            return candidate
    return None


def refused_format(data):
    """Name of a file format that is known but not accepted; None if it is unknown."""
    start = bytes(data[:16])
    if start[4:12] in (b"ftypavif", b"ftypavis"):  # after the size of the first box
        return "AVIF"
    return next((name for signature, name in _REFUSED.items() if start.startswith(signature)), None)


def _check_jpeg(data):
    height, width = _jpeg_size(data)
    check_claim("JPEG", height, width, height * width <= PIXELS_PER_BYTE * len(data), len(data))


def _jpeg_size(data):
    at = 2
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            break
        marker = data[at + 1]
        if marker == 0xFF:  # fill byte
            at += 1
            continue
        if marker in _JPEG_STANDALONE:
            at += 2
            continue
        if marker in _JPEG_FRAME_HEADERS and at + 9 <= len(data):
            return struct.unpack_from(">HH", data, at + 5)
        if marker in (0xD9, 0xDA):  # the end, or pixels, before any size
            break
        at += 2 + max(2, int.from_bytes(data[at + 2 : at + 4], "big"))
    raise ConversionError(f"JPEG of {len(data)} bytes without a readable header; {DAMAGED}")


_JPEG_STANDALONE = {0x01, *range(0xD0, 0xD8)}
_JPEG_FRAME_HEADERS = set(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}


def _check_bmp(data):
    """BMP and DIB, without run-length encoding: as cv2.imwrite writes them."""
    offset, header_bytes, width, height, planes, bits, compression = _unpacked("BMP", "<10xIIiiHHI", data)
    is_plain = compression == 0 or (compression == 3 and bits in (16, 32))
    if header_bytes < 40 or width < 0 or planes != 1 or bits not in (1, 4, 8, 16, 24, 32) or not is_plain:
        raise ConversionError(
            f"BMP of {bits} bits per pixel, compression {compression}: expected 1, 4, 8, 16, 24 or 32 bits, "
            "not compressed; use PNG, which compresses without loss"
        )
    row_bytes = (width * bits + 31) // 32 * 4
    is_whole = offset + abs(height) * row_bytes <= len(data)
    check_claim("BMP", abs(height), width, is_whole, len(data))


def _check_sun_raster(data):
    """Sun raster without run-length encoding: as cv2.imwrite writes it."""
    width, height, bits, _, kind, _, map_bytes = _unpacked("Sun raster", ">4x7I", data)
    if kind not in (0, 1) or bits not in (1, 8, 24, 32):
        raise ConversionError(
            f"Sun raster of type {kind}, {bits} bits per pixel: expected type 0 or 1 (not compressed), "
            "and 1, 8, 24 or 32 bits; use PNG, which compresses without loss"
        )
    row_bytes = (width * bits + 15) // 16 * 2
    check_claim("Sun raster", height, width, 32 + map_bytes + height * row_bytes <= len(data), len(data))


def is_gray_sun_raster(data):
    """Whether a Sun raster has 8 bits per pixel and no color map: OpenCV decodes it as all black."""
    _, _, bits, _, _, map_kind, _ = _unpacked("Sun raster", ">4x7I", data)
    return bits == 8 and map_kind == 0


def _unpacked(name, layout, data):
    try:
        return struct.unpack_from(layout, data)
    except struct.error:
        raise ConversionError(f"{name} of {len(data)} bytes that ends within its header; {DAMAGED}") from None


_GAP = rb"(?:\s|#[^\n]*\n)+"  # between the numbers: whitespace and comments
_PNM_HEADER = re.compile(rb"P([1-6])" + _GAP + rb"(\d{1,9})" + _GAP + rb"(\d{1,9})\s")
_TEXT_HEADER_BYTES = 4096


def _check_pnm(data):
    """PBM (P1, P4), PGM (P2, P5) and PPM (P3, P6), as text or binary."""
    header = _PNM_HEADER.match(bytes(data[:_TEXT_HEADER_BYTES]))
    if not header:
        raise ConversionError(f"PNM of {len(data)} bytes without a readable header; {DAMAGED}")
    kind, width, height = map(int, header.groups())
    row_bytes = (width + 7) // 8 if kind == 4 else width * (3 if kind in (3, 6) else 1)
    is_possible = header.end() + height * row_bytes <= len(data)
    check_claim("PNM", height, width, is_possible, len(data))


_PFM_HEADER = re.compile(rb"P([Ff])\s(\d{1,9})\s(\d{1,9})\s")


def _check_pfm(data):
    """PFM: float32, one channel (Pf) or three (PF)."""
    header = _PFM_HEADER.match(bytes(data[:64]))
    if not header:
        raise ConversionError(f"PFM of {len(data)} bytes without a readable header; {DAMAGED}")
    width, height = int(header[2]), int(header[3])
    row_bytes = width * (12 if header[1] == b"F" else 4)
    check_claim("PFM", height, width, header.end() + height * row_bytes <= len(data), len(data))


_PAM_HEADER = re.compile(
    rb"P7\nWIDTH (\d{1,9})\nHEIGHT (\d{1,9})\nDEPTH ([1-4])\nMAXVAL (\d{1,5})\n"
    rb"(?:TUPLTYPE [A-Z_]+\n)?ENDHDR\n"
)


def _check_pam(data):
    header = _PAM_HEADER.match(bytes(data[:256]))
    if not header:
        raise ConversionError(f"PAM of {len(data)} bytes without a readable header; {DAMAGED}")
    width, height, channels, maximum = map(int, header.groups())
    row_bytes = width * channels * (2 if maximum > 255 else 1)
    check_claim("PAM", height, width, header.end() + height * row_bytes <= len(data), len(data))


_HDR_HEADER = re.compile(rb"#\?(?:RADIANCE|RGBE)\n(?:[^\n]+\n)*\n-Y (\d{1,9}) \+X (\d{1,9})\n")
_HDR_PIXELS_PER_BYTE = 16  # 4 runs of 127 values in 2 bytes each


def _check_hdr(data):
    header = _HDR_HEADER.match(bytes(data[:_TEXT_HEADER_BYTES]))
    if not header:
        raise ConversionError(f"Radiance HDR of {len(data)} bytes without a readable header; {DAMAGED}")
    height, width = map(int, header.groups())
    is_possible = height * width <= _HDR_PIXELS_PER_BYTE * len(data)
    check_claim("Radiance HDR", height, width, is_possible, len(data))


_GIF_PIXELS_PER_BYTE = 4096  # a code of LZW


def _check_gif(data):
    width, height = _unpacked("GIF", "<6xHH", data)
    check_claim("GIF", height, width, height * width <= _GIF_PIXELS_PER_BYTE * len(data), len(data))


_WEBP_ANIMATION = 2


def _check_webp(data):
    kind = bytes(data[12:16])
    if kind == b"VP8X":
        flags, columns, rows = _unpacked("WebP", "<20xB3x3s3s", data)
        if flags & _WEBP_ANIMATION:
            raise ConversionError("an animated WebP holds many images; publish one image per message")
        width, height = (1 + int.from_bytes(number, "little") for number in (columns, rows))
    elif kind == b"VP8L":
        (numbers,) = _unpacked("WebP", "<21xI", data)
        width, height = 1 + (numbers & 0x3FFF), 1 + (numbers >> 14 & 0x3FFF)
    elif kind == b"VP8 ":
        width, height = (number & 0x3FFF for number in _unpacked("WebP", "<26xHH", data))
    else:
        raise ConversionError(f"WebP of {len(data)} bytes without a readable header; {DAMAGED}")
    check_blank_claim("WebP", height, width, len(data))


_FORMATS = {
    (b"\xff\xd8",): FileFormat("JPEG", _check_jpeg),
    (PNG_SIGNATURE,): FileFormat("PNG", checked_png),
    (b"BM",): FileFormat("BMP", _check_bmp),
    (b"\x59\xa6\x6a\x95",): FileFormat("Sun raster", _check_sun_raster),
    TIFF_SIGNATURES: FileFormat("TIFF", check_tiff),
    tuple(b"P%d" % kind for kind in range(1, 7)): FileFormat("PNM", _check_pnm),
    (b"PF", b"Pf"): FileFormat("PFM", _check_pfm),
    (b"P7\n",): FileFormat("PAM", _check_pam),
    (b"#?RADIANCE\n", b"#?RGBE\n"): FileFormat("Radiance HDR", _check_hdr),
    (b"GIF87a", b"GIF89a"): FileFormat("GIF", _check_gif),
    (b"RIFF",): FileFormat("WebP", _check_webp),
    (JPEG2000_SIGNATURE,): FileFormat("JPEG 2000", check_jpeg2000),
}
_REFUSED = {
    b"\x76\x2f\x31\x01": "OpenEXR",
    b"II+\0": "BigTIFF",
    b"MM\0+": "BigTIFF",
    b"\xff\x4f\xff\x51": "JPEG 2000 without a file header",
    b"\0\0\0\1": "H.264 video",
}
