"""The parts in which an answer is run."""

import pytest

from imgproc_course.classroom.exercises.cell_syntax import (
    parts_of,
    plain_python,
    program_lines,
    statements_of,
    without_endless,
)

FUTURE = "from __future__ import annotations"


def test_each_statement_is_a_part_in_which_its_lines_keep_their_numbers():
    assert parts_of("a = 1\n\n@b\ndef f():\n    pass\nc") == [
        "a = 1",
        "#\n#\n@b\ndef f():\n    pass",
        "#\n#\n#\n#\n#\nc",
    ]
    assert parts_of(f"# x\n{FUTURE}\na\nb") == [f"#\n{FUTURE}", f"#\n{FUTURE}\na", f"#\n{FUTURE}\n#\nb"]
    assert parts_of("a; b\nc") == ["a; b\nc"] and parts_of("a (\nb") == ["a (\nb"]


@pytest.mark.parametrize("start", ["", "from __future__ import (" + "annotations,\n" * 1_000 + ")\n"])
def test_an_answer_of_very_many_lines_is_one_part(start):
    """Its parts would have 400 MB together, outside the sandbox."""
    source = start + "1\n" * (2_000 if start else 20_000) + "def f():\n    return 3"
    assert parts_of(source) == [source]
    assert len(parts_of("1\n" * 2_000 + "def f():\n    return 3")) == 2_001


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
        ("x = [w := k for k in words], w", {"words", "w"}),
    ],
)
def test_the_variable_of_a_comprehension_is_no_name_that_a_statement_reads(source, reads):
    [statement] = statements_of(source)
    assert statement.reads == reads


SCRIPT = """class Gray(Node):
    def run(self):
        while rclpy.ok():
            rclpy.spin_once(self)

def main(args=None):
    rclpy.init(args=args)
    Gray().run()

"""


@pytest.mark.parametrize(
    ("lines", "named", "is_left_out"),
    [
        ("main()", "main()", True),
        ("import sys\nif __name__ == '__main__':\n    sys.exit(main())", "sys.exit(main())", True),
        ("try:\n    main()\nexcept KeyboardInterrupt:\n    pass", "main()", True),
        ("node = Gray()\nrclpy.spin(node)", "rclpy.spin(node)", True),
        ("executor.spin()", "executor.spin()", True),
        ("Gray().run()", "Gray().run()", True),
        ("while rclpy.ok():\n    rclpy.spin_once(Gray())", "while rclpy.ok():", True),
        ("while True:\n    print(3)", "while True:", True),
        ("rclpy.init()", "rclpy.init()", True),
        ("import matplotlib.pyplot as plt\nplt.show()", "plt.show()", False),
        ("size = int(input('size?'))", "size = int(input('size?'))", False),
        ("cv2.waitKeyEx(0)", "cv2.waitKeyEx(0)", False),
        (
            "while True:\n    cv2.imshow('a', b)\n    if cv2.waitKey(1) == 27:\n        break",
            "while True:",
            False,
        ),
        ("while True:\n    break", "", False),
        ("if __name__ == '__main__':\n    print(3)", "", False),
        ("def wait():\n    input()", "", False),
        ("TABLE = [3]; main()", "main()", False),
    ],
)
def test_lines_of_a_program_are_named_and_those_without_an_end_left_out(lines, named, is_left_out):
    source = SCRIPT + lines
    assert [code for _, code in program_lines(source)][:1] == [named] * bool(named)
    kept = without_endless(source)
    assert (kept != source) == is_left_out and kept.count("\n") == source.count("\n")
    assert kept.startswith(SCRIPT)
