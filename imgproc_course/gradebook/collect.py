"""Collect submissions from folders, single files, and the zips of learning platforms.

    submissions/ada.ipynb                                     one file per learner
    submissions/ada/04_grayscale.ipynb                        one folder per learner, with any content
    submissions/04_grayscale/ada.ipynb                        one folder per lesson
    submissions/Ada Lovelace_12345_assignsubmission_file_/*   Moodle ("Download all submissions")
    submissions/lovelaceada_LATE_123_456_04_grayscale-1.ipynb Canvas ("Download Submissions")
    submissions/anything.zip                                  a platform's zip, or a learner's own

A single such zip can also be given alone. Only regular files are read, as bytes. Links are not followed, a
file with a second name (a hard link) is refused, nothing is unpacked to disk, and a name from outside never
becomes a path.
"""

import hashlib
import os
import re
import stat
import unicodedata
import zipfile
import zlib
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path, PurePosixPath

from imgproc_course.authoring.lesson_names import is_lesson, lessons_named, without_lesson
from imgproc_course.autograder.sanitize import sanitize_line

LARGEST = 50_000_000  # bytes of one notebook; a lesson full of images has a tenth of it
LARGEST_ZIP = 4_000_000_000  # bytes of the zip file itself
LARGEST_WITHIN = 8_000_000_000  # bytes of all files in a zip, unpacked
MOST_FILES = 20_000
DEEPEST = 12  # folders
MOST_RATIO = 200  # unpacked size to packed size
_MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+_?(?P<file>.*)", re.S)
_CANVAS = re.compile(
    r"(?P<name>[^_]+)_(?:(?P<late>LATE)_)?(?P<id>\d+)_(?P<order>\d+)_(?P<file>.+)", re.S | re.I
)
_REPEATED = re.compile(r"(?P<stem>.+?)(?:-(?P<number>\d{1,6})|[ _]?\((?P<copy>\d{1,6})\))", re.S)
_NO_OWNER = ""  # in place of a learner's name: a folder that holds the files of every learner
_SKIPPED_FOLDERS = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}


class CollectError(ValueError):
    """There is nothing to collect; one line that says what to do."""


@dataclass(frozen=True)
class SubmittedFile:
    """One submitted file, not yet read.

    learner       the name that the platform, the folder or the file gives
    platform      "moodle", "canvas" or "";  platform_id: the platform's number of the learner, or ""
    source        where the file was found, for display
    group         the zip or folder that it came in; distinguishes learners who have the same name
    submitted_at  datetime, local, of the file; None if unknown
    late          True if the platform says that it is late
    order         tuple; sorts the submissions of one lesson from the earliest to the latest
    reason        why the file is not read, or ""
    location      what `read` needs to open it
    """

    learner: str
    platform: str
    platform_id: str
    source: str
    group: str
    submitted_at: datetime | None
    late: bool
    order: tuple
    reason: str = ""
    location: tuple = ()

    def read(self):
        """Read the file.

        Returns
        -------
        bytes

        Raises
        ------
        CollectError : it cannot be read, or it is too large
        """
        if self.reason:
            raise CollectError(self.reason)
        opener, *location = self.location
        return opener.read(*location) if isinstance(opener, _Archives) else _read_file(opener, *location)


@dataclass
class Collection:
    """What was collected: `files`, sorted by source, and `ignored`, the names of all other files.

    Use it as a context manager: a zip stays open until the end of the block.
    """

    files: list = field(default_factory=list)
    ignored: list = field(default_factory=list)
    archives: object = field(default_factory=lambda: _Archives())

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.archives.close()


