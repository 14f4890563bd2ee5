"""What `check` says of wrong types, shapes, dtypes and values."""

from types import SimpleNamespace

import numpy as np
import pytest
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.comparison import compare
from nbclassroom.exercises.diagnosis import diagnose

RNG = np.random.default_rng(7)
GRAY = RNG.integers(20, 200, (5, 6), dtype=np.uint8)
COLOUR = RNG.integers(20, 200, (4, 5, 3), dtype=np.uint8)
SIGNED = RNG.integers(-300, 300, (5, 6), dtype=np.int32)
WIDE = np.hstack([GRAY, GRAY])
MASK = RNG.random((5, 6)) > 0.5


def call_of(expected, actual, argument=GRAY, tolerance=0.0):
    forms = canonical(expected), canonical(actual)
    return SimpleNamespace(
        case=SimpleNamespace(tolerance=tolerance),
        arguments=(argument,),
        expected=SimpleNamespace(value=forms[0]),
        result=SimpleNamespace(value=forms[1], finished=True, printed=""),
        difference=compare(*forms, tolerance),
    )


def say(expected, actual, argument=GRAY, tolerance=0.0):
    call = call_of(expected, actual, argument, tolerance)
    return diagnose([call], call, ("image",))


def changed(array, where, value=7):
    array = array.copy()
    array[where] = value
    return array


TYPES = [
    (80, "80", "return it without quotes, not an f-string"),
    (80, (5, 16), "You return 2 values (a tuple), and the task asks for one number alone."),
    (80, GRAY, "You return an array, and the task asks for a number: is a sum, a mean or an index missing"),
    ("a", len, "You return a function itself, and the task asks for a text, such as its name."),
    ("a", {"b"}, "You return a set, and the task asks for a single text."),
    (GRAY, np.sum, "You return a function itself, and the task asks for an array."),
    (GRAY, range(3), "You return a value of type range, and the task asks for an array."),
    ("a", ["a", "b"], "You return 2 values (a list), and the task asks for a single text."),
    (GRAY, GRAY.tolist(), "A list is not an array. Make it one: np.array(..., dtype=np.uint8)."),
    (GRAY, 99, "You return one number, not an array. Which line makes one number of many?"),
    (GRAY, "gray", "You return a text, and the task asks for an array."),
    (
        GRAY,
        (3, GRAY),
        "You return 2 values (a tuple). The one at index 1 has the shape of the task: return it",
    ),
    (COLOUR, COLOUR.transpose(2, 0, 1), "the axes stand in another order: rows come first, channels last."),
    ((GRAY, MASK), GRAY, "You return one array, and the task asks for 2: return both, with a comma"),
    ((GRAY[0], 0.5), np.zeros(4), "You return one array, and the task asks for 2: return both, with a comma"),
    (
        (GRAY, GRAY),
        np.stack([GRAY, GRAY]),
        "You return one array, and the task asks for 2: return both, with a comma",
    ),
    ((GRAY, MASK), {"a": GRAY, "b": MASK}, "You return a dict, and the task asks for 2 values (a tuple)."),
    ([0, 3], [(0, 0), 3], "There you return 2 values (a tuple), and the task asks for one number alone."),
    ((GRAY, MASK), (GRAY, MASK, 3), "You return 3 values (a tuple), and the task asks for 2."),
]
DTYPES = [
    (
        SIGNED,
        SIGNED.astype(np.int64),
        "The values are right; only the dtype is not: you return int64. End with",
    ),
    ((SIGNED, SIGNED), (SIGNED.astype(int), SIGNED.astype(int)), "End with .astype(np.int32)."),
    ({"gray": GRAY}, {"gray": GRAY.astype(float)}, "you return float64. End with .astype(np.uint8)."),
    (MASK, np.where(MASK, 255, 0), "The task asks for bool, True and False, and you return numbers (int64)."),
    (np.where(MASK, np.uint8(255), np.uint8(0)), MASK, "write np.where(mask, 255, 0).astype(np.uint8)"),
    (GRAY, GRAY > 0, "you return True and False (bool). Keep the numbers themselves"),
    (GRAY / 7, (GRAY / 7).astype(np.uint8), "The fractions are lost: you return uint8"),
    (
        (GRAY.astype("i4"), SIGNED),
        (GRAY, SIGNED.astype(np.uint8)),
        "The values do not all fit into uint8, and were cut. Make the result int32.",
    ),
    (SIGNED, SIGNED.astype(np.uint8), "do not all fit into uint8, and were cut. Make the result int32."),
]
SHAPES = [
    (GRAY, GRAY.T, "Rows and columns are exchanged"),
    (
        GRAY,
        GRAY.T + 1,
        "Rows and columns are exchanged in the shape of your result: the number of rows comes",
    ),
    (COLOUR, COLOUR.reshape(4, 15), "The values are right and in the right order; only the shape is not"),
    (COLOUR[..., 0], COLOUR, "One axis is too many: did you make your result with the shape of a colour"),
    (COLOUR, COLOUR[..., 0], "The axis of the channels is missing: each pixel has 3 values."),
]
# What says nothing of the cause, beside the case's hint
SIZES = [
    (
        GRAY,
        GRAY[1:-1, 1:-1],
        "Your result has 2 rows too few and 2 columns too few: the border of the image is",
    ),
    (GRAY[:3], GRAY[:1, :4], "Your result has 2 rows too few and 2 columns too few."),
    (GRAY, np.pad(GRAY, ((0, 0), (0, 1))), "Your result has one column too many."),
    (GRAY[0], GRAY[0, :2], "Your result has 2 values, and the task asks for 6 here."),
]
VALUES = [
    (81, 80, "Your number is one too small, in every check."),
    (0.25, 25.0, "100 times the expected number (is it in percent?)"),
    (GRAY, GRAY * 0, "Every value of your result is 0: where do they become 0?"),
    (SIGNED, -SIGNED, "All signs are exchanged"),
    (SIGNED, SIGNED * np.int32([1, -1, 1, 1, 1, 1]), "Only signs are wrong"),
    (SIGNED, np.abs(SIGNED), "negative values must stay negative, without abs()"),
    ([1, 2, 3], [3, 2, 1], "Your result is the other way round"),
    ([(1, 2), (3, 3)], [(2, 1), (3, 3)], "In each part of this result, the first and the last value"),
    (MASK, ~MASK, "True and False are exchanged."),
    (GRAY[:5, :5], GRAY[:5, :5].T, "Rows and columns are exchanged"),
    (SIGNED, SIGNED[:, ::-1], "mirrored from left to right"),
    (SIGNED, SIGNED[::-1], "upside down"),
    (np.where(MASK, 255, 0), np.where(MASK, 1, 0), "Where 255 is expected, your result has 1. Everything"),
    ((MASK, ~MASK), (MASK, MASK), "All that you return is the same array: does it have two names?"),
    (COLOUR, COLOUR[..., ::-1], "the first and the last are exchanged"),
    (SIGNED, changed(SIGNED, 2, SIGNED[2] - 1), "Each wrong value is one too small: is it rounded down,"),
    ((2, -1.2), (2, 2 * np.pi - 1.2), "Your angle is a whole turn (2π) away: bring it into the range"),
    ((2, 0.5), (2, np.degrees(0.5)), "Your angle is in degrees, and the task asks for radians."),
    (90.0, np.pi / 2, "Your angle is in radians, and the task asks for degrees."),
    (GRAY / 7, GRAY / 21, "are the expected ones times one number."),
]
PLACES = [
    (GRAY, changed(changed(GRAY, 0), np.s_[:, 0]), "Only values in the first row and in the first column"),
    (WIDE, np.pad(WIDE[:-1], ((0, 1), (0, 0))), "Only values in the last row are wrong, and there your"),
    (GRAY, np.pad(GRAY[1:-1, 1:-1], 1), "and there your result is 0: is the border never computed?"),
]


