"""Compare two canonical forms, and say in words where they differ.

Runs in the learner's notebook (`check`) and in the grader's process alike, on forms only: no object of the
learner's comes here.
"""

import base64
import hashlib
from dataclasses import dataclass

import numpy as np

from imgproc_course.exercises.canonical import array_of

# What rounding alone may cost, relative to the expected number: a sum taken in another order is not a
# mistake.
_ROUNDING = {"float16": 1e-2, "float32": 1e-5, "float64": 1e-9, "float": 1e-9}


@dataclass(frozen=True)
class Difference:
    """The first thing in which an answer differs from the expected one.

    kind      "type", "shape", "dtype", "length", "keys" or "value"
    where     path inside the answer, "" for the answer itself: "[1]", "['edges']"
    message   the difference as a sentence
    index     index of the first differing element of an array (row, col, ...), or None
    expected, actual   the two numbers at that place, or None
    count, total       how many elements of the array differ, of how many
    """

    kind: str
    where: str
    message: str
    index: tuple | None = None
    expected: object = None
    actual: object = None
    count: int = 0
    total: int = 0


def compare(expected, actual, tolerance=0.0, where=""):
    """The first difference between two canonical forms, or None.

    Numbers agree when |actual - expected| <= tolerance + rounding * |expected|; the rounding is 1e-9 for
    Python's floats and float64, 1e-5 for float32, 1e-2 for float16, and 0 for integers. NumPy's scalars count
    as Python's numbers, and an integer is good where a float is expected.

    Parameters
    ----------
    expected, actual : dict, from `canonical` with the same limit
    tolerance : float >= 0, absolute, in the unit of the answer
    where : str, path of the two inside the whole answer

    Returns
    -------
    Difference or None
    """
    wanted, got = _kind(expected), _kind(actual)
    if wanted != got and not (wanted == "float" and got == "int"):
        return Difference("type", where, f"{describe(actual)} came back, {describe(expected)} was expected")
    if actual.get("too_large") or actual.get("opaque"):
        return Difference("type", where, f"{describe(actual)} came back, which cannot be compared")
    if wanted == "ndarray":
        return _compare_arrays(expected, actual, tolerance, where)
    if wanted in ("tuple", "list"):
        return _compare_items(expected, actual, tolerance, where)
    if wanted == "dict":
        return _compare_dicts(expected, actual, tolerance, where)
    if wanted == "message":
        return _compare_fields(expected, actual, tolerance, where)
    if wanted == "bytes":
        same = _digest(expected) == _digest(actual)
    elif wanted in ("int", "float"):
        same = _close(expected, actual, tolerance)
    else:
        same = expected.get("value") == actual.get("value")
    if same:
        return None
    return Difference(
        "value",
        where,
        f"{describe(actual)} came back, {describe(expected)} was expected",
        expected=expected.get("value"),
        actual=actual.get("value"),
    )


def describe(form):
    """A canonical form in a few words: `an array of shape (5, 5), uint8`, `the text 'rgb8'`."""
    kind = _kind(form)
    if form.get("too_large"):
        return f"a very large {form['type']}"
    if kind == "ndarray":
        return f"an array of shape {tuple(form['shape'])}, {form['dtype']}"
    if kind == "None":
        return "None"
    if kind in ("tuple", "list"):
        return f"a {kind} of {len(form['items'])}"
    if kind == "dict":
        return f"a dict with the keys {', '.join(_key(key) for key, _ in form['items']) or 'none'}"
    if kind == "bytes":
        return f"{form['length']} bytes"
    if kind == "str":
        text = form["value"]
        return f"the text {text if len(text) <= 60 else text[:57] + '...'!r}"
    if kind == "bool":
        return str(form["value"])
    if kind in ("int", "float"):
        return f"the {'whole number' if kind == 'int' else 'float'} {_readable(form['value'])}"
    return f"an object of type {form['type']}"


def _kind(form):
    kind = form["type"]
    if "fields" in form:
        return "message"
    if not kind.startswith("numpy."):
        return kind
    scalar = kind.removeprefix("numpy.")
    return "bool" if scalar.startswith("bool") else "float" if scalar.startswith("float") else "int"


def _key(form):
    return repr(form.get("value", form["type"]))


def _readable(value):
    return value if isinstance(value, str) else f"{value:.10g}" if isinstance(value, float) else str(value)


