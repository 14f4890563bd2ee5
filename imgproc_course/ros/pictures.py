"""Where a camera's pictures come from: a recording, or a webcam; each picture with the time it is due."""

import functools
import time

import cv2
import numpy as np
from sensor_msgs.msg import CameraInfo

from imgproc_course.messages import array_to_compressed, array_to_image, encoding_info
from imgproc_course.recording import NotRecordedError

FRAME_ID = "camera_front"
_WEBCAM_CURE = "plug one in, close the program that uses it, or open_camera() for the recorded drive"


class RecordedPictures:
    """Yields (due, picture) for each picture of a recording: due in seconds of time.monotonic().

    Parameters
    ----------
    recording : Recording; it is closed with this
    speed : times the recording's own rate
    loop : whether it starts again at its end
    stamps : "now" or "recorded"

    Raises
    ------
    ValueError : its pictures are nothing to look at, such as depth
    """

    def __init__(self, recording, speed, loop, stamps):
        self._recording = recording
        self._loop = loop
        self._keep_stamps = stamps == "recorded"
        self._stamps = recording.stamps
        first = recording.message(0)
        self._frame_id = first.header.frame_id or FRAME_ID
        self._is_compressed = hasattr(first, "format")
        if not self._is_compressed and encoding_info(first.encoding).color is None:
            raise ValueError(
                f"{recording.name} cannot be played as a camera: the pictures on {recording.camera_topic} "
                f"are {first.encoding}, neither colour nor gray (depth?); record a colour camera's topic "
                "too, or read these with open_recording(...).frame(k, 'passthrough')"
            )
        try:
            self._info = recording.camera_info
        except NotRecordedError:
            self._info = _uncalibrated(*recording.frame(0).shape[:2])
        self.rate = (recording.rate or 1.0) * speed
        # Seconds from the start; a stamp that jumps back is shown at once.
        self._due = np.maximum.accumulate(self._stamps - self._stamps[0]) / 1e9 / speed
        self._lap = self._due[-1] + 1 / self.rate

    def __iter__(self):
        start = time.monotonic()
        while True:
            for k, due in enumerate(self._due):
                late = time.monotonic() - start - due
                if late > max(1.0, 2 / self.rate):
                    start += late  # the machine slept: go on from here instead of hurrying after
                # Counted from the start, never from the last picture, so that no delay adds up.
                yield start + due, _RecordedPicture(self, k)
            if not self._loop:
                return
            start += self._lap

    def image(self, k):
        return array_to_image(self._recording.frame(k, "rgb8"), "rgb8")

    def compressed(self, k, header):
        if not self._is_compressed:
            return array_to_compressed(self._recording.frame(k, "bgr8"), "bgr8", header=header)
        msg = self._recording.message(k)
        msg.header = header
        return msg

    def camera_info(self, header):
        return _with_header(self._info, header)

    def stamp(self, k):
        return int(self._stamps[k]) if self._keep_stamps else None

    @property
    def frame_id(self):
        return self._frame_id

    def close(self):
        self._recording.close()


class _RecordedPicture:
    """One picture; what is costly is done when it is asked for."""

    def __init__(self, pictures, k):
        self._pictures, self._k = pictures, k
        self.frame_id = pictures.frame_id
        self.stamp = pictures.stamp(k)
        self.camera_info = pictures.camera_info

    @functools.cached_property
    def image(self):
        return self._pictures.image(self._k)

    def compressed(self, header):
        return self._pictures.compressed(self._k, header)


class Webcam:
    """Yields (due, picture) for each picture of this machine's first camera, at its own rate.

    Raises
    ------
    RuntimeError : none answers
    """

    def __init__(self, number=0):
        log_level = cv2.utils.logging.getLogLevel()
        cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # the error below says it all
        self._capture = cv2.VideoCapture(number)
        cv2.utils.logging.setLogLevel(log_level)
        if not self._capture.isOpened():
            raise RuntimeError(f"no webcam answers on this machine (camera {number}); {_WEBCAM_CURE}")
        self.rate = self._capture.get(cv2.CAP_PROP_FPS) or None

    def __iter__(self):
        while True:
            answered, frame = self._capture.read()
            if not answered:
                raise RuntimeError(f"the webcam gives no more pictures; {_WEBCAM_CURE}")
            yield time.monotonic(), _WebcamPicture(frame)

    def close(self):
        self._capture.release()


class _WebcamPicture:
    frame_id = "webcam"
    stamp = None

    def __init__(self, frame):
        self._frame = frame

    @functools.cached_property
    def image(self):
        return array_to_image(cv2.cvtColor(self._frame, cv2.COLOR_BGR2RGB), "rgb8")

    def compressed(self, header):
        return array_to_compressed(self._frame, "bgr8", header=header)

    def camera_info(self, header):
        return _with_header(_uncalibrated(*self._frame.shape[:2]), header)


def _uncalibrated(height, width):
    """What sensor_msgs says of a camera that nobody measured: its matrix K is zero."""
    return CameraInfo(height=height, width=width)


def _with_header(info, header):
    return CameraInfo(
        header=header,
        height=info.height,
        width=info.width,
        distortion_model=info.distortion_model,
        d=list(info.d),
        k=info.k,
        r=info.r,
        p=info.p,
        binning_x=info.binning_x,
        binning_y=info.binning_y,
        roi=info.roi,
    )
