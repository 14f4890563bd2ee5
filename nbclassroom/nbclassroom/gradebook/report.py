"""The page of a learner, to give back; and what it shares with the teacher's pages.

Each page is one file that loads nothing: it contains its style, and its Content-Security-Policy allows that
style (by its hash), images drawn by `answer_images`, and nothing else; on the pages on which a teacher
decides, one script of ours, too. The template escapes every text, and characters that a reader would not see
are made visible before. The checks are HTML already, made so by `autograder.checked_answer`.
"""

import base64
import hashlib
import html
from functools import lru_cache
from pathlib import Path
from typing import Any

from .. import course
from ..autograder.outcomes import Outcome
from ..autograder.sanitize import sanitize_text
from .submission import NOT_PYTHON
from .teacher_tables import plain_number

TEMPLATES = Path(__file__).with_name("pages")
_NOTE = '<p class="note">{}.</p>'


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
        "capital": _capital,
        "count": count_of,
        "points": points_text,
        "anchor": anchor_of,
        "submitted": submitted_lessons,
        "numbered": lambda name: (name, "number"),
        "percent": lambda pair: round(100 * pair[0] / pair[1]) if pair[1] else 0,
    }
    return environment


def _shown(value):
    """A text as pages show it; anything else unchanged."""
    return sanitize_text(value, 20_000) if type(value) is str else value


def _capital(text):
    """The text with a capital; a text that begins with a Python name, like my_psnr(), stays unchanged."""
    return text[:1].upper() + text[1:] if text.split(" ", 1)[0].isalpha() else text


def count_of(number, noun):
    """A number with its noun: "1 learner", "2 learners"; only for nouns whose plural ends in s."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def points_text(entry):
    """The points of a learner, a lesson or an exercise: "7 of 12", or "7 of 12, 3 points not graded yet"."""
    waiting = entry.get("open_points", 0)
    text = f", {count_of(waiting, 'point')} not graded yet" if waiting else ""
    return f"{entry['points']} of {entry['max_points']}{text}"


def anchor_of(entry):
    """The id of a learner's answer on the teacher's pages of an exercise."""
    return entry["page"].rpartition("/")[2].removesuffix(".html")


def safe_html(html):
    """HTML of ours, which templates do not escape."""
    return _environment().filters["safe"](html)


def prepare_templates():
    """Compile the templates: the autograder can start in this time."""
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
    """What the page shows of an exercise beside its entry in grades.json; the checks are HTML already."""
    is_said = any(note.startswith("line ") and NOT_PYTHON in note for note in notes)
    is_said |= bool(notes) and {case.outcome for case in exercise.cases} == {Outcome.MISSING}
    notes = notes if is_said or not exercise.message else [*notes, exercise.message]
    above = "".join(_NOTE.format(html.escape(_shown(_capital(note)))) for note in notes)
    checks = {"body": safe_html(above + exercise.body), "review": safe_html(above + exercise.review)}
    return {"function": key_exercise.function} | checks
