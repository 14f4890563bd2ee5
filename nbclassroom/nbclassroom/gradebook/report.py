"""The page of a learner, to give back; and those on which a teacher reads answers and decides.

Each page is one file that loads nothing: it contains its style, and its Content-Security-Policy allows that
style (by its hash), images drawn by `answer_images`, and nothing else; on the pages on which a teacher
decides, one script of ours, too. The template escapes every text, and characters that a reader would not see
are made visible before. The checks are HTML already, made so by `autograder.shown_answer`.

The teacher's are review.html, and one page per exercise, with each learner's answer as it was graded beside
its checks. What is typed there becomes lines for decisions.csv, to copy, or saved by `grade --review`.
"""

import base64
import hashlib
import html
import keyword
import re
import tempfile
from functools import lru_cache
from pathlib import Path

from .. import course
from ..autograder.outcomes import PHRASES, Outcome
from ..autograder.sanitize import sanitize_text, spreadsheet_text
from ..autograder.shown_answer import capital, rendered_text
from .csv_table import csv_text
from .submission import NOT_PYTHON
from .teacher_tables import EVERYBODY, plain_number

TEMPLATES = Path(__file__).with_name("pages")
FOLDER = "review"
_GRADED = ("graded by a person",)
_MOST_COLOURED = 20_000  # characters of an answer; a longer one takes time
# What is not closed ends with the line or the text, so no character is looked at for a second try.
_TOKENS = re.compile(
    r"(?P<c>#.*)"
    r"|(?P<s>\"\"\"[\s\S]*?(?:\"\"\"|\Z)|'''[\s\S]*?(?:'''|\Z)"
    r"|\"(?:\\.|[^\"\\\n])*+\"?|'(?:\\.|[^'\\\n])*+'?)"
    rf"|\b(?P<k>{'|'.join(keyword.kwlist)})\b|(?<=\bdef )(?P<nf>\w+)|\b(?P<m>\d[\w.]*)"
)
_NOTE = '<p class="note">{}.</p>'


@lru_cache(maxsize=1)
def _environment():
    import jinja2  # see `prepare_templates`

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        finalize=_shown,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "capital": capital,
        "count": count_of,
        "points": points_text,
        "anchor": anchor_of,
        "submitted": lambda entry: sum(bool(one["lesson"] and one["sha256"]) for one in entry["lessons"]),
        "numbered": lambda name: (name, "number"),
        "percent": lambda pair: round(100 * pair[0] / pair[1]) if pair[1] else 0,
    }
    return environment


def _shown(value):
    """A text as pages show it; anything else unchanged."""
    return sanitize_text(value, 20_000) if type(value) is str else value


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
    return safe_html(text), f"'sha256-{digest}'"


def learner_page(entry, results, answer_keys, policy=None, *, incomplete=False, keep=None):
    """The page of one learner, HTML; `entry` is the learner's part of grades.json.

    Of a lesson without a GradedSubmission in `results`, {lesson: result}, the page shows only the points.
    `policy` is the LatePolicy or None; `incomplete`: the page says that its details are missing. `keep` is
    called with each exercise, whose `review` is what the teacher sees of the checks.
    """
    content = {"learner": entry, "late_policy": policy and policy.text, "incomplete": incomplete}
    lessons = [_lesson_view(one, results.get(one["lesson"]), answer_keys) for one in entry["lessons"]]
    for exercise in [one for lesson in lessons for one in lesson["exercises"]] if keep else ():
        keep(exercise)
    return render_page("learner.html", lessons=lessons, offered=len(answer_keys.lessons), **content)


def _lesson_view(lesson, result, answer_keys):
    findings = [finding for finding in lesson["findings"] if finding["kind"] == "message"]
    views = []
    for entry, exercise in zip(lesson["exercises"], result.exercises if result else (), strict=False):
        notes = [finding["text"] for finding in findings if finding["exercise"] == exercise.id]
        function = answer_keys.key_of(lesson["key"]).exercise(exercise.id).function
        views.append(entry | _checks_view(exercise, notes) | {"function": function})
    ids = {view["id"] for view in views}
    return lesson | {
        "exercises": views,
        "notes": [finding_text(finding) for finding in findings if finding["exercise"] not in ids],
        "file": lesson["file"].rpartition("/")[2],
        "before_late": plain_number(lesson["points"] + lesson["late_deduction"]),
    }


def finding_text(finding):
    """A finding outside its exercise: of the whole lesson, or of a practice exercise, which no page lists."""
    return f"{finding['exercise']}: {finding['text']}" if finding["exercise"] else finding["text"]


def _checks_view(exercise, notes):
    """The checks for the learner and for the teacher, HTML, below the notes and the message."""
    is_said = any(note.startswith("line ") and NOT_PYTHON in note for note in notes)
    is_said |= bool(notes) and {case.outcome for case in exercise.cases} == {Outcome.MISSING}
    notes = notes if is_said or not exercise.message else [*notes, exercise.message]
    above = "".join(_NOTE.format(html.escape(_shown(capital(note)))) for note in notes)
    return {"body": safe_html(above + exercise.body), "review": safe_html(above + exercise.review)}


