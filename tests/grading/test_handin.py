"""What a learner is told before handing in."""

import json

import nbformat
import pytest
from click.testing import CliRunner

from imgproc_course.grading.build import unexecuted
from imgproc_course.grading.commands import check
from imgproc_course.grading.handin import HandInError, look_at, report_lines, run_answers
from imgproc_course.grading.masters import read_master


@pytest.fixture
def hand_in(write_master, tmp_path):
    """Writes a learner's notebook, changed by a function, and gives its path."""

    def write(change=lambda cells: None, *, solved=True):
        notebook = json.loads(nbformat.writes(unexecuted(read_master(write_master()), solved=solved)))
        cells = {cell["id"]: cell for cell in notebook["cells"]}
        change(cells)
        notebook["cells"] = [cell for cell in cells.values() if cell is not None]
        path = tmp_path / "my_lesson.ipynb"
        path.write_text(json.dumps(notebook), encoding="utf-8")
        return path

    return write


ANSWER = "answer-template-double"


def found(path):
    handin = look_at(path)
    (entry,) = handin.entries
    return handin, entry.state, " ".join(entry.notes)


def test_an_answered_lesson_is_ready(hand_in):
    handin, state, notes = found(hand_in())
    assert handin.ready and state == "answered" and notes == ""
    assert list(report_lines(handin)) == [
        "my_lesson.ipynb: 90_template",
        "  template-double: answered",
        "Ready to hand in.",
    ]


@pytest.mark.parametrize(
    "source", [None, 'def double(pixels):\n    # hm\n    raise NotImplementedError("your turn")\n']
)
def test_the_stub_is_not_attempted(hand_in, source):
    def change(cells):
        if source:
            cells[ANSWER]["source"] = source

    handin, state, _ = found(hand_in(change, solved=False))
    assert state == "not attempted" and not handin.ready


def edit(id, **fields):
    return lambda cells: cells[id].update(fields)


def remove(id):
    return lambda cells: cells.update({id: None})


def duplicate(cells):
    cells["copy"] = dict(cells[ANSWER])


def move(cells):
    cells["mine"] = dict(cells[ANSWER], id="mine")
    cells[ANSWER] = None


def split(cells):
    cells["mine"] = dict(cells[ANSWER], id="mine")
    cells[ANSWER]["source"] = "helper = 3"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (remove(ANSWER), "its answer cell (answer-template-double) is missing. Take the lesson afresh"),
        (move, "is missing; double() stands in another cell (mine), which is not graded"),
        (duplicate, "stands there 2 times; keep the one that counts"),
        (edit(ANSWER, source=""), "its answer cell is empty"),
        (edit(ANSWER, source="# later"), "its answer cell is empty"),
        (edit(ANSWER, cell_type="markdown"), "is a markdown cell; make it code again"),
        (edit(ANSWER, cell_type="raw"), "is a raw cell; make it code again"),
        (
            edit(ANSWER, source=["def double(pixels)\n", "    return 3"]),
            "line 1 of its answer cell is no Python",
        ),
        (edit(ANSWER, source="def dubble(pixels): return 3"), "does not define double()"),
        (split, "does not define double(), but cell mine does, and it is not graded"),
    ],
)
def test_an_answer_that_grading_would_not_find_is_said(hand_in, change, said):
    handin, state, notes = found(hand_in(change))
    assert state == "needs your attention" and not handin.ready
    assert said in notes


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            remove("check-template-double-1"),
            "its check cell (check-template-double-1) is missing; grading uses its own",
        ),
        (
            edit("check-template-double-1", source="True"),
            "its check cell (check-template-double-1) was changed",
        ),
        (
            edit("given-template-double-1", source="LIMIT = 300"),
            "its given cell (given-template-double-1) was",
        ),
    ],
)
def test_changed_cells_of_ours_are_said_and_do_no_harm(hand_in, change, said):
    handin, state, notes = found(hand_in(change))
    assert state == "answered" and handin.ready
    assert said in notes


def test_a_lesson_of_another_version_is_said(hand_in):
    path = hand_in()
    notebook = json.loads(path.read_text())
    notebook["metadata"]["imgproc_course"]["version"] = "0.0.1"
    path.write_text(json.dumps(notebook))
    assert look_at(path).notes[0].startswith("made for version 0.0.1 of the course, this is ")


def test_a_lesson_without_its_metadata_is_known_by_its_name(hand_in):
    path = hand_in()
    notebook = json.loads(path.read_text())
    del notebook["metadata"]["imgproc_course"]
    renamed = path.with_name("90_template_final.ipynb")
    renamed.write_text(json.dumps(notebook))
    assert look_at(renamed).lesson == "90_template"
    path.write_text(json.dumps(notebook))
    with pytest.raises(HandInError, match="no lesson of this course; the lessons are"):
        look_at(path)


@pytest.mark.parametrize("text", ["", "[]", "{", '{"cells": 3}', "[" * 100_000])
def test_a_file_that_is_no_notebook_is_answered_with_the_cure(tmp_path, text):
    path = tmp_path / "my_lesson.ipynb"
    path.write_text(text)
    with pytest.raises(HandInError, match=r"no notebook .*save it again"):
        look_at(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(HandInError, match="no such file"):
        look_at(tmp_path / "nothing.ipynb")


def run(path):
    handin = look_at(path)
    run_answers(handin)
    return handin


def test_answers_are_run_by_themselves(hand_in):
    handin = run(hand_in())
    assert handin.entries[0].result.passed
    assert "  template-double: 1 of 1 checks pass" in list(report_lines(handin))


def test_a_wrong_answer_is_told_with_its_story(hand_in):
    handin = run(hand_in(edit(ANSWER, source="def double(pixels): return pixels * 2")))
    assert "1 of 1 checks fail: Bright pixels: 11 of 12 values differ" in handin.entries[0].notes[0]
    assert list(report_lines(handin))[-1].startswith(
        "Everything is where grading looks for it, but not every"
    )


def test_an_answer_that_needs_another_cell_is_told(hand_in):
    handin = run(hand_in(edit(ANSWER, source="x = y + 1\ndef double(pixels): return x")))
    assert "its cell does not run by itself: NameError: name 'y' is not defined" in handin.entries[0].notes[0]
    assert not handin.ready


def test_the_command_says_it_and_fails_while_not_ready(hand_in):
    done = CliRunner().invoke(check, ["--run", str(hand_in())])
    assert done.exit_code == 0 and done.output.endswith("Ready to hand in.\n")
    done = CliRunner().invoke(check, [str(hand_in(solved=False))])
    assert done.exit_code == 1 and "template-double: not attempted" in done.output
    done = CliRunner().invoke(check, ["nothing.ipynb"])
    assert done.exit_code == 1 and "Error: nothing.ipynb: no such file" in done.output
