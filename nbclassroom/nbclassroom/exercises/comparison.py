"""Compare two canonical forms, and describe their first difference.

This runs in the learner's notebook (`check`) and in the grader's process. It reads canonical forms only,
never an object of the learner's.
"""

from dataclasses import dataclass

import numpy as np

from .canonical import array_of, canonical, shorten_form

_LONGEST_TEXT = 500  # a longer text is cut
_MOST_KEYS = 50  # of a dict, that are named
_LONGEST_INTEGER = 30  # digits; of a longer one the first digits are told
_GLANCE, _CONTEXT = 30, 20  # characters: how two longer texts are compared
# The kind of difference if two values have not the same parts.
_PARTS_DIFFER = {"tuple": "length", "list": "length", "dict": "keys", "message": "type"}
# Rounding errors, relative to the expected number: a sum computed in another order is not a mistake.
_ROUNDING = {"float16": 1e-2, "float32": 1e-5, "float64": 1e-9, "float": 1e-9}


@dataclass(frozen=True)
class Difference:
    kind: str  # "type", "shape", "dtype", "length", "keys" or "value"
    path: str  # inside the answer, "" for the answer itself: "[1]", "['edges']"
    message: str  # the difference as a sentence without its full stop


def compare(expected, actual, tolerance=0.0, path="", *, exact_type=True):
    """The first Difference between two forms that `canonical` wrote, or None.

    Numbers agree when |actual - expected| <= tolerance + rounding * |expected|; the rounding is 1e-9 for
    Python's floats and float64, 1e-5 for float32, 1e-2 for float16, and 0 for integers. NumPy's scalars count
    as Python's numbers, and an integer may stand for an expected float.

    If the type need not be exact, right values may also come as a float for an integer, in another number
    type of an array, as a list for a tuple, as a list (of lists or arrays) for an array, and the other way
    round, and as an array of one element for a number. True and False never stand for numbers: a mask selects
    pixels, and 0 and 1 do not. Whether numbers in float32 are right is decided with its rounding.

    The tolerance is absolute, in the unit of the answer; `path` is that of the two inside the whole answer.
    """
    if not exact_type:
        actual = as_type_of(expected, actual)
    kind, actual_kind = kind_of(expected), kind_of(actual)
    are_numbers = {kind, actual_kind} <= {"int", "float"} and (kind == "float" or not exact_type)
    if kind != actual_kind and not are_numbers:
        return _difference("type", path, expected, actual)
    if actual.get("too_large") or actual.get("opaque"):
        return Difference("type", path, f"got {describe(actual)}, which cannot be compared")
    if kind == "ndarray":
        return _compare_arrays(expected, actual, tolerance, path, exact_type)
    if kind in _PARTS_DIFFER:
        return _compare_parts(expected, actual, tolerance, path, exact_type)
    if kind == "bytes":
        same = _have_one_digest(expected, actual)
    elif kind in ("int", "float"):
        same = _close(expected, actual, tolerance)
    else:
        same = expected.get("value") == actual.get("value")
    if same:
        return None
    where = _first_difference(expected, actual) if kind == "str" else ""
    return _difference("value", path, expected, actual, where)


def _compare_parts(expected, actual, tolerance, path, exact_type):
    parts, actual_parts = dict(named_items(expected)), dict(named_items(actual))
    if parts.keys() != actual_parts.keys():
        return _difference(_PARTS_DIFFER[kind_of(expected)], path, expected, actual)
    pairs = ((part, actual_parts[name], tolerance, path + name) for name, part in parts.items())
    differences = (compare(*pair, exact_type=exact_type) for pair in pairs)
    return next((difference for difference in differences if difference), None)


def named_items(form):
    """The parts of a tuple, list, dict or message as (name, form): ("[0]", form); else []."""
    if form["type"] in ("tuple", "list"):
        return [(f"[{number}]", item) for number, item in enumerate(form.get("items", ()))]
    if form["type"] == "dict":
        return [(f"[{_key(key)}]", value) for key, value in form.get("items", ())]
    return [(f".{name}", value) for name, value in form.get("fields", {}).items()]


