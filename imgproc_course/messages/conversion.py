# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""sensor_msgs/Image to a NumPy array and back, with the same bytes as cv_bridge and without its faults.

A message may be of any class that has the fields: of sensor_msgs, of rosbags, or a SimpleNamespace.
"""

import functools
import sys
from collections.abc import Callable
from operator import index
from typing import NamedTuple

import numpy as np

from .encodings import ENCODINGS, EncodingInfo, encoding_info, generic_name
from .errors import ConversionError, quoted
from .message_classes import Message, new_message
from .pixels import converter
from .wrong_arrays import CALLS_FOR_SHAPES, call_for, call_for_values, has_channels_first

UINT32_MAX = 2**32 - 1  # the largest height, width and step of a message, and the most bytes it can carry


def image_to_array(msg: Message, desired_encoding: str = "passthrough") -> np.ndarray:
    """The image of an Image message as an array.

    Parameters
    ----------
    msg : sensor_msgs/Image, or any object with its fields; `data` may be bytes, bytearray, memoryview,
        array.array, a uint8 ndarray, or a list or tuple of ints
    desired_encoding : "passthrough" (also "") keeps the values; any other encoding converts them as cv_bridge
        does: first the colors, then the depth (see `pixels.converter`)

    Returns
    -------
    (H, W) or (H, W, channels) ndarray in the machine's byte order; nv12 and nv21 are (H * 3 / 2, W), nv24 is
    (H * 3, W), as OpenCV lays them out. If no value changes, the result is a READ-ONLY view of `msg.data`,
    without a copy: call `.copy()` before you draw on it. (If the rows are padded, the view has gaps between
    its rows.) Otherwise it is a fresh array.

    Raises
    ------
    ConversionError : a field is missing, has another type, or contradicts the others; an encoding is unknown;
        the conversion has no meaning

    Examples
    --------
    >>> msg = array_to_image(np.array([[[1, 2, 3]]], np.uint8), "rgb8")
    >>> print(image_to_array(msg, "bgr8"))
    [[[3 2 1]]]
    """
    try:
        layout = _layout(msg.encoding, desired_encoding, msg.height, msg.width, msg.step, msg.is_bigendian)
        data = memoryview(msg.data)
        is_plain = layout.format and len(data) == layout.size
        # The array keeps the memoryview, which locks the buffer: `data` cannot grow under the view.
        frame = np.asarray(data.toreadonly().cast(layout.format, layout.shape)) if is_plain else None
    except (AttributeError, TypeError, ValueError, BufferError):  # read again, to find the wrong field
        frame = None
    if frame is None:
        try:
            layout, frame = _read_any(msg, desired_encoding)
        except ConversionError as error:
            raise error.with_traceback(None) from error.__cause__
    return layout.convert(frame) if layout.convert else frame


def _read_any(msg, desired_encoding):
    """(_Layout, array) of a message with padded rows, swapped bytes or data of any kind, or with a fault."""
    name = _checked_name("encoding", _field(msg, "encoding"))
    desired = _checked_name("desired_encoding", desired_encoding)
    layout = _layout(name, desired, *(_number(msg, field) for field in _NUMBER_FIELDS))
    data = bytes_of(_field(msg, "data"))
    if data.nbytes < layout.size:
        raise ConversionError(_cut_short(layout, data.nbytes))
    if layout.is_padded:
        frame = _skip_padding(np.frombuffer(data.toreadonly(), np.uint8), layout)
    else:
        count = layout.size // layout.dtype.itemsize
        frame = np.frombuffer(data.toreadonly(), layout.dtype, count).reshape(layout.shape)
    return layout, frame if layout.dtype.isnative else frame.astype(layout.source.dtype)


def array_to_image(
    array: np.ndarray, encoding: str = "passthrough", header: Message | None = None
) -> Message:
    """An Image message that holds a copy of the array.

    Parameters
    ----------
    array : (H, W) or (H, W, channels) ndarray of uint8, int8, uint16, int16, int32, float32 or float64, of
        any memory layout and either byte order (`is_bigendian` is set accordingly)
    encoding : the meaning of the values; it must fit the array, since nothing is converted here.
        "passthrough" says only how they are stored ("8UC3"); a receiver then cannot tell rgb from bgr
    header : std_msgs/Header, stored by reference; None for an empty one

    Returns
    -------
    sensor_msgs.msg.Image, or the class of rosbags with the same fields if sensor_msgs is not installed

    Raises
    ------
    ConversionError : no message can hold the array, or the array does not fit `encoding`

    Examples
    --------
    >>> msg = array_to_image(np.array([[1, 2], [3, 4]], np.uint8), "mono8")
    >>> print(msg.height, msg.width, msg.encoding, *msg.data)
    2 2 mono8 1 2 3 4
    """
    try:
        return _message_of(array, encoding, header)
    except ConversionError as error:
        raise error.with_traceback(None) from error.__cause__


def _message_of(array, encoding, header):
    info = described(array, encoding)
    rows, width = array.shape[:2]
    height, step = info.height(rows), width * info.pixel_bytes
    if max(rows, width, step, step * rows) > UINT32_MAX:
        raise ConversionError(
            f"an array of shape {array.shape} is too large for a message, whose fields hold at most "
            f"{UINT32_MAX}; crop it or scale it down"
        )
    is_bigendian = array.dtype.itemsize > 1 and array.dtype.isnative == (sys.byteorder == "big")
    pixels = np.ascontiguousarray(array).view(np.uint8)
    fields = {"height": height, "width": width, "encoding": info.name, "step": step}
    return new_message("Image", header, pixels.data, is_bigendian=int(is_bigendian), **fields)


class _Layout(NamedTuple):
    """Where the values lie in the bytes of a message, and what becomes of them."""

    source: EncodingInfo
    dtype: np.dtype  # of the values in the message
    height: int
    width: int
    step: int
    size: int  # bytes of all rows
    shape: tuple[int, ...]
    is_padded: bool
    format: str  # of the values in a memoryview; empty if rows are padded or bytes swapped
    convert: Callable | None


# Cached, since the images of a camera agree in all of this. Typed: 720.0 is no height, though it equals 720.
@functools.lru_cache(maxsize=512, typed=True)
def _layout(encoding, desired, height, width, step, is_bigendian):
    source = _known(encoding, "encoding")
    is_passthrough = desired in ("passthrough", "")
    convert = None if is_passthrough else converter(source, _known(desired, "desired_encoding"))
    height, width, step, is_bigendian = map(index, (height, width, step, is_bigendian))
    _check_numbers(source, height, width, step, is_bigendian)
    dtype = source.dtype.newbyteorder(">" if is_bigendian else "<")
    is_padded = step > width * source.pixel_bytes
    return _Layout(
        source=source,
        dtype=dtype,
        height=height,
        width=width,
        step=step,
        size=step * source.rows(height),
        shape=source.shape(height, width),
        is_padded=is_padded,
        format=dtype.char if dtype.isnative and not is_padded else "",
        convert=convert,
    )


def _known(name, field):
    try:
        return encoding_info(name)
    except ConversionError as error:
        raise ConversionError(f"{field}: {error}") from None


def described(array, encoding):
    """EncodingInfo of an array, which must fit `encoding`; of "passthrough": how the array is stored."""
    if isinstance(array, np.ndarray) and array.dtype == object:
        array = array.tolist()
    if not isinstance(array, np.ndarray):
        raise ConversionError(f"expected a NumPy array, got {quoted(array)}; {call_for(array)}")
    if type(array) is not np.ndarray and np.ma.is_masked(array):
        raise ConversionError("a message cannot hold a mask; fill it first: array.filled(0)")
    encoding = _checked_name("encoding", encoding)
    if array.ndim not in (2, 3) or has_channels_first(array.shape, encoding):
        raise ConversionError(
            f"expected an array of shape (H, W) or (H, W, channels), got {array.shape}; "
            + CALLS_FOR_SHAPES.get(array.ndim, CALLS_FOR_SHAPES[4])
        )
    channels = array.shape[2] if array.ndim == 3 else 1
    stored, info, fits, is_planar = _described(array.dtype, channels, encoding)
    if not fits:
        raise ConversionError(_mislabelled(array, stored, info))
    if is_planar and (array.shape[0] % 3 or _planes_misfit(info, 0, array.shape[1])):
        raise ConversionError(
            f"an array of shape {array.shape} cannot be {info.name!r}: expected "
            + ("(H * 3, W)" if info.name == "nv24" else "(H * 3 / 2, W) with H and W even")
        )
    return info


@functools.lru_cache(maxsize=256)
def _described(dtype, channels, encoding):
    """(EncodingInfo of the values as stored, that of `encoding`, whether both fit, whether it is planar)."""
    stored = encoding_info(generic_name(dtype, channels))
    info = stored if encoding == "passthrough" else _known(encoding, "encoding")
    return stored, info, info[1:3] == stored[1:3], info.is_planar


def _mislabelled(array, stored, info):
    expected = f"{info.dtype.name}, " + ("(H, W)" if info.channels == 1 else f"(H, W, {info.channels})")
    if info.dtype != stored.dtype:
        remedy = f"convert the values to {info.dtype.name} first: {call_for_values(array, info)}"
    else:
        names = [name for name, info in ENCODINGS.items() if info[1:3] == stored[1:3] and info.color]
        own = " or ".join(map(repr, [*names[:2], stored.name]))
        remedy = f"name the array's own encoding ({own}), or convert the array first"
    actual = f"{array.dtype.name}, {array.shape}"
    return f"encoding {info.name!r} needs an array of {expected}; got {actual}: {remedy}"


def _planes_misfit(source, height, width):
    """Whether blocks of 2 × 2 pixels, which share one U and one V, do not tile this size (nv24 has none)."""
    return source.color != "nv24" and (height % 2 or width % 2)


def _skip_padding(bytes_, layout):
    """The rows of pixels without their padding: a view, but a copy of nv24's planes."""
    source, height, width, step = layout.source, layout.height, layout.width, layout.step
    if source.color == "nv24":  # a row of U and V pairs, and its padding, is twice as long as a row of Y
        luma = bytes_[: height * step].reshape(height, step)[:, :width]
        chroma = bytes_[height * step : 3 * height * step].reshape(height, 2 * step)[:, : 2 * width]
        return np.concatenate([luma, chroma.reshape(2 * height, width)])
    value_bytes = layout.dtype.itemsize
    strides = (step, source.pixel_bytes, value_bytes)[: len(layout.shape)]
    frame = np.ndarray(layout.shape, layout.dtype, bytes_, strides=strides)
    return frame if step % value_bytes == 0 else frame.copy()  # OpenCV refuses a step that splits a value


