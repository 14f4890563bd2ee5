"""Predictions whose answer stands above the question: in the text, a heading, the goals or an output."""

import re
from typing import NamedTuple

from nbclassroom.authoring.execute import output_texts

_RESULT = re.compile(r"The result is (.*)\.$", re.M)
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_DIGITS = ("zero|no|none|nothing", "1", "two", "three", "four", "five", "six", "seven", "eight", "nine")
_TAG_OR_ARRAY = re.compile(r"<[^>]*>|\[[^\[\]]*\]")  # of an output
_NO_ANSWER = re.compile(r"\*\*Time\*\*.*|^(#+) \d+ ·|\(\d+ minutes?.*\)$|\bsections? \d+", re.M)
_HEADING, _GOAL = re.compile(r"^#+ .*", re.M), re.compile(r"^- .*", re.M)
_SENTENCE = re.compile(r"(?<=[.?!:])\s+|\n\n+|\n(?=[-|#])")
_WORD = re.compile(r"[a-z]{4,}")
_OF_QUESTIONS = {"predict", "which", "many", "much", "what", "your", "this", "that", "with", "from", "they"}


class Spoiled(NamedTuple):
    """A prediction (cell id), its answer, and the words above it that give the answer."""

    prediction: str
    answer: str
    words: str


def spoiled_predictions(cells):
    """The Spoiled of a lesson's stored cells; an answer "yes" or "no" is not looked for.

    A number is looked for everywhere above, with its unit if it has one. A word, and a whole number from 0 to
    9 without a unit, are looked for in sentences that hold half of the words of the question; a word and 0
    (nothing) also in the headings and the goals. The numbers of a printed array are data, and not looked at.
    """
    found, texts = [], []
    for position, cell in enumerate(cells):
        if cell.id.startswith("predict-"):
            before, _, question = texts[-1].rpartition("**Predict")
            answer = _answer(cells[position + 1 :])
            words = _words_that_give(answer, question, [*texts[:-1], before])
            found += [Spoiled(cell.id, answer, words)] if words else []
        text = (
            cell.source
            if cell.cell_type == "markdown"
            else _TAG_OR_ARRAY.sub(" ", "\n".join(output_texts(cell)))
        )
        texts.append(_NO_ANSWER.sub(r"\1", text).replace("−", "-"))
    return found


def _answer(cells):
    outputs = ("\n".join(output_texts(cell)) for cell in cells if cell.cell_type == "code")
    return next(match[1] for match in map(_RESULT.search, outputs) if match).replace("−", "-")


def _words_that_give(answer, question, texts):
    """The first words in the texts that give the answer; "" if none do."""
    headings = [line for text in texts for line in _HEADING.findall(text)] + _GOAL.findall(texts[0])
    sentences = [sentence for text in texts for sentence in _SENTENCE.split(text)]
    asked = set(_WORD.findall(question.lower())) - _OF_QUESTIONS
    near = [text for text in sentences if 2 * len(asked & set(_WORD.findall(text.lower()))) >= len(asked)]
    numbers = _NUMBER.findall(answer)
    if answer in ("yes", "no"):
        return ""
    if not numbers:
        return _first(rf"(?i)\b{re.escape(answer)}\b", headings + near)
    if re.fullmatch(r"\d", answer):
        pattern = rf"(?i)\b(?:{answer}|{_DIGITS[int(answer)]})\b(?![.,]\d)"
        return _first(pattern, near if int(answer) else headings + near)
    unit = re.escape(answer.rpartition(numbers[-1])[2].strip(" )"))
    texts = [re.sub(r"(?<=\d),(?=\d{3}\b)", "", text) for text in texts]
    number = r"[ ,()x×]{1,3}".join(map(re.escape, numbers))
    return _first(
        rf"(?<![\w.,-]){number}(?!\d|[.,]\d)" + (rf" ?{unit}(?![\w/])" if unit else r"(?!\w)"), texts
    )


def _first(pattern, texts):
    for text in texts:
        if match := re.search(pattern, text):
            return " ".join(text[max(0, match.start() - 60) : match.end() + 40].split())
    return ""
