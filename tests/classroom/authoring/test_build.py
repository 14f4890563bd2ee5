"""Masters become lessons: the same in every build, and without the solutions."""

import base64
import json
import os
import re
import shutil
from importlib.metadata import version

import nbformat
import pytest
from nbclassroom.authoring.build import build, compare_lessons

# Cells whose output is hard to reproduce.
EXTRAS = """

# %%
import os
import sys

print("one")
print("a warning", file=sys.stderr)
print("two")
# C code prints so, as ROS does at any time for its log
_ = os.write(2, b"[INFO] [1.25] [camera]: a topic has 1 subscriber\\n")

# %% tags=["nbval-ignore-output"]
print(os.urandom(4).hex())

# %%
# Check: a varying output
assert os

# %% tags=["nbval-raises-exception"]
int("three")

# %%
import base64

from IPython.display import Image

Image(data=base64.b64decode("IMAGE_DATA"), format="png")

# %%
from ipywidgets import Label

Label("a widget")

# %% role="predict"
guess_sum = None  # your guess: which number?

# %%
from imgproc_course.exercises import compare_guess

compare_guess(guess_sum, 2 + LIMIT)

# %%
# Check: the sum
assert 2 + LIMIT == 257
"""
# A PNG of one pixel with a date and a program's name, as matplotlib and cameras write them.
NOTED_PNG = (
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAAB3RJTUUH6gsVCgAAZouBLgAAABJ0RVh0U29mdHdhcmUAYSBwcm9n"
    "cmFtmsrMTQAAAApJREFUeJxjYAAAAAIAAUivpHEAAAAASUVORK5CYII="
)


@pytest.fixture(scope="module")
def built(tmp_path_factory, template):
    """The template with the extras, built once: its folders, and the master."""
    folder = tmp_path_factory.mktemp("built")
    masters = folder / "masters"
    masters.mkdir()
    master = masters / "90_template.py"
    master.write_text(template + EXTRAS.replace("IMAGE_DATA", NOTED_PNG), encoding="utf-8")
    lines = []
    result = build(masters, folder / "lessons", folder / "solved", progress=lines.append)
    assert result.problems == []
    return folder, lines


def cells_of(path):
    return {cell.id: cell for cell in nbformat.read(path, as_version=4).cells}


def test_a_lesson_shows_the_stub_and_nothing_of_the_grading(built):
    folder, _ = built
    text = (folder / "lessons" / "90_template.ipynb").read_text()
    for hidden in ("np.minimum", "def inputs", "pixels * 2", "Widen", "exercise(", "Any pixels", "role"):
        assert hidden not in text
    cells = cells_of(folder / "lessons" / "90_template.ipynb")
    check = cells["check-template-double-1"]
    assert "not attempted yet" in check.outputs[0].data["text/plain"]
    assert check.metadata == {"editable": False, "deletable": False}
    answer = cells["answer-template-double"]
    assert answer.metadata == {"deletable": False, "imgproc_course": {"exercise": "template-double"}}


def test_the_solved_twin_passes_its_checks(built):
    folder, _ = built
    solved = cells_of(folder / "solved" / "90_template.ipynb")
    assert "np.minimum" in solved["answer-template-double"].source
    assert (
        "template-double: the check passes."
        in solved["check-template-double-1"].outputs[0].data["text/plain"]
    )
    assert list(solved) == list(cells_of(folder / "lessons" / "90_template.ipynb"))


def test_a_learner_can_write_a_guess_but_not_delete_its_cell(built):
    folder, _ = built
    cells = list(cells_of(folder / "lessons" / "90_template.ipynb").values())[-3:]
    assert [cell.metadata for cell in cells] == [
        {"deletable": False},
        {},
        {"jupyter": {"source_hidden": True}},  # JupyterLab shows the first line of this cell
    ]
    assert cells[0].id == "predict-template-1"
    assert cells[1].outputs[0].data["text/plain"] == "No guess yet. The result is 257."


def test_the_metadata_name_the_lesson_and_no_machine(built):
    folder, _ = built
    notebook = nbformat.read(folder / "lessons" / "90_template.ipynb", as_version=4)
    assert notebook.metadata == {
        "imgproc_course": {
            "lesson": "template",
            "title": "Doubling",
            "minutes": 5,
            "core_minutes": 5,
            "deeper": [],
            "version": version("imgproc-course"),
        },
        "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
        "language_info": {"name": "python", "file_extension": ".py", "mimetype": "text/x-python"},
    }
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    assert all("execution" not in cell.metadata for cell in notebook.cells)


def outputs_of(built, position):
    folder, _ = built
    return cells_of(folder / "lessons" / "90_template.ipynb")[f"template-{position}"].outputs


def test_streams_are_merged_with_stdout_first_and_without_the_log_of_c_code(built):
    assert [(out.name, out.text) for out in outputs_of(built, 7)] == [
        ("stdout", "one\ntwo\n"),
        ("stderr", "a warning\n"),
    ]


def test_a_planned_failure_is_stored(built):
    (error,) = outputs_of(built, 10)
    assert (error.ename, error.evalue) == ("ValueError", "invalid literal for int() with base 10: 'three'")


def test_images_lose_their_date_and_program(built):
    (image,) = outputs_of(built, 11)
    raw = base64.b64decode(image.data["image/png"])
    assert b"IDAT" in raw and b"IEND" in raw
    assert b"tIME" not in raw and b"tEXt" not in raw


def test_widgets_leave_no_model(built):
    (widget,) = outputs_of(built, 12)
    assert list(widget.data) == ["text/plain"]
    folder, _ = built
    assert "widget-state" not in (folder / "lessons" / "90_template.ipynb").read_text()


