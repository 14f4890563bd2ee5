"""Attacks on the form of a submission: its cells, metadata, files, archives and names.

Each attack has wrong answers, tries to gain points by a trick, and is put into a folder of submissions
between honest ones. There is one for each form; what is refused of it, and in which words, is in
test_submission.py, test_collect.py and test_intake.py. The attacks by the source of an answer are in
tests/classroom/autograder/attacks.py.
"""

import io
import json
import os
import warnings
import zipfile
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from nbclassroom.autograder.sanitize import sanitize_line
from nbclassroom.gradebook.grade import grade_submissions
from submissions import answers_of, cell_of, make_zip, notebook, write

LESSON = "20_light"


@dataclass(frozen=True)
class FormAttack:
    """An attack; it is submitted by a learner of its own.

    put       function of the learner's folder, which does not exist yet, and the master
    reported  text that the instructor must find in the report; "" if there is nothing to report
    folder    name of the learner's folder, if this name is the attack
    never     (pattern, text) pairs: no file of the grades whose name fits the pattern may contain the text
    """

    name: str
    put: object
    reported: str = ""
    folder: str = ""
    never: tuple = ()

    @property
    def learner(self):
        """The learner's name in the grades."""
        return sanitize_line(self.folder_name, 120)

    @property
    def folder_name(self):
        return self.folder or self.name

    @property
    def neighbour(self):
        """The honest learner whose submission is graded after it."""
        return f"{self.name}, neighbour"


FORM_ATTACKS = []


def attack(name, reported="", **more):
    """Decorator: makes an attack of a function of (folder, master)."""

    def add(put):
        FORM_ATTACKS.append(FormAttack(name, put, reported, **more))
        return put

    return add


def of_cells(name, reported="", **more):
    """Decorator: makes an attack of a function that changes a notebook with wrong answers in place."""

    def add(change):
        def put(folder, light):
            lesson = wrong_notebook(light)
            change(lesson)
            write(folder / f"{LESSON}.ipynb", lesson)

        FORM_ATTACKS.append(FormAttack(name, put, reported, **more))
        return change

    return add


def wrong_notebook(light):
    """The lesson with wrong answers; a dict."""
    return notebook(
        light,
        {"light-double": "def double(p):\n    return p", "light-halves": "def halves(p):\n    return p"},
    )


# ---------------------------------------------------------------- cells and metadata


@of_cells("edited checks", "was changed")
def edit_checks(lesson):
    cell_of(lesson, "check-light-double-1")["source"] = "print('light-double: the check passes.')"


@of_cells("cells with the ids of hidden checks")
def _hidden_case_ids(lesson):
    for id in ("hidden-light-double-1", "case-light-double-1", "solution-light-double"):
        lesson["cells"].append({"id": id, "cell_type": "code", "metadata": {}, "source": "1", "outputs": []})


@of_cells(
    "outputs and widgets with a script", never=(("**/*.html", "<script>alert"), ("**/*.html", "onload="))
)
def _script_in_outputs(lesson):
    html = {"text/html": "<script>alert(1)</script>", "image/svg+xml": "<svg onload=alert(1)>"}
    state = {"application/vnd.jupyter.widget-state+json": {"state": html["text/html"]}}
    lesson["metadata"]["widgets"] = state
    shown = {"output_type": "display_data", "data": html, "metadata": {}}
    cell_of(lesson, "check-light-double-1")["outputs"] = [shown]


@of_cells("points, tags and a kernel that direct a grader")
def _directing_metadata(lesson):
    tags = ["nbval-skip", "nbval-raises-exception", "raises-exception"]
    for cell in lesson["cells"]:
        graded = {"nbgrader": {"points": 1000, "grade": True, "locked": False}, "points": 1000}
        cell["metadata"] = graded | {"tags": tags}
    lesson["metadata"]["imgproc_course"]["points"] = 1000
    lesson["metadata"]["kernelspec"] = {"name": "bash", "language": "bash", "argv": ["/bin/sh"]}


@attack("a notebook nested deeper than it is read", "nested too deep")
def _deep(folder, light):
    write(folder / f"{LESSON}.ipynb", b"[" * 100_000 + b"]" * 100_000)


@attack("two hundred megabytes", "it has 200 MB")
def _huge(folder, light):
    with write(folder / f"{LESSON}.ipynb", b"").open("wb") as file:
        file.truncate(200_000_000)


# ---------------------------------------------------------------- files, archives and names


def trap_of(folder):
    """The file that the code of an attack writes; this code must never run."""
    return folder.parents[1] / "trapped"


