"""Collect submissions from folders, single files, and the zips of learning platforms.

    submissions/ada.ipynb                                     one file per learner
    submissions/ada/04_grayscale.ipynb                        one folder per learner, with any content
    submissions/01_ada/04_grayscale.ipynb                     the same, with the numbers of a class list
    submissions/04_grayscale/ada.ipynb                        one folder per lesson
    submissions/Ada Lovelace_12345_assignsubmission_file_/*   Moodle ("Download all submissions")
    submissions/lovelaceada_LATE_123_456_04_grayscale-1.ipynb Canvas ("Download Submissions")
    submissions/class.zip                                     a platform's zip, as it was downloaded
    submissions/ada.zip                                       a learner's own zip: all of it is ada's

A single zip can also be given alone. Only regular files are read, as bytes. Links are not followed, a
file with a second name (a hard link) is refused, nothing is unpacked to disk, and a name from outside never
becomes a path.

What arrives as one person's is theirs: names inside it are never believed. A zip is a platform's if it lies
at the top (or in the folder of a lesson) and every file in it has the form that Moodle or Canvas gives it; a
zip given alone is the instructor's. See `senders.Certainty` for names that somebody could choose. Each sender
has a budget of files and bytes.
"""

import hashlib
import os
import stat
import unicodedata
from collections import Counter, deque
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path, PurePosixPath

from imgproc_course.classroom.authoring.lesson_names import is_lesson
from imgproc_course.classroom.autograder.sanitize import sanitize_line
from imgproc_course.classroom.gradebook.archives import (
    LARGEST,
    LARGEST_ZIP,
    Archives,
    CollectError,
    file_problem,
    member_problem,
    member_time,
    open_collected,
    read_bounded,
)
from imgproc_course.classroom.gradebook.senders import (
    Certainty,
    Sender,
    is_lesson_file,
    numbered_learners,
    platform_sender,
    sender_of,
    split_repetition,
)

MOST_SENDERS = 20_000
MOST_NOTEBOOKS = 100  # of one sender; the course has 21 lessons
LARGEST_SUBMISSION = 200_000_000  # bytes of one sender's notebooks together
MOST_FOLDERS = 300  # of one sender
MOST_FILES = 20_000  # in the folders of one sender; as many in the zips
DEEPEST = 12  # folders
_MOST_LISTED = 20  # other files of one sender, by name; and findings about what was not looked at
_MOST_NAMES = 3  # different names in one zip: more look like a zip of several people
_SKIPPED_FOLDERS = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}
_ENVIRONMENTS = {".venv", "venv", "env", ".tox", "site-packages", "node_modules"}


@dataclass(frozen=True, kw_only=True)
class SubmittedFile(Sender):
    """One submitted file, not yet read, and who sent it.

    source        where the file was found, for display
    group         the zip or folder that it came in; distinguishes learners who have the same name
    submitted_at  datetime, local, of the file, or what a platform's zip says; None if unknown
    order         tuple; sorts the submissions of one lesson from the earliest to the latest
    archived_at   datetime of the platform's zip that says `submitted_at`; None for other files
    reason        why the file is not read, or ""
    location      what `read` needs to open it
    """

    source: str = ""
    group: str = ""
    submitted_at: datetime | None = None
    order: tuple = ()
    archived_at: datetime | None = None
    reason: str = ""
    location: tuple = ()

    def read(self):
        """The bytes of the file; CollectError if it cannot be read, or if it is too large."""
        if self.reason:
            raise CollectError(self.reason)
        opener, *location = self.location
        if isinstance(opener, Archives):
            return opener.read(*location)
        with open_collected(opener, *location, LARGEST) as file:
            try:
                return read_bounded(file)
            except OSError as error:
                raise CollectError(f"it cannot be read ({error.strerror})") from error


