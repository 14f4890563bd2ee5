"""Compare a learner's guess with the result, and answer questions from earlier lessons: no points."""

import builtins
import contextlib
import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import course
from .cell_syntax import names_of, top_level

_NO_GUESS = {"", "?"}
_CLOSE = 0.1  # of the result
_HUGE = 1e15  # beyond it, a float is not shown as a whole number, and nothing is close
_LONGEST = 60  # characters of a guess that are shown
_NUMBER = re.compile(r"[-+−]?\d+(?:[.,]\d+)*(?:e[-+]?\d+)?", re.I)
_NUMBER_IN_A_TUPLE = re.compile(r"[-+−]?\d+(?:\.\d+)?")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(,\d{3})+(\.\d+)?")
_PREDICT_CELL = re.compile(r"\s*(?P<name>guess(_\w+)?)\s*=[ \t]*(?P<guess>[^#\n]*?)[ \t]*(#[^\n]*)?\s*")
_ASK_CELL = re.compile(r'(?P<name>(from .+\n+)?ask\("[\w/-]+",)(?P<guess>[^#\n]*?)\)[ \t]*(#.*)?')
_QUOTES = "\"'“”„‘’«»"
_WORDS = {"yes": True, "true": True, "no": False, "false": False}


@dataclass(frozen=True)
class GuessComparison:
    """A guess beside the result; a notebook shows it as a line of text."""

    guess: str  # as text; "" if there is none yet
    result: str  # as text
    verdict: str = ""  # "Right!", "Close." or ""
    advice: str = ""  # what a guess can be, if this one cannot be read

    def __repr__(self):
        return self._sentence(str)

    def _repr_html_(self):
        return f"<div>{self._sentence(lambda text: f'<b>{html.escape(text)}</b>')}</div>"

    def _sentence(self, mark):
        if self.advice:
            return f"{self.advice} The result: {mark(self.result)}."
        if not self.guess:
            return f"No guess yet. The result is {mark(self.result)}."
        sentence = f"Your guess: {mark(self.guess)}. The result: {mark(self.result)}."
        return f"{sentence} {self.verdict}".rstrip()


def compare_guess(guess: object, value: object, unit: str = "") -> GuessComparison:
    """Show a learner's guess beside the result. It never raises, whatever the guess is.

    Parameters
    ----------
    guess : number, text, yes or no, or a tuple or list of these
        Numbers may be text: 36, "36", "about 36 %", "0,36", "720 x 1280". None, "" and ... are no guess yet.
    value : number, text, bool, or a tuple, list or one-dimensional array of these; the result
    unit : str, shown after numbers: "%", "gray levels"

    Returns
    -------
    GuessComparison : says "Right!" if both are equal as shown, "Close." within 10 % of the result
    """
    value = _plain(value)
    result = _text(value, unit)
    try:
        plain_guess = _plain(guess)
        if plain_guess is None or plain_guess in _NO_GUESS:
            return GuessComparison("", result)
        plain_guess = _as_kind_of(value, plain_guess, unit)
        verdict, text = _verdict(plain_guess, value, unit), _text(plain_guess, unit)
        text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
        return GuessComparison(text, result, verdict)
    except Exception:  # noqa: BLE001 - a guess can be any object of the learner's
        advice = 'A guess is a number, a text in quotes, such as "yes", or a tuple, such as (2, 3).'
        return GuessComparison("", result, advice=advice)


def ask(name: str, answer: object = None, *thousands: int) -> None:
    """Print why an answer to the question "<lesson that asks>/<name>" is right or wrong. It never raises.

    The answer is a letter, such as "b", or a number, also with commas: 691,200; None is no answer yet.
    """
    answer = (answer, *thousands) if thousands else answer
    lesson, _, name = str(name).partition("/")
    for folder in (Path(), *course.folders_of_lessons()):
        with contextlib.suppress(OSError, ValueError, KeyError):
            texts = json.loads((folder / "texts" / f"{lesson}.json").read_text(encoding="utf-8"))
            return print(_reply(texts[name], answer))
    return print("The folder texts/ must be beside the lesson: take it again where you got the lesson.")


