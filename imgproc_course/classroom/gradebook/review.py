"""The pages on which a teacher reads answers and decides: review.html, and one page per exercise.

A page shows each learner's answer as it was graded, beside its checks; learners whose answers fail alike
follow each other. What is typed there becomes lines for decisions.csv, to copy, or saved by `grade --review`.
"""

import re
import tempfile
from dataclasses import dataclass, field

from ..autograder.outcomes import TEXTS, Outcome
from ..autograder.sanitize import sanitize_text, spreadsheet_text
from .csv_table import csv_text
from .report import anchor_of, render_page

FOLDER = "review"
_MOST_COLOURED = 20_000  # characters of an answer; a longer one takes time


class AnswerParts:
    """What the pages show of each answer, kept in a file until all are graded: it can be much."""

    def __init__(self):
        self._file, self._places = tempfile.TemporaryFile(), {}  # noqa: SIM115 - `close` closes it
        self.close = self._file.close

    def keep(self, learner, exercise, answer, body):
        """Keep the source of an answer, and its checks as HTML."""
        self._places[learner, exercise] = []
        for text in (_coloured(answer), body):
            data = text.encode("utf-8")
            self._places[learner, exercise].append((self._file.seek(0, 2), len(data)))
            self._file.write(data)

    def read(self, learner, exercise):
        """(source, checks) of an answer, both HTML; empty if its page could not be written."""
        return [self._read(*place) for place in self._places.get((learner, exercise), ((0, 0), (0, 0)))]

    def _read(self, start, length):
        from jinja2.utils import markupsafe  # see `report.prepare_templates`

        self._file.seek(start)
        return markupsafe.Markup(self._file.read(length).decode("utf-8"))


def _coloured(source):
    """A source as HTML; hidden characters are made visible before."""
    from jinja2.utils import markupsafe
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers.python import PythonLexer

    text = sanitize_text(source, 2 * _MOST_COLOURED)
    if len(text) > _MOST_COLOURED:
        return markupsafe.escape(text)
    return highlight(text, PythonLexer(stripnl=False), HtmlFormatter(nowrap=True))


@dataclass
class _Review:
    """The answers to one exercise: {how they end, in words: answers}."""

    lesson: dict
    exercise: dict
    ways: dict = field(default_factory=dict)

    @property
    def groups(self):
        """[(words, answers)]: first those who lost points alike, the most frequent way first."""
        return sorted(self.ways.items(), key=lambda item: (item[0] == (), -len(item[1]), item[0]))


def review_pages(grades, parts, names):
    """Yields (path below the folder of grades, HTML) of the pages; `parts` are the AnswerParts.

    `grades` are those to show, and `names` {name to show: the learner's name}.
    """
    reviews = _reviews(grades["learners"])
    about = [
        {"path": f"{FOLDER}/{id}.html", "id": id, "lesson": one.lesson, "title": one.exercise["title"]}
        | {"groups": one.groups, "count": sum(map(len, one.ways.values()))}
        for id, one in reviews.items()
    ]
    if about:
        yield "review.html", render_page("review.html", reviews=about)
    for place, one in enumerate(about):
        neighbours = about[place - 1] if place else None, about[place + 1] if about[place + 1 :] else None
        content = {"review": one, "around": neighbours, "parts": parts, "names": names}
        yield one["path"], render_page("answers.html", script="review.js", **content)


def _reviews(learners):
    reviews = {}
    for learner in learners:
        for lesson in learner["lessons"]:
            for exercise in lesson["exercises"]:
                review = reviews.setdefault(exercise["id"], _Review(lesson, exercise))
                cells = (learner["name"], lesson["lesson"], exercise["id"])
                answer = {"learner": learner, "lesson": lesson, "exercise": exercise}
                answer["line"] = csv_text([map(spreadsheet_text, cells)], lineterminator="")
                review.ways.setdefault(_way(exercise), []).append(answer | {"anchor": anchor_of(learner)})
    return reviews


def _way(exercise):
    """How an answer fails, in words: equal words, the same checks in the same way; () if all pass."""
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
    return f"{label} ({message})" if message else label
