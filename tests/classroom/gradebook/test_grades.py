"""Thirty submissions from end to end; attacks of form gain nothing; grades are the same every time."""

import io
import json
import random
import shutil
import threading
import time
from datetime import datetime

import pytest
from form_attacks import FORM_ATTACKS, grade_attacks
from nbclassroom.autograder.answer_key import load_key
from nbclassroom.autograder.results import from_json
from nbclassroom.gradebook.grade import grade_submissions, show_time
from nbclassroom.gradebook.grades_json import lesson_names
from nbclassroom.gradebook.result_store import ResultStore
from submissions import answers_of, notebook, thirty, write
from tqdm import tqdm

pytestmark = pytest.mark.sandbox


def lesson_of(grades, learner, lesson="light"):
    of = next(each for each in grades["learners"] if each["name"] == learner)
    return next(each for each in of["lessons"] if each["lesson"] == lesson)


def findings_of(lesson):
    return [finding["text"] for finding in lesson["findings"]]


@pytest.fixture(scope="module")
def classroom(tmp_path_factory, masters):
    folder = tmp_path_factory.mktemp("classroom") / "submissions"
    return folder, thirty(folder, list(masters.values()))


@pytest.fixture(scope="module")
def graded(classroom, key_path, tmp_path_factory):
    out = tmp_path_factory.mktemp("graded") / "grades"
    summary = grade_submissions(classroom[0], [key_path], out, workers=1)
    return out, summary


def test_lessons_are_in_the_order_of_the_course():
    mine = {"lessons": [{"lesson": "a", "number": "31"}, {"lesson": "b", "number": "07"}]}
    course = {"lessons": [{"lesson": "z", "number": "04"}, {"lesson": "b", "number": "05"}]}
    assert lesson_names({"keys": [mine, course]}) == ["z", "b", "a"]
    assert lesson_names({"keys": [course, mine]}) == ["z", "b", "a"]


def test_thirty_submissions_get_the_right_points(graded, classroom):
    grades = json.loads((graded[0] / "grades.json").read_text())
    points = {"light": 6, "sound": 4}
    for learner, lesson, kind in classroom[1]:
        got = lesson_of(grades, learner, lesson)
        assert got["max_points"] == points[lesson], learner
        if kind == "right":
            assert got["points"] == points[lesson]
        elif kind == "broken":
            assert (got["points"], got["status"]) == (0, "not graded") and got["reason"]
        else:
            assert got["points"] == 0, (learner, kind)
        mistakes = [each["mistake"] for each in got["exercises"]]
        assert all(mistakes) == (kind in (0, 1)) or not mistakes
        outcomes = {case["outcome"] for each in got["exercises"] for case in each["cases"]}
        assert outcomes == {
            "right": {"passed"},
            "untouched": {"not attempted"},
            "raising": {"raised"},
            "broken": set(),
        }.get(kind, {"wrong"})
    assert graded[1].not_graded == 4
    assert "30 learners, 26 lessons graded" in graded[1].text


def test_teachers_scripts_find_the_fields_of_format_8(graded):
    """Other fields need another number of the format."""
    grades = json.loads((graded[0] / "grades.json").read_text())
    learner = next(each for each in grades["learners"] if each["points"])
    lesson = next(each for each in learner["lessons"] if each["points"])
    exercise = lesson["exercises"][0]
    parts = (grades, learner, lesson, exercise, exercise["cases"][0])
    assert grades["format"] == 8
    assert [" ".join(sorted(part)) for part in parts] == [
        "anonymous_pages course deadline format ignored keys late_policy layout learners open_as_zero roster "
        "sandbox",
        "lessons max_points name open_points page points",
        "autograded_points days_late decision earlier exercises file findings key late late_deduction lesson "
        "max_points open_points platform platform_id points reason sha256 status submitted_at title version",
        "autograded_points cases cause decision id mark max_points message mistake mistake_explanation "
        "open_points points rubric title",
        "hidden id max_points message outcome points title",
    ]


def test_another_order_and_more_workers_give_the_same_bytes(graded, classroom, key_path, tmp_path):
    mixed = tmp_path / "submissions"
    learners = sorted(classroom[0].iterdir())
    random.Random(3).shuffle(learners)
    for learner in learners:
        shutil.copytree(learner, mixed / learner.name)
    out = tmp_path / "grades"
    grade_submissions(mixed, [key_path], out, workers=3)
    for path in sorted(graded[0].rglob("*")):
        if path.is_file() and path.parent.name != "results":
            assert (out / path.relative_to(graded[0])).read_bytes() == path.read_bytes(), path.name


