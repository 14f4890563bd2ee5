"""From a folder of submissions to grades: judged once, kept, and written the same each time.

grades/grades.json        everything, as grades.schema.json says; no time of day, no order, no chance in it
grades/grades.csv         a row a learner and lesson, for a spreadsheet
grades/summary.html       the teacher's page
grades/learners/*.html    a page a learner, to be handed back
grades/exports/*.csv      for Moodle, Canvas, and what reads nbgrader's table
grades/judged/*.json      every result, by a digest of (key, answers): an interrupted run goes on from here
"""

import json
from importlib.metadata import version
from pathlib import Path

from tqdm import tqdm

from imgproc_course.authoring.atomic_write import write_file
from imgproc_course.autograder.pool import autograde
from imgproc_course.gradebook.learners import digest_of_answers
from imgproc_course.gradebook.submission import Finding

FORMAT = 1
SCHEMA = Path(__file__).with_name("grades.schema.json")
_CASE = ("id", "title", "hidden", "points", "got", "outcome", "hint", "said")


class GradesFolderError(ValueError):
    """A folder that cannot be written; one line with the remedy."""


def write_whole(path, data):
    """Write a file at once: whoever reads it finds the old one or the new one.

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


class Store:
    """The folder of answers and results, by digest.

    Parameters
    ----------
    folder : Path
    how : dict, what a result depends on besides key and answers: the kernel, the sandbox
    """

    def __init__(self, folder, how):
        self._folder, self._how = Path(folder), how | {"version": version("imgproc-course"), "format": FORMAT}

    def keep_answers(self, key, lesson, answers):
        """Keep answers until they are judged; gives their digest."""
        digest = digest_of_answers(key, lesson, answers, self._how)
        path = self._folder / f"{digest}.answers.json"
        if not path.exists():
            write_whole(path, json.dumps([key.digest, lesson, answers], sort_keys=True))
        return digest

    def answers(self, digest):
        """(digest of the key, lesson, answers)."""
        return json.loads((self._folder / f"{digest}.answers.json").read_text(encoding="utf-8"))

    def keep_result(self, digest, result):
        """Keep a result."""
        write_whole(self._folder / f"{digest}.json", json.dumps(result, sort_keys=True))

    def result(self, digest):
        """The result, or None where there is none yet, or half a one."""
        try:
            result = json.loads((self._folder / f"{digest}.json").read_text(encoding="utf-8"))
            return result if isinstance(result["got"], int) and result["exercises"] is not None else None
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def has_result(self, digest):
        return self.result(digest) is not None


def judge_all(learners, answer_keys, store, *, afresh=False, quiet=None, **options):
    """Judge what is not judged yet; each result is kept at once. Equal answers are judged once.

    Parameters
    ----------
    learners : list of Learner
    answer_keys : AnswerKeys
    store : Store
    afresh : bool, judge again what was judged before
    quiet : bool or None, as tqdm's `disable`
    options : as `autograde` takes them

    Returns
    -------
    int, how many were judged now

    Raises
    ------
    SandboxError : there is no sandbox here
    """
    counting = [each for learner in learners for each in learner.submissions.values()]
    wanted = sorted({each.answers_digest for each in counting if each.answers_digest})
    missing = [digest for digest in wanted if afresh or not store.has_result(digest)]
    with tqdm(
        total=len(wanted),
        initial=len(wanted) - len(missing),
        desc="grading",
        unit=" submissions",
        disable=quiet,
    ) as bar:
        for key in answer_keys.keys:
            handed = (
                (digest, lesson, answers)
                for digest, (of, lesson, answers) in ((each, store.answers(each)) for each in missing)
                if of == key.digest
            )
            for result in autograde(handed, key, **options):
                digest = result.pop("submission")
                store.keep_result(digest, result)
                bar.update()
    return len(missing)


# ---------------------------------------------------------------- what grades.json holds


def grades_of(learners, answer_keys, store, *, sandbox, deadline=None, ignored=()):
    """What grades.json holds.

    Parameters
    ----------
    learners : list of Learner, all judged
    answer_keys : AnswerKeys
    store : Store
    sandbox : bool, whether answers ran in one
    deadline : datetime or None
    ignored : list of str, files that are no notebooks

    Returns
    -------
    dict, see grades.schema.json
    """
    return {
        "format": FORMAT,
        "course": version("imgproc-course"),
        "sandbox": sandbox,
        "deadline": deadline.isoformat() if deadline else None,
        "keys": [_key_entry(key) for key in answer_keys.keys],
        "learners": [_learner_entry(learner, answer_keys, store) for learner in learners],
        "ignored": list(ignored),
    }


def _key_entry(key):
    lessons = [
        {"lesson": name, "title": each.title, "version": each.version, "points": each.points}
        for name, each in sorted(key.lessons.items())
    ]
    return {"digest": key.digest, "lessons": lessons}


def _learner_entry(learner, answer_keys, store):
    lessons = [
        _lesson_entry(learner.submissions[name], learner.earlier.get(name, ()), answer_keys, store)
        for name in sorted(learner.submissions)
    ]
    lessons += [_lesson_entry(each, (), answer_keys, store) for each in learner.unidentified]
    return {
        "name": learner.name,
        "page": f"learners/{learner.page}",
        "got": sum(each["got"] for each in lessons),
        "points": sum(each["points"] for each in lessons),
        "lessons": lessons,
    }


def _lesson_entry(submission, earlier, answer_keys, store):
    content = submission.content
    graded = bool(submission.answers_digest)
    lesson = (submission.key or answer_keys).lessons.get(submission.lesson)
    result = store.result(submission.answers_digest) if graded else None
    notices = [*content.findings, *(_claims(content, result) if result else ())]
    return {
        "lesson": submission.lesson,
        "title": lesson.title if lesson else "",
        "status": "graded" if graded else "not graded",
        "reason": content.reason,
        "got": result["got"] if result else 0,
        "points": lesson.points if lesson else 0,
        "version": content.version,
        "key": submission.key.digest if submission.key else None,
        **_file_entry(submission),
        "notices": [{"kind": each.kind, "exercise": each.exercise, "text": each.text} for each in notices],
        "exercises": [_exercise_entry(each) for each in result["exercises"]] if result else [],
        "earlier": [_file_entry(each) | {"reason": each.content.reason} for each in earlier],
    }


def _file_entry(submission):
    file = submission.file
    return {
        "source": file.source,
        "sha256": submission.file_digest or None,
        "handed_in": file.submitted_at.isoformat() if file.submitted_at else None,
        "late": submission.late,
        "platform": file.platform,
        "platform_id": file.platform_id,
    }


def _exercise_entry(exercise):
    """The result without the values: those stand in the learner's page and in judged/."""
    cases = [{name: case[name] for name in _CASE} for case in exercise["cases"]]
    return {name: value for name, value in exercise.items() if name != "cases"} | {"cases": cases}


def _claims(content, result):
    """Stored outputs that say something else than grading found; often only an answer changed afterwards."""
    for exercise in result["exercises"]:
        public = [case for case in exercise["cases"] if not case["hidden"]]
        if exercise["id"] in content.claims and any(case["outcome"] != "passed" for case in public):
            text = "its stored output says that every check passes, and grading finds that not every one does"
            yield Finding("odd", exercise["id"], text)


def as_text(grades):
    """grades.json's text: the same for the same grades."""
    return json.dumps(grades, indent=1, sort_keys=True, ensure_ascii=True) + "\n"


def needs_a_look(grades):
    """How many hand-ins could not be graded, or were not judged."""
    count = 0
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            outcomes = {case["outcome"] for each in lesson["exercises"] for case in each["cases"]}
            count += lesson["status"] != "graded" or "not judged" in outcomes
    return count


def make_private(folder):
    """Make a folder that only its owner can look into."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as error:
        raise GradesFolderError(f"{folder}: cannot be made ({error.strerror})") from error
