"""The teacher's pages: what to look at, lines for decisions, changes, ids, feedback zips."""

import html
import io
import json
import re
import zipfile
from datetime import datetime

import pytest
from click.testing import CliRunner
from nbclassroom.gradebook.grade import changed_points, grade_submissions
from nbclassroom.gradebook.submission import EQUALS
from nbclassroom.gradebook.summary import summary_page
from submissions import answers_of, cell_of, notebook, write

from imgproc_course.cli import main

pytestmark = pytest.mark.sandbox
MOODLE = "Ada_B Lovelace_12345_assignsubmission_file_"
MIXED = ("Moodle", "Canvas", "{learner}")


@pytest.fixture(scope="module")
def class_folder(light, key_path, tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    right = answers_of(light, "right")
    write(folder / "in" / MOODLE / "20_light.ipynb", notebook(light, right))
    write(folder / "in" / "lovelacebob_LATE_77_100_20_light-1.ipynb", notebook(light, right))
    cheating = notebook(light, right | {"light-double": "def double(p):\n    import os\n    os._exit(0)"})
    write(folder / "in" / "eve" / "20_light.ipynb", cheating)
    write(folder / "in" / "Zoe, =1+1" / "20_light.ipynb", b"{")
    return folder


@pytest.fixture(scope="module")
def graded(class_folder, key_path):
    """(the summary of a run, its folder)"""
    out = class_folder / "out"
    return grade_submissions(class_folder / "in", [key_path], out, workers=1, layouts=MIXED), out


def rows_of(out, heading):
    text = (out / "summary.html").read_text(encoding="utf-8")
    return text.partition(f"<h2>{heading}</h2>")[2].partition("</section>")[0].split("<tr>")[2:]


def test_who_may_have_lost_points_comes_first_and_the_hostile_last(graded):
    headings = re.findall(r"<h2>(.*?)</h2>", (graded[1] / "summary.html").read_text(encoding="utf-8"))
    assert headings[0] == "May have lost points unfairly" and headings[-1] == "Hostile answers"
    (row,) = rows_of(graded[1], "May have lost points unfairly")
    assert "could not be graded: " in row and "<bdi>Zoe, =1+1</bdi>" in row
    (row,) = rows_of(graded[1], "Hostile answers")
    assert "light-double: ended the Python process" in row and "<bdi>eve</bdi>" in row


def test_what_equals_the_solution_is_one_line_for_each_exercise(graded):
    grades = json.loads((graded[1] / "grades.json").read_text(encoding="utf-8"))
    to_look_at = re.compile(r"<b>(\d+)</b>to look at")
    (before,) = to_look_at.findall(summary_page(grades))
    found = {"kind": "odd", "exercise": "light-double", "text": EQUALS}
    for learner in grades["learners"][:2]:
        learner["lessons"][0]["findings"].append(found)
    page = summary_page(grades)
    rows = page.partition("Equal to the course")[2].partition("</section>")[0].split("<tr>")[2:]
    assert len(rows) == 1 and "2 learners:" in rows[0] and "light-double.html" in rows[0]
    assert to_look_at.findall(page) == [str(int(before) + 1)]
    assert "equals the course" not in page


def test_more_than_ten_findings_that_may_be_dishonest_are_folded(graded):
    grades = json.loads((graded[1] / "grades.json").read_text(encoding="utf-8"))
    (eve,) = (learner for learner in grades["learners"] if learner["name"] == "eve")
    eve["lessons"][0]["findings"] = [{"kind": "odd", "exercise": "light-double", "text": "it has tags"}]
    for count, opening in (
        (10, "<details open><summary>10 findings<"),
        (11, "<details><summary>11 findings<"),
    ):
        grades["learners"] = [eve] * count
        assert opening in summary_page(grades).partition("Perhaps dishonest")[2]


def test_a_line_about_a_broken_file_or_a_suspicion_needs_points(graded, class_folder, key_path, tmp_path):
    lines = [
        html.unescape(re.search(r"<code>(.*?)</code>", row)[1])
        for heading in ("May have lost points unfairly", "Hostile answers")
        for row in rows_of(graded[1], heading)
    ]
    assert lines == ['"Zoe, =1+1",light,,?,looked at by hand', "eve,light,light-double,?,looked at by hand"]
    assert 'href="review/light-double.html#eve-' in rows_of(graded[1], "Hostile answers")[0]
    decisions = tmp_path / "decisions.csv"
    text = "\n".join(["learner,lesson,exercise,points,comment", *lines])
    decisions.write_text(text)
    out = tmp_path / "out"
    with pytest.raises(ValueError, match=r"row 2: the points are '\?'; expected 0 to 6"):
        grade_submissions(class_folder / "in", [key_path], out, decisions=decisions, layouts=MIXED)
    decisions.write_text(text.replace(",?,", ",6,", 1).replace(",?,", ",1,"))
    grade_submissions(class_folder / "in", [key_path], out, decisions=decisions, workers=1, layouts=MIXED)
    grades = json.loads((out / "grades.json").read_text())
    assert {entry["name"]: entry["points"] for entry in grades["learners"]}["Zoe, =1+1"] == 6
    assert "May have lost points" not in (out / "summary.html").read_text()


def test_a_hundred_files_of_one_learner_do_not_hide_the_others(light, submissions, key_path, tmp_path):
    write(submissions / "zoe" / "20_light.ipynb", b"{")
    for number in range(50):
        write(submissions / "eve" / f"{number}.ipynb", notebook(light) | {"cells": [], "metadata": {}})
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    rows = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert [("eve" in row, "zoe" in row) for row in rows] == [(True, False)] * 3 + [(False, True)]


def test_practice_is_no_reason_for_a_decision_on_the_whole_lesson(masters, submissions, key_path, tmp_path):
    made = notebook(masters["sound"])
    made["cells"].remove(cell_of(made, "answer-sound-practice"))
    write(submissions / "ada" / "21_sound.ipynb", made)
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    assert rows_of(tmp_path / "out", "May have lost points unfairly") == []
    (row,) = rows_of(tmp_path / "out", "Also unusual")
    assert "sound-practice: its answer cell" in row


def test_a_lost_name_and_a_file_of_ones_own_are_not_dishonest(light, submissions, key_path, tmp_path):
    right = answers_of(light, "right")
    own_file = "from mine import twice\ndef double(pixels):\n    return twice(pixels)"
    write(submissions / "ada" / "20_light.ipynb", notebook(light, right | {"light-double": own_file}))
    (submissions / "ada" / "mine.py").write_text("def twice(pixels):\n    return pixels\n")
    write(submissions / "bob" / "20_light.ipynb", notebook(light, right | {"light-double": USES_CV2}))
    typo = "def Double(pixels):\n    return pixels"
    write(submissions / "cy" / "20_light.ipynb", notebook(light, right | {"light-double": typo}))
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    (cy,) = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert "its answer cell does not define double(), but Double()" in cy
    ada, bob = rows_of(tmp_path / "out", "Modules that the exercise does not allow")
    assert "light-double: uses a module that this exercise does not allow: mine" in ada
    assert "light-double: uses a module that this exercise does not allow: cv2" in bob
    assert "bob,light,light-double,?,looked at by hand" in bob
    assert rows_of(tmp_path / "out", "Perhaps dishonest") == []


def test_a_wrong_name_may_be_unfair_and_cells_that_do_not_run_are_a_list(
    light, submissions, key_path, tmp_path
):
    answers = {
        "ada": "def duoble(pixels):\n    return pixels",
        "bob": "def double(pixels):\n    return \u201cpixels\u201d",
        "cy": "def double(pixels):\n    I do not know",
        "di": "def double(pixels, most=the_most):\n    return pixels",
        "eli": "def double(pixels):\n    return pixels + unknown",
        "fay": "",
    }
    right = answers_of(light, "right")
    for name, source in answers.items():
        write(submissions / name / "20_light.ipynb", notebook(light, right | {"light-double": source}))
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    (ada,) = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert "light-double: its answer cell does not define double(), but duoble()" in ada
    assert "<code>ada,light,light-double,3,looked at by hand</code>" in ada
    bob, cy, di = rows_of(tmp_path / "out", "Answers that do not run")
    assert "\u201c is no character of Python" in bob
    assert "light-double: line 2 of its answer cell is not Python: I do not know (invalid syntax)" in cy
    assert "0 of 3" in cy and "<code>" not in cy
    assert "light-double: its cell does not run: NameError: name &#39;the_most&#39; is not defined" in di


def test_an_answer_that_does_not_run_is_listed_until_it_is_decided(light, submissions, key_path, tmp_path):
    answers = answers_of(light, "right") | {"light-double": "def double(pixels):\n    I do not know"}
    write(submissions / "ada" / "20_light.ipynb", notebook(light, answers))
    decisions, out = tmp_path / "decisions.csv", tmp_path / "out"
    decisions.write_text("learner,lesson,exercise,points\nada,light,light-double,0\n")
    grade_submissions(submissions, [key_path], out, decisions=decisions, workers=1)
    assert rows_of(out, "Answers that do not run") == []


USES_CV2 = "import cv2\ndef double(pixels):\n    return cv2.add(pixels, pixels)"


def test_one_learner_and_one_lesson_are_not_plural(light, submissions, key_path, tmp_path):
    write(submissions / "ada.ipynb", notebook(light))
    summary = grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    assert summary.text.startswith("1 learner, 1 lesson graded (1 in this run)")
    text = (tmp_path / "out" / "summary.html").read_text()
    assert "<b>1</b>learner<" in text and "of 1 submission graded" in text


def test_the_zips_of_feedback_have_the_names_that_moodle_and_canvas_read(graded):
    with zipfile.ZipFile(graded[1] / "exports" / "moodle-feedback-light.zip") as archive:
        (name,) = archive.namelist()
        page = archive.read(name)
    assert name == "Ada B Lovelace_12345_assignsubmission_file/feedback.html"
    assert page == next((graded[1] / "learners").glob("ada-b-*.html")).read_bytes()
    with zipfile.ZipFile(graded[1] / "exports" / "canvas-feedback-light.zip") as archive:
        assert archive.namelist() == ["lovelacebob_LATE_77_100_20_light-1.html"]


def test_a_learner_of_no_platform_has_a_zip_alone(graded):
    names = {path.name for path in (graded[1] / "exports").glob("feedback-*.zip")}
    pages = {path.stem: path for path in (graded[1] / "learners").iterdir()}
    own = [stem for stem in pages if stem.startswith(("eve-", "zoe-"))]
    assert names == {f"feedback-{stem}.zip" for stem in own} and len(own) == 2
    for stem in own:
        with zipfile.ZipFile(graded[1] / "exports" / f"feedback-{stem}.zip") as archive:
            assert [archive.read(name) for name in archive.namelist()] == [pages[stem].read_bytes()]


CHANGES = {  # what a lesson has in two runs, and how the terminal says it
    "3 of 6 → 4 of 6": ({"points": 3}, {"points": 4}),
    "3 of 6 → 2 of 6, 1 deducted because late": ({"points": 3}, {"points": 2, "late_deduction": 1}),
    "4 of 6 → excused": ({"points": 4}, {"points": 0, "decision": {"excused": True}}),
    "3 of 6, decided by hand; the autograder gives 0 → 3 of 6, decided by hand; the autograder gives 5": [
        {"points": 3, "decision": {"excused": False}, "autograded_points": points} for points in (0, 5)
    ],
    "4 of 6 → not graded: it is empty": ({"points": 4}, {"status": "not graded", "reason": "it is empty"}),
    "": ({"points": 4, "version": "1"}, {"points": 4, "version": "2"}),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_of_points_is_named(change):
    lesson = {"lesson": "light", "status": "graded", "max_points": 6}
    before, after = (
        {"learners": [{"name": "Bob", "lessons": [lesson | entry]}]} for entry in CHANGES[change]
    )
    assert changed_points(before, after)[1:] == ([f"  Bob: light: {change}"] if change else [])


def test_the_terminal_says_whose_points_changed(light, submissions, key_path, tmp_path):
    options = {"workers": 1}
    write(submissions / "bob.ipynb", notebook(light, answers_of(light, "right")))
    out = tmp_path / "out"
    first = grade_submissions(submissions, [key_path], out, **options)
    assert "the run before" not in first.text
    (out / "decisions.csv").write_text("learner,lesson,points\nbob,light,2\n")
    write(submissions / "cy.ipynb", notebook(light, answers_of(light, "right")))
    second = grade_submissions(submissions, [key_path], out, **options)
    assert second.text.splitlines()[1:4] == [
        "2 lessons with other points than in the run before (grades.previous.json):",
        "  bob: light: 6 of 6 → 2 of 6, decided by hand; the autograder gives 6",
        "  cy: light: not there → 6 of 6",
    ]
    before = json.loads((out / "grades.previous.json").read_text())
    assert [learner["points"] for learner in before["learners"]] == [6]


def test_anonymous_pages_show_no_name(class_folder, graded, key_path, tmp_path):
    out = tmp_path / "out"
    shown = {"workers": 1, "anonymous": True, "deadline": datetime(2026, 11, 1)}
    shown["layouts"] = MIXED
    grade_submissions(class_folder / "in", [key_path], out, **shown)
    grades = json.loads((out / "grades.json").read_text())
    for learner in grades["learners"]:
        assert re.fullmatch(r"learners/learner-[0-9a-f]{10}\.html", learner["page"])
    pages = [*out.glob("*.html"), *(out / "learners").iterdir()]
    pages += (out / "review").iterdir()
    assert len(pages) == 8
    for path in pages:
        text = path.read_text(encoding="utf-8")
        assert not re.search("lovelace|zoe|\\beve\\b|20_light", text, re.I), path.name
    (row,) = rows_of(out, "Hostile answers")
    line = re.search(r"<code>(.*?)</code>", row)[1]
    assert re.match("learner-[0-9a-f]{10},light,light-double,\\?,", line)
    (out / "decisions.csv").write_text(
        "learner,lesson,exercise,points,comment\n" + line.replace(",?,", ",1,")
    )
    grade_submissions(class_folder / "in", [key_path], out, **shown)
    grades = json.loads((out / "grades.json").read_text())
    (eve,) = [learner for learner in grades["learners"] if learner["name"] == "eve"]
    assert eve["lessons"][0]["exercises"][0]["points"] == 1
    with zipfile.ZipFile(io.BytesIO((out / "exports" / "moodle-feedback-light.zip").read_bytes())) as archive:
        assert archive.namelist() == ["Ada B Lovelace_12345_assignsubmission_file/feedback.html"]


def test_a_lesson_that_lost_points_by_lateness_alone_gets_back_only_those(
    light, submissions, key_path, tmp_path
):
    half = notebook(light, answers_of(light, "right") | {"light-double": "def double(p):\n    return p"})
    write(submissions / "ada" / "light.ipynb", half, datetime(2026, 11, 1))
    write(submissions / "ada" / "light (1).ipynb", half, datetime(2026, 11, 4))
    late = {"deadline": datetime(2026, 11, 2), "late": "50% a day, 1 day"}
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1, **late)
    (row,) = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert "0 of 6" in row and "<code>ada,light,,3,looked at by hand</code>" in row


def test_a_wrong_late_submission_after_a_right_one_in_time_is_listed(light, submissions, key_path, tmp_path):
    right, wrong = notebook(light, answers_of(light, "right")), notebook(light, answers_of(light, 0))
    write(submissions / "ada" / "light.ipynb", right, datetime(2026, 11, 1))
    write(submissions / "ada" / "light (1).ipynb", wrong, datetime(2026, 11, 4))
    write(submissions / "bob" / "light.ipynb", wrong, datetime(2026, 11, 4))
    late = {"deadline": datetime(2026, 11, 2), "late": "50% a day, 1 day"}
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1, **late)
    (row,) = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert "ada" in row and "an earlier submission was in time" in row


