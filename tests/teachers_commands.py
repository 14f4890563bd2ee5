"""What a teacher types: build, key, grade and the site. `.ci/run` runs this on the other Pythons.

The stored lessons and the points below were made on the reference Python, which has tests of its own.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "tests/benchmarks"))
from bench_grading import answers_of, write_submissions  # noqa: E402

COMMAND = str(Path(sys.executable).with_name("imgproc-course"))
BUILT = ("grayscale", "reading_text")
SEED = "5f0d2c6b8e914a37b1c8f2e6d3a09475"
pytestmark = pytest.mark.timeout(1500)
# Of twenty submissions, every second of which is right; the others have known mistakes and stubs.
POINTS = {
    "canny_stages": [4, 14, 2, 14, 2, 14, 0, 14, 0, 14, 3, 14, 0, 14, 0, 14, 1, 14, 2, 14],
    "reading_text": [3, *[6, 0] * 9, 6],
}


def run(*command):
    """What a command prints; it must succeed."""
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout


def test_lessons_equal_their_masters():
    assert "Lessons equal to their masters: 2." in run(COMMAND, "build", *BUILT, "--check")


@pytest.mark.sandbox
def test_submissions_get_their_points(tmp_path):
    run(COMMAND, "key", *POINTS, "--seed", SEED, "--out", tmp_path / "key")
    for lesson, points in POINTS.items():
        folder = tmp_path / lesson
        write_submissions(folder / "submissions", lesson, list(answers_of(lesson, len(points))))
        run(COMMAND, "grade", folder / "submissions", "--key", tmp_path / "key", "--out", folder / "grades")
        learners = json.loads((folder / "grades/grades.json").read_text("utf-8"))["learners"]
        assert [learner["points"] for learner in learners] == points
        findings = {finding["text"] for learner in learners for finding in learner["lessons"][0]["findings"]}
        assert [text.partition(",")[0] for text in findings] == ["it equals the course's solution"]


def test_the_site_is_built():
    assert "Open build/site/html/index.html" in run("environment/site")
    assert (ROOT / "build/site/html/lessons/16_reading_text.html").exists()
