"""One change makes a source Python, or nothing is said: the list holds slips of honest learners."""

import ast

import pytest
from nbclassroom.exercises import cell_syntax
from nbclassroom.exercises.cell_syntax import plain_character, without_slip

SLIPS = {
    "dfe f(x):\n    return x": "def f(x):\n    return x",
    "Def f(x):\n    return x": "def f(x):\n    return x",
    "def f(x):\n    retrun x": "def f(x):\n    return x",
    "def f(x):\n    retrn x": "def f(x):\n    return x",
    "def f(x):\n    returnn x": "def f(x):\n    return x",
    "if x:\n    y = 1\nesle:\n    y = 2": "if x:\n    y = 1\nelse:\n    y = 2",
    "def f(x):\n    y = 1\n     return y": "def f(x):\n    y = 1\n    return y",
    "def f(x):\n    y = 1\n   return y": "def f(x):\n    y = 1\n    return y",
    "def f(x):\n\ty = 1\n        return y": "def f(x):\n        y = 1\n        return y",
    "y = \u201ca\u201d + \u2018b\u2019": "y = \"a\" + 'b'",
    "y = 'a\u2019": "y = 'a'",
    "y = 3 \u2013 x": "y = 3 - x",
    "def f(x):\n\u00a0   return x": "def f(x):\n    return x",
    "y = x\u200b": "y = x",
    "\u201cnot\u201d mended in a text": None,
    "f\uff08x\uff09": "f(x)",
    # More than one change, or no Python at all.
    "def f(x)\n    retrun x": None,
    "I do not know what to do": None,
    "I don\u2019t know what to do": None,
    "def f(x):\n": None,
    "def f(x):\n    return x *": None,
    "print \u201ca\u201d": None,
    "x plus 3": None,
    "<html>": None,
}


def error_in(source):
    with pytest.raises(SyntaxError) as caught:
        ast.parse(source)
    return caught.value


@pytest.mark.parametrize(("source", "mended"), SLIPS.items(), ids=map(repr, SLIPS))
def test_a_slip_is_mended(source, mended):
    result = without_slip(source, error_in(source))
    assert (result and result[0]) == mended
    assert result is None or ast.dump(result[1]) == ast.dump(ast.parse(mended))


def test_a_long_source_is_not_searched(monkeypatch):
    source = "retrun x"
    monkeypatch.setattr(cell_syntax, "_MOST_CHARACTERS", len(source))
    assert without_slip(source, error_in(source))
    assert without_slip(source + " ", error_in(source + " ")) is None


def test_no_line_is_tried_often(monkeypatch):
    tries = []
    monkeypatch.setattr(
        cell_syntax.ast, "parse", lambda text: tries.append(text) or compile(text, "", "exec")
    )
    source = "retrun " * 300
    assert without_slip(source, SyntaxError("invalid syntax", ("", 1, 1, source, 1, 200))) is None
    assert len(tries) == cell_syntax._MOST_TRIES == len(set(tries))


def test_an_error_outside_the_lines_is_no_slip():
    assert without_slip("retrun x", SyntaxError("invalid syntax", ("", 9, 90, "", 9, 91))) is None


def test_what_a_keyboard_writes_for_a_typographic_character():
    written = map(plain_character, "\u201c\u2019\u2212\u00a0\u200b\uff1a\u00b2")
    assert list(written) == ['"', "'", "-", " ", "", ":", None]
