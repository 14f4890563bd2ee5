"""The one comparison: as tolerant as the master says, and safe from anything that a kernel sends."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from nbclassroom.autograder.shown_answer import PageHtml
from nbclassroom.autograder.verdict import CaseRun, read_call, read_form, verdict_on
from nbclassroom.exercises.answer_images import answer_images
from nbclassroom.exercises.canonical import PLAIN_TYPES, canonical
from nbclassroom.exercises.comparison import compare
from nbclassroom.exercises.lesson import Case, Exercise, ExpectedCall
from nbclassroom.exercises.running import CallResult, Verdict
from nbclassroom.exercises.values import answer_parts, describe_value, differing_elements, table_rows

RIGHT = np.array([[1.0, 2.0], [3.0, 4.0]])
JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5)),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=10,
)
# Forms that are nearly right: the keys and words that `compare` reads, with any values.
KEYS = "type value items fields shape dtype data digest length opaque array"
WORDS = "ndarray numpy.matrix tuple dict int float numpy.uint8 bytes uint8 object AAAA nan str"
NEARLY = st.recursive(
    st.one_of(st.sampled_from(WORDS.split()), st.integers(-2, 2**70), st.floats(), st.booleans()),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.sampled_from(KEYS.split()), inner, max_size=5)
    ),
    max_leaves=12,
)


def payload_of(*values, **more):
    calls = [{"value": canonical(value), "changed": [], "printed": ""} | more for value in values]
    return {"calls": calls}


def passes(payload, expected, tolerance):
    return verdict_of([payload], [expected], tolerance).passed


def verdict_of(payloads, expected, tolerance=0.0):
    calls = tuple(ExpectedCall((), CallResult(canonical(value))) for value in expected)
    case = Case("one", "", 1, "", tolerance, calls=calls)
    return verdict_on(Exercise(id="one", exact_type=True), case, payloads)


@pytest.mark.parametrize(
    "value",
    [
        *(None, True, 3, 2**70, 0.5, float("nan"), "text", b"bytes", RIGHT, np.uint8(7), np.float32(1)),
        *(np.bool_(True), (1, "a"), [RIGHT, None], {"edges": RIGHT}, np.zeros((0, 3), ">f4"), object()),
        *(np.zeros(100_000), RIGHT.view(np.matrix), [RIGHT.astype(object).view(np.matrix)]),
    ],
    ids=lambda value: type(value).__name__,
)
def test_every_canonical_form_is_accepted(value):
    form = canonical(value)
    assert read_form(json.loads(json.dumps(form))) == form


def test_the_tolerance_is_the_limit():
    assert passes(payload_of(RIGHT + 0.09), RIGHT, 0.1)
    assert not passes(payload_of(RIGHT + 0.11), RIGHT, 0.1)
    assert not passes(payload_of(RIGHT + 1e-6), RIGHT, 0.0)


@pytest.mark.parametrize(
    "payload",
    [
        payload_of(RIGHT, RIGHT),
        payload_of(),
        payload_of(RIGHT, changed=["pixels"]),
        payload_of(RIGHT.astype(np.float32)),
        payload_of(RIGHT.tolist()),
        {"calls": [{"timed_out": True}]},
        {"calls": [{"error": "E", "message": "", "line": "", "changed": [], "printed": ""}]},
        "passed",
        None,
    ],
)
def test_every_other_payload_fails(payload):
    assert not passes(payload, RIGHT, 0.5)


@given(st.one_of(JSON, NEARLY))
def test_no_other_json_passes_or_raises(payload):
    assert not passes(payload, RIGHT, 1e9)
    inner = {"calls": [{"value": payload, "changed": [], "printed": ""}]}
    assert not passes(inner, RIGHT, 1e9)


@given(NEARLY)
def test_every_accepted_form_can_be_compared_and_shown(data):
    form = read_form(data)
    for value in (RIGHT, 1, 0.5, "a", (1, RIGHT), {"a": 1}, b"b", None):
        if form is not None:
            show(canonical(value), form)


def nested(depth):
    return {"type": "list", "items": [nested(depth - 1)] if depth else []}


DATA = {"type": "bytes", "length": 1, "data": "AA=="}
FORGED = {  # {name: (what a kernel sends, the keys that stay)}
    "an object": (
        {"type": "types.SimpleNamespace", "opaque": True, "fields": {"data": 7}, "items": 5, "shape": "x"},
        ["type", "opaque"],
    ),
    "a long text": ({"type": "str", "too_large": True, "value": 3, "items": [1]}, ["type", "too_large"]),
    "an array of objects": (
        {"type": "ndarray", "opaque": True, "dtype": "uint8", "shape": [3, 4], "data": 5, "fields": 6},
        ["type", "dtype", "shape", "opaque"],
    ),
    "a large array": (
        {"type": "ndarray", "dtype": "uint8", "shape": [2, 2], "digest": "0" * 64, "summary": "x"},
        ["type", "dtype", "shape", "digest"],
    ),
    "a message without a size": (
        {"type": "image", "fields": {"data": {"type": "image", "fields": {"data": DATA}}, "height": DATA}},
        ["type", "fields"],
    ),
    "keys that are lists": (
        {"type": "dict", "items": [[{"type": "list", "items": []}, DATA]] * 2},
        ["type", "items"],
    ),
    "a great number": ({"type": "float", "value": 10**308, "items": []}, ["type", "value"]),
    "a list in a list": (nested(9), ["type", "items"]),
}


def show(expected, actual):
    """What a page and `check` do with two values."""
    difference = compare(expected, actual)
    for name, part, actual_part in answer_parts(expected, actual):
        wrong = differing_elements(part, actual_part, 0.0)
        if actual_part is not None:
            PageHtml().text(describe_value(actual_part))
            table_rows(actual_part, wrong)
        answer_images(expected, name, part, actual_part, wrong)
    return difference


@pytest.mark.parametrize("name", FORGED)
def test_a_forged_form_is_made_anew_of_the_keys_of_its_type_and_can_be_shown(name):
    data, keys = FORGED[name]
    form = read_form(json.loads(json.dumps(data)))
    assert list(form) == keys
    assert read_form(form) == form
    for value in (RIGHT, np.zeros((20, 20)), 1, 0.5, "a", (1, RIGHT), {(1, 2): RIGHT}, b"b", None):
        assert show(canonical(value), form) is not None


@pytest.mark.parametrize("name", PLAIN_TYPES)
def test_a_class_with_the_name_of_a_plain_type_is_described(name):
    value = type(name, (), {"__module__": "__main__"})()
    form = read_form(canonical(value))
    assert (
        show(canonical(1), form).message == f"expected the integer 1, got an object of type __main__.{name}"
    )


def test_scalars_without_a_form_of_their_own_are_described():
    difference = show(canonical(0.5), read_form(canonical(np.complex64(1))))
    assert difference.message == "expected the float 0.5, got an object of type numpy.complex64"


def test_keys_of_a_dict_that_are_tuples_are_compared():
    assert compare(canonical({(1, 2): 5}), canonical({(1, 2): 5})) is None
    difference = compare(canonical({(1, 2): 5}), canonical({(3, 4): 5}))
    assert difference.message == "expected a dict with the keys (1, 2), got a dict with the keys (3, 4)"


def test_what_a_call_says_is_bounded():
    texts = {"error": "E" * 9_000, "message": "m" * 9_000_000, "line": "l" * 9_000, "printed": "p" * 9_000}
    call = read_call(texts | {"changed": ["n" * 9_000] * 90})
    lengths = [len(text) for text in (call.error, call.message, call.line, call.printed, *call.changed)]
    assert lengths == [2_000, 2_000, 2_000, 2_000, *[300] * 20]


@pytest.mark.parametrize(
    "form",
    [
        {"type": "str", "value": "\ud800"},
        {"type": "float", "value": float("nan")},
        {"type": "int", "value": True},
        {"type": "SimpleNamespace", "fields": {"\ud800": {"type": "None"}}},
        {"type": "ndarray", "dtype": "uint8", "shape": [True], "data": "AA=="},
        {"type": "bytes", "length": 2, "data": "AA=="},
        {"type": "numpy.object_", "value": 1},
        {"type": "dict", "items": [[{"type": "None"}]]},
        # Opaque or too large, with the type of a form that a reader would open.
        {"type": "list", "opaque": True},
        {"type": "ndarray", "opaque": True},
        {"type": "ndarray", "too_large": True},
        # Shapes and dtypes that NumPy refuses.
        {"type": "ndarray", "dtype": "uint8", "shape": [2**39, 2**39, 0], "data": ""},
        {"type": "ndarray", "dtype": "float64", "shape": [2**39, 2**39], "digest": "0" * 64},
        {"type": "ndarray", "dtype": "uint8", "shape": [1] * 65, "data": "AA=="},
        {"type": "ndarray", "dtype": "x" * 301, "shape": [0], "opaque": True},
        # Numbers outside their type.
        {"type": "numpy.uint8", "value": 256},
        {"type": "int", "value": 2**4096},
        {"type": "float", "value": 2**1024 - 1},
        {"type": "str", "value": "a" * 60_001},
        # Too many parts, and too deep.
        {"type": "tuple", "items": [{"type": "None"}] * 50_000},
        nested(11),
    ],
    ids=lambda form: repr(form)[:60],
)
def test_a_malformed_form_is_rejected(form):
    assert read_form(form) is None


def test_a_verdict_names_the_first_call_that_failed():
    verdict = verdict_of([payload_of(1, 5, 4)], [1, 2, 3])
    assert (verdict.result.value["value"], verdict.passed) == (5, False)
    assert [call.result.value["value"] for call in verdict.calls] == [1, 5, 4]
    for others in (payload_of(1, 2), payload_of(1, 2, 3, 4)):
        assert "other calls" in verdict_of([others], [1, 2, 3]).forged


def test_nbval_finds_equal_to_what_is_stored_what_is_within_the_tolerance():
    near, far = (CaseRun(verdict=verdict_of([payload_of(shown)], [2.0], 0.1)) for shown in (2.05, 2.2))
    assert payload_of(2.0) == near != "passed"
    assert far != payload_of(2.0) != CaseRun()
    assert near != payload_of(2.05)


def test_exactly_one_answer_counts():
    payload = payload_of(1)
    assert verdict_of([payload], [1]).passed
    assert verdict_of([payload, payload], [1]) == verdict_of([], [1]) == Verdict()
    assert Verdict().forged


def test_a_right_answer_of_a_cell_that_failed_does_not_pass():
    run = CaseRun(verdict=verdict_of([payload_of(1)], [1]))
    assert run.passed
    run.check.error = ("ValueError", "")
    assert not run.passed
    run.check.error, run.check.ended = ("", ""), "time"
    assert not run.passed
