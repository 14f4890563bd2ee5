"""Progress is kept in a learner's folder only, and survives what can happen to its file."""

import json
import os
import subprocess
import sys

import pytest
from nbclassroom.exercises import CheckFileError, check, progress
from nbclassroom.exercises.progress import (
    PROGRESS,
    ExerciseProgress,
    digest_of,
    note_progress,
    progress_of,
    read_progress,
)
from readable_cell import run_cell


@pytest.fixture
def learner(tmp_path, monkeypatch):
    """A learner's folder as the current one, in a process that looks like a notebook's kernel."""
    (tmp_path / ".course.json").write_text("{}")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("JPY_SESSION_NAME", str(tmp_path / "04_grayscale.ipynb"))
    monkeypatch.setattr(progress, "TEST_VARIABLE", "NOT_SET_BY_PYTEST")
    monkeypatch.setattr(progress, "_of_this_process", {})
    return tmp_path


ONE = ExerciseProgress(True, ("aa", "bb"), 2)


def test_progress_survives_the_process(learner, monkeypatch):
    note_progress("a-one", ExerciseProgress(tries=("aa",)))
    note_progress("a-one", ExerciseProgress(tries=("bb",), hints=2))
    note_progress("a-two", ExerciseProgress(hints=1))
    note_progress("a-one", ExerciseProgress(passed=True, hints=1))
    monkeypatch.setattr(progress, "_of_this_process", {})
    assert progress_of("a-one") == ONE
    assert read_progress(learner) == {"a-one": ONE, "a-two": ExerciseProgress(hints=1)}
    assert sorted(path.name for path in learner.iterdir()) == [
        ".course.json",
        ".progress.json",
        ".progress.lock",
    ]


@pytest.mark.parametrize("missing", ["JPY_SESSION_NAME", "marker", "not pytest"])
def test_nothing_is_written_elsewhere(learner, monkeypatch, missing):
    if missing == "marker":
        (learner / ".course.json").unlink()
    elif missing == "not pytest":
        monkeypatch.setattr(progress, "TEST_VARIABLE", "PYTEST_CURRENT_TEST")
    else:
        monkeypatch.delenv(missing)
    note_progress("a-one", ONE)
    assert progress_of("a-one") == ONE  # as long as the process
    assert not (learner / PROGRESS).exists()


@pytest.mark.parametrize(
    "content", [b"", b"{", b"\xff\xfe", b"[]", b'{"format": 2}', b'{"format": 1, "exercises": {"a-one": 3}}']
)
def test_a_damaged_file_is_moved_aside_and_named(learner, capsys, content):
    (learner / PROGRESS).write_bytes(content)
    assert progress_of("a-one") == ExerciseProgress()
    note_progress("a-one", ONE)
    assert read_progress(learner) == {"a-one": ONE}
    assert (learner / ".progress.damaged-1.json").read_bytes() == content
    assert capsys.readouterr().out == (
        "Your progress in .progress.json could not be read: it begins anew."
        " The old file is .progress.damaged-1.json.\n"
    )
    (learner / PROGRESS).write_bytes(content)
    note_progress("a-two", ONE)
    assert (learner / ".progress.damaged-2.json").read_bytes() == content


def test_a_folder_that_cannot_be_written_costs_only_the_file(learner, monkeypatch):
    def refuse(*_arguments):
        raise PermissionError("read-only")

    monkeypatch.setattr(progress, "one_at_a_time", refuse)
    note_progress("a-one", ExerciseProgress(tries=("aa",)))
    note_progress("a-one", ExerciseProgress(tries=("bb",)))
    assert progress_of("a-one").tries == ("aa", "bb")
    assert not (learner / PROGRESS).exists()


NOTING = """
import sys
from nbclassroom.exercises.progress import ExerciseProgress, note_progress
for number in range(100):
    note_progress(f"a-{sys.argv[1]}{number}", ExerciseProgress(hints=1))
"""


def test_two_notebooks_lose_nothing_of_each_other(learner):
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
    processes = [
        subprocess.Popen([sys.executable, "-c", NOTING, name], cwd=learner, env=environment) for name in "xy"
    ]
    assert [process.wait(60) for process in processes] == [0, 0]
    assert set(read_progress(learner)) == {f"a-{name}{number}" for name in "xy" for number in range(100)}
    assert not list(learner.glob("*.tmp"))


def test_unchanged_progress_is_not_written_again(learner):
    note_progress("a-one", ONE)
    before = (learner / PROGRESS).stat().st_ino
    note_progress("a-one", ExerciseProgress(passed=True, hints=1))
    assert (learner / PROGRESS).stat().st_ino == before
    assert json.loads((learner / PROGRESS).read_text())["format"] == 1


def test_a_digest_tells_answers_apart():
    def plus(a, b):
        return a + b

    def minus(a, b):
        return a - b

    def nested(a, b):
        return [x + a for x in b]

    def nested_otherwise(a, b):
        return [x - a for x in b]

    functions = [plus, minus, nested, nested_otherwise, len]
    assert len({digest_of(function) for function in functions}) == 5
    assert digest_of(plus) == digest_of(plus)


def test_a_digest_does_not_depend_on_lines():
    values = ("a - b", "(a -  # on two lines\n        b)")
    functions = (run_cell(f"def f(a, b):\n    return {value}\n")["f"] for value in values)
    assert len(set(map(digest_of, functions))) == 1


def test_check_of_a_tried_exercise_that_the_course_no_longer_has_is_a_sentence(learner):
    with pytest.raises(CheckFileError, match="there is no exercise 'gone-one'"):
        check("gone-one", len)
    note_progress("gone-one", ExerciseProgress(passed=True))
    assert repr(check("gone-one", len)) == (
        "gone-one is no longer in the course. Your answer and your progress are kept."
    )
