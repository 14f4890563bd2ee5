"""Collect submissions: the files below a folder, or in a zip, and whose each of them is (see `layouts`).

Only regular files are read, as bytes, and no links are followed. Zips are read like folders, also in zips:
nothing is unpacked to disk, and a name from outside never becomes a path. A submission costs only its sender:
each learner has a budget of files.
"""

import os
import unicodedata
from collections import Counter
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from datetime import datetime
from functools import partial
from pathlib import Path, PurePosixPath

from ..authoring.lesson_names import notebook_name, split_repetition
from ..autograder.sanitize import sanitize_line
from .archives import Archives, CollectError, member_parts, member_time, read_collected
from .layouts import FolderLayout, Sender, doubt, shown

MOST_NOTEBOOKS = 100  # of one learner; the course has 22 lessons
MOST_FILES = 20_000  # in a folder at the top; and in the zips of a folder
_MOST_LISTED = 20  # other files of one learner, by name
_LATEST = 253_402_128_000  # seconds since 1970, in the year 9999; some file systems store later times
DEEPEST = 12  # folders
_TOOLS_FOLDERS = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}
_LEFT_OUT = _TOOLS_FOLDERS | {"venv", "env", "site-packages", "node_modules"}  # and hidden folders


@dataclass(kw_only=True)
class SubmittedFile(Sender):
    """One submitted file, not yet read, and whose it is.

    path          below the folder of submissions; it ends with "/" if a folder or a zip cannot be read
    dates         {index of a part of the path that is a file or a zip: its local time}
    reason        why the file is not read, or ""; else `reader` returns its bytes
    submitted_at  the time of the file, or of the learner's zip; in a platform's zip what that zip says
    version       as in Sender; of files that dates order, ("", the date)
    """

    path: str = ""
    dates: dict = field(default_factory=dict)
    reason: str = ""
    reader: object = None
    submitted_at: datetime | None = None

    @property
    def source(self):
        """Where it was found, one printable line."""
        return shown(self.path.rstrip("/"))

    def read(self):
        """The bytes of the file; CollectError if it cannot be read, or if it is too large."""
        if self.reason:
            raise CollectError(self.reason)
        return self.reader()

    def give_to(self, learner, sender):
        """Set what the Sender says; of the dates that which no learner wrote counts."""
        vars(self).update(vars(sender) | {"learner": learner})
        depth = self.place.count("/")
        self.submitted_at = next((self.dates[index] for index in sorted(self.dates) if index >= depth), None)
        self.version = self.version or ("", str(self.submitted_at))


def collect(path, lessons=(), layouts=()):
    """The Collection of a folder or a zip; `layouts` are names or patterns, () for the one that fits.

    CollectError: there is no submission in it, or nobody knows whose a file is.
    """
    path = Path(path)
    if not path.exists():
        raise CollectError(f"{path}: does not exist; give the folder or the zip with the submissions")
    search = _Search(path.resolve())
    if not search.notebooks:
        raise CollectError(f"{path}: no notebooks (*.ipynb) and no zip in it; give the folder of submissions")
    layout = FolderLayout(path.resolve().stem, lessons)
    layout.choose([file.path for file in search.notebooks], layouts)
    return Collection(search, layout)


class Collection(AbstractContextManager):
    """What was collected, of each learner no more than their budget of files.

    layout   the name of the layout
    files    list of SubmittedFile, sorted by source
    ignored  names of other files, sorted; of each learner at most some

    Use it as a context manager: a zip stays open until the end of the block.
    """

    def __init__(self, search, layout):
        self.layout = " or ".join(one.name for one in layout.layouts)
        self.files, self.ignored = [], []
        self._archives, self._counts = search.archives, Counter()
        senders = {file.path: layout.sender_of(file.path) for file in search.notebooks + search.others}
        names = _names_of({path: sender for path, sender in senders.items() if sender})
        for file in search.notebooks:
            self._add(file, names[file.path], senders[file.path])
        learners = {file.learner for file in self.files}
        for file in search.others:
            learner = names.get(file.path, "")
            self._counts[learner, "others"] += 1
            if self._counts[learner, "others"] <= _MOST_LISTED:
                self.ignored.append(shown(file.path))
            elif self._counts[learner, "others"] == _MOST_LISTED + 1:
                self.ignored.append(f"{learner or 'in this folder'}: more files")
            # Who sent no notebook gets a page that says so.
            if learner and learner not in learners and not PurePosixPath(file.path).name.startswith("."):
                file.reason = "it is no notebook (*.ipynb) and no zip; submit the notebook itself"
                self._add(file, learner, senders[file.path])
                learners.add(learner)
        self.files.sort(key=lambda file: file.source)
        self.ignored.sort()

    def __exit__(self, *_error):
        self._archives.close()

    def _add(self, file, learner, sender):
        """Add a learner's file, if their budget allows."""
        file.give_to(learner, sender)
        self._counts[learner] += 1
        if self._counts[learner] > MOST_NOTEBOOKS:
            file.path = f"{file.path.rpartition('/')[0]}/"
            file.reason = f"more than {MOST_NOTEBOOKS} notebooks and zips; the others were not read"
        if self._counts[learner] <= MOST_NOTEBOOKS + 1:
            self.files.append(file)


