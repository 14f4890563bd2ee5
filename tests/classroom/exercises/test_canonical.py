"""The canonical form: by value, lossless for small values, and safe from an object's own methods."""

import json
from array import array
from collections import Counter, OrderedDict, defaultdict
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest
from nbclassroom.exercises.canonical import array_of, canonical, shorten_form


@pytest.mark.parametrize(
    ("value", "form"),
    [
        (None, {"type": "None"}),
        (True, {"type": "bool", "value": True}),
        (-7, {"type": "int", "value": -7}),
        (0.1, {"type": "float", "value": 0.1}),
        (float("nan"), {"type": "float", "value": "nan"}),
        (float("-inf"), {"type": "float", "value": "-inf"}),
        ("ü", {"type": "str", "value": "ü"}),
        (np.uint8(200), {"type": "numpy.uint8", "value": 200}),
        (np.float64(0.5), {"type": "numpy.float64", "value": 0.5}),
        (np.bool_(True), {"type": "numpy.bool", "value": True}),
        (b"\x01", {"type": "bytes", "length": 1, "data": "AQ=="}),
        ((1, [2.0]), {"type": "tuple", "items": [{"type": "int", "value": 1}, {"type": "list", "items": [
            {"type": "float", "value": 2.0}]}]}),
    ],
)  # fmt: skip
def test_each_kind_of_value_has_its_form(value, form):
    assert canonical(value) == form
    assert json.loads(json.dumps(canonical(value), allow_nan=False)) == form


def test_the_order_of_a_dict_makes_no_difference():
    assert canonical({"b": 1, "a": 2}) == canonical({"a": 2, "b": 1})
    assert [key["value"] for key, _ in canonical({"b": 1, "a": 2})["items"]] == ["a", "b"]


@pytest.mark.parametrize("dtype", ["bool", "uint8", "int16", "uint64", "float16", "float32", "float64"])
def test_an_array_is_restored_whole(dtype):
    values = np.arange(12).reshape(3, 4).astype(dtype)
    back = array_of(canonical(values))
    assert back.dtype == values.dtype
    np.testing.assert_array_equal(back, values)
    back[0, 0] = 1  # writable, so that it can be drawn on


def test_layout_and_byte_order_make_no_difference():
    values = np.arange(12, dtype=np.uint16).reshape(3, 4)
    assert canonical(values.astype(">u2")) == canonical(values)
    assert canonical(np.asfortranarray(values)) == canonical(values)
    assert canonical(np.repeat(values, 2, axis=1)[:, ::2]) == canonical(values)


def test_zeros_and_nans_have_one_form():
    assert canonical(np.array([-0.0, np.nan])) == canonical(np.array([0.0, -np.nan]))
    assert canonical(-0.0) == canonical(0.0)
    assert str(canonical(-0.0)["value"]) == "0.0"


def test_a_large_array_is_given_by_its_digest():
    values = np.zeros(101, np.uint8)
    values[7] = 3
    form = shorten_form(canonical(values), 100)
    assert "data" not in form
    other = values.copy()
    other[8] = 1
    assert shorten_form(canonical(other), 100)["digest"] != form["digest"]
    assert "digest" not in shorten_form(canonical(values[2:]), 100)
    assert "data" in canonical(values)


class Liar:
    """Equals everything, and pretends to be an array."""

    def __eq__(self, other):
        return True

    __hash__ = None

    def __array__(self, dtype=None, copy=None):
        raise AssertionError("asked for an array")

    def __repr__(self):
        raise AssertionError("asked for its text")


class Named(type):
    """Makes classes that claim to be NumPy's."""

    __name__ = property(lambda cls: "ndarray")
    __module__ = property(lambda cls: "numpy")


def test_strange_objects_give_only_the_name_of_their_type():
    class Loud(np.ndarray):
        def __eq__(self, other):
            return True

        __hash__ = None

    class Number(int):
        pass

    assert canonical(Liar()) == {"type": f"{__name__}.Liar", "opaque": True}
    assert canonical(np.zeros(3).view(Loud))["opaque"]
    assert canonical(Number(3))["opaque"]
    assert canonical(np.ma.masked_array([1, 2], mask=[0, 1]))["opaque"]
    full_of_liars = np.empty(1, dtype=object)
    full_of_liars[0] = Liar()
    form = canonical(full_of_liars)
    assert form == {"type": "ndarray", "dtype": "object", "shape": [1], "opaque": True}


class Box(NamedTuple):
    left: int
    top: int

    def __iter__(self):
        raise AssertionError("asked for its items")


@pytest.mark.parametrize(
    ("value", "plain"),
    [
        (np.array(["KITCHEN", "BATH"])[0], "KITCHEN"),
        (bytearray(b"ab"), b"ab"),
        (Box(3, 4), (3, 4)),
        (OrderedDict(b=1, a=2), {"a": 2, "b": 1}),
        (defaultdict(list, {"a": [1]}), {"a": [1]}),
        (Counter("aab"), {"a": 2, "b": 1}),
    ],
)
def test_a_type_that_holds_the_same_values_has_the_form_of_the_plain_type(value, plain):
    assert canonical(value) == canonical(plain)
    assert canonical([value]) == canonical([plain])


def test_a_metaclass_cannot_choose_the_name():
    Odd = Named("Odd", (), {})
    assert (Odd.__module__, Odd.__name__) == ("numpy", "ndarray")
    assert canonical(Odd())["type"] == f"{__name__}.Odd"


def test_values_that_are_too_large_or_too_deep():
    loop, named = [], {}
    loop.append(loop)
    named["itself"] = named
    texts = [json.dumps(canonical(value)) for value in (loop, named)]
    assert [(text.count('"items"'), text.count("too_large")) for text in texts] == [(8, 1), (8, 1)]
    assert canonical([0] * 30_000) == {"type": "list", "too_large": True}
    assert canonical("a" * 20_000) == {"type": "str", "too_large": True}
    assert canonical(1 << 5_000) == {"type": "int", "too_large": True}
    assert canonical("\ud800")["value"] == "\\ud800"


def test_messages_of_rclpy_and_of_rosbags_have_the_same_fields():
    class Rclpy:
        _fields_and_field_types = {"height": "uint32", "data": "sequence<uint8>"}  # noqa: RUF012 - as rosidl writes it

        def __init__(self):
            self.height, self.data = 2, array("B", [1, 2])

    class Rosbags:
        __msgtype__ = "sensor_msgs/msg/Image"
        __dataclass_fields__ = {"height": None, "data": None, "__msgtype__": None}  # noqa: RUF012

        def __init__(self):
            self.height, self.data = 2, np.array([1, 2], np.uint8)

    assert canonical(Rclpy())["fields"] == canonical(Rosbags())["fields"]
    assert canonical(Rclpy())["fields"]["data"]["dtype"] == "uint8"
    assert canonical(SimpleNamespace(height=2))["fields"] == {"height": {"type": "int", "value": 2}}
