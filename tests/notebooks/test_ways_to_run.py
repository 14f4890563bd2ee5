"""Two lessons in some ways to run them; tests/benchmarks/bench_ways_to_run.py runs every lesson so."""

import sys
from pathlib import Path

import nbformat
import pytest

sys.path.append(str(Path(__file__).parent))
from nbclassroom.authoring.lesson_files import without_outputs
from ways_to_run import tracebacks, ways_of

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"


@pytest.mark.parametrize(
    ("name", "way"), [("01_arrays", "visible+wrong+bare+twice"), ("02_what_is_image_processing", "begin")]
)
def test_a_lesson_shows_no_traceback(tmp_path, name, way):
    lesson = nbformat.reads(
        without_outputs((NOTEBOOKS / f"{name}.ipynb").read_bytes()).decode(), as_version=4
    )
    assert ways_of(lesson, way)
    assert tracebacks(lesson, way, tmp_path) == []