# ---------------------------------------------------------------- going on, and what is kept


def test_an_interrupted_run_continues_where_it_stopped(light, key_path, submissions, tmp_path, monkeypatch):
    for number in range(6):
        answers = answers_of(light, "right")
        answers["light-double"] += f"\n# {number}"
        write(submissions / f"{number}.ipynb", notebook(light, answers))
    stored, keep = [], ResultStore.keep_result

    def keep_three(store, digest, result):
        if len(stored) == 3:
            raise KeyboardInterrupt
        stored.append(digest)
        keep(store, digest, result)

    monkeypatch.setattr(ResultStore, "keep_result", keep_three)
    out = tmp_path / "grades"
    with pytest.raises(KeyboardInterrupt):
        grade_submissions(submissions, [key_path], out, workers=1)
    assert not (out / "grades.json").exists()
    monkeypatch.setattr(ResultStore, "keep_result", keep)
    assert (
        "6 lessons graded (3 in this run; the others equal one of these, or were graded before)"
        in grade_submissions(submissions, [key_path], out, workers=1).text
    )
    assert "(0 in this run; the others" in grade_submissions(submissions, [key_path], out, workers=1).text
    again = grade_submissions(submissions, [key_path], out, workers=1, fresh=True)
    assert "(6 in this run)" in again.text


def test_an_incomplete_result_is_graded_again(light, key_path, submissions, grade, tmp_path):
    write(submissions / "ada.ipynb", notebook(light, answers_of(light, "right")))
    first = grade(submissions)
    (path,) = [each for each in (tmp_path / "grades" / "results").iterdir() if "page" not in each.name]
    path.write_text(path.read_text()[:40])
    assert grade(submissions) == first
    assert from_json(json.loads(path.read_text())).points == 6


def test_equal_answers_are_graded_once(light, key_path, submissions, tmp_path):
    for name in ("ada", "bob", "eve"):
        write(submissions / f"{name}.ipynb", notebook(light, answers_of(light, "right")))
    summary = grade_submissions(submissions, [key_path], tmp_path / "grades", workers=1)
    assert "3 lessons graded (1 in this run; the others equal" in summary.text


def test_a_whole_folder_with_the_index_and_the_glossary_is_graded(light, submissions, grade):
    alone = notebook(light, answers_of(light, "right"))
    write(submissions / "ada" / "20_light.ipynb", alone)
    expected = grade(submissions)
    for page in ("index", "glossary"):
        made = notebook(light)
        made["metadata"]["imgproc_course"]["lesson"] = page
        made["cells"] = []
        write(submissions / "ada" / f"{page}.ipynb", made)
    assert grade(submissions)["learners"] == expected["learners"]


def test_pages_of_learners_who_are_gone_are_removed(light, submissions, grade, tmp_path):
    write(submissions / "ada.ipynb", notebook(light))
    write(submissions / "bob.ipynb", notebook(light))
    grade(submissions)
    (submissions / "bob.ipynb").unlink()
    grade(submissions)
    assert [path.name.split("-")[0] for path in (tmp_path / "grades" / "learners").iterdir()] == ["ada"]


def test_no_grades_among_the_submissions(light, key_path, submissions):
    write(submissions / "ada.ipynb", notebook(light))
    for out in (submissions, submissions / "grades", key_path / "grades"):
        with pytest.raises(ValueError, match="name a folder outside it"):
            grade_submissions(submissions, [key_path], out)


def test_a_folder_that_cannot_be_written(light, key_path, submissions, tmp_path):
    write(submissions / "ada.ipynb", notebook(light))
    (tmp_path / "file").write_text("")
    with pytest.raises(ValueError, match="cannot be"):
        grade_submissions(submissions, [key_path], tmp_path / "file" / "grades")


# ---------------------------------------------------------------- late, again, other versions


