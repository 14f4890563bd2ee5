"""The teacher's page: totals, who may have lost points unfairly, the checks that most learners fail."""

import statistics
from collections import Counter
from itertools import chain

from ..autograder.outcomes import CELL_FAILS, PHRASES, Outcome
from ..autograder.sanitize import spreadsheet_text
from ..exercises.running import MEANT
from .csv_table import csv_text
from .grades_json import lesson_names
from .platforms import lessons_of
from .report import finding_text, render_page, reviews_of
from .roster import squeezed
from .submission import EQUALS, ONE_LESSON
from .teacher_tables import plain_number

_MOST_UNKNOWN = 3  # files of one learner that belong to no lesson
_LIST_OF = dict.fromkeys((Outcome.NOT_GRADED, Outcome.MEMORY, Outcome.OUTPUT), "unfair")
_LIST_OF |= {Outcome.HOSTILE: "hostile", Outcome.CRASHED: "hostile", Outcome.REFUSED_MODULE: "modules"}


def summary_page(grades, failed_pages=()):
    """The teacher's page, HTML; `failed_pages` are {name: why}."""
    submissions = [lesson for learner in grades["learners"] for lesson in learner["lessons"]]
    submitted = {lesson["lesson"] for lesson in submissions}
    learners = [_with_handed_out(learner, grades, submitted) for learner in grades["learners"]]
    graded = [lesson for lesson in submissions if lesson["status"] == "graded"]
    missing = grades["roster"]["missing"] if grades["roster"] else ()
    written = {one["id"]: one for one in reviews_of(grades["learners"]) if one["rubric"]}
    return render_page(
        "summary.html",
        grades=grades,
        failed_pages=dict(failed_pages),
        offered=len(lesson_names(grades)),
        names=[name for name in lesson_names(grades) if name in submitted],
        submissions=submissions,
        graded=graded,
        waiting=written.values(),
        bins=_histogram(_percentages(learners)),
        learners=learners,
        checks=_check_rows(graded, written),
        mistakes=_mistake_counts(graded),
        sent={name: sum(squeezed(name) in squeezed(path) for path in grades["ignored"]) for name in missing},
        **_mean_and_median(learners),
        **_lists_of_concerns(grades["learners"]),
        equal=_equal_to_solution(grades["learners"]),
        lessons=list(_lesson_rows(graded, lesson_names(grades))),
    )


def _lists_of_concerns(learners):
    """{list: what the teacher should look at in it}."""
    names = "unfair hostile dishonest others broken modules"
    lists: dict[str, list] = {name: [] for name in names.split()}
    for learner in learners:
        # Those not decided; a hundred files that belong to no lesson would hide all other learners'.
        unknown = [lesson for lesson in learner["lessons"] if not lesson["lesson"]][:_MOST_UNKNOWN]
        known = [lesson for lesson in learner["lessons"] if lesson["lesson"] and not lesson["decision"]]
        for lesson in known + unknown:
            for name, concern in _concerns(learner, lesson):
                lists[name].append(concern)
    return lists


def _equal_to_solution(learners):
    """{exercise id: learners whose answer equals the solution, and is not decided}."""
    found: dict[str, list] = {}
    for learner in learners:
        for lesson in learner["lessons"]:
            decided = {one["id"] for one in lesson["exercises"] if one["decision"] or lesson["decision"]}
            equal = {one["exercise"] for one in lesson["findings"] if one["text"] == EQUALS}
            for id in sorted(equal - decided):
                found.setdefault(id, []).append(learner)
    return found


def _concerns(learner, lesson):
    """(list, what the page shows of a concern); what cost nothing is one entry for each submission."""
    grouped: dict[tuple, dict] = {}
    about_answers = chain(_about_exercises(lesson), _about_broken_cells(lesson))
    for name, exercise, text in chain(_about_submission(lesson), _about_findings(lesson), about_answers):
        texts = grouped.setdefault((name, exercise if name != "others" else ""), {})
        texts[text] = None
    entries = {exercise["id"]: exercise for exercise in lesson["exercises"]}
    for (name, id), texts in grouped.items():
        entry = entries.get(id, lesson)
        if not entry["decision"]:
            others = [(one, entries[one]) for one in _failing_alike(lesson, id)]
            pairs = ((id if id in entries else "", entry), *others)
            line = "\n".join(filter(None, (_line_to_copy(name, learner, lesson, *pair) for pair in pairs)))
            about = {"learner": learner, "lesson": lesson, "entry": entry, "line": line}
            yield name, about | {"texts": list(texts)}


