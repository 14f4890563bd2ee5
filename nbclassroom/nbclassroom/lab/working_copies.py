"""The learner's working copies: lessons are copied into my_lessons/, and work there is never overwritten.

A copy has no outputs, so that a learner can predict a result. my_lessons/.course.json stores for each copy
which lesson it came from. An update replaces a copy that the learner has not changed. If the learner has
changed it, the updated lesson is added under a new name. A copy under an older number of its lesson gets the
new number. Nothing is ever deleted. Without .course.json, every copy that differs from its lesson counts as
changed.
"""

import contextlib
import errno
import hashlib
import itertools
import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from nbclassroom import course
from nbclassroom.authoring.lesson_files import TEXTS, files_for_learners, without_outputs
from nbclassroom.authoring.lesson_names import lesson_name
from nbclassroom.exercises.atomic_write import write_file
from nbclassroom.exercises.progress import one_at_a_time

STATE = ".course.json"
LOCK = ".course.lock"
# A lesson's number in prose: in its heading, in a link, in "lesson 04".
_NUMBER = re.compile(r"(?<=^# )\d\d(?= · )|\b\d\d(?=_[a-z])|(?<=[Ll]esson )\d\d\b")


@dataclass
class LessonChanges:
    """What has changed among the working copies: names of files, relative to my_lessons/."""

    new: list[str] = field(default_factory=list)
    updated: list[str] = field(default_factory=list)
    added_beside: list[tuple[str, str]] = field(default_factory=list)  # (learner's file, updated lesson)
    renumbered: list[tuple[str, str]] = field(default_factory=list)  # (old name, new name)
    no_longer_in_course: list[str] = field(default_factory=list)  # copies that stay, named once
    folder: str = "my_lessons"

    @property
    def written(self):
        return [*self.new, *self.updated, *(lesson for _, lesson in self.added_beside)]

    def lines(self):
        """Lines of text that tell the learner what has changed."""
        if self.new:
            yield f"New in {self.folder}/: {', '.join(self.new)}"
        if self.updated:
            yield f"Updated, because you had not changed them: {', '.join(self.updated)}"
        for learners_file, lesson in self.added_beside:
            yield f"Updated in the course: {learners_file}. Your file is unchanged; the new one is {lesson}"
        if self.renumbered:
            pairs = ", ".join(f"{old} is now {new}" for old, new in self.renumbered)
            yield f"Lessons have new numbers, and your work in them is unchanged: {pairs}"
        if self.no_longer_in_course:
            names = ", ".join(self.no_longer_in_course)
            yield f"No longer in the course; your file and its progress are kept: {names}"
        if not self.written and not self.renumbered:
            yield f"{self.folder}/ is up to date; nothing was changed."


class Origin(NamedTuple):
    """The lesson that a working copy came from, and the update that was last added beside it."""

    shipped: str  # digest of the lesson's bytes, without outputs
    work: str  # digest of the parts that a learner changes
    offered: str = ""  # digest of the bytes of the update that was added beside it


def update_lessons(source=None, target=None, version=None):
    """Creates or updates the working copies in `target`, by default my_lessons/; returns LessonChanges.

    ValueError, one line that says what to do: there are no lessons, or the folder cannot be written; then no
    work has changed.
    """
    source = Path(source or course.folder())
    target = Path(target or course.learners_folder())
    lessons = [path.relative_to(source).as_posix() for path in files_for_learners(source)]
    if not any(name.endswith(".ipynb") for name in lessons):
        remedy = "run this from a clone of the course's repository"
        raise ValueError(f"there are no lessons in {source.name}/; {remedy}")
    if target.exists() and not target.is_dir():
        problem = f"{target.name} is a file, but the lessons need a folder of this name"
        raise ValueError(f"{problem}; rename the file")
    try:
        target.mkdir(exist_ok=True)
        with one_at_a_time(target / LOCK):
            return _update(source, target, lessons, version or course.release())
    except OSError as error:
        raise ValueError(_failure_text(target, error)) from error


def _update(source, target, lessons, version):
    """Each file is written whole, and the state at last: what was interrupted is completed next time."""
    origins, changes = _read_state(target / STATE), LessonChanges(folder=target.name)
    for name in lessons:
        data = without_outputs((source / name).read_bytes())
        if name.startswith(f"{TEXTS}/"):  # the lessons read them: no work of a learner
            _write(target / name, data)
            continue
        old_name = _name_under_older_number(target, name, origins)
        origin = _take_origin(origins, target, name, old_name)
        if old_name:
            (target / old_name).rename(target / name)
            changes.renumbered.append((old_name, name))
        origins[name] = _update_one(target, changes, name, data, origin, version)
    for name in origins.keys() - lessons:
        del origins[name]
        if name.endswith(".ipynb") and (target / name).exists():
            changes.no_longer_in_course.append(name)
    entries = {name: origin._asdict() for name, origin in sorted(origins.items())}
    _write(target / STATE, json.dumps({"lessons": entries}, indent=1).encode())
    return changes


