"""Collect submissions: the files below a folder, or in a zip, and whose each of them is (see `layouts`).

Only regular files are read, as bytes, and no links are followed. Zips are read like folders, also in zips: a
name from outside never becomes a path. A submission costs only its sender, who has a budget of files.
"""

import os
import unicodedata
from collections import Counter, defaultdict
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path, PurePosixPath

from ..authoring.lesson_names import notebook_name, split_repetition
from ..autograder.sanitize import sanitize_line
from .archives import MOST_MEMBERS, Archives, CollectError, member_time
from .layouts import MOST_LISTED, FolderLayout, doubt

MOST_NOTEBOOKS = 100  # of one learner
_TOOLS_FOLDERS = {".ipynb_checkpoints", "__MACOSX", "__pycache__", ".git"}
_LEFT_OUT = _TOOLS_FOLDERS | {"venv", "env", "site-packages", "node_modules"}  # and hidden folders


@dataclass(kw_only=True)
class SubmittedFile:
    """One submitted file, not yet read, and whose it is.

    path     below the folder of submissions; it ends with "/" if a folder or a zip cannot be read
    dates    (path, local time) of each zip that it is in, the outermost first, and its own
    reason   why the file is not read, or ""; else `reader` returns its bytes
    place    the path of what the learner's name is in, "" or with "/" at its end
    version  (a text that versions of one file share, the number or date of this one)
    """

    path: str = ""
    dates: tuple = ()
    reason: str = ""
    reader: Callable[[], bytes] = bytes
    learner: str = ""
    place: str = ""
    platform: str = ""
    platform_id: str = ""
    late: bool = False
    version: tuple = ()

    @property
    def submitted_at(self):
        """The first date that the learner did not write, or None."""
        return next((date for path, date in self.dates if len(path) > len(self.place)), None)

    @property
    def source(self):
        """Where it was found, one printable line."""
        return sanitize_line(self.path.rstrip("/"))

    def read(self):
        """The bytes of the file; CollectError if it cannot be read, or if it is too large."""
        if self.reason:
            raise CollectError(self.reason)
        return self.reader()


