"""What an error of Python's or NumPy's means, in a plain sentence or two, and what to do about it.

The advice is for somebody who meets the error for the first time. It reads the error's type and message, and
the line that raised: `thinned > high and thinned < 9` needs another sentence than `if thinned > high:`.
"""

import ast
import re
import unicodedata
from pathlib import Path

from nbclassroom import course

# What a keyboard writes, for what a chat or a word processor puts in its place, or for a kind of character.
_PLAIN = {"\u2212": "-", "\u00d7": "*", "\u00f7": "/", "\u2264": "<=", "\u2265": ">=", "\u2260": "!="}
_PLAIN |= {"Pi": '"', "Pf": '"', "Ps": '"', "Pd": "-", "Cf": "", "\u3001": ",", "\u3002": "."}


def advice_on(error, message, line="", parameters=None, function="", closest=""):
    """What an error (its type's name and message) means and what to do; "" if nothing is certain.

    `line` is the line that raised it, with its number: "line 3: return gray[row, col]". `closest` is a name
    that exists, much like the one that was not found.
    """
    source = line.partition(": ")[2]
    call = f"{function}({', '.join(parameters)})" if parameters is not None else ""
    if call and message.startswith(f"{function}()") and "positional argument" in message:
        return f"check calls {call}: begin your function with def {call}: and use these arguments."
    did_you_mean = f"Did you mean {closest}? Every letter counts, small or capital." if closest else ""
    if closest.startswith("self."):
        did_you_mean = f"Write {closest}: what belongs to the object has self. before its name."
    for pattern, advice in _ADVICE.items():
        match = re.match(pattern, f"{error}: {message}\n{source}")
        if match:
            text = advice(match, source) if callable(advice) else match.expand(advice)
            return text if text.startswith("The name") else did_you_mean or text
    return did_you_mean


def advise_everywhere():
    """Gives this advice also on errors that the course shows elsewhere, such as those of a ROS callback."""
    advisers = course.load(course.error_advisers) if course.error_advisers else [advice_on]
    if advice_on not in advisers:
        advisers.append(advice_on)


def _nodes(source):
    """The syntax nodes of one line; () if the line is only a part of a statement."""
    text = re.sub(r"^el(?=if\b)", "", source.strip())
    try:
        return tuple(ast.walk(ast.parse(f"{text} pass" if text.endswith(":") else text)))
    except SyntaxError:
        return ()


def _ambiguous(_match, source):
    nodes = _nodes(source)
    chains = [node for node in nodes if isinstance(node, ast.Compare) and len(node.ops) > 1]
    parts = [part for node in nodes if isinstance(node, ast.BoolOp) for part in node.values]
    if any(isinstance(node, ast.BitAnd | ast.BitOr) for chain in chains for node in ast.walk(chain)):
        return "& is computed before > and <=. Put each comparison in parentheses: (a > low) & (a <= high)."
    if chains:
        return _ADVICE["<chained comparison>"]
    if parts:
        return _ADVICE["<and, or>"]
    return _ADVICE["<if, while>"]


def _broadcast(match, source):
    shapes_as_text = re.findall(r"\([\d,]*\)", match[1])
    # a += b names the shape of a twice
    shapes = list(dict.fromkeys(tuple(map(int, re.findall(r"\d+", shape))) for shape in shapes_as_text))
    rules = _broadcast_rules(shapes[0], shapes[-1], source) if len(shapes) == 2 else ()
    advice = next((advice for holds, advice in rules if holds), "")
    rule = "<shape of a place>" if "input array" in match[1] else "<equal shapes>"
    return f"{_ADVICE[rule]} {advice}".rstrip()


