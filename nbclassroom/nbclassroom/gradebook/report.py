"""The page of a learner, to give back; and what it shares with the teacher's pages.

Each page is one file that loads nothing: it contains its style, and its Content-Security-Policy allows that
style (by its hash), images drawn by `answer_images`, and nothing else; on the pages on which a teacher
decides, one script of ours, too. The template escapes every text, and characters that a reader would not see
are made visible before.
"""

import base64
import hashlib
from collections import namedtuple
from functools import lru_cache
from pathlib import Path
from typing import Any

from .. import course
from ..autograder.outcomes import TEXTS, Outcome
from ..autograder.sanitize import sanitize_line, sanitize_text, without_machine_paths
from ..exercises import values
from ..exercises.error_advice import advice_on
from .submission import NOT_PYTHON
from .teacher_tables import plain_number

TEMPLATES = Path(__file__).with_name("pages")
_LONGEST_DESCRIPTION = 400  # characters of a value
_CELL_ADVICE = (
    "No check could use your answer: run the cell in the lesson, and fix what Python reports there."
)
_FOREIGN_VALUE = (
    "Your answer reads a value that another cell makes with a module that is not allowed here. In the lesson"
    " it works; in grading nothing has this module. Compute with the arguments of your function."
)
_MAP_CAPTION = "The drive: a green dot is its start, a cross a bump, a ring the decisive moment."
_DRIVES_WRONG = "does not drive as the task asks"
_NAME_ADVICE = (
    "Grading runs your notebook as Restart & Run All does, from its top to the check of the exercise, and if"
    " a name is missing the cells below, too. Is the name misspelled, or does no cell define it?"
)


@lru_cache(maxsize=1)
def _environment():
    import jinja2  # see `prepare_templates`

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.finalize = _shown
    environment.filters |= {
        **{"capital": _capital, "count": count_of, "anchor": anchor_of, "submitted": submitted_lessons},
        "numbered": lambda name: (name, "number"),
        "percent": lambda pair: round(100 * pair[0] / pair[1]) if pair[1] else 0,
    }
    return environment


def _shown(value):
    """A text as pages show it; anything else unchanged."""
    return without_machine_paths(sanitize_text(value, 20_000)) if type(value) is str else value


def _capital(text):
    """The text with a capital; a text that begins with a Python name, like my_psnr(), stays unchanged."""
    return text[:1].upper() + text[1:] if text.split(" ", 1)[0].isalpha() else text


def count_of(number, noun):
    """A number with its noun: "1 learner", "2 learners"; only for nouns whose plural ends in s."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def anchor_of(entry):
    """The id of a learner's answer on the teacher's pages of an exercise."""
    return entry["page"].rpartition("/")[2].removesuffix(".html")


def prepare_templates():
    """Import what draws pages, and compile the templates: the autograder can start in this time."""
    import nbclassroom.exercises.answer_images  # noqa: F401 - Pillow

    for path in TEMPLATES.glob("*.html"):
        _environment().get_template(path.name)


def render_page(name, *, script=None, **content):
    """A page: the template `name` of pages/ with its content, and perhaps with a script of pages/."""
    content["style"], style_hash = _own_code("style.css")
    policy = f"default-src 'none'; style-src {style_hash}; img-src data:"
    if script:
        content["script"], script_hash = _own_code(script)
        policy += f"; script-src {script_hash}; connect-src 'self'"
    return _environment().get_template(name).render(policy=policy, course_title=course.title, **content)


def _own_code(name):
    """A file of ours that a page contains as it is, and its hash, by which the page's policy allows it."""
    text = (TEMPLATES / name).read_text(encoding="utf-8")
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
    return _environment().filters["safe"](text), f"'sha256-{digest}'"


def _rendered(name, **content):
    """A part of a page, for another template."""
    return _environment().filters["safe"](_environment().get_template(name).render(**content))


