"""The instructor's commands: what they print, what they refuse, and their exit codes."""

import json
import os
import shutil
import subprocess
import sys
from datetime import datetime

import pytest
from click.testing import CliRunner
from nbclassroom.authoring.masters import new_lesson, read_master
from nbclassroom.autograder import make_answer_key, pool
from nbclassroom.autograder.answer_key import load_key
from nbclassroom.exercises.declaration import MasterError
from nbclassroom.gradebook import grade
from nbclassroom.gradebook.teacher_tables import local_time_of
from submissions import MASTERS, answers_of, notebook, write

from imgproc_course.cli import main

pytestmark = pytest.mark.sandbox


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))

    def run(*words):
        return CliRunner().invoke(main, [str(word) for word in words])

    return run


def test_without_workers_there_is_one_for_two_cores(run, tmp_path, key_path, monkeypatch):
    write(tmp_path / "in" / "ada.ipynb", notebook(read_master(MASTERS / "21_sound.py"), {}))
    asked, grade_submissions = [], grade.grade_submissions

    def with_its_workers_noted(*arguments, workers, **options):
        asked.append(workers)
        return grade_submissions(*arguments, workers=1, **options)

    monkeypatch.setattr(grade, "grade_submissions", with_its_workers_noted)
    open_shared = pool.open_worker_threads
    monkeypatch.setattr(pool, "open_worker_threads", lambda *_, **_options: open_shared(1))
    monkeypatch.setattr(os, "cpu_count", lambda: 5)
    assert run("grade", "in", "--key", key_path).exit_code == 0
    assert run("grade", "in", "--key", key_path, "--workers", 2).exit_code == 0
    assert asked == [3, 2]


def test_a_key_without_a_seed_keeps_one_and_makes_the_same_key_again(run, tmp_path):
    made = run("key", "21", "--masters", MASTERS, "--out", "k")
    assert made.exit_code == 0, made.output
    assert "Key in k/: lessons 1, exercises with points 1." in made.output and "k.seed" in made.output
    seed = (tmp_path / "k.seed").read_text().strip()
    assert len(seed) == 32 and (tmp_path / "k.seed").stat().st_mode & 0o777 == 0o600
    first = load_key(tmp_path / "k").digest
    refused = run("key", "21", "--masters", MASTERS, "--out", "k")
    assert refused.exit_code == 1 and "it exists already" in refused.output
    assert load_key(tmp_path / "k").digest == first
    assert run("key", "21", "--masters", MASTERS, "--out", "k", "--replace").exit_code == 0
    assert load_key(tmp_path / "k").digest == first
    other = run(
        "key",
        "21",
        "--masters",
        MASTERS,
        "--out",
        "k",
        "--replace",
        "--seed",
        "5eed" + "c09a41f7d263b8e05f1a97c4d3806be2",
    )
    assert "Its seed is not saved" in other.output
    assert load_key(tmp_path / "k").digest != first
    cells = load_key(tmp_path / "k").lessons["sound"].cells
    assert cells["check-sound-mean-1"] == 'check("sound-mean", mean)'
    assert cells["answer-sound-mean"] is None


def test_a_seed_that_can_be_guessed_is_refused(run, tmp_path):
    for seed in ("1", "2026", "correct horse battery staple", "31415926535897932384626433832795"):
        refused = run("key", "21", "--masters", MASTERS, "--out", "k", "--seed", seed)
        assert refused.exit_code == 1 and "can be guessed" in refused.output
    (tmp_path / "k.seed").write_text("12345")
    refused = run("key", "21", "--masters", MASTERS, "--out", "k")
    assert refused.exit_code == 1 and "can be guessed" in refused.output
    assert not (tmp_path / "k").exists()


def test_a_key_in_a_checkout_that_does_not_ignore_it_is_a_warning(run, tmp_path):
    subprocess.run(["git", "init", "-q", "."], cwd=tmp_path, check=True)
    words = ("key", "21", "--masters", MASTERS, "--out", "k", "--replace")
    warned = run(*words).output
    assert "Warning: k is in a git checkout and git does not ignore it" in warned
    assert "k.seed is in a git" in warned
    (tmp_path / ".gitignore").write_text("/k/\n/k.seed\n")
    assert "Warning" not in run(*words).output


