"""A hand-out: lessons without outputs, their checks, and solutions only if the teacher says so."""

import json
import zipfile

import nbformat
import pytest
from click.testing import CliRunner
from nbclassroom.authoring.lesson_files import without_outputs

from imgproc_course.cli import main

SUM = nbformat.v4.new_code_cell("2 + 3", id="sums-1", execution_count=1)
SUM.outputs = [nbformat.v4.new_output("execute_result", {"text/plain": "5"}, execution_count=1)]
CHECK = nbformat.v4.new_code_cell('check("sums-double", double)', id="check-sums-double-1")


def write_lesson(path, *cells):
    path.parent.mkdir(exist_ok=True)
    nbformat.write(nbformat.v4.new_notebook(cells=list(cells)), path)


@pytest.fixture
def lessons(tmp_path):
    """A teacher's folder: two lessons, a glossary, and files that are not for learners."""
    folder = tmp_path / "lessons"
    write_lesson(folder / "01_sums.ipynb", SUM, CHECK)
    write_lesson(folder / "02_words.ipynb", nbformat.v4.new_markdown_cell("# Words", id="words-1"))
    write_lesson(folder / "index.ipynb", SUM)
    for name in (
        "checks/sums.json",
        "solutions/sums.json",
        "texts/sums.json",
        "sums.py",
        "masters/01_sums.py",
        "key/answers.json",
        "key.seed",
        "glossary.md",
        "notes.md",
    ):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(name)
    return folder


@pytest.fixture
def hand_out(lessons, tmp_path):
    """Runs the command; returns its exit code and its text."""

    def run(*options, folder=tmp_path / "handout", source=lessons):
        result = CliRunner().invoke(main, ["handout", str(folder), "--from", str(source), *options])
        assert not result.exception or isinstance(result.exception, SystemExit)
        return result.exit_code, result.output

    return run


def files_in(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()
    }


def test_learners_get_lessons_without_outputs_and_their_checks(hand_out, tmp_path):
    assert hand_out() == (0, f"Lessons handed out: 2, without solutions, in {tmp_path}/handout/\n")
    files = files_in(tmp_path / "handout")
    assert sorted(files) == [
        ".course.json", "01_sums.ipynb", "02_words.ipynb", "checks/sums.json", "glossary.md", "index.ipynb",
        "sums.py", "texts/sums.json",
    ]  # fmt: skip
    assert files["sums.py"] == b"sums.py"
    assert files["checks/sums.json"] == b"checks/sums.json"
    for name in ("01_sums.ipynb", "index.ipynb"):
        cell = json.loads(files[name])["cells"][0]
        assert (cell["source"], cell["outputs"], cell["execution_count"]) == (["2 + 3"], [], None)


def test_solutions_only_if_the_teacher_says_so(hand_out, tmp_path):
    assert hand_out("--with-solutions")[1].startswith("Lessons handed out: 2, with solutions")
    assert files_in(tmp_path / "handout")["solutions/sums.json"] == b"solutions/sums.json"


@pytest.mark.parametrize("name", ["01", "sums", "01_sums"])
def test_one_lesson(hand_out, tmp_path, name):
    hand_out(name)
    assert sorted(files_in(tmp_path / "handout")) == [
        ".course.json", "01_sums.ipynb", "checks/sums.json", "glossary.md", "index.ipynb",
        "sums.py", "texts/sums.json",
    ]  # fmt: skip


def test_links_to_lessons_that_are_left_out_are_plain_text(hand_out, lessons, tmp_path):
    text = "See [lesson 01, Sums](01_sums.ipynb#cell-id=sums-1), [Words](02_words.ipynb), and [this](a.md)."
    write_lesson(lessons / "index.ipynb", nbformat.v4.new_markdown_cell(text, id="index-1"))
    assert hand_out("words")[0] == 0
    (cell,) = nbformat.read(tmp_path / "handout" / "index.ipynb", as_version=4).cells
    assert cell.source == "See lesson 01, Sums, [Words](02_words.ipynb), and [this](a.md)."
    assert hand_out(folder=tmp_path / "all")[0] == 0
    (cell,) = nbformat.read(tmp_path / "all" / "index.ipynb", as_version=4).cells
    assert cell.source == text