def collect(path, lessons=()):
    """Find every submitted file.

    Parameters
    ----------
    path : Path of a folder, a zip or a notebook
    lessons : names of lessons, to distinguish them from names of learners

    Returns
    -------
    Collection

    Raises
    ------
    CollectError : the path does not exist, or there is no submission in it
    """
    path = Path(path)
    if not path.exists():
        raise CollectError(f"{path}: does not exist; give the folder or the zip with the submissions")
    collection, finder = Collection(), _Finder(tuple(lessons))
    if path.is_dir():
        _walk(path.resolve(), finder, collection)
    else:
        finder.add(path.resolve(), (path.name,), collection)
    if not collection.files:
        raise CollectError(f"{path}: no notebooks (*.ipynb) and no zip in it; give the folder of submissions")
    collection.files.sort(key=lambda file: file.source)
    collection.ignored.sort()
    return collection


def _walk(root, finder, collection):
    folders, count = [(root, ())], 0
    while folders:
        folder, parts = folders.pop()
        try:
            entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError as error:
            collection.ignored.append(f"{_display_path(parts)}/ (cannot be read: {error.strerror})")
            continue
        for entry in entries:
            count += 1
            if count > MOST_FILES:
                raise CollectError(f"{root}: more than {MOST_FILES} files; grade it in parts")
            entry_parts = (*parts, entry.name)
            if entry.name in _SKIPPED_FOLDERS or (entry.name.startswith(".") and not parts):
                continue
            if entry.is_dir(follow_symlinks=False):
                if len(entry_parts) > DEEPEST:
                    collection.ignored.append(
                        f"{_display_path(entry_parts)}/ (more than {DEEPEST} folders deep)"
                    )
                else:
                    folders.append((Path(entry.path), entry_parts))
            else:
                finder.add(Path(entry.path), entry_parts, collection)


class _Finder:
    """Turns files, and the members of zips, into SubmittedFiles."""

    def __init__(self, lessons):
        self._lessons = lessons

    def add(self, path, parts, collection):
        """Add a file to the collection; of a zip, add its members."""
        suffix = PurePosixPath(parts[-1].lower()).suffix
        if suffix not in (".ipynb", ".zip"):
            collection.ignored.append(_display_path(parts))
            return
        try:
            status = path.lstat()
        except OSError as error:
            reason = f"it cannot be read ({error.strerror})"
            collection.files.append(self._submitted_file(parts, None, reason=reason))
            return
        modified = datetime.fromtimestamp(int(status.st_mtime))
        reason = _file_problem(status, LARGEST if suffix == ".ipynb" else LARGEST_ZIP)
        if reason or suffix == ".ipynb":
            location = (str(path), status.st_dev, status.st_ino)
            collection.files.append(self._submitted_file(parts, modified, reason=reason, location=location))
            return
        try:
            self._add_members(path, parts, modified, collection)
        except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError) as error:
            reason = f"the zip cannot be read ({sanitize_line(str(error), 100)})"
            collection.files.append(self._submitted_file(parts, modified, reason=reason))

    def _add_members(self, path, parts, modified, collection):
        members = collection.archives.members(path)
        reason = _zip_problem(members)
        if reason:
            collection.files.append(self._submitted_file(parts, modified, reason=reason))
            return
        member_parts = [PurePosixPath(member.filename.replace("\\", "/")).parts for member in members]
        names = [tuple(part for part in inner if part not in ("/", "..", ".")) for inner in member_parts]
        owner_of = self._owner_function(parts, names)
        for number, (member, inner, name) in enumerate(zip(members, member_parts, names, strict=True)):
            if _SKIPPED_FOLDERS & set(name) or not name or name[-1].startswith("._"):
                continue
            suffix = PurePosixPath(name[-1].lower()).suffix
            if suffix not in (".ipynb", ".zip"):
                collection.ignored.append(_display_path((*parts, *inner)))
                continue
            owner = owner_of(name)
            # A learner can write any date into a zip. Only a platform's or an instructor's zip is trusted.
            file = self._submitted_file(
                (*owner, *name),
                modified if any(owner) else _member_time(member, modified),
                reason=_member_problem(member, inner, suffix),
                location=(collection.archives, str(path), number),
                source=(*parts, *inner),
                group=_display_path(parts),
                number=number,
            )
            collection.files.append(file)

    def _owner_function(self, parts, names):
        """A function from a member's name to the folders in front of it that name its owner."""
        stem = PurePosixPath(parts[-1]).stem
        if len(parts) > 1 or _platform_name(stem):
            return lambda name: (*parts[:-1], stem)
        notebooks = [name for name in names if name and name[-1].lower().endswith(".ipynb")]
        top_folders = {name[0] if len(name) > 1 else None for name in notebooks}
        one_folder = (
            len(top_folders) == 1 and None not in top_folders and not _platform_name(next(iter(top_folders)))
        )
        depth = 2 if one_folder else 1

        def owner_of(name):
            if len(name) <= depth and self._is_lesson(name[-1]):
                return (stem,)
            return (_NO_OWNER,) if one_folder else ()

        return owner_of

    def _is_lesson(self, name):
        stem, _ = _repetition(PurePosixPath(name).stem)
        return not _platform_name(name) and is_lesson(stem, self._lessons)

    def _submitted_file(
        self, parts, submitted_at, *, reason="", location=(), source=None, group="", number=0
    ):
        owner = _owner(parts, self._lessons)
        _, repetition = _repetition(PurePosixPath(parts[-1]).stem)
        moment = submitted_at.isoformat() if submitted_at else ""
        if not group and not owner["platform"] and len(parts) > 1:
            group = sanitize_line(parts[0], 120)
        return SubmittedFile(
            learner=sanitize_line(unicodedata.normalize("NFC", owner["name"]), 120),
            platform=owner["platform"],
            platform_id=owner["id"],
            source=_display_path(source or parts),
            group=group,
            submitted_at=submitted_at,
            late=owner["late"],
            order=(owner["order"], moment, repetition, number, _display_path(source or parts)),
            reason=reason,
            location=location,
        )


