"""A canonical form for a reader: a small table of numbers, or one line of text.

`check` and the graded report both show values in this way. The texts hold values of a learner's program:
escape them in a page.
"""

import base64

import numpy as np

from .canonical import array_of
from .comparison import describe, differing, named_items

MOST_NUMBERS = 144  # a larger array is described or drawn, not printed
_FIRST_BYTES = 8  # of a long sequence
_MOST_PARTS = 6
_MOST_ITEMS = 40
_MOST_DEPTH = 2
_MOST_CHARACTERS = 60  # of a text inside another value


def answer_parts(expected, actual):
    """(name, expected form, actual form or None) of each item of a tuple, list, dict or message with arrays.

    Another answer is one part, the whole, with the name "".
    """
    items = named_items(expected)
    if not any(form["type"] == "ndarray" for _, form in items) or len(items) > _MOST_PARTS:
        return [("", expected, actual)]
    actual_items = dict(named_items(actual)) if actual is not None else {}
    if actual is not None and actual_items.keys() != {name for name, _ in items}:
        return [("", expected, actual)]
    return [(name, form, actual_items.get(name)) for name, form in items]


def differing_elements(expected, actual, tolerance):
    """Which elements of two arrays differ, as bools; None for two shapes, or for numbers and bools."""
    expected, actual = array_of(expected), array_of(actual)
    if expected is None or actual is None or expected.shape != actual.shape:
        return None
    if (expected.dtype == bool) != (actual.dtype == bool):
        return None
    return differing(expected, actual, tolerance)


def table_rows(form, wrong=None):
    """A small array, or the bytes of a small image message, as rows of (text, whether it differs), or ()."""
    values = array_of(form)
    if values is None:
        values = _rows_of_message(form)
    if values is None or not 0 < values.size <= MOST_NUMBERS or values.ndim not in (1, 2, 3):
        return ()
    wrong = np.zeros(values.shape, bool) if wrong is None else wrong
    if values.ndim == 1:
        values, wrong = values[np.newaxis], wrong[np.newaxis]
    wrong = wrong.any(axis=2) if values.ndim == 3 else wrong
    rows = zip(values, wrong.tolist(), strict=True)
    return tuple(tuple(zip(map(_number, row), marks, strict=True)) for row, marks in rows)


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


def _number(value):
    if np.ndim(value):
        return f"({' '.join(map(_number, value))})"
    return f"{value:.6g}" if value.dtype.kind == "f" else str(value)


def describe_value(form, depth=0):
    """A value in one line: a short one whole, a long one by type and beginning; `depth` values hold it."""
    if form["type"] == "ndarray":
        return _describe_array(form, depth)
    if form["type"] == "bytes" and "data" in form:
        return _describe_bytes(base64.b64decode(form["data"]))
    if depth and "value" in form:
        text = repr(form["value"])
        return text if len(text) <= _MOST_CHARACTERS else f"{text[: _MOST_CHARACTERS - 1]}…"
    if depth > _MOST_DEPTH:
        return describe(form)
    if "fields" in form:
        fields = ", ".join(f"{name}={_describe_field(form, name, depth)}" for name in form["fields"])
        table = "; data in rows of step bytes" if table_rows(form) else ""
        return f"({fields})" if depth else f"an object with the fields {fields}{table}"
    if form["type"] in ("tuple", "list") and 0 < len(form.get("items", ())) <= _MOST_ITEMS:
        items = ", ".join(describe_value(item, depth + 1) for item in form["items"])
        return f"a {form['type']} of {len(form['items'])}: {items}"
    if form["type"] == "dict" and "items" in form:
        pairs = form["items"][:_MOST_ITEMS]
        texts = (f"{describe_value(k, depth + 1)}: {describe_value(v, depth + 1)}" for k, v in pairs)
        return f"a dict: {', '.join(texts)}"
    return describe(form)


def _describe_field(form, name, depth):
    raw = _bytes_of(form["fields"][name]) if name == "data" else None
    return describe_value(form["fields"][name], depth + 1) if raw is None else _describe_bytes(raw)


def _describe_array(form, depth):
    values = array_of(form)
    if values is None or not values.size or (depth == 0 and table_rows(form)):
        return describe(form)
    if depth and values.size <= _FIRST_BYTES:
        return str(values.tolist())
    return f"{describe(form)}, from {_number(values.min())} to {_number(values.max())}"


def _describe_bytes(raw):
    if not raw:
        return "no bytes"
    if len(raw) <= _FIRST_BYTES:
        return f"bytes({list(raw)})"
    return f"{len(raw)} bytes ({', '.join(str(value) for value in raw[:_FIRST_BYTES])}, …)"