@dataclass(frozen=True, order=True)
class IntakeFinding:
    """Something unusual about what arrived.

    kind     "sender": whose it is can be doubted; "date": when it came can be doubted; "file": something
             was not read or not looked at
    learner  the sender
    file     where
    text     one line
    """

    kind: str
    learner: str
    file: str
    text: str


@dataclass
class Collection:
    """What was collected.

    files     list of SubmittedFile, sorted by source
    ignored   names of other files, sorted; of each sender at most some
    findings  list of IntakeFinding

    Use it as a context manager: a zip stays open until the end of the block.
    """

    files: list = field(default_factory=list)
    ignored: list = field(default_factory=list)
    findings: list = field(default_factory=list)
    archives: object = field(default_factory=Archives)
    _known: set = field(default_factory=set)
    _counts: Counter = field(default_factory=Counter)

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.archives.close()

    def add_finding(self, kind, learner, parts, text):
        """Add a finding once; of one learner only the first ones of a kind."""
        finding = IntakeFinding(kind, learner, display_path(parts), text)
        if finding in self._known or self._counts[kind, learner] > _MOST_LISTED:
            return
        self._known.add(finding)
        self._counts[kind, learner] += 1
        if self._counts[kind, learner] > _MOST_LISTED:
            finding = IntakeFinding(kind, learner, "", "and more of the same kind, which are not listed")
        self.findings.append(finding)


def collect(path, lessons=()):
    """Find every submitted file in a folder, a zip or a notebook, as a Collection.

    The names of lessons distinguish them from names of learners. CollectError: there is no submission.
    """
    path = Path(path)
    if not path.exists():
        raise CollectError(f"{path}: does not exist; give the folder or the zip with the submissions")
    collection = Collection()
    intake = _Intake(tuple(lessons), collection)
    if path.is_dir():
        intake.add_folder(path.resolve())
    else:
        intake.add_file(path.resolve(), (path.name,), alone=True)
    intake.finish()
    if not collection.files:
        raise CollectError(f"{path}: no notebooks (*.ipynb) and no zip in it; give the folder of submissions")
    collection.files.sort(key=lambda file: file.source)
    collection.ignored.sort()
    collection.findings.sort()
    return collection


