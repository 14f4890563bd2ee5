"""The one change that would make a wrong answer right, named by its place."""

import numpy as np
import pytest
from nbclassroom.exercises import one_change
from nbclassroom.exercises.one_change import sentence_on_change
from nbclassroom.exercises.running import call
from readable_cell import run_cell


def sentence(source, *pairs, task=""):
    """The sentence on a function f, for which (arguments, expected value) are the calls."""

    def passes(function, seconds):
        results = [call(function, arguments, [], seconds) for arguments, _ in pairs]
        wanted = [call(lambda value=value: value, (), [], 1) for _, value in pairs]
        return all(map(lambda one, other: one.matches(other, 1e-9, exact_type=False), results, wanted))

    return sentence_on_change(run_cell(source, {"np": np})["f"], passes, task)


ROWS = "def f(a):\n    found = []\n    for row in range(len(a)):\n        for col in range(len(a[0])):\n"
TABLE = [[0, 5, 0], [7, 0, 0]]
CASES = {
    "a limit": ("def f(a, b):\n    return a < b", [((1, 1), True), ((2, 1), False)], "line 2", "the limit"),
    "an order": ("def f(a, b):\n    return a - b", [((1, 3), 2)], "line 2", "which of them comes first?"),
    "a function": ("def f(a):\n    return int(a)", [((1.6,), 2), ((1.2,), 1)], "line 2", "int(a)"),
    "a line": (
        "def f(a):\n    b = 2 * a\n    a = a + 1\n    return a, b",
        [((1,), (2, 4)), ((5,), (6, 12))],
        "line 2",
        "b = 2 * a: should it come after what stands below it?",
    ),
    "none": ("def f(a):\n    return not a", [((0,), False), ((None,), True)], "not a", "is None meant?"),
    "a sign": ("def f(a):\n    return [a, 3]", [((2,), [-2, 3])], "a in return [a, 3]", "its sign"),
    "a name in one line": (
        "def f(a, b):\n    c = a + 1\n    return c * (a - 2) * (2 - a)",
        [((1, 3), -2), ((2, 5), -27)],
        "line 3",
        "a in return c * (a - 2) * (2 - a): is it the right variable?",
    ),
    "the first number of a search": (
        "def f(a):\n    low = 9\n    for b in a:\n        low = b if b < low else low\n    return low",
        [(([20, 11, 30],), 11)],
        "9 in low = 9",
        "is this number right?",
    ),
    "a value in each round": (
        "def f(a):\n    b = []\n    least = np.inf\n    for c in a:\n        for d in c:\n"
        "            least = min(d, least)\n        b.append(least)\n    return b",
        [(([[1, 2], [4, 3]],), [1, 3])],
        "least = np.inf",
        "in each round of the loop?",
    ),
    "a number": ("def f(a):\n    return a[1:-1]", [(([1, 2, 3],), [1, 2])], "line 2", "1 in return a[1:-1]"),
    "a square": ("def f(a):\n    return 16 - a", [((0,), 256)], "line 2", "16 in return 16 - a"),
    "the names of a shape": (
        "def f(a):\n    height, width = a.shape\n    return a.sum() / height",
        [((np.ones((2, 3)),), 2.0)],
        "line 3",
        "height in return a.sum() / height: is it the right variable?",
    ),
    "a variable": ("def f(a, b):\n    return a * a", [((2, 5), 10)], "line 2", "a in return a * a"),
    "the dtype of an argument": (
        "def f(a):\n    return float(sum(a) / len(a))",
        [((np.array([200, 100], np.uint8),), 150)],
        "With one change, these",
        "do not fit into the dtype of a. Widen a first, with astype.",
    ),
    "the same at two places": (
        ROWS + "            if a[row][col]:\n                r, c = col, row\n"
        "                found.append((r, c))\n"
        "    return found",
        [((TABLE,), [(0, 1), (1, 0)])],
        "line 6",
        "(r, c)",
    ),
    "in two lines": (
        "def f(a, b):\n    a = a // 2\n    b = b // 2\n    return a, b",
        [((1, 3), (0.5, 1.5))],
        "lines 2, 3",
        "a // 2, and b // 2: is it the right operator?",
    ),
    "a window": ("def f(a):\n    return [*range(a)]", [((1,), [0, 1, 2]), ((0,), [0])], "range(a)"),
    "a dtype": ("def f(a):\n    return int(np.uint16(a))", [((70000,), 70000)], "can this type hold every"),
    "a size": (
        "def f(a):\n    return a.sum() / 25",
        [((np.ones(6),), 1.0)],
        "is it the same for every input?",
    ),
    "one number twice": ("def f(a):\n    return a[1:4][:4]", [(("abcdefg",), "bcde")], "line 2", "4 in"),
    "the end of two loops": (
        "def f(a, b):\n    k = 0\n    for i in range(1, len(a)):\n        for j in range(1, len(b)):\n"
        "            k += i * j\n    return k",
        [(("ab", "abc"), 18)],
        "lines 3, 4",
        "range(1, len(a)), and range(1, len(b)): does it end at the right place?",
    ),
    "a missing square": (
        "def f(a, b):\n    return a * (1 / b) + a / (2 * b)",
        [((2.0, 4.0), 1.0), ((3.0, 2.0), 3.75)],
        "is its square needed?",
    ),
    "parentheses": (
        "def f(a, b, c, d):\n    return a * b - c + d",
        [((2, 7, 4, 1), 8)],
        "line 2",
        "a * b - c + d: do parentheses stand where they should?",
    ),
    "a slice that begins below 0": (
        "def f(a, k):\n    return a[k - 2 : k]",
        [(("abcd", 1), "a"), (("abcd", 3), "bc")],
        "k - 2:k in return a[k - 2 : k]: can it begin below 0, which counts from the end?",
    ),
    "the next round": (
        "def f(a):\n    b = 0\n    for c in a:\n        if c < 0: break\n        b += c\n    return b",
        [(([5, -1, 2],), 7), (([-1, 1],), 1)],
        "line 4",
        "or go on with its next round?",
    ),
    "two parts": ("def f(a, b):\n    return a // b * b", [((7, 3), 7), ((8, 3), 8)], "", "last two parts"),
    "a condition of two": (
        "def f(a):\n    return a[(a > 2) & (a < 5)].sum()",
        [((np.array([3, 6, 1]),), 4), ((np.array([1, 9, 4]),), 5)],
        "line 2",
        "is the first part needed?",
    ),
    "an end at -0": ("def f(a, k):\n    return a[k:-k]", [(("ab", 0), "ab"), (("abc", 1), "b")], "-0 mean"),
    "the end of a slice": (
        "def f(a, k):\n    return a[0:k]",
        [(("abcd", 2), "abc")],
        "last element left out?",
    ),
    "an index": (
        "def f(a, r, c):\n    return a[r][c] + a[c, r]",
        [((np.arange(9).reshape(3, 3), 0, 1), 8)],
        "a[c, r]: is it the right place?",
    ),
    "columns": (
        "def f(a):\n    return int(a[::2].sum())",
        [((np.arange(6).reshape(2, 3),), 10)],
        "take columns?",
    ),
    "not": ("def f(a):\n    return not a", [((True,), True), ((0,), 0)], "not a: is it the right way round?"),
    "a factor too many": ("def f(a):\n    return a * 100 < 2", [((1,), True), ((3,), False)], "second part"),
    "the other pixels": ("def f(a):\n    return a.tolist()", [((np.ones(2) > 0,), [False, False])], "a in"),
    "a length": ("def f(a):\n    return a.sum() / len(a)", [((np.ones((2, 3)),), 2.0)], "the right size?"),
    "a product": ("def f(a):\n    return a.sum() / (4 * 5)", [((np.ones((2, 3)),), 1.0)], "4 * 5 in"),
    "twice a number": (
        "def f(a):\n    return a * 8",
        [((3,), 48)],
        "8 in return a * 8: is this number right?",
    ),
    "in each round": (
        "def f(a):\n    n = 0\n    sums = []\n    for row in a:\n        for b in row:\n            n += b\n"
        "        sums.append(n)\n    return sums",
        [(([[1, 2], [3]],), [3, 3])],
        "n = 0: should it run once, or in each round of the loop?",
    ),
    "two names": (
        "def f(a):\n    b = a\n    b[0] = b[0] + a[1]\n    b[1] = b[1] + a[0]\n    return b",
        [(([1, 5],), [6, 6])],
        "another name for the same one?",
    ),
    "a condition": (
        "def f(a):\n    b = []\n    for c in a:\n        if c > 1:\n            b.append(c)\n    return b",
        [(([1, 5],), [1, 5])],
        "if c > 1: is this condition needed?",
    ),
    "a call": ("def f(a):\n    return sorted(a)", [(([2, 1],), [2, 1])], "sorted(a)", "is this call needed?"),
    "a keyword": ("def f(a):\n    return sorted(a, reverse=1)", [(([2, 1],), [1, 2])], "is reverse needed?"),
    "the old value": (
        "def f(a, b):\n    a = a + b\n    b = a - b\n    return [a, b]",
        [((5, 2), [7, 3])],
        "does the line below it need the old value?",
    ),
    "a denominator": ("def f(a, b):\n    return a / b * 4", [((16, 2), 2)], "a / b * 4", "right operator?"),
    "a part too many": ("def f(a, b):\n    return a * b + b", [((2, 3), 6)], "is the second part needed?"),
}