# ---------------------------------------------------------------- the owner of a file


def _platform_name(name):
    """(platform, match) of a name that Moodle or Canvas made, or None."""
    moodle = _MOODLE.fullmatch(name)
    if moodle:
        return "moodle", moodle
    canvas = _CANVAS.fullmatch(name)
    return ("canvas", canvas) if canvas else None


def _owner(parts, lessons):
    """The owner of a file: named by the first folder, or by the file itself if it is in no folder.

    A folder with a lesson's name, and the one folder that holds everything, name no owner. Deeper folders
    were named by the learner, who must not be able to submit as somebody else.
    """
    folders = list(parts[:-1])
    if folders[:1] == [_NO_OWNER]:
        folders = folders[2:]
    folders = [part for part in folders if not is_lesson(part, lessons)]
    platform_name = _platform_name(folders[0] if folders else parts[-1])
    if platform_name:
        platform, match = platform_name
        groups = match.groupdict()
        return {
            "name": match["name"].strip() or "(no name)",
            "id": match["id"][:20],
            "platform": platform,
            "late": bool(groups.get("late")),
            "order": int((groups.get("order") or "0")[:18]),
        }
    name = folders[0] if folders else _without_lesson(PurePosixPath(parts[-1]).stem, lessons)
    return {"name": name.strip() or "(no name)", "id": "", "platform": "", "late": False, "order": 0}


def _without_lesson(stem, lessons):
    """A file's stem without the lesson's name.

    student-1 and student-2 are two learners; ada_04_grayscale and ada_04_grayscale-1 are both ada's.
    """
    unnumbered, _ = _repetition(stem)
    named = lessons_named(unnumbered, lessons)
    stem = unnumbered if named and unnumbered.endswith(named[-1]) else stem
    return without_lesson(stem, lessons) or stem


def _repetition(stem):
    """A stem without the mark of a repeated submission ("-1", " (2)"), and the mark's number (0 if none)."""
    match = _REPEATED.fullmatch(stem)
    return (match["stem"], int(match["number"] or match["copy"])) if match else (stem, 0)