class _Intake:
    """Turns files, and the members of zips, into SubmittedFiles."""

    def __init__(self, lessons, collection):
        self._lessons, self._collection = lessons, collection
        self._notebooks, self._bytes, self._unlisted = Counter(), Counter(), Counter()
        self._members = Counter()
        self._numbered = frozenset()

    # ------------------------------------------------------------ folders

    def add_folder(self, root):
        """Add everything in the folder of submissions."""
        entries = self._entries(root, ())
        folders = [entry for entry in entries if is_lesson(entry.name, self._lessons) and _is_folder(entry)]
        notebooks = [Path(path).relative_to(root).parts for entry in folders for path in _notebooks_in(entry)]
        self._numbered = numbered_learners(notebooks, self._lessons)
        for entry in folders:
            if entry.name not in self._numbered:
                entries.remove(entry)
                entries += self._entries(Path(entry.path), (entry.name,))
        if len(entries) > MOST_SENDERS:
            raise CollectError(f"{root}: more than {MOST_SENDERS} submissions; grade it in parts")
        for entry in sorted(entries, key=lambda entry: entry.path):
            parts = Path(entry.path).relative_to(root).parts
            if not _is_folder(entry):
                if not entry.name.startswith("."):
                    self.add_file(Path(entry.path), parts)
            elif not self._is_hidden(entry, parts):
                self._walk(Path(entry.path), parts)

    def _walk(self, top, top_parts):
        """Add the notebooks in a sender's folder, the upper folders first."""
        folders, count, files_left = deque([(top, top_parts)]), 0, MOST_FILES
        while folders:
            folder, parts = folders.popleft()
            count += 1
            if count > MOST_FOLDERS:
                text = f"more than {MOST_FOLDERS} folders; the deeper ones were not looked at"
                self._add_finding("file", top_parts, text)
                return
            entries = self._entries(folder, parts)
            files_left -= len(entries)
            if files_left < 0:  # the notebooks in this folder are still found
                text = f"more than {MOST_FILES} files; the others were not looked at"
                self._add_finding("file", top_parts, text)
                entries = [entry for entry in entries if _suffix(entry.name) in (".ipynb", ".zip")]
                folders.clear()
            for entry in entries:
                entry_parts = (*parts, entry.name)
                if not _is_folder(entry):
                    self.add_file(Path(entry.path), entry_parts)
                elif self._is_walked(entry, entry_parts):
                    folders.append((Path(entry.path), entry_parts))

    def _is_walked(self, entry, parts):
        if entry.name in _ENVIRONMENTS or os.access(f"{entry.path}/pyvenv.cfg", os.F_OK):
            self._add_finding("file", parts, "an environment of installed packages; it was not looked at")
        elif len(parts) > DEEPEST and entry.name not in _SKIPPED_FOLDERS:
            self._add_finding("file", parts, f"more than {DEEPEST} folders deep; it was not looked at")
        else:
            return not self._is_hidden(entry, parts)
        return False

    def _is_hidden(self, folder, parts):
        """Whether a folder is not looked at because of its name; it is listed unless a tool made it."""
        if folder.name in _SKIPPED_FOLDERS:
            return True
        if folder.name.startswith("."):
            self._ignore((*parts, ""))
            return True
        return False

    def _entries(self, folder, parts):
        """The entries of a folder, sorted by name; of one that cannot be read none, and a finding."""
        try:
            return sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError as error:
            reason = f"the folder cannot be read ({error.strerror})"
            if not parts:
                raise CollectError(f"{folder}: {reason}") from error
            self._add_submission(self._sender_of_folder(parts), parts, reason=reason)
            return []

    def _sender_of_folder(self, parts):
        return self._sender_of(parts if len(parts) > 1 else (*parts, ""))

    def _sender_of(self, parts):
        return sender_of(parts, self._lessons, self._numbered)

    # ------------------------------------------------------------ files

    def add_file(self, path, parts, *, alone=False):
        """Add a file; of a zip, add its members. `alone`: it is all that there is."""
        suffix = _suffix(parts[-1])
        try:
            status = path.lstat()
        except OSError as error:
            status, reason = None, f"it cannot be read ({error.strerror})"
        else:
            reason = file_problem(status, LARGEST if suffix == ".ipynb" else LARGEST_ZIP)
        if suffix not in (".ipynb", ".zip"):
            if status and stat.S_ISLNK(status.st_mode):
                self._add_finding("file", parts, "a link; links are not followed")
            self._ignore(parts)
            return
        sender = self._sender_of(parts)
        modified = local_time(status.st_mtime) if status else None
        if suffix == ".zip" and not reason:
            location = (str(path), status.st_dev, status.st_ino)
            reason = self._add_members(location, parts, sender, modified, alone)
            if not reason:
                return
        self._add_submission(
            sender,
            parts,
            submitted_at=modified,
            size=status.st_size if suffix == ".ipynb" and status else 0,
            reason=reason,
            location=(str(path), status.st_dev, status.st_ino) if status else (),
        )

    # ------------------------------------------------------------ zips

    def _add_members(self, location, parts, sender, modified, alone):
        """Add the notebooks in a zip; returns why it cannot be read, or ""."""
        archives, budget = self._collection.archives, (sender.learner, sender.platform_id, parts[0])
        if self._members[budget] > MOST_FILES:
            return f"the zips before it in this submission hold more than {MOST_FILES} files"
        try:
            members = archives.members(*location)
        except CollectError as error:
            return str(error)
        self._members[budget] += len(members)
        names = [_member_name(member) for member in members]
        sender_in = self._senders_in(parts, [name for name in names if _is_counted(name)], sender, alone)
        for number, (member, name) in enumerate(zip(members, names, strict=True)):
            if not _is_counted(name):
                continue
            member_sender = sender_in(name)
            if _suffix(name[-1]) not in (".ipynb", ".zip"):
                self._ignore((*parts, *name), member_sender)
                continue
            is_platforms = member_sender != sender
            self._add_submission(
                member_sender,
                (*parts, *PurePosixPath(member.filename.replace("\\", "/")).parts),
                # A learner can write any date into a zip.
                submitted_at=member_time(member, modified) if is_platforms else modified,
                archived_at=modified if is_platforms else None,
                size=member.file_size,
                reason=member_problem(member),
                location=(archives, location, number),
                group=display_path(parts),
                number=number,
            )
        return ""

    def _senders_in(self, parts, names, sender, alone):
        """A function from a member's name to its Sender."""
        if alone and not sender.platform:
            return self._senders_in_folder(names, sender)
        at_top = sender.place == parts[:-1] and sender.certainty is not Certainty.IN_UNKNOWN_FOLDER
        if not at_top or sender.platform or not names:
            return lambda name: sender
        senders = [platform_sender(name[0]) for name in names]
        if all(found is not None and not found.doubt for found in senders):
            return lambda name: replace(
                sender_of(name, self._lessons), place=parts, certainty=Certainty.IN_ZIP
            )
        self._report_names(parts, names, sender)
        return lambda name: sender

    def _senders_in_folder(self, names, sender):
        """The same for a zip given alone: a folder of submissions, perhaps inside one more folder."""
        notebooks = [name for name in names if _suffix(name[-1]) == ".ipynb"]
        tops = {name[0] if len(name) > 1 else "" for name in notebooks}
        is_wrapped = len(tops) == 1 and "" not in tops and platform_sender(*tops) is None
        depth = 1 if is_wrapped else 0
        numbered = numbered_learners([name[depth:] for name in notebooks], self._lessons)

        def sender_in(name):
            if len(name) <= depth + 1 and is_lesson_file(name[-1], self._lessons):
                return sender
            return sender_of(name[depth:] or name, self._lessons, numbered)

        return sender_in

    def _report_names(self, parts, names, sender):
        """Report a zip that may hold submissions of several people; all of them count as its sender's."""
        named = {part for name in names if _suffix(name[-1]) == ".ipynb" for part in name}
        people = sorted(part for part in named if not is_lesson(PurePosixPath(part).stem, self._lessons))
        if any(map(platform_sender, people)) or len(people) > _MOST_NAMES:
            text = f"this zip names {sanitize_line(', '.join(people[:_MOST_NAMES]), 200)}"
            text += f"; all of it counts as {sender.learner}'s. If it holds submissions of several people,"
            self._collection.add_finding("sender", sender.learner, parts, f"{text} unpack it")

    # ------------------------------------------------------------ what was found

    def _add_submission(
        self, sender, parts, *, size=0, reason="", submitted_at=None, group="", number=0, **more
    ):
        """Add the file that was found at `parts` to the collection, if its sender's budget allows."""
        key = (sender.learner, sender.platform_id, parts[0])  # a forged name uses up nobody else's budget
        self._notebooks[key] += 1
        if self._notebooks[key] > MOST_NOTEBOOKS:
            text = f"more than {MOST_NOTEBOOKS} notebooks and zips; the others were not read"
            self._collection.add_finding("file", sender.learner, parts[:1], text)
            return
        self._bytes[key] += 0 if reason else size
        if self._bytes[key] > LARGEST_SUBMISSION:
            most = LARGEST_SUBMISSION // 1_000_000
            reason = reason or f"with it, this submission has more than {most} MB of notebooks; submit fewer"
        if sender.doubt:
            self._collection.add_finding("sender", sender.learner, parts, sender.doubt)
        if not group and not sender.platform and len(parts) > 1:
            group = sanitize_line(parts[0], 120)
        _, repetition = split_repetition(PurePosixPath(parts[-1]).stem)
        moment, source = submitted_at.isoformat() if submitted_at else "", display_path(parts)
        file = SubmittedFile(
            **vars(sender),
            source=source,
            group=group,
            submitted_at=submitted_at,
            order=(sender.sequence, moment, repetition, number, source),
            reason=reason,
            **more,
        )
        self._collection.files.append(file)

    def _add_finding(self, kind, parts, text):
        self._collection.add_finding(kind, self._sender_of_folder(parts).learner, parts, text)

    def _ignore(self, parts, sender=None):
        sender = sender or self._sender_of(parts)
        self._unlisted[sender.learner] += 1
        if self._unlisted[sender.learner] <= _MOST_LISTED:
            self._collection.ignored.append(display_path(parts))

    def finish(self):
        """Report what can only be known now that everything is collected."""
        files, findings = self._collection.files, self._collection.findings
        self._collection.files = list(_told_apart(files, findings))
        senders = {file.learner for file in self._collection.files}
        for name, count in self._unlisted.items():
            if count > _MOST_LISTED:
                self._collection.ignored.append(f"{name}: {count - _MOST_LISTED} more files")
            if name not in senders:
                findings.append(IntakeFinding("file", name, "", "no notebook and no zip"))


