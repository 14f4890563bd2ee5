"""What a picture must be before it is computed on, how it goes on past its border, and by which bands."""

import numpy as np

# Some ten arrays of int16 are alive at a time; at this many pixels each they stay in a core's cache.
BAND_PIXELS = 80_000

# Our word for a border -> NumPy's. OpenCV calls them BORDER_REFLECT_101 (dcb|abcd|cba) and BORDER_REPLICATE.
BORDERS = {"reflect_101": "reflect", "replicate": "edge"}

GRAY = "(H, W) uint8"
BGR = "(H, W, 3) uint8"


def checked_gray(gray, name="gray"):
    """The picture as a plain array, once it is sure that it is (H, W) uint8 with at least one pixel."""
    array = _checked_uint8(gray, GRAY, name)
    if array.ndim == 3 and array.shape[2] in (3, 4):
        raise ValueError(_wrong(name, GRAY, array, f"make it gray first: to_gray({name})"))
    if array.ndim != 2:
        raise ValueError(
            _wrong(name, GRAY, array, f"give one picture of two axes: {name}[..., 0] or reshape")
        )
    return array


def checked_bgr(bgr, name="bgr"):
    """The frame as a plain array, once it is sure that it is (H, W, 3) uint8 with at least one pixel."""
    array = _checked_uint8(bgr, BGR, name)
    if array.ndim == 2:
        raise ValueError(_wrong(name, BGR, array, "it is gray already: use it as it is"))
    if array.ndim == 3 and array.shape[2] == 4:
        raise ValueError(_wrong(name, BGR, array, f"drop the fourth channel: {name}[..., :3]"))
    if array.ndim != 3 or array.shape[2] != 3:
        raise ValueError(_wrong(name, BGR, array, "decode it as bgr8 first"))
    return array


def checked_frame(frame, name="frame"):
    """The picture as a plain array, once it is sure that it is (H, W) or (H, W, 3) uint8 with a pixel."""
    array = _checked_uint8(frame, f"{GRAY} or {BGR}", name)
    return array if array.ndim == 2 else checked_bgr(array, name)


def checked_pair(reference, picture):
    """Two pictures as plain arrays, once it is sure that both are uint8 and of one shape."""
    reference, picture = checked_frame(reference, "reference"), checked_frame(picture, "picture")
    if reference.shape != picture.shape:
        raise ValueError(
            f"reference and picture must have one shape, got {reference.shape} and {picture.shape}; "
            f"crop or resize one of them first"
        )
    return reference, picture


def checked_size(size, name="size", smallest=1):
    """The side of a window in pixels as an int, once it is sure that the window has a middle pixel."""
    if isinstance(size, bool) or not isinstance(size, int | np.integer) or size < smallest or size % 2 == 0:
        raise ValueError(
            f"{name} must be an odd whole number of pixels, at least {smallest}, got {size!r}; "
            f"only a window with an odd side has a middle pixel"
        )
    return int(size)


def checked_number(value, name, *, least=-np.inf, infinite=False):
    """A real number as a float; `least` is the smallest allowed."""
    real = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not real or np.isnan(value) or (np.isinf(value) and not infinite) or value < least:
        bound = "" if least == -np.inf else f", at least {least:g}"
        raise ValueError(
            f"{name} must be a number{bound}, got {value!r}; give one number, such as {name}=1.5"
        )
    return float(value)


def checked_whole(value, name):
    """A whole number as an int."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise ValueError(f"{name} must be a whole number, got {value!r}; round it first: round({name})")
    return int(value)


def padded(picture, margin, border):
    """The picture with `margin` more pixels on each of its four sides.

    Parameters
    ----------
    picture : (H, W, ...) array
    margin : pixels to add on each side
    border : "reflect_101" mirrors at the middle of the outermost pixel, as OpenCV's filters do: dcb|abcd|cba;
        "replicate" repeats the outermost pixel: aaa|abcd|ddd

    Returns
    -------
    (H + 2 margin, W + 2 margin, ...) array of the same dtype
    """
    widths = [(margin, margin)] * 2 + [(0, 0)] * (picture.ndim - 2)
    return np.pad(picture, widths, mode=BORDERS[border])


def bands(picture, least_rows=8):
    """Cuts a picture into bands of rows that fit a core's cache: yields (top, bottom), bottom excluded.

    One step after another over a whole 1280×720 picture waits for memory most of the time; all steps over
    one band, then the next band, do not.
    """
    rows, row_size = len(picture), picture[0].size
    height = max(least_rows, BAND_PIXELS // row_size)
    for top in range(0, rows, height):
        yield top, min(top + height, rows)


def _checked_uint8(picture, expected, name):
    if isinstance(picture, np.ma.MaskedArray):
        raise ValueError(
            f"{name} must be {expected}, got a masked array; its mask would be lost: "
            f"say what masked pixels are, {name}.filled(0)"
        )
    if not isinstance(picture, np.ndarray):
        raise ValueError(f"{name} must be {expected}, {_no_array(picture, expected, name)}")
    array = np.asarray(picture)
    if array.dtype != np.uint8:
        raise ValueError(_wrong(name, expected, array, _cure_of_dtype(array, name)))
    if array.size == 0:
        raise ValueError(_wrong(name, expected, array, "it has no pixel; look at what made it"))
    return array


def _wrong(name, expected, array, remedy):
    return f"{name} must be {expected}, got {array.shape} {array.dtype}; {remedy}"


def _no_array(picture, expected, name):
    kind = type(picture).__name__
    if picture is None:
        return "got None; look at what made it: a function without return gives None"
    if hasattr(picture, "data") and (hasattr(picture, "encoding") or hasattr(picture, "format")):
        convert = "image_to_array" if hasattr(picture, "encoding") else "compressed_to_array"
        encoding = "bgr8" if BGR in expected else "mono8"
        return f"got a message ({kind}); take its pixels first: {convert}({name}, {encoding!r})"
    if isinstance(picture, list | tuple) or hasattr(picture, "__array__"):
        return f"got a {kind}; make an array of it: np.array({name}, dtype=np.uint8)"
    return f"got {picture!r:.60} of type {kind}; give the array of a picture, such as recording.frame(0)"


def _cure_of_dtype(array, name):
    """What makes it uint8: what 0 and 255 stand for is guessed by the values themselves."""
    dtype = array.dtype
    if dtype == np.bool_:
        return f"make True white: {name}.astype(np.uint8) * 255"
    if dtype.kind not in "fiu":
        return "scale real numbers to 0..255 and make them uint8 first"
    if array.size == 0:
        return "it has no pixel; look at what made it"
    low, high = array.min(), array.max()
    if not (np.isfinite(low) and np.isfinite(high)):
        return f"replace what is no number, or infinite, first: np.nan_to_num({name})"
    values = f"make it uint8 first: its values go from {low:g} to {high:g}"
    if low < 0 or high > 255:
        bits = f"({name} >> 8).astype(np.uint8) when it uses all 16 bits, or " if dtype == np.uint16 else ""
        whole = f"np.rint({name})" if dtype.kind == "f" else name
        return f"{values}, so {bits}np.clip({whole}, 0, 255).astype(np.uint8)"
    if dtype.kind in "iu":
        return f"{values}, so {name}.astype(np.uint8)"
    scaled = f"{name} * 255" if high <= 1 else name
    return f"{values}, so np.rint({scaled}).astype(np.uint8)"