@pytest.mark.parametrize("name", CASES)
def test_the_place_of_one_change_is_named(name):
    source, pairs, *parts = CASES[name]
    text = sentence(source, *pairs)
    assert "these checks pass" in text
    assert all(part in text for part in parts), text


def test_a_change_is_found_in_a_class():
    source = "class f:\n    def __init__(self, a):\n        self.a = a - 1\n"
    made = run_cell(f"x = 1\n\n{source}")["f"]
    right = call(lambda: 5, (), [], 1).value
    text = sentence_on_change(made, lambda changed, _: call(lambda: changed(4).a, (), [], 1).value == right)
    assert "line 5" in text and "is it the right operator?" in text


def test_a_condition_that_never_held_is_named():
    source = "def f(a):\n    if a == '1':\n        return 1\n    elif a > 9:\n        return 2\n    return 3"
    function = run_cell(source)["f"]
    text = "In these checks a == '1' was never true: line 3 never ran."
    assert one_change.sentence_on_branch(function, lambda: function(5)) == text
    text = "In these checks a > 9 was never true: line 5 never ran."
    assert one_change.sentence_on_branch(function, lambda: (function("1"), function(5))) == text
    assert one_change.sentence_on_branch(function, lambda: (function("1"), function(10))) == ""


def test_a_number_of_the_task_is_tried():
    source, pairs = "def f(a):\n    return a > 5", [((0.5,), True), ((0.1,), False)]
    assert "of the task?" in sentence(source, *pairs, task="A quarter is 25 %, or 0.25.")
    assert sentence(source, *pairs) == ""
    source, pair = "def f(a):\n    return a @ [1, 0, -1]", ((np.array([[5, 0, 2]]),), [-3])
    assert "1 in" in sentence(source, pair, task="3 of 7")