@pytest.mark.parametrize(("expected", "actual", "text"), TYPES + DTYPES + SHAPES)
def test_a_wrong_form_is_named_without_a_hint_about_values(expected, actual, text):
    diagnosis = say(expected, actual)
    assert text in diagnosis.text and diagnosis.replaces_hint and not diagnosis.on_border


@pytest.mark.parametrize(("expected", "actual", "text"), SIZES)
def test_a_wrong_size_alone_says_no_cause_and_leaves_the_hint(expected, actual, text):
    diagnosis = say(expected, actual)
    assert diagnosis.text.startswith(text) and not diagnosis.replaces_hint


def test_rows_and_columns_are_exchanged_only_if_they_are_so_in_every_check():
    calls = [call_of(GRAY, np.zeros(GRAY.shape[::-1], np.uint8), GRAY)]
    assert "are exchanged in the shape" in diagnose(calls, calls[0], ("image",)).text
    calls.append(call_of(WIDE, WIDE[1:], WIDE))
    assert "exchanged" not in diagnose(calls, calls[0], ("image",)).text


def test_an_input_that_comes_back_unchanged_is_told():
    assert say(255 - GRAY, GRAY).text.startswith("Your result is image, unchanged")


def test_of_another_number_or_a_value_in_place_of_none_the_hint_tells_more():
    for diagnosis in (say(None, 0.0), say(80, 1.5)):
        assert diagnosis.text == "" and not diagnosis.replaces_hint


def test_a_none_that_was_printed_needs_no_hint():
    call = call_of(GRAY, None)
    assert not diagnose([call], call).replaces_hint
    call.result.printed = "3"
    assert diagnose([call], call).replaces_hint


