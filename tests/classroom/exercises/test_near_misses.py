"""The one small change that makes an answer pass, as a question about its place."""

import ast

import numpy as np
import pytest

from imgproc_course.classroom.exercises.answer_cells import ComposedAnswer
from imgproc_course.classroom.exercises.check_data import Case, CheckData, ExpectedCall
from imgproc_course.classroom.exercises.near_misses import near_miss
from imgproc_course.classroom.exercises.running import call

IMAGE = np.random.default_rng(1).integers(0, 256, size=(7, 9), dtype=np.uint8)
COLOUR = np.random.default_rng(2).integers(0, 256, size=(4, 5, 3), dtype=np.uint8)
MASK = IMAGE > 120


def near_miss_of(body, wrong_body, *arguments):
    """The question about a wrong body of f(a, b) for the arguments, whose right body is given."""
    sources = [f"def f(a, b):\n    {text}\n" for text in (body, wrong_body)]
    names = {"np": np}
    exec(sources[0], names)
    calls = tuple(ExpectedCall(args, call(names["f"], args, ("a", "b"), 1)) for args in arguments)
    exercise = CheckData(
        **{"id": "test-f", "title": "", "function": "f", "names": ("a", "b"), "stub": "", "given": ()},
        **{"allowed": (), "time_limit": 1.0, "practice": False, "hidden_count": 0, "hidden_points": 0},
        **{"border_hint": "", "hints": (), "another_way": "", "exact_type": False, "mistakes": ()},
        cases=(Case("1", "", 1, "", 0.0, calls=calls),),
    )
    text = near_miss(exercise, ComposedAnswer("f", sources[1]))
    return text.removeprefix("With one small change all checks here pass.\nin your line: ")


WINDOWS = """result = np.zeros_like(a)
    padded = np.pad(a, 1)
    for row in range(a.shape[0]):
        for col in range(a.shape[1]):
            result[row, col] = padded[row : row + 3, col : col + 3].max()
    return result"""


@pytest.mark.parametrize(
    ("right", "wrong", "question"),
    [
        (
            "return a > b",
            "return a >= b",
            "Is >= right in a >= b, or must it be >? What about a value that is equal?",
        ),
        (
            "return a <= b",
            "return a < b",
            "Is < right in a < b, or must it be <=? What about a value that is equal?",
        ),
        ("return a > b", "return a < b", "Is < right in a < b, or must it be >?"),
        ("return (a > 9) & (a < b)", "return (a > 9) | (a < b)", "or must it be &?"),
        (
            "return a / 2 / (b + 1)",
            "return a / 2 / b + 1",
            "computes a / 2 / b first. Are parentheses missing?",
        ),
        ("return (a / 3 - b) ** 2", "return a / 3 - b**2", "computes b ** 2 first. Are parentheses missing?"),
        ("return a / (b + 1)", "return (b + 1) / a", "Are b + 1 and a exchanged?"),
        ("return np.where(a > b, 7, 0)", "return np.where(a > b, 0, 7)", "Are 0 and 7 exchanged?"),
        ("return a.mean(axis=1)", "return a.mean(axis=0)", "Is 0 right in axis=0, or 1?"),
        ("return a.mean(axis=1)", "return a.sum(axis=1)", "Is sum right, or must it be mean?"),
        ("return a[1:, 2:]", "return a[1:, 1:]", "in 1:?"),
        ("return a[: b - 115]", "return a[: b - 116]", "Is 116 one too large in b - 116?"),
        ("return [k for k in range(b)]", "return [k for k in range(b + 1)]", "Is 1 one too large in b + 1?"),
        (
            "return [k for k in range(b - 1)]",
            "return [k for k in range(b)]",
            "Is b one too large in range(b)?",
        ),
        ("return (a / 9) @ a.T", "return (a.T / 9) @ a.T", "Must a.T / 9 be transposed?"),
        ("return (a / 9) @ a.T", "return (a / 9) @ a", "Must a be transposed?"),
        ("return (a / 9) * a", "return (a / 9) @ a", "Is @ right in a / 9 @ a, or must it be *?"),
        (
            "return a / 4.0 - b",
            "return abs(a / 4.0 - b)",
            "Is abs(a / 4.0 - b) right, or is a / 4.0 - b enough?",
        ),
        ("return a.astype(int) * 3", "return a * 3", "Values wrap around in the dtype of a,"),
        (
            "return np.zeros((7, 9))[a > 0]",
            "return np.zeros((7, 9))[a]",
            "a holds numbers, and here a mask is",
        ),
        (WINDOWS, WINDOWS.replace("+ 3", "+ 2"), "Is 2 one too small in row + 2?"),
        (WINDOWS, WINDOWS.replace("shape[0]", "shape[1]"), "Is 1 right in a.shape[1], or 0?"),
    ],
)
def test_the_place_of_one_small_mistake(right, wrong, question):
    assert question in near_miss_of(right, wrong, (IMAGE, 120))


def test_the_order_of_the_channels():
    right = "b, g, r = a[..., 0], a[..., 1], a[..., 2]\n    return b * 0.1 + g * 0.6 + r * 0.3"
    text = near_miss_of(right, right.replace("b, g, r =", "r, g, b ="), (COLOUR, 0))
    assert text.endswith("Are r and b exchanged?")
    wrong = right.replace("2]", "3]").replace("0]", "2]").replace("3]", "0]")
    assert near_miss_of(right, wrong, (COLOUR, 0)).endswith("exchanged?")


def test_the_line_is_the_learners_own():
    text = near_miss_of(
        "x = 1\n    return a > b", "x = 1\n    return a >= b  # brighter", (IMAGE, int(IMAGE[0, 0]))
    )
    assert text.splitlines()[0] == "return a >= b  # brighter"


@pytest.mark.parametrize(
    "wrong",
    [
        "return a * 17 - 3 * b",  # more than one thing is wrong
        "if b == 1: return a",
        "open('x', 'w')\n    return a >= b",  # a changed copy might do harm
        "import os\n    return a >= b",
        "while True: pass",
    ],
)
def test_of_other_answers_nothing_is_said(wrong):
    assert near_miss_of("return a > b", wrong, (IMAGE, int(IMAGE[0, 0])), (IMAGE, 3)) == ""


def test_a_text_with_values_in_it_is_read_too():
    right = "return f'{b - 1:03d} and {b}'"
    assert "Is 2 one too large in b - 2?" in near_miss_of(right, right.replace("- 1", "- 2"), (IMAGE, 5))


def test_the_trees_that_are_tried_leave_the_answer_as_it_is():
    source = "def f(a, b):\n    return a * 17 - 3 * b\n"
    answer = ComposedAnswer("f", source)
    near_miss_of("return a > b", "return a * 17 - 3 * b", (IMAGE, 3))
    assert answer.source == source and ast.unparse(ast.parse(source)) == source.strip()
