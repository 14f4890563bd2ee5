"""The folder of results: every result is stored at once, so an interrupted run continues where it stopped."""

import json
from importlib.metadata import version
from pathlib import Path

from tqdm import tqdm

from imgproc_course.authoring.atomic_write import write_file
from imgproc_course.autograder.pool import autograde
from imgproc_course.autograder.results import from_json, to_json
from imgproc_course.gradebook.learners import digest_of_answers

_FORMAT = 2  # of the files in the folder


class GradesFolderError(ValueError):
    """A folder of grades cannot be written; the message is one line with the remedy."""


def write_grades_file(path, data):
    """Write a file that only its owner can read, whole: a reader finds the old file or the new one.

    Parameters
    ----------
    path : Path
    data : str or bytes

    Raises
    ------
    GradesFolderError : the disk is full or read-only
    """
    try:
        write_file(path, data, permissions=0o600)
    except OSError as error:
        raise GradesFolderError(f"{path}: cannot be written ({error.strerror})") from error


def make_private_folder(folder):
    """Make a folder that only its owner can open.

    Raises
    ------
    GradesFolderError : it cannot be made
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as error:
        raise GradesFolderError(f"{folder}: cannot be made ({error.strerror})") from error


class ResultStore:
    """Answers and their results in a folder, by a digest of answers, key and options.

    Parameters
    ----------
    folder : Path
    options : dict of what a result depends on besides key and answers: the kernel, the sandbox
    """

    def __init__(self, folder, options):
        self._folder = Path(folder)
        self._options = options | {"version": version("imgproc-course"), "format": _FORMAT}

    def keep_answers(self, key, lesson, answers):
        """Store answers until they are graded; returns their digest."""
        digest = digest_of_answers(key, lesson, answers, self._options)
        path = self._folder / f"{digest}.answers.json"
        if not path.exists():
            write_grades_file(path, json.dumps([key.digest, lesson, answers], sort_keys=True))
        return digest

    def answers(self, digest):
        """The stored answers: (digest of the key, lesson, {exercise id: source})."""
        return json.loads((self._folder / f"{digest}.answers.json").read_text(encoding="utf-8"))

    def keep_result(self, digest, result):
        """Store a GradedSubmission."""
        write_grades_file(self._folder / f"{digest}.json", json.dumps(to_json(result), sort_keys=True))

    def result(self, digest):
        """The GradedSubmission, or None if there is none yet or its file is damaged."""
        try:
            return from_json(json.loads((self._folder / f"{digest}.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, KeyError, TypeError):
            return None


def grade_missing(learners, answer_keys, store, *, fresh=False, quiet=None, **options):
    """Grade what has no result yet. Equal answers are graded once.

    Parameters
    ----------
    learners : list of Learner
    answer_keys : AnswerKeys
    store : ResultStore
    fresh : bool, grade again what has a result
    quiet : bool or None, as tqdm's `disable`
    options : as `autograde` takes them

    Returns
    -------
    int, how many were graded now

    Raises
    ------
    SandboxError : there is no sandbox here
    """
    submissions = [submission for learner in learners for submission in learner.submissions.values()]
    digests = sorted({submission.answers_digest for submission in submissions} - {""})
    missing = [digest for digest in digests if fresh or store.result(digest) is None]
    with tqdm(
        total=len(digests),
        initial=len(digests) - len(missing),
        desc="grading",
        unit=" submissions",
        disable=quiet,
    ) as bar:
        for key in answer_keys.keys:
            for result in autograde(_submissions_of_key(missing, key, store), key, **options):
                store.keep_result(result.name, result)
                bar.update()
    return len(missing)


def _submissions_of_key(digests, key, store):
    """(digest, lesson, answers) of the answers that are graded with that key."""
    for digest in digests:
        key_digest, lesson, answers = store.answers(digest)
        if key_digest == key.digest:
            yield digest, lesson, answers
