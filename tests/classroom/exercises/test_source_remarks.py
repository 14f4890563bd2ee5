"""Sentences about a function that are certain from its source alone."""

import pytest
from nbclassroom.exercises.source_remarks import has_done, remarks_on_source, unused_arguments
from readable_cell import run_cell


def function_of(source):
    return run_cell(source)["f"]


def remarks(source, errors=()):
    return remarks_on_source(function_of(source), errors)


@pytest.mark.parametrize(
    ("line", "start"),
    [
        ("raise NotImplementedError('x')\n    return a", "The line with raise NotImplementedError is still"),
        ("return a\n    return b", "The last lines of f() are never run. What stands below a return is not"),
        ("return a == 1 or 2", "In a == 1 or 2 the last part is no comparison, and is true or false by"),
        ("a.astype(int)\n    return a", "a.astype(int) gives a new value and changes nothing: keep it"),
        ("return a is True", "a is True asks for the value True or False itself: of the number 1"),
        (
            "b = a > 3\n    return a * b",
            "b is what the function gets, and b = a > 3 replaces it before it is",
        ),
        ("a[b] == 9\n    return a", "a[b] == 9 stands alone: it compares, and nothing is done"),
        ("a & (b > 3)\n    return a", "a & (b > 3) gives a new value and changes nothing: keep it"),
        ("return a << b + 1", "In a << b + 1 the sum is computed before the shift."),
        ("sorted(a)\n    return a", "sorted(a) gives a new value and changes nothing: keep it"),
        (
            "for c in a:\n        if c > b:\n            c = 9",
            "In the loop for c in a: its variable gets another",
        ),
        ("return [[0] * a] * b", "[[0] * a] * b has one row several times: what is set in one"),
        (
            "for c in a:\n        if c:\n            return c\n        else:\n            return b",
            "A return at the",
        ),
        ("for c in a:\n        return c", "A return at the end of the block of a loop ends the function in"),
    ],
)
def test_a_certain_mistake_is_named(line, start):
    (remark,) = remarks(f"def f(a, b):\n    {line}\n")
    assert remark.startswith(start)


@pytest.mark.parametrize(
    "line", ["a or 2", "b = b > a", "a += b", "for c in a:\n        if c: break\n        return c"]
)
def test_of_other_lines_nothing_is_said(line):
    assert remarks(f"def f(a, b):\n    {line}\n") == []


def test_what_a_loop_over_an_argument_gives_should_be_used():
    source = "def f(boxes):\n    for left, top, width in boxes:\n        print(left, {})\n"
    texts = remarks(source.format("top"), {""})
    assert texts == ["f() does not use what it gets: width."]
    assert remarks(source.format("top, width"), {""}) == []


def test_memory_that_is_replaced_is_told():
    (remark,) = remarks("def f(seen, memory):\n    memory = {'seen': seen}\n    return memory")
    assert remark.startswith("memory = ... makes a new value that only this call has.")


def test_a_source_that_is_not_known_gives_no_remark():
    assert remarks_on_source(len) == []


def test_why_a_none_was_returned():
    source = "def f(a):\n    if a > 3:\n        return a\n"
    (remark,) = remarks(source, {"None"})
    assert remark.startswith("There is a way through f() on which no return is reached. Is a case missing")
    assert remarks(source) == remarks(f"{source}    return None\n", {"None"}) == []
    assert remarks(f"{source}    else:\n        return 3\n", {"None"}) == []
    (remark,) = remarks(source.replace("return a", "a += 1"), {"None"})
    assert remark == "f() has no return with a value. Did you forget return?"


@pytest.mark.parametrize(
    ("sentence", "is_done"),
    [
        ("Rows come first: image[top:bottom, left:right].", True),
        ("Pad the image: write np.pad(gray, 1, mode='edge').", True),
        ("Write image[left:right].", False),
        ("Write image[top:bottom, left:right], and use np.abs(image).", False),
        ("You wrote np.pad(gray, 1, mode='edge').", False),
        ("Rows and columns are exchanged.", False),
        ("Divide each row: image[top:bottom, left:right] / 2.", False),
    ],
)
def test_code_that_stands_there_already(sentence, is_done):
    source = 'part = image[top : bottom, left:right]\npadded = np.pad(gray, 1, mode="edge")'
    assert has_done(source, sentence) == is_done


def test_an_argument_that_a_wrong_answer_does_not_use_is_named():
    source = "def f(image, mask):\n    return image > 100\n"
    assert remarks(source, {""}) == ["f() does not use what it gets: mask."]
    assert remarks(source) == []


def test_what_the_right_answer_does_not_use_is_not_asked_for():
    solution = "def g(a):\n    return a\n\n\ndef f(rows, first, last):\n    return rows, last\n"
    assert (unused_arguments(solution, "g"), unused_arguments(solution, "f")) == ((), ("first",))
    nothing = "def f(rows, first, last):\n    return 1\n"
    texts = remarks_on_source(function_of(nothing), {""}, ("first",))
    assert texts == [f"f() does not use what it gets: {name}." for name in ("rows", "last")]


def test_a_function_that_does_not_end_hears_of_its_own_loop():
    loop = "def f(a):\n    while a:\n        print(a)\n    return a\n"
    question = "A while loop may be endless: does each step change what the loop tests, and is nothing"
    question += " visited twice?"
    assert remarks(loop, {"TimeUp"}) == [question]
    assert remarks("def f(a):\n    return [b for b in range(a)]\n", {"TimeUp"}) == []
