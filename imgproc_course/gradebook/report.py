"""The pages: one a learner, to be handed back, and the teacher's summary.

Each is one file that loads nothing: its style stands in it, and its Content-Security-Policy allows that style
(by its hash) and images drawn by `answer_images`, and nothing else. Every text is escaped by the template;
what a reader's eye would not see is made visible before.
"""

import base64
import hashlib
import statistics
from functools import lru_cache
from pathlib import Path

import jinja2

from imgproc_course.exercises.answer_images import answer_images
from imgproc_course.exercises.values import answer_parts, differing_elements
from imgproc_course.gradebook.report_values import value_of
from imgproc_course.gradebook.sanitize import visible

TEMPLATES = Path(__file__).with_name("pages")
OUTCOMES = {
    "passed": "passed",
    "wrong": "gives another value",
    "raised": "raised an exception",
    "not attempted": "not attempted",
    "missing": "the function is missing",
    "refused module": "uses what this exercise refuses",
    "time": "did not come to its end in time",
    "memory": "needed too much memory",
    "output": "printed too much",
    "crashed": "ended Python itself",
    "hostile": "gave out what no answer gives out",
    "not judged": "could not be judged; your teacher will look at it",
}
_NOTHING_TO_SHOW = ("not attempted", "missing", "refused module")
# Where every check of an exercise ended like this, no inputs are the cause, and no check's hint helps.
_ADVICE = {
    "missing": "Grading looks into the lesson's own answer cell alone: take a fresh copy of the lesson, write"
    " your function there, and let `imgproc-course check` look at it before you hand it in.",
    "refused module": "The task is to write it by hand: leave out what it refuses.",
    "time": "It comes to no end in time, whatever it is given: is there a loop whose condition stays true, or"
    " one that goes over every pixel again for each pixel?",
    "memory": "It needs too much, whatever it is given: what grows with every turn of a loop?",
    "output": "Take the print calls out of your function.",
    "crashed": "Nothing in your function may end Python: no exit(), no quit(), no os._exit().",
}
_CELL_ADVICE = (
    "No check could call your function: run the cell in the lesson, and mend what Python says there."
)
_NAME_ADVICE = (
    "Grading runs the given cell of the exercise and your answer cell, and nothing else of the notebook: what"
    " your function needs must stand in one of the two."
)
LOOK_AT = ("hostile", "crashed", "output", "memory", "refused module", "not judged")
_BINS = 10


@lru_cache(maxsize=1)
def _environment():
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.finalize = lambda value: visible(value, 20_000) if type(value) is str else value
    environment.globals["outcomes"] = OUTCOMES
    environment.filters["capital"] = _capital
    environment.filters["percent"] = lambda pair: round(100 * pair[0] / pair[1]) if pair[1] else 0
    return environment


def _capital(text):
    """The text with a capital; what begins with a name of Python's, like my_psnr(), stays as it is."""
    return text[:1].upper() + text[1:] if text.split(" ", 1)[0].isalpha() else text


def _page(name, **content):
    style = (TEMPLATES / "style.css").read_text(encoding="utf-8")
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode("ascii")
    policy = f"default-src 'none'; style-src 'sha256-{digest}'; img-src data:"
    style = jinja2.utils.markupsafe.Markup(style)  # ours, and the hash is of every letter
    return _environment().get_template(name).render(style=style, policy=policy, **content)


# ---------------------------------------------------------------- a learner's page


def learner_page(entry, results, answer_keys):
    """The page of one learner.

    Parameters
    ----------
    entry : dict, the learner's part of grades.json
    results : {lesson: result of `judge`, with values}
    answer_keys : AnswerKeys

    Returns
    -------
    str, HTML
    """
    lessons = [
        _lesson_view(lesson, results.get(lesson["lesson"]), answer_keys) for lesson in entry["lessons"]
    ]
    return _page("learner.html", learner=entry, lessons=lessons)