# The functions below run once a layout, or only if something is wrong.

_NUMBER_FIELDS = ("height", "width", "step", "is_bigendian")


def _field(msg, name):
    try:
        return getattr(msg, name)
    except AttributeError:
        raise ConversionError(
            f"expected a sensor_msgs/Image, got {quoted(msg)} without a field {name!r}; {_remedy_for(msg)}"
        ) from None


def _remedy_for(msg):
    if isinstance(getattr(msg, "format", None), str):
        return "compressed_to_array reads a CompressedImage"
    if isinstance(msg, np.ndarray):
        return "it is an array already: use it directly"
    return "pass the message itself, as in a subscriber's on_image(frame, msg)"


def _checked_name(field, name):
    if not isinstance(name, str):
        raise ConversionError(f"{field}: an encoding is a name such as 'bgr8', got {quoted(name)}")
    return name


def _number(msg, field):
    value = _field(msg, field)
    try:
        return index(value)
    except TypeError:
        raise ConversionError(f"field {field!r} must be an int, got {quoted(value)}") from None


def bytes_of(data):
    """`data` of a message as a flat memoryview of bytes, from any kind of sequence."""
    try:
        view = memoryview(bytes(data) if isinstance(data, list | tuple) else data)
        if view.itemsize == 1:
            can_cast = view.c_contiguous and view.format in ("B", "b", "c", "?") and view.nbytes
            return view.cast("B") if can_cast else memoryview(view.tobytes())
    except (TypeError, ValueError, OverflowError, BufferError):
        pass
    raise ConversionError(
        "field 'data' must be bytes, an array.array('B'), a uint8 array or a list of ints 0..255; "
        f"got {quoted(data)}; array.tobytes() makes bytes of any array"
    )