def _display_path(parts):
    return sanitize_line("/".join(parts), 300)


# ---------------------------------------------------------------- which files are not read


def _file_problem(status, largest):
    if stat.S_ISLNK(status.st_mode):
        return "it is a link; links are not followed: submit the notebook itself"
    if not stat.S_ISREG(status.st_mode):
        return "it is not a regular file"
    if status.st_nlink > 1:
        return "it is a hard link: the same file has another name; submit a copy"
    if status.st_size > largest:
        return too_large(status.st_size, largest)
    return ""


def too_large(size, largest):
    """Why a file of this size in bytes is not read, and what to do."""
    return (
        f"it has {size // 1_000_000} MB, at most {largest // 1_000_000} are read: clear its outputs"
        " (Kernel > Restart Kernel and Clear Outputs), save it and submit it again"
    )


def _zip_problem(members):
    if len(members) > MOST_FILES:
        return f"the zip holds {len(members)} files; at most {MOST_FILES} are read"
    size = sum(member.file_size for member in members)
    if size > LARGEST_WITHIN:
        return f"the zip holds {size // 1_000_000} MB; at most {LARGEST_WITHIN // 1_000_000} are read"
    return ""


def _member_problem(member, parts, suffix):
    if suffix == ".zip":
        return "it is a zip in a zip; submit the notebook itself"
    if member.filename.startswith(("/", "\\")) or ".." in parts or re.match(r"[A-Za-z]:", member.filename):
        return "its name leads out of the zip"
    if stat.S_IFMT(member.external_attr >> 16) not in (0, stat.S_IFREG):
        return "it is a link or a device in a zip; submit the notebook itself"
    if member.flag_bits & 1:
        return "it is locked with a password"
    if member.file_size > LARGEST:
        return too_large(member.file_size, LARGEST)
    if member.file_size > MOST_RATIO * max(member.compress_size, 1) and member.file_size > 1_000_000:
        return f"it unpacks to more than {MOST_RATIO} times its size"
    return ""


def _member_time(member, default):
    try:
        modified = datetime(*member.date_time)
    except ValueError:
        return default
    return modified if modified.year > 1980 else default


# ---------------------------------------------------------------- reading


def _read_file(path, device, inode):
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise CollectError(f"it cannot be read ({error.strerror})") from error
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        reason = _file_problem(status, LARGEST)
        if not reason and (status.st_dev, status.st_ino) != (device, inode):
            reason = "it was replaced by another file while it was collected"
        if reason:
            raise CollectError(reason)
        try:
            return _read_bounded(file)
        except OSError as error:
            raise CollectError(f"it cannot be read ({error.strerror})") from error


class _Archives:
    """Keeps the last zip open: its members are read one after another."""

    def __init__(self):
        self._path, self._archive = None, None

    def members(self, path):
        """The members of a zip, without its folders."""
        if self._path != str(path):
            self.close()
            self._archive, self._path = zipfile.ZipFile(path), str(path)
        return [member for member in self._archive.infolist() if not member.is_dir()]

    def read(self, path, number):
        """The bytes of one member."""
        try:
            with self._archive_open(path, number) as file:
                return _read_bounded(file)
        except (zipfile.BadZipFile, zlib.error, OSError, ValueError, EOFError, RuntimeError) as error:
            if isinstance(error, CollectError):
                raise
            raise CollectError(f"it cannot be unpacked ({sanitize_line(str(error), 100)})") from error

    def _archive_open(self, path, number):
        member = self.members(path)[number]
        return self._archive.open(member)

    def close(self):
        """Close the zip that is open, if any."""
        if self._archive is not None:
            self._archive.close()
        self._path, self._archive = None, None


def _read_bounded(file):
    data = file.read(LARGEST + 1)
    if len(data) > LARGEST:
        raise CollectError(too_large(len(data), LARGEST))
    return data


def digest_of(data):
    """SHA-256 of a file's bytes, as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()
