"""The first difference of two canonical forms."""

from types import SimpleNamespace

import numpy as np
import pytest
from nbclassroom.exercises.canonical import canonical, shorten_form
from nbclassroom.exercises.comparison import compare, describe, describe_index


def difference(expected, actual, tolerance=0.0):
    return compare(canonical(expected), canonical(actual), tolerance)


@pytest.mark.parametrize(
    ("expected", "actual"),
    [
        (3, 3),
        (3, np.int64(3)),
        (3.0, 3),
        (0.3, 0.1 + 0.2),
        (float("nan"), np.float64("nan")),
        (float("inf"), float("inf")),
        (True, np.bool_(True)),
        ("bgr8", "bgr8"),
        ({"a": 1, "b": (2, 3)}, {"b": (2, 3), "a": 1}),
        (np.array([1.0, np.nan, np.inf]), np.array([1.0 + 1e-12, np.nan, np.inf])),
        (np.array([1], np.uint16), np.array([1], ">u2")),
        (np.float32([1 / 3]), np.float32([1 / 3 + 1e-7])),
    ],
)
def test_equal_answers_agree(expected, actual):
    assert difference(expected, actual) is None


@pytest.mark.parametrize(
    ("expected", "actual", "kind"),
    [
        (3, 4, "value"),
        (3, 3.0, "type"),
        (3, True, "type"),
        (1.0, 1.0 + 1e-6, "value"),
        (1.0, float("nan"), "value"),
        (float("inf"), float("-inf"), "value"),
        (None, 0, "type"),
        ((1, 2), [1, 2], "type"),
        ((1, 2), (1, 2, 3), "length"),
        ({"a": 1}, {"b": 1}, "keys"),
        (b"ab", b"ac", "value"),
        (np.zeros((2, 3)), np.zeros((3, 2)), "shape"),
        (np.zeros(2, np.uint8), np.zeros(2, np.int64), "dtype"),
        (np.zeros(()), 0.0, "type"),
        (44, np.array([44]), "type"),
        (np.array([np.inf]), np.array([-np.inf]), "value"),
        (np.array([2**63 + 1], np.uint64), np.array([2**63], np.uint64), "value"),
    ],
)
def test_different_answers_differ(expected, actual, kind):
    assert difference(expected, actual).kind == kind


def test_the_first_difference_is_named_with_its_place_and_numbers():
    expected = np.zeros((4, 5), np.uint8)
    actual = expected.copy()
    actual[1, 3], actual[2, 0] = 7, 9
    result = difference(expected, actual)
    assert result.message == "2 of 20 values differ; the first at row 1, col 3: expected 0, got 7"


def test_a_difference_inside_an_answer_has_its_path():
    result = difference({"edges": (1, [2, 3])}, {"edges": (1, [2, 4])})
    assert result.path == "['edges'][1][1]"
    assert result.message == "expected the integer 3, got the integer 4"


def test_the_tolerance_is_absolute_and_inclusive():
    assert difference(100, 102, tolerance=2) is None
    assert difference(100, 103, tolerance=2).kind == "value"
    expected, actual = np.full(3, 100, np.uint8), np.array([100, 102, 103], np.uint8)
    result = difference(expected, actual, tolerance=2)
    assert result.message.startswith("1 of 3 values differ; the first at index 2:")


def test_digests_are_compared_if_the_values_are_not_stored():
    values = np.arange(100_000, dtype=np.int32)
    expected, other = (shorten_form(canonical(one), 1_000) for one in (values, values + 1))
    assert compare(expected, expected) is None
    assert compare(expected, other).message == "the values differ"
    assert compare(expected, canonical(values)) is None
    halves, large = (canonical(one) for one in (values + 0.5, values.astype(np.int64) + 2**32))
    assert compare(expected, canonical(values.astype(float)), exact_type=False) is None
    assert all(compare(expected, one, exact_type=False) for one in (halves, large))
    unknown = {"type": "ndarray", "dtype": "int32", "shape": [100_000]}
    assert compare(expected, unknown).message == "the values differ"


def test_objects_without_a_value_are_never_equal():
    assert difference(object(), object()).kind == "type"


def test_descriptions():
    assert describe(canonical(np.zeros((5, 4), np.uint8))) == "an array of shape (5, 4), uint8"
    assert describe(canonical(3)) == "the integer 3"
    assert describe(canonical({"a": 1})) == "a dict with the keys 'a'"
    assert describe_index((3, 7, 2)) == "row 3, col 7, channel 2"


def test_long_texts_are_given_whole_with_their_first_difference():
    expected = (
        "/home/robot/ros2_ws/install/image_edge_detection/lib/image_edge_detection/image_edge_detection"
    )
    message = compare(canonical(expected), canonical(expected + ".py")).message
    assert f"expected the text {expected!r}, got the text {expected + '.py'!r}" in message
    assert message.endswith(
        "they differ from character 95 on, after '…image_edge_detection': expected the end, got '.py'"
    )
    message = compare(canonical(expected), canonical(f"'{expected}' ")).message
    assert message.endswith("""; before the expected text stands "'", and after it "' \"""")
    message = compare(canonical(expected), canonical(expected.replace("/lib", ""))).message
    assert "differ from character 50 on, after '…mage_edge_detection/': expected 'lib/" in message
    assert "character" not in compare(canonical("rgb8"), canonical("bgr8")).message


