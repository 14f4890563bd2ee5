"""The folder of results: every result is stored at once, so an interrupted run continues where it stopped."""

import contextlib
import fcntl
import hashlib
import json
import threading
import time
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

from tqdm import tqdm

from ..authoring.lesson_names import lesson_name
from ..autograder.outcomes import Outcome
from ..autograder.pool import autograde
from ..autograder.results import from_json, to_json
from ..exercises.atomic_write import write_file

_FORMAT = 3  # of the files in the folder


class GradesFolderError(ValueError):
    """A folder of grades cannot be written; the message is one line with the remedy."""


def write_grades_file(path, data):
    """Write a file for its owner alone, whole, over the old one; GradesFolderError: it cannot be written."""
    try:
        write_file(path, data, permissions=0o600)
    except OSError as error:
        raise GradesFolderError(f"{path}: cannot be written ({error.strerror})") from error


@contextlib.contextmanager
def open_grades_folder(folder):
    """Make a folder for its owner, lock it, remove unfinished files; GradesFolderError: it is in use."""
    with contextlib.ExitStack() as stack:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            folder.chmod(0o700)
            lock = stack.enter_context((folder / ".lock").open("w", encoding="ascii"))
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            for path in folder.rglob(".writing-*.tmp"):
                path.unlink(missing_ok=True)
        except BlockingIOError as error:
            message = f"{folder}: another run is writing into it; wait for its end, or name another --out"
            raise GradesFolderError(message) from error
        except OSError as error:
            raise GradesFolderError(f"{folder}: cannot be made ({error.strerror})") from error
        yield


class ResultStore:
    """Answers and results in a folder, by a digest of answers, key, and `options` such as the sandbox."""

    def __init__(self, folder, options):
        self._folder = Path(folder)
        self._not_graded = {}
        self._options = options | {"version": version("imgproc-course"), "format": _FORMAT}

    def keep_answers(self, key, lesson, answers):
        """Store answers until they are graded; returns their digest."""
        everything = json.dumps([key.digest, lesson, answers, self._options], sort_keys=True)
        digest = hashlib.sha256(everything.encode("ascii")).hexdigest()
        path = self._folder / f"{digest}.answers.json"
        if not path.exists():
            write_grades_file(path, json.dumps([key.digest, lesson, answers], sort_keys=True))
        return digest

    def answers(self, digest):
        """The stored answers: (digest of the key, lesson, {exercise id: source})."""
        return json.loads((self._folder / f"{digest}.answers.json").read_text(encoding="utf-8"))

    def keep_result(self, digest, result):
        """Store a GradedSubmission; one not graded is kept for this run alone: the next tries again."""
        if result.exercises_with(Outcome.NOT_GRADED):
            self._not_graded[digest] = result
            return
        write_grades_file(self._folder / f"{digest}.json", json.dumps(to_json(result), sort_keys=True))

    def result(self, digest):
        """The GradedSubmission, or None if there is none yet or its file is damaged."""
        if digest in self._not_graded:
            return self._not_graded[digest]
        try:
            return from_json(json.loads((self._folder / f"{digest}.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, KeyError, TypeError):
            return None


def answers_to_regrade(targets, learners, names, answer_keys, *, fresh=False):
    """What is graded again though it has a result: {digest of answers: exercise ids, or None for all}.

    `targets` are names or anonymous ids of learners, lessons, ids of exercises; ValueError: one is none of
    them. `names` are {name or anonymous id: the learner's name}; `fresh`: everything is graded again.
    """
    lessons = {exercise.id: name for name, exercise in _graded_exercises(answer_keys)}
    again = {}
    for target in targets:
        lesson = lessons.get(target) or lesson_name(target)
        if target not in names and lesson not in answer_keys.lessons:
            text = f"--regrade {target[:60]!r}: no learner, lesson or exercise has this name"
            raise ValueError(f"{text}; the lessons are {', '.join(answer_keys.lessons)}")
        for digest in _digests(learners, names.get(target), lesson):
            everything = target not in lessons or again.get(digest, set()) is None
            again[digest] = None if everything else again.get(digest, set()) | {target}
    return dict.fromkeys(_digests(learners)) if fresh else again


def _graded_exercises(answer_keys):
    for key in answer_keys.keys:
        for name, lesson in key.lessons.items():
            yield from ((name, exercise) for exercise in lesson.exercises if not exercise.practice)


def _digests(learners, name=None, lesson=None):
    """The digests of all answers; of one learner, or else of one lesson."""
    digests = {
        digest
        for learner in learners
        for graded_lesson, digest in learner.digests.items()
        if (learner.name == name if name else lesson in (None, graded_lesson))
    }
    return sorted(digests)


def grade_missing(learners, answer_keys, store, again, *, quiet, on_result, **options):
    """Grade what has no result, and `again`, equal answers once; how many submissions were graded now."""
    digests = _digests(learners)
    stored = {digest: store.result(digest) for digest in digests}
    missing = [digest for digest in digests if digest in again or stored[digest] is None]
    done, about = len(digests) - len(missing), {"desc": "grading", "unit": " submissions"}
    with tqdm(total=len(digests), initial=done, disable=quiet, **about) as bar:
        threading.Thread(target=show_time, args=(bar,), daemon=True).start()
        exercises = {digest: again.get(digest) if stored[digest] else None for digest in missing}
        keys = {digest: answer_keys.key_of(store.answers(digest)[0]) for digest in missing}
        for result in autograde(_submissions(exercises, store), keys, **options):
            if exercises[result.name]:
                result = _with_old_exercises(result, stored[result.name], exercises[result.name])
            store.keep_result(result.name, result)
            bar.update()
            on_result(result.name)
    return len(missing)


def show_time(bar):
    """Show each second that passes: a submission whose robot drives takes a minute."""
    while not bar.disable:  # a closed bar is disabled
        time.sleep(1)
        bar.refresh()


def _submissions(exercises, store):
    """(digest, lesson, answers) of the answers that are to be graded."""
    for digest, ids in exercises.items():
        _, lesson, answers = store.answers(digest)
        yield digest, lesson, {id: source for id, source in answers.items() if not ids or id in ids}


def _with_old_exercises(result, stored, ids):
    """A new result, with the stored results of the exercises that were not graded again."""
    exercises = zip(result.exercises, stored.exercises, strict=True)
    return replace(result, exercises=tuple(new if new.id in ids else old for new, old in exercises))