def test_progress_names_the_lesson(built):
    _, lines = built
    assert lines[0] == "90_template ..."
    assert lines[1].startswith("90_template: ") and lines[1].endswith(" s")


def test_building_again_changes_nothing(built):
    folder, _ = built
    path = folder / "lessons" / "90_template.ipynb"
    before = path.read_bytes()
    assert compare_lessons(folder / "masters", folder / "lessons", progress=str).problems == []
    result = build(folder / "masters", folder / "lessons", folder / "solved", ["90"], progress=str)
    assert result.problems == [] and result.built == ["90_template"]
    assert path.read_bytes() == before
    names = sorted(p.name for p in path.parent.iterdir())
    assert names == ["90_template.ipynb", "checks"]  # no temporary file is left


def test_a_difference_is_named_with_lesson_and_cell(built, tmp_path):
    folder, _ = built
    notebook = json.loads((folder / "lessons" / "90_template.ipynb").read_text())
    cells = {cell["id"]: cell for cell in notebook["cells"]}
    cells["template-7"]["outputs"][0]["text"] = ["one\n", "three\n"]
    cells["template-8"]["outputs"] = []  # varies: not compared
    cells["template-11"]["outputs"][0]["data"]["image/png"] = "AAAA"
    cells["answer-template-double"]["source"] = ["def double(pixels): ..."]
    notebook["metadata"]["imgproc_course"]["version"] = "0.0.1"
    (tmp_path / "90_template.ipynb").write_text(json.dumps(notebook))
    (tmp_path / "80_gone.ipynb").write_text(json.dumps(notebook))
    shutil.copytree(folder / "lessons" / "checks", tmp_path / "checks")
    (tmp_path / "checks" / "gone.json").write_text("{}")
    problems = compare_lessons(folder / "masters", tmp_path, progress=str).problems
    assert [problem.splitlines()[0] for problem in problems] == [
        "90_template.ipynb: the lesson's metadata (title, minutes, version) differ",
        "90_template.ipynb: cell answer-template-double: its source differs from the master",
        "90_template.ipynb: cell template-7: its outputs differ from the stored ones",
        "90_template.ipynb: cell template-11: its outputs differ from the stored ones",
        "80_gone.ipynb: it has no master; delete it, or restore its master",
        "gone.json: it has no master; delete it, or restore its master",
    ]
    assert "stored: one three" in problems[2] and "now:    one two" in problems[2]


def test_a_lesson_that_was_never_built_is_named(write_master, tmp_path):
    path = write_master()
    problems = compare_lessons(path.parent, tmp_path, progress=str).problems
    assert problems == [
        "90_template.ipynb: not built yet, or not a notebook; run imgproc-course build",
        "checks/template.json: not built yet; run imgproc-course build",
    ]


@pytest.mark.parametrize(
    ("added", "message"),
    [
        ("\n# %%\n1 / 0\n", "90_template.py: cell template-7: ZeroDivisionError: division by zero"),
        ("\n# %%\nprint(np.__file__)\n", "template-7: its output contains a path of this machine"),
        ("\n# %%\nobject()\n", "template-7: its output contains the address 0x"),
        (
            '\n# %% tags=["nbval-raises-exception"]\nx = 1\n',
            "template-7: tagged nbval-raises-exception, but",
        ),
        ("\n# %%\nimport os\n\nos._exit(1)\n", "90_template.py: cell template-7: the kernel died"),
    ],
)
def test_a_cell_that_cannot_be_stored_is_named_and_the_stored_lesson_stays(
    write_master, tmp_path, added, message
):
    path = write_master(add=added)
    stored = tmp_path / "lessons" / "90_template.ipynb"
    stored.parent.mkdir()
    stored.write_text("the stored one")
    result = build(path.parent, stored.parent, tmp_path / "solved", progress=str)
    assert result.built == []
    assert len(result.problems) == 1 and message in result.problems[0]
    assert stored.read_text() == "the stored one"


def test_one_bad_lesson_does_not_block_another(write_master, tmp_path):
    write_master(("title: Doubling", "title: ''"), name="80_bad")
    path = write_master(("template-double", "template-twice"))
    result = build(path.parent, tmp_path / "lessons", tmp_path / "solved", progress=str)
    assert result.built == ["90_template"]
    assert "80_bad.py: the front matter needs" in result.problems[0]


def test_a_check_whose_answer_can_be_copied_is_named_with_its_line(write_master, tmp_path):
    path = write_master(("return (rng.integers(100, 256, (3, 4), dtype=np.uint8),)", "return (np.eye(3),)"))
    (problems,) = build(path.parent, tmp_path / "lessons", tmp_path / "solved", progress=str).problems
    match = re.search(r"90_template.py, line (\d+): case-template-double-1: inputs\(rng\) ignores", problems)
    assert path.read_text().splitlines()[int(match[1]) - 1].startswith('# %% role="case"')


def test_the_kernel_sees_no_other_robot_and_no_backend_setting(write_master, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    names = ("MPLBACKEND", "ROS_AUTOMATIC_DISCOVERY_RANGE")
    code = "import os\n\n" + "\n".join(f"print(os.environ[{name!r}])" for name in names)
    path = write_master(add=f"\n# %%\n{code}\nprint(sorted(os.listdir()))\n")
    build(path.parent, tmp_path / "lessons", tmp_path / "solved", progress=str)
    printed = cells_of(tmp_path / "lessons" / "90_template.ipynb")["template-7"].outputs[0].text
    assert (
        printed
        == "module://matplotlib_inline.backend_inline\nLOCALHOST\n['.ipython', 'checks', 'solutions']\n"
    )
    assert os.environ["MPLBACKEND"] == "agg"