def _broadcast_rules(first, second, source):
    """(whether it holds, advice) of each rule about the different shapes of two arrays in a line."""
    yield len(first) == 2 and second == first[:1], _ADVICE["<number of each row>"]
    if len(first) != len(second):
        return
    has_kernel = any(shape in ((3, 3), (5, 5)) for shape in (first, second)) and re.search("kernel|:", source)
    yield has_kernel, _ADVICE["<kernel>"]
    is_square = len(second) == 2 and second[0] == second[1]
    yield is_square and re.search(r"[\w)\]] / [A-Za-z(]", source), _ADVICE["<division by a matrix>"]
    yield first == second[::-1], _ADVICE["<exchanged>"]
    gap = max((abs(a - b) for a, b in zip(first, second, strict=True)), default=0)
    yield gap <= 2, _ADVICE["<nearly one shape>"].format(gap)


def _index_outside(match, source):
    axis, size = match[1], int(match[2])
    advice = f"Python counts from 0, so {size - 1} is the last index of axis {axis}."
    if axis == "2":
        return f"{advice} Axis 2 of a colour image holds its channels."
    places = [node for node in _nodes(source) if isinstance(node, ast.Subscript)]
    read = [place for place in places if isinstance(place.ctx, ast.Load)] or places
    indices = [getattr(place.slice, "elts", [place.slice])[int(axis) :][:1] for place in read]
    sums = [part for index in indices for part in index if isinstance(getattr(part, "op", None), ast.Add)]
    is_one_array = len({ast.unparse(place.value) for place in read}) == 1
    steps = dict.fromkeys(ast.unparse(part) for part in sums if is_one_array)
    text = _ADVICE["<index with a sum>" if steps else "<index>"].format(" or ".join(steps))
    return f"{advice} {text}"


def _typographic(match, _source):
    character = match[1] or chr(int(match[2], 16))
    narrow = unicodedata.normalize("NFKC", character)  # of wide letters and spaces
    is_plain = narrow.isascii() and not narrow.isalnum()
    plain = narrow if is_plain else _PLAIN.get(character, _PLAIN.get(unicodedata.category(character)))
    name = match[1] or f"U+{match[2]}, which nobody sees,"
    if plain is None:
        return f"{name} is no character of Python, except in texts and comments."
    origin = f"{name} is no character of Python: chats, word processors and web pages write it"
    if not plain:
        return f"{origin}. Type this line again."
    written = {" ": "a space", '"': "\" or '"}.get(plain, plain)
    return f"{origin} in the place of {written}. Type {written} there."


_IMPORTS = dict.fromkeys(("math", "cv2", "os", "sys", "random", "itertools", "struct", "time"), "import {}")
_FROM_MATH = "sqrt log10 log floor ceil pi inf sin cos tan atan2 hypot radians"
_IMPORTS |= dict.fromkeys(_FROM_MATH.split(), "from math import {}")
_IMPORTS |= {"np": "import numpy as {}", "plt": "import matplotlib.pyplot as {}"}
_IMPORTS |= {"ndimage": "from scipy import {}", "norm": "from numpy.linalg import {}"}


def _unknown(match, _source):
    name = match[1]
    if name in _IMPORTS:
        line = _IMPORTS[name].format(name)
        return f"The name {name} is not known in this cell. Write its import line in it: {line}"
    return _ADVICE["<unknown name>"].format(name)


# {pattern of an error as Python prints it: a function of the match and of the line that raised}
_RULES = {
    "ValueError: .*truth value of an (?:empty )?array": _ambiguous,
    r"IndexError: .*index -?\d+ is out of bounds for axis (\d) with size (\d+)": _index_outside,
    "ValueError: (.*could not (?:be )?broadcast.*)": _broadcast,
    r"NameError: name '(\w+)' is not defined": _unknown,
    r"SyntaxError: invalid (?:non-printable )?character (?:'(.)' \()?U\+([0-9A-F]+)": _typographic,
}


def read_phrases(text):
    """{pattern: advice} of a text in which each advice stands, indented, below its pattern."""
    entries = (entry.split("\n", 1) for entry in re.split(r"\n+(?=\S)", text.strip()))
    return {pattern: " ".join(advice.split()) for pattern, advice in entries}


# A pattern of an error as Python prints it, and of the line that raised where that counts; below it what the
# error means, a template for the match. The first pattern that matches counts. What rules say has <brackets>.
_PHRASES = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
_ADVICE = read_phrases(_PHRASES) | _RULES
