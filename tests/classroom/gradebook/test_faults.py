"""A fault of the autograder is reported to the teacher, never stored, and costs nobody else a point."""

import json
import shutil
import tempfile

import pytest
from click.testing import CliRunner
from nbclassroom.gradebook.result_store import open_grades_folder
from submissions import answers_of, notebook, write

from imgproc_course.cli import main

pytestmark = pytest.mark.sandbox


@pytest.fixture
def faulty_key(key_path, tmp_path):
    """A key in which an expected value lacks its items: comparing with it raises a KeyError."""
    folder = tmp_path / "key"
    shutil.copytree(key_path, folder)
    path = folder / "checks" / "light.json"
    file = json.loads(path.read_text())
    for case in file["exercises"]["light-halves"]["cases"]:
        for name in case["expected"]:
            file["values"][name].pop("items", None)
    path.write_text(json.dumps(file))
    return folder


def test_an_exception_of_ours_is_not_graded_not_stored_and_reported(light, faulty_key, submissions, tmp_path):
    write(submissions / "ada" / "light.ipynb", notebook(light, answers_of(light, "right")))
    out = tmp_path / "grades"
    command = ["grade", str(submissions), "--key", str(faulty_key), "--out", str(out), "--workers", "1"]
    for _ in range(2):  # what is not stored is graded again
        done = CliRunner().invoke(main, command)
        assert done.exit_code == 3
        assert "(1 in this run)" in done.output
        assert "light-halves: the autograder failed: KeyError: 'items'; run the command again" in done.output
    ((lesson,),) = [
        learner["lessons"] for learner in json.loads((out / "grades.json").read_text())["learners"]
    ]
    outcomes = {
        exercise["id"]: {case["outcome"] for case in exercise["cases"]} for exercise in lesson["exercises"]
    }
    assert outcomes.pop("light-halves") == {"not graded"}
    assert set().union(*outcomes.values()) == {"passed"}
    hidden = [
        case["message"]
        for exercise in lesson["exercises"]
        for case in exercise["cases"]
        if case["hidden"] and case["outcome"] == "not graded"
    ]
    assert set(hidden) == {"the autograder failed: KeyError"}
    assert [path.name for path in (out / "results").iterdir() if "page" not in path.name] == []
    assert "could not be graded" in (out / "summary.html").read_text()


def test_a_full_disk_is_one_line(light, key_path, submissions, tmp_path, monkeypatch):
    def full(**_options):
        raise OSError(28, "No space left on device")

    write(submissions / "ada" / "light.ipynb", notebook(light))
    monkeypatch.setattr(tempfile, "TemporaryFile", full)
    command = ["grade", str(submissions), "--key", str(key_path), "--out", str(tmp_path / "grades")]
    done = CliRunner().invoke(main, command)
    error = "Error: grade stopped: [Errno 28] No space left on device"
    assert (done.exit_code, done.output.splitlines()[-1]) == (1, error)


def test_two_runs_do_not_write_into_one_folder(tmp_path):
    refusal = pytest.raises(ValueError, match="grades: another run is writing into it; wait for its end")
    with open_grades_folder(tmp_path / "grades"), refusal:
        open_grades_folder(tmp_path / "grades").__enter__()
    with open_grades_folder(tmp_path / "grades"):
        pass