def _lesson_view(lesson, result, answer_keys):
    told = [notice for notice in lesson["notices"] if notice["kind"] == "message"]
    key = answer_keys.key_of(lesson["key"]) if lesson["key"] else None
    exercises = []
    for each in result["exercises"] if result else ():
        notes = [notice["text"] for notice in told if notice["exercise"] == each["id"]]
        exercises.append(_exercise_view(each, notes, key.exercise(each["id"])))
    others = {notice["exercise"] for notice in told} - {each["id"] for each in exercises}
    return lesson | {
        "exercises": exercises,
        "notes": [_with_exercise(notice) for notice in told if notice["exercise"] in others],
        "file": lesson["source"].rpartition("/")[2],
    }


def _with_exercise(notice):
    """Of the whole lesson, or of a practice exercise, which has no place of its own on the page."""
    return f"{notice['exercise']}: {notice['text']}" if notice["exercise"] else notice["text"]


def _exercise_view(exercise, notes, declared):
    advice, alike = _advice_of(exercise)
    cases, first = [], True
    for case in exercise["cases"]:
        passed = case["outcome"] == "passed"
        view = case | {"passed": passed, "values": [], "images": [], "printed_here": "", "open": first}
        view["story"] = "" if alike else _story_of(case)
        view["hint"] = "" if alike else case["hint"]
        shows = case["outcome"] not in _NOTHING_TO_SHOW and advice != _CELL_ADVICE
        if not passed and not case["hidden"] and "given" in case and shows:
            view |= _values_view(case, declared)
            first = False
        cases.append(view)
    said = [exercise["said"]] if exercise["said"] and not (notes and advice == _ADVICE["missing"]) else []
    if alike and not exercise["said"]:
        said += list(dict.fromkeys(filter(None, map(_story_of, exercise["cases"]))))[:1]
    return exercise | {
        "cases": cases,
        "notes": [*notes, *said],
        "advice": advice,
        "function": declared.function,
    }


def _story_of(case):
    """What is told of a check beside its title; of a hidden one no more than the exception's name."""
    if case["outcome"] == "crashed" or (case["hidden"] and case["outcome"] not in ("raised", "memory")):
        return ""
    return case["said"]


def _advice_of(exercise):
    """(what to do, whether every check ended alike, so that this stands in place of their hints)."""
    outcomes = {case["outcome"] for case in exercise["cases"]}
    if len(outcomes) != 1:
        return "", False
    (outcome,) = outcomes
    if outcome == "raised":
        said = [case["said"] for case in exercise["cases"]]
        if exercise["said"]:
            return _CELL_ADVICE, True
        return (_NAME_ADVICE if all(each.startswith("NameError") for each in said) else ""), False
    return _ADVICE.get(outcome, ""), outcome in _ADVICE


def _values_view(case, declared):
    names = [*declared.arguments, *("" for _ in case["given"])]
    tolerance = next((each.tolerance for each in declared.cases if each.id == case["id"]), 0.0)
    rows = [
        [value_of(f"given {name}".strip(), form) for name, form in zip(names, case["given"], strict=False)]
    ]
    images, given = [], next(iter(case["given"]), None)
    for name, expected, actual in answer_parts(case["expected"], case["actual"]):
        wrong = differing_elements(expected, actual, tolerance)
        back = value_of(f"returned {name}".strip(), actual, wrong)
        rows.append([back, value_of(f"expected {name}".strip(), expected, wrong)])
        images += answer_images(given, name, expected, actual, wrong)
        given = None
    return {"values": rows, "images": images, "printed_here": case["printed"].strip()}


# ---------------------------------------------------------------- the teacher's page