ARRAY = np.int32([[1, 2], [3, 4]])


@pytest.mark.parametrize(
    ("expected", "actual"),
    [
        (44, 44.0),
        (44, np.float32(44)),
        (44, np.array(44)),
        (44, np.array([44])),
        (44.5, np.array([[44.5]])),
        (0.1, np.float32([0.1])),
        (True, np.array([True])),
        ((1, 2), (np.array([1]), np.array([2.0]))),
        ([0.1, 0.2], np.float32([0.1, 0.2])),
        (np.array([0.1, 0.2]), [np.float32(0.1), np.float32(0.2)]),
        (np.array([[0.1, 0.2]]), [np.float32([0.1, 0.2])]),
        (ARRAY, ARRAY.view(np.matrix)),
        (44, np.array([[44]]).view(np.matrix)),
        ((ARRAY, ARRAY), [ARRAY.view(np.matrix), ARRAY]),
        (np.array([ARRAY, ARRAY]), [ARRAY.view(np.matrix), ARRAY]),
        (44.0, np.int64(44)),
        ((1, 2), [1, 2.0]),
        ([1, 2], np.array([1, 2])),
        ((ARRAY, 1), [ARRAY.astype(np.int64), 1]),
        (ARRAY, ARRAY.astype(np.float64)),
        (ARRAY, ARRAY.tolist()),
        (ARRAY, [(1, 2), (3, 4)]),
        (np.array([0.1, 0.2]), np.array([0.1, 0.2], np.float32)),
        ({"gray": ARRAY}, {"gray": ARRAY.tolist()}),
        (np.array([True, False]), [True, False]),
        (np.zeros((0, 2)), np.zeros((0, 2), np.uint8)),
        ([(1, 2), (3, 4)], ARRAY),
        ([], np.zeros((0, 2), int)),
        ([[(1, 2), (3, 4)]], ARRAY[np.newaxis]),
    ],
)
def test_a_right_value_in_another_type_passes_where_the_type_need_not_be_exact(expected, actual):
    forms = canonical(expected), canonical(actual)
    assert compare(*forms, exact_type=False) is None


@pytest.mark.parametrize(
    ("expected", "actual"),
    [
        (44, 44.5),
        (44, 44.000001),
        (44, "44"),
        (44, [44]),
        (44, np.array([45])),
        (44, np.array([44, 44])),
        (44, np.array([])),
        (44, np.array([True])),
        (True, np.array([1])),
        (ARRAY, (ARRAY + 1).view(np.matrix)),
        (ARRAY[0], ARRAY[0].view(np.matrix)),
        (ARRAY, ARRAY.astype(object).view(np.matrix)),
        (ARRAY > 2, ARRAY.view(np.matrix)),
        (1, True),
        (True, 1),
        (ARRAY > 2, (ARRAY > 2).astype(np.uint8)),
        (ARRAY, ARRAY > 2),
        (ARRAY, [[1, 2], [3]]),
        (ARRAY, [[1, 2], [3, "4"]]),
        (ARRAY, [[1, 2], [3, 5]]),
        (ARRAY, [1, 2, 3, 4]),
        (ARRAY, [[1, 2], [3, 10**400]]),
        (ARRAY, ARRAY.astype(np.float32) + np.float32(0.25)),
        (np.array([30.0]), np.array([30.01], np.float16)),
        ((1, 2), {1: 2}),
        ([(1, 2), (3, 5)], ARRAY),
        ([(1, 2)], ARRAY),
        ([1, 2], ARRAY),
        ((ARRAY, ARRAY + 1), np.stack([ARRAY, ARRAY + 1])),
        ({"gray": 1}, {"grey": 1}),
    ],
)
def test_another_value_fails_in_every_type(expected, actual):
    forms = canonical(expected), canonical(actual)
    assert compare(*forms, exact_type=False) is not None


ONE_OF_EACH_KIND = [
    *(None, True, 3, 2.5, float("nan"), "a", b"a", (1, 2), [1, 2], [(1, 2), (3, 4)], [], {1: 2, 3: 4}, {}),
    *(ARRAY, ARRAY[0], ARRAY > 2, np.array(3), np.array([3]), np.zeros((2, 0)), np.zeros((2, 2, 2))),
    *(np.float32(2.5), np.uint8(3), np.float16([1, 2]), ARRAY.astype(object), ARRAY.view(np.matrix)),
    *(SimpleNamespace(a=1, b=2), (ARRAY, ARRAY > 2), {"a": ARRAY, "b": 1}, object(), 10**4000, "x" * 20_000),
]


@pytest.mark.parametrize("expected", ONE_OF_EACH_KIND[:-2], ids=lambda value: type(value).__name__)
@pytest.mark.parametrize("exact_type", [True, False])
def test_any_answer_can_be_compared_with_any_expected_one(expected, exact_type):
    """An exception here would cost a learner points, by a fault of ours."""
    forms = [canonical(value) for value in ONE_OF_EACH_KIND]
    differences = [compare(canonical(expected), form, exact_type=exact_type) for form in forms]
    equal = [value for value, difference in zip(ONE_OF_EACH_KIND, differences, strict=True) if not difference]
    assert len(equal) <= 5 and all(difference is None or difference.message for difference in differences)