def _first_difference(expected, actual):
    """Where two long texts begin to differ; "" for short ones, which a reader compares at a glance."""
    texts = [form.get("value", "") for form in (expected, actual)]
    if min(map(len, texts)) < _GLANCE:
        return ""
    before, found, after = texts[1].partition(texts[0])
    if before and found:
        return f"; before the expected text stands {before!r}, and after it {after!r}"
    pairs = enumerate(zip(*texts, strict=False))
    start = next((place for place, (a, b) in pairs if a != b), min(map(len, texts)))
    before = "…" * (start > _CONTEXT) + texts[0][max(0, start - _CONTEXT) : start]
    tails = [repr(text[start : start + _CONTEXT]) if text[start:] else "the end" for text in texts]
    place = f"character {start + 1} on, after {before!r}" if start else "the first character on"
    return f"; they differ from {place}: expected {tails[0]}, got {tails[1]}"


def _difference(kind, path, expected, actual, where=""):
    return Difference(kind, path, f"expected {describe(expected)}, got {describe(actual)}{where}")


def describe(form):
    """A short description of a canonical form: `an array of shape (5, 5), uint8`, `the text 'rgb8'`."""
    kind = kind_of(form)
    if form.get("too_large"):
        return f"a very large {form['type']}"
    if kind == "ndarray":
        return f"an array of shape {tuple(form['shape'])}, {form['dtype']}"
    if kind in ("None", "bool"):
        return str(form.get("value"))
    if kind in ("tuple", "list"):
        return f"a {kind} of {len(form['items'])}"
    if kind == "dict":
        keys = ", ".join(_key(key) for key, _ in form["items"][:_MOST_KEYS])
        return f"a dict with the keys {keys[:_LONGEST_TEXT] or 'none'}"
    if kind == "bytes":
        return f"{form['length']} bytes"
    if kind == "str":
        text = form.get("value", "")
        return f"the text {text if len(text) <= _LONGEST_TEXT else text[: _LONGEST_TEXT - 1] + '…'!r}"
    if kind in ("int", "float"):
        return f"the {'integer' if kind == 'int' else 'float'} {_readable(form['value'])}"
    return f"an object of type {form['type']}"


def kind_of(form):
    """The kind of a form: its type; "int", "float" or "bool" for NumPy's scalars; "message"; "opaque"."""
    kind = form["type"]
    if "fields" in form:
        return "message"
    if form.get("opaque") and kind != "ndarray":
        return "opaque"
    if not kind.startswith("numpy."):
        return kind
    scalar = kind.removeprefix("numpy.")
    return "bool" if scalar.startswith("bool") else "float" if scalar.startswith("float") else "int"


def as_type_of(expected, actual):
    """The same values in the container of the expected form, if it can hold them; else the form as it is."""
    kind, actual_kind = kind_of(expected), kind_of(actual)
    if kind in ("tuple", "list") and actual_kind in ("tuple", "list"):
        return actual | {"type": kind}
    if kind == "ndarray" and actual_kind in ("tuple", "list"):
        return _array_form(actual, len(expected["shape"]))
    if actual_kind == "ndarray":
        return _numbers_form(expected, actual)
    return actual


def _array_form(form, depth):
    """A list of numbers, or of lists of numbers, as an array of `depth` axes; as it is if it is none."""
    try:
        array = np.array(_numbers(form))
    except (ValueError, OverflowError):  # rows of different lengths, or what is no number
        return form
    is_array = form.get("items") and array.ndim == depth and array.dtype.kind in "biuf"
    return canonical(array) if is_array else form


def _numbers(form):
    """The numbers of a list, whose items may be lists or arrays; ValueError if it holds anything else."""
    if form["type"] in ("tuple", "list") and "items" in form:
        return [_numbers(item) for item in form["items"]]
    number = array_of(form) if form["type"] == "ndarray" else form.get("value")
    if number is None or isinstance(number, str):
        raise ValueError(form["type"])
    # A list of float32 must not become an array of float64, which may round less.
    return np.float32(number) if form["type"] == "numpy.float32" else number


def _numbers_form(expected, actual):
    """An array of one element as a number, or an array as a list of numbers or pairs, if that is expected.

    Where two arrays are expected, one array of both stays what it is.
    """
    values, kind = array_of(actual), kind_of(expected)
    if values is None:
        return actual
    # As NumPy's scalars, and not as Python's numbers: float32 rounds more.
    if kind in ("int", "float", "bool") and values.size == 1:
        return canonical(values.flat[0])
    items = expected.get("items", ())
    if kind not in ("tuple", "list") or (kind == "tuple" and values.ndim and len(values) != len(items)):
        return actual
    are_pairs = all(item["type"] in ("tuple", "list") for item in items)
    if values.ndim == 1 or (are_pairs and values.ndim and len(values) == len(items)):
        return {"type": kind, "items": [canonical(part) for part in values]}
    return actual