QUIET = """# ---
# jupyter:
#   imgproc_course:
#     title: Quiet
# ---

# %% [markdown]
# # Quiet
# A lesson without exercises.
"""


def test_lessons_without_points_are_named(run, tmp_path):
    (tmp_path / "mine").mkdir()
    for name in ("22_quiet", "23_silent"):
        (tmp_path / "mine" / f"{name}.py").write_text(QUIET)
    shutil.copy(MASTERS / "21_sound.py", tmp_path / "mine")
    made = run("key", "--masters", "mine", "--out", "k")
    assert made.exit_code == 0, made.output
    assert "Key in k/: lessons 3, exercises with points 1.\nLessons without points: quiet, silent.\n" in (
        made.output
    )
    assert "without points" not in run("key", "21", "--masters", "mine", "--out", "k2").output


def test_a_folder_without_masters_is_refused(run, tmp_path):
    wrong = run("key", "--masters", tmp_path, "--out", "k")
    assert wrong.exit_code == 1 and "no masters in" in wrong.output


# ---------------------------------------------------------------- grade


def test_exit_codes(run, light, key_path, tmp_path):
    write(tmp_path / "in" / "ada.ipynb", notebook(light, answers_of(light, "right")))
    good = run("grade", "in", "--key", key_path, "--out", "out")
    assert good.exit_code == 0, good.output
    assert "1 learner, 1 lesson graded (1 in this run), 0 late, 0 could not be graded." in good.output
    write(tmp_path / "in" / "bob.ipynb", b"{")
    some = run(
        "grade", "in", "--key", key_path, "--out", "out", "--deadline", "2026-11-01T00:00", "--workers", 1
    )
    assert some.exit_code == 3
    assert (
        "bob: bob.ipynb: it is not a notebook" in some.output
        and "or were graded before), 2 late" in some.output
    )


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (("grade", "nowhere", "--key", "KEY"), 1, "nowhere: does not exist"),
        (("grade", "in", "--key", "nokey"), 1, "there is no key; make one: imgproc-course key"),
        (("grade", "in", "--key", "KEY", "--out", "in/grades"), 1, "name a folder outside it"),
        (("grade", "in", "--key", "KEY", "--deadline", "tomorrow"), 2, "2026-12-01T23:59"),
        (("grade", "in", "--key", "KEY", "--workers", "0"), 2, "0 is not in the range"),
    ],
)
def test_an_error_is_one_line(run, light, key_path, tmp_path, words, code, message):
    write(tmp_path / "in" / "ada.ipynb", notebook(light))
    ended = run(*(key_path if word == "KEY" else word for word in words))
    assert ended.exit_code == code and message in ended.output
    assert code == 2 or len(ended.output.strip().splitlines()) == 1


def test_the_table_of_a_platform_is_filled(run, light, key_path, tmp_path):
    write(tmp_path / "submissions" / "ada_7_100_20_light.ipynb", notebook(light, answers_of(light, "right")))
    table = tmp_path / "gradebook.csv"
    table.write_text("Student,ID,Section,20_light (1)\nAda,7,A,\n", encoding="utf-8")
    done = run("grade", "submissions", "--key", key_path, "--workers", 1, "--platform-table", table)
    assert done.exit_code == 0 and "gradebook.csv: 1 points filled in." in done.output
    filled = (tmp_path / "grades" / "exports" / "filled-gradebook.csv").read_text(encoding="utf-8")
    assert filled.splitlines() == ["Student,ID,Section,20_light (1)", "Ada,7,A,6"]
    missing = run("grade", "submissions", "--key", key_path, "--platform-table", "none.csv")
    assert missing.exit_code == 1 and "Error: none.csv: it cannot be read" in missing.output


def test_what_draws_pages_is_loaded_while_the_autograder_starts():
    code = "import sys; import nbclassroom.gradebook.grade;"
    code += " print({'jinja2', 'PIL'} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("set()\n", "")


