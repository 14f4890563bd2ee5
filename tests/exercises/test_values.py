"""What a reader sees of a value."""

from types import SimpleNamespace

import numpy as np
import pytest

from imgproc_course.exercises.canonical import canonical
from imgproc_course.exercises.values import in_words, parts_of, rows_of, wrong_of


def names(expected, actual):
    return [name for name, _, _ in parts_of(canonical(expected), actual and canonical(actual))]


def test_parts_of_an_answer_of_another_kind_are_the_whole():
    pair = (np.zeros((2, 2)), np.ones((2, 2)))
    assert names(pair, pair) == ["[0]", "[1]"]
    assert names(pair, (pair[0],)) == [""]
    assert names(pair, None) == ["[0]", "[1]"]
    assert names((1, 2), (1, 2)) == [""]
    assert names({"gray": pair[0], 3: 4}, {"gray": pair[0], 3: 4}) == ["[3]", "['gray']"]
    assert names((*pair, *pair, *pair, 1), (*pair, *pair, *pair, 1)) == [""]


def test_a_tolerance_marks_nothing_that_is_near_enough():
    expected, actual = canonical(np.array([1.0, 2.0])), canonical(np.array([1.05, 2.5]))
    assert wrong_of(expected, actual, 0.1).tolist() == [False, True]
    assert wrong_of(expected, canonical(np.array([1.0])), 0.1) is None
    assert wrong_of(expected, None, 0.1) is None


@pytest.mark.parametrize(
    ("value", "words"),
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
        (3, "the whole number 3"),
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
def test_words(value, words):
    assert in_words(canonical(value)) == words


def message(**changed):
    fields = {"height": 2, "width": 1, "step": 2, "data": b"\x01\x02\x03\x04"}
    return canonical(SimpleNamespace(**(fields | changed)))


BYTES = ((("1", False), ("2", False)), (("3", False), ("4", False)))


def test_a_small_pictures_bytes_are_a_table_of_its_rows():
    assert rows_of(message()) == BYTES
    # Where ROS is installed the data of a message are an array.
    assert rows_of(message(data=np.uint8([1, 2, 3, 4]))) == BYTES
    assert in_words(message(data=np.uint8([1, 2, 3, 4]))) == (
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
def test_what_is_no_small_picture_is_no_table(changed):
    assert rows_of(message(**changed)) == ()
    assert "rows of step bytes" not in in_words(message(**changed))


def test_rows_mark_what_differs():
    colour = canonical(np.arange(6, dtype=np.uint8).reshape(1, 2, 3))
    wrong = np.zeros((1, 2, 3), bool)
    wrong[0, 1, 2] = True
    assert rows_of(colour, wrong) == ((("(0 1 2)", False), ("(3 4 5)", True)),)
    assert rows_of(canonical(np.float32([0.5, np.nan]))) == ((("0.5", False), ("nan", False)),)
    assert rows_of(canonical(np.zeros((13, 13)))) == rows_of(canonical(3)) == rows_of(None) == ()
