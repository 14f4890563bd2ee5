"""The recorded drive, and a reader and a writer of rosbag2 recordings, without ROS.

The drive is rendered, not filmed. environment/drive/README.md says how, and what it is not suitable for.
"""

from .errors import FrameIndexError, NotRecordedError, RecordingError
from .recording import Recording, open_recording
from .writer import RecordingWriter

__all__ = [
    "FrameIndexError",
    "NotRecordedError",
    "Recording",
    "RecordingError",
    "RecordingWriter",
    "open_recording",
]
