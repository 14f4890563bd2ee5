"""Who handed in what: learners, their lessons, and which of several hand-ins counts."""

import hashlib
import json
import re
from dataclasses import dataclass, field

from tqdm import tqdm

from imgproc_course.gradebook.collect import IntakeError, digest_of
from imgproc_course.gradebook.submission import Lifted, Notice, Reader, lift


@dataclass
class HandedIn:
    """One file that was handed in, as read.

    digest   SHA-256 of its bytes, "" where they were not read
    late     handed in late, or None where nobody said when it was due
    answers  digest of its answers with their key, "" where there is nothing to judge
    """

    handin: object
    digest: str
    lifted: object
    late: bool
    answers: str = ""
    key: object = None

    @property
    def lesson(self):
        return self.lifted.lesson


@dataclass
class Learner:
    """A learner: `counting` {lesson: HandedIn}, `earlier` {lesson: [HandedIn]}, `unplaced` [HandedIn]."""

    name: str
    counting: dict = field(default_factory=dict)
    earlier: dict = field(default_factory=dict)
    unplaced: list = field(default_factory=list)

    @property
    def page(self):
        """The name of the learner's page: of letters that every system takes, and told apart by digits."""
        slug = re.sub(r"[^a-z0-9]+", "-", self.name.lower()).strip("-")[:40] or "learner"
        return f"{slug}-{hashlib.sha256(self.name.encode()).hexdigest()[:10]}.html"


def read_all(intake, term, store, *, deadline=None, quiet=None):
    """Read everything that was handed in, and find out whose it is and which counts.

    Parameters
    ----------
    intake : Intake
    term : Term
    store : Store, which keeps the answers
    deadline : datetime, local and without a zone, or None
    quiet : bool or None, as tqdm's `disable`

    Returns
    -------
    list of Learner, sorted by name
    """
    read = []
    with Reader() as reader:
        for handin in tqdm(intake.handins, desc="reading", unit=" files", disable=quiet, leave=False):
            read.append(_read(handin, term, store, deadline, reader))
    return _learners(read)


def _read(handin, term, store, deadline, reader):
    late = handin.late or bool(deadline and handin.when and handin.when > deadline)
    try:
        data = handin.read()
    except IntakeError as error:
        lifted = Lifted(lesson=_lesson_by_name(handin.source, term), reason=str(error))
        return HandedIn(handin, "", lifted, late)
    lifted = lift(data, term, reader)
    handed_in = HandedIn(handin, digest_of(data), lifted, late)
    if lifted.reason:
        lifted.lesson = _lesson_by_name(handin.source, term)
        return handed_in
    handed_in.key = term.key_for(lifted.lesson, lifted.version)
    of_key = handed_in.key.lessons[lifted.lesson].version
    if lifted.version != of_key:
        made = f"version {lifted.version[:40]!r}" if lifted.version else "an unknown version"
        text = f"it was made from {made} of the lesson, and graded with the key of version {of_key}"
        lifted.notices.append(Notice("message", "", text))
    handed_in.answers = store.keep_answers(handed_in.key, lifted.lesson, lifted.answers)
    lifted.answers = {}
    return handed_in


def _lesson_by_name(source, term):
    """The one lesson whose name stands in a file's name, or None."""
    fitting = [name for name in term.lessons if name in source]
    return fitting[0] if len(fitting) == 1 else None


def _learners(read):
    names = _names(read)
    learners = {}
    for handed_in in sorted(read, key=lambda each: each.handin.order):
        learner = learners.setdefault(names[id(handed_in)], Learner(names[id(handed_in)]))
        _place(learner, handed_in)
    for learner in learners.values():
        _settle(learner)
    return [learners[name] for name in sorted(learners, key=lambda name: (name.casefold(), name))]


def _names(read):
    """What each is called: namesakes, told apart by the platform, get their number behind their name."""
    people = {}
    for each in read:
        of = each.handin
        group = of.group if of.platform == "moodle" else ""
        if of.id:
            people.setdefault((of.learner, of.platform, group), set()).add(of.id)
    namesakes = {(name, platform) for (name, platform, _), ids in people.items() if len(ids) > 1}
    return {
        id(each): f"{each.handin.learner} ({each.handin.id})"
        if (each.handin.learner, each.handin.platform) in namesakes
        else each.handin.learner
        for each in read
    }


def _place(learner, handed_in):
    """A later hand-in takes the place of an earlier one; one that cannot be graded, of none that can."""
    lesson = handed_in.lesson
    if lesson is None:
        learner.unplaced.append(handed_in)
        return
    before = learner.counting.get(lesson)
    if before is None:
        learner.counting[lesson] = handed_in
        return
    keeps = bool(handed_in.lifted.reason) and not before.lifted.reason
    learner.counting[lesson] = before if keeps else handed_in
    learner.earlier.setdefault(lesson, []).append(handed_in if keeps else before)


def _settle(learner):
    for lesson, others in learner.earlier.items():
        counts = learner.counting[lesson]
        others.sort(key=lambda each: each.handin.order)
        text = f"handed in {len(others) + 1} times; the latest counts ({counts.handin.source})"
        counts.lifted.notices.append(Notice("message", "", text))


def answers_digest(key, lesson, answers, how):
    """What a result depends on, as one SHA-256.

    Parameters
    ----------
    key : Key
    lesson : str
    answers : {exercise id: source}
    how : what else it depends on, as JSON holds it
    """
    text = json.dumps([key.digest, lesson, answers, how], sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode("ascii")).hexdigest()