def test_a_list_of_another_shape_has_advice_where_lists_are_free():
    call = call_of(GRAY, GRAY.tolist()[:-1])
    diagnosis = diagnose([call], call, ("image",), exact_type=False)
    assert diagnosis.text.startswith("Your result has one row too few.")
    call = call_of(GRAY[0], list(GRAY[0, :2]))
    text = diagnose([call], call, ("image",), exact_type=False).text
    assert text.startswith("Your result has 2 values, and the task asks for 6 here.")


def test_of_two_wrong_parts_the_shape_is_explained():
    call = call_of((GRAY, GRAY), ("gray", GRAY[1:-1, 1:-1]))
    assert diagnose([call], call).text == "Your result has 2 rows too few and 2 columns too few."


def test_of_a_wrong_dtype_beside_wrong_values_nothing_is_certain():
    call = call_of((MASK, MASK), (MASK.astype(np.uint8), ~MASK))
    diagnosis = diagnose([call], call, exact_type=False)
    assert diagnosis.text == "" and not diagnosis.replaces_hint  # so the case's hint is shown


@pytest.mark.parametrize(("expected", "actual", "text"), VALUES + PLACES)
def test_what_is_certain_about_values(expected, actual, text):
    diagnosis = say(expected, actual, argument=None)
    assert text in diagnosis.text
    assert diagnosis.on_border == any(text is place for *_, place in PLACES)


def test_a_wrong_dtype_with_wrong_values_is_not_called_right():
    assert say(SIGNED, SIGNED.astype(np.int64) * 3 + 1).text.startswith("Not only the dtype: 30 of 30 values")
    assert not say(SIGNED, SIGNED.astype(np.int64) * 3 + 1).replaces_hint


def test_the_first_row_of_a_colour_image_is_not_a_channel():
    diagnosis = say(COLOUR[..., 0], COLOUR[0], argument=COLOUR)
    assert "image[0] is the first row, and axis=0 goes along the rows" in diagnosis.text
    assert "image[..., 0], axis=-1" in diagnosis.text


def test_what_is_true_of_one_call_only_is_not_said():
    calls = [call_of(SIGNED, -SIGNED), call_of(SIGNED, SIGNED + 3)]
    assert diagnose(calls, calls[0], ("image",)).text == ""
    calls = [call_of(GRAY, np.pad(GRAY[1:-1, 1:-1], 1)), call_of(GRAY, GRAY + np.uint8(1))]
    assert not diagnose(calls, calls[0], ("image",)).on_border


def test_a_fixed_number_is_named():
    calls = [call_of(80, 921600), call_of(12, 921600)]
    assert diagnose(calls, calls[0]).text.startswith("Your function returns 921600 for every input")
    calls = [call_of(80, 921600), call_of(80, 921600)]
    assert diagnose(calls, calls[0]).text == ""
    calls = [call_of(80, 921600), call_of(12, 921600), call_of(7, None)]
    calls[-1].result.finished = False  # it raised
    assert diagnose(calls, calls[0]).text == ""


def test_a_shape_of_which_nothing_is_certain_leaves_the_hint_in():
    diagnosis = say(GRAY[:, 0] > 99, COLOUR[0] > 99)
    assert diagnosis.text == "" and not diagnosis.replaces_hint


def test_numpy_scalars_count_as_numbers():
    assert say(0.5, np.float64(50)).text.startswith("Your number is 100 times the expected number")


TOO_LARGE = [(3, 10**400), (0.5, -(10**400)), (3, 2**5000), ("abc", "a" * 20_000), ((1, 2), [1] * 30_000)]


@pytest.mark.parametrize(("expected", "actual"), TOO_LARGE, ids=range(len(TOO_LARGE)))
def test_of_a_value_that_is_too_large_nothing_is_said(expected, actual):
    calls = [call_of(expected, expected), call_of(expected, actual)]
    assert diagnose(calls, calls[1]).text == ""


def test_a_value_that_cannot_be_compared_is_not_called_fixed():
    calls = [call_of("a/b", {"a/b"}), call_of("c/d", {"a/b"})]
    assert diagnose(calls, calls[0]).text == "You return a set, and the task asks for a single text."


def test_axis_0_of_a_gray_image():
    diagnosis = say(GRAY.mean(axis=1), GRAY.mean(axis=0))
    assert diagnosis.text.endswith("axis=0 goes along the rows, and axis=1 along the columns.")
    assert "channels" not in diagnosis.text


def test_a_few_wrong_values_on_the_border_of_a_small_array_tell_nothing():
    small = np.arange(9).reshape(3, 3)
    assert say(small, changed(small, np.s_[0, 0], 50)).text == ""
    assert say(small, changed(small, ([0, 0, 2], [0, 2, 0]), 50)).text == ""