def _key(form):
    if form["type"] == "tuple" and "items" in form:
        return f"({', '.join(map(_key, form['items']))})"
    return repr(form.get("value", form["type"]))


def _readable(value):
    if isinstance(value, int) and abs(value) >= 10**_LONGEST_INTEGER:
        return f"{str(value)[:12]}… of {len(str(abs(value)))} digits"
    return value if isinstance(value, str) else f"{value:.10g}" if isinstance(value, float) else str(value)


def as_float(value):
    """The value of an int or float form as a float, infinite if it is too large for one."""
    try:
        return float(value)  # "nan", "inf" and "-inf" too
    except OverflowError:  # an integer of more than 1024 bits
        return float("inf") if value > 0 else float("-inf")


def _close(expected, actual, tolerance):
    if kind_of(expected) == "int" and tolerance == 0:
        return expected["value"] == actual["value"]
    rounding = _rounding(*(form["type"].removeprefix("numpy.") for form in (expected, actual)))
    value, actual_value = (np.float64(as_float(form["value"])) for form in (expected, actual))
    return bool(_near(value, actual_value, tolerance, rounding))


def _near(expected, actual, tolerance, rounding):
    with np.errstate(invalid="ignore", over="ignore"):
        near = np.abs(actual - expected) <= tolerance + rounding * np.abs(expected)
    finite = np.isfinite(expected) & np.isfinite(actual)
    return np.where(finite, near, (expected == actual) | (np.isnan(expected) & np.isnan(actual)))


def _rounding(kind, actual_kind):
    """The relative rounding for an expected type of number; float32 instead of float64 rounds more."""
    rounding = _ROUNDING.get(kind, 0.0)
    return max(rounding, _ROUNDING["float32"]) if rounding and actual_kind == "float32" else rounding


def differing(expected, actual, tolerance=0.0):
    """Which elements of two arrays of one shape differ by more than the absolute tolerance; bools."""
    if expected.dtype.kind in "biu" and tolerance == 0:
        return expected != actual
    rounding = _rounding(expected.dtype.name, actual.dtype.name)
    return ~_near(expected.astype(np.float64), actual.astype(np.float64), tolerance, rounding)


def _compare_arrays(expected, actual, tolerance, path, exact_type):
    if expected["shape"] != actual["shape"]:
        shape, actual_shape = tuple(expected["shape"]), tuple(actual["shape"])
        return Difference("shape", path, f"expected shape {shape}, got an array of shape {actual_shape}")
    is_number = "bool" not in (expected["dtype"], actual["dtype"])
    if expected["dtype"] != actual["dtype"] and (exact_type or not is_number):
        message = f"expected {expected['dtype']}, got an array of {actual['dtype']}"
        return Difference("dtype", path, message)
    expected_values, actual_values = array_of(expected), array_of(actual)
    if expected_values is None or actual_values is None:
        with np.errstate(invalid="ignore"):  # a digest is of values in one dtype
            cast = actual_values.astype(expected["dtype"]) if actual_values is not None else None
        if cast is not None and (cast == actual_values).all():
            actual = canonical(cast)
        same = expected["dtype"] == actual["dtype"] and _have_one_digest(expected, actual)
        return None if same else Difference("value", path, "the values differ")
    wrong = differing(expected_values, actual_values, tolerance)
    if not wrong.any():
        return None
    index = tuple(int(i) for i in np.argwhere(wrong)[0])
    first, actual_first = (_readable(values[index].item()) for values in (expected_values, actual_values))
    message = f"{wrong.sum()} of {wrong.size} values differ; the first at {describe_index(index)}"
    return Difference("value", path, f"{message}: expected {first}, got {actual_first}")


def describe_index(index):
    """An array index as text: `row 3, col 7, channel 2`."""
    names = {0: (), 1: ("index",), 2: ("row", "col"), 3: ("row", "col", "channel")}.get(len(index))
    if names is None:
        return f"index {index}"
    return ", ".join(f"{name} {i}" for name, i in zip(names, index, strict=True)) or "its only value"


def _have_one_digest(*forms):
    """Whether two forms have the same values; those of a form without values are not known."""
    short = [shorten_form(form, 0) for form in forms]
    first, second = (form.get("digest", form.get("data")) for form in short)
    return first is not None and first == second
