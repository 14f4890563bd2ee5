"""The one comparison of a test case: what its check cell showed, against what the key expects.

What it showed came from a learner's process and may be anything. `read_form` accepts canonical forms only
(see `exercises.canonical`), and makes each of them anew from the keys that its type has: right types, a known
dtype, data of the right length, limited size and depth. So code that compares, describes or draws a form
meets only what `canonical` itself could have written.
"""

import base64
import re
import sys
from dataclasses import dataclass, field
from typing import Any

import msgspec
import numpy as np

from ..exercises.canonical import MOST_CHARACTERS, MOST_INT_BITS, PLAIN_TYPES, SCALARS
from ..exercises.running import CallResult, Verdict
from .sandbox.fork_server_client import CellRun

_MOST_DEPTH = 10  # one more than `canonical` writes
_MOST_FORMS = 50_000  # in one value; `canonical` stops at 20,000 items, and an item of a dict is two
_MOST_BYTES = 1 << 40  # of an array that is given by its digest
_MOST_CALLS = 1_000
_MOST_CHANGED, _MOST_TEXT, _MOST_NAME = 20, 2_000, 300  # names, characters
_SCALARS = {f"numpy.{scalar.__name__}": np.dtype(scalar) for scalar in SCALARS}
_DTYPES = {np.dtype(code).name: np.dtype(code) for code in "?bBhHiIlLqQefd"}
_CONTAINERS = ("tuple", "list", "dict")


@dataclass(eq=False)
class CaseRun:
    """One test case in its kernel: how the answer cell and then the check cell ended, and the verdict.

    nbval gets it as the output of a check, and asks `stored != shown`, where the stored output is that of the
    answer key; if so, it lets the check's cell fail. `==` is our comparison: the verdict compared what was
    shown with just these stored values.
    """

    answer: CellRun = field(default_factory=CellRun)
    check: CellRun = field(default_factory=CellRun)
    verdict: Verdict = field(default_factory=Verdict)  # or that of a partner, see `kinds.kind.Kind.partner`
    told: list = field(default_factory=list)  # what the kernel showed beside a partner: no verdict reads it
    let_fail: bool = False  # by nbval

    @property
    def ended(self):
        """How the kernel was ended, "" if it was not (see CellRun)."""
        return self.answer.ended or self.check.ended

    @property
    def passed(self):
        return not (self.ended or self.check.error[0] or self.let_fail) and self.verdict.passed

    def __eq__(self, stored):
        expected = (call.expected.value for call in self.verdict.calls)
        known = [value for value in expected if value is not None]  # there is none of a drive
        is_output = isinstance(stored, dict) and [call["value"] for call in stored["calls"]] == known
        return is_output and self.verdict.passed


def verdict_on(exercise, case, payloads):
    """The Verdict on the one payload that a check cell showed, against the calls of a case.

    The comparison is `Exercise.judge`, so `check` in a lesson and the autograder agree.
    """
    results = read_answer(payloads)
    if results is None:
        return Verdict()
    calls = [exercise.judge(case, *pair) for pair in zip(case.calls, results, strict=False)]
    are_others = len(results) != len(case.calls) and all(call.passed for call in calls)
    return Verdict(calls, "its check cell reported other calls than were made" if are_others else "")


def read_form(data):
    """A canonical form, made from what a learner's process sent; None if it is no canonical form."""
    try:
        return _read(data, 0, iter(range(_MOST_FORMS)))
    except ValueError:
        return None


def _read(data, depth, forms):
    """A form at a depth; each takes one of the `forms` that are left for the whole value."""
    _require(isinstance(data, dict) and depth <= _MOST_DEPTH and next(forms, None) is not None)
    kind = _text(data.get("type"), _MOST_NAME)
    if data.get("too_large") is True:
        _require(kind in ("int", "str", *_CONTAINERS))
        return {"type": kind, "too_large": True}
    if kind == "ndarray":
        return _array(data)
    if data.get("opaque") is True:
        _require(kind not in PLAIN_TYPES and kind not in _SCALARS)
        return {"type": kind, "opaque": True}
    if kind in _CONTAINERS:
        return {"type": kind, "items": _items(kind, data.get("items"), depth + 1, forms)}
    if kind == "bytes":
        length = _length(data.get("length"))
        return {"type": kind, "length": length} | _data(data, length)
    if kind == "None":
        return {"type": kind}
    if kind in PLAIN_TYPES or kind in _SCALARS:
        return {"type": kind, "value": _plain(kind, data.get("value"))}
    fields = data.get("fields")
    _require(isinstance(fields, dict))
    read = {_text(name, _MOST_NAME): _read(field, depth + 1, forms) for name, field in fields.items()}
    return {"type": kind, "fields": read}


