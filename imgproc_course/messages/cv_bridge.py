"""cv_bridge's own names on top of this room, to replace it in a node by one line:

    from imgproc_course.messages.cv_bridge import CvBridge, CvBridgeError

What cv_bridge gets right comes back the same, and writable as there; where it gives a wrong picture or an
error of some other class, here comes the right picture or a CvBridgeError. On purpose different: the field
`format` of a compressed message is the one that ROS's own transport writes.
"""

import functools

import cv2
import numpy as np

from .compressed import compressed_to_array
from .conversion import array_to_image, described, image_to_array
from .encodings import encoding_info, generic_name
from .errors import ConversionError, quoted
from .image_files import encode_image_file
from .message_classes import new_compressed_image
from .pixels import converter

__all__ = ["CvBridge", "CvBridgeError", "cvtColorForDisplay", "getCvType"]

_DEPTHS = {
    "8U": ("uint8", cv2.CV_8U),
    "8S": ("int8", cv2.CV_8S),
    "16U": ("uint16", cv2.CV_16U),
    "16S": ("int16", cv2.CV_16S),
    "32S": ("int32", cv2.CV_32S),
    "32F": ("float32", cv2.CV_32F),
    "64F": ("float64", cv2.CV_64F),
}
_CHANNEL_SHIFT = (cv2.CV_8UC2 - cv2.CV_8UC1).bit_length() - 1  # 3 in OpenCV 4, 5 in OpenCV 5


class CvBridgeError(ConversionError, TypeError):
    """As cv_bridge's: a TypeError; and a ConversionError like every other of this room."""


def _raises_cv_bridge_error(function):
    @functools.wraps(function)
    def wrapped(*args, **kwargs):
        try:
            return function(*args, **kwargs)
        except ConversionError as error:
            raise CvBridgeError(str(error)) from error

    return wrapped


class CvBridge:
    """Converts between messages and arrays; the methods and their parameters are cv_bridge's.

    Attributes
    ----------
    cvtype_to_name : {cv2.CV_8UC3: "8UC3", ...}, 1 to 4 channels
    cvdepth_to_numpy_depth : {cv2.CV_8U: "uint8", ...}
    numpy_type_to_cvtype : {"uint8": "8U", ..., "8U": "uint8", ...}
    """

    def __init__(self):
        self.cvtype_to_name = {
            getattr(cv2, f"CV_{depth}C{n}"): f"{depth}C{n}" for depth in _DEPTHS for n in (1, 2, 3, 4)
        }
        self.cvdepth_to_numpy_depth = {code: dtype for dtype, code in _DEPTHS.values()}
        self.numpy_type_to_cvtype = {dtype: depth for depth, (dtype, _) in _DEPTHS.items()}
        self.numpy_type_to_cvtype.update({depth: dtype for depth, (dtype, _) in _DEPTHS.items()})

    @_raises_cv_bridge_error
    def imgmsg_to_cv2(self, img_msg, desired_encoding="passthrough"):
        """The picture of an Image, always writable; see `image_to_array`.

        "passthrough" gives a view of `img_msg.data` where that may be written to and its rows have no
        padding; everything else is a fresh array.
        """
        frame = image_to_array(img_msg, desired_encoding)
        if frame.flags.writeable:
            return frame
        if desired_encoding == "passthrough" and frame.flags.c_contiguous and _is_writable(img_msg.data):
            return np.frombuffer(img_msg.data, frame.dtype, frame.size).reshape(frame.shape)
        return frame.copy()

    @_raises_cv_bridge_error
    def cv2_to_imgmsg(self, cvim, encoding="passthrough", header=None):
        """An Image that holds a copy of the array; see `array_to_image`."""
        return array_to_image(cvim, encoding, header)

    @_raises_cv_bridge_error
    def compressed_imgmsg_to_cv2(self, cmprs_img_msg, desired_encoding="passthrough"):
        """The picture of a CompressedImage; see `compressed_to_array`."""
        return compressed_to_array(cmprs_img_msg, desired_encoding)

    @_raises_cv_bridge_error
    def cv2_to_compressed_imgmsg(self, cvim, dst_format="jpg", header=None):
        """A CompressedImage of an array: gray, bgr or bgra, with the dtypes that the file format holds.

        dst_format is an extension that OpenCV writes: jpg, jpeg, jpe, png, bmp, dib, sr, ras, tif, tiff, pbm,
        pgm, ppm, pnm, pfm, webp or jp2; in any case, with or without a dot in front. It becomes the message's
        `format` as it is.
        """
        if not isinstance(dst_format, str):
            raise ConversionError(
                f"dst_format must be a str such as 'jpg' or 'png', got {quoted(dst_format)}"
            )
        described(cvim, "passthrough")
        data = encode_image_file(cvim, dst_format.removeprefix(".").lower())
        return new_compressed_image(header, dst_format, data)

    @_raises_cv_bridge_error
    def encoding_to_cvtype2(self, encoding):
        """OpenCV's number of an encoding's array: "bgr8" gives cv2.CV_8UC3."""
        return getCvType(encoding)

    @_raises_cv_bridge_error
    def encoding_to_dtype_with_channels(self, encoding):
        """("uint8", 3) of "bgr8"."""
        info = encoding_info(encoding)
        return info.dtype.name, info.channels

    @_raises_cv_bridge_error
    def dtype_with_channels_to_cvtype2(self, dtype, n_channels):
        """ "8UC3" of (np.dtype("uint8"), 3)."""
        return generic_name(dtype, n_channels)

    @_raises_cv_bridge_error
    def cvtype2_to_dtype_with_channels(self, cvtype):
        """("uint8", 3) of cv2.CV_8UC3."""
        depth = cvtype & ((1 << _CHANNEL_SHIFT) - 1)
        if depth not in self.cvdepth_to_numpy_depth:
            raise ConversionError(f"no message holds OpenCV's type {quoted(cvtype)}")
        return self.cvdepth_to_numpy_depth[depth], (cvtype >> _CHANNEL_SHIFT) + 1


