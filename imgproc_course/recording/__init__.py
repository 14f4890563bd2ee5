"""The recorded drive, and a reader and a writer of rosbag2 recordings, without ROS.

The drive is rendered, not filmed. environment/drive/README.md says how, and what it is not suitable for.
"""

from typing import TYPE_CHECKING, Any

from ..extras import naming_extra
from .errors import FrameIndexError, NotRecordedError, RecordingError
from .recording import Recording, open_recording

if TYPE_CHECKING:
    from .writer import RecordingWriter

__all__ = [
    "FrameIndexError",
    "NotRecordedError",
    "Recording",
    "RecordingError",
    "RecordingWriter",
    "open_recording",
]


def __getattr__(name: str) -> Any:
    """Imports the writer when it is asked for: rosbags needs apsw, which some platforms lack."""
    if name != "RecordingWriter":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    with naming_extra():
        from .writer import RecordingWriter

    return RecordingWriter
