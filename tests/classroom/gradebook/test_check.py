"""`imgproc-course check`: what a learner reads before submitting a lesson."""

import io
import json
import sys

import nbformat
import pytest
from click.testing import CliRunner
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.authoring.masters import read_master
from nbclassroom.cli import check
from nbclassroom.gradebook import check as check_module
from nbclassroom.gradebook.check import check_lesson, report_lines, run_answers
from template_master import write_carried_files

pytestmark = pytest.mark.usefixtures("one_fork_server")


@pytest.fixture
def lesson(write_master, tmp_path):
    """Writes a learner's notebook, changed by a function, and returns its path."""

    def write(change=lambda cells: None, *, solved=True):
        master = read_master(write_master())
        write_carried_files(master, tmp_path)
        notebook = json.loads(nbformat.writes(lesson_notebook(master, solved=solved)))
        cells = {cell["id"]: cell for cell in notebook["cells"]}
        change(cells)
        notebook["cells"] = [cell for cell in cells.values() if cell is not None]
        path = tmp_path / "my_lesson.ipynb"
        path.write_text(json.dumps(notebook), encoding="utf-8")
        return path

    return write


ANSWER = "answer-template-double"


def inspect(path):
    lesson_check = check_lesson(path)
    (entry,) = lesson_check.exercises
    return lesson_check, entry.state, " ".join(entry.notes)


def test_an_answered_lesson_is_ready(lesson):
    lesson_check, state, notes = inspect(lesson())
    assert lesson_check.ready and state == "answered" and notes == ""
    assert list(report_lines(lesson_check)) == [
        "my_lesson.ipynb: template",
        "  template-double: answered",
        "Complete: every answer cell is there and filled in. The answers were not run;"
        f" `imgproc-course check --run {lesson_check.path}` runs them.",
    ]


def test_a_deeper_exercise_can_be_left_open(lesson):
    path = lesson(solved=False)
    notebook = json.loads(path.read_text())
    notebook["metadata"]["imgproc_course"]["deeper"] = ["template-double"]
    path.write_text(json.dumps(notebook))
    lesson_check, state, _ = inspect(path)
    assert lesson_check.ready and state == "not attempted"
    lines = list(report_lines(lesson_check))
    assert lines[1] == "  template-double (deeper): not attempted"
    assert lines[-2].startswith("The core is complete: every answer cell of it is there and filled in.")
    assert lines[-1] == "1 deeper exercise is open: it gives points, too."


def edit(id, **fields):
    return lambda cells: cells[id].update(fields)


def remove(id):
    return lambda cells: cells.update({id: None})


MISSING = "its answer cell (answer-template-double) is missing"


def test_an_answer_that_would_get_no_points_is_reported(lesson):
    lesson_check, found, notes = inspect(lesson(remove(ANSWER)))
    assert found == "missing" and not lesson_check.ready
    assert f"{MISSING} Open the lesson afresh" in notes


def test_the_lessons_own_function_of_that_name_is_not_a_misplaced_answer(lesson, write_master):
    path = lesson(remove(ANSWER))
    changed = write_master(("LIMIT = 255", "LIMIT = 255\n\ndef double(pixels):\n    return pixels"))
    write_carried_files(read_master(changed), path.parent)
    notebook = json.loads(path.read_text())
    given = next(cell for cell in notebook["cells"] if cell["id"] == "given-template-double-1")
    given["source"] += "\n\ndef double(pixels):\n    return pixels"
    path.write_text(json.dumps(notebook))
    _, _, notes = inspect(path)
    assert f"{MISSING} Open the lesson afresh" in notes


def test_the_checks_beside_the_lesson_are_used_and_no_master(lesson, tmp_path):
    path = lesson()
    (tmp_path / "masters" / "90_template.py").unlink()
    assert check_lesson(path).ready
    (tmp_path / "checks" / "template.json").write_text('{"template-double": ')
    done = CliRunner().invoke(check, [str(path)])
    assert done.exit_code == 1 and done.output.startswith("Error: checks/template.json cannot be read (")
    assert done.output.endswith("take the folder checks/ again from the course or from your teacher\n")


def test_a_file_that_is_not_a_notebook_is_answered_with_the_remedy(tmp_path):
    path = tmp_path / "my_lesson.ipynb"
    path.write_bytes(b"{")
    with pytest.raises(ValueError) as error:
        check_lesson(path)
    text = "it is not a notebook: its JSON is broken (line 1); save it again in JupyterLab"
    assert str(error.value) == f"{path}: {text}"


def test_a_large_file_is_not_read(lesson, monkeypatch):
    monkeypatch.setattr(check_module, "LARGEST", 100)
    with pytest.raises(match="it has 0 MB, at most 0 are read: clear its outputs"):
        check_lesson(lesson())


def test_a_notebook_that_a_browser_saved_as_text_is_checked(lesson):
    path = lesson()
    assert check_lesson(path.rename(path.with_name("my_lesson.ipynb.txt"))).ready


@pytest.mark.parametrize(
    ("name", "problem"),
    [("notes.txt", "is no notebook"), ("", "is a folder"), ("20_light.ipynb", "does not exist")],
)
def test_what_is_no_lesson_is_one_line(tmp_path, name, problem):
    (tmp_path / "notes.txt").write_text("hello")
    done = CliRunner().invoke(check, [str(tmp_path / name)])
    assert done.exit_code == 1 and done.output == (
        f"Error: {tmp_path / name} {problem}; give the lesson that you want to submit, such as"
        " my_lessons/03_images_as_messages.ipynb\n"
    )


