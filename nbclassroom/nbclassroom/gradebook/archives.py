"""Zips of platforms and learners: nothing is unpacked to disk, and nothing in a zip is believed.

The table of contents, the packing of members and their sizes are bounded before anything is unpacked.
"""

import io
import os
import re
import stat
import zipfile
import zlib
from contextlib import ExitStack, contextmanager, suppress
from datetime import datetime
from functools import partial

from ..autograder.sanitize import sanitize_line

LARGEST = 50_000_000  # bytes of one notebook, or of a zip in a zip; a lesson full of images has a tenth of it
LARGEST_ZIP = 4_000_000_000  # bytes of the zip file itself
MOST_MEMBERS = 20_000  # of a zip; if those in one folder have more, the next one there is not read
DEEPEST_ZIPS = 4  # zips in zips
MOST_RATIO = 200  # unpacked size to packed size
_LARGEST_CONTENTS = 8_000_000  # bytes of a zip's table of contents; 20,000 files need 3 MB
_ERRORS = (zipfile.BadZipFile, zlib.error, OSError, ValueError, EOFError, RuntimeError)


class CollectError(ValueError):
    """There is nothing to collect, or it is in doubt, and then with an `exit_code`; says what to do."""

    exit_code = 1


def too_large(size, largest):
    """Why a file of this size in bytes is not read, and what to do."""
    text = f"it has {size // 1_000_000} MB, at most {largest // 1_000_000} are read: clear its outputs"
    return f"{text} (Kernel > Restart Kernel and Clear Outputs), save it and submit it again"


def _open_collected(path, status, largest):
    """Open for reading bytes what had this status when it was collected; CollectError: it is no such file."""
    if stat.S_ISLNK(status.st_mode):
        raise CollectError("it is a link; links are not followed: submit the notebook itself")
    if not stat.S_ISREG(status.st_mode):
        raise CollectError("it is not a regular file")
    if status.st_size > largest:
        raise CollectError(too_large(status.st_size, largest))
    file = os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC), "rb")
    if not os.path.samestat(status, os.fstat(file.fileno())):
        file.close()
        raise CollectError("it was replaced by another file while it was collected")
    return file


@contextmanager
def _named_errors(subject):
    """Raises a CollectError that says of the subject why it cannot be read."""
    try:
        yield
    except CollectError:
        raise
    except _ERRORS as error:  # an OSError's own text has the teacher's path
        reason = sanitize_line(getattr(error, "strerror", None) or str(error), 100)
        raise CollectError(f"{subject} cannot be read ({reason})") from error


class _ContentsReader(io.BufferedReader):
    """A zip's file; as long as `limited`, no part of it is read that is larger than a table of contents."""

    limited = True

    def read(self, size=-1):
        if self.limited and size > _LARGEST_CONTENTS:
            raise zipfile.BadZipFile(f"its table of contents has {size // 1_000_000} MB")
        return super().read(size)


class Archives:
    """Keeps the zips open that the last member was in: members are read one after another.

    A location is ((path, its os.lstat),), and for what is in that zip the number of the member, and so on.
    """

    def __init__(self):
        self._opened = {}  # {location: (ExitStack, ZipFile, members)}

    def members(self, location):
        """The members of the zip at a location, without its folders; CollectError: it cannot be read."""
        self.close(location)
        if location not in self._opened:
            with _named_errors("the zip"):
                self._opened[location] = self._open(location)
        return self._opened[location][-1]

    def _open(self, location):
        if len(location) > DEEPEST_ZIPS:
            raise CollectError(f"zips in zips are read {DEEPEST_ZIPS} deep; submit the notebook itself")
        with ExitStack() as stack:
            inner = io.BytesIO(self.read(location)) if len(location) > 1 else None
            (path, status), *_ = location
            raw = inner or _open_collected(path, status, LARGEST_ZIP).detach()
            file = stack.enter_context(_ContentsReader(raw))
            archive = stack.enter_context(zipfile.ZipFile(file))
            file.limited = False
            # Not is_dir(): in Python 3.11 it fails for a member without a name.
            members = [member for member in archive.infolist() if not member.filename.endswith("/")]
            if len(members) > MOST_MEMBERS:
                raise CollectError(f"the zip holds {len(members)} files; at most {MOST_MEMBERS} are read")
            for member in members:
                member.filename = member.filename.replace("\\", "/")
                with suppress(UnicodeError):
                    if not member.flag_bits & 0x800:  # macOS writes UTF-8 and does not say so
                        member.filename = member.filename.encode("cp437").decode()
            return stack.pop_all(), archive, members

    def read(self, location):
        """The bytes of the file or the member at a location; CollectError: it cannot be read."""
        if len(location) == 1:
            ((path, status),) = location
            open_file = partial(_open_collected, path, status, LARGEST)
        else:
            member = self.members(location[:-1])[location[-1]]
            if problem := _member_problem(member):
                raise CollectError(problem)
            open_file = partial(self._opened[location[:-1]][1].open, member)
        with _named_errors("it"), open_file() as file:
            return file.read(LARGEST)  # of a member, zipfile reads no more than the size that was looked at

    def close(self, location=()):
        """Close the zips that are open, except those that the location is in."""
        for other in [other for other in self._opened if other != location[: len(other)]]:
            self._opened.pop(other)[0].close()


def _member_problem(member):
    """Why a member is not read, or ""."""
    name, size, packed = member.filename, member.file_size, max(member.compress_size, 1)
    leads_out = name.startswith("/") or ".." in name.split("/") or re.match(r"[A-Za-z]:", name)
    is_file = stat.S_IFMT(member.external_attr >> 16) in (0, stat.S_IFREG)
    is_usual = member.compress_type in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
    problems = (
        (leads_out, "its name leads out of the zip"),
        (not is_file, "it is a link or a device in a zip; submit the notebook itself"),
        (member.flag_bits & 1, "it is locked with a password"),
        (not is_usual, "it is packed with an unusual method; make the zip again with the method Deflate"),
        (size > LARGEST, too_large(size, LARGEST)),
        (size > max(MOST_RATIO * packed, 1_000_000), f"it unpacks to more than {MOST_RATIO} times its size"),
    )
    return next((text for holds, text in problems if holds), "")


def member_time(member, default):
    """The date of a member as the zip says it, or `default` if it says none."""
    with suppress(ValueError):
        if member.date_time >= (1981,):
            return datetime(*member.date_time)
    return default
