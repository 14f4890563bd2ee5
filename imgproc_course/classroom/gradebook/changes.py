"""What changed between two runs: the rules, and everything about each learner's lessons and exercises."""

import json

from .anonymity import learner_without_name
from .grades_json import FORMAT
from .report import count_of, finding_text, render_page

PREVIOUS = "grades.previous.json"
_RULES = {"deadline": "deadline", "late_policy": "late policy", "sandbox": "sandbox"}
_WORDS = {None: "none", True: "yes", False: "no"}
_NOT_THERE = "not there"


def read_grades(path):
    """The content of a grades.json, or None if there is none in today's format."""
    try:
        grades = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return grades if isinstance(grades, dict) and grades.get("format") == FORMAT else None


def changes_page(before, after, names):
    """The page of what changed between two runs, HTML; `names` are {learner's name: the name to show}."""
    rows, names = list(changes_between(before, after)), {"": "everybody"} | names
    for row in rows:
        row["learner"] = names.get(row["learner"], "(gone)")
    return render_page("changes.html", rows=rows)


def changes_between(before, after):
    """The differences of two contents of grades.json.

    Yields dicts: learner ("" for the whole run), page (of the later run, or ""), lesson, exercise (or ""),
    aspect ("" for the points), before, after: texts.
    """
    yield from _changes_of_run(before, after)
    anonymous = after.get("anonymous_pages", False)
    old, new = (_learners(grades, anonymous) for grades in (before, after))
    for name in sorted({*old, *new}, key=lambda name: (name.casefold(), name)):
        about = {"learner": name, "page": new[name]["page"] if name in new else ""}
        old_parts, new_parts = (_parts(learners.get(name)) for learners in (old, new))
        for lesson, exercise in {**old_parts, **new_parts}:
            entries = [parts.get((lesson, exercise)) for parts in (old_parts, new_parts)]
            for aspect, *texts in _differences(*entries):
                part = {"lesson": lesson, "exercise": exercise, "aspect": aspect}
                yield about | part | dict(zip(("before", "after"), texts, strict=True))


def _changes_of_run(before, after):
    about = {"learner": "", "page": "", "lesson": "the whole run", "exercise": ""}
    for name in sorted((before.keys() | after.keys()) - {"learners", "anonymous_pages"}):
        old, new = before.get(name), after.get(name)
        if old != new:
            texts = [_WORDS.get(one, one) for one in (old, new)] if name in _RULES else ["", "changed"]
            yield about | {"aspect": _RULES.get(name, name), "before": texts[0], "after": texts[1]}


def _learners(grades, anonymous):
    entries = grades["learners"]
    shown = map(learner_without_name, entries) if anonymous else entries
    names = [entry["name"] for entry in entries]
    return dict(zip(names, shown, strict=True))


def _parts(learner):
    """{(lesson, exercise or ""): entry}, the lesson's own entry first."""
    parts = {}
    for lesson in learner["lessons"] if learner else ():
        name = lesson["lesson"] or lesson["file"]
        parts[name, ""] = {key: value for key, value in lesson.items() if key != "exercises"}
        parts |= {(name, exercise["id"]): exercise for exercise in lesson["exercises"]}
    return parts


def _differences(old, new):
    """(aspect, before, now) of what differs in an entry; without words for it, the names of the fields."""
    if old is None or new is None:
        yield "", *(_points(entry) if entry else _NOT_THERE for entry in (old, new))
    elif old != new:
        rows = [(aspect, text(old), text(new)) for aspect, text in _ASPECTS.items()]
        rows = [row for row in rows if row[1] != row[2]]
        fields = [name for name in sorted({*old, *new}) if old.get(name) != new.get(name)]
        yield from rows or [("details", "", f"changed: {', '.join(fields)}")]


def _points(entry):
    if entry.get("status") == "not graded":
        return f"not graded: {entry['reason']}"
    if entry.get("decision") and entry["decision"]["excused"]:
        return "excused"
    text = f"{entry['points']} of {entry['max_points']}"
    if entry.get("late_deduction"):
        text += f", {entry['late_deduction']} deducted because late"
    decided = f", decided by hand; the autograder gives {entry.get('autograded_points')}"
    return text + (decided if entry.get("decision") else "")


def _lateness(entry):
    if entry.get("days_late"):
        return f"{count_of(entry['days_late'], 'day')} late"
    return "late" if entry.get("late") else "in time"


def _file(entry):
    submitted = f", submitted {entry['submitted_at']}" if entry.get("submitted_at") else ""
    return f"{entry.get('file', '')} ({(entry.get('sha256') or 'none')[:8]}{submitted})"


def _checks(entry):
    cases = [f"{case['title']}: {case['outcome']} {case['message']}" for case in entry.get("cases", ())]
    return "; ".join(filter(None, [entry.get("mistake", ""), *map(str.strip, cases)]))


_ASPECTS = {
    "": _points,
    "lateness": _lateness,
    "file": _file,
    "checks": _checks,
    "comment": lambda entry: (entry.get("decision") or {}).get("comment", ""),
    "findings": lambda entry: "; ".join(map(finding_text, entry.get("findings", ()))),
}
