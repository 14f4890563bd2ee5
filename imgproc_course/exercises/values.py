"""A canonical form as a reader sees it: a small table of numbers, a line of words.

`check` and the graded report both show values in this way. The texts hold what a learner's program made: who
writes them into a page escapes them.
"""

import base64

import numpy as np

from imgproc_course.exercises.canonical import array_of
from imgproc_course.exercises.comparison import describe, differing

MOST_NUMBERS = 144  # a larger array is described or drawn, not printed
_FIRST = 8  # bytes of a long row of them that are printed
_MOST_PARTS = 6
_MOST_ITEMS = 40
_DEEPEST = 2
_LONGEST = 60  # characters of a text inside another value


def parts_of(expected, actual):
    """An answer's parts: itself, or what its tuple, list, dict or message holds, where arrays are among that.

    Parameters
    ----------
    expected, actual : canonical forms; actual is None where nothing came back

    Returns
    -------
    list of (name, expected form, actual form or None); the name is "" for the whole answer
    """
    inner = _named_items(expected)
    if not any(form["type"] == "ndarray" for _, form in inner) or len(inner) > _MOST_PARTS:
        return [("", expected, actual)]
    came_back = dict(_named_items(actual)) if actual is not None else {}
    if actual is not None and came_back.keys() != {name for name, _ in inner}:
        return [("", expected, actual)]
    return [(name, form, came_back.get(name)) for name, form in inner]


def _named_items(form):
    if form["type"] in ("tuple", "list"):
        return [(f"[{number}]", item) for number, item in enumerate(form.get("items", ()))]
    if form["type"] == "dict":
        return [(f"[{in_words(key, 1)}]", value) for key, value in form.get("items", ())]
    return [(f".{name}", value) for name, value in form.get("fields", {}).items()]


def wrong_of(expected, actual, tolerance):
    """Which elements of an array differ, as a bool array; None where that cannot be said.

    Parameters
    ----------
    expected, actual : canonical forms, or None
    tolerance : float
    """
    expected, actual = array_of(expected), array_of(actual)
    if expected is None or actual is None or (expected.shape, expected.dtype) != (actual.shape, actual.dtype):
        return None
    return differing(expected, actual, tolerance)


def rows_of(form, wrong=None):
    """A small array, or the bytes of a small picture's message, as a table.

    Parameters
    ----------
    form : canonical form, or None
    wrong : bool array, which elements differ, or None

    Returns
    -------
    tuple of rows of (text, whether it differs); () where words are enough
    """
    values = array_of(form)
    if values is None:
        values = _rows_of_message(form)
    if values is None or not 0 < values.size <= MOST_NUMBERS or values.ndim not in (1, 2, 3):
        return ()
    wrong = np.zeros(values.shape, bool) if wrong is None else wrong
    if values.ndim == 1:
        values, wrong = values[np.newaxis], wrong[np.newaxis]
    return tuple(
        tuple((_element(value), bool(np.any(mark))) for value, mark in zip(row, marks, strict=True))
        for row, marks in zip(values, wrong, strict=True)
    )


def _rows_of_message(form):
    """(height, step) uint8, the bytes of an Image's data, or None for anything else."""
    fields = {} if form is None else form.get("fields", {})
    height, step = (fields.get(name, {}).get("value") for name in ("height", "step"))
    raw = _bytes_of(fields["data"]) if "data" in fields else None
    if raw is None or type(height) is not int or type(step) is not int or height * step != len(raw):
        return None
    return np.frombuffer(raw, np.uint8).reshape(height, step) if height > 0 and step > 0 else None


def _bytes_of(form):
    if "data" in form and (form["type"] == "bytes" or form.get("dtype") == "uint8"):
        return base64.b64decode(form["data"])
    return None


def _element(value):
    text = " ".join(_number(number) for number in np.atleast_1d(value))
    return f"({text})" if np.ndim(value) else text


def _number(value):
    return f"{value:.6g}" if value.dtype.kind == "f" else str(value)


def in_words(form, depth=0):
    """A value in a line: the whole of a short one, what it is and how it begins of a long one.

    Parameters
    ----------
    form : canonical form
    depth : int, in how many other values it lies

    Returns
    -------
    str
    """
    if form["type"] == "ndarray":
        return _array_in_words(form, depth)
    if form["type"] == "bytes" and "data" in form:
        return _bytes_in_words(base64.b64decode(form["data"]))
    if depth and "value" in form:
        return _cut(repr(form["value"]))
    if depth > _DEEPEST:
        return describe(form)
    if "fields" in form:
        fields = ", ".join(f"{name}={_field_in_words(form, name, depth)}" for name in form["fields"])
        table = "; data in rows of step bytes" if rows_of(form) else ""
        return f"({fields})" if depth else f"an object with the fields {fields}{table}"
    if form["type"] in ("tuple", "list") and 0 < len(form.get("items", ())) <= _MOST_ITEMS:
        items = ", ".join(in_words(item, depth + 1) for item in form["items"])
        return f"a {form['type']} of {len(form['items'])}: {items}"
    if form["type"] == "dict" and "items" in form:
        pairs = form["items"][:_MOST_ITEMS]
        return "a dict: " + ", ".join(f"{in_words(k, depth + 1)}: {in_words(v, depth + 1)}" for k, v in pairs)
    return describe(form)


def _field_in_words(form, name, depth):
    raw = _bytes_of(form["fields"][name]) if name == "data" else None
    return in_words(form["fields"][name], depth + 1) if raw is None else _bytes_in_words(raw)


def _cut(text):
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def _array_in_words(form, depth):
    values = array_of(form)
    if values is None or not values.size or (depth == 0 and rows_of(form)):
        return describe(form)
    if depth and values.size <= _FIRST:
        return str(values.tolist())
    return f"{describe(form)}, from {_number(values.min())} to {_number(values.max())}"


def _bytes_in_words(raw):
    if not raw:
        return "no bytes"
    if len(raw) <= _FIRST:
        return f"bytes({list(raw)})"
    return f"{len(raw)} bytes ({', '.join(str(each) for each in raw[:_FIRST])}, …)"
