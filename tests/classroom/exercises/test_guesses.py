"""A guess beside the result: lenient in what a learner types, and it never raises."""

import numpy as np
import pytest
from nbclassroom.exercises.guesses import read_bare_guess

from imgproc_course.exercises import compare_guess


@pytest.mark.parametrize("guess", [None, "", "  ", "?", ..., "...", (), (None, None)])
def test_without_a_guess_it_shows_the_result(guess):
    assert repr(compare_guess(guess, 36, "%")) == "No guess yet. The result is 36 %."


@pytest.mark.parametrize(
    ("guess", "value", "text"),
    [
        (36, np.int64(36), "Your guess: 36. The result: 36. Right!"),
        (36.0, 36, "Your guess: 36. The result: 36. Right!"),
        (33, 36, "Your guess: 33. The result: 36. Close."),
        (32, 36, "Your guess: 32. The result: 36."),
        (0.1, 0, "Your guess: 0.1. The result: 0."),
        (np.float32(0.5), 0.5, "Your guess: 0.5. The result: 0.5. Right!"),
        ("about 36 %", 36, "Your guess: 36. The result: 36. Right!"),
        ("30 or 40", 36, "Your guess: 30 or 40. The result: 36."),
        ("36 %", 0.36, "Your guess: 0.36. The result: 0.36. Right!"),
        ("0,36", 0.36, "Your guess: 0.36. The result: 0.36. Right!"),
        ("921,600", 921_600, "Your guess: 921600. The result: 921600. Right!"),
        ((2, 764, 800), 2_764_800, "Your guess: 2764800. The result: 2764800. Right!"),  # 2,764,800
        ((2, 3), 36, "Your guess: (2, 3). The result: 36."),
        ("−3", -3, "Your guess: -3. The result: -3. Right!"),
        ((720, 1280), (720, 1280), "Your guess: (720, 1280). The result: (720, 1280). Right!"),
        ([720, 1280], np.array([720, 1280]), "Your guess: (720, 1280). The result: (720, 1280). Right!"),
        ("720 x 1280", (720, 1280), "Your guess: (720, 1280). The result: (720, 1280). Right!"),
        ((1280, 720), (720, 1280), "Your guess: (1280, 720). The result: (720, 1280)."),
        ("Left.", "left", "Your guess: Left. The result: left. Right!"),
        ("right", "left", "Your guess: right. The result: left."),
        ("YES", np.True_, "Your guess: yes. The result: yes. Right!"),
        (False, True, "Your guess: no. The result: yes."),
    ],
)
def test_a_guess_is_read_as_a_learner_means_it(guess, value, text):
    assert repr(compare_guess(guess, value)) == text


def test_a_number_carries_its_unit():
    assert repr(compare_guess("36 %", 36, "%")) == "Your guess: 36 %. The result: 36 %. Right!"
    assert repr(compare_guess(9, 8.6, "gray levels")) == (
        "Your guess: 9 gray levels. The result: 8.6 gray levels. Close."
    )


class Hostile:
    """An object that raises whatever is done with it."""

    def _raise(self, *_):
        raise KeyError("hostile")

    __class__ = property(_raise)
    __eq__ = __hash__ = __repr__ = __len__ = __bool__ = _raise


ENDLESS = [1]
ENDLESS.append(ENDLESS)


OTHER_OBJECTS = {
    "a function": print,
    "an object that raises": Hostile(),
    "a list that holds itself": ENDLESS,
    "a dict": {1: 2},
    "a long list": [1] * 1000,
    "a long array": np.zeros(1000),
    "a table": np.zeros((2, 2)),
    "a complex number": 3 + 2j,
    "a number of 5000 digits": 10**5000,
}


@pytest.mark.parametrize("name", OTHER_OBJECTS)
def test_an_object_that_is_no_guess_does_not_raise(name):
    assert repr(compare_guess(OTHER_OBJECTS[name], 3)) == (
        'A guess is a number, a text in quotes, such as "yes", or a tuple, such as (2, 3). The result: 3.'
    )


@pytest.mark.parametrize("guess", [10**400, float("inf"), float("nan"), 1e308, "x" * 1000])
def test_a_guess_beyond_all_numbers_is_shown_short(guess):
    text = repr(compare_guess(guess, 3.5))
    assert text.startswith("Your guess: ") and text.endswith("The result: 3.5.") and len(text) < 110


def test_html_is_escaped():
    html = compare_guess("<b>", "left")._repr_html_()
    assert html == "<div>Your guess: <b>&lt;b&gt;</b>. The result: <b>left</b>.</div>"


@pytest.mark.parametrize(
    ("typed", "guess"),
    [
        ("yes", "yes"),
        ("36 %", "36 %"),
        ("720 x 1280", "720 x 1280"),
        ("(720, x)", "(720, x)"),
        ("“left”", "left"),
        ("'left\"", "left"),
        ("yes?", "yes?"),
    ],
)
def test_a_guess_that_is_no_python_becomes_a_text_and_a_sentence_says_how_to_write_it(typed, guess, capsys):
    namespace = {}
    lines = read_bare_guess([f"guess_share = {typed}  # your guess: how many?\n"], {"frame"})
    exec("".join(lines), namespace)
    assert namespace["guess_share"] == guess
    assert capsys.readouterr().out == (
        "Your guess is taken as a text. Write a number alone, such as 36, and a text in quotes:"
        f' guess_share = "{guess}"\n'
    )


@pytest.mark.parametrize(
    "source",
    [
        "guess = None  # your guess: yes or no?\n",
        'guess = "yes"',
        'guess = "#1"',
        "guess = (720, 1280)",
        "guess = len(frame)",
        "x = yes",
        "guess = yes\nprint(guess)",
        "%time guess = 3",
    ],
)
def test_other_cells_stay_as_they_are(source):
    assert read_bare_guess([source], {"frame"}) == [source]


def test_an_empty_guess_is_no_guess():
    assert read_bare_guess(["guess_share =  # your guess: how many?\n"], {}) == ["guess_share = None\n"]
