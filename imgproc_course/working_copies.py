"""The learner's working copies: lessons go into my_lessons/, and work begun there is never written over.

For each copy, my_lessons/.course.json keeps which lesson it came from. A copy that the learner has not
changed follows an update; beside one with work in it the updated lesson is laid under a name of its own.
Nothing is ever deleted. Without that file, every copy that differs from its lesson counts as work.
"""

import contextlib
import errno
import hashlib
import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import imgproc_course
from imgproc_course.authoring.atomic_write import stage_file

CHECKOUT = Path(imgproc_course.__file__).resolve().parents[1]
STATE = ".course.json"
LOCK = ".course.lock"
NOT_FOR_LEARNERS = {"masters", "__pycache__"}


class LessonsError(Exception):
    """The lessons could not be brought; the text is one line that says what to do."""


@dataclass
class Brought:
    """What happened to the working copies: names of files, relative to my_lessons/."""

    new: list[str] = field(default_factory=list)
    corrected: list[str] = field(default_factory=list)
    beside: list[tuple[str, str]] = field(
        default_factory=list
    )  # (the learner's file, the updated lesson beside it)
    folder: str = "my_lessons"

    @property
    def written(self):
        """Every file that was laid down, as it is in the course."""
        return [*self.new, *self.corrected, *(theirs for _, theirs in self.beside)]

    def lines(self):
        """What to tell the learner, one sentence a line."""
        if self.new:
            yield f"New in {self.folder}/: {', '.join(self.new)}"
        if self.corrected:
            yield f"Brought up to date, as you had not changed them: {', '.join(self.corrected)}"
        for mine, theirs in self.beside:
            yield f"Changed in the course: {mine}. Yours is as you left it; the new one is {theirs}"
        if not (self.new or self.corrected or self.beside):
            yield f"{self.folder}/ is up to date; nothing in it was touched."


class Origin(NamedTuple):
    """Which lesson a working copy came from, and which update was last laid beside it."""

    shipped: str  # digest of the lesson's bytes
    work: str  # digest of what a learner can change in it
    offered: str = ""  # digest of the bytes of the update beside it


def bring_lessons(source=None, target=None, version=None):
    """Makes or updates the working copies.

    Parameters
    ----------
    source : the folder of the lessons; the checkout's notebooks/ unless said
    target : the learner's folder; the checkout's my_lessons/ unless said
    version : version of the course, for the name of an update beside a learner's file

    Returns
    -------
    Brought

    Raises
    ------
    LessonsError : no lessons, or the folder cannot be written; then everything is as it was
    """
    source = Path(source or CHECKOUT / "notebooks")
    target = Path(target or CHECKOUT / "my_lessons")
    lessons = list(_lessons(source))
    if not any(name.endswith(".ipynb") for name in lessons):
        raise LessonsError(
            f"there are no lessons in {source.name}/; run this from a clone of the course's repository"
        )
    if target.exists() and not target.is_dir():
        raise LessonsError(
            f"{target.name} is a file, and the lessons need a folder of that name; rename the file"
        )
    try:
        target.mkdir(exist_ok=True)
        with _one_at_a_time(target / LOCK):
            return _bring(source, target, lessons, version or imgproc_course.__version__)
    except OSError as error:
        raise LessonsError(_what_to_do(target, error)) from error


def _lessons(source):
    """Relative names of everything that a learner gets, in order."""
    for path in sorted(source.rglob("*")) if source.is_dir() else ():
        name = path.relative_to(source)
        hidden = any(part.startswith(".") or part in NOT_FOR_LEARNERS for part in name.parts)
        if path.is_file() and not hidden:
            yield name.as_posix()


def _bring(source, target, lessons, version):
    origins = _read_state(target / STATE)
    brought, staged = Brought(folder=target.name), Staged(target)
    with staged:
        for name in lessons:
            data = (source / name).read_bytes()
            origins[name] = _bring_one(staged, brought, name, data, origins.get(name), version)
        state = target / STATE
        staged.write(
            STATE, _state_text(origins).encode(), replaces=state.read_bytes() if state.exists() else None
        )
        staged.put_in_place()
    return brought


