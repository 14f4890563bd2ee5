"""The pages on which a teacher reads answers and decides: review.html, and one page per exercise.

A page shows each learner's answer as it was graded, beside its checks; learners whose answers fail alike
follow each other. What is typed there becomes lines for decisions.csv, to copy, or saved by `grade --review`.
"""

import keyword
import re
import tempfile

from ..autograder.outcomes import TEXTS, Outcome
from ..autograder.sanitize import sanitize_text, spreadsheet_text
from ..autograder.written_answer import rendered_text
from .csv_table import csv_text
from .report import anchor_of, render_page, safe_html
from .teacher_tables import EVERYBODY

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


class AnswerParts:
    """What the pages show of each answer, kept in a file until all are graded: it can be much."""

    def __init__(self, folder):
        self._file, self._places = tempfile.TemporaryFile(dir=folder), {}  # noqa: SIM115 - `close` closes it
        self.close = self._file.close

    def keep(self, learner, exercise, answer, body):
        """Keep the source of an answer, and its checks as HTML."""
        texts = [text.encode("utf-8") for text in (_coloured(answer), body)]
        self._places[learner, exercise] = self._file.seek(0, 2), *map(len, texts)
        self._file.writelines(texts)

    def read(self, learner, exercise):
        """(source, checks) of an answer, both HTML; empty if its page could not be written."""
        from jinja2.utils import markupsafe  # see `report.prepare_templates`

        start, *lengths = self._places.get((learner, exercise), (0, 0, 0))
        self._file.seek(start)
        return [markupsafe.Markup(self._file.read(length).decode("utf-8")) for length in lengths]


def _coloured(source):
    """A source as HTML; hidden characters are made visible before."""
    from jinja2.utils import markupsafe

    text = sanitize_text(source, 2 * _MOST_COLOURED)
    span, parts, end = markupsafe.Markup('<span class="{}">{}</span>'), [], 0
    for token in _TOKENS.finditer(text) if len(text) <= _MOST_COLOURED else ():
        parts += [text[end : token.start()], span.format(token.lastgroup, token[0])]
        end = token.end()
    return markupsafe.Markup("").join([*parts, text[end:]])


def review_pages(grades, parts, names, solutions):
    """Yields (path, HTML) of each page; `parts` are AnswerParts, `names` {shown name: the learner's}.

    `solutions(lesson)` gives {exercise: solution}, of what a person grades a model answer.
    """
    reviews = _reviews(grades["learners"])
    if reviews:
        yield "review.html", render_page("review.html", reviews=reviews)
    for one, *around in zip(reviews, [None, *reviews], [*reviews[1:], None], strict=False):
        content = {"review": one, "around": around, "parts": parts, "names": names, "model": ""}
        if one["rubric"]:
            content["model"] = safe_html(rendered_text(solutions(one["lesson"]["lesson"])[one["id"]]))
            content["line"] = csv_text([(EVERYBODY, one["lesson"]["lesson"], one["id"])], lineterminator="")
        yield one["path"], render_page("answers.html", script="review.js", **content)


def _reviews(learners):
    """The answers to each exercise: in `groups` first those who lost points alike, the most frequent way."""
    reviews: dict[str, dict] = {}
    ways: dict[str, dict] = {}
    for learner in learners:
        for lesson in learner["lessons"]:
            for exercise in lesson["exercises"]:
                id = exercise["id"]
                about = {"path": f"{FOLDER}/{id}.html", "lesson": lesson, "title": exercise["title"]}
                reviews.setdefault(id, about | {"id": id})
                cells = (learner["name"], lesson["lesson"], id)
                line = csv_text([map(spreadsheet_text, cells)], lineterminator="")
                answer = {"learner": learner, "lesson": lesson, "exercise": exercise, "line": line}
                answers = ways.setdefault(id, {}).setdefault(_way(exercise), [])
                answers.append(answer | {"anchor": anchor_of(learner)})
    for id, review in reviews.items():
        review["groups"] = sorted(ways[id].items(), key=_order)
        exercises = [answer["exercise"] for answers in ways[id].values() for answer in answers]
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
    label, message = TEXTS[case["outcome"]].label, case["message"]
    if case["outcome"] == Outcome.RAISED:
        message = "".join(re.findall(r"^[A-Z]\w+", message))
    is_drive = message.startswith("The robot ")  # and returned no other value
    return message if is_drive else f"{label} ({message})" if message else label
