"""One cause of several failures is told once, and what the sandbox refused is listed as what it is."""

import html
import json

import pytest
from nbclassroom.gradebook.grade import grade_submissions
from submissions import answers_of, notebook, write

pytestmark = pytest.mark.sandbox
DOUBLE = "def double(pixels):\n    return np.minimum(pixels.astype(int) * two(), 255).astype(np.uint8)"
HALVES = "def halves(pixels):\n    return pixels[:two()], pixels[two():]"
USE_TWO = {"light-double": DOUBLE, "light-halves": HALVES}
USE_TIP = {id: source.replace("two()", "2") for id, source in USE_TWO.items()}
ENDLESS = "import os\ndef double(pixels):\n    os.system('rm -rf /')\n    while True:\n        pass"
HOSTILE = """
import socket, subprocess
try:
    socket.create_connection(("192.0.2.1", 80))
except OSError:
    subprocess.run(["true", "gus"])
import matplotlib.pyplot as plt
plt.plot([1])
open("own.txt", "w").close()
open("/content/drive.txt", "w")
"""
READING = """
import os, pathlib
open("../up", "w"), next(os.walk("/"))
try: open(b"/tmp/../etc")
except OSError: pass
try: pathlib.Path("/usr/up").unlink()
except OSError: os._exit(3)
"""
MACHINE = """
import pathlib, platform, shutil, tempfile
pathlib.Path("mine").mkdir()
open("mine/../log.txt", "w").close()
pathlib.Path("log.txt").absolute().unlink()
shutil.rmtree("mine")
with tempfile.TemporaryDirectory() as folder:
    open(folder + "/x", "w").close()
(pathlib.Path.home() / "x").touch()
open("/dev/null", "w").close()
print(platform.processor(), platform.freedesktop_os_release())
"""
LOST = "def halves(pixels):\n    return lost"
CLASS = {  # {learner: (their first cell, their answers)}
    "syntax": ("def two():\n    retrun 2", USE_TWO),
    "statement": ("two = len(3)", USE_TWO),
    "call": ("def two():\n    retrun (2)", USE_TWO),
    "module": ("import cv9 as np\ntwo = np.two", USE_TWO),
    "answer": ("x = 1", USE_TWO | {"light-double": f"def two():\n    retrun 2\n{DOUBLE}"}),
    "default": ("two = len(3)", USE_TWO | {"light-double": "def double(p, most=two()):\n    return p"}),
    "apart": (MACHINE, {"light-double": "def double(p):\n    return lost(p)", "light-halves": LOST}),
    "long": ("x = 1", {"light-double": f"{'#' * 200_000}\n{DOUBLE}"}),
    "tip": (HOSTILE.replace("gus", "tip"), USE_TIP),
    "gus": (HOSTILE, {"light-double": ENDLESS, "light-halves": READING}),
}


@pytest.fixture(scope="module")
def graded(light, key_path, tmp_path_factory):
    """The folder of a class's grades."""
    folder = tmp_path_factory.mktemp("causes")
    for name, (source, answers) in CLASS.items():
        made = notebook(light, answers)
        cell = {"id": "own", "cell_type": "code", "metadata": {}, "source": source}
        made["cells"].insert(0, cell | {"outputs": [], "execution_count": None})
        write(folder / "in" / name / "20_light.ipynb", made)
    grade_submissions(folder / "in", [key_path], folder / "out", workers=1)
    return folder / "out"


def parts_of(graded, name):
    """What the page of a learner shows of each exercise."""
    (page,) = (graded / "learners").glob(f"{name}-*.html")
    return html.unescape(page.read_text(encoding="utf-8")).split('<div class="exercise">')[1:]


def rows_of(graded, heading, name):
    text = (graded / "summary.html").read_text(encoding="utf-8")
    section = html.unescape(text.partition(f"<h2>{heading}</h2>")[2].partition("</section>")[0])
    return [row for row in section.split("<tr>") if f"<bdi>{name}</bdi>" in row]


CELL = 'The cell that begins with "{}" does not work, and this exercise needs it ({}). Mend it first.'
TOLD = {
    "syntax": CELL.format("def two():", "SyntaxError: invalid syntax, line 2: retrun 2"),
    "statement": CELL.format("two = len(3)", "TypeError: object of type 'int' has no len()"),
    "default": CELL.format("two = len(3)", "TypeError: object of type 'int' has no len()"),
    "call": CELL.format("def two():", "name 'retrun' is not defined. Did you mean return?"),
    "module": "Write this exercise without cv9.",
    "answer": 'SyntaxError: invalid syntax (<cell>, line 2).</p><div class="paragraph">Look at this line',
}


