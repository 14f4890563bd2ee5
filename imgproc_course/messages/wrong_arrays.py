# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""What to call first, if an argument is no array, or its shape or dtype does not fit the encoding."""

import numpy as np

from .encodings import ENCODINGS

_CALLS = {  # by the name of a class
    "NoneType": "the file or the camera gave no image: cv2.imread gives None for a path that it cannot read",
    "tuple": "take the image out of it: VideoCapture.read gives (ok, frame)",
    "list": "call np.asarray(..., dtype=np.uint8) first",
    **dict.fromkeys(("str", "PurePath"), "call cv2.imread(...) first"),
    **dict.fromkeys(
        ("bytes", "bytearray", "memoryview"),
        "call cv2.imdecode(np.frombuffer(..., np.uint8), cv2.IMREAD_COLOR) first",
    ),
    "VideoCapture": "call .read() first: it gives (ok, frame)",
    "Tensor": "call .numpy() first; of PyTorch .permute(1, 2, 0).cpu().numpy(), whose channels come first",
    **dict.fromkeys(("UMat", "ndarray"), "call .get() first"),  # of OpenCV and CuPy
    "VideoFrame": "call .to_ndarray(format='bgr24') first",
}


def call_for(value):
    """The remedy for an argument that is no array."""
    if hasattr(value, "data") and (hasattr(value, "encoding") or hasattr(value, "format")):
        return f"call {'image' if hasattr(value, 'encoding') else 'compressed'}_to_array(...) first"
    if type(value).__module__.startswith("PIL."):
        return "call np.asarray(image.convert('RGB')) first; its encoding is 'rgb8'"
    names = [cls.__name__ for cls in type(value).__mro__ if cls.__name__ in _CALLS]
    if names:
        return _CALLS[names[0]]
    return "call np.asarray(...) first" if hasattr(value, "__array__") else "pass the array of an image"


CALLS_FOR_SHAPES = {  # by the number of axes
    1: "call array.reshape(height, width, channels), or cv2.imdecode for the bytes of an image file",
    3: "its channels come first: call np.transpose(array, (1, 2, 0)) first",
    4: "send one image per message, without a batch axis: array[0]",
}


def has_channels_first(shape, encoding):
    """Whether an array is (channels, H, W): no encoding has its number of channels, or hardly any image."""
    most_channels = 4 if encoding in ENCODINGS else 16 if encoding == "passthrough" else np.inf
    return len(shape) == 3 and shape[0] in (1, 3, 4) and shape[1] > 1 and shape[2] > most_channels


def call_for_values(array, info):
    """The expression that converts the values to the dtype of an encoding, by their range."""
    if info.dtype.kind == "f":
        return f"array.astype('{info.dtype.name}')"
    limits, is_float = np.iinfo(info.dtype), array.dtype.kind == "f"
    every = 1 + array.size // 2**26  # an array of one repeated value may be larger than the memory
    finite = array[::every, ::every][np.isfinite(array[::every, ::every])]
    low, high = (finite.min(), finite.max()) if finite.size else (0, 0)
    values = "np.nan_to_num(array)" if is_float else "array"
    if is_float and info.name == "16UC1" and high <= 100:
        values += " * 1000"  # metres to millimetres
    elif is_float and -1 <= low <= high <= 1:
        values = f"{values} * {limits.max}" if low >= 0 else f"({values} + 1) * {limits.max / 2:g}"
    elif info.color and array.dtype.kind == "u":
        values += f" * ({limits.max} / {np.iinfo(array.dtype).max})"
    values = f"np.clip(np.rint({values}), {limits.min}, {limits.max})"
    return f"{values}.astype('{info.dtype.name}'), since they lie in {low:g} to {high:g}"
