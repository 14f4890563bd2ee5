# SPDX-FileCopyrightText: the imgproc-course contributors
# SPDX-License-Identifier: Apache-2.0
# You can copy this file with its folder, under any name.
"""sensor_msgs/Image to NumPy and back, with the same bytes as cv_bridge. For example::

    from imgproc_course.messages import image_to_array, array_to_image

    frame = image_to_array(msg, "bgr8")          # (H, W, 3) uint8
    reply = array_to_image(frame, "bgr8", header=msg.header)

The package needs only NumPy and OpenCV, and it works under any name: you can copy the folder into your own
package. It reads any object that has the message's fields. It makes messages of sensor_msgs if ROS is
installed, otherwise of rosbags. A ConversionError says what is wrong with a message or an array.
"""

from .compressed import array_to_compressed, compressed_to_array
from .conversion import array_to_image, image_to_array
from .encodings import EncodingInfo, encoding_info
from .errors import ConversionError

__all__ = [
    "ConversionError",
    "EncodingInfo",
    "array_to_compressed",
    "array_to_image",
    "compressed_to_array",
    "encoding_info",
    "image_to_array",
]