def _write(path, data):
    if not path.exists() or path.read_bytes() != data:
        write_file(path, data)


def _name_under_older_number(folder, name, origins):
    """The name of a lesson's copy under an older number; None if there is none, or if the name is taken."""
    path = folder / name
    lesson = lesson_name(path.stem)
    if path.exists() or lesson == path.stem:
        return None
    name_in_metadata = None
    for copy in sorted(path.parent.glob(f"[0-9][0-9]_{lesson}{path.suffix}"), reverse=True):
        old_name = copy.relative_to(folder).as_posix()
        if copy.is_file() and old_name in origins:
            return old_name
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError, AttributeError):
            if lesson_name(json.loads(copy.read_bytes())["metadata"][course.name]["lesson"]) == lesson:
                name_in_metadata = name_in_metadata or old_name
    return name_in_metadata


def _take_origin(origins, folder, name, old_name):
    """Where a copy came from; also under an older number, if an update was interrupted after its renaming."""
    older = [entry for entry in sorted(origins) if _unnumbered(entry) == _unnumbered(name)]
    taken = [name, old_name, *(entry for entry in older if not (folder / entry).exists())]
    return next((origins.pop(entry) for entry in taken if entry in origins), None)


def _unnumbered(name):
    path = Path(name)
    return path.with_stem(lesson_name(path.stem))


def _update_one(folder, changes, name, data, origin, version):
    """Writes the files of one lesson; returns the origin to store."""
    copy = folder / name
    lesson = Origin(_digest(data), _work_digest(name, data))
    if not copy.exists():
        write_file(copy, data)
        changes.new.append(name)
        return lesson
    if origin and origin.shipped == lesson.shipped:
        return origin
    copy_data = copy.read_bytes()
    copy_work = _work_digest(name, copy_data)
    if origin and origin.work == copy_work:
        if copy_data != data:
            write_file(copy, data)
            changes.updated.append(name)
        return lesson
    if copy_work == lesson.work:
        return lesson
    if origin and (origin.offered == lesson.shipped or origin.work == lesson.work):
        return origin  # the update was added before, or it changes nothing that a learner sees
    name_beside = _name_beside(folder, name, version, data)
    if name_beside is not None:
        write_file(folder / name_beside, data)
        changes.added_beside.append((name, name_beside))
    return Origin(origin.shipped if origin else "", origin.work if origin else "", lesson.shipped)


def _name_beside(folder, name, version, data):
    """A free name for an updated lesson; None if a file with the same lesson exists already."""
    path = Path(name)
    for number in itertools.count(1):
        label = f"version {version}" if number == 1 else f"version {version}, {number}"
        name_beside = path.with_name(f"{path.stem} ({label}){path.suffix}").as_posix()
        if not (folder / name_beside).exists():
            return name_beside
        if _work_digest(name, (folder / name_beside).read_bytes()) == _work_digest(name, data):
            return None


def _digest(data):
    return hashlib.sha256(data).hexdigest()


def _work_digest(name, data):
    """Digest of what counts as a learner's work: in a notebook the cells, without their outputs and counts.

    Running cells is not work; writing, adding or moving a cell is, and so is pasting an image into one. In a
    file that is not a readable notebook, every byte counts. The numbers of lessons do not count.
    """
    if name.endswith(".ipynb"):
        with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
            work = [_work_of(cell) for cell in json.loads(data)["cells"]]
            return _digest(json.dumps(work, sort_keys=True).encode())
    return _digest(data)


def _work_of(cell):
    source = cell["source"] if isinstance(cell["source"], str) else "".join(cell["source"])
    return [
        cell.get("id"),
        cell["cell_type"],
        source if cell["cell_type"] != "markdown" else _NUMBER.sub("", source),
        cell.get("attachments") or {},
    ]


def _read_state(path):
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))["lessons"]
        return {name: Origin(**entry) for name, entry in entries.items()}
    except (FileNotFoundError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _failure_text(target, error):
    reason = error.strerror or str(error)
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        remedy = "free 100 MB and start again"
    elif error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        remedy = "give yourself the right to write there, or clone the course to a folder of your own"
    else:
        remedy = "make sure that it is an ordinary folder of yours, and start again"
    return f"not all lessons are in {target.name}/; your work there is unchanged ({reason}); {remedy}"
