"""Collect submissions from folders, single files, and the zips of learning platforms.

    submissions/ada.ipynb                                     one file per learner
    submissions/ada/04_grayscale.ipynb                        one folder per learner, with any content
    submissions/01_ada/04_grayscale.ipynb                     the same, with the numbers of a class list
    submissions/04_grayscale/ada.ipynb                        one folder per lesson
    submissions/Ada Lovelace_12345_assignsubmission_file_/*   Moodle ("Download all submissions")
    submissions/lovelaceada_LATE_123_456_04_grayscale-1.ipynb Canvas ("Download Submissions")
    submissions/class.zip                                     a platform's zip, as it was downloaded
    submissions/ada.zip                                       a learner's own zip: all of it is ada's

A single zip can also be given alone. Only regular files are read, as bytes. Links are not followed; a
file with several names (hard links, as `cp -al` makes) is read, and reported if two people have it. Nothing
is unpacked to disk, and a name from outside never becomes a path.

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
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial
from pathlib import Path, PurePosixPath

from ..authoring.lesson_names import is_lesson, lesson_name, lessons_named
from ..autograder.sanitize import sanitize_line
from . import archives
from .archives import Archives, CollectError
from .senders import (
    Certainty,
    Sender,
    is_lesson_file,
    notebook_name,
    numbered_learners,
    platform_sender,
    sender_of,
    split_repetition,
)

MOST_SENDERS = 20_000
MOST_NOTEBOOKS = 100  # of one sender; the course has 22 lessons
AGES = 3  # of `SubmittedFile.order`: the platform's number, the time, and the time `changed` in a zip
LARGEST_SUBMISSION = 200_000_000  # bytes of one sender's notebooks together
MOST_FILES = 20_000  # and folders, in the folders of one sender; as many files in the zips
DEEPEST = 12  # folders
_MOST_LISTED = 20  # other files of one sender, by name; and findings about what was not looked at
_MOST_NAMES = 3  # different names in one zip: more look like a zip of several people
_KINDS = (".ipynb", ".zip")
_SKIPPED_FOLDERS = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}
_ENVIRONMENTS = {".venv", "venv", "env", ".tox", "site-packages", "node_modules"}
_NO_NOTEBOOK = "it is no notebook (*.ipynb) and no zip; submit the notebook itself"


@dataclass(frozen=True, kw_only=True)
class SubmittedFile(Sender):
    """One submitted file, not yet read, and who sent it; `source` is where it was found, for display.

    group         the zip or folder that it came in; distinguishes learners who have the same name
    submitted_at  local time of the file, or what a platform's zip of the time `archived_at` says
    order         sorts the submissions of one lesson from the earliest to the latest: first what tells their
                  times (AGES), then what is only a guess (the upper folder, and copies, are later)
    reason        why the file is not read, or ""; else `reader` returns its bytes
    """

    source: str = ""
    group: str = ""
    submitted_at: datetime | None = None
    order: tuple = ()
    archived_at: datetime | None = None
    reason: str = ""
    reader: object = None

    def read(self):
        """The bytes of the file; CollectError if it cannot be read, or if it is too large."""
        if self.reason:
            raise CollectError(self.reason)
        return self.reader()


@dataclass(frozen=True, order=True)
class IntakeFinding:
    """Something unusual in one line, of the kind "sender" or "date" (in doubt), or "file" (not read)."""

    kind: str
    learner: str
    file: str
    text: str


def collect(path, lessons=()):
    """The Collection of a folder, a zip or a notebook; CollectError: there is no submission in it."""
    path = Path(path)
    if not path.exists():
        raise CollectError(f"{path}: does not exist; give the folder or the zip with the submissions")
    collection = Collection()
    intake = _Intake(path.resolve(), tuple(lessons), collection)
    if path.is_dir():
        intake.add_everything()
        intake.report_links()
    else:
        intake.add_file(path.resolve(), is_everything=True)
    collection.finish(lessons)
    if not collection.files:
        raise CollectError(f"{path}: no notebooks (*.ipynb) and no zip in it; give the folder of submissions")
    return collection


class Collection(AbstractContextManager):
    """What was collected, of each sender no more than their budget of files and bytes.

    files     list of SubmittedFile, sorted by source
    ignored   names of other files, sorted; of each sender at most some
    findings  list of IntakeFinding

    Use it as a context manager: a zip stays open until the end of the block.
    """

    def __init__(self):
        self.files, self.ignored, self.findings, self.archives = [], [], [], Archives()
        self._notebooks, self._bytes, self._ignored, self._found = Counter(), Counter(), Counter(), Counter()
        self._known, self._others = set(), []

    def __exit__(self, *_error):
        self.archives.close()

    def add_finding(self, kind, learner, parts, text):
        """Add a finding once; of one learner only the first ones of a kind."""
        finding = IntakeFinding(kind, learner, display_path(parts), text)
        if finding in self._known or self._found[kind, learner] > _MOST_LISTED:
            return
        self._known.add(finding)
        self._found[kind, learner] += 1
        if self._found[kind, learner] > _MOST_LISTED:
            finding = IntakeFinding(kind, learner, "", "and more of the same kind, which are not listed")
        self.findings.append(finding)

    def ignore(self, sender, parts):
        """List a file that is not read."""
        self._ignored[sender.learner] += 1
        if self._ignored[sender.learner] <= _MOST_LISTED:
            self.ignored.append(display_path(parts))
            self._others.append((sender, parts))

    def add(
        self, sender, parts, *, size=0, reason="", submitted_at=None, group="", number=0, changed="", **more
    ):
        """Add the file that was found at `parts`, if its sender's budget allows; `changed`: see AGES."""
        key = (sender.learner, sender.platform_id, parts[0])  # a forged name uses up nobody else's budget
        self._notebooks[key] += 1
        if self._notebooks[key] > MOST_NOTEBOOKS:
            text = f"more than {MOST_NOTEBOOKS} notebooks and zips; the others were not read"
            self.add_finding("file", sender.learner, parts[:1], text)
            return
        self._bytes[key] += 0 if reason else size
        if self._bytes[key] > LARGEST_SUBMISSION:
            most = LARGEST_SUBMISSION // 1_000_000
            reason = reason or f"with it, this submission has more than {most} MB of notebooks; submit fewer"
        if sender.doubt:
            self.add_finding("sender", sender.learner, parts, sender.doubt)
        if not group and not sender.platform and len(parts) > 1:
            group = sanitize_line(parts[0], 120)
        _, repetition = split_repetition(PurePosixPath(notebook_name(parts[-1])).stem)
        moment, source = submitted_at.isoformat() if submitted_at else "", display_path(parts)
        order = (sender.sequence, moment, changed, -len(parts), repetition, number, source)
        more |= {"source": source, "group": group, "submitted_at": submitted_at, "order": order}
        self.files.append(SubmittedFile(**vars(sender), reason=reason, **more))

    def _add_others(self, lessons):
        """Add what came in place of a notebook, with the reason why it is not read: its sender gets a page.

        It is named as lessons are handed out (04_grayscale.py), or its sender has sent nothing else.
        """
        senders = {file.learner for file in self.files}
        named = {(file.learner, name) for file in self.files for name in lessons_named(file.source, lessons)}
        others = [(_handed_out_as(parts[-1], lessons), sender, parts) for sender, parts in self._others]
        for lesson, sender, parts in sorted(others, key=lambda other: not other[0]):
            is_in_theirs = sender.platform or any(part.startswith(sender.given) for part in parts[:-1])
            is_missing = (sender.learner, lesson) not in named if lesson else sender.learner not in senders
            is_tools_own = parts[-1].startswith(".") or not parts[-1]
            if is_in_theirs and is_missing and not is_tools_own:
                self.add(sender, parts, reason=_NO_NOTEBOOK)
                senders.add(sender.learner)

    def finish(self, lessons):
        """Report what can only be known now that everything is collected, and sort it."""
        if self.files:
            self._add_others(lessons)
        files = list(_told_apart(self.files, self.findings))
        self.files = sorted(files, key=lambda file: file.source)
        senders = {file.learner for file in files}
        for name, count in self._ignored.items():
            if count > _MOST_LISTED:
                self.ignored.append(f"{name}: {count - _MOST_LISTED} more files")
            if name not in senders:
                self.findings.append(IntakeFinding("file", name, "", "no notebook and no zip"))
        self.ignored.sort()
        self.findings.sort()


