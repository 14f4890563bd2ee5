"""Advice on errors: each error is really raised, by the Python and the NumPy that are installed."""

import math  # noqa: F401 - the lines below use it
from pathlib import Path  # noqa: F401
from types import SimpleNamespace  # noqa: F401

import numpy as np
import pytest
from nbclassroom.exercises.error_advice import advice_on

GIVEN = {
    "a": np.arange(30).reshape(5, 6),
    "mask": np.ones((5, 6), bool),
    "kernel": np.ones((3, 3)),
    "text": "abc",
    "values": [3, 1, 2],
    "names": {"box": 1},
    "nothing": None,
    "memory": {},
    "number": 5,
    "colour": np.zeros((4, 5, 3), np.uint8),
}

ADVICE = {
    "text[a]": "A list or a text takes one number as its index",
    "np.linalg.norm(a)[0]": "A sum, a mean or a norm without axis=... is one number",
    'memory["count"] += 1': "Store a first value for 'count' before you read it, as memory.setdefault does",
    "word, angle = nothing": "test it first: if value is None",
    "a > 3 and a < 9": "`and` and `or` need a single True or False",
    "3 < a < 9": "A chained comparison such as low < a < high does not work with an array.",
    "a > 3 & a <= 9": "& is computed before > and <=. Put each comparison in parentheses",
    "1.5 ^ 2": "In Python ^ is not a power. Write a ** 2 for a square.",
    "(1, 2) - (3, 4)": "A tuple does no arithmetic. Take its numbers one by one",
    "math.remainder(a, 2 * math.pi)": "all at once: (angles + np.pi) % (2 * np.pi) - np.pi",
    "min([])": "min() of nothing is an error, and here there is nothing to compare.",
    "max(x for x in [])": "give a value for it: max(..., default=...)",
    "if a > 3:\n    pass": "`if` and `while` need one True or False",
    "np.linalg.solve(np.zeros((3, 3)), np.ones(3))": "The equations have no single solution",
    "a.shape[2]": "The shape of a gray image has two numbers",
    "a * kernel": "equal shapes. A kernel needs a window of its own size for each pixel.",
    "np.zeros(8).reshape(3, 3)": "8 values do not fill the shape (3,3). Usual causes: the shape is not",
    "a[number + 1, number]": "so 4 is the last index of axis 0. Here number + 1 goes further.",
    "np.ones((3, 4))[:] = np.ones((2, 4))": "Values are stored in a place of their own shape",
    "a / a.sum(axis=1)": "It needs a second axis then: numbers[:, None]",
    "''[0] == text[0]": "This string is empty, and has neither a first nor a last element.",
    "values.upper()": "A list has no .upper(). Do its elements have it?",
    "values.right": "A list has no .right. Its parts have numbers: [0] is the first.",
    "a.rows": "An array has no .rows: the number of its rows is .shape[0]",
    "SimpleNamespace(height=3).rows": "The number of its rows is height, and of its columns width",
    "a.copy[0] = 3": "here or where it got its name, as in new = old.copy()",
    "raise NameError(\"name 'rospy' is not defined\")": "rospy is the library of ROS 1, and ROS 2 has rclpy",
    "a[1:] - a[:-2]": "One of these two is longer, by 1. Print the shapes of both:",
    "a[5, 0]": "so 4 is the last index of axis 0.",
    "colour[0, 0, 3]": "so 2 is the last index of axis 2. Axis 2 of a colour image holds its channels.",
    "values[3]": "the last index is len(...) - 1",
    'np.frombuffer(b"abc")': "Without dtype np.frombuffer reads float64, eight bytes for each value",
    "SimpleNamespace(width=3).channels": "A message has no field channels",
    "a.reshape(4, -1)": "30 values do not fill the shape (4,newaxis).",
    "a[1.5]": "An index is a whole number, and / makes a float.",
    "a[a.shape[0] / 2, 0]": "Divide whole numbers with //; with floats, // gives a float too: use int()",
    "values[1.0]": "Divide whole numbers with //; with floats, // gives a float too: use int()",
    "range(5 / 2)": "A count is a whole number",
    "values[1, 2]": "values[row][col]",
    "a[0, 0, 0]": "The array has 2 axes, and you give 3 indices.",
    "a[kernel > 0]": "A mask chooses values of an array of its own shape.",
    "a += 0.5": "Write a = a + b instead of a += b",
    "maths.sqrt(2)": "Nothing has the name maths here.",
    "os.getcwd()": "Write its import line in it: import os",
    "cos(0.5)": "Write its import line in it: from math import cos",
    "norm(a)": "Write its import line in it: from numpy.linalg import norm",
    "def f(x):\n    if x > 9:\n        best = 1\n    return best\nf(1)": "Is a case missing, or does best",
    "a.append(3)": "An array cannot grow.",
    "a.height": "the number of its rows is .shape[0], that of its columns .shape[1]",
    "values.reshape(3, 1)": "A list has no .reshape. Make an array of it first",
    "grown = a or mask": "Between arrays write & or |, with each comparison in parentheses.",
    "values.sort()[0]": "call them on a line of their own, or use sorted(values)",
    "nothing.shape": "A value here is None.",
    "nothing + 1": "A value here is None.",
    "a.shape(0)": "A tuple is not a function",
    "number(2)": "is a * missing before them?",
    "len[values]": "This is a function. Call it with round brackets",
    "number[0]": "This is a single number",
    "int(a)": "array.astype(...) changes the dtype of all values",
    "math.log10(a)": "NumPy has functions for arrays, such as np.log10",
    "text - 1": "cannot be combined in this way. An f-string",
    "text + 1": "An f-string writes both into a text.",
    "rows, cols = colour.shape": "A colour image has three, rows, columns and channels",
    "for name, value in names:\n    pass": "For keys and values write dictionary.items().",
    "for x, y, z in [names]:\n    pass": "There are 3 names between for and in, and a value of this loop has",
    "for x, y in values, values:\n    pass": "To go through two sequences together write zip",
    "np.zeros(number, number)": "The shape is one argument, in parentheses of its own",
    "x, y = values": "There are 2 names on the left",
    "0.5 ^ 2.0 * a": "In Python ^ is not a power.",
    "a > 3.0 | (a * 0.5)": "put each comparison in parentheses",
    "mask | (a * 0.5)": "for a mask write np.zeros(shape, dtype=bool)",
    "np.zeros(3, np.uint8) * 3735": "So the values would overflow: widen the array first, as in astype",
    "-mask": "For the opposite of a mask write ~mask.",
    "def f():\n    return f()\nf()": "Mark what it has visited already",
    "1 / 0": "The divisor is 0 for this input.",
    "(a * 0.5)[0, 0] = values": "One element of an array holds one number",
    "np.zeros(0).max()": "The array has no values here, so it has no maximum",
    'np.frombuffer(b"abc", "u1")[0] = 1': "Work on a copy: array.copy().",
    "a @ a": "as many columns on its left as rows on its right: here 6 and 5. Which shape has each part?",
    "a @ np.diag(values)": "np.diag of n numbers is n × n.",
    "np.zeros(1)[number]": "or a value that was rounded up?",
    "np.dot(a, a)": "Value by value, arrays are multiplied with *.",
    'round(float("nan"))': "NaN is the result of 0 divided by 0",
    "import sklearns": "No library with the name sklearns is installed here.",
    "a = \u201ca\u201d": "\u201c is no character of Python: chats, word processors and web pages write it in"
    " the place of \" or '. Type \" or ' there.",
    "a = 3 \u2212 2": "\u2212 is no character of Python: chats, word processors and web pages write it in the"
    " place of -. Type - there.",
    "a =\u00a03": "U+00A0, which nobody sees, is no character of Python: chats, word processors and web"
    " pages write it in the place of a space. Type a space there.",
    "a = 3\u200b": "U+200B, which nobody sees, is no character of Python: chats, word processors and web"
    " pages write it. Type this line again.",
    "a = 3\u00b2": "\u00b2 is no character of Python, except in texts and comments.",
    "a = 3 \u2013 2": "in the place of -. Type - there.",
    "a = (3\uff09": "\uff09 is no character of Python: chats, word processors and web pages write it in the"
    " place of ). Type ) there.",
    "retrun a": "is a word misspelled (return, def, else)",
}


