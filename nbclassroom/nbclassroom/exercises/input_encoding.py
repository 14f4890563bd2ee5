"""Write arguments as JSON and read them back exactly: byte order, memory layout and order of keys survive.

There is no pickle, so reading cannot run anything. `canonical` forms are for answers and leave out what does
not count; a function under test must get exactly what the lesson would pass to it.
"""

import base64
import types
from collections.abc import Callable

import numpy as np

_PLAIN = (bool, int, float, str, type(None))
_KINDS = "biufc"


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
    if kind is np.ndarray and value.dtype.kind in _KINDS:
        order = "F" if value.flags.f_contiguous and not value.flags.c_contiguous else "C"
        data = base64.b64encode(value.tobytes(order)).decode("ascii")
        return {"array": data, "dtype": value.dtype.str, "shape": list(value.shape), "order": order}
    if issubclass(kind, np.generic) and value.dtype.kind in _KINDS:
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
    if isinstance(form, _PLAIN):
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