def test_a_zip_file_holds_the_same_files(hand_out, tmp_path):
    assert hand_out("--zip")[1].endswith(f"in {tmp_path}/handout/ and {tmp_path}/handout.zip\n")
    with zipfile.ZipFile(tmp_path / "handout.zip") as archive:
        entries = {(entry.date_time, entry.external_attr) for entry in archive.infolist()}
        packed = {name.removeprefix("handout/"): archive.read(name) for name in archive.namelist()}
    assert packed == files_in(tmp_path / "handout")
    assert entries == {((1980, 1, 1, 0, 0, 0), 0o644 << 16)}
    before = (tmp_path / "handout.zip").read_bytes()
    assert hand_out("--zip")[0] == 0  # the same again changes nothing
    assert (tmp_path / "handout.zip").read_bytes() == before


def test_a_file_that_differs_is_never_replaced(hand_out, lessons, tmp_path):
    hand_out()
    before = files_in(tmp_path / "handout")
    (tmp_path / "handout" / "02_words.ipynb").write_text("a learner's work")
    (lessons / "glossary.md").unlink()
    write_lesson(lessons / "03_more.ipynb", SUM)
    code, text = hand_out()
    assert (code, text) == (
        1,
        f"Error: {tmp_path}/handout/02_words.ipynb exists already and differs, and nothing was written;"
        " give another folder, or move the files away\n",
    )
    after = files_in(tmp_path / "handout")
    assert after == before | {"02_words.ipynb": b"a learner's work"}


@pytest.mark.parametrize(
    ("options", "damage", "message"),
    [
        (("nouns",), None, "'nouns' names no lesson: 01_sums, 02_words"),
        ((), "checks/sums.json", "01_sums.ipynb has exercises, but checks/sums.json is missing beside it"),
        (("--with-solutions",), "solutions/sums.json", "but solutions/sums.json is missing"),
    ],
)
def test_what_is_missing_is_named(hand_out, lessons, tmp_path, options, damage, message):
    if damage:
        (lessons / damage).unlink()
    code, text = hand_out(*options)
    assert code == 1 and message in text and len(text.splitlines()) == 1
    assert not (tmp_path / "handout").exists()


def test_a_folder_without_lessons_and_a_lesson_that_is_no_notebook(hand_out, lessons, tmp_path):
    assert hand_out(source=tmp_path)[1].startswith(f"Error: no notebooks in {tmp_path}")
    (lessons / "02_words.ipynb").write_text("{")
    assert hand_out() == (1, "Error: 02_words.ipynb is not a notebook; build the lessons again\n")


def test_a_hand_out_does_not_land_among_the_lessons(hand_out, lessons):
    for folder in (lessons, lessons / "handout"):
        before = files_in(lessons)
        code, text = hand_out(folder=folder)
        assert code == 1 and "is in the folder of the lessons" in text and files_in(lessons) == before


@pytest.mark.parametrize(
    "data", [b"", b"[]", b"null", b"\xff", b'{"cells": 3}', b'{"cells": [{"cell_type": "code"}]}']
)
def test_a_file_that_is_no_notebook_stays_as_it_is(data):
    assert without_outputs(data) == data


def test_a_cell_can_be_tagged_to_keep_its_output():
    kept, cleared = (SUM.copy() | {"metadata": {"tags": tags}} for tags in (["keep-output"], []))
    copy = json.loads(without_outputs(json.dumps({"cells": [kept, cleared]}).encode()))
    assert copy["cells"] == [kept, cleared | {"outputs": [], "execution_count": None}]


def test_a_notebook_without_outputs_keeps_its_bytes():
    data = json.dumps({"cells": [{"cell_type": "code", "outputs": [], "execution_count": None}]}).encode()
    assert without_outputs(data) == data