def error_of(source):
    """(type name, message, line) of the error that a source raises."""
    try:
        exec(source, globals() | GIVEN)
    except SyntaxError as error:
        return type(error).__name__, error.msg, f"line 1: {source}"
    except (Exception, SystemExit) as error:  # noqa: BLE001 - any error may be wanted
        first = next((line for line in source.splitlines() if not line.startswith("def ")), source)
        return type(error).__name__, str(error), f"line 1: {first}"
    raise AssertionError(f"{source!r} raises nothing")


@pytest.mark.parametrize("source", ADVICE, ids=range(len(ADVICE)))
def test_each_error_has_its_advice(source):
    assert ADVICE[source] in advice_on(*error_of(source))


def test_an_argument_that_the_function_does_not_take_is_named():
    def luma():
        return 3

    with pytest.raises(TypeError) as caught:
        luma(3)
    message = str(caught.value).replace(luma.__qualname__, "luma")
    advice = advice_on("TypeError", message, "", ("bgr",), "luma")
    assert advice == "check calls luma(bgr): begin your function with def luma(bgr): and use these arguments."


def test_an_unknown_error_gets_no_advice():
    assert advice_on("ValueError", "a message of somebody's") == ""
    assert advice_on("MemoryError", "out of bounds for axis 0 with size 5") == ""


def test_a_line_that_is_a_part_of_a_statement_gets_the_general_advice():
    advice = advice_on("ValueError", "The truth value of an array with ...", "line 3: (a > 3 and")
    assert advice.startswith("`if` and `while` need one True or False")


def test_the_number_256_needs_another_number_and_not_a_wider_array():
    assert "widen" not in advice_on(*error_of("np.zeros(3, np.uint8)[0] = 256"))


def test_what_a_loop_over_the_image_itself_reads_needs_no_padding():
    assert "must be padded" not in advice_on(*error_of("a[number, number]"))
    for line in (
        "a[number, number + 1]",
        "a[number - 1, 0] + a[number, 0]",
        "a[number, 0] + GIVEN['a'][number + 1, 0]",
    ):
        assert "goes further" not in advice_on(*error_of(line))


def test_a_close_name_comes_before_general_advice_but_not_before_a_missing_import():
    error = error_of("maths.sqrt(2)")
    assert advice_on(*error, closest="mask") == "Did you mean mask? Every letter counts, small or capital."
    assert "import os" in advice_on(*error_of("os.getcwd()"), closest="pos")
    text = "Write self.mask: what belongs to the object has self. before its name."
    assert advice_on(*error, closest="self.mask") == text