def test_answers_of_another_lesson_in_one_notebook_are_listed(light, submissions, key_path, tmp_path):
    both = notebook(light, answers_of(light, "right"))
    both["cells"].append({"id": "answer-sound-mean", "cell_type": "code", "metadata": {}, "source": "x = 1"})
    write(submissions / "ada.ipynb", both)
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    (row,) = rows_of(tmp_path / "out", "May have lost points unfairly")
    assert "6 of 6" in row and "it also has answer cells of sound; a notebook counts for one lesson" in row
    assert ": submit the others as notebooks of their own" in row


def test_who_sent_only_other_files_is_named_with_them(light, submissions, key_path, tmp_path):
    write(submissions / "ada.ipynb", notebook(light, answers_of(light, "right")))
    write(submissions / "Uwe Ulm.py", b"x = 1")
    (tmp_path / "roster.csv").write_text("name\nada\nUwe Ulm\nMax Nobody\n", encoding="utf-8")
    options = {"workers": 1, "roster": tmp_path / "roster.csv"}
    grade_submissions(submissions, [key_path], tmp_path / "out", **options)
    page = (tmp_path / "out" / "summary.html").read_text(encoding="utf-8")
    assert "<bdi>Uwe Ulm</bdi> (sent 1 file, no notebook); <bdi>Max Nobody</bdi>." in page


