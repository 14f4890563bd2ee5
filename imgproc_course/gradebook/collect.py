"""Take in what learners handed in: folders, files, and the zips of learning platforms.

    submissions/ada.ipynb                                     a file a learner
    submissions/ada/03_grayscale.ipynb                        a folder a learner, with whatever is in it
    submissions/03_grayscale/ada.ipynb                        a folder a lesson
    submissions/Ada Lovelace_12345_assignsubmission_file_/*   Moodle ("Download all submissions")
    submissions/lovelaceada_LATE_123_456_03_grayscale-1.ipynb Canvas ("Download Submissions")
    submissions/anything.zip                                  a platform's zip, or a learner's own

or one such zip alone. Files are only ever read, as bytes, and only ordinary ones: no link is followed, a file
with two names is refused, nothing is unpacked to disk, and no name from outside becomes a path.
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

from imgproc_course.gradebook.sanitize import visible_line

LARGEST = 50_000_000  # bytes of one notebook; a lesson full of pictures has a tenth of it
LARGEST_ZIP = 4_000_000_000
LARGEST_WITHIN = 8_000_000_000  # bytes of all that a zip holds
MOST_FILES = 20_000
DEEPEST = 12
MOST_RATIO = 200
_MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+_?(?P<rest>.*)", re.S)
_CANVAS = re.compile(
    r"(?P<name>[^_]+)_(?:(?P<late>LATE)_)?(?P<id>\d+)_(?P<order>\d+)_(?P<rest>.+)", re.S | re.I
)
_AGAIN = re.compile(r"(?P<stem>.+?)(?:-(?P<again>\d{1,6})|[ _]?\((?P<copy>\d{1,6})\))", re.S)
_LESSON = re.compile(r"\d\d_[a-z0-9_]+")
_NOBODY = ""  # stands for a folder that holds everything, and says nothing of whose it is
_PASSED_OVER = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}


class IntakeError(ValueError):
    """Nothing can be taken in from there; one line with the remedy."""


@dataclass(frozen=True)
class HandIn:
    """One file that was handed in, not read yet.

    learner   the name that the platform, the folder or the file gives
    id        the platform's number of the learner, or "";  platform: "moodle", "canvas" or ""
    source    where it was found, to be shown
    group     what tells namesakes apart: the zip or folder that it came in
    when      datetime, local, of the file; None where there is none
    late      the platform says that it is late
    order     tuple by which a later hand-in of the same lesson is told from an earlier one
    refused   why it is not read, or ""
    """

    learner: str
    id: str
    platform: str
    source: str
    group: str
    when: datetime | None
    late: bool
    order: tuple
    refused: str = ""
    place: tuple = ()

    def read(self):
        """Its bytes.

        Raises
        ------
        IntakeError : it cannot be read, or is too large
        """
        if self.refused:
            raise IntakeError(self.refused)
        first, *rest = self.place
        return first.read(*rest) if isinstance(first, _Archives) else _read_file(first, *rest)


@dataclass
class Intake:
    """What was found: `handins`, sorted by where they stood, and `ignored`, files that are no notebooks.

    A context manager: a zip stays open as long as it is read.
    """

    handins: list = field(default_factory=list)
    ignored: list = field(default_factory=list)
    archives: object = field(default_factory=lambda: _Archives())

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.archives.close()


def take_in(path, lessons=()):
    """Find everything that was handed in.

    Parameters
    ----------
    path : Path of a folder, a zip or a notebook
    lessons : names of lessons, to tell them from names of learners

    Returns
    -------
    Intake

    Raises
    ------
    IntakeError : there is no such thing, or nothing in it
    """
    path = Path(path)
    if not path.exists():
        raise IntakeError(f"{path}: there is nothing; give the folder or the zip that was handed in")
    intake, finder = Intake(), _Finder(tuple(lessons))
    if path.is_dir():
        _walk(path.resolve(), finder, intake)
    else:
        finder.file(path.resolve(), (path.name,), intake)
    if not intake.handins:
        raise IntakeError(f"{path}: no notebooks (*.ipynb) and no zip in it; is it the folder handed in?")
    intake.handins.sort(key=lambda each: each.source)
    intake.ignored.sort()
    return intake


def _walk(root, finder, intake):
    waiting, count = [(root, ())], 0
    while waiting:
        folder, parts = waiting.pop()
        try:
            entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError as error:
            intake.ignored.append(f"{_shown(parts)}/ (cannot be read: {error.strerror})")
            continue
        for entry in entries:
            count += 1
            if count > MOST_FILES:
                raise IntakeError(f"{root}: more than {MOST_FILES} files; grade it in parts")
            here = (*parts, entry.name)
            if entry.name in _PASSED_OVER or (entry.name.startswith(".") and not parts):
                continue
            if entry.is_dir(follow_symlinks=False):
                if len(here) > DEEPEST:
                    intake.ignored.append(f"{_shown(here)}/ (more than {DEEPEST} folders deep)")
                else:
                    waiting.append((Path(entry.path), here))
            else:
                finder.file(Path(entry.path), here, intake)


class _Finder:
    """Makes hand-ins of files, and of what zips hold."""

    def __init__(self, lessons):
        self._lessons = lessons

    def file(self, path, parts, intake):
        suffix = PurePosixPath(parts[-1].lower()).suffix
        if suffix not in (".ipynb", ".zip"):
            intake.ignored.append(_shown(parts))
            return
        try:
            status = path.lstat()
        except OSError as error:
            intake.handins.append(self._handin(parts, None, refused=f"it cannot be read ({error.strerror})"))
            return
        when = datetime.fromtimestamp(int(status.st_mtime))
        refused = _why_not(status, LARGEST if suffix == ".ipynb" else LARGEST_ZIP)
        if refused or suffix == ".ipynb":
            key = (str(path), status.st_dev, status.st_ino)
            intake.handins.append(self._handin(parts, when, refused=refused, place=key))
            return
        try:
            self._zip(path, parts, when, intake)
        except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError) as error:
            reason = f"the zip cannot be read ({visible_line(str(error), 100)})"
            intake.handins.append(self._handin(parts, when, refused=reason))

    def _zip(self, path, parts, when, intake):
        members = intake.archives.members(path)
        reason = _why_not_unzip(members)
        if reason:
            intake.handins.append(self._handin(parts, when, refused=reason))
            return
        inside = [PurePosixPath(member.filename.replace("\\", "/")).parts for member in members]
        named = [tuple(part for part in inner if part not in ("/", "..", ".")) for inner in inside]
        owner = self._owner(parts, named)
        for number, (member, inner, name) in enumerate(zip(members, inside, named, strict=True)):
            if _PASSED_OVER & set(name) or not name or name[-1].startswith("._"):
                continue
            suffix = PurePosixPath(name[-1].lower()).suffix
            if suffix not in (".ipynb", ".zip"):
                intake.ignored.append(_shown((*parts, *inner)))
                continue
            whose = owner(name)
            # A learner can write any date into a zip: only a platform's or a teacher's is to be believed.
            handin = self._handin(
                (*whose, *name),
                when if any(whose) else _when_of(member, when),
                refused=_why_not_member(member, inner, suffix),
                place=(intake.archives, str(path), number),
                source=(*parts, *inner),
                group=_shown(parts),
                number=number,
            )
            intake.handins.append(handin)

    def _owner(self, parts, named):
        """A function from a name in a zip to the folders that say whose it is, before that name."""
        stem = PurePosixPath(parts[-1]).stem
        if len(parts) > 1 or _platform_name(stem):
            return lambda name: (*parts[:-1], stem)
        notebooks = [name for name in named if name and name[-1].lower().endswith(".ipynb")]
        top = {name[0] if len(name) > 1 else None for name in notebooks}
        common = len(top) == 1 and None not in top and not _platform_name(next(iter(top)))
        depth = 2 if common else 1

        def owner(name):
            flat = len(name) <= depth and self._is_lesson(name[-1])
            return (stem,) if flat else (*(() if not common else (_NOBODY,)),)

        return owner

    def _is_lesson(self, name):
        stem, _ = _again(PurePosixPath(name).stem)
        return not _platform_name(name) and (stem in self._lessons or _LESSON.fullmatch(stem) is not None)

    def _handin(self, parts, when, *, refused="", place=(), source=None, group="", number=0):
        who = _who(parts, self._lessons)
        _, again = _again(PurePosixPath(parts[-1]).stem)
        moment = when.isoformat() if when else ""
        return HandIn(
            learner=visible_line(unicodedata.normalize("NFC", who["name"]), 120),
            id=who["id"],
            platform=who["platform"],
            source=_shown(source or parts),
            group=group or (visible_line(parts[0], 120) if who["platform"] == "" and len(parts) > 1 else ""),
            when=when,
            late=who["late"],
            order=(who["order"], moment, again, number, _shown(source or parts)),
            refused=refused,
            place=place,
        )


# ---------------------------------------------------------------- whose it is


def _platform_name(name):
    """(platform, match) of a name as Moodle or Canvas gives it, or None."""
    moodle = _MOODLE.fullmatch(name)
    if moodle:
        return "moodle", moodle
    canvas = _CANVAS.fullmatch(name)
    return ("canvas", canvas) if canvas else None


def _who(parts, lessons):
    """Whose file it is: what the first folder says, or the file itself where it stands in none.

    A folder of a lesson's name, and the one folder that holds everything, say nothing of it. Whatever stands
    deeper was named by the learner, who may not hand in as somebody else.
    """
    folders = list(parts[:-1])
    if folders[:1] == [_NOBODY]:
        folders = folders[2:]
    folders = [part for part in folders if part not in lessons and not _LESSON.fullmatch(part)]
    first = folders[0] if folders else parts[-1]
    found = _platform_name(first)
    if found:
        platform, match = found
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
    """A file's name without the lesson's: student-1 and -2 are two, ada_03_grayscale-1 is ada again."""
    before, _ = _again(stem)
    stem = before if before.endswith(tuple(lessons)) else stem
    for lesson in lessons:
        if lesson in stem and stem != lesson:
            rest = stem.replace(lesson, "", 1).strip(" -_.")
            return rest or stem
    return stem


def _again(stem):
    """A stem without the mark of a repeated hand-in ("-1", " (2)"), and its number."""
    match = _AGAIN.fullmatch(stem)
    return (match["stem"], int(match["again"] or match["copy"])) if match else (stem, 0)


def _shown(parts):
    return visible_line("/".join(parts), 300)


# ---------------------------------------------------------------- what is read, and what not


def _why_not(status, largest):
    if stat.S_ISLNK(status.st_mode):
        return "it is a link; links are not followed: hand in the notebook itself"
    if not stat.S_ISREG(status.st_mode):
        return "it is no ordinary file"
    if status.st_nlink > 1:
        return "it is a hard link: the same file has another name; hand in a copy"
    if status.st_size > largest:
        return _too_large(status.st_size, largest)
    return ""


def _too_large(size, largest):
    return (
        f"it has {size // 1_000_000} MB, at most {largest // 1_000_000} are read: clear its outputs"
        " (Kernel > Restart Kernel and Clear Outputs), save it and hand it in again"
    )


def _why_not_unzip(members):
    if len(members) > MOST_FILES:
        return f"the zip holds {len(members)} files; at most {MOST_FILES} are read"
    size = sum(member.file_size for member in members)
    if size > LARGEST_WITHIN:
        return f"the zip holds {size // 1_000_000} MB; at most {LARGEST_WITHIN // 1_000_000} are read"
    return ""


def _why_not_member(member, inner, suffix):
    if suffix == ".zip":
        return "it is a zip in a zip; hand in the notebook itself"
    if member.filename.startswith(("/", "\\")) or ".." in inner or re.match(r"[A-Za-z]:", member.filename):
        return "its name in the zip leads out of the zip"
    kind = member.external_attr >> 16
    if stat.S_IFMT(kind) not in (0, stat.S_IFREG):
        return "it is a link or a device in a zip; hand in the notebook itself"
    if member.flag_bits & 1:
        return "it is locked with a password"
    if member.file_size > LARGEST:
        return _too_large(member.file_size, LARGEST)
    if member.file_size > MOST_RATIO * max(member.compress_size, 1) and member.file_size > 1_000_000:
        return f"it unpacks to more than {MOST_RATIO} times its size"
    return ""


def _when_of(member, otherwise):
    try:
        when = datetime(*member.date_time)
    except ValueError:
        return otherwise
    return when if when.year > 1980 else otherwise


def _read_file(path, device, inode):
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise IntakeError(f"it cannot be read ({error.strerror})") from error
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        refused = _why_not(status, LARGEST)
        if not refused and (status.st_dev, status.st_ino) != (device, inode):
            refused = "it was changed while it was looked at"
        if refused:
            raise IntakeError(refused)
        try:
            return _bounded(file)
        except OSError as error:
            raise IntakeError(f"it cannot be read ({error.strerror})") from error


class _Archives:
    """The zip that was opened last: its members are read one after another."""

    def __init__(self):
        self._path, self._archive = None, None

    def members(self, path):
        """What it holds, folders left out."""
        if self._path != str(path):
            self.close()
            self._archive, self._path = zipfile.ZipFile(path), str(path)
        return [member for member in self._archive.infolist() if not member.is_dir()]

    def read(self, path, number):
        try:
            with self._archive_open(path, number) as file:
                return _bounded(file)
        except (zipfile.BadZipFile, zlib.error, OSError, ValueError, EOFError, RuntimeError) as error:
            if isinstance(error, IntakeError):
                raise
            raise IntakeError(f"it cannot be unpacked ({visible_line(str(error), 100)})") from error

    def _archive_open(self, path, number):
        member = self.members(path)[number]
        return self._archive.open(member)

    def close(self):
        if self._archive is not None:
            self._archive.close()
        self._path, self._archive = None, None


def _bounded(file):
    data = file.read(LARGEST + 1)
    if len(data) > LARGEST:
        raise IntakeError(_too_large(len(data), LARGEST))
    return data


def digest_of(data):
    """SHA-256 of a file's bytes, as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()
