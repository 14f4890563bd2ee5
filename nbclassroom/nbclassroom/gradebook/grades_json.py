"""What grades.json contains: everything that a run knows. Other names of its fields need another FORMAT.

There is no time of day, no order of files and no chance in it: the same submissions give the same bytes.
"""

import copy
import hashlib
import json
import re
from dataclasses import asdict
from pathlib import Path

from .. import course
from ..autograder.outcomes import Outcome
from ..autograder.results import GradedSubmission, to_json
from .collect import SubmittedFile
from .submission import Finding, Submission
from .teacher_tables import plain_number

FORMAT = 8
_SHORTEST = 3  # characters of a name that pages without names leave out of texts


def grades_of(entries, answer_keys, rules, collection, about):
    """The content of grades.json; `entries` are from `learner_entry`.

    `about` has the fields "sandbox", "anonymous_pages", "open_as_zero", and "roster" of `roster_report`.
    """
    return about | {
        "format": FORMAT,
        "course": course.release(),
        "deadline": rules.deadline.isoformat() if rules.deadline else None,
        "late_policy": rules.policy.text if rules.policy else None,
        "keys": [_key_entry(key) for key in answer_keys.keys],
        "learners": entries,
        "layout": collection.layout,
        "ignored": collection.ignored,
    }


def grades_text(grades):
    """The text of grades.json: the same for the same grades."""
    # One line per learner: json's own indentation is several times slower.
    learners = ",\n".join(json.dumps(learner, sort_keys=True) for learner in grades["learners"])
    head, tail = json.dumps(grades | {"learners": []}, sort_keys=True).split('"learners": []')
    return f'{head}\n"learners": [\n{learners}\n]{tail}\n'


def lesson_names(grades):
    """The names of the keys' lessons, in the order of the course."""
    numbers = {one["lesson"]: one["number"] for key in reversed(grades["keys"]) for one in key["lessons"]}
    return sorted(numbers, key=lambda name: (numbers[name], name))


def _key_entry(key):
    lessons = [
        {"lesson": lesson.name, "number": lesson.number, "title": lesson.title}
        | {"version": lesson.version, "max_points": lesson.points}
        for lesson in key.lessons.values()
    ]
    return {"digest": key.digest, "lessons": lessons}


def learner_entry(learner, answer_keys, store, rules, *, anonymous=False):
    """A graded learner's part of grades.json; `rules` are assigned TeacherRules."""
    decisions = rules.decisions.get(learner.name, ())
    submissions = [*learner.submissions.values(), *learner.unidentified]
    without_file = {decision.lesson for decision in decisions} - learner.submissions.keys()
    submissions += [_nothing_submitted(name, submissions) for name in without_file]
    lessons = [_lesson_entry(learner, submission, answer_keys, store, rules) for submission in submissions]
    for lesson in lessons:
        own = [decision for decision in decisions if decision.lesson == lesson["lesson"]]
        _settle_lesson(lesson, own, rules)
    page = answer_keys.anonymous_id(learner.name) if anonymous else page_name(learner.name)
    order = {name: (lesson.number, name) for name, lesson in answer_keys.lessons.items()}
    return {
        "name": learner.name,
        "page": f"learners/{page}.html",
        "points": plain_number(sum(lesson["points"] for lesson in lessons)),
        "max_points": sum(lesson["max_points"] for lesson in lessons),
        "open_points": sum(lesson["open_points"] for lesson in lessons),
        "lessons": sorted(lessons, key=lambda lesson: order.get(lesson["lesson"], ("~", lesson["file"]))),
    }


def page_name(name):
    """The name of a learner's page: safe on every system, and unique through a digest."""
    slug = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")[:40] or "learner"
    return f"{slug}-{hashlib.sha256(name.encode()).hexdigest()[:10]}"


