"""Temporary folders that do not outlive a killed run: the next run removes them."""

import fcntl
import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

_PREFIX = "imgproc-course-"
_LOCK = ".lock"


class TemporaryFolder:
    """A folder in the system's folder for temporary files; `path` is its Path.

    It holds a file that this process locks. The system unlocks it when the process ends, however it ends, so
    a folder whose file can be locked was left by a run that was killed: it is removed with the next folder
    that is made.
    """

    def __init__(self):
        _remove_abandoned()
        folder = Path(tempfile.mkdtemp(prefix=f".{_PREFIX}"))
        self._lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        # Under this name others may look for its lock.
        self.path = folder.rename(folder.with_name(folder.name.removeprefix(".")))

    def remove(self):
        """Remove it with all that it holds."""
        shutil.rmtree(self.path, ignore_errors=True)
        os.close(self._lock)


def _remove_abandoned():
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with suppress(OSError):  # another user's, or another process removes it now
            lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder)
            finally:
                os.close(lock)