# ---------------------------------------------------------------- running the answers


def run(path):
    lesson_check = check_lesson(path)
    run_answers(lesson_check)
    return lesson_check


def test_the_terminal_shows_nothing_that_an_answer_prints_or_asks(lesson, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO("Ada"))
    noise = 'print("x" * 9_000)\nimport sys\nprint("y", file=sys.stderr)\nname = input("Your name?")\n'

    def add_noise(cells):
        cells[ANSWER]["source"] = f"{noise}{''.join(cells[ANSWER]['source'])}\nsys.exit(0)"

    lesson_check = run(lesson(add_noise))
    assert all(case.passed for case in lesson_check.exercises[0].result.cases)
    program, failure = lesson_check.exercises[0].notes
    assert program.startswith("line 4, input('Your name?'), belongs to a program")
    assert failure.startswith("a statement in its cell fails: RuntimeError: input() waits for a person")
    assert capsys.readouterr() == ("", "")
    assert sys.stdin.read() == "Ada"


def test_a_wrong_answer_is_explained(lesson):
    lesson_check = run(lesson(edit(ANSWER, source="def double(pixels): return pixels * 2")))
    title, text, *_ = lesson_check.exercises[0].notes
    assert title.startswith("✗ Bright pixels (0 of ") and text.startswith("    11 of 12 values differ")
    assert list(report_lines(lesson_check))[-1] == (
        "Complete, but grading would not give every point yet: see above."
    )


def test_a_wrong_answer_is_not_called_ready_if_it_was_not_run(lesson):
    path = lesson(edit(ANSWER, source="def double(pixels): return pixels * 2"))
    done = CliRunner().invoke(check, [str(path)])
    assert done.exit_code == 0 and "eady" not in done.output
    assert done.output.endswith(f"The answers were not run; `imgproc-course check --run {path}` runs them.\n")


def test_a_refused_module_is_reported_before_the_error_that_it_causes(lesson):
    source = "import cv2\ndef double(pixels): return cv2.add(pixels)"
    lesson_check = run(lesson(edit(ANSWER, source=source)))
    assert lesson_check.exercises[0].notes[0] == "Write this exercise without cv2."


def test_what_an_exception_means_is_said(lesson):
    notes = run(lesson(edit(ANSWER, source="def double(pixels): return pixels * 300"))).exercises[0].notes
    assert notes[1].endswith("OverflowError: Python integer 300 out of bounds for uint8")
    assert notes[3].startswith("    300 does not fit into uint8")


def test_an_answer_that_still_raises_the_stubs_error_is_not_attempted(lesson):
    source = 'def double(pixels):\n    half = 3\n    raise NotImplementedError("later")'
    lesson_check = run(lesson(edit(ANSWER, source=source)))
    assert lesson_check.exercises[0].state == "not attempted" and not lesson_check.ready


def test_an_answer_that_needs_another_cell_is_reported(lesson):
    lesson_check = run(lesson(edit(ANSWER, source="x = y + 1\ndef double(pixels): return x + 1")))
    cell_note, *notes = lesson_check.exercises[0].notes
    assert cell_note == "a statement in its cell fails: NameError: name 'y' is not defined"
    assert "NameError: x is not there, because the statement that defines it fails" in "".join(notes)
    lesson_check = run(lesson(edit(ANSWER, source="def double(pixels, more=y): return 3")))
    notes = lesson_check.exercises[0].notes
    assert notes[0] == "a statement in its cell fails: NameError: name 'y' is not defined"


@pytest.mark.parametrize(
    "imports",
    ["import cv2", "import cv2 as cv", "from imgproc_course.recording import open_recording"],
)
def test_a_cell_that_fails_without_a_refused_module_names_the_module(lesson, imports):
    """And not the name that is missing: another import of it would not help."""
    name, module = imports.split()[-1], imports.split()[1]
    source = f"{imports}\nframe = {name}.x\ndef double(pixels, sample=frame): return sample + 3"
    lesson_check = run(lesson(edit(ANSWER, source=source)))
    assert f"rite this exercise without {module}" in lesson_check.exercises[0].notes[0]


def test_the_exit_code_is_1_while_the_lesson_is_not_ready(lesson):
    done = CliRunner().invoke(check, ["--run", str(lesson())])
    assert done.exit_code == 0 and done.output.endswith("Ready to submit: every check passes.\n")
    assert "  template-double: 1 of 1 checks pass\n" in done.output
    done = CliRunner().invoke(check, [str(lesson(solved=False))])
    assert done.exit_code == 1 and "template-double: not attempted" in done.output


def test_an_answer_that_ends_python_is_named(lesson):
    source = "import os\n\ndef double(pixels):\n    os._exit(0)\n"
    assert run(lesson(edit(ANSWER, source=source))).exercises[0].notes[0] == "It ended its process."


def test_a_lesson_that_cannot_be_read_is_one_line(lesson, monkeypatch):
    path = lesson()
    monkeypatch.setattr(type(path), "read_bytes", lambda _path: path.parent.open("rb"))
    with pytest.raises(match=r"cannot be read \(Is a directory\); change its permissions"):
        check_lesson(path)


def test_of_several_lessons_a_missing_one_does_not_hide_the_others(lesson):
    done = CliRunner().invoke(check, ["nothing.ipynb", str(lesson())])
    assert done.exit_code == 1 and "Error: nothing.ipynb does not exist" in done.output
    assert "template-double: " in done.output.split("does not exist")[1]
