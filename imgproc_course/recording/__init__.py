"""The recorded drive, and what reads it: any rosbag2 recording, frame by frame, without ROS.

The drive itself is rendered, not filmed: environment/drive/README.md says how, and what it is not good for.
"""

from .errors import FrameIndexError, NotRecordedError, RecordingError
from .recording import Recording, open_recording

__all__ = ["FrameIndexError", "NotRecordedError", "Recording", "RecordingError", "open_recording"]
