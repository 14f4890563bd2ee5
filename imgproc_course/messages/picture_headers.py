"""What a JPEG or PNG says of itself, read before a decoder may take memory for it.

A header of a few bytes can claim a picture of gigabytes. Here the claim is held against what so many bytes
can hold at all, PNG's checksums are verified, and chunks that do not touch the pixels are dropped, so that
libpng has nothing to complain of on stderr.
"""

import struct
import zlib

from .errors import ConversionError, shown

MAX_PIXELS = 2**27  # 134 million: more than any camera on a robot has
PNG_EXPANSION = 1032  # bytes that one byte of a deflate stream can become: 258 from 2 bits
JPEG_PIXELS_PER_BYTE = 1024  # a block of 8 × 8 takes at least 1 bit; chroma may be halved each way
_CUT_SHORT = "the message is cut short or damaged; publish it again"


def check_jpeg(data):
    """Raises ConversionError where the bytes are no JPEG, or claim more pixels than they can hold."""
    height, width = _jpeg_size(data)
    _refuse_claim("JPEG", height, width, height * width <= JPEG_PIXELS_PER_BYTE * len(data), len(data))


def _jpeg_size(data):
    at = 2
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            break
        marker = data[at + 1]
        if marker == 0xFF:  # fill byte
            at += 1
            continue
        if marker in _STANDALONE:
            at += 2
            continue
        if marker in _FRAME_HEADERS and at + 9 <= len(data):
            return struct.unpack_from(">HH", data, at + 5)
        if marker in (0xD9, 0xDA):  # the end, or pixels, before any size
            break
        at += 2 + max(2, int.from_bytes(data[at + 2 : at + 4], "big"))
    raise ConversionError(f"JPEG of {len(data)} bytes without a readable header; {_CUT_SHORT}")


_STANDALONE = {0x01, *range(0xD0, 0xD8)}
_FRAME_HEADERS = set(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}


def checked_png(data):
    """The bytes of a PNG that is whole, reduced to the chunks that make its pixels.

    Parameters
    ----------
    data : contiguous memoryview of bytes that begins with PNG's signature

    Returns
    -------
    `data` itself, or bytes without the chunks that do not matter here (texts, times, animation, color
    profiles)

    Raises
    ------
    ConversionError : cut short, a wrong checksum, a header that no decoder takes, or a claim of more pixels
        than the bytes can hold
    """
    kept, compressed, has_extras = [data[:8]], 0, False
    at, kind, header = 8, b"", None
    while kind != b"IEND":
        length, kind, chunk = _png_chunk(data, at)
        if (kind == b"IHDR") != (at == 8):
            raise ConversionError(f"PNG whose header is not its first chunk; {_CUT_SHORT}")
        if kind == b"IHDR":
            header = _png_header(chunk[8:-4])
        if kind in _PNG_CHUNKS_KEPT:
            kept.append(chunk)
        elif kind[:1].isupper():
            raise ConversionError(f"PNG with a chunk {shown(kind)} that no decoder knows; encode it again")
        else:
            has_extras = True
        compressed += length if kind == b"IDAT" else 0
        at += 12 + length
    height, width, bits = header
    scanlines = height * (1 + (width * bits + 7) // 8)
    _refuse_claim("PNG", height, width, scanlines <= PNG_EXPANSION * compressed, len(data))
    return b"".join(kept) if has_extras else data


_PNG_CHUNKS_KEPT = {b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"}
_PNG_CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}  # by color type
_PNG_DEPTHS = {0: {1, 2, 4, 8, 16}, 2: {8, 16}, 3: {1, 2, 4, 8}, 4: {8, 16}, 6: {8, 16}}


def _png_chunk(data, at):
    """(length of the content, kind, the whole chunk) at a place in the file; its checksum holds."""
    if at + 12 > len(data):
        raise ConversionError(f"PNG that ends after {len(data)} bytes, before its last chunk; {_CUT_SHORT}")
    length = int.from_bytes(data[at : at + 4], "big")
    chunk = data[at : at + 12 + length]
    kind = bytes(chunk[4:8])
    if len(chunk) < 12 + length:
        raise ConversionError(f"PNG that ends within its chunk {shown(kind)}; {_CUT_SHORT}")
    if zlib.crc32(chunk[4:-4]) != int.from_bytes(chunk[-4:], "big"):
        raise ConversionError(f"PNG with a wrong checksum in its chunk {shown(kind)}; {_CUT_SHORT}")
    return length, kind, chunk


def _png_header(content):
    """(height, width, bits per pixel) of an IHDR."""
    if len(content) != 13:
        raise ConversionError(f"PNG with a header of {len(content)} bytes, expected 13; {_CUT_SHORT}")
    width, height, depth, color_type, compression, filtering, interlace = struct.unpack(">IIBBBBB", content)
    known = depth in _PNG_DEPTHS.get(color_type, ())
    if not known or compression or filtering or interlace > 1:
        raise ConversionError(f"PNG of a kind that does not exist (color type {color_type}, {depth} bits)")
    return height, width, depth * _PNG_CHANNELS[color_type]


def _refuse_claim(kind, height, width, is_possible, size):
    if height == 0 or width == 0:
        raise ConversionError(f"{kind} of {height} rows × {width} columns has no pixel; {_CUT_SHORT}")
    if not is_possible or height * width > MAX_PIXELS:
        raise ConversionError(
            f"{kind} of {size} bytes claims {height} rows × {width} columns, more than "
            + (f"the {MAX_PIXELS} pixels taken here" if is_possible else "so few bytes can hold")
            + "; the message is damaged or made to exhaust the memory"
        )
