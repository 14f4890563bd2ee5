"""The limits on what the header of an image file may claim: decoders allocate before they read the pixels."""

from .errors import ConversionError

MAX_PIXELS = 2**27  # 134 million: more than any camera on a robot has
BLANK_PIXELS = 2**22  # RVL, WebP and JPEG 2000 write a blank image of any size in a few bytes
PIXELS_PER_BYTE = 1024  # beyond that, for these three; for JPEG too: 8 × 8 pixels need at least 1 bit
DAMAGED = "the message is cut short or damaged; publish it again"


def check_claim(name, height, width, file_bytes, limit):
    """Refuses no pixel, and more than `limit` or MAX_PIXELS pixels, in the header of an image file."""
    limit = min(limit, MAX_PIXELS)
    if height == 0 or width == 0:
        raise ConversionError(f"{name} of {height} rows × {width} columns has no pixel; {DAMAGED}")
    if height * width > limit:
        raise ConversionError(
            f"{name} of {file_bytes} bytes claims {height} rows × {width} columns, more than the {limit} "
            "pixels accepted from so few bytes; the message is damaged or made to exhaust the memory"
        )
