"""Values as JSON: the canonical form of an answer, by value, and the exact form of an argument.

Grading runs this module inside the learner's kernel, where neither the expected answers nor the masters
exist. It needs only NumPy, gives values and never a verdict, and does not trust an object's own `__eq__`,
`__array__` or `__repr__`.

Arguments are read back exactly: byte order, memory layout and order of keys survive, because a function under
test must get what the lesson would pass to it. There is no pickle, so reading cannot run anything.
"""

import array
import base64
import collections
import decimal
import enum
import fractions
import hashlib
import math
import types
from collections.abc import Callable

import numpy as np

_MOST_ITEMS = 20_000  # of all containers together
_MOST_DEPTH = 8
MOST_CHARACTERS = 10_000  # of a text
MOST_INT_BITS = 4_096
_MOST_NAME_CHARACTERS = 100

# Types whose forms have keys of their own, beside NumPy's scalars.
PLAIN_TYPES = ("None", "bool", "int", "float", "str", "bytes", "tuple", "list", "dict", "ndarray")
_MATRIX_TYPE = np.matrix

# Types that hold the same values as a plain one, and are given as that one.
_STAND_INS: dict[type, type] = {
    np.str_: str,
    np.bytes_: bytes,
    bytearray: bytes,
    collections.OrderedDict: dict,
    collections.defaultdict: dict,
    collections.Counter: dict,
}
_NUMBERS = (decimal.Decimal, fractions.Fraction, np.longdouble)
_EXACT_KINDS = "biufc"  # of NumPy's types, in arguments

# Read through `type` itself: a metaclass may redefine __qualname__ and __module__.
_QUALNAME = type.__dict__["__qualname__"]
_MODULE = type.__dict__["__module__"]


def canonical(value, most=None):
    """The canonical form of a value.

    Once its arrays and texts have more than `most` bytes together, further ones are given without values.
    Of long ones `shorten_form` makes digests.

    It is a dict that json.dumps takes, with "type" and, by type:
        bool, int, float, str, None      "value" (the floats that JSON lacks are "nan", "inf", "-inf")
        NumPy scalars                    "type" is "numpy.uint8" and so on, "value"
        tuple, list                      "items"
        dict                             "items": [[key, value], ...] sorted by key
        bytes                            "length" and "data" (base64) or "digest"
        ndarray                          "dtype", "shape", and "data" (base64, little-endian, C order) or
                                         "digest"
        ROS message, SimpleNamespace     "fields": {name: form}
        anything else, and subclasses    "opaque": True, and only the name of the type
    A named tuple is given as a tuple, NumPy's text and a StrEnum as a str, a Counter as a dict, a Decimal, a
    Fraction and a longdouble as a float, a matrix, and a masked array without a mask, as an array.
    A value that is too deep, too long or too large has "too_large": True.

    In this form NaN equals NaN and -0.0 equals 0.0; byte order and memory layout make no difference.
    """
    return _Writer(math.inf if most is None else most).write(value, 0)


def shorten_form(form, most):
    """A form in which SHA-256 digests replace the data of arrays and bytes, if these are more than `most`."""
    if isinstance(form, list):
        return [shorten_form(item, most) for item in form]
    if not isinstance(form, dict):
        return form
    if len(form.get("data", "")) > most * 4 // 3:
        digest = hashlib.sha256(base64.b64decode(form["data"])).hexdigest()
        return {name: value for name, value in form.items() if name != "data"} | {"digest": digest}
    return {name: shorten_form(value, most) for name, value in form.items()}


def type_name(value):
    """`module.name` of the value's type, only `name` for built-ins; runs no code of the value."""
    kind = type(value)
    name = _QUALNAME.__get__(kind)[:_MOST_NAME_CHARACTERS]
    module = _MODULE.__get__(kind)
    if not isinstance(module, str) or module in ("builtins", "__main__"):
        return name
    return f"{module[:_MOST_NAME_CHARACTERS]}.{name}"


