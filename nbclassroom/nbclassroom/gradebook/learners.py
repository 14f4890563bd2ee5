"""Learners and their submissions: who submitted which lesson, and which of several submissions counts."""

import hashlib
import time
from collections import defaultdict
from dataclasses import dataclass, field
from itertools import chain

from tqdm import tqdm

from .archives import CollectError
from .layouts import doubt
from .submission import EQUALS, AnswerState, NotebookReader, Submission, lesson_by_name, read_submission

NOTEBOOK_SECONDS = 5  # of processor time, for reading one notebook; a usual one takes 0.02
READING_SECONDS = 30  # for all notebooks of one sender


@dataclass
class Learner:
    """A learner: {lesson: the Submission that counts}, {lesson: earlier ones, oldest first}, and others."""

    name: str
    submissions: dict = field(default_factory=dict)
    earlier: dict = field(default_factory=dict)
    unidentified: list = field(default_factory=list)  # of no known lesson

    @property
    def numbers(self):
        """{(platform, its number of the learner)} of all submissions, also of those that do not count."""
        submissions = chain(self.submissions.values(), *self.earlier.values(), self.unidentified)
        return {(one.file.platform, one.file.platform_id) for one in submissions}

    @property
    def digests(self):
        """{lesson: answers_digest} of the submissions that count and can be graded."""
        return {lesson: one.answers_digest for lesson, one in self.submissions.items() if one.answers_digest}


def read_all(collection, answer_keys, store):
    """The Learners of all files, by name; their answers are added to the store.

    CollectError, with a list: which of a learner's files counts is unknown.
    """
    learners: dict[str, Learner] = {}
    seconds: dict[str, float] = defaultdict(float)
    by_lesson, doubtful = defaultdict(list), []
    with NotebookReader(NOTEBOOK_SECONDS) as reader:
        for file in tqdm(collection.files, desc="reading", unit=" files", disable=None, leave=False):
            start = time.monotonic()
            learner = learners.setdefault(file.learner, Learner(file.learner))
            if seconds[learner.name] > READING_SECONDS:
                text = "reading the earlier notebooks of this submission took too much time; submit fewer"
                file.reason = file.reason or text
            submission = _read(file, answer_keys, store, reader)
            seconds[learner.name] += time.monotonic() - start
            lesson = submission.lesson
            if lesson is not None:
                by_lesson[learner.name, lesson].append(submission)
            elif not submission.is_page:
                learner.unidentified.append(submission)
    for (name, lesson), several in by_lesson.items():
        several.sort(key=lambda one: (str(one.file.submitted_at), one.file.source))
        latest = _latest(several)
        counting = learners[name].submissions[lesson] = latest[0]
        if len(latest) > 1:
            doubtful.append(f"{name}, {lesson}: {', '.join(one.file.source for one in latest)}")
        elif earlier := [one for one in several if one is not counting]:
            learners[name].earlier[lesson] = earlier
            text = f"submitted {1 + len(earlier)} times; this one counts: {counting.file.source}"
            counting.add(text)
            for other in earlier:
                if more := sorted(other.answered - counting.answered):
                    text = f"{other.file.source} answers {', '.join(more)}, and this one does not"
                    counting.add(f"{text}; only one file counts")
    if doubtful:
        text = "these files of one learner have different answers to one lesson, and nothing orders them"
        remedy = "Remove those that do not count; if they are several people's, give the layout, such as"
        raise doubt(text, doubtful, f'{remedy} --layout "{{group}}/{{learner}}".')
    return [learners[name] for name in sorted(learners, key=lambda name: (name.casefold(), name))]


def _read(file, answer_keys, store, reader):
    try:
        data = file.read()
    except CollectError as error:
        lesson = lesson_by_name(file.source, answer_keys.lessons)
        return Submission(lesson=lesson, reason=str(error), file=file)
    submission = read_submission(data, answer_keys.versions, reader, file.source)
    submission.file, submission.file_digest = file, hashlib.sha256(data).hexdigest()
    if not submission.reason:
        submission.key = answer_keys.key_for(submission.lesson, submission.version)
        submission.answers_digest = store.keep_page(submission.key, submission.lesson, submission.page)
        for id in answer_keys.equal_to_solution(submission.lesson, submission.shapes):
            submission.add(EQUALS, id, "odd")
        untouched = (AnswerState.NOT_ATTEMPTED, AnswerState.MISSING)
        answered = (id for id in submission.answers if submission.states[id] not in untouched)
        submission.answered = frozenset(answered)
        submission.page = {"answers": {}}
    return submission


def _latest(submissions):
    """Of one lesson's submissions, the oldest first, those that no later one with answers replaces."""
    answered = [one for one in submissions if one.answered]
    if not answered:
        return sorted(submissions, key=lambda one: bool(one.answers_digest))[-1:]
    newest = dict(sorted(one.file.version for one in answered)).items()  # of each family the last one
    return list({one.answers_digest: one for one in answered if one.file.version in newest}.values())
