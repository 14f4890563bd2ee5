"""The sources of a camera's images: a recording or a webcam. Each image comes with the time to publish it."""

import copy
import functools
import time
from typing import Any

import cv2
import numpy as np
from sensor_msgs.msg import CameraInfo, Image

from imgproc_course.messages import array_to_compressed, array_to_image, encoding_info
from imgproc_course.recording import NotRecordedError
from imgproc_course.recording.recording import CLOCK_JUMP, first_readable

FRAME_ID = "camera_front"
_WEBCAM_REMEDY = "plug one in, close the program that uses it, or open_camera() for the recorded drive"


class RecordedImages:
    """Yields (due, image) for each image of a recording; `due` is in seconds of time.monotonic().

    `speed` is a factor on the recorded rate, `stamps` "now" or "recorded". Depth images are refused.
    """

    def __init__(self, recording, speed, loop, stamps):
        self.recording = recording
        self._loop = loop
        self.uses_recorded_stamps = stamps == "recorded"
        self.stamps = recording.stamps
        first = first_readable(recording.message, len(self.stamps))
        self.frame_id = first.header.frame_id or FRAME_ID
        self.is_compressed = hasattr(first, "format")
        if not self.is_compressed and encoding_info(first.encoding).color is None:
            raise ValueError(
                f"{recording.name} cannot be played as a camera: the images on {recording.camera_topic} "
                f"are {first.encoding}, neither colour nor gray (depth?); record a colour camera's topic "
                "too, or read these with open_recording(...).frame(k, 'passthrough')"
            )
        try:
            self.info = recording.camera_info
        except NotRecordedError:
            frame = first_readable(recording.frame, len(self.stamps))
            self.info = _uncalibrated(*frame.shape[:2])
        self.rate = (recording.rate or 1.0) * speed
        # Seconds from the start. If a stamp jumps back, or far ahead, its image is due at once.
        intervals = np.diff(self.stamps, prepend=self.stamps[0])
        stamps = np.cumsum(np.where(np.abs(intervals) < CLOCK_JUMP, intervals, 0))
        self._offsets = np.maximum.accumulate(stamps) / 1e9 / speed
        self._duration = self._offsets[-1] + 1 / self.rate

    def __iter__(self):
        start = time.monotonic()
        while True:
            for k, offset in enumerate(self._offsets):
                delay = time.monotonic() - start - offset
                if delay > max(1.0, 2 / self.rate):
                    start += delay  # the machine was asleep: continue from here, do not catch up
                # Counted from the start, not from the last image, so that delays do not add up.
                yield start + offset, _RecordedImage(self, k)
            if not self._loop:
                return
            start += self._duration

    def other_topics(self, base):
        """What is published beside the camera's topics: (message type, topic, function(image, header))."""
        has_depth = self.recording.depth_topic is not None
        return [(Image, f"{base}/depth", lambda image, header: image.depth(header))] if has_depth else []

    def close(self):
        self.recording.close()


class _RecordedImage:
    """One image; it is decoded only when its message is needed."""

    def __init__(self, images, k):
        self._images, self._recording, self._k = images, images.recording, k
        self.frame_id = images.frame_id
        self.stamp = int(images.stamps[k]) if images.uses_recorded_stamps else None

    def __str__(self):
        return f"frame {self._k}"

    @functools.cached_property
    def message(self):
        return array_to_image(self._recording.frame(self._k, "rgb8"), "rgb8")

    def compressed(self, header):
        if self._images.is_compressed:
            return _with_header(self._recording.message(self._k), header)
        return array_to_compressed(self._recording.frame(self._k, "bgr8"), "bgr8", header=header)

    def camera_info(self, header):
        return _with_header(self._images.info, header)

    def depth(self, header):
        return array_to_image(self._recording.depth(self._k), "16UC1", header)


class Webcam:
    """Yields (due, image) for each image of this machine's first camera, at the camera's own rate."""

    def __init__(self, number=0):
        log_level = cv2.utils.logging.getLogLevel()
        cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # the error below is enough
        self._capture = cv2.VideoCapture(number)
        cv2.utils.logging.setLogLevel(log_level)
        if not self._capture.isOpened():
            raise RuntimeError(f"no webcam answers on this machine (camera {number}); {_WEBCAM_REMEDY}")
        self.rate = self._capture.get(cv2.CAP_PROP_FPS) or None

    def __iter__(self):
        while True:
            succeeded, frame = self._capture.read()
            if not succeeded:
                raise RuntimeError(f"the webcam sends no more images; {_WEBCAM_REMEDY}")
            yield time.monotonic(), _WebcamImage(frame)

    def other_topics(self, base):
        return []

    def close(self):
        self._capture.release()


class FrameImage:
    """An image that is no message yet; a subclass has `_frame`, (H, W, 3) uint8 BGR."""

    _frame: Any

    @functools.cached_property
    def message(self):
        return array_to_image(cv2.cvtColor(self._frame, cv2.COLOR_BGR2RGB), "rgb8")

    def compressed(self, header):
        return array_to_compressed(self._frame, "bgr8", header=header)


class _WebcamImage(FrameImage):
    frame_id = "webcam"
    stamp = None

    def __init__(self, frame):
        self._frame = frame

    def camera_info(self, header):
        return _with_header(_uncalibrated(*self._frame.shape[:2]), header)


def _uncalibrated(height, width):
    """The camera info of an uncalibrated camera, as sensor_msgs defines it: its matrix K is zero."""
    return CameraInfo(height=height, width=width)


def _with_header(msg, header):
    msg = copy.copy(msg)
    msg.header = header
    return msg
