"""Learners and their submissions: who submitted which lesson, and which of several submissions counts."""

import hashlib
import json
import re
from dataclasses import dataclass, field

from tqdm import tqdm

from imgproc_course.autograder.answer_key import Key
from imgproc_course.gradebook.collect import CollectError, SubmittedFile, digest_of
from imgproc_course.gradebook.submission import (
    NotebookReader,
    SubmissionContent,
    lesson_by_name,
    read_submission,
)


@dataclass
class Submission:
    """One submitted file, read.

    file            the file as it was collected
    file_digest     SHA-256 of its bytes, "" if they could not be read
    content         what the file holds
    answers_digest  identifies its answers together with their key; "" if it cannot be read
    has_answers     True if it holds the answer to an exercise
    key             the key that it is graded with, or None
    """

    file: SubmittedFile
    file_digest: str
    content: SubmissionContent
    answers_digest: str = ""
    has_answers: bool = False
    key: Key | None = None

    @property
    def lesson(self):
        """The name of its lesson, or None."""
        return self.content.lesson


@dataclass
class Learner:
    """A learner and their submissions.

    submissions   {lesson: the Submission that counts}
    earlier       {lesson: list of the Submissions that do not count, oldest first}
    unidentified  list of Submissions whose lesson is unknown
    """

    name: str
    submissions: dict = field(default_factory=dict)
    earlier: dict = field(default_factory=dict)
    unidentified: list = field(default_factory=list)

    @property
    def page(self):
        """The file name of the learner's page: safe on every system, and unique through a digest."""
        slug = re.sub(r"[^a-z0-9]+", "-", self.name.lower()).strip("-")[:40] or "learner"
        return f"{slug}-{hashlib.sha256(self.name.encode()).hexdigest()[:10]}.html"


def read_all(collection, answer_keys, store, *, quiet=None):
    """Read every submitted file, assign it to its learner, and choose the submission that counts.

    Parameters
    ----------
    collection : Collection
    answer_keys : AnswerKeys
    store : Store, keeps the answers until they are graded
    quiet : bool or None, as tqdm's `disable`

    Returns
    -------
    list of Learner, sorted by name
    """
    submissions = []
    with NotebookReader() as reader:
        for file in tqdm(collection.files, desc="reading", unit=" files", disable=quiet, leave=False):
            submissions.append(_read(file, answer_keys, store, reader))
    return _learners(submissions)


def _read(file, answer_keys, store, reader):
    try:
        data = file.read()
    except CollectError as error:
        content = SubmissionContent(
            lesson=lesson_by_name(file.source, answer_keys.lessons), reason=str(error)
        )
        return Submission(file, "", content)
    content = read_submission(data, answer_keys, reader, file.source)
    submission = Submission(file, digest_of(data), content)
    if content.reason:
        return submission
    submission.key = answer_keys.key_for(content.lesson, content.version)
    submission.answers_digest = store.keep_answers(submission.key, content.lesson, content.answers)
    submission.has_answers, content.answers = bool(content.answers), {}
    return submission


def _learners(submissions):
    names = _display_names(submissions)
    learners = {}
    for submission in sorted(submissions, key=lambda submission: submission.file.order):
        name = names[id(submission)]
        _add(learners.setdefault(name, Learner(name)), submission)
    for learner in learners.values():
        _report_repeated(learner)
    return [learners[name] for name in sorted(learners, key=lambda name: (name.casefold(), name))]


def _display_names(submissions):
    """{id(submission): the learner's name}; learners of one name get the platform's number after it."""
    people = {}
    for submission in submissions:
        file = submission.file
        group = file.group if file.platform == "moodle" else ""
        if file.platform_id:
            people.setdefault((file.learner, file.platform, group), set()).add(file.platform_id)
    namesakes = {(name, platform) for (name, platform, _), numbers in people.items() if len(numbers) > 1}
    return {
        id(submission): f"{submission.file.learner} ({submission.file.platform_id})"
        if (submission.file.learner, submission.file.platform) in namesakes
        else submission.file.learner
        for submission in submissions
    }


def _add(learner, submission):
    """A later submission replaces an earlier one, unless only the earlier one has answers to grade."""
    lesson = submission.lesson
    if submission.content.is_page:
        return
    if lesson is None:
        learner.unidentified.append(submission)
        return
    before = learner.submissions.get(lesson)
    if before is None:
        learner.submissions[lesson] = submission
        return
    before_counts = _value(before) > _value(submission)
    learner.submissions[lesson] = before if before_counts else submission
    learner.earlier.setdefault(lesson, []).append(submission if before_counts else before)


def _value(submission):
    return not submission.content.reason, submission.has_answers


def _report_repeated(learner):
    for lesson, earlier in learner.earlier.items():
        submission = learner.submissions[lesson]
        earlier.sort(key=lambda submission: submission.file.order)
        submission.content.add(
            f"submitted {len(earlier) + 1} times; this one counts: {submission.file.source}"
        )


def digest_of_answers(key, lesson, answers, conditions):
    """Everything that a result depends on, as one SHA-256.

    Parameters
    ----------
    key : Key
    lesson : str
    answers : {exercise id: source}
    conditions : what else the result depends on, as JSON holds it

    Returns
    -------
    str, hexadecimal digits
    """
    text = json.dumps([key.digest, lesson, answers, conditions], sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode("ascii")).hexdigest()
