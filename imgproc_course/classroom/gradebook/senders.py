"""Who sent a file: the learner whom a platform's name, a folder or a file's name gives.

The first part of a path names the sender: the instructor or the platform wrote it. Deeper parts were named by
the learner, who must not be able to submit as somebody else.
"""

import re
import unicodedata
from dataclasses import dataclass, field, replace
from enum import IntEnum
from pathlib import PurePosixPath

from ..authoring.lesson_names import is_lesson, lesson_name, lessons_named, without_lesson
from ..autograder.sanitize import sanitize_line

LONGEST_NAME = 500  # characters of one part of a path
_MOODLE = re.compile(r"_(?P<id>\d{1,20})_assignsubmission_[a-z]+_?")
_CANVAS = re.compile(
    r"(?P<name>[^_]+)_(?:(?P<late>LATE)_)?(?P<id>\d{1,20})_(?P<order>\d{1,18})_(?P<file>.+)", re.S | re.I
)
# Some browsers save a notebook as text: 04_grayscale.ipynb.txt, and once more as 04_grayscale.ipynb (1).txt.
_NOTEBOOK_AS_TEXT = re.compile(r"(?P<stem>.+)\.ipynb(?P<copy> ?\(\d{1,6}\))?\.(?:txt|json)", re.S | re.I)
_REPEATED = re.compile(r"(?P<stem>.+?)(?:-(?P<number>\d{1,6})|[ _]?\((?P<copy>\d{1,6})\))", re.S)


class Certainty(IntEnum):
    """How certain a sender is: a file never takes the place of one whose sender is more certain."""

    IN_ZIP = 0  # a name in a platform's zip
    IN_UNKNOWN_FOLDER = 1  # in a folder named like a lesson that no key has: perhaps it is a learner's folder
    CHOSEN = 2  # a name that somebody chose on a platform; or one in a lesson's folder, perhaps a learner's
    OWN = 3  # a folder or file at the top that has this name by itself


@dataclass(frozen=True)
class Sender:
    """Who sent a file; `learner` is a name, one printable line.

    platform     "moodle", "canvas" or ""; platform_id: its number of the learner, or ""
    sequence     its number of the submission; sorts the submissions of one learner
    doubt        why the name cannot be believed, or ""
    given        the name as it was given, with marks and spaces that nobody sees
    place        tuple of str, the folders, and the zip, that the name is in
    """

    learner: str
    platform: str = ""
    platform_id: str = ""
    late: bool = False
    sequence: int = 0
    doubt: str = ""
    given: str = field(default="", compare=False)
    place: tuple = field(default=(), compare=False)
    certainty: Certainty = field(default=Certainty.OWN, compare=False)


def sender_of(parts, lessons, numbered=frozenset()):
    """The Sender of a file by its path, without lessons; `numbered` is what `numbered_learners` found."""
    parts = (*parts[:-1], notebook_name(parts[-1]))
    folders = (part in numbered or not is_lesson(part, lessons) for part in parts[:-1])
    depth = next((depth for depth, names_somebody in enumerate(folders) if names_somebody), len(parts) - 1)
    sender = platform_sender(parts[depth])
    if sender is None:
        is_file = depth == len(parts) - 1
        given = name_in_stem(PurePosixPath(parts[-1]).stem, lessons) if is_file else parts[depth]
        sender = Sender(given)
    name = sanitize_line(unicodedata.normalize("NFC", sender.learner.strip()), 120) or "(no name)"
    certainty = Certainty.CHOSEN if depth or sender.platform else Certainty.OWN
    if depth and lesson_name(parts[0]) not in lessons:
        certainty = Certainty.IN_UNKNOWN_FOLDER
    return replace(
        sender, learner=name, given=sender.learner, place=tuple(parts[:depth]), certainty=certainty
    )


def numbered_learners(paths, lessons):
    """The folders that a class list numbered: 01_ada has the form of a lesson's name, but is a learner's.

    In the folder of a lesson without a key, hardly a file is named after a lesson that has one. If at least
    half of the files are in at least half of such folders, all of these folders are learners'. A path is a
    tuple of its parts, from the top folder on.
    """
    votes = {}
    for folder, *_, name in (path for path in paths if len(path) > 1):
        if is_lesson(folder, lessons) and lesson_name(folder) not in lessons:
            votes.setdefault(folder, []).append(bool(lessons_named(name, lessons)))
    learners = sum(2 * sum(votes_named) >= len(votes_named) for votes_named in votes.values())
    return frozenset(votes) if 2 * learners >= len(votes) else frozenset()


def notebook_name(name):
    """The name of a file; of a notebook that a browser saved as text the notebook's own: ada.ipynb."""
    match = _NOTEBOOK_AS_TEXT.fullmatch(name)
    return f"{match['stem']}{match['copy'] or ''}.ipynb" if match else name


def platform_sender(name):
    """The Sender in a name that Moodle or Canvas made, or None.

    A person chooses their name on the platform, and the name of their file. If there is more than one mark
    of Moodle in a name, one of them is theirs: then the name says nothing.
    """
    marks = list(_MOODLE.finditer(name))
    if len(marks) > 1:
        return Sender(name, doubt="its name has Moodle's mark more than once, so it names nobody for certain")
    if marks and marks[0].start():
        return Sender(name[: marks[0].start()], "moodle", marks[0]["id"])
    match = _CANVAS.fullmatch(name)
    if match:
        return Sender(match["name"], "canvas", match["id"], bool(match["late"]), int(match["order"]))
    return None


def name_in_stem(stem, lessons):
    """A file's stem without the lesson's name.

    student-1 and student-2 are two learners; ada_04_grayscale and ada_04_grayscale-1 are both ada's.
    """
    unnumbered, _ = split_repetition(stem)
    named_lessons = lessons_named(unnumbered, lessons)
    stem = unnumbered if named_lessons and unnumbered.endswith(named_lessons[-1]) else stem
    return (without_lesson(stem, lessons) if named_lessons else "") or stem


def split_repetition(stem):
    """A stem without the mark of a repeated submission ("-1", " (2)"), and the mark's number (0 if none)."""
    match = _REPEATED.fullmatch(stem)
    return (match["stem"], int(match["number"] or match["copy"])) if match else (stem, 0)


def is_lesson_file(name, lessons):
    """Whether a file is named after a lesson, and after nothing else."""
    stem, _ = split_repetition(PurePosixPath(notebook_name(name)).stem)
    return platform_sender(name) is None and is_lesson(stem, lessons)