def _items(kind, items, depth, forms):
    _require(isinstance(items, list))
    if kind != "dict":
        return [_read(item, depth, forms) for item in items]
    _require(all(isinstance(pair, list) and len(pair) == 2 for pair in items))
    return [[_read(part, depth, forms) for part in pair] for pair in items]


def _require(condition):
    if not condition:
        raise ValueError("no canonical form")


def _text(value, most_characters):
    """A text that is not too long and can be written to a file; lone surrogates cannot."""
    _require(isinstance(value, str) and len(value) <= most_characters)
    value.encode("utf-8")
    return value


def _plain(kind, value):
    if kind == "str":
        return _text(value, 6 * MOST_CHARACTERS)  # a lone surrogate is written as six characters
    dtype = _SCALARS.get(kind)
    if kind == "bool" or (dtype and dtype.kind == "b"):
        _require(isinstance(value, bool))
    elif kind == "float" or (dtype and dtype.kind == "f"):
        if isinstance(value, str):
            _require(value in ("nan", "inf", "-inf"))
            return value
        _require(isinstance(value, (int, float)) and not isinstance(value, bool))
        _require(abs(value) <= sys.float_info.max)
        return float(value)
    else:
        _require(isinstance(value, int) and not isinstance(value, bool))
        limits = np.iinfo(dtype) if dtype else None
        _require(limits.min <= value <= limits.max if limits else value.bit_length() <= MOST_INT_BITS)
    return value


def _length(value):
    _require(isinstance(value, int) and not isinstance(value, bool) and 0 <= value < _MOST_BYTES)
    return value


def _array(data):
    shape, name = data.get("shape"), _text(data.get("dtype"), _MOST_NAME)
    _require(isinstance(shape, list) and len(shape) <= 64)  # NumPy's limit
    form = {"type": "ndarray", "dtype": name, "shape": [_length(length) for length in shape]}
    size = _DTYPES[name].itemsize if name in _DTYPES else 1
    for length in shape:
        size *= max(length, 1)  # NumPy refuses a shape whose other lengths are too large, beside a 0 as well
    _require(size < _MOST_BYTES)
    if data.get("opaque") is True:
        return form | {"opaque": True}
    _require(name in _DTYPES)
    return form | _data(data, 0 if 0 in shape else size)


def _data(data, size):
    """The data of a form, of so many bytes; or its digest."""
    if "data" not in data:
        digest = _text(data.get("digest"), 64)
        _require(re.fullmatch(r"[0-9a-f]{64}", digest))
        return {"digest": digest}
    encoded = _text(data["data"], (size + 2) // 3 * 4)
    _require(len(base64.b64decode(encoded, validate=True)) == size)
    return {"data": encoded}


def read_answer(payloads):
    """What a check cell showed, as a list of CallResult; None if ours cannot have shown it so, once."""
    payload = payloads[0] if len(payloads) == 1 else None
    if not isinstance(payload, dict) or not isinstance(payload.get("calls"), list):
        return None
    calls = list(map(read_call, payload["calls"][:_MOST_CALLS]))
    return None if None in calls else calls


class _Call(msgspec.Struct):
    """A call that ended in time, as `check_cell.call_to_json` writes it: with a value or an error."""

    changed: list[str]
    printed: str
    value: Any = None
    error: str = ""
    message: str = ""
    line: str = ""


def read_call(entry):
    """The CallResult that `check_cell.call_to_json` wrote; None for a malformed entry."""
    if isinstance(entry, dict) and entry.get("timed_out") is True:
        return CallResult(timed_out=True)
    try:
        call = msgspec.convert(entry, _Call)
    except msgspec.ValidationError:
        return None
    value = None if call.error else read_form(call.value)
    if value is None and not call.error:
        return None
    texts = {name: getattr(call, name)[:_MOST_TEXT] for name in ("error", "message", "line", "printed")}
    changed = tuple(name[:_MOST_NAME] for name in call.changed[:_MOST_CHANGED])
    return CallResult(value, **texts, changed=changed)
