"""Write the folder of grades; docs/teach/reference.md says what is in it.

results/*.json has every result, by a digest of key and answers: an interrupted run continues from there. The
grades that differed last are in grades.previous.json.
"""

import json
from functools import partial
from pathlib import Path

from ..autograder.sanitize import sanitize_line
from .grades_json import FORMAT, grades_text, learner_entry, learner_without_name, without_names
from .lms_export import feedback_zips, grades_csv
from .report import count_of, learner_page, points_text
from .result_store import write_grades_file
from .review import FOLDER, AnswerParts, review_pages
from .summary import summary_page

PREVIOUS = "grades.previous.json"
_MOST_CHANGES = 20  # lines
_NOT_THERE = "not there"


class LearnerPages:
    """Writes the learners' pages, each as soon as all its results are there: the workers grade on meanwhile.

    entries  {learner's name: entry in grades.json}
    failed   {learner's name as pages show it: why their page lacks its details}
    parts    the AnswerParts for the teacher's pages
    solutions  gives {exercise: solution} of a lesson
    """

    def __init__(self, out, learners, answer_keys, store, rules, *, anonymous=False):
        self.entries, self.failed, self.parts = {}, {}, AnswerParts(out)
        self._out, self._learners, self._answer_keys, self._store = out, learners, answer_keys, store
        self._rules, self._anonymous, self.solutions = rules, anonymous, answer_keys.solutions
        self._missing = {learner.name: set(learner.digests.values()) for learner in learners}

    def result_stored(self, digest):
        """Write the pages that waited only for this result."""
        for learner in self._learners:
            missing = self._missing[learner.name]
            if digest in missing:
                missing.discard(digest)
                if not missing:
                    self._write(learner)

    def finish(self):
        """Write all other pages, and remove those of an earlier run; returns the entries of all learners."""
        for learner in self._learners:
            if learner.name not in self.entries:
                self._write(learner)
        pages = {Path(entry["page"]).name for entry in self.entries.values()}
        _remove_others(self._out / "learners", "*.html", pages)
        return [self.entries[learner.name] for learner in self._learners]

    def _write(self, learner):
        entry = learner_entry(learner, self._answer_keys, self._store, self._rules, anonymous=self._anonymous)
        self.entries[learner.name] = entry
        page_entry = learner_without_name(entry) if self._anonymous else entry
        policy = self._rules.policy
        try:
            results = {lesson: self._store.result(digest) for lesson, digest in learner.digests.items()}
            keep = partial(self._keep_parts, learner)
            page = learner_page(page_entry, results, self._answer_keys, policy, keep=keep)
        except Exception as error:  # noqa: BLE001 - a page shows values that other people's code returned
            self.failed[page_entry["name"]] = sanitize_line(f"{type(error).__name__}: {error}", 200)
            page = learner_page(page_entry, {}, self._answer_keys, policy, incomplete=True)
        write_grades_file(self._out / entry["page"], page)

    def _keep_parts(self, learner, lesson, exercises):
        """Keep what the teacher's pages show of a lesson's answers; the lesson may have none."""
        digest = learner.digests.get(lesson)
        answers = self._store.page(digest)[2]["answers"] if digest else {}
        for exercise in exercises:
            self.parts.keep(learner.name, exercise["id"], answers.get(exercise["id"], ""), exercise["review"])


def write_grades(out, grades, pages):
    """Write all but the results and the learners' pages.

    Returns the lines that say whose points changed since the run before.
    """
    before, text = read_grades(out / "grades.json"), grades_text(grades)
    write_grades_file(out / "grades.json", text)
    write_grades_file(out / "grades.csv", grades_csv(grades))
    page_grades = without_names(grades) if grades["anonymous_pages"] else grades
    entries = zip(page_grades["learners"], grades["learners"], strict=True)
    names = {shown_entry["name"]: entry["name"] for shown_entry, entry in entries}
    if before is not None and grades_text(before) != text:
        write_grades_file(out / PREVIOUS, grades_text(before))
    _write_review(out, page_grades, pages.parts, names, pages.solutions)
    files = feedback_zips(grades, lambda entry: (out / entry["page"]).read_bytes())
    for name, data in files.items():
        write_grades_file(out / "exports" / name, data)
    for pattern in ("*.csv", "*.zip"):
        _remove_others(out / "exports", pattern, files)
    write_grades_file(out / "summary.html", summary_page(page_grades, pages.failed))
    return changed_points(before, grades) if before else []


def _write_review(out, *about):
    written = set()
    for name, page in review_pages(*about):
        written.add(Path(name).name)
        write_grades_file(out / name, page)
    _remove_others(out / FOLDER, "*.html", written)
    _remove_others(out, "review.html", written)


def _remove_others(folder, pattern, names):
    """Remove the files of an earlier run: pages of learners who are gone would be given back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in names:
            path.unlink()


def read_grades(path):
    """The content of a grades.json, or None if there is none in today's format."""
    try:
        grades = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return grades if isinstance(grades, dict) and grades.get("format") == FORMAT else None


def changed_points(before, after):
    """Lines for the terminal: each lesson whose points differ in two contents of grades.json."""
    old, new = map(_points_of_lessons, (before, after))
    lines = [
        f"  {name}: {lesson}: {old.get((name, lesson), _NOT_THERE)} → {new.get((name, lesson), _NOT_THERE)}"
        for name, lesson in sorted(old.keys() | new.keys())
        if old.get((name, lesson)) != new.get((name, lesson))
    ]
    first = f"{count_of(len(lines), 'lesson')} with other points than in the run before ({PREVIOUS}):"
    more = [f"  and {len(lines) - _MOST_CHANGES} more"] if len(lines) > _MOST_CHANGES else []
    return [first, *lines[:_MOST_CHANGES], *more] if lines else []


def _points_of_lessons(grades):
    return {
        (learner["name"], lesson["lesson"] or lesson["file"]): _points(lesson)
        for learner in grades["learners"]
        for lesson in learner["lessons"]
    }


def _points(lesson):
    if lesson["status"] == "not graded":
        return f"not graded: {lesson['reason']}"
    if lesson.get("decision") and lesson["decision"]["excused"]:
        return "excused"
    text = points_text(lesson)
    if lesson.get("late_deduction"):
        text += f", {lesson['late_deduction']} deducted because late"
    decided = f", decided by hand; the autograder gives {lesson.get('autograded_points')}"
    return text + (decided if lesson.get("decision") else "")
