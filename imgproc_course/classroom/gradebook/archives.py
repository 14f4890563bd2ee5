"""Zips of platforms and learners: nothing is unpacked to disk, and nothing in a zip is believed.

A zip is opened as the regular file that was collected. Its table of contents, the packing of its members and
their sizes are bounded before anything is unpacked.
"""

import io
import os
import re
import stat
import zipfile
import zlib
from contextlib import ExitStack
from datetime import datetime
from pathlib import PurePosixPath

from ..autograder.sanitize import sanitize_line
from .senders import LONGEST_NAME

LARGEST = 50_000_000  # bytes of one notebook; a lesson full of images has a tenth of it
LARGEST_ZIP = 4_000_000_000  # bytes of the zip file itself
MOST_MEMBERS = 20_000
MOST_RATIO = 200  # unpacked size to packed size
_LARGEST_CONTENTS = 8_000_000  # bytes of a zip's table of contents; 20,000 files need 3 MB
_ERRORS = (zipfile.BadZipFile, zlib.error, OSError, ValueError, EOFError, RuntimeError)


class CollectError(ValueError):
    """There is nothing to collect, or nobody knows whose it is; what to do, and the command's exit code."""

    def __init__(self, text, exit_code=1):
        super().__init__(text)
        self.exit_code = exit_code


def file_problem(status, largest):
    """Why a file with this status is not read, or ""."""
    if stat.S_ISLNK(status.st_mode):
        return "it is a link; links are not followed: submit the notebook itself"
    if not stat.S_ISREG(status.st_mode):
        return "it is not a regular file"
    if status.st_size > largest:
        return too_large(status.st_size, largest)
    return ""


def too_large(size, largest):
    """Why a file of this size in bytes is not read, and what to do."""
    return (
        f"it has {size // 1_000_000} MB, at most {largest // 1_000_000} are read: clear its outputs"
        " (Kernel > Restart Kernel and Clear Outputs), save it and submit it again"
    )


def _open_collected(path, device, inode, largest):
    """Open a collected file for reading bytes; CollectError if another file has taken its place."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise CollectError(f"it cannot be read ({error.strerror})") from error
    file = os.fdopen(descriptor, "rb")
    status = os.fstat(descriptor)
    reason = file_problem(status, largest)
    if not reason and (status.st_dev, status.st_ino) != (device, inode):
        reason = "it was replaced by another file while it was collected"
    if reason:
        file.close()
        raise CollectError(reason)
    return file


def read_collected(path, device, inode):
    """The bytes of a collected notebook; CollectError if it cannot be read."""
    with _open_collected(path, device, inode, LARGEST) as file:
        try:
            return _read_bounded(file)
        except OSError as error:
            raise CollectError(f"it cannot be read ({error.strerror})") from error


def _read_bounded(file):
    """The bytes of a file; CollectError if they are more than the largest notebook may have."""
    data = file.read(LARGEST + 1)
    if len(data) > LARGEST:
        raise CollectError(too_large(len(data), LARGEST))
    return data


class _ContentsReader(io.BufferedReader):
    """A zip's file; as long as `limited`, no part of it is read that is larger than a table of contents."""

    limited = True

    def read(self, size=-1):
        if self.limited and size > _LARGEST_CONTENTS:
            raise zipfile.BadZipFile(f"its table of contents has {size // 1_000_000} MB")
        return super().read(size)


class Archives:
    """Keeps the last zip open: its members are read one after another."""

    def __init__(self):
        self._opened, self._location, self._archive, self._members = ExitStack(), None, None, []

    def members(self, *location):
        """The members of the zip at a path, device and inode, without its folders."""
        if self._location != location:
            self.close()
            opened = _open_collected(*location, LARGEST_ZIP)
            file = self._opened.enter_context(_ContentsReader(opened.detach()))
            try:
                self._archive = self._opened.enter_context(zipfile.ZipFile(file))
            except (*_ERRORS, NotImplementedError) as error:
                self.close()
                raise CollectError(f"the zip cannot be read ({sanitize_line(str(error), 100)})") from error
            # Not is_dir(): in Python 3.11 it fails for a member without a name.
            members = [member for member in self._archive.infolist() if not member.filename.endswith("/")]
            if len(members) > MOST_MEMBERS:
                text = f"the zip holds {len(members)} files; at most {MOST_MEMBERS} are read"
                raise CollectError(text)
            file.limited, self._location, self._members = False, location, members
        return self._members

    def read(self, location, number):
        """The bytes of one member."""
        try:
            member = self.members(*location)[number]
            with self._archive.open(member) as file:
                return _read_bounded(file)
        except _ERRORS as error:
            if isinstance(error, CollectError):
                raise
            raise CollectError(f"it cannot be unpacked ({sanitize_line(str(error), 100)})") from error

    def close(self):
        """Close the zip that is open, if any."""
        self._opened.close()
        self._location = None


def member_parts(member):
    """The parts of the name of a member, whatever system wrote it."""
    return PurePosixPath(member.filename.replace("\\", "/")).parts


def member_problem(member):
    """Why a member of a zip is not read, or ""."""
    name, parts = member.filename, member_parts(member)
    if parts and PurePosixPath(parts[-1].lower()).suffix == ".zip":
        return "it is a zip in a zip; submit the notebook itself"
    if name.startswith(("/", "\\")) or ".." in parts or re.match(r"[A-Za-z]:", name):
        return "its name leads out of the zip"
    if any(len(part) > LONGEST_NAME for part in parts):
        return f"its name has more than {LONGEST_NAME} characters"
    if stat.S_IFMT(member.external_attr >> 16) not in (0, stat.S_IFREG):
        return "it is a link or a device in a zip; submit the notebook itself"
    if member.flag_bits & 1:
        return "it is locked with a password"
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        return "it is packed with an unusual method; make the zip again with the method Deflate"
    if member.file_size > LARGEST:
        return too_large(member.file_size, LARGEST)
    if member.file_size > MOST_RATIO * max(member.compress_size, 1) and member.file_size > 1_000_000:
        return f"it unpacks to more than {MOST_RATIO} times its size"
    return ""


def member_time(member, default):
    """The date of a member as the zip says it, or `default` if it says none."""
    try:
        modified = datetime(*member.date_time)
    except ValueError:
        return default
    return modified if modified.year > 1980 else default