def test_the_latest_submission_counts_and_all_are_listed(light, submissions, grade):
    write(
        submissions / "ada" / "light (1).ipynb",
        notebook(light, answers_of(light, "right")),
        datetime(2026, 11, 1),
    )
    write(
        submissions / "ada" / "light (2).ipynb", notebook(light, answers_of(light, 0)), datetime(2026, 12, 2)
    )
    write(submissions / "ada" / "light.ipynb", notebook(light), datetime(2026, 10, 1))
    write(submissions / "ada" / "d.ipynb", b"{", datetime(2026, 12, 3))
    grades = grade(submissions, deadline=datetime(2026, 12, 1, 23, 59))
    lesson = lesson_of(grades, "ada")
    assert (lesson["points"], lesson["file"], lesson["late"]) == (0, "ada/light (2).ipynb", True)
    assert [(each["file"], each["late"]) for each in lesson["earlier"]] == [
        ("ada/light.ipynb", False),
        ("ada/light (1).ipynb", False),
    ]
    assert "submitted 3 times; this one counts: ada/light (2).ipynb" in findings_of(lesson)
    assert lesson_of(grades, "ada", None)["reason"].startswith("it is not a notebook")


def test_canvas_submissions_are_ordered_by_number_and_late_as_canvas_says(light, submissions, grade):
    right, wrong = notebook(light, answers_of(light, "right")), notebook(light, answers_of(light, 0))
    write(submissions / "lovelaceada_77_100_20_light.ipynb", wrong, datetime(2026, 11, 5))
    write(submissions / "lovelaceada_LATE_77_200_20_light-1.ipynb", right, datetime(2026, 11, 1))
    lesson = lesson_of(grade(submissions), "lovelaceada")
    assert (lesson["points"], lesson["late"], lesson["platform_id"]) == (6, True, "77")


@pytest.mark.parametrize("kind", ["no answer cells", "stubs"])
def test_a_submission_without_answers_does_not_replace_one_with_answers(light, submissions, grade, kind):
    right = notebook(light, answers_of(light, "right"))
    write(submissions / "ada" / "20_light.ipynb", right, datetime(2026, 11, 1))
    empty = right | {"metadata": {}, "cells": right["cells"][:1]}  # recognized by its file name alone
    empty = notebook(light) if kind == "stubs" else empty
    write(submissions / "ada" / "20_light-1.ipynb", empty, datetime(2026, 12, 2))
    lesson = lesson_of(grade(submissions), "ada")
    assert (lesson["points"], lesson["file"]) == (6, "ada/20_light.ipynb")


def test_an_older_version_is_graded_with_its_own_key_or_reported(
    light, key_path, submissions, tmp_path, grade
):
    old = tmp_path / "old-key"
    shutil.copytree(key_path, old)
    for path in old.rglob("*.json"):
        path.write_text(path.read_text().replace('"version": "0.1.0"', '"version": "0.0.9"'))
    write(submissions / "ada.ipynb", notebook(light, answers_of(light, "right"), version="0.0.9"))
    write(submissions / "bob.ipynb", notebook(light, answers_of(light, "right")))
    lesson = lesson_of(grade(submissions), "ada")
    assert lesson["points"] == 6
    assert "it was made from version '0.0.9' of the lesson, not from version 0.1.0" in findings_of(lesson)
    grade_submissions(submissions, [key_path, old], tmp_path / "both", workers=1)
    both = json.loads((tmp_path / "both" / "grades.json").read_text())
    for learner, path in (("ada", old), ("bob", key_path)):
        lesson = lesson_of(both, learner)
        assert (lesson["key"], lesson["points"], lesson["findings"]) == (load_key(path).digest, 6, [])


# ---------------------------------------------------------------- attacks of form


@pytest.fixture(scope="module")
def attacked(light, key_path, tmp_path_factory):
    return grade_attacks(light, key_path, tmp_path_factory.mktemp("attacked"))


@pytest.mark.parametrize("attack", FORM_ATTACKS, ids=[attack.name for attack in FORM_ATTACKS])
def test_an_attack_of_form_gains_nothing_harms_nobody_and_is_reported(attacked, attack):
    result = attacked[attack.name]
    assert (result.gained, result.harmed) == (0, ())
    assert attack.reported in result.report


def test_the_bar_shows_the_seconds_of_one_submission_and_ends_with_its_run():
    text, end = io.StringIO(), time.monotonic() + 60
    with tqdm(total=2, file=text) as bar:
        ticking = threading.Thread(target=show_time, args=(bar,))
        ticking.start()
        while "00:02" not in text.getvalue() and time.monotonic() < end:
            time.sleep(0.05)
    assert "| 0/2 [00:01<" in text.getvalue() and "| 0/2 [00:02<" in text.getvalue()
    ticking.join(60)
    assert not ticking.is_alive()
