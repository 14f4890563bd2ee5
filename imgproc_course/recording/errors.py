"""The errors of a recording: one line each, which says what to do."""


class RecordingError(ValueError):
    """The recording cannot be opened or read."""


class FrameIndexError(RecordingError, IndexError):
    """There is no message with this number."""


class NotRecordedError(RecordingError, KeyError):
    """The recording holds no such topic."""

    __str__ = ValueError.__str__  # KeyError would put the line in quotes