class _Writer:
    def __init__(self, bytes_left):
        self._bytes_left, self._items_left = bytes_left, _MOST_ITEMS

    def write(self, value, depth):
        value = _plain(value)
        kind = type(value)
        if value is None:
            return {"type": "None"}
        if kind is int and value.bit_length() > MOST_INT_BITS:
            return _too_large("int")
        if kind in (bool, int, float):
            return {"type": kind.__name__, "value": _number(value)}
        if kind is str:
            return self._text(value)
        if kind is bytes:
            return {"type": "bytes", "length": len(value), **self._data(value)}
        if kind is np.ndarray:
            return self._array(value)
        if kind in SCALARS:
            return {"type": f"numpy.{kind.__name__}", "value": _number(value.item())}
        if kind in (tuple, list, dict):
            return self._container(value, depth)
        names = tuple(value.__dict__) if kind is types.SimpleNamespace else _message_fields(kind)
        name = type_name(value)
        form = {"type": f"__main__.{name}" if name in PLAIN_TYPES else name}  # a class of that name
        if names and depth < _MOST_DEPTH:
            return form | {"fields": {name: self._field(value, name, depth) for name in names}}
        return form | {"opaque": True}

    def _text(self, value):
        self._bytes_left -= len(value)
        if len(value) > MOST_CHARACTERS or self._bytes_left < 0:
            return _too_large("str")
        return {"type": "str", "value": value.encode("utf-8", "backslashreplace").decode("utf-8")}

    def _container(self, value, depth):
        kind = type(value).__name__
        self._items_left -= len(value)
        if depth >= _MOST_DEPTH or self._items_left < 0:
            return _too_large(kind)
        if kind == "dict":
            pairs = [[self.write(k, depth + 1), self.write(v, depth + 1)] for k, v in value.items()]
            return {"type": "dict", "items": sorted(pairs, key=lambda pair: repr(pair[0]))}
        return {"type": kind, "items": [self.write(item, depth + 1) for item in value]}

    def _array(self, value):
        if value.dtype == np.longdouble:
            value = value.astype(np.float64)
        form = {"type": "ndarray", "dtype": value.dtype.name, "shape": list(value.shape)}
        if value.dtype.kind not in "biuf" or value.dtype.itemsize > 8:
            return form | {"opaque": True}
        if value.nbytes > self._bytes_left:
            return form
        plain = np.ascontiguousarray(value).astype(value.dtype.newbyteorder("<"), copy=False)
        if plain.dtype.kind == "f":
            plain = plain + plain.dtype.type(0)  # -0.0 becomes 0.0
            plain[np.isnan(plain)] = np.nan
        return form | self._data(plain.tobytes())

    def _data(self, raw):
        self._bytes_left -= len(raw)
        if self._bytes_left < 0:
            return {}
        return {"data": base64.b64encode(raw).decode("ascii")}

    def _field(self, message, name, depth):
        value = getattr(message, name)
        # rclpy stores a sequence of numbers as array.array, rosbags as ndarray: in this form they are equal.
        return self.write(np.array(value) if type(value) is array.array else value, depth + 1)


SCALARS: frozenset[type[np.generic]] = frozenset(
    {np.bool_, np.float16, np.float32, np.float64, *(np.dtype(code).type for code in "bBhHiIlLqQ")}
)


def _message_fields(kind):
    """Field names of a ROS message class of rclpy or rosbags; () for any other class."""
    if isinstance(kind.__dict__.get("_fields_and_field_types"), dict):
        return tuple(kind.__dict__["_fields_and_field_types"])
    if isinstance(kind.__dict__.get("__msgtype__"), str):
        return tuple(name for name in kind.__dict__.get("__dataclass_fields__", ()) if name != "__msgtype__")
    return ()


def _number(value):
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return "nan" if value != value else "inf" if value > 0 else "-inf"
    return value + 0.0 if isinstance(value, float) else value


