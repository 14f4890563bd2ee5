# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""sensor_msgs/CompressedImage to a NumPy array and back: JPEG, PNG, other image files, and ROS's transports.

ROS's compressed_image_transport writes "<encoding>; <codec> compressed <stored>" into the field `format`: the
encoding of the image before compression, and that of the values in the file. `stored` is empty if they are as
they were: always in a TIFF, and in a PNG that is not in color. Many cameras write only "jpeg" or "png". Then
the encoding follows from the decoded image.
"""

import functools

import cv2
import numpy as np

from .conversion import bytes_of, described
from .depth import decode_depth, is_depth
from .encodings import ENCODINGS, encoding_info, generic_name
from .errors import ConversionError, quoted
from .image_files import check_value_count, decode_image_file, encode_image_file
from .lossless import LOSSLESS, decode_lossless
from .message_classes import Message, new_message
from .pixels import converter

# The last part of the topic's name, if it carries sensor_msgs/CompressedImage
TRANSPORTS = ("compressed", "compressedDepth", *LOSSLESS)


def compressed_to_array(msg: Message, desired_encoding: str = "passthrough") -> np.ndarray:
    """The image of a CompressedImage message as an array.

    Parameters
    ----------
    msg : sensor_msgs/CompressedImage, or any object with its fields `format` and `data`. `data` must hold a
        JPEG, PNG, or another image file that `CvBridge.cv2_to_compressed_imgmsg` writes, compressedDepth
        (PNG or RVL), or what zstd_image_transport publishes
    desired_encoding : "passthrough" (also "") keeps the image as it is decoded: mono8, bgr8, bgra8, mono16,
        bgr16 or bgra16; a Bayer mosaic if `format` says so; 16UC1 or 32FC1 of compressedDepth; 32FC1 and the
        like of TIFF and PFM; of zstd the raw image. Any other encoding converts this image, as
        `image_to_array` does

    Returns
    -------
    (H, W) or (H, W, channels) ndarray, fresh and writable

    Raises
    ------
    ConversionError : the data are of another format, cut short or damaged; the header claims more pixels than
        the bytes can hold (checked before a decoder allocates memory); the conversion has no meaning

    Notes
    -----
    A JPEG has no checksum. If bits in it are flipped, every decoder returns an image with wrong pixels.

    Examples
    --------
    >>> msg = array_to_compressed(np.array([[10, 200]], np.uint8), "mono8", "png")
    >>> print(compressed_to_array(msg))
    [[ 10 200]]
    """
    try:
        return _decoded(msg, desired_encoding)
    except ConversionError as error:
        raise error.with_traceback(None) from error.__cause__


def _decoded(msg, desired_encoding):
    format, data = _fields(msg)
    if format in LOSSLESS:
        return decode_lossless(data, desired_encoding)
    if is_depth(format, data):
        frame, source = decode_depth(format, data)
    else:  # whatever the format says: the file itself says what it is
        frame = decode_image_file(data, format)
        source = _meaning(format, frame)
    if isinstance(desired_encoding, str) and desired_encoding in ("passthrough", ""):
        desired_encoding = source.name.replace("rgb", "bgr")
    convert = _conversion(source, encoding_info(desired_encoding), "the encoding in msg.format")
    return convert(frame) if convert else frame


def array_to_compressed(
    array: np.ndarray,
    encoding: str = "bgr8",
    format: str = "jpeg",
    header: Message | None = None,
    quality: int = 90,
) -> Message:
    """A CompressedImage message that holds the array as JPEG or PNG.

    Parameters
    ----------
    array : (H, W) or (H, W, channels) ndarray
    encoding : the meaning of the values: mono8, mono16, rgb8 and the like, bgr16 and the like, 8UC1, 8UC3
        (taken as bgr), 16UC1, or a Bayer encoding (PNG only)
    format : "jpeg" (also "jpg"; 8 bits, loses detail, drops alpha) or "png" (8 or 16 bits, lossless)
    header : std_msgs/Header, stored by reference; None for an empty one
    quality : of JPEG, 1 to 100

    Returns
    -------
    sensor_msgs.msg.CompressedImage, or the class of rosbags if sensor_msgs is not installed. Its `format` is
    the text that ROS's compressed_image_transport writes, such as "rgb8; jpeg compressed bgr8"

    Raises
    ------
    ConversionError : the array does not fit `encoding`, or the format would change its values

    Examples
    --------
    >>> msg = array_to_compressed(np.zeros((2, 2, 3), np.uint8), "rgb8")
    >>> msg.format
    'rgb8; jpeg compressed bgr8'
    """
    try:
        return _encoded(array, encoding, format, header, quality)
    except ConversionError as error:
        raise error.with_traceback(None) from error.__cause__


def _encoded(array, encoding, format, header, quality):
    codec = {"jpeg": "jpeg", "jpg": "jpeg", "png": "png"}.get(format) if isinstance(format, str) else None
    if codec is None:
        raise ConversionError(f"format must be 'jpeg' or 'png', got {quoted(format)}; 'png' is lossless")
    if not isinstance(quality, int) or not 1 <= quality <= 100:
        raise ConversionError(f"quality must be an int from 1 to 100, got {quoted(quality)}")
    info = described(array, encoding)
    check_value_count(array)
    stored = _stored_as(info, codec)
    convert = None if stored.color is None else _conversion(info, stored)
    pixels = np.ascontiguousarray(array, info.dtype)
    options = [cv2.IMWRITE_JPEG_QUALITY, quality] if codec == "jpeg" else []
    data = encode_image_file(convert(pixels) if convert else pixels, codec, options)
    format = f"{info.name}; {codec} compressed {stored.name}"
    return new_message("CompressedImage", header, data, format=format)


def _decoded_name(dtype, channels):
    """Encoding of an image as OpenCV decodes it: "bgr8" of (uint8, 3), "32FC1" of (float32, 1)."""
    color = {1: "mono", 3: "bgr", 4: "bgra"}.get(channels)
    bits = {"uint8": 8, "uint16": 16}.get(dtype.name)
    return f"{color}{bits}" if color and bits else generic_name(dtype, channels)


_conversion = functools.lru_cache(maxsize=256)(converter)


def _stored_as(info, codec):
    """EncodingInfo of the values in the file: one that OpenCV's encoders accept, of the same depth."""
    is_mosaic = (info.color or "").startswith("bayer_")
    if codec == "jpeg" and (is_mosaic or info.dtype != np.uint8):
        problem = "blurs a mosaic" if is_mosaic else "holds 8 bits"
        raise ConversionError(
            f"JPEG {problem}, and the array is {info.name!r}; use format='png', or convert it to 'bgr8'"
        )
    bits = 8 * info.dtype.itemsize
    if info.color in ("rgb", "bgr") or (codec == "jpeg" and info.color in ("rgba", "bgra")):
        return encoding_info(f"bgr{bits}")
    if info.color in ("rgba", "bgra"):
        return encoding_info(f"bgra{bits}")
    if info.color == "gray":
        return info
    if info.dtype.kind == "u" and info.channels in (1, 3) and (info.color is None or is_mosaic):
        return info._replace(color=None, name=_decoded_name(info.dtype, info.channels))
    remedy = "convert it to 'bgr8' or 'mono8' first"
    if info.name == "32FC1":
        remedy = "depth in millimetres fits into '16UC1' (PNG)"
    raise ConversionError(f"{codec} cannot hold {info.name!r}; {remedy}")


