# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""The names of cv_bridge, so that one changed line replaces it in a node:

    from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError

Where cv_bridge is right, the result is the same, and writable as there. Where cv_bridge returns a wrong image
or raises another error, this returns the right image or raises CvBridgeError.
"""

import cv2
import numpy as np

from .compressed import compressed_to_array
from .conversion import array_to_image, described, image_to_array
from .encodings import DEPTHS, encoding_info, generic_name
from .errors import ConversionError, quoted
from .image_files import encode_image_file
from .message_classes import new_message
from .pixels import converter

__all__ = ["CvBridge", "CvBridgeError", "cvtColorForDisplay", "getCvType"]

_DEPTHS = {depth: (np.dtype(code).name, getattr(cv2, f"CV_{depth}")) for depth, code in DEPTHS.items()}
_CHANNEL_SHIFT = (cv2.CV_8UC2 - cv2.CV_8UC1).bit_length() - 1  # 3 in OpenCV 4, 5 in OpenCV 5


CvBridgeError = ConversionError  # a TypeError too, as in cv_bridge


class CvBridge:
    """Converts between messages and arrays; the methods and their parameters are cv_bridge's.

    Attributes
    ----------
    cvtype_to_name : {cv2.CV_8UC3: "8UC3", ...}, 1 to 4 channels
    cvdepth_to_numpy_depth : {cv2.CV_8U: "uint8", ...}
    numpy_type_to_cvtype : {"uint8": "8U", ..., "8U": "uint8", ...}
    """

    def __init__(self):
        names = [f"{depth}C{n}" for depth in _DEPTHS for n in (1, 2, 3, 4)]
        self.cvtype_to_name = {getattr(cv2, f"CV_{name}"): name for name in names}
        self.cvdepth_to_numpy_depth = {code: dtype for dtype, code in _DEPTHS.values()}
        self.numpy_type_to_cvtype = {dtype: depth for depth, (dtype, _) in _DEPTHS.items()}
        self.numpy_type_to_cvtype.update({depth: dtype for depth, (dtype, _) in _DEPTHS.items()})

    def imgmsg_to_cv2(self, img_msg, desired_encoding="passthrough"):
        """The image of an Image message, always writable; see `image_to_array`.

        "passthrough" returns a view of `img_msg.data` if that is writable and its rows have no padding.
        Everything else is a fresh array.
        """
        frame = image_to_array(img_msg, desired_encoding)
        if frame.flags.writeable:
            return frame
        data, is_whole = img_msg.data, desired_encoding == "passthrough" and frame.flags.c_contiguous
        if is_whole and not isinstance(data, list | tuple) and not memoryview(data).readonly:
            return np.frombuffer(data, frame.dtype, frame.size).reshape(frame.shape)
        return frame.copy()

    def cv2_to_imgmsg(self, cvim, encoding="passthrough", header=None):
        """An Image message with a copy of the array; see `array_to_image`."""
        return array_to_image(cvim, encoding, header)

    def compressed_imgmsg_to_cv2(self, cmprs_img_msg, desired_encoding="passthrough"):
        """The image of a CompressedImage message; see `compressed_to_array`."""
        return compressed_to_array(cmprs_img_msg, desired_encoding)

    def cv2_to_compressed_imgmsg(self, cvim, dst_format="jpg", header=None):
        """A CompressedImage message of an array: gray, bgr or bgra, of a dtype that the file format holds.

        dst_format is a file extension that OpenCV writes: jpg, jpeg, jpe, png, bmp, dib, sr, ras, tif, tiff,
        pbm, pgm, ppm, pnm, pam, pfm, hdr, pic, gif, webp or jp2; in upper or lower case, with or without a
        leading dot. The message's `format` is dst_format, unchanged.
        """
        if not isinstance(dst_format, str):
            raise ConversionError(f"dst_format must be a str such as 'jpg', got {quoted(dst_format)}")
        described(cvim, "passthrough")
        data = encode_image_file(cvim, dst_format.removeprefix(".").lower())
        return new_message("CompressedImage", header, data, format=dst_format)

    def encoding_to_cvtype2(self, encoding):
        """OpenCV's type of the array of an encoding: cv2.CV_8UC3 for "bgr8"."""
        return getCvType(encoding)

    def encoding_to_dtype_with_channels(self, encoding):
        """("uint8", 3) for "bgr8"."""
        info = encoding_info(encoding)
        return info.dtype.name, info.channels

    def dtype_with_channels_to_cvtype2(self, dtype, n_channels):
        """ "8UC3" for (np.dtype("uint8"), 3)."""
        return generic_name(dtype, n_channels)

    def cvtype2_to_dtype_with_channels(self, cvtype):
        """("uint8", 3) for cv2.CV_8UC3."""
        depth = cvtype & ((1 << _CHANNEL_SHIFT) - 1)
        if depth not in self.cvdepth_to_numpy_depth:
            raise ConversionError(f"no message holds OpenCV's type {quoted(cvtype)}")
        return self.cvdepth_to_numpy_depth[depth], (cvtype >> _CHANNEL_SHIFT) + 1