def test_a_folder_in_doubt_stops_the_run_with_a_list_and_a_layout_settles_it(
    light, submissions, key_path, tmp_path
):
    for name in ("ada", "bob"):
        write(submissions / "week_1" / f"{name}.ipynb", notebook(light, answers_of(light, "right")))
    write(submissions / "week_1" / "notes.txt", b"")
    command = ["grade", str(submissions), "--key", str(key_path), "--out", str(tmp_path / "out")]
    for options in ([], ["--dry-run"]):
        ended = CliRunner().invoke(main, command + options)
        assert ended.exit_code == 3 and not (tmp_path / "out").exists()
        assert "  week_1/bob.ipynb: week_1 or bob\n" in ended.output
    ended = CliRunner().invoke(main, [*command, "--dry-run", "--layout", "{group}/{learner}"])
    assert ended.exit_code == 0 and not (tmp_path / "out").exists()
    assert ended.output.splitlines() == [
        "layout {group}/{learner}: 2 learners, nothing graded",
        *("ada", "  light: week_1/ada.ipynb", "bob", "  light: week_1/bob.ipynb"),
        *("left out, since they are no notebooks:", "  week_1/notes.txt"),
    ]
    ended = CliRunner().invoke(main, [*command, "--layout", "{group}/{learner}"])
    assert ended.exit_code == 0 and "Layout: {group}/{learner}." in ended.output
    ended = CliRunner().invoke(main, command)
    assert ended.exit_code == 0
    assert ended.output.startswith("As in the run before: the layout {group}/{learner}.\n")