def summary_page(grades):
    """The teacher's page.

    Parameters
    ----------
    grades : dict, what grades.json holds

    Returns
    -------
    str, HTML
    """
    handed_in = [(learner, lesson) for learner in grades["learners"] for lesson in learner["lessons"]]
    graded = [(learner, lesson) for learner, lesson in handed_in if lesson["status"] == "graded"]
    shares = [100 * learner["got"] / learner["points"] for learner in grades["learners"] if learner["points"]]
    checks = sorted(_checks(graded), key=lambda each: (each["share"], each["title"]))
    return _page(
        "summary.html",
        grades=grades,
        lessons=_lessons(graded),
        handed_in=len(handed_in),
        graded=len(graded),
        late=[(learner, lesson) for learner, lesson in handed_in if lesson["late"]],
        refused=[(learner, lesson) for learner, lesson in handed_in if lesson["status"] != "graded"],
        bins=_histogram(shares),
        mean=round(statistics.fmean(shares)) if shares else 0,
        median=round(statistics.median(shares)) if shares else 0,
        checks=checks,
        mistakes=_mistakes(graded),
        odd=list(_odd(handed_in)),
        again=[(learner, lesson) for learner, lesson in handed_in if lesson["earlier"]],
        names=sorted({lesson["lesson"] for _, lesson in handed_in if lesson["lesson"]}),
    )


def _histogram(shares):
    """[{from, to, count, height}] of percentages, ten bins; the last holds 100 too."""
    counts = [0] * _BINS
    for share in shares:
        counts[min(int(share * _BINS / 100), _BINS - 1)] += 1
    highest = max(counts) or 1
    width = 100 // _BINS
    return [
        {"low": k * width, "high": (k + 1) * width, "count": count, "height": round(100 * count / highest)}
        for k, count in enumerate(counts)
    ]


def _lessons(graded):
    found = {}
    for _, lesson in graded:
        found.setdefault(lesson["lesson"], []).append(lesson)
    for name in sorted(found):
        of = found[name]
        shares = [100 * each["got"] / each["points"] for each in of if each["points"]]
        yield {
            "name": name,
            "title": of[0]["title"],
            "count": len(of),
            "points": of[0]["points"],
            "mean": round(statistics.fmean(shares)) if shares else 0,
            "median": round(statistics.median(shares)) if shares else 0,
            "full": sum(each["got"] == each["points"] for each in of),
        }


def _checks(graded):
    found = {}
    for _, lesson in graded:
        for exercise in lesson["exercises"]:
            for case in exercise["cases"]:
                name = (lesson["lesson"], exercise["id"], case["id"])
                about = {"lesson": lesson["lesson"], "exercise": exercise["title"], "title": case["title"]}
                about |= {"hidden": case["hidden"], "passed": 0, "attempted": 0, "count": 0}
                check = found.setdefault(name, about)
                check["count"] += 1
                check["passed"] += case["outcome"] == "passed"
                check["attempted"] += case["outcome"] not in ("not attempted", "missing")
    for check in found.values():
        check["share"] = round(100 * check["passed"] / check["count"])
    return found.values()


def _mistakes(graded):
    counts = {}
    for _, lesson in graded:
        for exercise in lesson["exercises"]:
            if exercise["mistake"]:
                name = (lesson["lesson"], exercise["title"], exercise["mistake"], exercise["mistake_says"])
                counts[name] = counts.get(name, 0) + 1
    return sorted(counts.items(), key=lambda item: (-item[1], item[0]))


def _odd(handed_in):
    """(learner, lesson, [what is odd])."""
    for learner, lesson in handed_in:
        told = [
            _with_exercise(notice)
            for notice in lesson["notices"]
            # the table of learners shows already how often something was submitted, and the results what is
            # wrong with an answer
            if notice["kind"] != "answer"
            and not (lesson["earlier"] and notice["text"].startswith("submitted "))
        ]
        for exercise in lesson["exercises"]:
            words = {case["outcome"] for case in exercise["cases"]} & set(LOOK_AT)
            told += [f"{exercise['id']}: {OUTCOMES[word]}" for word in sorted(words)]
        if told:
            yield learner, lesson, told