@attack("modules and settings of pytest beside the notebook")
def _modules_beside(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for name in ("numpy", "sitecustomize", "usercustomize", "coverage", "imgproc_course", "json"):
        write(folder / f"{name}.py", f"open({str(trap_of(folder))!r}, 'w').close()")
    write(folder / "conftest.py", f"open({str(trap_of(folder))!r}, 'w').close()")
    write(folder / "x.pth", f"import os; open({str(trap_of(folder))!r}, 'w').close()")
    write(folder / "pytest.ini", "[pytest]\naddopts = --nbval-lax")
    write(folder / "pyproject.toml", "[tool.pytest.ini_options]\naddopts = '--co'\n")


@attack("a link to a neighbour's notebook", "links are not followed")
def _link(folder, light):
    right = write(folder.parents[1] / "right.ipynb", notebook(light, answers_of(light, "right")))
    folder.mkdir(parents=True)
    (folder / f"{LESSON}.ipynb").symlink_to(right)


@attack("a pipe without a writer", "not a regular file")
def _pipe(folder, light):
    folder.mkdir(parents=True)
    os.mkfifo(folder / f"{LESSON}.ipynb")


@attack("a name in a zip that leads out of it", "leads out of the zip")
def _out_of_zip(folder, light):
    make_zip(folder / "work.zip", [(f"../../{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])


@attack("a zip bomb", "200 times its size")
def _bomb(folder, light):
    make_zip(folder / "work.zip", [(f"{LESSON}.ipynb", b"0" * 20_000_000)])


def _name(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


attack("a name that is options and marks", folder="-p x::[1] <b>\u202egpj.\nx")(_name)
attack(
    "a name that is a formula, also after a semicolon",
    folder='=cmd|"calc"!A1,x\t;=cmd|y',
    never=(("**/*.csv", '"=cmd'), ("**/*.csv", ";=cmd"), ("**/*.csv", "\t")),
)(_name)
attack(
    "a name that is a script", folder="<img src=x onerror=alert(1)>", never=(("**/*.html", "<img src=x"),)
)(_name)
attack(
    "the neighbour's name and a mark that nobody sees",
    folder="the neighbour's name and a mark that nobody sees, neighbour\u200b",
)(_name)


# ---------------------------------------------------------------- senders and budgets


@attack("an environment of 20,001 files")
def _environment(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    packages = folder / ".venv" / "lib"
    packages.mkdir(parents=True)
    for number in range(20_001):
        (packages / f"{number}.ipynb").touch()


@attack("a zip packed with LZMA", "unusual method")
def _unusual_packing(folder, light):
    folder.mkdir(parents=True)
    with zipfile.ZipFile(folder / "work.zip", "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))


@attack("a zip with a table of contents of 10 MB", "table of contents has")
def _huge_contents(folder, light):
    make_zip(folder / "work.zip", [(f"{number:05d}{'x' * 1000}.ipynb", b"") for number in range(10_000)])


@attack("a link to the folder of submissions, and links in a circle", "links are not followed")
def _links_in_a_circle(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    (folder / "all").symlink_to(folder.parent)
    (folder / "circle").symlink_to("circle")


@attack("one name twice in a zip", "submitted 2 times")
def _one_name_twice(folder, light):
    answers = [wrong_notebook(light), notebook(light, answers_of(light, "untouched"))]
    with warnings.catch_warnings(action="ignore"):
        make_zip(folder / "work.zip", [(f"{LESSON}.ipynb", json.dumps(lesson)) for lesson in answers])


@attack("a zip that asks for a password", "locked with a password")
def _password(folder, light):
    path = make_zip(folder / "work.zip", [(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])
    data = bytearray(path.read_bytes())
    for signature, place in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):  # the flags of a member: encrypted
        data[data.index(signature) + place] |= 1
    path.write_bytes(data)


@of_cells("a lesson's name that is a list, and answers that point at each other")
def _odd_metadata(lesson):
    lesson["metadata"]["imgproc_course"] = {"lesson": ["light"], "version": {"x": 1}}
    for id, exercise in (("light-double", "light-halves"), ("light-halves", "light-double")):
        cell_of(lesson, f"answer-{id}")["metadata"]["imgproc_course"] = {"exercise": exercise}


@of_cells("helper functions that read each other in a circle of hundreds")
def _circle(lesson):
    cell_of(lesson, "answer-light-double")["source"] = "def double(p):\n    return h0(p)"
    for number in range(600):
        source = f"def h{number}(p):\n    return h{(number + 1) % 600}(p)"
        lesson["cells"].append({"id": f"h{number}", "cell_type": "code", "metadata": {}, "source": source})


@of_cells("a source of a million lines of one letter", "longer than")
def _lines(lesson):
    cell_of(lesson, "answer-light-double")["source"] = ["#\n"] * 1_000_000 + ["def double(p): return p"]


@attack("a notebook with two lists of cells")
def _two_lists(folder, light):
    right, wrong = notebook(light, answers_of(light, "right")), wrong_notebook(light)
    text = json.dumps(wrong)
    write(folder / f"{LESSON}.ipynb", '{"cells": ' + json.dumps(right["cells"]) + ", " + text[1:])


@attack("folders with the names of notebooks and zips")
def _folders_named_as_files(folder, light):
    write(folder / f"{LESSON}.ipynb" / "more.zip" / f"{LESSON}.IPYNB", wrong_notebook(light))


@attack("a zip whose members lie upon each other", "more than 100 notebooks")
def _overlapping(folder, light):
    folder.mkdir(parents=True)
    data = json.dumps(wrong_notebook(light)).encode()
    with zipfile.ZipFile(folder / "work.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(f"{LESSON}.ipynb", data)
        (first,) = archive.infolist()
        for number in range(3_000):
            info = zipfile.ZipInfo(f"{number}/{LESSON}.ipynb")
            for name in ("header_offset", "compress_size", "file_size", "CRC", "compress_type"):
                setattr(info, name, getattr(first, name))
            archive.filelist.append(info)
            archive.NameToInfo[info.filename] = info


@attack("zips of fifteen thousand files each", "hold more than 20000 files")
def _many_members(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for number in range(15_000):
            archive.writestr(zipfile.ZipInfo(f"{number}.txt"), "")
    for number in range(4):
        write(folder / f"{number}.zip", buffer.getvalue())


@attack("names of files that a program could take for its own")
def _names_of_ours(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for name in (
        ".lock",
        "grades.json",
        "summary.html",
        "~$x.ipynb.tmp",
        "{{ grades }}.ipynb.txt",
        "..ipynb",
    ):
        write(folder / name, b"{}")


# ---------------------------------------------------------------- grading them all


@dataclass(frozen=True)
class Attacked:
    """The result of an attack.

    gained    its points
    report    what the instructor reads about it, one line
    harmed    what it harmed, as texts; empty if its neighbour is graded as if alone
    """

    gained: int
    report: str
    harmed: tuple


def grade_attacks(light, key_path, folder):
    """Grade all at once, an honest submission after each, and one honest submission alone; {name: Attacked}.

    Parameters
    ----------
    light : Master
    key_path : Path of its key
    folder : Path, empty
    """
    honest = notebook(light, answers_of(light, "right"))
    write(folder / "alone" / "alone.ipynb", honest)
    for attack in FORM_ATTACKS:
        attack.put(folder / "submissions" / attack.folder_name, light)
        write(folder / "submissions" / attack.neighbour / f"{LESSON}.ipynb", honest)
    learners = []
    for name in ("alone", "submissions"):
        out = folder / f"{name}-grades"
        grade_submissions(folder / name, [key_path], out, workers=1)
        grades = json.loads((out / "grades.json").read_text(encoding="utf-8"))
        learners.append({learner["name"]: learner for learner in grades["learners"]})
    (alone,) = learners[0]["alone"]["lessons"]
    return {attack.name: _attacked(attack, learners[1], alone, folder) for attack in FORM_ATTACKS}


def _attacked(attack, learners, alone, folder):
    lessons = learners[attack.learner]["lessons"]
    texts = [lesson["reason"] for lesson in lessons if lesson["reason"]]
    texts += [finding["text"] for lesson in lessons for finding in lesson["findings"]]
    points = learners[attack.learner]["points"]
    return Attacked(points, "; ".join(texts), _harm(attack, learners, alone, folder))


def _harm(attack, learners, alone, folder):
    harm = []
    (neighbour,) = learners[attack.neighbour]["lessons"]
    for part in ("points", "max_points", "exercises", "findings"):
        if neighbour[part] != alone[part]:
            harm.append(f"its neighbour's {part}")
    if trap_of(folder / "submissions" / "any").exists():
        harm.append("code beside a notebook ran")
    for pattern, text in attack.never:
        for path in sorted(Path(folder, "submissions-grades").glob(pattern)):
            if text in path.read_text(encoding="utf-8", errors="replace"):
                harm.append(f"{text!r} is in {path.name}")
    return tuple(harm)