def _check_numbers(source, height, width, step, is_bigendian):
    """Refuses numbers of a message that contradict each other."""
    if is_bigendian not in (0, 1):
        raise ConversionError(
            f"field 'is_bigendian' is {quoted(is_bigendian)}; expected 0 or 1: set it to 0, unless "
            "a big-endian machine wrote the values"
        )
    for field, value in {"height": height, "width": width, "step": step}.items():
        if not 0 <= value <= UINT32_MAX:
            raise ConversionError(f"field {field!r} is {quoted(value)}; expected a uint32, 0 to {UINT32_MAX}")
    if source.is_planar and _planes_misfit(source, height, width):
        raise ConversionError(
            f"encoding {source.name!r} with {height} rows × {width} columns: 2 × 2 pixels share one color, "
            "so both must be even; height and width are those of the image, not of the stacked planes"
        )
    row = width * source.pixel_bytes
    if step < row:
        raise ConversionError(
            f"encoding {source.name!r} with width {width} needs step >= {row} bytes, got {step}; "
            "the message is cut short or its encoding is mislabelled"
        )


def _cut_short(layout, size):
    remedy = "the message is cut short, or its height, step or encoding is wrong"
    if layout.source.is_planar:
        remedy += " (step is the length of a row of Y)"
    rows = layout.source.rows(layout.height)
    return f"{rows} rows of {layout.step} bytes need {layout.size} bytes of data, got {size}; {remedy}"