@_raises_cv_bridge_error
def getCvType(encoding):
    """OpenCV's number of an encoding's array: "bgr8" gives cv2.CV_8UC3."""
    info = encoding_info(encoding)
    depth = generic_name(info.dtype, 1).removesuffix("C1")
    return _DEPTHS[depth][1] + ((info.channels - 1) << _CHANNEL_SHIFT)


@_raises_cv_bridge_error
def cvtColorForDisplay(
    source,
    encoding_in,
    encoding_out,
    do_dynamic_scaling=False,
    min_image_value=0.0,
    max_image_value=0.0,
    colormap=-1,
):
    """A picture to look at, made of an array of any encoding.

    Parameters
    ----------
    source : (H, W) or (H, W, channels) ndarray, which `encoding_in` describes
    encoding_out : an encoding of 8 bits such as "bgr8" or "mono8"; "" means "bgr8"
    do_dynamic_scaling : stretch the finite values over 0..255 (one channel only); a constant picture becomes
        128
    min_image_value, max_image_value : where they differ, the values that become 0 and 255 (one channel only)
    colormap : such as cv2.COLORMAP_JET, for scaled pictures; -1 for none. NaN becomes black

    Returns
    -------
    ndarray as `encoding_out` says, fresh. "32SC1" is taken as labels where nothing is to be scaled: each gets
    a color of its own, and -1 black

    Notes
    -----
    Different from cv_bridge on purpose: a constant picture has the channels of `encoding_out`; 8UC1, 8UC3 and
    8UC4 are shown as mono8, bgr8 and bgra8; values below `min_image_value` do not wrap in signed types; label
    colors are all distinct (in cv_bridge, label 7 is as black as no label).
    """
    info, target = described(source, encoding_in), encoding_info(encoding_out or "bgr8")
    if target.dtype != np.uint8 or target.color not in ("gray", "rgb", "bgr", "rgba", "bgra"):
        raise ConversionError(f"encoding_out must be 'bgr8', 'mono8' or the like, got {quoted(encoding_out)}")
    is_scaled = do_dynamic_scaling or min_image_value != max_image_value
    if info.name == "32SC1" and (target.name == "bgr8" or not is_scaled):
        frame, shown_as = _label_colors(source), "bgr8"
    elif is_scaled:
        if info.channels != 1:
            raise ConversionError(
                f"scaling takes one channel, {info.name!r} has {info.channels}; give one of them"
            )
        limits = None if do_dynamic_scaling else (min_image_value, max_image_value)
        frame, shown_as = _scaled(source.reshape(source.shape[:2]), limits, colormap)
    else:
        frame, shown_as = source.astype(info.dtype), _LOOKS_LIKE.get(info.name, info.name)
        if encoding_info(shown_as).color is None:
            raise ConversionError(
                f"{info.name!r} does not say which value is white; set do_dynamic_scaling=True, "
                "or min_image_value and max_image_value"
            )
    frame = frame.reshape(frame.shape[:2]) if frame.ndim == 3 and frame.shape[2] == 1 else frame
    convert = converter(encoding_info(shown_as), target)
    return convert(frame) if convert else frame


_LOOKS_LIKE = {
    "8U": "mono8",
    "8UC1": "mono8",
    "8UC3": "bgr8",
    "8UC4": "bgra8",
    "16U": "mono16",
    "16UC1": "mono16",
}


def _label_colors(labels):
    """(H, W, 3) uint8, bgr: hues a golden angle apart, so that near labels look unlike; -1 is black."""
    labels = labels.reshape(labels.shape[:2]).astype(np.int64)
    table = np.zeros((256, 1, 3), np.uint8)
    table[:, 0, 0] = np.arange(256) * 0.381966 % 1 * 180  # OpenCV's hue: half degrees
    table[:, 0, 1] = 255 - np.arange(256) // 64 * 40
    table[:, 0, 2] = 255 - np.arange(256) % 4 * 30
    frame = cv2.cvtColor(table, cv2.COLOR_HSV2BGR)[labels % 256, 0]
    frame[labels == -1] = 0
    return frame


def _scaled(values, limits, colormap):
    """(frame, encoding): the values between the limits (found where None) over 0..255, then colored."""
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


def _is_writable(data):
    return not isinstance(data, list | tuple) and not memoryview(data).readonly