def getCvType(encoding):
    """OpenCV's type of the array of an encoding: cv2.CV_8UC3 for "bgr8"."""
    info = encoding_info(encoding)
    depth = generic_name(info.dtype, 1).removesuffix("C1")
    return _DEPTHS[depth][1] + ((info.channels - 1) << _CHANNEL_SHIFT)


def cvtColorForDisplay(
    source,
    encoding_in,
    encoding_out,
    do_dynamic_scaling=False,
    min_image_value=0.0,
    max_image_value=0.0,
    colormap=-1,
):
    """An array of any encoding as an image that can be displayed.

    Parameters
    ----------
    source : (H, W) or (H, W, channels) ndarray, of the encoding `encoding_in`
    encoding_out : an encoding of 8 bits such as "bgr8" or "mono8"; "" means "bgr8"
    do_dynamic_scaling : stretch the finite values over 0..255 (one channel only); a constant image becomes
        128
    min_image_value, max_image_value : if they differ, the values that become 0 and 255 (one channel only)
    colormap : such as cv2.COLORMAP_JET, for scaled images; -1 for none. NaN becomes black

    Returns
    -------
    fresh ndarray of the encoding `encoding_out`. Without scaling, "32SC1" is taken as a label image: each
    label gets its own color, and -1 is black

    Notes
    -----
    These differences from cv_bridge are intended: a constant image has the channels of `encoding_out`; 8UC1,
    8UC3 and 8UC4 are displayed as mono8, bgr8 and bgra8; values below `min_image_value` do not wrap in signed
    types; all label colors are distinct (in cv_bridge, label 7 is black, like no label).
    """
    info, desired = described(source, encoding_in), encoding_info(encoding_out or "bgr8")
    if desired.dtype != np.uint8 or desired.color not in ("gray", "rgb", "bgr", "rgba", "bgra"):
        raise ConversionError(f"encoding_out must be 'bgr8', 'mono8' or the like, got {quoted(encoding_out)}")
    is_scaled = do_dynamic_scaling or min_image_value != max_image_value
    if info.name == "32SC1" and (desired.name == "bgr8" or not is_scaled):
        frame, frame_encoding = _label_colors(source), "bgr8"
    elif is_scaled:
        if info.channels != 1:
            raise ConversionError(
                f"scaling takes one channel, {info.name!r} has {info.channels}; pass one of them"
            )
        limits = None if do_dynamic_scaling else (min_image_value, max_image_value)
        frame, frame_encoding = _scaled(source.reshape(source.shape[:2]), limits, colormap)
    else:
        frame, frame_encoding = source.astype(info.dtype), _DISPLAYED_AS.get(info.name, info.name)
        if encoding_info(frame_encoding).color is None:
            raise ConversionError(
                f"{info.name!r} does not say which value is white; set do_dynamic_scaling=True, "
                "or min_image_value and max_image_value"
            )
    frame = frame.reshape(frame.shape[:2]) if frame.ndim == 3 and frame.shape[2] == 1 else frame
    convert = converter(encoding_info(frame_encoding), desired)
    return convert(frame) if convert else frame


_DISPLAYED_AS = dict.fromkeys(("8U", "8UC1"), "mono8") | dict.fromkeys(("16U", "16UC1"), "mono16")
_DISPLAYED_AS |= {"8UC3": "bgr8", "8UC4": "bgra8"}


def _label_colors(labels):
    """(H, W, 3) uint8, bgr: hues a golden angle apart, so that near labels look different; -1 is black."""
    labels = labels.reshape(labels.shape[:2]).astype(np.int64)
    table = np.zeros((256, 1, 3), np.uint8)
    table[:, 0, 0] = np.arange(256) * 0.381966 % 1 * 180  # OpenCV's hue: half degrees
    table[:, 0, 1] = 255 - np.arange(256) // 64 * 40
    table[:, 0, 2] = 255 - np.arange(256) % 4 * 30
    frame = cv2.cvtColor(table, cv2.COLOR_HSV2BGR)[labels % 256, 0]
    frame[labels == -1] = 0
    return frame


def _scaled(values, limits, colormap):
    """(frame, encoding): the values between the limits (None: the finite range) as 0..255, then colored."""
    values = values.astype(np.float64)
    if limits is None:
        finite = values[np.isfinite(values)]
        limits = (finite.min(), finite.max()) if finite.size else (0.0, 0.0)
    low, high = map(float, limits)
    if low == high:
        gray = np.full(values.shape, 128, np.uint8)
    else:
        stretched = np.clip((values - low) * (255 / (high - low)), 0, 255)
        gray = np.rint(np.nan_to_num(stretched, nan=0.0)).astype(np.uint8)
    if colormap == -1 or gray.size == 0:
        return gray, "mono8"
    colored = cv2.applyColorMap(gray, colormap)
    colored[np.isnan(values)] = 0
    return colored, "bgr8"