def _reply(question, answer):
    value, replies, given = question["answer"], question["replies"], False
    with contextlib.suppress(Exception):  # an answer can be any object of the learner's
        given = _as_kind_of(value, _plain(answer), "")
    if given is None or given in _NO_GUESS:
        return "No answer yet. Write your answer in place of None, and run this cell again."
    key = _text(given, "").casefold().strip("() ")
    if _is_number(value) and _is_number(given):
        key = key if key in replies else "less" if given < value else "more"
    if key not in replies or _is_number(value) != _is_number(given):
        expected = "a number, such as 36" if _is_number(value) else f"one of {', '.join(replies)}, in quotes"
        return f"The answer is {expected}."
    return f"Right. {replies[key]}" if key == str(value) else f"Not yet. {replies[key]} {question['again']}"


def read_bare_guess(lines, names):
    """The lines of a cell, as IPython runs them: a guess that Python cannot read becomes a text.

    So does an answer to a question. A sentence then says how to write it. `names` are those that exist in
    the kernel; a cell that is no guess, or one that Python can read, stays as it is.
    """
    source = "".join(lines)
    asked = _ASK_CELL.fullmatch(source.strip())
    match = asked or _PREDICT_CELL.fullmatch(source)
    statements, known = list(map(names_of, top_level(source))), {*names, "ask", *dir(builtins)}
    if not match or (statements and all(one.reads <= known for one in statements)):
        return lines
    text = match["guess"].strip().strip(_QUOTES)
    guess = json.dumps(text, ensure_ascii=False) if match["guess"] else None
    code = f"{match['name']} {guess})" if asked else f"{match['name']} = {guess}"
    sentence = (
        f"Your {'answer' if asked else 'guess'} is taken as a text. Write a number alone, such as 36, and a"
        f" text in quotes: {code.splitlines()[-1]}"
    )
    return [*([f"print({sentence!r})\n"] if guess else []), f"{code}\n"]


def _plain(value):
    """A number, text, bool, None, or a tuple of them, of Python's own types; TypeError for anything else."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.size <= _LONGEST):
        value = value.tolist()
    if value is None or value is ...:
        return None
    if isinstance(value, bool | int | float):
        return value
    if isinstance(value, str):
        return value.strip().rstrip(".!")
    if isinstance(value, tuple | list) and len(value) <= _LONGEST:
        parts = tuple(_plain(part) for part in value)
        if not any(isinstance(part, tuple) for part in parts):
            return parts if any(part is not None for part in parts) else None
    raise TypeError(f"{type(value).__name__} is not a number, a text or a tuple of them")


def _as_kind_of(value, guess, unit):
    """The guess as the kind of value that the result is, if its text can be read so."""
    if isinstance(value, tuple):
        return _as_tuple(value, guess, unit)
    if isinstance(value, bool) and isinstance(guess, str):
        return _WORDS.get(guess.casefold().strip(".!"), guess)
    if _is_number(value) and isinstance(guess, tuple):  # 2,764,800 is a tuple for Python
        text = ",".join("000" if part == 0 else str(part) for part in guess)
        return _number(text) if _THOUSANDS.fullmatch(text) else guess
    matches = _NUMBER.findall(guess) if _is_number(value) and isinstance(guess, str) else ()
    if len(matches) == 1:
        number = _number(matches[0])
        is_fraction = guess.endswith("%") and unit != "%" and abs(value) <= 1
        return number / 100 if is_fraction else number
    return guess


def _as_tuple(value, guess, unit):
    if isinstance(guess, str):
        parts = tuple(_number(match) for match in _NUMBER_IN_A_TUPLE.findall(guess))
        return parts if parts and len(parts) == len(value) else guess
    if isinstance(guess, tuple) and len(guess) == len(value):
        return tuple(_as_kind_of(*pair, unit) for pair in zip(value, guess, strict=True))
    return guess


def _number(text):
    """The number that a text stands for: "0,36" is 0.36 and "1,280" is 1280."""
    text = text.replace("−", "-")
    text = text.replace(",", "") if _THOUSANDS.fullmatch(text) else text.replace(",", ".")
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < _HUGE else number


def _verdict(guess, value, unit):
    if _text(guess, unit).casefold() == _text(value, unit).casefold():
        return "Right!"
    if _is_number(guess) and _is_number(value) and abs(guess) < _HUGE:
        return "Close." if abs(guess - value) <= _CLOSE * abs(value) else ""
    return ""


def _is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def _text(value, unit):
    if isinstance(value, tuple):
        return f"({', '.join(_text(part, '') for part in value)}{',' if len(value) == 1 else ''})"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not _is_number(value):
        return str(value)
    is_whole = isinstance(value, int) or (value.is_integer() and abs(value) < _HUGE)
    number = str(int(value)) if is_whole else f"{value:.6g}"
    return f"{number} {unit}".rstrip()