def _fields(msg):
    """(format, data) of a message; the data as a memoryview."""
    format, data = (getattr(msg, field, None) for field in ("format", "data"))
    if isinstance(format, str) and data is not None:
        return format, bytes_of(data)
    remedy = "image_to_array reads an Image" if hasattr(msg, "encoding") else "pass the message itself"
    missing = "'data'" if isinstance(format, str) else "a text in 'format'"
    raise ConversionError(
        f"expected a sensor_msgs/CompressedImage, got {quoted(msg)} without {missing}; {remedy}"
    )


def _meaning(format, frame):
    """EncodingInfo of a decoded image: as OpenCV decodes it, or as `format` says where that is more exact."""
    decoded = encoding_info(_decoded_name(frame.dtype, 1 if frame.ndim == 2 else frame.shape[2]))
    original_name, _, codec = map(str.strip, format.partition(";"))
    codec, compressed, stored_name = map(str.strip, codec.partition("compressed"))
    original, stored = ENCODINGS.get(original_name), ENCODINGS.get(stored_name or original_name)
    if compressed and stored and stored.dtype != decoded.dtype:
        raise ConversionError(
            f"format {quoted(format)} and a file of {decoded.dtype.name}: the publisher lost the values of "
            f"{stored.name!r}; subscribe to the raw topic, or for depth to compressedDepth"
        )
    if stored_name.startswith("rgb"):  # the publisher did not swap the channels to OpenCV's order
        return encoding_info(decoded.name.replace("bgr", "rgb"))
    if original is None or original[1:3] != decoded[1:3]:
        return decoded
    # The file holds a mosaic or a depth image as gray levels: only `format` says what it is. Of a mosaic, the
    # plugin makes gray before it writes a JPEG.
    is_mosaic = (original.color or "").startswith("bayer_") and (codec, stored_name) != ("jpeg", "mono8")
    is_as_it_was = codec == "tiff" and not stored_name and original.color
    return original if is_mosaic or is_as_it_was or original.name == "16UC1" else decoded
