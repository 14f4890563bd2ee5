"""The teacher's page: totals, who may have lost points unfairly, the checks that most learners fail."""

import csv
import io
import statistics
from collections import Counter
from pathlib import PurePosixPath

from imgproc_course.classroom.autograder.outcomes import CELL_FAILS, TEXTS, Outcome
from imgproc_course.classroom.autograder.sanitize import spreadsheet_text
from imgproc_course.classroom.gradebook.grades_json import lesson_names
from imgproc_course.classroom.gradebook.report import count_of, finding_text, render_page

_BIN_COUNT = 10
_MOST_UNKNOWN = 3  # files of one learner that belong to no lesson
_MOST_MOVED = 2  # answers whose place is told for each
_PERHAPS_UNFAIR = {Outcome.NOT_GRADED, Outcome.MEMORY, Outcome.OUTPUT}
_PERHAPS_DISHONEST = {Outcome.HOSTILE, Outcome.CRASHED, Outcome.REFUSED_MODULE}


def summary_page(grades, failed_pages=(), other_pages=()):
    """The teacher's page, HTML.

    `failed_pages` are {learner's name: why their page lacks its details}, `other_pages` {file name: title}.
    """
    submissions = [(learner, lesson) for learner in grades["learners"] for lesson in learner["lessons"]]
    submitted = {lesson["lesson"] for _, lesson in submissions}
    names = [name for name in lesson_names(grades) if name in submitted]
    graded = [(learner, lesson) for learner, lesson in submissions if lesson["status"] == "graded"]
    percentages = [_percentage(learner) for learner in grades["learners"] if learner["max_points"]]
    own_modules = {PurePosixPath(path).stem for path in grades["ignored"] if path.endswith(".py")}
    concerns = list(_concerns(submissions, own_modules))
    return render_page(
        "summary.html",
        grades=grades,
        failed_pages=dict(failed_pages),
        other_pages=dict(other_pages),
        lessons=list(_lesson_rows(graded, names)),
        submission_count=len(submissions),
        graded_count=len(graded),
        late_count=sum(lesson["late"] for _, lesson in submissions),
        bins=_histogram(percentages),
        mean=round(statistics.fmean(percentages)) if percentages else 0,
        median=round(statistics.median(percentages)) if percentages else 0,
        checks=_check_rows(graded),
        mistakes=_mistake_counts(graded),
        unfair=[concern for concern in concerns if concern["list"] == "unfair"],
        dishonest=[concern for concern in concerns if concern["list"] == "dishonest"],
        others=[concern for concern in concerns if concern["list"] == "other"],
        broken=[concern for concern in concerns if concern["list"] == "broken"],
        names=names,
        senders=[finding for finding in grades["intake"] if finding["kind"] != "file"],
        other_files=[finding for finding in grades["intake"] if finding["kind"] == "file"],
    )


# ---------------------------------------------------------------- what to look at


def _concerns(submissions, own_modules):
    """What the teacher should look at: dicts with the list it belongs to, the texts, and a line to copy.

    What cost nothing is one entry for each submission. `own_modules` are files that were submitted too.
    """
    unknown = Counter(learner["page"] for learner, lesson in submissions if not lesson["lesson"])
    listed = Counter()
    for learner, lesson in submissions:
        if lesson["decision"]:
            continue
        if not lesson["lesson"]:
            listed[learner["page"]] += 1
            if (
                listed[learner["page"]] > _MOST_UNKNOWN
            ):  # a hundred files of one learner would hide all others
                continue
            left_out = unknown[learner["page"]] - _MOST_UNKNOWN
            if listed[learner["page"]] == _MOST_UNKNOWN and left_out > 0:
                files = count_of(left_out, "more file")
                lesson = lesson | {"reason": f"{lesson['reason']}; {files} of theirs could not be graded"}
        grouped = {}
        for name, exercise, text in _concerns_of(lesson, own_modules):
            grouped.setdefault((name, exercise if name != "other" else ""), []).append(text)
        entries = {exercise["id"]: exercise for exercise in lesson["exercises"]}
        for (name, id), texts in grouped.items():
            entry = entries.get(id, lesson)
            if not entry["decision"]:
                yield {
                    "list": name,
                    "learner": learner,
                    "lesson": lesson,
                    "texts": _texts_in_short(list(dict.fromkeys(texts))),
                    "points": entry["points"],
                    "max_points": entry["max_points"],
                    "line": _line_to_copy(name, learner, lesson, id if id in entries else "", entry),
                }


def _texts_in_short(texts):
    """The texts; those about answers without marks as one, because some tools remove the marks of all."""
    moved = [
        text for text in texts if ": graded from another cell (" in text and text.endswith(" is missing")
    ]
    if len(moved) <= _MOST_MOVED:
        return texts
    exercises = ", ".join(text.partition(":")[0] for text in moved)
    short = "its answers were found by the names of their functions, because their answer cells are missing"
    return [*(text for text in texts if text not in moved), f"{short}: {exercises}"]


