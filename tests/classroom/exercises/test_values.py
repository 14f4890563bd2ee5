"""Values as tables and as lines of text."""

from types import SimpleNamespace

import numpy as np
import pytest
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.values import (
    answer_parts,
    describe_value,
    differing_elements,
    table_rows,
)


def names(expected, actual):
    return [name for name, _, _ in answer_parts(canonical(expected), actual and canonical(actual))]


def test_an_answer_with_other_items_is_one_part():
    pair = (np.zeros((2, 2)), np.ones((2, 2)))
    assert names(pair, pair) == ["[0]", "[1]"]
    assert names(pair, (pair[0],)) == [""]
    assert names(pair, None) == ["[0]", "[1]"]
    assert names((1, 2), (1, 2)) == [""]
    assert names({"gray": pair[0], 3: 4}, {"gray": pair[0], 3: 4}) == ["[3]", "['gray']"]
    assert names((*pair, *pair, *pair, 1), (*pair, *pair, *pair, 1)) == [""]


def test_values_within_the_tolerance_are_not_marked():
    expected, actual = canonical(np.array([1.0, 2.0])), canonical(np.array([1.05, 2.5]))
    assert differing_elements(expected, actual, 0.1).tolist() == [False, True]
    assert differing_elements(expected, canonical(np.array([1.0])), 0.1) is None
    assert differing_elements(expected, None, 0.1) is None


@pytest.mark.parametrize(
    ("value", "description"),
    [
        (np.uint8([[1, 2]]), "an array of shape (1, 2), uint8"),
        (np.zeros((20, 20)), "an array of shape (20, 20), float64, from 0 to 0"),
        (np.zeros((0, 3)), "an array of shape (0, 3), float64"),
        (b"", "no bytes"),
        (b"abc", "bytes([97, 98, 99])"),
        (bytes(1000), "1000 bytes (0, 0, 0, 0, 0, 0, 0, 0, …)"),
        ((1, "a", None, 2.5), "a tuple of 4: 1, 'a', None, 2.5"),
        ([np.float32([1, 2]), 3], "a list of 2: [1.0, 2.0], 3"),
        ([np.zeros(9)], "a list of 1: an array of shape (9,), float64, from 0 to 0"),
        ({"b": 1, "a": (2,)}, "a dict: 'a': a tuple of 1: 2, 'b': 1"),
        (3, "the integer 3"),
        (("x" * 100,), f"a tuple of 1: '{'x' * 58}…"),
        ([[[[[1]]]]], "a list of 1: a list of 1: a list of 1: a list of 1"),
        (
            SimpleNamespace(
                header=SimpleNamespace(stamp=SimpleNamespace(sec=5), frame_id="cam"), data=b"\x07"
            ),
            "an object with the fields header=(stamp=(sec=5), frame_id='cam'), data=bytes([7])",
        ),
    ],
)
def test_descriptions(value, description):
    assert describe_value(canonical(value)) == description


def message(**changed):
    fields = {"height": 2, "width": 1, "step": 2, "data": b"\x01\x02\x03\x04"}
    return canonical(SimpleNamespace(**(fields | changed)))


BYTES = ((("1", False), ("2", False)), (("3", False), ("4", False)))


def test_the_bytes_of_a_small_image_are_a_table_of_its_rows():
    assert table_rows(message()) == BYTES
    # With ROS installed, the data of a message is an array.
    assert table_rows(message(data=np.uint8([1, 2, 3, 4]))) == BYTES
    assert describe_value(message(data=np.uint8([1, 2, 3, 4]))) == (
        "an object with the fields height=2, width=1, step=2, data=bytes([1, 2, 3, 4]);"
        " data in rows of step bytes"
    )


@pytest.mark.parametrize(
    "changed",
    [
        {"step": 3},
        {"height": "2"},
        {"height": -2, "step": -2},
        {"height": 0, "data": b""},
        {"data": np.float64([1, 2, 3, 4])},
        {"height": 20, "step": 10, "data": bytes(200)},
    ],
)
def test_an_inconsistent_or_large_message_has_no_table(changed):
    assert table_rows(message(**changed)) == ()
    assert "rows of step bytes" not in describe_value(message(**changed))


def test_rows_mark_what_differs():
    colour = canonical(np.arange(6, dtype=np.uint8).reshape(1, 2, 3))
    wrong = np.zeros((1, 2, 3), bool)
    wrong[0, 1, 2] = True
    assert table_rows(colour, wrong) == ((("(0 1 2)", False), ("(3 4 5)", True)),)
    assert table_rows(canonical(np.float32([0.5, np.nan]))) == ((("0.5", False), ("nan", False)),)
    assert table_rows(canonical(np.zeros((13, 13)))) == table_rows(canonical(3)) == table_rows(None) == ()