def learner_page(entry, results, answer_keys, policy=None, *, incomplete=False, keep=None):
    """The page of one learner, HTML; `entry` is the learner's part of grades.json.

    Of a lesson without a GradedSubmission in `results`, {lesson: result}, the page shows only the points.
    `policy` is the LatePolicy or None; `incomplete`: the page says that its details are missing. `keep` is
    called with each lesson's name and its exercises, whose `review` is what the teacher sees of the checks.
    """
    content = {"learner": entry, "late_policy": policy and policy.text, "incomplete": incomplete}
    content |= {"submitted": submitted_lessons(entry), "offered": len(answer_keys.lessons)}
    lessons = [_lesson_view(one, results.get(one["lesson"]), answer_keys) for one in entry["lessons"]]
    for lesson in lessons if keep else ():
        keep(lesson["lesson"], lesson["exercises"])
    return render_page("learner.html", lessons=lessons, **content)


def _lesson_view(lesson, result, answer_keys):
    findings = [finding for finding in lesson["findings"] if finding["kind"] == "message"]
    key: Any = answer_keys.key_of(lesson["key"]) if lesson["key"] else None
    views = []
    for entry, exercise in zip(lesson["exercises"], result.exercises if result else (), strict=False):
        notes = [finding["text"] for finding in findings if finding["exercise"] == exercise.id]
        views.append(entry | _exercise_view(exercise, notes, key.exercise(exercise.id)))
    ids = {view["id"] for view in views}
    return lesson | {
        "exercises": views,
        "notes": [finding_text(finding) for finding in findings if finding["exercise"] not in ids],
        "file": lesson["file"].rpartition("/")[2],
        "before_late": plain_number(lesson["points"] + lesson["late_deduction"]),
    }


def submitted_lessons(entry):
    """How many lessons of the key a learner submitted."""
    return sum(bool(lesson["lesson"] and lesson["sha256"]) for lesson in entry["lessons"])


def finding_text(finding):
    """A finding outside its exercise: of the whole lesson, or of a practice exercise, which no page lists."""
    return f"{finding['exercise']}: {finding['text']}" if finding["exercise"] else finding["text"]


def _exercise_view(exercise, notes, key_exercise):
    """What the page shows of an exercise beside its entry in grades.json."""
    advice, replaces_hints = _advice_on(exercise)
    show_values = not advice.endswith(_CELL_ADVICE)
    is_no_python = any(note.startswith("line ") and NOT_PYTHON in note for note in notes)
    if is_no_python:
        advice = _CELL_ADVICE  # the note says what is wrong
    cases = [_case_view(case, key_exercise, replaces_hints, show_values) for case in exercise.cases]
    for view in [view for view in cases if view["values"]][:1]:
        view["open"] = True
    explained_by_notes = is_no_python or (notes and advice == TEXTS[Outcome.MISSING].advice)
    messages = [exercise.message] if exercise.message and not explained_by_notes else []
    if replaces_hints and not exercise.message:
        messages += list(dict.fromkeys(filter(None, map(_message_of, exercise.cases))))[:1]
    notes = [*notes, *messages]
    view = {"mistake": exercise.mistake, "mistake_explanation": exercise.mistake_explanation}
    view |= {"notes": notes, "advice": advice}
    return {"function": key_exercise.function} | _bodies(view, cases)


def _bodies(view, cases):
    """The checks as HTML: for the learner, and for the teacher, who sees the values of hidden ones, too."""
    body = _rendered("exercise.html", exercise=view | {"cases": cases})
    if not any(case["secret"] for case in cases):
        return {"body": body, "review": body}
    cases = [case | case["secret"] for case in cases]
    return {"body": body, "review": _rendered("exercise.html", exercise=view | {"cases": cases})}