def _concerns_of(lesson, own_modules):
    """(list, exercise id or "", text) of everything unusual about one submission."""
    if lesson["status"] != "graded":
        yield "unfair", "", f"could not be graded: {lesson['reason']}"
    if lesson["late_deduction"] and not all(earlier["late"] for earlier in lesson["earlier"]):
        yield "unfair", "", "an earlier submission was in time, but the latest one counts"
    if lesson["late"] and not lesson["days_late"]:
        yield "other", "", "the platform says that it is late; by how much is unknown, so nothing is deducted"
    entries = {exercise["id"]: exercise for exercise in lesson["exercises"]}
    for finding in lesson["findings"]:
        if finding["exercise"] and finding["exercise"] not in entries:  # a practice exercise has no points
            yield "other", "", finding_text(finding)
            continue
        entry = entries.get(finding["exercise"], lesson)
        lost_points = entry["autograded_points"] < entry["max_points"]
        repeated = lesson["earlier"] and finding["text"].startswith("submitted ")
        # The results show what is wrong with an answer, and the table of learners what was submitted twice.
        if finding["kind"] == "odd":
            yield "dishonest", finding["exercise"], finding_text(finding)
        elif finding["kind"] == "message" and not repeated:
            yield ("unfair" if lost_points else "other"), finding["exercise"], finding_text(finding)
    for exercise in lesson["exercises"]:
        for outcome in sorted({Outcome(case["outcome"]) for case in exercise["cases"]}):
            if outcome in _PERHAPS_UNFAIR | _PERHAPS_DISHONEST:
                module = _refused_module(exercise["cases"]) if outcome is Outcome.REFUSED_MODULE else ""
                is_own = module.partition(".")[0] in own_modules
                text = f"{TEXTS[outcome].label}: {module}" if module else TEXTS[outcome].label
                if is_own:
                    text = f"it imports {module}, a file of their own; only notebooks are graded"
                name = "unfair" if outcome in _PERHAPS_UNFAIR or is_own else "dishonest"
                yield name, exercise["id"], f"{exercise['id']}: {text}"
        yield from _broken_cells(exercise, lesson["findings"])


def _broken_cells(exercise, findings):
    """An entry for an answer whose cell does not run, unless it is listed as a slip already."""
    messages = [case["message"] for case in exercise["cases"] if case["message"].startswith(CELL_FAILS)]
    about = [finding for finding in findings if finding["exercise"] == exercise["id"]]
    if messages and not any(finding["kind"] == "message" for finding in about):
        texts = [finding["text"] for finding in about if finding["kind"] == "answer"]
        yield "broken", exercise["id"], f"{exercise['id']}: {[*texts, *messages][0]}"


def _refused_module(cases):
    """The module that an answer must not use, as the messages of its cases name it, or ""."""
    messages = (case["message"] for case in cases if case["outcome"] == Outcome.REFUSED_MODULE)
    return next((message.rpartition(" ")[2] for message in messages if message), "")


def _line_to_copy(name, learner, lesson, exercise, entry):
    """The line of decisions.csv that gives full points, or none; "" where no lesson is known."""
    if not lesson["lesson"]:
        return ""
    points = entry["max_points"] if name == "unfair" else 0
    buffer = io.StringIO()
    cells = (learner["name"], lesson["lesson"], exercise, points, "looked at by hand")
    csv.writer(buffer, lineterminator="").writerow([spreadsheet_text(cell) for cell in cells])
    return buffer.getvalue()


# ---------------------------------------------------------------- totals


def _percentage(entry):
    return 100 * entry["points"] / entry["max_points"]


def _histogram(percentages):
    """[{low, high, count, height}] of ten bins; the last one includes 100."""
    counts = [0] * _BIN_COUNT
    for percentage in percentages:
        counts[min(int(percentage * _BIN_COUNT / 100), _BIN_COUNT - 1)] += 1
    highest = max(counts) or 1
    width = 100 // _BIN_COUNT
    return [
        {"low": k * width, "high": (k + 1) * width, "count": count, "height": round(100 * count / highest)}
        for k, count in enumerate(counts)
    ]


def _lesson_rows(graded, names):
    lessons_by_name = {name: [] for name in names}
    for _, lesson in graded:
        lessons_by_name[lesson["lesson"]].append(lesson)
    for name, lessons in lessons_by_name.items():
        if not lessons:
            continue
        percentages = [_percentage(lesson) for lesson in lessons if lesson["max_points"]]
        yield {
            "name": name,
            "title": lessons[0]["title"],
            "count": len(lessons),
            "max_points": max(lesson["max_points"] for lesson in lessons),
            "mean": round(statistics.fmean(percentages)) if percentages else 0,
            "median": round(statistics.median(percentages)) if percentages else 0,
            "full": sum(lesson["points"] == lesson["max_points"] for lesson in lessons),
        }


def _check_rows(graded):
    """One row per check, those that most learners fail first."""
    rows = {}
    for _, lesson in graded:
        for exercise in lesson["exercises"]:
            for case in exercise["cases"]:
                row = rows.setdefault(
                    (lesson["lesson"], exercise["id"], case["id"]),
                    {
                        "lesson": lesson["lesson"],
                        "exercise": exercise["title"],
                        "title": case["title"],
                        "hidden": case["hidden"],
                        "passed": 0,
                        "attempted": 0,
                        "count": 0,
                    },
                )
                row["count"] += 1
                row["passed"] += case["outcome"] == Outcome.PASSED
                row["attempted"] += case["outcome"] not in (Outcome.NOT_ATTEMPTED, Outcome.MISSING)
    for row in rows.values():
        row["share"] = round(100 * row["passed"] / row["count"])
    return sorted(rows.values(), key=lambda row: (row["share"], row["title"]))


def _mistake_counts(graded):
    """[((lesson, exercise's title, mistake, explanation), count)], the most frequent mistake first."""
    counts = {}
    for _, lesson in graded:
        for exercise in lesson["exercises"]:
            if exercise["mistake"]:
                mistake = (exercise["mistake"], exercise["mistake_explanation"])
                entry = (lesson["lesson"], exercise["title"], *mistake)
                counts[entry] = counts.get(entry, 0) + 1
    return sorted(counts.items(), key=lambda item: (-item[1], item[0]))
