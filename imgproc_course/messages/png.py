"""The chunks of a PNG: checked, and reduced to those that make the pixels, before libpng decodes them."""

import struct
import zlib

from .errors import ConversionError, quoted
from .image_limits import DAMAGED, check_claim

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
PNG_EXPANSION = 1032  # bytes that one byte of a deflate stream can become: 258 from 2 bits
_PIXEL_CHUNKS = {b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"}
_CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}  # by color type
_DEPTHS = {0: {1, 2, 4, 8, 16}, 2: {8, 16}, 3: {1, 2, 4, 8}, 4: {8, 16}, 6: {8, 16}}


def checked_png(data):
    """The bytes of a whole PNG, reduced to the chunks that make its pixels.

    Parameters
    ----------
    data : contiguous memoryview of bytes that begins with PNG_SIGNATURE

    Returns
    -------
    `data` itself, or bytes without the other chunks (texts, times, animation, color profiles): libpng prints
    warnings about them to stderr

    Raises
    ------
    ConversionError : the PNG is cut short; a checksum is wrong; no decoder takes the header; the header
        claims more pixels than the bytes can hold
    """
    pixel_chunks, compressed_bytes, has_other_chunks = [data[:8]], 0, False
    at, kind = 8, b""
    height = width = pixel_bits = 0
    while kind != b"IEND":
        length, kind, chunk = _chunk(data, at)
        if (kind == b"IHDR") != (at == 8):
            raise ConversionError(f"PNG whose header is not its first chunk; {DAMAGED}")
        if kind == b"IHDR":
            height, width, pixel_bits = _header(chunk[8:-4])
        if kind in _PIXEL_CHUNKS:
            pixel_chunks.append(chunk)
        elif kind[:1].isupper():
            raise ConversionError(f"PNG with a chunk {quoted(kind)} that no decoder knows; encode it again")
        else:
            has_other_chunks = True
        compressed_bytes += length if kind == b"IDAT" else 0
        at += 12 + length
    scanline_bytes = height * (1 + (width * pixel_bits + 7) // 8)
    check_claim("PNG", height, width, scanline_bytes <= PNG_EXPANSION * compressed_bytes, len(data))
    return b"".join(pixel_chunks) if has_other_chunks else data


def _chunk(data, at):
    """(length of the content, kind, the whole chunk) at a position in the file; its checksum is right."""
    if at + 12 > len(data):
        raise ConversionError(f"PNG that ends after {len(data)} bytes, before its last chunk; {DAMAGED}")
    length = int.from_bytes(data[at : at + 4], "big")
    chunk = data[at : at + 12 + length]
    kind = bytes(chunk[4:8])
    if len(chunk) < 12 + length:
        raise ConversionError(f"PNG that ends within its chunk {quoted(kind)}; {DAMAGED}")
    if zlib.crc32(chunk[4:-4]) != int.from_bytes(chunk[-4:], "big"):
        raise ConversionError(f"PNG with a wrong checksum in its chunk {quoted(kind)}; {DAMAGED}")
    return length, kind, chunk


def _header(content):
    """(height, width, bits per pixel) of an IHDR."""
    if len(content) != 13:
        raise ConversionError(f"PNG with a header of {len(content)} bytes, expected 13; {DAMAGED}")
    width, height, depth, color_type, compression, filtering, interlace = struct.unpack(">IIBBBBB", content)
    is_known = depth in _DEPTHS.get(color_type, ())
    if not is_known or compression or filtering or interlace > 1:
        raise ConversionError(
            f"PNG of a kind that does not exist (color type {color_type}, {depth} bits); {DAMAGED}"
        )
    return height, width, depth * _CHANNELS[color_type]
