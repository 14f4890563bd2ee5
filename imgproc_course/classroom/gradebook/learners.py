"""Learners and their submissions: who submitted which lesson, and which of several submissions counts."""

import hashlib
import re
import time
import unicodedata
from collections import Counter
from dataclasses import dataclass, field
from itertools import chain
from pathlib import PurePosixPath

from tqdm import tqdm

from ..autograder.answer_key import Key
from .archives import CollectError
from .collect import AGES, IntakeFinding, SubmittedFile, digest_of
from .notebook_reader import NotebookReader
from .roster import squeezed
from .senders import Certainty, notebook_name, split_repetition
from .submission import AnswerState, SubmissionContent, lesson_by_name, read_submission

NOTEBOOK_SECONDS = 5  # of processor time, for reading one notebook; a usual one takes 0.02
_MOST_LISTED = 20  # files that may be several people's
READING_SECONDS = 30  # for all notebooks of one sender
# Words of files and folders that name nobody; so do single letters and numbers such as v2 or 2026.
_NO_NAMES = """[a-z] ps version final old new copy of kopie von conflicted backup draft try attempt fixed
    my work solution solved answers? abgabe loesung lösung submissions? submitted homework hw week woche lab
    lessons? task exercises? uebung übung blatt aufgabe assignment project notebooks? untitled imgproc course
    downloads desktop zip first second third last better best mine"""
_NO_NAME = re.compile(rf"(?:{'|'.join(_NO_NAMES.split())})?\d{{0,4}}")
_TOO_SLOW_TOGETHER = "reading the earlier notebooks of this submission took too much time; submit fewer"


@dataclass
class Submission:
    """A submitted file, read; digests of its bytes, and of its answers with their key; "" for none."""

    file: SubmittedFile
    file_digest: str
    content: SubmissionContent
    answers_digest: str = ""
    answered: frozenset = frozenset()  # ids of the exercises with more than a stub
    key: Key | None = None

    @property
    def lesson(self):
        """The name of its lesson, or None."""
        return self.content.lesson


@dataclass
class Learner:
    """A learner: {lesson: the Submission that counts}, {lesson: earlier ones, oldest first}, and others."""

    name: str
    submissions: dict = field(default_factory=dict)
    earlier: dict = field(default_factory=dict)
    unidentified: list = field(default_factory=list)  # of no known lesson

    @property
    def files(self):
        """The SubmittedFiles of all submissions, also of those that do not count."""
        earlier = chain.from_iterable(self.earlier.values())
        return [one.file for one in (*self.submissions.values(), *earlier, *self.unidentified)]

    @property
    def digests(self):
        """{lesson: answers_digest} of the submissions that count and can be graded."""
        submissions = self.submissions.items()
        return {name: one.answers_digest for name, one in submissions if one.answers_digest}

    @property
    def page(self):
        """The file name of the learner's page: safe on every system, and unique through a digest."""
        slug = re.sub(r"[^a-z0-9]+", "-", self.name.lower()).strip("-")[:40] or "learner"
        return f"{slug}-{hashlib.sha256(self.name.encode()).hexdigest()[:10]}.html"


def read_all(collection, answer_keys, store, *, quiet=None):
    """The Learners of all files, by name; adds findings to the collection, and answers to the store."""
    submissions = []
    with NotebookReader(NOTEBOOK_SECONDS) as notebook_reader:
        reader = _SubmissionReader(answer_keys, store, notebook_reader)
        for file in tqdm(collection.files, desc="reading", unit=" files", disable=quiet, leave=False):
            submissions.append(reader.read(file))
    learners = _learners(submissions)
    collection.findings += [*_replaced_by_name(submissions), *_spelled_differently(submissions)]
    return learners


class _SubmissionReader:
    """Reads submitted files; each sender has a budget of time."""

    def __init__(self, answer_keys, store, notebook_reader):
        self._answer_keys, self._store, self._notebook_reader = answer_keys, store, notebook_reader
        self._seconds = Counter()

    def read(self, file):
        """The Submission of a file."""
        try:
            data = file.read()
        except CollectError as error:
            return Submission(file, "", self._unread(file, str(error)))
        submission = Submission(file, digest_of(data), self._content(file, data))
        content = submission.content
        if content.reason:
            return submission
        submission.key = self._answer_keys.key_for(content.lesson, content.version)
        submission.answers_digest = self._store.keep_answers(submission.key, content.lesson, content.answers)
        untouched = (AnswerState.NOT_ATTEMPTED, AnswerState.MISSING)
        submission.answered = frozenset(id for id in content.answers if content.states[id] not in untouched)
        content.answers = {}
        return submission

    def _content(self, file, data):
        sender = (file.learner, file.platform_id, file.group)
        if self._seconds[sender] > READING_SECONDS:
            return self._unread(file, _TOO_SLOW_TOGETHER)
        start = time.monotonic()
        content = read_submission(data, self._answer_keys, self._notebook_reader, file.source)
        self._seconds[sender] += time.monotonic() - start
        return content

    def _unread(self, file, reason):
        lesson = lesson_by_name(file.source, self._answer_keys.lessons)
        return SubmissionContent(lesson=lesson, reason=reason)