def _case_view(case, key_exercise, replaced_by_advice, show_values):
    view = {"values": [], "images": [], "printed": "", "secret": {}}
    if case.drive:
        drive_view = {"images": [_map_of(case)]}
        view |= {"secret": drive_view} if case.hidden else drive_view
    if case.failed_call and TEXTS[case.outcome].shows_values and show_values:
        values_view = _values_view(case, key_exercise)
        view |= {"secret": values_view} if case.hidden else values_view
    is_open = case.outcome == Outcome.NOT_ATTEMPTED  # a hint would give away what nobody asked for
    return {
        **(view | vars(case)),
        "passed": case.passed,
        "label": _DRIVES_WRONG if case.drive and case.outcome == Outcome.WRONG else TEXTS[case.outcome].label,
        "message": "" if replaced_by_advice else _message_of(case),
        "hint": "" if replaced_by_advice or is_open else case.hint,
        "state": "passed" if case.passed else "open" if is_open else "failed",
        "open": False,
    }


def _map_of(case):
    from ..exercises.kinds.drive.images import draw_map

    record = case.drive | {"ended": "", "missed": not case.passed}
    return draw_map(record, case.drive | {"title": _MAP_CAPTION})


def _message_of(case):
    """What a page says about a case beside its title; for a hidden one the exception's name, or metrics."""
    shown_of_hidden = case.drive or case.outcome in (Outcome.RAISED, Outcome.MEMORY)
    if case.outcome == Outcome.CRASHED or (case.hidden and not shown_of_hidden):
        return ""
    return case.message


def _advice_on(exercise):
    """(advice, whether it replaces the hints): every case ended alike, so the cause is not in the inputs."""
    outcomes = {case.outcome for case in exercise.cases}
    if len(outcomes) != 1:
        return "", False
    (outcome,) = outcomes
    if outcome == Outcome.RAISED:
        if ": RefusedModule: " in exercise.message:
            return _FOREIGN_VALUE, True
        if exercise.message:
            advice = _advice_on_exception(exercise.message.partition(": ")[2])
            return f"{advice} {_CELL_ADVICE}".strip(), True
        errors = {case.message.partition(":")[0] for case in exercise.cases}
        if errors == {"NameError"}:
            return _NAME_ADVICE, False
        advice = _advice_on_exception(exercise.cases[0].message) if len(errors) == 1 else ""
        return advice, bool(advice)
    return TEXTS[outcome].advice, bool(TEXTS[outcome].advice)


def _advice_on_exception(text):
    """The advice of `check` on the exception of a case's message, "" if there is none."""
    error, _, message = text.partition(": ")
    before, mark, line = message.rpartition(" (line ")
    if not mark or not line.endswith(")"):
        return advice_on(error, message)
    return advice_on(error, before, f"line {line[:-1]}")


def _values_view(case, key_exercise):
    from ..exercises.answer_images import answer_images

    call = case.failed_call
    names = [*key_exercise.names, *("" for _ in call.arguments)]
    tolerance = next((declared.tolerance for declared in key_exercise.cases if declared.id == case.id), 0.0)
    given = zip(names, call.arguments, strict=False)
    rows = [[value_of(f"given {name}".strip(), form) for name, form in given]]
    images, argument = [], next(iter(call.arguments), None)
    for name, expected, actual in values.answer_parts(call.expected, call.actual):
        wrong = values.differing_elements(expected, actual, tolerance)
        returned = value_of(f"returned {name}".strip(), actual, wrong)
        rows.append([returned, value_of(f"expected {name}".strip(), expected, wrong)])
        images += answer_images(argument, name, expected, actual, wrong)
        argument = None
    return {"values": rows, "images": images, "printed": call.printed.strip()}


# A value in a report; `rows` are those of a small array, of (text, differs).
Value = namedtuple("Value", ("label", "description", "rows"), defaults=((),))


def value_of(label, form, wrong=None):
    """The Value of a canonical form, or of None; `wrong` is a bool array: which elements differ."""
    if form is None:
        return Value(label, "nothing was returned")
    description = sanitize_line(values.describe_value(form), _LONGEST_DESCRIPTION)
    return Value(label, description, values.table_rows(form, wrong))
