"""The limits on what the header of an image file may claim: decoders allocate before they read the pixels."""

from .errors import ConversionError

MAX_PIXELS = 2**27  # 134 million: more than any camera on a robot has
BLANK_PIXELS = 2**22  # RVL, WebP and JPEG 2000 write a blank image of any size in a few bytes
PIXELS_PER_BYTE = 1024  # beyond that, for these three; for JPEG too: 8 × 8 pixels need at least 1 bit
DAMAGED = "the message is cut short or damaged; publish it again"


def check_claim(name, height, width, is_possible, file_bytes, limit="so few bytes can hold"):
    """Checks the size in the header of an image file.

    Parameters
    ----------
    name : name of the file format, for the error
    height, width : in pixels, as the header claims
    is_possible : whether so many bytes can hold so many pixels in this format
    file_bytes : size of the file
    limit : for the error: the limit that is exceeded if not is_possible

    Raises
    ------
    ConversionError : no pixel, more than MAX_PIXELS, or not possible
    """
    if height == 0 or width == 0:
        raise ConversionError(f"{name} of {height} rows × {width} columns has no pixel; {DAMAGED}")
    if not is_possible or height * width > MAX_PIXELS:
        limit = f"the limit of {MAX_PIXELS} pixels" if is_possible else limit
        raise ConversionError(
            f"{name} of {file_bytes} bytes claims {height} rows × {width} columns, more than {limit}; "
            "the message is damaged or made to exhaust the memory"
        )


def check_blank_claim(name, height, width, file_bytes):
    """As check_claim, for a format that writes a blank image of any size in a few bytes."""
    most = BLANK_PIXELS + PIXELS_PER_BYTE * file_bytes
    limit = f"the {most} pixels accepted from so few bytes"
    check_claim(name, height, width, height * width <= most, file_bytes, limit)
