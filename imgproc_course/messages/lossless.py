# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""Raw images, compressed without loss, as ROS's zstd_image_transport and zlib_image_transport publish them.

The data begin with the height, width, is_bigendian, step and encoding of a sensor_msgs/Image. Then follow its
bytes as gzip (zstd_image_transport up to ROS Kilted, in spite of its name), zlib or Zstandard.
"""

import importlib
import struct
import sys
import zlib
from types import SimpleNamespace

from .conversion import image_to_array
from .encodings import encoding_info
from .errors import ConversionError
from .image_headers import DAMAGED, MAX_PIXELS

LOSSLESS = ("zstd", "zlib")  # the field `format`, and the last part of the topic's name
_FIELDS = struct.Struct("<IIBII")  # the last one is the length of the encoding, which follows
_ZSTANDARD = b"\x28\xb5\x2f\xfd"  # the first bytes of its streams


def decode_lossless(data, desired_encoding):
    """The array of a contiguous memoryview, converted as by `image_to_array`, fresh and writable."""
    if len(data) < _FIELDS.size:
        raise ConversionError(f"{len(data)} bytes cannot hold the fields of an image; {DAMAGED}")
    height, width, is_bigendian, step, length = _FIELDS.unpack_from(data)
    encoding = bytes(data[_FIELDS.size :][:length]).decode("ascii", "replace")
    size = step * encoding_info(encoding).rows(height)
    if size > 8 * MAX_PIXELS:
        raise ConversionError(f"{len(data)} bytes claim an image of {size}; {DAMAGED}")
    stream = data[_FIELDS.size :][length:]
    decompressor, error_class = _decompressor(stream)
    try:
        pixels = decompressor.decompress(stream, size + 1)  # one more, so that the checksum is read
    except error_class as error:
        raise ConversionError(f"the compressed image does not decode ({error}); {DAMAGED}") from None
    fields = {"height": height, "width": width, "step": step, "is_bigendian": is_bigendian}
    frame = image_to_array(SimpleNamespace(encoding=encoding, data=pixels, **fields), desired_encoding)
    return frame if frame.flags.writeable else frame.copy()


def _decompressor(stream):
    if bytes(stream[:4]) != _ZSTANDARD:
        return zlib.decompressobj(32 + zlib.MAX_WBITS), zlib.error  # gzip or zlib, by its first bytes
    module = "compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd"
    try:
        zstd = importlib.import_module(module)
    except ImportError:
        raise ConversionError(
            "no decoder of Zstandard is installed; pip install backports.zstd, or subscribe to the raw topic"
        ) from None
    return zstd.ZstdDecompressor(), zstd.ZstdError
