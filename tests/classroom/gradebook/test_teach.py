"""The README's "How to teach with it", run as written, on thirty generated submissions."""

import json
import os
import re
import subprocess
import sys
from datetime import datetime
from pathlib import Path

import pytest
from submissions import answers_of, notebook, thirty, write

from imgproc_course.classroom.authoring.masters import find_masters, read_master

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("answer_key")]
CHECKOUT = Path(__file__).resolve().parents[3]


def commands():
    text = (CHECKOUT / "README.md").read_text(encoding="utf-8")
    _, found, section = text.partition("\n## How to teach with it\n")
    assert found, 'README.md has no section "## How to teach with it"'
    block = re.search(r"```sh\n(.*?)```", section.partition("\n## ")[0], re.S)
    return [line for line in block[1].splitlines() if line.strip()]


def run(line, folder):
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    return subprocess.run(
        ["bash", "-c", line],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=900,  # `key` drives the robot for minutes, on a busy machine
    )


def grades_in(folder):
    grades = json.loads((folder / "grades" / "grades.json").read_text(encoding="utf-8"))
    return {learner["name"]: learner for learner in grades["learners"]}


@pytest.mark.timeout(1800)
def test_a_term_in_ten_commands(tmp_path):
    lines = commands()
    assert len(lines) == 10
    masters = [read_master(path) for path in find_masters(CHECKOUT / "notebooks" / "masters")]
    masters = [each for each in masters if any(not exercise.practice for exercise in each.exercises)]
    has_mistakes = {exercise.id for each in masters for exercise in each.exercises if exercise.mistakes}
    submitted, graded = [], 0
    for line in lines:
        if "imgproc-course grade" in line and graded == 0:
            submitted = thirty(tmp_path / "submissions", masters)
        elif "imgproc-course grade" in line:
            own = read_master(next((tmp_path / "my_masters").glob("*.py")))
            made = notebook(own, answers_of(own, "right"))
            write(tmp_path / "submissions" / "own" / "x.ipynb", made, datetime(2026, 12, 2))
        ended = run(line, tmp_path)
        if "imgproc-course grade" not in line:
            assert ended.returncode == 0, f"{line}\n{ended.stdout}\n{ended.stderr}"
            continue
        assert ended.returncode == 3, ended.stderr  # some of the thirty are broken
        graded += 1
        learners = grades_in(tmp_path)
        for learner, lesson, kind in submitted:
            (of,) = learners[learner]["lessons"]
            assert of["lesson"] == lesson
            assert of["status"] == ("not graded" if kind == "broken" else "graded")
            if kind == "right":
                assert of["points"] == of["max_points"] > 0, learner
            elif kind in ("untouched", "raising", "broken"):
                assert of["points"] == 0, learner
            else:
                assert of["points"] < of["max_points"], learner
                assert all(each["mistake"] for each in of["exercises"] if each["id"] in has_mistakes), learner
    assert graded == 2
    assert grades_in(tmp_path)["own"]["points"] == 3
    pages = list((tmp_path / "grades" / "learners").iterdir())
    assert len(pages) == 31 and (tmp_path / "feedback.zip").stat().st_size > 10_000
    handed_out = sorted(path.stem for path in (tmp_path / "handout").glob("[0-9]*.ipynb"))
    assert handed_out == [path.stem for path in find_masters(CHECKOUT / "notebooks" / "masters")]
    assert (tmp_path / "handout" / "checks" / "grayscale.json").is_file()
    assert not (tmp_path / "handout" / "solutions").exists()
    assert (tmp_path / "handout.zip").is_file() and (tmp_path / "handout_mine.zip").is_file()
