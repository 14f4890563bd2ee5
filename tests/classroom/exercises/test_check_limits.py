"""`check` hurts nobody: neither by time and memory, nor by an error of its own."""

import json
import random
import resource
import runpy
from pathlib import Path

import numpy as np
import pytest
from nbclassroom.exercises import check, checking, judging, one_change
from nbclassroom.exercises.check_files import find_check_file
from nbclassroom.exercises.limited_fork import text_within
from nbclassroom.exercises.running import attempt
from readable_cell import run_cell

MONSTERS = runpy.run_path(Path(__file__).with_name("monsters.py"))["MONSTERS"]
ID = "grayscale-luma"


def luma_of(source):
    """The answer of a cell, whose source can be read."""
    names = {"np": np, "frame": np.zeros((720, 1280, 3), np.uint8)}
    return run_cell(source, names)["luma"]


def shown(source):
    result = check(ID, luma_of(source))
    assert not result.passed and result.attempted
    return repr(result) + result._repr_html_()


def peak():
    """The most memory that this process has had, bytes; pages that nobody has touched count too."""
    return int(Path("/proc/self/status").read_text().partition("VmPeak:")[2].split()[0]) * 1024


def burden_of(source):
    """[text, bytes over the answer itself in this process, bytes of the largest process that it started]"""
    luma, exercise = luma_of(source), find_check_file(ID).exercise(ID)
    for expected in exercise.cases[0].calls:
        attempt(lambda arguments=expected.arguments: luma(*arguments), None, exercise.time_limit)
    before, text = peak(), shown(source)
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return [text[:500], peak() - before, (resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss - own) << 10]


@pytest.mark.parametrize("name", MONSTERS)
def test_a_check_takes_little_more_than_the_answer_itself(name):
    text, *sizes = json.loads(text_within(lambda: json.dumps(burden_of(MONSTERS[name])), 100))
    assert text.startswith(f"{ID}: 0 of 3 checks pass.")
    assert max(sizes) < 200_000_000


VALUES = (
    *("bgr", "bgr[..., 0]", "wide", "total", "3735", "0", "-1.5", "2 ** 70", "None", "'b'", "[1, 2]", "np"),
    *("bgr.shape", "helper(bgr)", "(total, wide)", "frame", "np.uint8(250)", "lambda: 1", "{}", "b'ab'"),
)
FORMS = (
    *("{} + {}", "{} * {}", "{} @ {}", "{}[{}]", "{} > {}", "{} & {} > {}", "np.maximum({}, {})", "not {}"),
    *("{} if {} else {}", "np.zeros({})", "{}.astype({})", "[{} for k in {}]", "{}.sum(axis={})"),
    "{}[1:, {}]",
)
STATEMENTS = (
    *("wide = {}", "total = {}", "total += {}", "{}", "bgr[...] = {}", "print({})", "assert {}"),
    *("wide, b = {}", "for k in {}:", "if {}:", "while {}:", "with {} as f:", "try:"),
    "def helper(values={}):",
)
ENDS = ("return {}", "return {}.astype(np.uint8)", "yield {}", "raise ValueError({})", "return", "break")
ENDS += ("import cv2",)


def expression(draw, depth=2):
    form = draw.choice(FORMS) if depth and draw.random() < 0.6 else "({})"
    parts = [expression(draw, depth - 1) if depth else draw.choice(VALUES) for _ in range(form.count("{}"))]
    return form.format(*parts)


def block(draw, indent):
    lines = []
    for _ in range(draw.randint(1, 3)):
        statement = draw.choice(STATEMENTS)
        lines.append(indent + statement.format(expression(draw)))
        if statement.endswith(":") and len(indent) < 12:
            lines += block(draw, indent + "    ")
        elif statement.endswith(":"):
            lines.append(f"{indent}    pass")
        lines += [f"{indent}finally:", f"{indent}    pass"] * (statement == "try:")
    return [*lines, indent + draw.choice(ENDS).format(expression(draw))]


def answers(seed):
    """Wrong answers that Python can read."""
    draw = random.Random(seed)
    while True:
        helper = ["def helper(values):", *block(draw, "    ")] * draw.randint(0, 1)
        lines = ["def luma(bgr):", "    wide = total = bgr.astype(int)", *block(draw, "    ")]
        source = "\n".join([*helper, *lines])
        if attempt(lambda source=source: compile(source, "", "exec"), None):
            yield source


@pytest.mark.parametrize("seed", range(2))
def test_no_error_of_ours_leaves_the_check_of_a_generated_answer(seed, monkeypatch):
    monkeypatch.setattr(one_change, "_MOST_SECONDS", 0.05)
    monkeypatch.setattr(checking, "attempt", lambda compute, *_others, **_options: compute())
    for _, source in zip(range(100), answers(seed), strict=False):
        text = repr(check(ID, luma_of(source)))
        assert text.startswith(f"{ID}: "), source


def left_out(*_arguments, **_options):
    raise RuntimeError("ours")


@pytest.mark.parametrize("name", ["remarks_on_source", "diagnose", "_explanation", "sentence_on_change"])
def test_a_remark_that_cannot_be_computed_is_left_out(name, monkeypatch):
    monkeypatch.setattr(judging if name == "diagnose" else checking, name, left_out)
    text = shown("def luma(bgr):\n    return bgr[..., 0]")
    assert text.startswith(f"{ID}: 0 of 3 checks pass.")
    assert "expected: an array of shape (4, 5), uint8" in text
