"""What the source of a cell says: magics, names, and lines of a program."""

import pytest
from nbclassroom.exercises.cell_syntax import (
    bound_names,
    has_stub_line,
    is_part_of,
    is_stub,
    names_of,
    plain_python,
    program_lines,
    top_level,
)


@pytest.mark.parametrize(
    ("source", "plain"),
    [
        ("%%time\nx = !ls\n", "#\nx = None\n"),
        ("\n\n%%time\nx = 1", "#\n#\n#\nx = 1"),
        ("%%time", ""),
        ("%%bash\nls", "#%%bash\n#ls"),
        ("\n  x = 1\n  if x:\n    y = !ls", "\nx = 1\nif x:\n  y = None"),
        ("%time y = f()\nnp.mean?", "y = f()\npass"),
    ],
)
def test_lines_keep_their_numbers_without_magics(source, plain):
    assert plain_python(source) == plain


SCRIPT = """class Gray(Node):
    def run(self):
        while rclpy.ok():
            rclpy.spin_once(self)

def main(args=None):
    rclpy.init(args=args)
    Gray().run()

"""


@pytest.mark.parametrize(
    ("lines", "named"),
    [
        ("main()", "main()"),
        ("import sys\nif __name__ == '__main__':\n    sys.exit(main())", "main()"),
        ("try:\n    main()\nexcept KeyboardInterrupt:\n    pass", "main()"),
        ("node = Gray()\nrclpy.spin(node)", "rclpy.spin(node)"),
        ("executor.spin()", "executor.spin()"),
        ("MultiThreadedExecutor().spin()", "MultiThreadedExecutor().spin()"),
        ("while rclpy.ok():\n    rclpy.spin_once(Gray())", "rclpy.ok()"),
        ("rclpy.init()", "rclpy.init()"),
        ("import matplotlib.pyplot as plt\nplt.show()", ""),
        ("size = int(input('size?'))", "input('size?')"),
        ("cv2.waitKeyEx(0)", "cv2.waitKeyEx(0)"),
        ("while True:\n    imshow('a', b)\n    if cv2.waitKey(1) == 27:\n        break", "imshow('a', b)"),
        ("if __name__ == '__main__':\n    print(3)", ""),
        ("def wait():\n    input()", ""),
        ("TABLE = [3]; main()", "main()"),
    ],
)
def test_lines_of_a_program_are_named(lines, named):
    assert [code for _, code in program_lines(SCRIPT + lines)][:1] == [named] * bool(named)


def test_a_stub_whose_last_lines_are_missing_is_none():
    stub = "import math\n\ndef f(a):\n    b = 1\n    return b\n"
    assert is_part_of("# mine\n" + stub[13:], stub)
    assert not is_part_of("def f(a):\n    b = 1", stub) and not is_part_of("", stub)


RAISES = "raise NotImplementedError"


@pytest.mark.parametrize(
    ("source", "is_blank", "goes_on"),
    [
        ("def f(a):\n    'Text.'\n    ...", True, False),
        ("class A:\n    pass", True, False),
        (f"def f(a):\n    {RAISES}('your turn')", True, False),
        (f"def f(a):\n    b = a\n    {RAISES}\n    return b", True, True),
        (f"def f(a):\n    if a:\n        return a\n    {RAISES}", False, False),
        (f"class A(B):\n    def __init__(self):\n        super().__init__()\n        {RAISES}", True, True),
        (f"class A:\n    def __init__(self):\n        {RAISES}\n    def g(self): return 1", True, True),
        ("def f(a):\n    return 3", True, False),  # as handed out
        ("def f(a):\n    return 4", False, False),
    ],
)
def test_a_stub_computes_nothing_or_is_as_it_was_handed_out(source, is_blank, goes_on):
    [statement] = top_level(source)
    assert is_stub(statement, "def f(a):\n    return 3  # your turn") == is_blank
    assert has_stub_line(statement) == goes_on


def test_bound_names():
    source = (
        "import a.b, c as d\nx, (y, *z) = 1, (2, 3)\ndef g(h): i = 1\nclass J: k = 2\nfor m in []: n = 1\n"
        "o = [p for p in x]\n"
    )
    assert bound_names(source) == {"a", "d", "x", "y", "z", "g", "J", "m", "n", "o"}
    assert bound_names("def (") == set() and bound_names("from a import *") == {"*"}


@pytest.mark.parametrize(
    ("source", "reads"),
    [
        ("x = [w for w in words]", {"words"}),
        ("x = {w: k for w, k in pairs if w in known}", {"pairs", "known"}),
        ("x = {w for w in words}, w", {"words", "w"}),
        ("x = [[k * w for k in row] for row in [*{s for s in rows}]]", {"w", "rows"}),
        ("def f(a):\n    return [w + bias for w in a], {k: k for k in a}", {"bias"}),
        ("def f(a):\n    return [w for w in a], w", {"w"}),
        ("def f(a=[w for w in words]):\n    return (w for w in a)", {"words"}),
        ("class A:\n    names = [w for w in words]\n    f = lambda self: {w for w in self}", {"words"}),
        ("f = lambda a: [w for w in a if w > least]", {"least"}),
        ("for w in [w for w in words]:\n    print(w)", {"print", "words"}),
        ("for w in words:\n    count += w", {"words", "count"}),
        ("class A:\n    w = least\n    k = w", {"least"}),
    ],
)
def test_the_names_that_a_statement_reads_before_it_binds_them(source, reads):
    [statement] = top_level(source)
    assert names_of(statement).reads == reads
