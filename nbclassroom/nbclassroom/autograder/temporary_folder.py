"""Temporary folders that do not outlive a killed run: the next run removes them, at its beginning or end."""

import fcntl
import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

_PREFIX = "nbclassroom-"
_LOCK = ".lock"


class TemporaryFolder:
    """A folder in the system's folder for temporary files; `path` is its Path.

    It holds a file that this process locks. The system unlocks it when the process ends, however it ends, so
    a folder whose file can be locked was left by a run that was killed.
    """

    def __init__(self):
        remove_abandoned_folders()
        folder = Path(tempfile.mkdtemp(prefix=f".{_PREFIX}"))
        self._lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        # Under this name others may look for its lock.
        self.path = folder.rename(folder.with_name(folder.name.removeprefix(".")))

    def remove(self):
        """Remove it with all that it holds."""
        shutil.rmtree(self.path, ignore_errors=True)
        os.close(self._lock)


def remove_abandoned_folders():
    """Remove the folders of runs that were killed, and have ended."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with suppress(OSError):  # another user's, or another process removes it now
            lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder)
            finally:
                os.close(lock)
