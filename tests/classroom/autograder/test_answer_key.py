"""A key contains what the autograder needs, and nothing that reveals its seed."""

import contextlib
import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from nbclassroom.autograder import make_answer_key
from nbclassroom.autograder.answer_key import KeyFolderError, load_key
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.exercises import MasterError, array_of

pytestmark = pytest.mark.sandbox
MASTERS = Path(__file__).parent / "masters"
SEED = 8_675_309


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_text() for path in sorted(folder.rglob("*.*"))}


@pytest.fixture(scope="module", autouse=True)
def one_fork_server():
    """All keys of this module are made with one fork server, which takes a second to start."""
    with KernelFactory() as shared, pytest.MonkeyPatch.context() as patch:
        patch.setattr(make_answer_key, "KernelFactory", lambda unsafe: contextlib.nullcontext(shared))
        patch.setattr(make_answer_key, "_AT_A_TIME", 1)
        yield


@pytest.fixture
def copy(key, tmp_path):
    return Path(shutil.copytree(key.path, tmp_path / "copy"))


def test_it_contains_exercises_cases_and_mistakes(key):
    lesson = key.lessons["attacked"]
    assert (lesson.title, lesson.number, lesson.points) == ("Attacked", "10", 10)
    double, mean, apply = lesson.exercises
    assert double.allowed == ()
    assert double.names == ("pixels",)
    assert [(c.id, c.points, c.hidden, len(c.calls)) for c in double.cases] == [
        ("case-attacked-double-1", 1, False, 1),
        ("hidden-attacked-double-1", 2, True, 2),
    ]
    assert double.cases[1].hint == "What does 200 become?"
    assert [case.tolerance for case in mean.cases] == [0.01, 0.01]
    assert [mistake.name for mistake in double.mistakes] == ["uint8 wraps", "half"]
    assert apply.practice and apply.cases == () and apply.points == 0


def test_its_expected_values_are_the_solutions(key):
    (call,) = key.exercise("attacked-double").cases[0].calls
    (pixels,) = call.arguments
    assert pixels.min() >= 100
    twice = np.minimum(pixels.astype(int) * 2, 255).astype(np.uint8)
    assert array_of(call.result.value).tolist() == twice.tolist()


def test_the_seed_is_in_no_file(key):
    assert not [name for name, text in files(key.path).items() if str(SEED) in text or "seed" in text]


def test_its_solutions_are_in_files_of_their_own(key):
    texts = files(key.path)
    assert [*texts] == ["checks/attacked.json", "solutions/attacked.json"]
    assert "np.minimum(pixels.astype(" not in texts["checks/attacked.json"]
    assert "np.minimum(pixels.astype(" in key.solutions("attacked")["attacked-double"]


def test_the_same_seed_gives_the_same_key_and_another_another(key, tmp_path):
    again = make_key(MASTERS, SEED, tmp_path / "again")
    other = make_key(MASTERS, "another", tmp_path / "other")
    assert files(again.path) == files(key.path)
    assert again.digest == key.digest != other.digest


def test_a_key_is_overwritten_only_with_replace(copy):
    with pytest.raises(KeyFolderError, match="it exists already"):
        make_key(MASTERS, 1, copy)
    before = load_key(copy).digest
    assert make_key(MASTERS, 1, copy, replace=True).digest != before
    assert [path.name for path in copy.parent.iterdir()] == ["copy"]


def test_a_second_run_goes_on_where_the_first_one_stopped(tmp_path, monkeypatch):
    """Of three exercises the last one is interrupted; the same seed gives the key of one run."""
    run, said = make_answer_key.with_results, []

    def interrupted(exercise, *arguments):
        if exercise.id == "attacked-apply":
            raise KeyboardInterrupt
        return run(exercise, *arguments)

    whole = make_key(MASTERS, SEED, tmp_path / "whole", say=said.append)
    out = tmp_path / "key"
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(make_answer_key, "with_results", interrupted)
        make_key(MASTERS, SEED, out, say=said.append)
    assert not out.exists()
    key = make_key(MASTERS, SEED, out, say=said.append)
    assert files(key.path) == files(whole.path)
    assert [text.split(" exercises")[0] for text in said] == ["3 of 3", "3 of 3", "1 of 3"]
    assert "about 1 min on two quiet cores" in said[0]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["key", "whole"]


def test_a_killed_process_is_one_line_with_the_remedy(tmp_path, monkeypatch):
    monkeypatch.setattr(make_answer_key, "with_results", lambda *_: os.kill(os.getpid(), 9))
    with pytest.raises(MasterError, match="a process was killed"):
        make_key(MASTERS, SEED, tmp_path / "key")


def test_a_failure_leaves_the_old_key(copy, tmp_path):
    masters = tmp_path / "masters"
    masters.mkdir()
    text = (MASTERS / "10_attacked.py").read_text()
    (masters / "10_attacked.py").write_text(text.replace("return float(np.mean(values))", "return unknown"))
    before = files(copy)
    with pytest.raises(MasterError, match=r"10_attacked.py, case-attacked-mean-1: the solution .*unknown"):
        make_key(masters, 1, copy, replace=True)
    assert files(copy) == before


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'function="apply",\n    practice=True,',
            'function="apply",',
            "case-attacked-apply-1.*cannot be sent.*practice=True",
        ),
        ("return float(np.mean(values))", "return object()", "nothing that can be compared"),
        ("return float(np.mean(values))", "return values.pop()", "fails. .* changed its input"),
        ("return float(np.mean(values))", "import os; os._exit(1)", "crashed"),
        ("return float(np.mean(values))", "return [].index(3)", " raised ValueError: 3 is not in list"),
        ("return float(np.mean(values))", "while True: pass", "fails. .* did not finish in time"),
    ],
)
def test_a_master_that_cannot_be_graded_is_refused(tmp_path, old, new, message):
    text = (MASTERS / "10_attacked.py").read_text()
    assert old in text
    (tmp_path / "10_attacked.py").write_text(text.replace(old, new))
    with pytest.raises(MasterError, match=message):
        make_key(tmp_path, 1, tmp_path / "key")


def test_a_folder_without_a_readable_key_is_reported(tmp_path, copy):
    with pytest.raises(KeyFolderError, match="there is no key; make one: imgproc-course key --out nowhere"):
        load_key(tmp_path / "nowhere")
    path = copy / "checks" / "attacked.json"
    path.write_text("{")
    with pytest.raises(KeyFolderError, match=r"checks/attacked.json cannot be read .*; make the key again$"):
        load_key(copy)


def change(path, edit):
    data = json.loads(path.read_text())
    edit(data["exercises"]["attacked-mean"]["cases"])
    path.write_text(json.dumps(data))


def test_checks_that_learners_have_are_no_key(copy):
    """Without the hidden cases, or with a source of inputs, which reading would run."""
    path = copy / "checks" / "attacked.json"
    text = path.read_text()
    for edit in (lambda cases: cases.pop(), lambda cases: cases[0].update(inputs="1 / 0")):
        path.write_text(text)
        change(path, edit)
        with pytest.raises(KeyFolderError, match="these are checks as learners have them; make a key: imgp"):
            load_key(copy)


def test_an_altered_key_is_another_key(copy):
    before = load_key(copy).digest
    change(copy / "checks" / "attacked.json", lambda cases: cases[0].update(tolerance=1.0))
    assert load_key(copy).digest != before