class AnswerParts:
    """What the pages show of each answer, kept in a file until all are graded: it can be much."""

    def __init__(self, folder):
        self._file, self._places = tempfile.TemporaryFile(dir=folder), {}  # noqa: SIM115 - `close` closes it
        self.close = self._file.close

    def keep(self, page, answers, exercise):
        """Keep the source of an answer, and its checks as HTML, by the path of its learner's page."""
        parts = _coloured(answers.get(exercise["id"], "")), exercise["review"]
        texts = [text.encode("utf-8") for text in parts]
        self._places[page, exercise["id"]] = self._file.seek(0, 2), *map(len, texts)
        self._file.writelines(texts)

    def read(self, page, exercise):
        """(source, checks) of an answer, both HTML; empty if its page could not be written."""
        start, *lengths = self._places.get((page, exercise), (0, 0, 0))
        self._file.seek(start)
        return [safe_html(self._file.read(length).decode("utf-8")) for length in lengths]


def _coloured(source):
    """A source as HTML; hidden characters are made visible before."""
    text = sanitize_text(source, 2 * _MOST_COLOURED)
    span, parts, end = safe_html('<span class="{}">{}</span>'), [], 0
    for token in _TOKENS.finditer(text) if len(text) <= _MOST_COLOURED else ():
        parts += [text[end : token.start()], span.format(token.lastgroup, token[0])]
        end = token.end()
    return safe_html("").join([*parts, text[end:]])


def review_pages(grades, parts, solutions):
    """Yields (path, HTML) of each page; `parts` are AnswerParts.

    `solutions(lesson)` gives {exercise: solution}, of what a person grades a model answer.
    """
    reviews = reviews_of(grades["learners"])
    if reviews:
        yield "review.html", render_page("review.html", reviews=reviews)
    for one, *around in zip(reviews, [None, *reviews], [*reviews[1:], None], strict=False):
        content = {"review": one, "around": around, "parts": parts, "model": ""}
        if one["rubric"]:
            content["model"] = safe_html(rendered_text(solutions(one["lesson"]["lesson"])[one["id"]]))
            content["line"] = csv_text([(EVERYBODY, one["lesson"]["lesson"], one["id"])], lineterminator="")
        yield one["path"], render_page("answers.html", script="review.js", **content)


def reviews_of(learners):
    """The answers to each exercise: in `groups` first those who lost points alike, the most frequent way."""
    reviews: dict[str, dict] = {}
    for learner in learners:
        for lesson in learner["lessons"]:
            for exercise in lesson["exercises"]:
                id = exercise["id"]
                about = {"id": id, "path": f"{FOLDER}/{id}.html", "lesson": lesson, "ways": {}}
                review = reviews.setdefault(id, about | {"title": exercise["title"]})
                cells = (learner["name"], lesson["lesson"], id)
                line = csv_text([map(spreadsheet_text, cells)], lineterminator="")
                answer = {"learner": learner, "lesson": lesson, "exercise": exercise, "line": line}
                review["ways"].setdefault(_way(exercise), []).append(answer | {"anchor": anchor_of(learner)})
    for review in reviews.values():
        review["groups"] = sorted(review["ways"].items(), key=_order)
        exercises = [answer["exercise"] for answers in review["ways"].values() for answer in answers]
        review["count"], review["open"] = len(exercises), sum(one["open_points"] > 0 for one in exercises)
        written = [one["rubric"] for one in exercises if one["rubric"]]  # of who wrote nothing there is none
        review["written"], review["rubric"] = len(written), [*written, ()][0]
    return list(reviews.values())


def _order(way_and_answers):
    """What the groups are sorted by: those that wait for a person first, those without a fault last."""
    way, answers = way_and_answers
    is_open = any(answer["exercise"]["open_points"] for answer in answers)
    return not is_open, way in ((), _GRADED), -len(answers), way


def _way(exercise):
    """How an answer fails, in words: equal words, the same checks in the same way; () if all pass."""
    if exercise["rubric"] and not exercise["open_points"]:
        return _GRADED
    failed = [case for case in exercise["cases"] if case["outcome"] != Outcome.PASSED]
    if exercise["mistake"]:
        titles = ", ".join(case["title"] for case in failed)
        return (f"{exercise['mistake']} (fails {titles})",)
    return tuple(f"{case['title']}: {_ending(case)}" for case in failed)


def _ending(case):
    """How a case ended; of an exception its name, because the rest quotes the learner's own line."""
    label, message = PHRASES[case["outcome"]], case["message"]
    if case["outcome"] == Outcome.RAISED:
        message = "".join(re.findall(r"^[A-Z]\w+", message))
    is_drive = message.startswith("The robot ")  # and returned no other value
    return message if is_drive else f"{label} ({message})" if message else label