def test_without_bubblewrap_grading_needs_unsafe(light, key_path, tmp_path):
    write(tmp_path / "in" / "ada.ipynb", notebook(light, answers_of(light, "right")))
    environment = os.environ | {"PATH": str(tmp_path)}
    words = [sys.executable, "-c", "from imgproc_course.cli import main; main()"]
    words += ["grade", "in", "--key", str(key_path)]
    refused = subprocess.run(
        words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert refused.returncode == 1 and len(refused.stderr.splitlines()) == 1
    assert "bubblewrap is not installed" in refused.stderr and "--unsafe" in refused.stderr
    assert not (tmp_path / "grades").exists()
    unsafe = subprocess.run(
        [*words, "--unsafe"], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert unsafe.returncode == 0, unsafe.stderr
    assert "without a sandbox" in unsafe.stdout
    grades = json.loads((tmp_path / "grades" / "grades.json").read_text())
    assert grades["sandbox"] is False and grades["learners"][0]["points"] == 6


def test_ctrl_c_says_how_to_continue(run, light, key_path, tmp_path, monkeypatch):
    write(tmp_path / "in" / "ada.ipynb", notebook(light))

    def interrupted(*_words, **_options):
        raise KeyboardInterrupt

    monkeypatch.setattr(grade, "grade_missing", interrupted)
    ended = run("grade", "in", "--key", key_path)
    assert ended.exit_code == 130 and "run the same command again to continue" in ended.output


def test_ctrl_c_of_the_key_says_how_to_continue(run, monkeypatch):
    def interrupted(*_words, **_options):
        raise KeyboardInterrupt

    monkeypatch.setattr(make_answer_key, "make_key", interrupted)
    ended = run("key", "--masters", MASTERS)
    text = "Stopped. Finished exercises are kept: run the same command again to continue."
    assert ended.exit_code == 130 and text in ended.output


def test_a_scheduler_is_found_by_its_address(run, light, key_path, tmp_path, monkeypatch):
    write(tmp_path / "in" / "ada.ipynb", notebook(light))
    asked = []

    def no_scheduler(address):
        asked.append(address)
        raise ValueError("no Dask scheduler answers at tcp://127.0.0.1:9")

    monkeypatch.setattr(grade, "open_scheduler", no_scheduler)
    ended = run("grade", "in", "--key", key_path, "--scheduler", "tcp://127.0.0.1:9")
    assert asked == ["tcp://127.0.0.1:9"]
    assert ended.exit_code == 1 and "no Dask scheduler answers" in ended.output


def test_a_deadline_without_a_time_is_the_end_of_the_day():
    assert local_time_of("2026-12-01") == datetime(2026, 12, 1, 23, 59, 59)


def test_a_deadline_with_a_zone_is_in_local_time():
    moment = local_time_of("2026-12-01T23:59+00:00")
    assert moment.tzinfo is None
    assert moment.astimezone().utctimetuple()[:5] == (2026, 12, 1, 23, 59)


# ---------------------------------------------------------------- a new lesson


def test_a_new_lesson_is_a_master_that_reads(tmp_path):
    path = new_lesson("Brightness & contrast", tmp_path / "mine")
    assert path.name == "30_brightness_contrast.py"
    master = read_master(path)
    assert (master.title, [each.id for each in master.exercises]) == (
        "Brightness contrast",
        ["brightness-contrast-double"],
    )
    assert new_lesson("other", tmp_path / "mine").name == "31_other.py"
    assert new_lesson("42_third", tmp_path / "mine").name == "42_third.py"


@pytest.mark.parametrize("name", ["42_light", "light", "07_Light"])
def test_a_new_lesson_with_the_name_of_another_is_refused_and_overwrites_nothing(run, tmp_path, name):
    assert run("new-lesson", "42_light", "--out", "mine").exit_code == 0
    (tmp_path / "mine" / "42_light.py").write_text("changed")
    again = run("new-lesson", name, "--out", "mine")
    refusal = "Error: mine/42_light.py: a lesson with that name exists; choose another name\n"
    assert (again.exit_code, again.output) == (1, refusal)
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["42_light.py"]
    assert (tmp_path / "mine" / "42_light.py").read_text() == "changed"


def test_a_name_that_no_lesson_can_have_is_refused(tmp_path):
    with pytest.raises(MasterError, match="cannot name a lesson"):
        new_lesson("!!", tmp_path)