class _Search:
    """Finds the `notebooks` below a folder, or in a zip, and all `others`: lists of SubmittedFile.

    What cannot be looked at is among the notebooks, with the reason: whose it is must be known.
    """

    def __init__(self, root):
        self._root, self._is_folder, self.archives = root, root.is_dir(), Archives()
        self.notebooks, self.others, self._members = [], [], Counter()
        if self._is_folder:
            self._walk()
        else:
            self._add_entry(root)
        self.archives.close()

    def _walk(self):
        counts = Counter()  # of files, by folder at the top
        for folder, folders, names in os.walk(self._root, onerror=self._add_unreadable):
            parts = Path(folder).relative_to(self._root).parts
            # Path.is_symlink() raises if a folder cannot be looked into.
            links = {name for name in folders if os.path.islink(f"{folder}/{name}")}  # noqa: PTH114
            for name in sorted(links):
                self._refuse("/".join((*parts, name)), "it is a link; links are not followed")
            left_out = _LEFT_OUT & set(folders) | {name for name in folders if name.startswith(".")}
            folders[:] = sorted(set(folders) - left_out - links)
            counts[parts[:1]] += len(names)
            if parts and (counts[parts[:1]] > MOST_FILES or len(parts) > DEEPEST):
                text = f"more than {MOST_FILES} files, or {DEEPEST} folders deep; others were not looked at"
                self._refuse("/".join(parts), text)
                folders.clear()
                continue
            for name in sorted({*names, *left_out} - _TOOLS_FOLDERS):
                self._add_entry(Path(folder, name))

    def _add_unreadable(self, error):
        reason = f"the folder cannot be read ({error.strerror})"
        if error.filename == os.fspath(self._root):
            raise CollectError(f"{self._root}: {reason}") from error
        self._refuse(self._path(Path(error.filename)), reason)

    def _refuse(self, path, reason):
        self.notebooks.append(SubmittedFile(path=f"{path}/", reason=reason))

    def _path(self, path):
        return path.relative_to(self._root if self._is_folder else self._root.parent).as_posix()

    def _add_entry(self, entry):
        file, location = SubmittedFile(path=self._path(entry)), ()
        try:
            status = os.lstat(entry)
            location = os.fspath(entry), status.st_dev, status.st_ino
            moment = datetime.fromtimestamp(min(max(0, int(status.st_mtime)), _LATEST))
            file.dates, file.reader = {file.path.count("/"): moment}, partial(read_collected, *location)
        except OSError as error:
            file.reason = f"it cannot be read ({error.strerror})"
        self._add(file, (location,), file.path.rpartition("/")[0] or file.path)

    def _add(self, file, location, budget):
        """Add a file, or what is in a zip; see Archives for the location, and `_Search._members`."""
        name = PurePosixPath(file.path).name
        if name.startswith(".") or _suffix(name) != ".zip":
            is_notebook = _suffix(name) == ".ipynb" and not name.startswith(".")
            (self.notebooks if is_notebook else self.others).append(file)
            return
        try:
            if file.reason or self._members[budget] > MOST_FILES:
                raise CollectError(file.reason or f"the zips before it hold more than {MOST_FILES} files")
            members = self.archives.members(location)
        except CollectError as error:
            file.path, file.reason = f"{file.path}/", str(error)
            self.notebooks.append(file)
            return
        self._members[budget] += len(members)
        place = f"{file.path}/" if self._is_folder or len(location) > 1 else ""
        for number, member in enumerate(members):
            parts = [part for part in member_parts(member) if part not in ("/", "..", ".")]
            if parts and not _TOOLS_FOLDERS & set(parts):
                inner = SubmittedFile(path=place + "/".join(parts))
                moment = member_time(member, max(file.dates.items())[1])
                inner.dates = (file.dates if place else {}) | {inner.path.count("/"): moment}
                inner.reader = partial(self.archives.read, (*location, number))
                # In a class's zip, the zips of one folder have a budget, or else each zip.
                own = inner.path if len(parts) == 1 else inner.path.rpartition("/")[0]
                self._add(inner, (*location, number), own if len(location) == 1 else budget)


def _names_of(senders):
    """{path: the learner's name} of {path: Sender}; CollectError: names of two learners look the same.

    If several learners of a platform have one name, the platform's number follows it. In Moodle a person has
    another number in each assignment, and so in each zip. Two forms of one letter (NFC, NFD) are the same.
    "ada (1)" beside "ada" can be ada's copy.
    """
    numbers, names, spellings = {}, {}, {}
    for sender in senders.values():
        place = sender.place if sender.platform == "moodle" else ""
        numbers.setdefault((sender.learner, sender.platform, place), set()).add(sender.platform_id)
    namesakes = {(learner, platform) for (learner, platform, _), ids in numbers.items() if len(ids) > 1}
    learners = {sender.learner for sender in senders.values()}
    for path, sender in senders.items():
        number = f" ({sender.platform_id})" if (sender.learner, sender.platform) in namesakes else ""
        learner = unicodedata.normalize("NFC", sender.learner)
        names[path] = sanitize_line(learner.strip(), 120) + number
        stem, copy = split_repetition(sender.learner)
        name = stem if copy and stem in learners else names[path]
        spellings.setdefault(name, {}).setdefault((learner, number), shown(path))
    alike = [" and ".join(paths.values()) for paths in spellings.values() if len(paths) > 1]
    if alike:
        raise doubt("these names look the same, and are different", alike, "Rename a file or folder of each.")
    return names


def _suffix(name):
    return PurePosixPath(notebook_name(name).lower()).suffix