def _told_apart(files, findings):
    """The files; senders whose names look like another one's get a name of their own, and a finding.

    Names can differ in spaces at their ends, beyond what is shown of a long name, or in a text that looks
    like an escaped mark. Two forms of one letter (NFC and NFD) are the same name, because systems change
    them; but not side by side in one folder.
    """
    spellings, people, identities = {}, {}, []
    for file in files:
        spellings.setdefault((file.place, _composed(file.given)), set()).add(file.given)
    for file in files:
        has_two_forms = len(spellings[file.place, _composed(file.given)]) > 1
        identities.append(file.given if has_two_forms else _composed(file.given))
        people.setdefault(file.learner, set()).add(identities[-1])
    for file, identity in zip(files, identities, strict=True):
        look_alikes = people[file.learner]
        first = file.learner if file.learner in look_alikes else min(look_alikes)
        if identity == first:
            yield file
            continue
        name = f"{file.learner} [{digest_of(os.fsencode(identity))[:6]}]"
        text = f"its name looks like {file.learner}, but is another one; the two are graded apart"
        findings.append(IntakeFinding("sender", name, file.source, text))
        yield replace(file, learner=name)


def _composed(name):
    return unicodedata.normalize("NFC", name)


def local_time(seconds):
    """Seconds since 1970 as a local datetime; the first or the last one if it is beyond the calendar."""
    try:
        return datetime.fromtimestamp(int(seconds))
    except (ValueError, OverflowError, OSError):
        return datetime.max.replace(microsecond=0) if seconds > 0 else datetime.min


def _is_folder(entry):
    try:
        return entry.is_dir(follow_symlinks=False)
    except OSError:
        return False


def _notebooks_in(folder):
    """The paths of the notebooks directly in a folder; none if it cannot be read, which is reported later."""
    try:
        return [entry.path for entry in os.scandir(folder) if _suffix(entry.name) == ".ipynb"]
    except OSError:
        return []


def _suffix(name):
    return PurePosixPath(name.lower()).suffix


def _member_name(member):
    parts = PurePosixPath(member.filename.replace("\\", "/")).parts
    return tuple(part for part in parts if part not in ("/", "..", "."))


def _is_counted(name):
    return bool(name) and not _SKIPPED_FOLDERS & set(name) and not name[-1].startswith("._")


def display_path(parts):
    """The parts of a path as one printable line."""
    return sanitize_line("/".join(parts), 300)


def digest_of(data):
    """SHA-256 of a file's bytes, as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()
