"""The expected values, where nbval looks for a stored output, and what they say of an answer.

nbval compares with `!=`. A `Reference` stands in a check cell's stored output, and its `!=` is
`exercises.compare`, tolerance and all: `check` in a lesson and the grader agree. What it is compared with
came from a learner's process and may be anything; `is_form` lets only canonical forms through.
"""

import base64
import binascii
import re

import numpy as np

from imgproc_course.exercises.comparison import compare

DEEPEST = 12
_SCALAR = re.compile(r"numpy\.(bool|(u?int|float)(8|16|32|64)|longlong|ulonglong)_?")
_DTYPES = frozenset(np.dtype(code).name for code in "?bBhHiIlLqQefd")
_SPECIAL = ("nan", "inf", "-inf")
_DIGEST = re.compile(r"[0-9a-f]{64}")


def is_form(form, depth=0):
    """Whether something read from a learner's process is a canonical form that `compare` can take."""
    if not isinstance(form, dict) or depth > DEEPEST or not _is_text(form.get("type")):
        return False
    kind = form["type"]
    if form.get("too_large") is True or form.get("opaque") is True:
        return len(kind) < 300 and ("shape" not in form or _is_array(form, opaque=True))
    if "fields" in form:
        fields = form["fields"]
        if not isinstance(fields, dict) or not all(_is_text(name) for name in fields):
            return False
        return all(is_form(each, depth + 1) for each in fields.values())
    if kind in ("tuple", "list"):
        items = form.get("items")
        return isinstance(items, list) and all(is_form(each, depth + 1) for each in items)
    if kind == "dict":
        items = form.get("items")
        return isinstance(items, list) and all(
            isinstance(pair, list) and len(pair) == 2 and all(is_form(each, depth + 1) for each in pair)
            for pair in items
        )
    if kind == "ndarray":
        return _is_array(form)
    if kind == "bytes":
        return _is_count(form.get("length")) and _holds(form, form["length"])
    return _is_plain(kind, form.get("value"))


def _is_text(value):
    """Whether it is text that can be written down; lone surrogates cannot."""
    return isinstance(value, str) and not any("\ud800" <= each <= "\udfff" for each in value)


def _is_plain(kind, value):
    if kind == "None":
        return value is None
    if kind == "str":
        return _is_text(value)
    scalar = _SCALAR.fullmatch(kind)
    kind = kind.removeprefix("numpy.") if scalar else kind
    if kind.startswith("bool"):
        return isinstance(value, bool)
    if kind.startswith("float"):
        return value in _SPECIAL if isinstance(value, str) else _is_number(value)
    return (kind == "int" or scalar is not None) and isinstance(value, int) and not isinstance(value, bool)


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 2**1024


def _is_count(value):
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**40


def _is_array(form, *, opaque=False):
    shape, dtype = form.get("shape"), form.get("dtype")
    if not isinstance(shape, list) or len(shape) > 32 or not all(_is_count(length) for length in shape):
        return False
    if opaque:
        return _is_text(dtype) and len(dtype) < 300
    if not isinstance(dtype, str) or dtype not in _DTYPES:
        return False
    size = np.dtype(dtype).itemsize
    for length in shape:
        size *= length
    return _holds(form, size)


def _holds(form, length):
    if "data" not in form:
        return isinstance(form.get("digest"), str) and _DIGEST.fullmatch(form["digest"]) is not None
    if not isinstance(form["data"], str) or len(form["data"]) > 64 << 20:
        return False
    try:
        return len(base64.b64decode(form["data"], validate=True)) == length
    except (ValueError, binascii.Error):
        return False


def read_answer(payload):
    """What a check cell showed, as calls, or None where it is not what our check cells show.

    Parameters
    ----------
    payload : what JSON holds

    Returns
    -------
    (calls, refused): list of dict with "value" | "error", "message", "line" | "timed_out", and "changed",
    "printed"; list of str
    """
    if not isinstance(payload, dict) or not isinstance(payload.get("calls"), list):
        return None
    refused = payload.get("refused")
    if not isinstance(refused, list) or not all(isinstance(name, str) for name in refused):
        return None
    calls = [_read_call(told) for told in payload["calls"]]
    return None if None in calls else (calls, refused)


def _read_call(told):
    if not isinstance(told, dict):
        return None
    if told.get("timed_out") is True:
        return {"timed_out": True}
    changed, printed = told.get("changed"), told.get("printed")
    if not isinstance(changed, list) or not all(isinstance(name, str) for name in changed):
        return None
    if not isinstance(printed, str):
        return None
    read = {"changed": changed[:20], "printed": printed[:2000]}
    if "error" in told:
        texts = [told.get(name) for name in ("error", "message", "line")]
        if not all(isinstance(text, str) for text in texts):
            return None
        return read | dict(zip(("error", "message", "line"), texts, strict=True))
    return read | {"value": told["value"]} if is_form(told.get("value")) else None


def failing_call(expected, calls, tolerance):
    """The first call that did not do what was expected: (its number, the Difference or None), or None.

    Parameters
    ----------
    expected : list of canonical forms
    calls : list, from `read_answer`
    tolerance : float
    """
    for number, form in enumerate(expected):
        if number >= len(calls) or "value" not in calls[number] or calls[number]["changed"]:
            return number, None
        difference = compare(form, calls[number]["value"], tolerance)
        if difference is not None:
            return number, difference
    return (len(expected), None) if len(calls) > len(expected) else None


def did_the_same(call, other, tolerance):
    """Whether two calls did the same, so that one is the other's mistake."""
    for name, default in (("timed_out", False), ("error", ""), ("changed", [])):
        if call.get(name, default) != other.get(name, default):
            return False
    return "value" not in other or compare(other["value"], call["value"], tolerance) is None


class Reference:
    """An expected answer that nbval can compare with: `reference != shown`."""

    def __init__(self, expected, tolerance):
        self._expected, self._tolerance = expected, tolerance

    def __ne__(self, shown):
        read = read_answer(shown)
        if read is None:
            return True
        calls, refused = read
        return bool(refused) or failing_call(self._expected, calls, self._tolerance) is not None

    def __eq__(self, shown):
        return not self != shown

    __hash__ = None

    def __repr__(self):
        return "<the expected answer>"