def test_a_line_of_the_task_is_right():
    source = "def f(a):\n    first, second = a\n    return second - first"
    assert "line 2" in sentence(source, (((5, 2),), 3))
    assert "line 3" in sentence(
        source, (((5, 2),), 3), task="Begin with\n    first, second = a\nand subtract."
    )


def test_nothing_is_said_if_no_change_helps():
    assert sentence("def f(a):\n    return 0", ((4,), 16), ((5,), 25)) == ""


@pytest.mark.parametrize("code", ["sum(a[-b:])", "sum(a[k] for k in range(b))"])
def test_a_place_is_no_factor_too_small(code):
    assert sentence(f"def f(a, b):\n    return {code}", (([1, 2, 3, 4, 5, 6], 2), 21)) == ""


@pytest.mark.parametrize("called", ["np.vectorize(abs)", "(lambda x: x)", "[abs][0]", "np.poly1d([1, 2])"])
def test_what_is_called_may_be_any_expression(called):
    assert sentence(f"def f(a):\n    return {called}(a) - a", ((4,), 100), ((5,), 110)) == ""


def test_changed_answers_log_nothing(caplog):
    source = "def f(a):\n    import logging\n    logging.warning('called')\n    return a - 1"
    assert "line 4" in sentence(source, ((4,), 5)) and caplog.text == ""


def test_the_time_of_all_changes_is_limited(monkeypatch):
    source, pairs, *_ = CASES["a limit"]
    monkeypatch.setattr(one_change, "_MOST_SECONDS", 0)
    assert sentence(source, *pairs) == ""


def test_a_change_that_never_ends_costs_no_more_than_its_time():
    source = "def f(a):\n    n = 0\n    while n <= a:\n        n += 1\n    return n"
    assert "n <= a" in sentence(source, ((3,), 3), ((5,), 5))
