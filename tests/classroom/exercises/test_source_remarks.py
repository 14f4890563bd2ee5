"""Sentences about a function that are certain from its source alone."""

import linecache

import pytest

from imgproc_course.classroom.exercises.source_remarks import remarks_on_source

LOOP = """def f(image, sector):
    for row in range(3):
        if sector[row] == 0:
            first = 1
        if sector[row] == 1:
            first = 2
        else:
            first = 3
    return first
"""


def function_of(source):
    """The function that a source defines; its source can be read, as that of a notebook's cell."""
    names = {}
    linecache.cache["<cell>"] = (len(source), None, source.splitlines(keepends=True), "<cell>")
    exec(compile(source, "<cell>", "exec"), names)
    return names["f"]


def remarks(source, errors=()):
    return remarks_on_source(function_of(source), errors)


@pytest.mark.parametrize(
    ("line", "start"),
    [
        ("if m == 'a' or 'b': return 1", "m == 'a' or 'b' is always true, because 'b' alone counts as True."),
        ("return a @ b", "a @ b is the product of two matrices or vectors;"),
        ("return np.dot(a, b)", "np.dot(a, b) is the product of two matrices or vectors;"),
        ("return sorted(a.glob('*'))", ".glob() looks on the disk of this computer, where"),
        ("width, height = a.shape", "width and height are exchanged: a shape begins with the number of rows"),
        ("w, h, n = a.shape[:2]", "w and h are exchanged"),
        ("t = np.uint8(0)\n    while t <= 255: t += 1", "t <= 255 is always true for a uint8"),
        ("return a.sum() == a.sum()", "a.sum() == a.sum() compares a value with itself."),
        ("return a > b & ~c", "Python computes b & ~c first, before the comparison."),
        ("x = y = np.zeros(3)", "x = y = ... gives two names to one array"),
        ("for a in range(3): pass", "The loop for a in ... writes over the argument a."),
        (
            "raise NotImplementedError('x')\n    return a",
            "The line with raise NotImplementedError is still there",
        ),
    ],
)
def test_a_certain_mistake_is_named(line, start):
    (remark,) = remarks(f"def f(a, b):\n    {line}\n")
    assert remark.startswith(start)


@pytest.mark.parametrize(
    "line",
    [
        "return a > (b & 1)",
        "return (a > b) & (a < c)",
        "x = y = 0",
        "best = worst = max(a)",
        "for row in range(3): pass",
        "return a == b",
        "raise NotImplementedError('x')",
        "height, width = a.shape",
        "(width,) = a.shape",
        "width, height = b",
        "t = 0\n    while t <= 255: t += 1",
        "t = np.uint8(0)\n    while t < 255: t += 1",
    ],
)
def test_of_other_lines_nothing_is_said(line):
    assert remarks(f"def f(a, b):\n    {line}\n") == []


def test_an_else_that_belongs_to_the_last_if_only():
    (remark,) = remarks(LOOP)
    assert remark.startswith("The else belongs to the last if only, so it also runs if sector[row] == 0.")
    assert remarks(LOOP.replace("if sector[row] == 1", "elif sector[row] == 1")) == []
    assert remarks(LOOP.replace("first = 1", "continue")) == []


def test_values_as_indices_are_named_if_an_index_was_outside():
    source = "def f(values):\n    for col in values:\n        values[col] += 1\n"
    (remark,) = remarks(source, {"IndexError"})
    assert remark.startswith("for col in values gives the values of values, not their positions.")
    assert remarks(source) == []
    assert remarks(source.replace("in values", "in range(3)"), {"IndexError"}) == []
    assert remarks(source.replace("[col]", "[col[:-1]]"), {"IndexError"}) == []


def test_positions_along_the_wrong_axis_or_none_are_named_if_they_led_to_an_error():
    source = "def f(scores):\n    for i in scores.argmax(axis=0):\n        pass\n"
    for call in ("scores.argmax(axis=0)", "scores.argmax(0)", "np.argmax(scores, axis=0)"):
        (remark,) = remarks(source.replace("scores.argmax(axis=0)", call), {"IndexError"})
        assert remark == "argmax(axis=0) gives a row's position for each column. For each row, write axis=1."
    for call in ("scores.argmax(axis=1)", "argmax(0)", "np.argmax()"):
        assert remarks(source.replace("scores.argmax(axis=0)", call), {"IndexError", "TypeError"}) == []
    for call in ("scores.argmin()", "np.argmin(scores)"):
        (remark,) = remarks(source.replace("scores.argmax(axis=0)", call), {"TypeError"})
        assert remark.startswith("argmin() without axis gives one position in all.")
    assert remarks(source) == remarks(source.replace("axis=0", ""), {"IndexError"}) == []
    assert remarks(source.replace("scores.argmax(axis=0)", "scores[0].argmax()"), {"TypeError"}) == []


def test_a_source_that_is_not_known_gives_no_remark():
    assert remarks_on_source(len) == []


def test_the_product_that_a_hint_uses_gets_no_remark():
    function = function_of("def f(a, b):\n    return a @ b == a\n")
    assert remarks_on_source(function, hints=["The offset is -(normal @ a)."]) == []
    assert len(remarks_on_source(function, hints=["Multiply each value."])) == 1