# This and the next three yield (list, exercise id or "", text) of what is unusual about one submission.
def _about_submission(lesson):
    if lesson["status"] != "graded":
        yield "unfair", "", f"could not be graded: {lesson['reason']}"
    in_time = [earlier for earlier in lesson["earlier"] if not earlier["late"] and not earlier["reason"]]
    if lesson["late"] and in_time and lesson["points"] < lesson["max_points"]:
        yield "unfair", "", "an earlier submission was in time, but the latest one counts"
    if lesson["late"] and not lesson["days_late"]:
        text = "the platform says that it is late; by how much is unknown, so nothing is deducted"
        yield "others", "", text


def _about_findings(lesson):
    """The results show what is wrong with an answer, and the table of learners what was submitted twice."""
    entries = {exercise["id"]: exercise for exercise in lesson["exercises"]}
    for finding in lesson["findings"]:
        entry = entries.get(finding["exercise"], lesson)
        lost_points = entry["autograded_points"] + entry["open_points"] < entry["max_points"]
        lost_points |= finding["text"].endswith(ONE_LESSON)
        repeated = lesson["earlier"] and finding["text"].startswith("submitted ")
        if finding["exercise"] and entry is lesson:  # a practice exercise has no points
            yield "others", "", finding_text(finding)
        elif finding["kind"] == "hostile":
            is_hostile = finding["exercise"] or lost_points  # in cells of their own learners download and try
            yield ("hostile" if is_hostile else "others"), finding["exercise"], finding_text(finding)
        elif finding["kind"] == "odd" and finding["text"] != EQUALS:
            yield "dishonest", finding["exercise"], finding_text(finding)
        elif finding["kind"] == "message" and not repeated:
            yield ("unfair" if lost_points else "others"), finding["exercise"], finding_text(finding)


def _about_exercises(lesson):
    for exercise in lesson["exercises"]:
        id, cases = exercise["id"], exercise["cases"]
        if exercise["cause"] not in ("", id):  # it is told with that one
            continue
        outcomes = sorted({Outcome(case["outcome"]) for case in cases} & _LIST_OF.keys())
        for outcome in outcomes:
            is_module = outcome is Outcome.REFUSED_MODULE  # as the messages of its cases name it
            messages = [case["message"] for case in cases if is_module and case["outcome"] == outcome]
            module = next(filter(None, messages), "").rpartition(" ")[2]
            text = f"{PHRASES[outcome]}: {module}" if module else PHRASES[outcome]
            yield _LIST_OF[outcome], id, f"{id}: {text}"
        is_elsewhere = exercise["cause"] and exercise["message"]
        if is_elsewhere:
            yield "unfair", id, f"{id}: {exercise['message']}"
        for message in () if is_elsewhere else [case["message"] for case in cases]:
            # `retrun (x)` is a call of a name that nothing has; the public checks say which name was meant.
            if message.startswith("NameError") and MEANT in message:
                yield "unfair", id, f"{id}: {message}"
        if alike := _failing_alike(lesson, id):
            name = "modules" if Outcome.REFUSED_MODULE in outcomes else "unfair"
            yield name, id, f"for the same reason: {', '.join(alike)}"


def _failing_alike(lesson, id):
    """The ids of the exercises whose cause this one tells."""
    return [one["id"] for one in lesson["exercises"] if id and one["cause"] == id != one["id"]]