@pytest.mark.parametrize("name", TOLD)
def test_one_cause_is_told_once_with_its_place(graded, name):
    double, halves = parts_of(graded, name)
    assert TOLD[name] in double
    assert 'It fails for the same reason as "Twice as bright": mend that first.' in halves
    for hint in ("Nothing has the name", "Is the name misspelled", "given pixels", "Hint:"):
        assert hint not in halves and (hint not in double)


@pytest.mark.parametrize("name", TOLD)
def test_the_summary_has_one_row_for_one_cause_with_the_lines_of_all(graded, name):
    heading = "May have lost points unfairly"
    heading = "Modules that the exercise does not allow" if name == "module" else heading
    (row,) = rows_of(graded, heading, name)
    assert "<li>for the same reason: light-halves</li>" in row
    points = "?" if name == "module" else "3"
    lines = [f"{name},light,{id},{points},looked at by hand" for id in ("light-double", "light-halves")]
    assert "<code>" + "\n".join(lines) + "</code>" in row


def test_two_answers_that_each_have_a_slip_of_their_own_are_told_apart(graded):
    for part in parts_of(graded, "apart"):
        assert "Nothing has the name lost here" in part or "NameError" in part
        assert "for the same reason" not in part


def test_what_the_sandbox_refused_is_listed_with_what_was_tried(graded):
    lesson, double, halves = rows_of(graded, "Hostile answers", "gus")
    assert "<li>it tried to open the network (192.0.2.1)</li>" in lesson
    assert "<li>it tried to start a program (true gus)</li>" in lesson and ".txt" not in lesson
    assert lesson.count("<li>") == 2 and "gus,light,,?," in lesson
    assert "<li>light-double: it tried to start a program (rm -rf /)</li>" in double
    tried = "read files (/)", "read files (/tmp/../etc)", "write files (../up)", "remove files (/usr/up)"
    for text in (*tried, "end Python (os._exit)"):
        assert f"<li>light-halves: it tried to {text}</li>" in halves
    (tip,) = rows_of(graded, "Also unusual", "tip")  # a cell of their own, and all points
    assert "<li>it tried to start a program (true tip)</li>" in tip
    (long,) = rows_of(graded, "May have lost points unfairly", "long")
    assert "its answer is longer than 200000 characters" in long.lower()
    assert "No check could use your answer" not in parts_of(graded, "long")[0]
    assert not [name for name in CLASS if name != "gus" and rows_of(graded, "Hostile answers", name)]


def test_a_hostile_answer_gets_no_advice(graded):
    double, _ = parts_of(graded, "gus")
    assert "double() used more than 1 s of processor time." in double
    assert "loop" not in double and "Hint" not in double


def test_attempts_are_findings_for_the_teacher_alone(graded):
    grades = json.loads((graded / "grades.json").read_text(encoding="utf-8"))
    (gus,) = [learner for learner in grades["learners"] if learner["name"] == "gus"]
    kinds = {finding["kind"] for finding in gus["lessons"][0]["findings"]}
    assert "hostile" in kinds and "tried to" not in "".join(parts_of(graded, "gus"))


def test_a_share_is_of_what_was_handed_out(masters, key_path, submissions, tmp_path):
    for name, lessons in {"ada": ("light", "sound"), "bob": ("light",)}.items():
        for lesson in lessons:
            made = notebook(masters[lesson], answers_of(masters[lesson], "right"))
            write(submissions / name / f"{lesson}.ipynb", made)
    for expected in (60, 100):  # bob's share, of 10 points; then nobody has sent the other lesson
        grade_submissions(submissions, [key_path], tmp_path / "out", workers=1)
        (row,) = rows_of(tmp_path / "out", "Learners", "bob")
        assert f'<td class="number">{expected} %</td>' in row
        text = (tmp_path / "out" / "summary.html").read_text(encoding="utf-8")
        assert f"<b>{(100 + expected) // 2} %</b>mean" in text
        (submissions / "ada" / "sound.ipynb").unlink(missing_ok=True)
