"""The chunks of a PNG: checked, and reduced to those that make the pixels, before libpng decodes them."""

import zlib

from .errors import ConversionError, quoted
from .image_headers import DAMAGED


def pixel_chunks(data):
    """The bytes of a whole PNG without texts, times, animation and color profiles.

    libpng prints warnings about these to stderr. ConversionError if the PNG is cut short, or if the checksum
    of a chunk is wrong.
    """
    chunks, at, kind = [data[:8]], 8, b""
    while kind != b"IEND":
        length = int.from_bytes(data[at : at + 4], "big")
        chunk = data[at : at + 12 + length]
        kind = bytes(chunk[4:8])
        if len(chunk) < 12 + length:
            raise ConversionError(f"PNG that ends within its chunk {quoted(kind)}; {DAMAGED}")
        if zlib.crc32(chunk[4:-4]) != int.from_bytes(chunk[-4:], "big"):
            raise ConversionError(f"PNG with a wrong checksum in its chunk {quoted(kind)}; {DAMAGED}")
        if kind[:1].isupper() or kind == b"tRNS":  # a decoder must know chunks in upper case
            chunks.append(chunk)
        at += 12 + length
    return b"".join(chunks)