def _about_broken_cells(lesson):
    """An answer whose cell does not run, unless it is listed as a slip already."""
    for exercise in lesson["exercises"]:
        messages = [case["message"] for case in exercise["cases"] if case["message"].startswith(CELL_FAILS)]
        about = [finding for finding in lesson["findings"] if finding["exercise"] == exercise["id"]]
        is_told = exercise["cause"] not in ("", exercise["id"])
        if messages and not is_told and not any(finding["kind"] == "message" for finding in about):
            texts = [finding["text"] for finding in about if finding["kind"] == "answer"]
            yield "broken", exercise["id"], f"{exercise['id']}: {[*texts, *messages][0]}"


def _line_to_copy(name, learner, lesson, exercise, entry):
    """The line of decisions.csv that takes back an unfair loss; "" where no lesson is known.

    Where nothing tells how many points are fair, "?" stands for them, which no run accepts.
    """
    if not lesson["lesson"]:
        return ""
    points = entry["max_points"] if exercise else plain_number(entry["points"] + entry["late_deduction"])
    is_known = exercise or entry["late_deduction"]
    if name in ("hostile", "dishonest", "modules") or lesson["status"] != "graded" or not is_known:
        points = "?"
    cells = (learner["name"], lesson["lesson"], exercise, points, "looked at by hand")
    return csv_text([map(spreadsheet_text, cells)], lineterminator="")


def _with_handed_out(learner, grades, submitted):
    """A learner's entry; its maximum has the lessons that only others submitted, because all got them."""
    own = {lesson["lesson"] for lesson in learner["lessons"]}
    others = [lesson for name, lesson in lessons_of(grades).items() if name in submitted - own]
    return learner | {"max_points": learner["max_points"] + sum(one["max_points"] for one in others)}


def _percentages(entries):
    shares = ((entry["points"], entry["max_points"] - entry["open_points"]) for entry in entries)
    return [100 * points / graded for points, graded in shares if graded]


def _mean_and_median(entries):
    """In percent of what is graded; 0 if there are no points."""
    percentages = _percentages(entries) or [0]
    return {"mean": round(statistics.fmean(percentages)), "median": round(statistics.median(percentages))}


def _histogram(percentages):
    """[{low, high, count, height}] of ten bins; the last one includes 100, and what a bonus adds."""
    counts = Counter(min(int(share // 10), 9) for share in percentages)
    bins = [{"low": 10 * tenth, "high": 10 * tenth + 10, "count": counts[tenth]} for tenth in range(10)]
    return [one | {"height": round(100 * one["count"] / max([1, *counts.values()]))} for one in bins]


def _lesson_rows(graded, names):
    for name in names:
        lessons = [lesson for lesson in graded if lesson["lesson"] == name]
        if lessons:
            yield {
                "name": name,
                "title": lessons[0]["title"],
                "count": len(lessons),
                "max_points": max(lesson["max_points"] for lesson in lessons),
                "full": sum(lesson["points"] == lesson["max_points"] for lesson in lessons),
                **_mean_and_median(lessons),
            }


def _check_rows(graded, written):
    """One row per check, those that most learners fail first; none for what a person grades."""
    rows: dict[tuple, dict] = {}
    for lesson in graded:
        for exercise in lesson["exercises"]:
            for case in () if exercise["id"] in written else exercise["cases"]:
                row = {"lesson": lesson["lesson"], "exercise": exercise["title"]}
                row |= {"title": case["title"], "hidden": case["hidden"]}
                key = (lesson["lesson"], exercise["id"], case["id"])
                row = rows.setdefault(key, row | {"passed": 0, "attempted": 0, "count": 0})
                row["count"] += 1
                row["passed"] += case["outcome"] == Outcome.PASSED
                row["attempted"] += case["outcome"] not in (Outcome.NOT_ATTEMPTED, Outcome.MISSING)
    for row in rows.values():
        row["share"] = round(100 * row["passed"] / row["count"])
    return sorted(rows.values(), key=lambda row: (row["share"], row["title"]))


def _mistake_counts(graded):
    """[((lesson, exercise's title, mistake, explanation), count)], the most frequent mistake first."""
    counts = Counter(
        (lesson["lesson"], exercise["title"], exercise["mistake"], exercise["mistake_explanation"])
        for lesson in graded
        for exercise in lesson["exercises"]
        if exercise["mistake"]
    )
    return sorted(counts.items(), key=lambda item: (-item[1], item[0]))
