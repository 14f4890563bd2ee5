"""RVL, the lossless depth compression of ROS's compressedDepth.

Source: A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017, doi:10.1145/3132272.3134144.

The pixels are stored as runs: the number of zero pixels, the number of nonzero pixels, then for each nonzero
pixel the difference to the previous nonzero pixel. The sign of a difference is in its lowest bit: 0, -1, 1,
-2 become 0, 1, 2, 3. A number is written in nibbles with 3 bits each, lowest bits first; bit 3 of a nibble is
set if more nibbles follow. Eight nibbles, the first one highest, make a little-endian word of 32 bits.
"""

import numpy as np

from .errors import ConversionError

_MAX_NIBBLES = 11  # of a number of 32 bits


def rvl_decode(stream, pixels):
    """(pixels,) uint16 of an RVL stream, which must hold exactly this number of pixels."""
    numbers = _from_words(stream)
    runs = _runs(numbers, pixels)
    signed_low = np.concatenate([numbers[:0], *(numbers[first : first + count] for first, _, count in runs)])
    differences = (signed_low >> 1).astype(np.uint16) ^ -(signed_low & 1).astype(np.uint16)
    values = np.cumsum(differences, dtype=np.uint16)
    flat, start = np.zeros(pixels, np.uint16), 0
    for _, position, count in runs:
        flat[position : position + count] = values[start : start + count]
        start += count
    return flat


def _runs(numbers, pixels):
    """(index of its first difference, index of its first pixel, length) of each run of nonzero pixels."""
    runs: list[tuple[int, int, int]] = []
    at, position = 0, 0
    while position < pixels:
        if at + 2 > numbers.size:
            raise ConversionError(
                f"RVL stream that ends after {position} of {pixels} pixels; the message is cut short"
            )
        zeros, nonzeros = numbers.item(at), numbers.item(at + 1)
        first, position = at + 2, position + zeros
        is_empty = (zeros == 0 and runs) or (nonzeros == 0 and position < pixels)
        if is_empty or position + nonzeros > pixels or first + nonzeros > numbers.size:
            raise ConversionError(
                f"RVL stream whose runs do not make {pixels} pixels; the message is damaged"
            )
        runs.append((first, position, nonzeros))
        at, position = first + nonzeros, position + nonzeros
    return runs


def _from_words(stream):
    groups = np.frombuffer(stream, "<u4", len(stream) // 4)
    highest_first = groups.astype(">u4").view(np.uint8)
    nibbles = np.column_stack([highest_first >> 4, highest_first & 15]).ravel()
    ends = np.flatnonzero(nibbles < 8)
    starts = np.concatenate([[0], ends[:-1] + 1])[: ends.size]
    lengths = ends - starts + 1
    if lengths.max(initial=0) > _MAX_NIBBLES:
        raise ConversionError("RVL stream with a number of more than 32 bits; the message is damaged")
    numbers = np.zeros(ends.size, np.uint32)
    for nibble in range(lengths.max(initial=0)):
        longer = lengths > nibble
        numbers[longer] |= (nibbles[starts[longer] + nibble] & 7).astype(np.uint32) << np.uint32(3 * nibble)
    return numbers