class _Intake:
    """Finds the files below a folder, and the members of zips, with their senders."""

    def __init__(self, root, lessons, collection):
        self._root, self._lessons, self._collection = root, lessons, collection
        self._linked = {}
        self._members, self._numbered = Counter(), frozenset()

    # ------------------------------------------------------------ folders

    def add_everything(self):
        """Add everything in the folder of submissions."""
        entries = self._entries(self._root)
        folders = [entry for entry in entries if is_lesson(entry.name, self._lessons) and _is_folder(entry)]
        opened = {folder: self._entries(folder) for folder in folders}
        notebooks = [self._parts(e) for inside in opened.values() for e in inside if _suffix(e) == ".ipynb"]
        self._numbered = numbered_learners(notebooks, self._lessons)
        for folder, inside in opened.items():
            if folder.name not in self._numbered:
                entries.remove(folder)
                entries += inside
        if len(entries) > MOST_SENDERS:
            raise CollectError(f"{self._root}: more than {MOST_SENDERS} submissions; grade it in parts")
        for entry in entries:
            if not _is_folder(entry):
                if not entry.name.startswith("."):
                    self.add_file(entry)
            elif not self._is_hidden(entry):
                self._walk(entry)

    def _walk(self, top):
        """Add the notebooks in a sender's folder, the upper folders first."""
        folders, files_left = deque([top]), MOST_FILES
        while folders:
            entries = self._entries(folders.popleft())
            files_left -= len(entries)
            if files_left < 0:  # the notebooks in this folder are still found
                self._add_finding(top, f"more than {MOST_FILES} files; the others were not looked at")
                entries = [entry for entry in entries if _suffix(entry) in _KINDS]
                folders.clear()
            for entry in entries:
                if not _is_folder(entry):
                    self.add_file(entry)
                elif self._is_walked(entry):
                    folders.append(entry)

    def _is_walked(self, folder):
        if folder.name in _ENVIRONMENTS or os.access(f"{folder.path}/pyvenv.cfg", os.F_OK):
            self._add_finding(folder, "an environment of installed packages; it was not looked at")
        elif len(self._parts(folder)) > DEEPEST and folder.name not in _SKIPPED_FOLDERS:
            self._add_finding(folder, f"more than {DEEPEST} folders deep; it was not looked at")
        else:
            return not self._is_hidden(folder)
        return False

    def _is_hidden(self, folder):
        """Whether a folder is not looked at because of its name; it is listed unless a tool made it."""
        if folder.name.startswith(".") and folder.name not in _SKIPPED_FOLDERS:
            parts = (*self._parts(folder), "")
            self._collection.ignore(self._sender_of(parts), parts)
        return folder.name.startswith(".") or folder.name in _SKIPPED_FOLDERS

    def _entries(self, folder):
        """The entries of a folder, sorted by name; of one that cannot be read none, and a finding."""
        try:
            return sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError as error:
            reason = f"the folder cannot be read ({error.strerror})"
            if folder is self._root:
                raise CollectError(f"{folder}: {reason}") from error
            self._collection.add(self._sender_of_folder(folder), self._parts(folder), reason=reason)
            return []

    def _add_finding(self, entry, text):
        sender = self._sender_of_folder(entry)
        self._collection.add_finding("file", sender.learner, self._parts(entry), text)

    def _sender_of_folder(self, folder):
        parts = self._parts(folder)
        return self._sender_of(parts if len(parts) > 1 else (*parts, ""))

    def _sender_of(self, parts):
        return sender_of(parts, self._lessons, self._numbered)

    def _parts(self, path):
        return Path(path).relative_to(self._root).parts

    # ------------------------------------------------------------ files

    def add_file(self, path, *, is_everything=False):
        """Add a file; of a zip its members, those of a class if it was given alone (`is_everything`)."""
        parts = (path.name,) if is_everything else self._parts(path)
        suffix, status = _suffix(path), None
        sender = self._sender_of(parts)
        try:
            status = os.lstat(path)
            largest = archives.LARGEST if suffix == ".ipynb" else archives.LARGEST_ZIP
            reason = archives.file_problem(status, largest)
        except OSError as error:
            reason = f"it cannot be read ({error.strerror})"
        if suffix not in _KINDS:
            if status and stat.S_ISLNK(status.st_mode):
                self._add_finding(path, "a link; links are not followed")
            self._collection.ignore(sender, parts)
            return
        about = {}
        if status and status.st_nlink > 1:
            self._linked.setdefault((status.st_dev, status.st_ino), []).append((path, sender))
        if status:
            location = (os.fspath(path), status.st_dev, status.st_ino)
            about["submitted_at"] = local_time(status.st_mtime)
            about["reader"] = partial(archives.read_collected, *location)
            if suffix == ".ipynb":
                about["size"] = status.st_size
            elif not reason:
                reason = self._add_members(location, parts, sender, about["submitted_at"], is_everything)
                if not reason:
                    return
        self._collection.add(sender, parts, reason=reason, **about)

    def report_links(self):
        """Report files that several people have; the same file twice in one person's folder is no matter.

        A link changes the time of the folder that it is made in, so the folder changed last has the copy.
        """
        for entries in self._linked.values():
            entries.sort(key=lambda entry: (Path(entry[0]).parent.stat().st_mtime_ns, os.fspath(entry[0])))
            first, owner = entries[0]
            for path, sender in entries[1:]:
                if sender.learner != owner.learner:
                    text = f"it is the same file as {display_path(self._parts(first))} (a hard link)"
                    text += f" of {owner.learner}; both are graded: ask whose it is"
                    self._collection.add_finding("sender", sender.learner, self._parts(path), text)

    # ------------------------------------------------------------ zips

    def _add_members(self, location, parts, sender, modified, is_everything):
        """Add the notebooks in a zip; returns why it cannot be read, or ""."""
        opened, budget = self._collection.archives, (sender.learner, sender.platform_id, parts[0])
        if self._members[budget] > MOST_FILES:
            return f"the zips before it in this submission hold more than {MOST_FILES} files"
        try:
            members = opened.members(*location)
        except CollectError as error:
            return str(error)
        self._members[budget] += len(members)
        names = [_counted_name(member) for member in members]
        senders = self._senders_in(parts, list(filter(None, names)), sender, is_everything)
        for number, (member, name) in enumerate(zip(members, names, strict=True)):
            if not name:
                continue
            if _suffix(name[-1]) not in _KINDS:
                self._collection.ignore(senders[name], (*parts, *name))
                continue
            is_named_inside = senders[name] != sender  # the zip is believed: then its dates count too
            self._collection.add(
                senders[name],
                (*parts, *archives.member_parts(member)),
                # A learner can write any date into a zip.
                submitted_at=archives.member_time(member, modified) if is_named_inside else modified,
                changed=archives.member_time(member, modified).isoformat(),
                archived_at=modified if is_named_inside else None,
                size=member.file_size,
                reason=archives.member_problem(member),
                reader=partial(opened.read, location, number),
                group=display_path(parts),
                number=number,
            )
        return ""

    def _senders_in(self, parts, names, sender, is_everything):
        """The Senders of the members of a zip, by their names."""
        if is_everything and not sender.platform:
            return self._senders_in_folder(names, sender)
        # No folder above the zip names a learner: then a platform may have made the zip.
        at_top = sender.place == parts[:-1] and sender.certainty is not Certainty.IN_UNKNOWN_FOLDER
        if at_top and not sender.platform and names:
            senders = [platform_sender(name[0]) for name in names]
            if all(sender is not None and not sender.doubt for sender in senders):
                in_zip = {"place": parts, "certainty": Certainty.IN_ZIP}
                return {name: replace(sender_of(name, self._lessons), **in_zip) for name in names}
            self._report_names(parts, names, sender)
        return dict.fromkeys(names, sender)

    def _senders_in_folder(self, names, sender):
        """The same for a zip given alone: a folder of submissions, perhaps inside one more folder."""
        notebooks = [name for name in names if _suffix(name[-1]) == ".ipynb"]
        tops = {name[0] if len(name) > 1 else "" for name in notebooks}
        is_wrapped = len(tops) == 1 and "" not in tops and platform_sender(*tops) is None
        depth = 1 if is_wrapped else 0
        numbered = numbered_learners([name[depth:] for name in notebooks], self._lessons)
        senders = {name: sender_of(name[depth:] or name, self._lessons, numbered) for name in names}
        lessons = (
            name for name in names if len(name) <= depth + 1 and is_lesson_file(name[-1], self._lessons)
        )
        return senders | dict.fromkeys(lessons, sender)

    def _report_names(self, parts, names, sender):
        """Report a zip that may hold submissions of several people; all of them count as its sender's."""
        named = {part for name in names if _suffix(name[-1]) == ".ipynb" for part in name}
        people = sorted(part for part in named if not is_lesson(PurePosixPath(part).stem, self._lessons))
        if any(map(platform_sender, people)) or len(people) > _MOST_NAMES:
            text = f"this zip names {sanitize_line(', '.join(people[:_MOST_NAMES]), 200)}"
            text += f"; all of it counts as {sender.learner}'s. If it holds submissions of several people,"
            self._collection.add_finding("sender", sender.learner, parts, f"{text} unpack it")


