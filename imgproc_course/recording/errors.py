"""What goes wrong with a recording, each in one line that says what to do."""


class RecordingError(ValueError):
    """The recording cannot be opened or read."""


class FrameIndexError(RecordingError, IndexError):
    """There is no message with this number."""


class NotRecordedError(RecordingError, KeyError):
    """The recording holds no such topic."""

    __str__ = ValueError.__str__  # KeyError would show the line in quotes