def test_an_excused_lesson_is_no_practice(light, submissions, key_path, tmp_path):
    write(submissions / "ada.ipynb", notebook(light, answers_of(light, 0)))
    (tmp_path / "decisions.csv").write_text(
        "learner,lesson,exercise,points,comment\nada,light,,excused,ill\n"
    )
    options = {"workers": 1, "decisions": tmp_path / "decisions.csv"}
    grade_submissions(submissions, [key_path], tmp_path / "out", **options)
    (page,) = (tmp_path / "out" / "learners").iterdir()
    text = page.read_text(encoding="utf-8")
    assert "counts neither for you nor against you" in text and "practice, without points" not in text


def test_a_total_says_how_many_lessons_were_submitted(graded):
    (page,) = (graded[1] / "learners").glob("eve-*.html")
    assert "of 2 lessons, 1 submitted" in page.read_text(encoding="utf-8")
    summary = (graded[1] / "summary.html").read_text(encoding="utf-8")
    assert summary.count('<td class="number">1 of 2</td>') == 4


def test_not_attempted_is_neutral_without_a_hint_and_with_a_kind_sentence(
    light, submissions, key_path, tmp_path
):
    answers = {"light-halves": "def halves(pixels):\n    return pixels, pixels"}
    write(submissions / "ada.ipynb", notebook(light, answers))
    grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
    (page,) = (tmp_path / "out" / "learners").iterdir()
    double, halves = page.read_text(encoding="utf-8").split('<div class="exercise">')[1:]
    assert double.count('class="open">○') == 2 and "You have not started this exercise yet" in double
    assert "failed" not in double and "Hint" not in double
    assert halves.count('class="failed">✗') == 2 and "Hint: Return both halves." in halves