def _learners(submissions):
    names = _display_names(submissions)
    learners, by_lesson = {}, {}
    for submission in sorted(submissions, key=lambda submission: submission.file.order):
        name, lesson = names[id(submission)], submission.lesson
        learner = learners.setdefault(name, Learner(name))
        if lesson is not None:
            by_lesson.setdefault((name, lesson), []).append(submission)
        elif not submission.content.is_page:
            learner.unidentified.append(submission)
    for (name, lesson), several in by_lesson.items():
        _choose(learners[name], lesson, several)
    return [learners[name] for name in sorted(learners, key=lambda name: (name.casefold(), name))]


def _choose(learner, lesson, submissions):
    """The latest of a lesson's submissions counts, unless an earlier one has a better claim (see `_rank`)."""
    counting = max(reversed(submissions), key=_rank)
    learner.submissions[lesson] = counting
    earlier = [submission for submission in submissions if submission is not counting]
    if earlier:
        learner.earlier[lesson] = earlier
    # What is less certainly theirs, they need not have submitted.
    theirs = [other for other in earlier if other.file.certainty >= counting.file.certainty]
    if theirs:
        text = f"submitted {1 + len(theirs)} times; this one counts: {counting.file.source}"
        counting.content.add(text)
    for other in theirs:
        if text := _doubt(counting, other):
            counting.content.add(text)


def _doubt(counting, other):
    """Why another submission of the lesson should perhaps count, or ""."""
    more = sorted(other.answered - counting.answered)
    if more:
        return f"{other.file.source} answers {', '.join(more)}, and this one does not; only one file counts"
    if not other.answered or other.answers_digest == counting.answers_digest:
        return ""
    if other.file.order[:AGES] == counting.file.order[:AGES]:
        return f"{other.file.source} has other answers and the same date: which one is the last is unknown"
    if _way_of(other.file) != _way_of(counting.file):
        return f"{other.file.source} has other answers and came in another way; only one file counts"
    if not counting.file.platform and len(_own_parts(counting.file)) == 1:
        return f"{other.file.source} has other answers; only one file counts, and only its name says whose"
    return ""


def _own_parts(file):
    """The parts of its path from the one that names its sender on."""
    return file.source.split("/")[len(file.place) :]


def _way_of(file):
    """Where the name of its sender stands: in which folder or zip, and whether as a folder, zip or notebook.

    A learner who can choose the name of a file can choose a neighbour's, but not the neighbour's folder.
    """
    return file.place, PurePosixPath(_own_parts(file)[0]).suffix


def _display_names(submissions):
    """{id(submission): the name that is shown}; in two cases the platform's number, or the zip, follows it:

    - several learners of a platform have this name;
    - somebody chose the name (`Certainty.CHOSEN`), and another submission of the same lesson came under it.
    """
    people, certain = {}, _most_certain(submissions)
    for submission in submissions:
        file = submission.file
        group = file.group if file.platform == "moodle" else ""
        if file.platform_id:
            people.setdefault((file.learner, file.platform, group), set()).add(file.platform_id)
    namesakes = {(name, platform) for (name, platform, _), numbers in people.items() if len(numbers) > 1}
    names = {
        id(submission): f"{submission.file.learner} ({submission.file.platform_id or submission.file.group})"
        for submission in submissions
        if (submission.file.learner, submission.file.platform) in namesakes
        or _is_contested(submission, certain)
    }
    numbered = set(names.values())  # somebody can be called like this
    for submission in submissions:
        name = submission.file.learner
        names.setdefault(id(submission), f"{name} (so named)" if name in numbered else name)
    return names


def _most_certain(submissions):
    """{(name, lesson): the file of it whose sender is most certain}."""
    certain = {}
    for submission in submissions:
        file, place = submission.file, (submission.file.learner, submission.lesson)
        if place not in certain or certain[place].certainty < file.certainty:
            certain[place] = file
    return certain


