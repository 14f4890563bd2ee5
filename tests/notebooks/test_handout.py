"""What learners get holds no solution and no hidden case: every file is opened, also in the zip file."""

from pathlib import Path

import pytest
from all_masters import PATHS, all_masters
from handed_out import HandedOut
from nbclassroom.authoring.handout import hand_out

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
TAUGHT = "node-class"  # its solution is the beginning of a later exercise


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handout") / "handout"
    _, archive = hand_out(folder, NOTEBOOKS, zipped=True)
    return HandedOut([*folder.rglob("*"), archive])


@pytest.mark.parametrize("lesson", [path.stem[3:] for path in PATHS])
def test_no_file_holds_a_solution_or_a_hidden_case(handed_out, lesson):
    for exercise in all_masters()[lesson].exercises:
        assert bool(list(handed_out.leaks(exercise))) == (exercise.id == TAUGHT)


def test_every_file_was_opened(handed_out):
    names = {Path(name).name for name in handed_out.files}
    assert {path.name for path in NOTEBOOKS.glob("*.ipynb")} <= names
    assert {path.name for path in (NOTEBOOKS / "checks").glob("*.json")} <= names
    assert "baseline.py" in names  # a lesson names it
    zipped = [name for name in handed_out.files if ".zip/" in name]
    assert 2 * len(zipped) == len(handed_out.files) > 2 * len(PATHS)
