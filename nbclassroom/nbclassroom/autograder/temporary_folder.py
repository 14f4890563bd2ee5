"""Temporary folders that do not outlive a killed run: the next run removes them, at its beginning or end."""

import os
import shutil
import tempfile
from pathlib import Path

import psutil

_PREFIX = "nbclassroom-"


def make_temporary_folder():
    """The Path of a new folder of this process."""
    remove_abandoned_folders()
    return Path(tempfile.mkdtemp(prefix=f"{_PREFIX}{os.getpid()}-"))


def remove_abandoned_folders():
    """Remove the folders of runs that were killed, and have ended."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*-*"):
        number = folder.name.removeprefix(_PREFIX).partition("-")[0]
        if number.isdecimal() and not psutil.pid_exists(int(number)):
            shutil.rmtree(folder, ignore_errors=True)  # another user's stays
