"""Questions that come back, with which lessons open; `questions.toml` beside the masters describes them."""

from .. import course
from ..exercises.percent_script import MasterError, ScriptCell
from .glossary import read_toml
from .lesson_names import lesson_name

QUESTIONS = "questions.toml"
OF_QUESTIONS = ("question", "ask")  # the roles of their cells: a text, and a call of `ask`
_KEYS = {"section", "asked", "question", "answer", "replies"}
_INTRODUCTION = """\
## Two questions from earlier lessons ([[minutes]])

No points: write your answer in place of `None`, and run the cell."""


def read_questions(path):
    """{name: entry} of a questions.toml; none without the file. MasterError names faults."""
    entries = read_toml(path)
    for name, entry in entries.items():
        replies = {str(entry.get("answer")), *entry.get("options", ("less", "more"))}
        missing = (_KEYS - set(entry)) or (replies - set(entry["replies"]))
        if missing:
            raise MasterError(f'{path.name}: ["{name}"] has no {", ".join(sorted(missing))}; add it')
    return entries


def with_questions(cells, path, references):
    """A master's cells, with questions before the first section; and what is stored of these."""
    lesson, asked, stored, text = lesson_name(path.stem), [], {}, _INTRODUCTION
    for name, entry in read_questions(path.with_name(QUESTIONS)).items():
        if lesson not in entry["asked"]:
            continue
        replies = {given: references.in_text(reply) for given, reply in entry["replies"].items()}
        again = references.in_text(f"Read [[{entry['section']}]] again.")
        stored[name] = {"answer": entry["answer"], "replies": replies, "again": again}
        options = entry.get("options", {})
        text += f"\n\n**{len(stored)}.** {entry['question']}\n"
        text += "".join(f"\n- **{letter}** {option}" for letter, option in options.items())
        expected = " or ".join(f'"{letter}"' for letter in options) or "a number"
        call = f'ask("{lesson}/{name}", None)  # your answer: {expected}'
        source = f"from {course.face} import ask\n\n{call}"
        asked.append(ScriptCell("markdown", "question", {}, text.strip(), 0, QUESTIONS))
        asked.append(ScriptCell("code", "ask", {}, source, 0, QUESTIONS))
        text = ""
    texts = [place for place, cell in enumerate(cells) if cell.kind == "markdown"]
    place = [*texts, len(cells), len(cells)][1]
    return (*cells[:place], *asked, *cells[place:]), stored
