"""The recorded drive, and a reader of rosbag2 recordings: frame by frame, without ROS.

The drive is rendered, not filmed. environment/drive/README.md says how, and what it is not suitable for.
"""

from .errors import FrameIndexError, NotRecordedError, RecordingError
from .recording import Recording, open_recording

__all__ = ["FrameIndexError", "NotRecordedError", "Recording", "RecordingError", "open_recording"]
