"""Short cases of each way to run a lesson; tests/benchmarks/bench_ways_to_run.py runs every lesson so."""

import sys
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

sys.path.append(str(Path(__file__).parent))
from ways_to_run import tracebacks, ways_of

from imgproc_course.classroom.authoring.learner_files import without_outputs

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"


def code(id, source, **metadata):
    return new_code_cell(source, id=id, metadata=metadata)


FOLDED = {"jupyter": {"source_hidden": True}}
FAILED = "AssertionError: "
# A lesson in which each way but `all` fails.
LESSON = new_notebook(
    cells=[
        new_markdown_cell("# Sums"),
        code("sums-2", "from ipywidgets import IntSlider\nfrom imgproc_course.exercises import check"),
        new_markdown_cell("## 1 · A number"),
        code("sums-4", "# Check: the number\nnumber = globals().get('number', 0) + 1", **FOLDED),
        code("sums-5", "assert number == 1"),
        code("predict-sums-1", "guess = None  # your guess: yes or no?"),
        code("sums-7", "assert guess != 'yes'"),
        code("sums-8", "slider = IntSlider(3)"),
        code("sums-9", "assert slider.value == 3"),
        code("sums-10", "1 / 0", tags=["raises-exception"]),
        code("answer-sums-double", "def double(x):\n    raise NotImplementedError('your turn')"),
        code("sums-12", "try:\n    assert double(1)\nexcept NotImplementedError:\n    pass"),
        new_markdown_cell("**You can begin here.**"),
        code("sums-14", "print(slider.value)"),
        code("check-sums-double-1", "assert 'number' in globals()"),
    ]
)  # fmt: skip


@pytest.mark.parametrize(
    ("way", "cells"),
    [
        ("visible", "2 5 7 8 9 10 double 12 14 double-1"),
        ("begin", "2 14 double-1"),
        ("exercises", "2 double double-1"),
        ("begin+visible+twice", "2 14 double-1 2 14 double-1"),
    ],
)
def test_a_way_has_its_cells(way, cells):
    (parts,) = ways_of(LESSON, way)
    ids = [cell.id.split("sums-")[1] for cell in parts if not cell.id.startswith("predict")]
    assert ids == cells.split()


@pytest.mark.parametrize(
    ("way", "found"),
    [
        ("all", []),
        ("visible", [("sums-5", "NameError: name 'number' is not defined"), ("check-sums-double-1", FAILED)]),
        ("wrong+bare+sliders", [("sums-7", FAILED), ("sums-9", FAILED), ("sums-12", FAILED)]),
        ("failing", [("sums-12", "ZeroDivisionError: wrong")]),
        ("twice", [("sums-5", FAILED)]),
    ],
)
def test_what_fails_in_a_way_is_found(tmp_path, way, found):
    assert tracebacks(LESSON, way, tmp_path) == found


@pytest.mark.parametrize(
    ("name", "way"), [("01_arrays", "visible+wrong+bare+twice"), ("02_what_is_image_processing", "begin")]
)
def test_a_lesson_shows_no_traceback(tmp_path, name, way):
    lesson = nbformat.reads(
        without_outputs((NOTEBOOKS / f"{name}.ipynb").read_bytes()).decode(), as_version=4
    )
    assert ways_of(lesson, way)
    assert tracebacks(lesson, way, tmp_path) == []
