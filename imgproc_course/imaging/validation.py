"""Checks of what callers pass in: images, window sizes and numbers. Each error names the remedy."""

import numpy as np

GRAY = "(H, W) uint8"
BGR = "(H, W, 3) uint8"


def check_gray(gray):
    """Return the image as a plain array; raise ValueError if it is not (H, W) uint8 or has no pixels."""
    array = _check_uint8(gray, GRAY, "gray")
    if array.ndim == 3 and array.shape[2] in (3, 4):
        raise ValueError(_mismatch("gray", GRAY, array, "make it gray first: to_gray(gray)"))
    if array.ndim != 2:
        raise ValueError(_mismatch("gray", GRAY, array, "one image has two axes: gray[..., 0] or reshape"))
    return array


def check_bgr(bgr, name="bgr"):
    """Return the image as a plain array; raise ValueError if it is not (H, W, 3) uint8 or has no pixels."""
    array = _check_uint8(bgr, BGR, name)
    if array.ndim == 2:
        raise ValueError(_mismatch(name, BGR, array, "it is gray already: use it as it is"))
    if array.ndim == 3 and array.shape[2] == 4:
        raise ValueError(_mismatch(name, BGR, array, f"drop the fourth channel: {name}[..., :3]"))
    if array.ndim != 3 or array.shape[2] != 3:
        raise ValueError(_mismatch(name, BGR, array, "decode it as bgr8 first"))
    return array


def check_image(image, name="image"):
    """Return the image as a plain array; raise ValueError if it is neither gray nor BGR, or has no pixels."""
    array = _check_uint8(image, f"{GRAY} or {BGR}", name)
    return array if array.ndim == 2 else check_bgr(array, name)


def check_pair(reference, image):
    """Return both images as plain arrays; raise ValueError if they are not uint8 or differ in shape."""
    reference, image = check_image(reference, "reference"), check_image(image, "image")
    if reference.shape != image.shape:
        raise ValueError(
            f"reference and image must have the same shape, got {reference.shape} and {image.shape}; "
            f"crop or resize one of them first"
        )
    return reference, image


def check_size(size, minimum=1):
    """Return the side of a window in pixels as an int; raise ValueError if the window has no middle pixel."""
    if isinstance(size, bool) or not isinstance(size, int | np.integer) or size < minimum or size % 2 == 0:
        raise ValueError(
            f"size must be an odd whole number of pixels, at least {minimum}, got {size!r}; "
            f"only a window with an odd side has a middle pixel"
        )
    return int(size)


def check_number(value, name, *, minimum=-np.inf, allow_infinite=False):
    """Return a real number as a float; raise ValueError if it is NaN or below `minimum`."""
    is_real = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not is_real or np.isnan(value) or (np.isinf(value) and not allow_infinite) or value < minimum:
        bound = "" if minimum == -np.inf else f", at least {minimum:g}"
        raise ValueError(f"{name} must be a number{bound}, got {value!r}; pass one, such as {name}=1.5")
    return float(value)


def _check_uint8(image, expected, name):
    if isinstance(image, np.ma.MaskedArray):
        raise ValueError(
            f"{name} must be {expected}, got a masked array; its mask would be lost: "
            f"fill the masked pixels first, {name}.filled(0)"
        )
    if not isinstance(image, np.ndarray):
        raise ValueError(f"{name} must be {expected}, {_describe_non_array(image, expected, name)}")
    array = np.asarray(image)
    if array.size == 0:
        raise ValueError(_mismatch(name, expected, array, "it has no pixels; check the code that made it"))
    if array.dtype != np.uint8:
        raise ValueError(_mismatch(name, expected, array, _dtype_remedy(array, name)))
    return array


def _mismatch(name, expected, array, remedy):
    return f"{name} must be {expected}, got {array.shape} {array.dtype}; {remedy}"


def _describe_non_array(value, expected, name):
    """What was passed instead of an array, and the remedy."""
    type_name = type(value).__name__
    if value is None:
        return "got None; check the code that made it: a function without return gives None"
    if hasattr(value, "data") and (hasattr(value, "encoding") or hasattr(value, "format")):
        converter = "image_to_array" if hasattr(value, "encoding") else "compressed_to_array"
        encoding = "bgr8" if BGR in expected else "mono8"
        return f"got a message ({type_name}); convert it first: {converter}({name}, {encoding!r})"
    if isinstance(value, list | tuple) or hasattr(value, "__array__"):
        return f"got a {type_name}; convert it to an array: np.array({name}, dtype=np.uint8)"
    return f"got {value!r:.60} of type {type_name}; pass the array of an image, such as recording.frame(0)"


def _dtype_remedy(array, name):
    """How to convert the array to uint8. The range of its values suggests what its 0 and 255 are."""
    dtype = array.dtype
    if dtype == np.bool_:
        return f"make True white: {name}.astype(np.uint8) * 255"
    if dtype.kind not in "fiu":
        return "scale real numbers to 0..255 and convert them to uint8 first"
    low, high = array.min(), array.max()
    if not (np.isfinite(low) and np.isfinite(high)):
        return f"replace NaN and infinite values first: np.nan_to_num({name})"
    value_range = f"convert it to uint8 first: its values go from {low:g} to {high:g}"
    if low < 0 or high > 255:
        shift = f"({name} >> 8).astype(np.uint8) if it uses all 16 bits, or " if dtype == np.uint16 else ""
        rounded = f"np.rint({name})" if dtype.kind == "f" else name
        return f"{value_range}, so {shift}np.clip({rounded}, 0, 255).astype(np.uint8)"
    if dtype.kind in "iu":
        return f"{value_range}, so {name}.astype(np.uint8)"
    scaled = f"{name} * 255" if high <= 1 else name
    return f"{value_range}, so np.rint({scaled}).astype(np.uint8)"
