"""What a learner is told before handing in."""

import json

import nbformat
import pytest
from click.testing import CliRunner

from imgproc_course.authoring.build import unexecuted
from imgproc_course.authoring.masters import read_master
from imgproc_course.cli import check
from imgproc_course.gradebook.check import HandInError, look_at, report_lines, run_answers


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
        "Complete: every answer cell is there and filled in. This does not run them;"
        f" `imgproc-course check --run {handin.path}` does.",
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


def assign(cells):
    """A name given in another cell is no definition that was misplaced."""
    cells["mine"] = dict(cells[ANSWER], id="mine", source="double = 3\nfrom math import floor as double")
    cells[ANSWER] = None


def define_in_the_check(cells):
    cells["check-template-double-1"]["source"] = cells[ANSWER]["source"]
    cells[ANSWER] = None


def split(cells):
    cells["mine"] = dict(cells[ANSWER], id="mine")
    cells[ANSWER]["source"] = "helper = 3"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (remove(ANSWER), "its answer cell (answer-template-double) is missing. Take the lesson afresh"),
        (move, "is missing; double() stands in another cell (mine), which is not graded"),
        (assign, "its answer cell (answer-template-double) is missing. Take the lesson afresh"),
        (
            define_in_the_check,
            "double() stands in another cell (check-template-double-1), which is not graded",
        ),
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


def test_the_lessons_own_function_of_that_name_is_not_a_misplaced_answer(hand_in, write_master):
    path = hand_in(remove(ANSWER))
    write_master(("LIMIT = 255", "LIMIT = 255\n\ndef double(pixels):\n    return pixels"))
    notebook = json.loads(path.read_text())
    given = next(cell for cell in notebook["cells"] if cell["id"] == "given-template-double-1")
    given["source"] += "\n\ndef double(pixels):\n    return pixels"
    path.write_text(json.dumps(notebook))
    _, _, notes = found(path)
    assert "its answer cell (answer-template-double) is missing. Take the lesson afresh" in notes


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


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "the file is empty; save it again in JupyterLab"),
        (b"{", "its content is no JSON; save it again in JupyterLab"),
        (b"[" * 100_000, "its content is no JSON; save it again in JupyterLab"),
        (b"\x89PNG\r\n", "its content is no JSON; save it again in JupyterLab"),
        (b"[]", "it has no list of cells (format 4); open it in JupyterLab and save it again"),
        (b'{"cells": 3}', "it has no list of cells (format 4); open it in JupyterLab and save it again"),
    ],
)
def test_a_file_that_is_no_notebook_is_answered_with_the_cure(tmp_path, content, said):
    path = tmp_path / "my_lesson.ipynb"
    path.write_bytes(content)
    with pytest.raises(HandInError) as error:
        look_at(path)
    assert str(error.value) == f"{path} is no notebook: {said}"


def test_a_file_of_another_kind_and_a_folder_are_one_line(tmp_path):
    (tmp_path / "notes.txt").write_text("hello")
    done = CliRunner().invoke(check, [str(tmp_path / "notes.txt")])
    assert done.exit_code == 1 and done.output == (
        f"Error: {tmp_path / 'notes.txt'} is no notebook: its name does not end in .ipynb;"
        " give the lesson's own file\n"
    )
    folder = f"Error: {tmp_path} is a folder; give the lesson itself, such as"
    done = CliRunner().invoke(check, [str(tmp_path)])
    assert done.exit_code == 1 and done.output == f"{folder} my_lessons/02_images_as_messages.ipynb\n"
    (tmp_path / "03_mine.ipynb").write_text("")
    done = CliRunner().invoke(check, [str(tmp_path)])
    assert done.exit_code == 1 and done.output == f"{folder} {tmp_path / '03_mine.ipynb'}\n"


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
    assert list(report_lines(handin))[-1] == (
        "Complete, but grading would not give every point yet: see above."
    )


def test_an_answer_that_is_wrong_is_not_called_ready_when_it_is_not_run(hand_in):
    path = hand_in(edit(ANSWER, source="def double(pixels): return pixels * 2"))
    done = CliRunner().invoke(check, [str(path)])
    assert done.exit_code == 0 and "eady" not in done.output
    assert done.output.endswith(f"This does not run them; `imgproc-course check --run {path}` does.\n")


def test_a_refused_module_is_told_before_the_error_that_it_leads_to(hand_in):
    source = "import cv2\ndef double(pixels): return cv2.add(pixels)"
    handin = run(hand_in(edit(ANSWER, source=source)))
    assert handin.entries[0].notes[0] == "it uses cv2, which this exercise refuses"
    assert handin.entries[0].notes[1].startswith("1 of 1 checks fail: Bright pixels: double() raised")


def test_an_answer_that_still_raises_its_stubs_error_is_not_attempted(hand_in):
    source = 'def double(pixels):\n    half = 3\n    raise NotImplementedError("later")'
    handin = run(hand_in(edit(ANSWER, source=source)))
    assert handin.entries[0].state == "not attempted" and not handin.ready


def test_an_answer_that_needs_another_cell_is_told(hand_in):
    handin = run(hand_in(edit(ANSWER, source="x = y + 1\ndef double(pixels): return x")))
    assert "its cell does not run by itself: NameError: name 'y' is not defined" in handin.entries[0].notes[0]
    assert not handin.ready


def test_the_command_says_it_and_fails_while_not_ready(hand_in):
    done = CliRunner().invoke(check, ["--run", str(hand_in())])
    assert done.exit_code == 0 and done.output.endswith("Ready to hand in: every check passes.\n")
    done = CliRunner().invoke(check, [str(hand_in(solved=False))])
    assert done.exit_code == 1 and "template-double: not attempted" in done.output
    done = CliRunner().invoke(check, ["nothing.ipynb"])
    assert done.exit_code == 1 and "Error: nothing.ipynb: no such file" in done.output
