"""The rules of a run are those of the run before, unless a command says otherwise."""

import json
from datetime import datetime

import pytest
from click.testing import CliRunner
from submissions import answers_of, notebook, write

from imgproc_course.cli import main

pytestmark = pytest.mark.sandbox
RULES = {
    "deadline": "2026-11-02T00:00",
    "late": "50% a day",
    "decisions": "mine.csv",
    "roster": "roster.csv",
    "extensions": "more_time.csv",
}
KEPT = (
    "the deadline 2026-11-02T00:00:00, the late policy 50% a day, the extensions {0}/more_time.csv, the"
    " decisions {0}/mine.csv, the roster {0}/roster.csv"
)


@pytest.fixture
def run(light, key_path, tmp_path, monkeypatch):
    """Runs `grade` in a folder with the tables of RULES; returns (output and exit code, grades.json)."""
    monkeypatch.chdir(tmp_path)
    for name in ("ada", "bob"):
        made = notebook(light, answers_of(light, "right"))
        write(tmp_path / "in" / name / "20_light.ipynb", made, datetime(2026, 11, 2, 12))
    (tmp_path / "mine.csv").write_text("learner,lesson,points,comment\nbob,light,,by hand\n")
    (tmp_path / "roster.csv").write_text("Full name,ID\nada,1\nbob,2\ncy,3\n")
    (tmp_path / "more_time.csv").write_text("learner,deadline\nbob,2026-11-03T00:00\n")

    def run(*words):
        command = ["grade", "in", "--workers", "1", *words]
        done = CliRunner().invoke(main, list(map(str, command)))
        return done, json.loads((tmp_path / "grades/grades.json").read_text())

    options = [word for name, value in RULES.items() for word in (f"--{name}", value)]
    done, _ = run("--key", key_path, *options)
    assert done.exit_code == 0, done.output
    return run


def rules_in(grades):
    """What a run's rules have made of ada and bob."""
    (ada,), (bob,) = (entry["lessons"] for entry in grades["learners"])
    comment = bob["decision"] and bob["decision"]["comment"]
    return ada["points"], bob["days_late"], comment, grades["roster"] and grades["roster"]["missing"]


def test_the_next_run_has_the_rules_of_the_run_before(run, tmp_path, monkeypatch):
    monkeypatch.chdir("/")
    words = [tmp_path / "in", "--out", tmp_path / "grades"]
    done = CliRunner().invoke(main, ["grade", *map(str, words), "--workers", "1"])
    assert done.exit_code == 0, done.output
    grades = json.loads((tmp_path / "grades/grades.json").read_text())
    assert rules_in(grades) == (3, 0, "by hand", ["cy"])
    first = done.output.splitlines()[0]
    assert first.startswith("As in the run before: the key /") and first.endswith(KEPT.format(tmp_path) + ".")


def test_what_a_command_says_counts_for_the_runs_after_it(run):
    for words in (("--deadline", "2026-11-05T00:00"), ()):
        done, grades = run(*words)
        assert done.exit_code == 0 and rules_in(grades) == (6, 0, "by hand", ["cy"])
        assert grades["deadline"] == "2026-11-05T00:00:00"


def test_a_run_can_forget_the_rules_of_the_run_before(run, key_path):
    done, grades = run("--forget-rules", "--key", key_path)
    assert done.exit_code == 0 and rules_in(grades) == (6, 0, None, None)
    assert "run before" not in run()[0].output.replace("As in the run before: the key", "")


def test_a_table_that_is_gone_stops_the_run(run, tmp_path):
    (tmp_path / "roster.csv").unlink()
    done, grades = run()
    assert done.exit_code == 1 and rules_in(grades) == (3, 0, "by hand", ["cy"])
    assert f"{tmp_path}/roster.csv: it cannot be read (No such file or directory)" in done.output


def test_damaged_rules_are_an_error_and_not_forgotten(run, tmp_path):
    (tmp_path / "grades/rules.json").write_text('{"deadline": 7}')
    done, _ = run()
    assert done.exit_code == 1 and "rules.json: cannot be read; remove it" in done.output
