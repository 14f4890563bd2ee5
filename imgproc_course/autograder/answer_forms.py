"""Read what a check cell showed. It came from a learner's process and may be anything.

`is_form` accepts canonical forms only (see `exercises.canonical`), and only those that `exercises.compare`
can take: right types, a known dtype, data of the right length, limited depth.
"""

import base64
import binascii
import re

import numpy as np

from imgproc_course.exercises.running import CallResult

MAX_DEPTH = 12
_MAX_CHANGED, _MAX_PRINTED = 20, 2000  # names and characters of a call that are kept
_MAX_BASE64 = 64 << 20  # characters
_SCALAR = re.compile(r"numpy\.(bool|(u?int|float)(8|16|32|64)|longlong|ulonglong)_?")
_DTYPES = frozenset(np.dtype(code).name for code in "?bBhHiIlLqQefd")
_SPECIAL = ("nan", "inf", "-inf")
_DIGEST = re.compile(r"[0-9a-f]{64}")


def is_form(form, depth=0):
    """Whether a value from a learner's process is a canonical form that `compare` can take."""
    if not isinstance(form, dict) or depth > MAX_DEPTH or not _is_text(form.get("type")):
        return False
    kind = form["type"]
    if form.get("too_large") is True or form.get("opaque") is True:
        return len(kind) < 300 and ("shape" not in form or _is_array(form, opaque=True))
    if "fields" in form:
        fields = form["fields"]
        if not isinstance(fields, dict) or not all(_is_text(name) for name in fields):
            return False
        return all(is_form(field, depth + 1) for field in fields.values())
    if kind in ("tuple", "list"):
        items = form.get("items")
        return isinstance(items, list) and all(is_form(item, depth + 1) for item in items)
    if kind == "dict":
        items = form.get("items")
        return isinstance(items, list) and all(
            isinstance(pair, list) and len(pair) == 2 and all(is_form(part, depth + 1) for part in pair)
            for pair in items
        )
    if kind == "ndarray":
        return _is_array(form)
    if kind == "bytes":
        return _is_count(form.get("length")) and _has_data(form, form["length"])
    return _is_plain(kind, form.get("value"))


def _is_text(value):
    """Whether it is text that can be written to a file; lone surrogates cannot."""
    return isinstance(value, str) and not any("\ud800" <= character <= "\udfff" for character in value)


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
    return _has_data(form, size)


def _has_data(form, size):
    """Whether the form has data of so many bytes, or a digest."""
    if "data" not in form:
        return isinstance(form.get("digest"), str) and _DIGEST.fullmatch(form["digest"]) is not None
    if not isinstance(form["data"], str) or len(form["data"]) > _MAX_BASE64:
        return False
    try:
        return len(base64.b64decode(form["data"], validate=True)) == size
    except (ValueError, binascii.Error):
        return False


def read_answer(payload):
    """Read what a check cell showed.

    Parameters
    ----------
    payload : any value that JSON can hold

    Returns
    -------
    (calls, refused): list of CallResult, and list of str, the refused modules that the function uses; or None
    if our check cells cannot have shown this
    """
    if not isinstance(payload, dict) or not isinstance(payload.get("calls"), list):
        return None
    refused = payload.get("refused")
    if not isinstance(refused, list) or not all(isinstance(name, str) for name in refused):
        return None
    calls = read_calls(payload["calls"])
    return None if None in calls else (calls, refused)


def read_calls(entries):
    """Read what `check_cell.call_to_json` wrote: a list of CallResult, None for a malformed entry."""
    return [_read_call(entry) for entry in entries]


def _read_call(entry):
    if not isinstance(entry, dict):
        return None
    if entry.get("timed_out") is True:
        return CallResult(timed_out=True)
    changed, printed = entry.get("changed"), entry.get("printed")
    if not isinstance(changed, list) or not all(isinstance(name, str) for name in changed):
        return None
    if not isinstance(printed, str):
        return None
    fields = {"changed": tuple(changed[:_MAX_CHANGED]), "printed": printed[:_MAX_PRINTED]}
    if "error" in entry:
        texts = [entry.get(name) for name in ("error", "message", "line")]
        if not entry["error"] or not all(isinstance(text, str) for text in texts):
            return None
        return CallResult(error=texts[0], message=texts[1], line=texts[2], **fields)
    return CallResult(value=entry["value"], **fields) if is_form(entry.get("value")) else None