def _handed_out_as(name, lessons):
    """The lesson that a file is named after, with its number; "" if it is named otherwise."""
    stem, _ = split_repetition(name.partition(".")[0])
    lesson = lesson_name(stem)
    return lesson if lesson != stem and lesson in lessons else ""


def _told_apart(files, findings):
    """The files; senders whose names look like another one's get a name of their own, and a finding.

    Names can differ in spaces at their ends, beyond what is shown of a long name, or in a text that looks
    like an escaped mark. Two forms of one letter (NFC and NFD) are the same name, because systems change
    them; but not side by side in one folder.
    """
    spellings, people = {}, {}
    for file in files:
        spellings.setdefault((file.place, _composed(file.given)), set()).add(file.given)

    def identity_of(file):
        composed = _composed(file.given)
        return file.given if len(spellings[file.place, composed]) > 1 else composed

    for file in files:
        people.setdefault(file.learner, set()).add(identity_of(file))
    for file in files:
        look_alikes, identity = people[file.learner], identity_of(file)
        first = file.learner if file.learner in look_alikes else min(look_alikes)
        if identity == first:
            yield file
            continue
        name = f"{file.learner} [{digest_of(os.fsencode(identity))[:6]}]"
        while name in people:  # somebody is called like this
            name += "'"
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


def _suffix(path):
    return PurePosixPath(notebook_name(os.fspath(path)).lower()).suffix


def _counted_name(member):
    """The parts of a member's name; none of what a tool made."""
    name = tuple(part for part in archives.member_parts(member) if part not in ("/", "..", "."))
    return () if _SKIPPED_FOLDERS & set(name) or "".join(name[-1:]).startswith("._") else name


def display_path(parts):
    """The parts of a path as one printable line."""
    return sanitize_line("/".join(parts), 300)


def digest_of(data):
    """SHA-256 of a file's bytes, as hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()