def _float(value):
    return float(value)  # "nan", "inf" and "-inf" too


def _close(expected, actual, tolerance):
    if _kind(expected) == "int" and tolerance == 0:
        return expected["value"] == actual["value"]
    rounding = _ROUNDING.get(expected["type"].removeprefix("numpy."), 0.0)
    return bool(
        _near(np.float64(_float(expected["value"])), np.float64(_float(actual["value"])), tolerance, rounding)
    )


def _near(expected, actual, tolerance, rounding):
    with np.errstate(invalid="ignore", over="ignore"):
        near = np.abs(actual - expected) <= tolerance + rounding * np.abs(expected)
    finite = np.isfinite(expected) & np.isfinite(actual)
    return np.where(finite, near, (expected == actual) | (np.isnan(expected) & np.isnan(actual)))


def differing(expected, actual, tolerance=0.0):
    """Where two arrays of one shape differ by more than the tolerance.

    Parameters
    ----------
    expected, actual : ndarray of one shape
    tolerance : float >= 0, absolute

    Returns
    -------
    ndarray of bool, the arrays' shape
    """
    if expected.dtype.kind in "biu" and tolerance == 0:
        return expected != actual
    rounding = _ROUNDING.get(expected.dtype.name, 0.0)
    return ~_near(expected.astype(np.float64), actual.astype(np.float64), tolerance, rounding)


def _compare_arrays(expected, actual, tolerance, where):
    if expected["shape"] != actual["shape"]:
        wanted, got = tuple(expected["shape"]), tuple(actual["shape"])
        message = f"an array of shape {got} came back, shape {wanted} was expected"
        return Difference("shape", where, message)
    if expected["dtype"] != actual["dtype"]:
        message = f"an array of {actual['dtype']} came back, {expected['dtype']} was expected"
        return Difference("dtype", where, message)
    wanted, got = array_of(expected), array_of(actual)
    if wanted is None or got is None:
        if _digest(expected) == _digest(actual):
            return None
        return Difference("value", where, "the values differ", total=int(np.prod(expected["shape"])))
    wrong = differing(wanted, got, tolerance)
    count = int(wrong.sum())
    if not count:
        return None
    index = tuple(int(i) for i in np.argwhere(wrong)[0])
    one, other = wanted[index].item(), got[index].item()
    message = (
        f"{count} of {wrong.size} values differ; the first at {place(index)}: {_readable(other)} came back, "
    )
    message += f"{_readable(one)} was expected"
    return Difference("value", where, message, index, one, other, count, wrong.size)


def place(index):
    """An array index in words: `row 3, col 7, channel 2`."""
    names = {0: (), 1: ("index",), 2: ("row", "col"), 3: ("row", "col", "channel")}.get(len(index))
    if names is None:
        return f"index {index}"
    return ", ".join(f"{name} {i}" for name, i in zip(names, index, strict=True)) or "its only value"


def _digest(form):
    return form.get("digest") or hashlib.sha256(base64.b64decode(form["data"])).hexdigest()


def _compare_items(expected, actual, tolerance, where):
    if len(expected["items"]) != len(actual["items"]):
        return Difference("length", where, f"{describe(actual)} came back, {describe(expected)} was expected")
    pairs = zip(expected["items"], actual["items"], strict=True)
    found = (compare(one, other, tolerance, f"{where}[{k}]") for k, (one, other) in enumerate(pairs))
    return next((difference for difference in found if difference), None)


def _compare_dicts(expected, actual, tolerance, where):
    wanted, got = ({_key(key): value for key, value in form["items"]} for form in (expected, actual))
    if wanted.keys() != got.keys():
        return Difference("keys", where, f"{describe(actual)} came back, {describe(expected)} was expected")
    found = (compare(wanted[key], got[key], tolerance, f"{where}[{key}]") for key in wanted)
    return next((difference for difference in found if difference), None)


def _compare_fields(expected, actual, tolerance, where):
    if expected["fields"].keys() != actual["fields"].keys():
        return Difference("type", where, f"{describe(actual)} came back, {describe(expected)} was expected")
    fields = expected["fields"]
    found = (compare(fields[name], actual["fields"][name], tolerance, f"{where}.{name}") for name in fields)
    return next((difference for difference in found if difference), None)
