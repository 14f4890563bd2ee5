"""What nbval compares with: tolerant where the master says so, and safe from whatever a kernel sends."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from imgproc_course.autograder.reference import Reference, is_form
from imgproc_course.exercises.canonical import canonical
from imgproc_course.exercises.comparison import compare

RIGHT = np.array([[1.0, 2.0], [3.0, 4.0]])
JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5)),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=10,
)
# Forms that are nearly right: the keys and words that `compare` looks at, with anything behind them.
KEYS = st.sampled_from(
    ["type", "value", "items", "fields", "shape", "dtype", "data", "digest", "length", "opaque"]
)
WORDS = st.sampled_from(
    [
        "ndarray",
        "tuple",
        "dict",
        "int",
        "float",
        "numpy.uint8",
        "bytes",
        "uint8",
        "object",
        "AAAA",
        "nan",
        "str",
    ]
)
NEARLY = st.recursive(
    st.one_of(WORDS, st.integers(-2, 2**70), st.floats(), st.booleans()),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(KEYS, inner, max_size=5)),
    max_leaves=12,
)


def shown(*values, refused=(), **more):
    calls = [{"value": canonical(value), "changed": [], "printed": ""} | more for value in values]
    return {"calls": calls, "refused": list(refused)}


@pytest.mark.parametrize(
    "value",
    [
        *(None, True, 3, 2**70, 0.5, float("nan"), "text", b"bytes", RIGHT, np.uint8(7), np.float32(1)),
        *(np.bool_(True), (1, "a"), [RIGHT, None], {"edges": RIGHT}, np.zeros((0, 3), ">f4"), object()),
        np.zeros(100_000),
    ],
    ids=lambda value: type(value).__name__,
)
def test_every_canonical_form_is_one(value):
    assert is_form(json.loads(json.dumps(canonical(value))))


def test_a_tolerance_is_kept_and_no_more():
    reference = Reference([canonical(RIGHT)], 0.1)
    assert (reference != shown(RIGHT + 0.09)) is False
    assert reference != shown(RIGHT + 0.11)
    assert Reference([canonical(RIGHT)], 0.0) != shown(RIGHT + 1e-6)


@pytest.mark.parametrize(
    "payload",
    [
        shown(RIGHT, RIGHT),
        shown(),
        shown(RIGHT, refused=["cv2"]),
        shown(RIGHT, changed=["pixels"]),
        shown(RIGHT.astype(np.float32)),
        shown(RIGHT.tolist()),
        {"calls": [{"timed_out": True}], "refused": []},
        {"calls": [{"error": "E", "message": "", "line": "", "changed": [], "printed": ""}], "refused": []},
        "passed",
        None,
    ],
)
def test_anything_else_differs(payload):
    assert Reference([canonical(RIGHT)], 0.5) != payload


@given(st.one_of(JSON, NEARLY))
def test_nothing_that_json_holds_passes_or_raises(payload):
    reference = Reference([canonical(RIGHT)], 1e9)
    assert reference != payload
    assert reference != {"calls": [{"value": payload, "changed": [], "printed": ""}], "refused": []}


@given(NEARLY)
def test_whatever_is_taken_for_a_form_can_be_compared(form):
    payload = {"calls": [{"value": form, "changed": [], "printed": ""}], "refused": []}
    for value in (RIGHT, 1, 0.5, "a", (1, RIGHT), {"a": 1}, b"b", None):
        differs = Reference([canonical(value)], 0.0) != payload
        assert differs is True or compare(canonical(value), form) is None


@pytest.mark.parametrize(
    "form",
    [
        {"type": "str", "value": "\ud800"},
        {"type": "\udfff", "opaque": True},
        {"type": "float", "value": float("nan")},
        {"type": "int", "value": True},
        {"type": "SimpleNamespace", "fields": {"\ud800": {"type": "None"}}},
        {"type": "ndarray", "dtype": "uint8", "shape": [True], "data": "AA=="},
        {"type": "ndarray", "dtype": "|u1", "shape": [1], "data": "AA=="},
        {"type": "bytes", "length": 2, "data": "AA=="},
        {"type": "numpy.object_", "value": 1},
        {"type": "dict", "items": [[{"type": "None"}]]},
    ],
)
def test_what_only_looks_like_a_form_is_none(form):
    assert not is_form(form)


def test_a_reference_says_nothing_of_itself():
    assert repr(Reference([canonical("secret")], 0)) == "<the expected answer>"
