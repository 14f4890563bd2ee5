"""The soak benchmark, for some seconds: it finds nothing in a good graph."""

import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.ros

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


def test_a_short_soak_finds_no_loss_and_no_growth(start):
    process = start(
        sys.executable, BENCHMARKS / "bench_soak.py", MINUTES="0.08", SPEED="0.5", WARM_UP="2", COLUMNS="110"
    )
    assert process.wait(120) == 0, process.output
    assert process.output.splitlines()[-1] == "no loss, no growth"
    rows = {line.split("│")[1].strip(): line for line in process.output.splitlines() if line.startswith("│")}
    assert list(rows) == ["camera", "image_gray_processor", "image_edge_detection", "notebook"]
    for node in ("image_gray_processor", "image_edge_detection"):
        frames, lost, failed = (int(cell) for cell in rows[node].split("│")[2:5])
        assert frames > 0 and (lost, failed) == (0, 0)