def _is_contested(submission, certain):
    """Whether somebody could choose its name, and there is a file of this lesson that has it by itself."""
    file, lesson = submission.file, submission.lesson
    is_chosen = file.certainty is Certainty.CHOSEN and lesson is not None
    return is_chosen and certain[file.learner, lesson].certainty is Certainty.OWN


def _rank(submission):
    """First the most certain sender, then what can be read, then what has answers."""
    return submission.file.certainty, not submission.content.reason, bool(submission.answered)


def _replaced_by_name(submissions):
    """A finding for each file that arrived under a name of which there is a more certain submission."""
    certain = _most_certain(submissions)
    for submission in submissions:
        file, lesson = submission.file, submission.lesson
        counting = certain[file.learner, lesson]
        if lesson and file.certainty < counting.certainty:
            text = f"it names {file.learner}, whose own submission of {lesson} counts: {counting.source}"
            text += f"; decisions and extensions for {file.learner} are for that one"
            yield IntakeFinding("sender", file.group, file.source, text)


def _spelled_differently(submissions):
    """A finding for each file that counts as somebody's whose other file of this lesson is spelled otherwise.

    "ada _20_light" and "ada_20_light" give one name, and could be two people's.
    """
    spelled = {}
    for submission in sorted(submissions, key=lambda submission: submission.file.order):
        file, lesson = submission.file, submission.lesson
        if lesson and not file.platform and file.certainty is Certainty.OWN:
            spelled.setdefault((file.learner, lesson), {}).setdefault(_spelling(file), file.source)
    for (learner, lesson), sources in spelled.items():
        first, *others = sources.values()
        for source in others:
            text = f"with {first} it gives one name, and the spelling differs; only one {lesson} counts:"
            yield IntakeFinding("sender", learner, source, f"{text} if they are two people's, rename one")


def _spelling(file):
    """What names its sender: its folder, or its file without the mark of a repeated submission."""
    parts = _own_parts(file)
    name = PurePosixPath(notebook_name(parts[0]))
    stem = name.stem if len(parts) == 1 or name.suffix == ".zip" else name.name
    return split_repetition(stem)[0]


def require_one_person_each(learners, lessons, known):
    """CollectError with a list: the files in a folder or zip of nobody `known` name several people."""
    folders = {}
    for learner in (learner for learner in learners if learner.name not in known):
        for submission in (*learner.submissions.values(), *chain.from_iterable(learner.earlier.values())):
            if not submission.file.platform and (name := _inner_name(submission.file, lessons)):
                folders.setdefault((learner.name, submission.file.place), {})[name] = submission.file.source
    doubtful = [named for named in folders.values() if not all(name <= max(named, key=len) for name in named)]
    if doubtful:
        files = sorted(chain.from_iterable(named.values() for named in doubtful))
        listed = [f"  {file}" for file in files[:_MOST_LISTED]] + ["  ..."] * (len(files) > _MOST_LISTED)
        text = "nothing was graded: in the folder or zip of one learner, these files name several people:"
        remedy = "Several people: give the folder that has a file or folder for each, and unpack the zip. One"
        remedy += " learner, or a group: give a --roster that has the folder's name, or rename the files."
        raise CollectError("\n".join([text, *listed, remedy]), 3)


def _inner_name(file, lessons):
    """The words that may name a person, of a file and its folders in the folder or zip of its sender."""
    path = unicodedata.normalize("NFC", "/".join(_own_parts(file)[1:])).casefold().partition(".ipynb")[0]
    if "\\" in path or path.rpartition("/")[2].startswith("-"):  # hidden marks, options: nobody is called so
        return frozenset()
    others = {word for lesson in lessons for word in lesson.split("_")}
    words = (word for word in re.findall(r"[^\W_]+", path) if word not in others)
    return frozenset(
        word for word in words if not _NO_NAME.fullmatch(word) and word not in squeezed(file.learner)
    )


def unproven_dates(files, deadline):
    """An IntakeFinding for each zip of a platform that was made after the deadline and says earlier dates."""
    packed_late = [file for file in files if file.archived_at and file.archived_at > deadline]
    counts = Counter(file.group for file in packed_late if file.submitted_at <= deadline)
    for group, count in counts.items():
        text = f"{count} of its files are in time only by the dates in this zip, which its maker can choose"
        yield IntakeFinding("date", "", group, text)
