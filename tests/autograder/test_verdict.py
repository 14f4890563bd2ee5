"""The one comparison: as tolerant as the master says, and safe from anything that a kernel sends."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from imgproc_course.autograder.answer_forms import is_form
from imgproc_course.autograder.verdict import CaseRun, verdict_on
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
# Forms that are nearly right: the keys and words that `compare` reads, with any values.
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


def payload_of(*values, refused=(), **more):
    calls = [{"value": canonical(value), "changed": [], "printed": ""} | more for value in values]
    return {"calls": calls, "refused": list(refused)}


def passes(payload, expected, tolerance):
    return verdict_on([payload], [canonical(expected)], tolerance).passed


@pytest.mark.parametrize(
    "value",
    [
        *(None, True, 3, 2**70, 0.5, float("nan"), "text", b"bytes", RIGHT, np.uint8(7), np.float32(1)),
        *(np.bool_(True), (1, "a"), [RIGHT, None], {"edges": RIGHT}, np.zeros((0, 3), ">f4"), object()),
        np.zeros(100_000),
    ],
    ids=lambda value: type(value).__name__,
)
def test_every_canonical_form_is_accepted(value):
    assert is_form(json.loads(json.dumps(canonical(value))))


def test_the_tolerance_is_the_limit():
    assert passes(payload_of(RIGHT + 0.09), RIGHT, 0.1)
    assert not passes(payload_of(RIGHT + 0.11), RIGHT, 0.1)
    assert not passes(payload_of(RIGHT + 1e-6), RIGHT, 0.0)


@pytest.mark.parametrize(
    "payload",
    [
        payload_of(RIGHT, RIGHT),
        payload_of(),
        payload_of(RIGHT, refused=["cv2"]),
        payload_of(RIGHT, changed=["pixels"]),
        payload_of(RIGHT.astype(np.float32)),
        payload_of(RIGHT.tolist()),
        {"calls": [{"timed_out": True}], "refused": []},
        {"calls": [{"error": "E", "message": "", "line": "", "changed": [], "printed": ""}], "refused": []},
        "passed",
        None,
    ],
)
def test_every_other_payload_fails(payload):
    assert not passes(payload, RIGHT, 0.5)


@given(st.one_of(JSON, NEARLY))
def test_no_other_json_passes_or_raises(payload):
    assert not passes(payload, RIGHT, 1e9)
    inner = {"calls": [{"value": payload, "changed": [], "printed": ""}], "refused": []}
    assert not passes(inner, RIGHT, 1e9)


@given(NEARLY)
def test_every_accepted_form_can_be_compared(form):
    payload = {"calls": [{"value": form, "changed": [], "printed": ""}], "refused": []}
    for value in (RIGHT, 1, 0.5, "a", (1, RIGHT), {"a": 1}, b"b", None):
        assert not passes(payload, value, 0.0) or compare(canonical(value), form) is None


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
def test_a_malformed_form_is_rejected(form):
    assert not is_form(form)


def test_a_verdict_names_the_first_call_that_failed():
    expected = [canonical(1), canonical(2), canonical(3)]
    verdict = verdict_on([payload_of(1, 5, 4)], expected, 0.0)
    assert (verdict.failed_call, verdict.difference.actual, verdict.passed) == (1, 5, False)
    assert [call.value["value"] for call in verdict.calls] == [1, 5, 4]
    assert verdict_on([payload_of(1, 2)], expected, 0.0).failed_call == 2
    assert verdict_on([payload_of(1, 2, 3, 4)], expected, 0.0).failed_call == 3


def test_exactly_one_answer_counts():
    payload = payload_of(1)
    assert verdict_on([payload], [canonical(1)], 0.0).passed
    assert verdict_on([payload, payload], [canonical(1)], 0.0).calls is None
    assert verdict_on([], [canonical(1)], 0.0).calls is None


def test_a_right_answer_of_a_cell_that_failed_does_not_pass():
    run = CaseRun(verdict=verdict_on([payload_of(1)], [canonical(1)], 0.0))
    assert run.passed
    run.check.error = ("ValueError", "")
    assert not run.passed
    run.check.error, run.check.ended = ("", ""), "time"
    assert not run.passed