def _bring_one(staged, brought, name, data, origin, version):
    """Stages what has to be written for one lesson; returns the origin to remember."""
    copy = staged.folder / name
    lesson = Origin(_digest(data), _work_digest(name, data))
    if not copy.exists():
        staged.write(name, data)
        brought.new.append(name)
        return lesson
    if origin and origin.shipped == lesson.shipped:
        return origin
    mine = copy.read_bytes()
    mine_work = _work_digest(name, mine)
    if origin and mine_work == origin.work:
        if mine != data:
            staged.write(name, data, replaces=mine)
            brought.corrected.append(name)
        return lesson
    if mine_work == lesson.work:
        return lesson
    if origin and (origin.offered == lesson.shipped or origin.work == lesson.work):
        return origin  # laid beside it already, or nothing that a learner would see has changed
    beside = _name_beside(staged.folder, name, version, data)
    if beside is not None:
        staged.write(beside, data)
        brought.beside.append((name, beside))
    return Origin(origin.shipped if origin else "", origin.work if origin else "", lesson.shipped)


def _name_beside(folder, name, version, data):
    """A free name for an updated lesson, or None when the same bytes lie beside it already."""
    path = Path(name)
    for number in range(1, 1000):
        label = f"version {version}" if number == 1 else f"version {version}, {number}"
        beside = path.with_name(f"{path.stem} ({label}){path.suffix}").as_posix()
        if not (folder / beside).exists():
            return beside
        if (folder / beside).read_bytes() == data:
            return None
    raise LessonsError(
        f"there are 999 updates of {name} in {folder.name}/ already; move some of them elsewhere"
    )


def _digest(data):
    return hashlib.sha256(data).hexdigest()


def _work_digest(name, data):
    """Digest of what counts as a learner's work: of a notebook its cells, without outputs and counts.

    Running cells is no work; writing, adding or moving one is, and so is pasting a picture into it. Of what
    is no readable notebook every byte counts.
    """
    if name.endswith(".ipynb"):
        with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
            cells = json.loads(data)["cells"]
            return _digest(json.dumps([_work_of(cell) for cell in cells], sort_keys=True).encode())
    return _digest(data)


def _work_of(cell):
    source = cell["source"]
    return [
        cell.get("id"),
        cell["cell_type"],
        source if isinstance(source, str) else "".join(source),
        cell.get("attachments") or {},
    ]


def _read_state(path):
    try:
        known = json.loads(path.read_text(encoding="utf-8"))["lessons"]
        return {
            str(name): Origin(str(entry["shipped"]), str(entry["work"]), str(entry.get("offered", "")))
            for name, entry in known.items()
        }
    except (FileNotFoundError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _state_text(origins):
    return json.dumps(
        {"lessons": {name: origin._asdict() for name, origin in sorted(origins.items())}}, indent=1
    )


class Staged:
    """Files written beside their places first; put in place only when every one is whole on disk."""

    def __init__(self, folder):
        self.folder = folder
        self._waiting = []  # (temporary path, its place, the bytes that it replaces there or None)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        for temporary, _, _ in self._waiting:
            temporary.unlink(missing_ok=True)

    def write(self, name, data, *, replaces=None):
        if data == replaces:
            return
        place = self.folder / name
        temporary = stage_file(place, data, sync=True)
        self._waiting.append((temporary, place, replaces))

    def put_in_place(self):
        for _, place, replaces in self._waiting:
            if (place.read_bytes() if place.exists() else None) != replaces:
                raise LessonsError(f"{place.name} was saved while it was brought up to date; start again")
        for temporary, place, _ in self._waiting:
            temporary.replace(place)


@contextlib.contextmanager
def _one_at_a_time(path):
    """Two starts at once: the second waits until the first has brought everything."""
    with path.open("a+b") as file:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_LOCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _what_to_do(target, error):
    why = error.strerror or str(error)
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        remedy = "free 100 MB and start again"
    elif error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        remedy = "give yourself the right to write there, or clone the course to a folder of your own"
    else:
        remedy = "see that it is an ordinary folder of yours, and start again"
    return f"no lessons were brought into {target.name}/, and nothing in it was changed ({why}); {remedy}"