class Collection(AbstractContextManager):
    """What is in a folder or a zip, of each learner no more than their budget of files; a context manager.

    `layouts` are names or patterns, () for the one that fits. What cannot be looked at is among the files,
    with the reason. CollectError: there is no submission, or nobody knows whose a file is.

    layout   the name of the layout
    files    list of SubmittedFile, sorted by source
    ignored  names of other files, sorted; of each learner at most some
    """

    def __init__(self, path, lessons=(), layouts=()):
        path, self._archives = Path(path), Archives()
        self._members: Counter[str] = Counter()
        self._notebooks: list[SubmittedFile] = []
        self._others: list[SubmittedFile] = []
        self.files: list[SubmittedFile] = []
        self.ignored: list[str] = []
        if not path.exists():
            raise CollectError(f"{path}: does not exist; give the folder or the zip with the submissions")
        self._root, self._is_folder = path.resolve(), path.is_dir()
        self._search()
        if not self._notebooks:
            text = "no notebooks (*.ipynb) and no zip in it; give the folder of submissions"
            raise CollectError(f"{path}: {text}")
        layout = FolderLayout(self._root.stem, lessons, [file.path for file in self._notebooks], layouts)
        self.layout = " or ".join(layout.layouts)
        for file in self._notebooks + self._others:
            if sender := layout.sender_of(file.path):
                vars(file).update(vars(sender))
            file.version = file.version or ("", str(file.submitted_at))
        _make_names_unique([file for file in self._notebooks + self._others if file.learner])
        # {learner: (notebooks, others)}, nobody's with ""
        files: dict[str, tuple[list, list]] = defaultdict(lambda: ([], []))
        for index, found in enumerate((self._notebooks, self._others)):
            for file in found:
                files[file.learner][index].append(file)
        for learner, (notebooks, others) in files.items():
            self._keep(learner, notebooks, others)
        self.files.sort(key=lambda file: file.source)
        self.ignored.sort()

    def __exit__(self, *_error):
        self._archives.close()

    def _keep(self, learner, notebooks, others):
        """Keep a learner's files, as far as the budget goes."""
        if learner and not notebooks:  # They get a page that says so.
            notebooks = [file for file in others if not PurePosixPath(file.path).name.startswith(".")][:1]
            for file in notebooks:
                file.reason = "it is no notebook (*.ipynb) and no zip; submit the notebook itself"
        for file in notebooks[MOST_NOTEBOOKS:]:
            file.path = f"{file.path.rpartition('/')[0]}/"
            file.reason = f"more than {MOST_NOTEBOOKS} notebooks and zips; the others were not read"
        self.files += notebooks[: MOST_NOTEBOOKS + 1]
        self.ignored += [sanitize_line(file.path) for file in others[:MOST_LISTED]]
        if len(others) > MOST_LISTED:
            self.ignored.append(f"{learner or 'in this folder'}: more files")

    def _search(self):
        root, entries = self._root, [self._root]
        while entries:
            entry = entries.pop()
            file = SubmittedFile(path=entry.relative_to(root if self._is_folder else root.parent).as_posix())
            left_out = entry != root and (entry.name in _LEFT_OUT or entry.name.startswith("."))
            if left_out or not os.path.isdir(entry):  # noqa: PTH112 - Path.is_dir() raises without rights
                self._add_entry(entry, file)
            elif entry.is_symlink():
                self._refuse(file, "it is a link; links are not followed")
            else:
                try:
                    names = {path.name for path in entry.iterdir()} - _TOOLS_FOLDERS
                    entries += (entry / name for name in sorted(names, reverse=True))
                except OSError as error:
                    self._refuse(file, f"the folder cannot be read ({error.strerror})")
        self._archives.close()

    def _refuse(self, file, reason):
        """Take a folder or zip that cannot be read for a notebook that cannot: whose it is must be known."""
        if file.path == ".":
            raise CollectError(f"{self._root}: {reason}")
        file.path, file.reason = f"{file.path}/", reason
        self._notebooks.append(file)

    def _add_entry(self, entry, file):
        location: tuple = ()
        try:
            status = os.lstat(entry)
            location = ((os.fspath(entry), status),)
            moment = datetime.fromtimestamp(int(status.st_mtime))
            file.dates, file.reader = ((file.path, moment),), partial(self._archives.read, location)
        except OSError as error:
            file.reason = f"it cannot be read ({error.strerror})"
        self._add(file, location, file.path.rpartition("/")[0] or file.path)

    def _add(self, file, location, budget):
        """Add a file, or what is in a zip: see Archives for the location; `budget` is a key of `_members`."""
        name = PurePosixPath(notebook_name(file.path).lower())
        suffix = "" if name.name.startswith(".") else name.suffix
        if suffix != ".zip":
            (self._notebooks if suffix == ".ipynb" else self._others).append(file)
            return
        try:
            if file.reason or self._members[budget] > MOST_MEMBERS:
                raise CollectError(file.reason or f"the zips before it hold more than {MOST_MEMBERS} files")
            members = self._archives.members(location)
        except CollectError as error:
            self._refuse(file, str(error))
            return
        self._members[budget] += len(members)
        place = f"{file.path}/" if self._is_folder or len(location) > 1 else ""
        for number, member in enumerate(members):
            parts = [part for part in member.filename.split("/") if part not in ("", "..", ".")]
            if parts and not _TOOLS_FOLDERS & set(parts):
                inner = SubmittedFile(path=place + "/".join(parts))
                date = member_time(member, file.dates[-1][1])
                inner.dates = (*(file.dates if place else ()), (inner.path, date))
                inner.reader = partial(self._archives.read, (*location, number))
                # In a class's zip, the zips of one folder have a budget, or else each zip.
                own = inner.path if len(parts) == 1 else inner.path.rpartition("/")[0]
                self._add(inner, (*location, number), own if len(location) == 1 else budget)


def _make_names_unique(files):
    """Put the platform's number behind a name of several people; CollectError: two names look the same."""
    numbers = defaultdict(set)
    spellings: dict[str, dict] = defaultdict(dict)
    for file in files:
        place = file.place if file.platform == "moodle" else ""  # in each zip a person has another number
        numbers[file.learner, file.platform, place].add(file.platform_id)
    namesakes = {(learner, platform) for (learner, platform, _), ids in numbers.items() if len(ids) > 1}
    learners = {file.learner for file in files}
    for file in files:
        number = f" ({file.platform_id})" if (file.learner, file.platform) in namesakes else ""
        learner = unicodedata.normalize("NFC", file.learner)
        stem, copy = split_repetition(file.learner)  # "ada (1)" beside "ada" can be ada's copy
        file.learner = sanitize_line(learner.strip(), 120) + number
        spelling = stem if copy and stem in learners else file.learner
        spellings[spelling].setdefault((learner, number), sanitize_line(file.path))
    alike = [" and ".join(paths.values()) for paths in spellings.values() if len(paths) > 1]
    if alike:
        raise doubt("these names look the same, and are different", alike, "Rename a file or folder of each.")