def _settle_lesson(entry, decisions, rules):
    """Set the final points of a lesson's entry, which has those of the autograder.

    The teacher's decisions come first, then what lateness costs. A decision on an exercise replaces its
    points; an excused exercise counts neither for nor against. A decision on the whole lesson is final: it
    replaces its points, and lateness costs nothing more. Open points are those that only a person can give,
    and has not.
    """
    policy = rules.policy
    by_exercise = {decision.exercise: decision for decision in decisions}
    whole_lesson = by_exercise.pop("", None)
    entry["autograded_points"] = entry["points"]
    for exercise in entry["exercises"]:
        exercise["autograded_points"] = exercise["points"]
        texts, worths = [text for text, _ in exercise["rubric"]], rules.worths.get(exercise["id"], ())
        if len(worths) == len(texts):
            exercise["rubric"] = list(map(list, zip(texts, worths, strict=True)))
        is_decided = _decide(exercise, by_exercise.get(exercise["id"]))
        waiting = [] if is_decided else exercise["cases"]
        exercise["open_points"] = sum(one["max_points"] for one in waiting if one["outcome"] == Outcome.OPEN)
    if entry["exercises"]:
        entry["points"] = plain_number(sum(exercise["points"] for exercise in entry["exercises"]))
        entry["max_points"] = sum(exercise["max_points"] for exercise in entry["exercises"])
    entry["late_deduction"] = 0
    if _decide(entry, whole_lesson):
        entry["status"] = "graded"
        for exercise in entry["exercises"]:
            exercise["open_points"] = 0
    elif policy and entry["days_late"]:
        points = plain_number(entry["points"] * policy.factor(entry["days_late"]))
        entry["late_deduction"] = plain_number(entry["points"] - points)
        entry["points"] = points
    entry["open_points"] = sum(exercise["open_points"] for exercise in entry["exercises"])


def _decide(entry, decision):
    """Enter a decision, or None; returns whether it gives the points, and does not only comment."""
    entry["decision"] = None
    if decision is None:
        return False
    points, lines = decision.points, list(decision.lines)
    if lines and decision.mark == entry["mark"]:
        worth = sum(entry["rubric"][line - 1][1] for line in {*lines} - {0})
        points = min(max(worth, 0), entry["max_points"])
    entry["decision"] = {"points": points, "excused": decision.excused, "comment": decision.comment}
    if lines:
        entry["decision"] |= {"lines": lines, "is_outdated": points is None}
    if decision.excused:
        entry["points"] = entry["max_points"] = 0
    elif points is not None:
        entry["points"] = points
    return decision.excused or points is not None


def _nothing_submitted(lesson, submissions):
    """For a decision on a lesson not submitted; the learner's other submissions know the platform."""
    known = next((submission.file for submission in submissions), SubmittedFile())
    file = SubmittedFile(learner=known.learner, platform=known.platform, platform_id=known.platform_id)
    return Submission(lesson=lesson, reason="nothing was submitted", file=file)


def _lesson_entry(learner, submission, answer_keys, store, rules):
    lesson = (submission.key or answer_keys).lessons.get(submission.lesson)
    result = store.result(submission.answers_digest) if submission.answers_digest else None
    result = result or GradedSubmission("", "", ())
    attempts = [Finding("hostile", id, f"it tried to {text}") for id, text in result.tried]
    exercises = [to_json(one) | {"points": one.points} for one in result.exercises]
    for exercise in exercises:  # without their HTML: that is on the pages and in the store
        del exercise["body"], exercise["review"]
    earlier = learner.earlier.get(submission.lesson, ())
    earlier = [_file_entry(learner, one, rules) | {"reason": one.reason} for one in earlier]
    return {
        "lesson": submission.lesson,
        "title": lesson.title if lesson else "",
        "status": "graded" if submission.answers_digest else "not graded",
        "reason": submission.reason,
        "points": result.points,
        "max_points": lesson.points if lesson else 0,
        "version": submission.version,
        "key": submission.key.digest if submission.key else None,
        **_file_entry(learner, submission, rules),
        "findings": [asdict(finding) for finding in submission.findings + attempts],
        "exercises": exercises,
        "earlier": earlier,
    }


def _file_entry(learner, submission, rules):
    file = submission.file
    late, days_late = rules.lateness(learner.name, submission.lesson, file)
    return {
        "file": file.source,
        "sha256": submission.file_digest or None,
        "submitted_at": file.submitted_at.isoformat() if file.submitted_at else None,
        "late": late,
        "days_late": days_late,
        "platform": file.platform,
        "platform_id": file.platform_id,
    }


def without_names(grades):
    """A copy of grades for the pages: ids instead of names, and no names of files."""
    learners = [learner_without_name(entry) for entry in grades["learners"]]
    return grades | {"ignored": [], "roster": None, "learners": learners}


def learner_without_name(entry):
    """A copy of a learner's entry, as `without_names` has it."""
    learner = copy.deepcopy(entry)
    name, learner["name"] = learner["name"], Path(learner["page"]).stem
    for lesson in learner["lessons"]:
        files = [lesson["file"], *(earlier["file"] for earlier in lesson["earlier"])]
        texts = [*filter(None, files), *([name] if len(name) >= _SHORTEST else [])]
        for holder, key in [(lesson, "reason"), *((finding, "text") for finding in lesson["findings"])]:
            for text in texts:
                holder[key] = holder[key].replace(text, "…")
        for file in (lesson, *lesson["earlier"]):
            file["file"] = ""
    return learner