def _plain(value):
    """A value in the plain type that holds the same, if there is one; any other value as it is."""
    kind = type(value)
    if kind in _STAND_INS:
        return _STAND_INS[kind](value)
    if issubclass(kind, tuple) and "_fields" in kind.__dict__:
        return tuple(tuple.__iter__(value))  # the class is a learner's, and so may be its __iter__
    if kind in _NUMBERS:
        try:
            return float(value)
        except (ValueError, OverflowError):  # a signalling nan of Decimal, a great Fraction
            return math.nan
    if kind is _MATRIX_TYPE or (kind is np.ma.MaskedArray and not np.ma.is_masked(value)):
        return np.ndarray.view(value, np.ndarray)
    if issubclass(kind, (enum.StrEnum, enum.IntEnum)):  # by the methods of str and int, not a learner's
        return str.__str__(value) if issubclass(kind, str) else int.__int__(value)
    return value


def _too_large(kind):
    return {"type": kind, "too_large": True}


def array_of(form: dict | None) -> np.ndarray | None:
    """The array of a form, writable; None if the form holds no data (too large, or not an array)."""
    if form is None or form["type"] != "ndarray" or "data" not in form:
        return None
    raw = base64.b64decode(form["data"])
    stored = np.dtype(form["dtype"]).newbyteorder("<")
    return np.frombuffer(raw, stored).reshape(form["shape"]).astype(np.dtype(form["dtype"]))


def encode(value):
    """None, numbers, text, bytes, arrays, and containers of these, as JSON; TypeError names another type."""
    kind = type(value)
    if kind in (bool, str, type(None)):
        return value
    if kind is int:
        return {"int": str(value)} if abs(value) >= 2**53 else value
    if kind is float:
        return {"float": value.hex()}
    if kind is bytes:
        return {"bytes": base64.b64encode(value).decode("ascii")}
    if kind is np.ndarray and value.dtype.kind in _EXACT_KINDS:
        order = "F" if value.flags.f_contiguous and not value.flags.c_contiguous else "C"
        data = base64.b64encode(value.tobytes(order)).decode("ascii")
        return {"array": data, "dtype": value.dtype.str, "shape": list(value.shape), "order": order}
    if issubclass(kind, np.generic) and value.dtype.kind in _EXACT_KINDS:
        return {"scalar": base64.b64encode(value.tobytes()).decode("ascii"), "dtype": value.dtype.str}
    if kind in (tuple, list):
        return {kind.__name__: [encode(item) for item in value]}
    if kind is dict:
        return {"dict": [[encode(key), encode(item)] for key, item in value.items()]}
    if kind is types.SimpleNamespace:
        return {"namespace": [[name, encode(item)] for name, item in vars(value).items()]}
    raise TypeError(
        f"a value of type {kind.__module__}.{kind.__qualname__} cannot be sent to a kernel as data; use"
        " numbers, text, bytes, arrays of numbers, tuple, list, dict or types.SimpleNamespace"
    )


def decode(form):
    """The value that `encode` wrote; arrays are writable and own their data."""
    if not isinstance(form, dict):
        return form
    if "array" in form:
        values = np.frombuffer(base64.b64decode(form["array"]), np.dtype(form["dtype"]))
        return values.reshape(form["shape"], order=form["order"]).copy(order="K")
    if "scalar" in form:
        return np.frombuffer(base64.b64decode(form["scalar"]), np.dtype(form["dtype"]))[0]
    ((kind, content),) = form.items()
    return _READERS[kind](content)


_READERS: dict[str, Callable] = {
    "int": int,
    "float": float.fromhex,
    "bytes": base64.b64decode,
    "tuple": lambda items: tuple(map(decode, items)),
    "list": lambda items: list(map(decode, items)),
    "dict": lambda pairs: {decode(key): decode(item) for key, item in pairs},
    "namespace": lambda pairs: types.SimpleNamespace(**{name: decode(item) for name, item in pairs}),
}
