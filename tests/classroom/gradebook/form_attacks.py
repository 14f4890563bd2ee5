"""Attacks on the form of a submission: its cells, metadata, files, archives and names.

Each attack has wrong answers, tries to gain points by a trick, and is put into a folder of submissions
between honest ones. `number` is the attack's number in the published list of 62. The attacks by the source
of an answer are in tests/classroom/autograder/attacks.py.
"""

import hashlib
import io
import json
import os
import socket
import unicodedata
import warnings
import zipfile
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from submissions import answers_of, cell_of, notebook, write

from imgproc_course.classroom.autograder.sanitize import sanitize_line
from imgproc_course.classroom.gradebook.grade import grade_submissions

LESSON = "20_light"


@dataclass(frozen=True)
class FormAttack:
    """An attack; it is submitted by a learner of its own.

    put       function of the learner's folder, which does not exist yet, and the master
    reported  text that the instructor must find in the report; "" if there is nothing to report
    folder    name of the learner's folder, if this name is the attack
    never     (pattern, text) pairs: no file of the grades whose name fits the pattern may contain the text
    known_as  the learner's name in the grades, if it is not the folder's
    """

    number: int
    name: str
    put: object
    reported: str = ""
    folder: str = ""
    never: tuple = ()
    known_as: str = ""

    @property
    def learner(self):
        """The learner's name in the grades."""
        return self.known_as or sanitize_line(self.folder_name, 120)

    @property
    def folder_name(self):
        return self.folder or f"{self.number:02d} {self.name}"

    @property
    def neighbour(self):
        """The honest learner whose submission is graded after it."""
        return f"{self.number:02d} {self.name}, neighbour"


FORM_ATTACKS = []


def attack(number, name, reported="", **more):
    """Decorator: makes an attack of a function of (folder, master)."""

    def add(put):
        FORM_ATTACKS.append(FormAttack(number, name, put, reported, **more))
        return put

    return add


def of_cells(number, name, reported="", **more):
    """Decorator: makes an attack of a function that changes a notebook with wrong answers in place."""

    def add(change):
        def put(folder, light):
            lesson = wrong_notebook(light)
            change(lesson)
            write(folder / f"{LESSON}.ipynb", lesson)

        FORM_ATTACKS.append(FormAttack(number, name, put, reported, **more))
        return change

    return add


def wrong_notebook(light):
    """The lesson with wrong answers; a dict."""
    return notebook(
        light,
        {"light-double": "def double(p):\n    return p", "light-halves": "def halves(p):\n    return p"},
    )


def claim(lesson, id="light-double"):
    """Store an output that says that a check passes."""
    cell = cell_of(lesson, f"check-{id}-1")
    cell["outputs"] = [{"output_type": "stream", "name": "stdout", "text": f"{id}: the check passes.\n"}]
    cell["execution_count"] = 3


# ---------------------------------------------------------------- cells and metadata


@of_cells(1, "deleted checks", "is missing; grading uses its own")
def _deleted_checks(lesson):
    lesson["cells"] = [cell for cell in lesson["cells"] if not cell["id"].startswith("check-")]


@of_cells(2, "edited checks", "was changed")
def edit_checks(lesson):
    cell_of(lesson, "check-light-double-1")["source"] = "print('light-double: the check passes.')"


@of_cells(3, "checks made raw cells", "not a code cell any more")
def _retyped_checks(lesson):
    cell_of(lesson, "check-light-double-1")["cell_type"] = "raw"


@of_cells(4, "points in the metadata", "direct a grader")
def _points(lesson):
    for cell in lesson["cells"]:
        cell["metadata"] = {"nbgrader": {"points": 1000, "grade": True, "locked": False}, "points": 1000}
    lesson["metadata"]["imgproc_course"]["points"] = 1000


@of_cells(4, "cells with the ids of hidden checks")
def _hidden_case_ids(lesson):
    for id in ("hidden-light-double-1", "case-light-double-1", "solution-light-double"):
        lesson["cells"].append({"id": id, "cell_type": "code", "metadata": {}, "source": "1", "outputs": []})


@of_cells(5, "every cell twice", "2 cells define double()")
def _duplicates(lesson):
    lesson["cells"] += [dict(cell) for cell in lesson["cells"]]


@of_cells(6, "cells in another order")
def _reordered(lesson):
    lesson["cells"].reverse()


@of_cells(7, "the answer in another cell", "graded from another cell (mine), which defines double()")
def _moved(lesson):
    cell_of(lesson, "answer-light-double")["id"] = "mine"


@of_cells(8, "tags that skip", "direct a grader")
def _skipping_tags(lesson):
    cell_of(lesson, "answer-light-double")["metadata"]["tags"] = ["nbval-skip", "nbval-ignore-output"]


@of_cells(9, "tags that allow an exception", "direct a grader")
def _raising_tags(lesson):
    cell_of(lesson, "answer-light-double")["metadata"]["tags"] = [
        "nbval-raises-exception",
        "raises-exception",
    ]


@of_cells(9, "tags that are no list")
def _tags_of_another_type(lesson):
    cell_of(lesson, "answer-light-double")["metadata"] = {"tags": {"nbval-skip": 1}}


@of_cells(10, "forged outputs", "stored output says that every check passes")
def _forged_outputs(lesson):
    claim(lesson)


@of_cells(11, "no execution counts", "stored output says that every check passes")
def _no_execution_counts(lesson):
    claim(lesson)
    cell_of(lesson, "check-light-double-1")["execution_count"] = None


@of_cells(12, "another kernel", "asks for the kernel 'bash'")
def _kernelspec(lesson):
    lesson["metadata"]["kernelspec"] = {"name": "bash", "language": "bash", "argv": ["/bin/sh"]}


@of_cells(13, "notebook format 4.99")
def _minor_99(lesson):
    lesson["nbformat_minor"] = 99


@of_cells(15, "an id of a hundred thousand letters")
def _huge_id(lesson):
    lesson["cells"].append({"id": "answer-" + "x" * 100_000, "cell_type": "code", "source": "1"})


@of_cells(58, "a lesson's name that is a path")
def _other_lesson(lesson):
    lesson["metadata"]["imgproc_course"]["lesson"] = "../../../etc/passwd"


@of_cells(61, "widget state with a script", never=(("**/*.html", "<script>alert"),))
def _widget_state(lesson):
    lesson["metadata"]["widgets"] = {
        "application/vnd.jupyter.widget-state+json": {"state": "<script>alert(1)</script>"}
    }


@of_cells(61, "outputs with a script", never=(("**/*.html", "<script>alert"), ("**/*.html", "onload=")))
def _script_in_outputs(lesson):
    html = {"text/html": "<script>alert(1)</script>", "image/svg+xml": "<svg onload=alert(1)>"}
    shown = {"output_type": "display_data", "data": html, "metadata": {}}
    cell_of(lesson, "check-light-double-1")["outputs"] = [shown]


# ---------------------------------------------------------------- notebooks that cannot be read

DEEP = 100_000
MALFORMED = {  # name: (number of the attack, the file's bytes, the reason in the report)
    "empty": (14, b"", "the file is empty"),
    "blank": (14, b" \n", "the file is empty"),
    "cut off": (14, b'{"nbformat": 4, "cells": [', "its JSON is broken (line 1)"),
    "UTF-16": (14, '{"nbformat": 4}'.encode("utf-16"), "no list of cells"),
    "UTF-16 cut off": (14, '{"nbformat": 4}'.encode("utf-16")[:-1], "it is not UTF-16"),
    "half a UTF-16 pair": (14, b"\xff\xfe{\x00\x3d\xd8}\x00", "it is not UTF-16"),
    "UTF-16 without its mark": (14, '{"nbformat": 4}'.encode("utf-16-le"), "its JSON is broken"),
    "UTF-32": (14, '{"nbformat": 4}'.encode("utf-32"), "its JSON is broken"),
    "latin-1": (14, '{"nbformat": 4, "ä": 1}'.encode("latin-1"), "it is not UTF-8"),
    "no JSON": (14, b"<html>", "its JSON is broken"),
    "a list": (14, b"[]", "its JSON holds something else"),
    "a number": (14, b"7", "its JSON holds something else"),
    "no format": (13, b'{"cells": []}', "which notebook format"),
    "format true": (13, b'{"nbformat": true, "cells": []}', "which notebook format"),
    "format 2": (13, b'{"nbformat": 2, "worksheets": []}', "notebook format 2"),
    "no worksheets": (13, b'{"nbformat": 3, "cells": []}', "no list of cells"),
    "worksheets a dict": (13, b'{"nbformat": 3, "worksheets": {"cells": []}}', "no list of cells"),
    "no cells in a worksheet": (13, b'{"nbformat": 3, "worksheets": [3, {"cells": {}}]}', "no list of cells"),
    "too many worksheets": (
        15,
        b'{"nbformat": 3, "worksheets": [' + b'{"cells": [1, 1]},' * 3_000 + b'{"cells": [1]}]}',
        "6001 cells",
    ),
    "format 5": (13, b'{"nbformat": 5, "cells": []}', "notebook format 5"),
    "format huge": (13, b'{"nbformat": 1' + b"0" * 400 + b', "cells": []}', "notebook format 1000"),
    "no cells": (14, b'{"nbformat": 4}', "no list of cells"),
    "cells a dict": (14, b'{"nbformat": 4, "cells": {}}', "no list of cells"),
    "deep lists": (14, b"[" * DEEP + b"]" * DEEP, "nested too deep"),
    "deep dicts": (14, b'{"a":' * DEEP + b"1" + b"}" * DEEP, "nested too deep"),
    "deep metadata": (14, b'{"nbformat": 4, "metadata": ' + b"[" * DEEP, "nested too deep"),
    "a long number": (14, b'{"nbformat": 4, "cells": ' + b"9" * 10_000 + b"}", "its JSON is broken"),
    "too many cells": (15, b'{"nbformat": 4, "cells": [' + b"1," * 6_000 + b"1]}", "6001 cells"),
    "null bytes": (14, b"\x00" * 100, "its JSON is broken"),
}


def _malformed(data):
    return lambda folder, light: write(folder / f"{LESSON}.ipynb", data)


for _name, (_number, _data, _reason) in MALFORMED.items():
    attack(_number, f"a file with {_name}", _reason)(_malformed(_data))


@attack(15, "two hundred megabytes", "it has 200 MB")
def _huge(folder, light):
    with write(folder / f"{LESSON}.ipynb", b"").open("wb") as file:
        file.truncate(200_000_000)


# ---------------------------------------------------------------- files, archives and names


def trap_of(folder):
    """The file that the code of an attack writes; this code must never run."""
    return folder.parents[1] / "trapped"


@attack(51, "modules beside the notebook")
def _modules_beside(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for name in ("numpy", "sitecustomize", "usercustomize", "coverage", "imgproc_course", "json"):
        write(folder / f"{name}.py", f"open({str(trap_of(folder))!r}, 'w').close()")
    write(folder / "x.pth", f"import os; open({str(trap_of(folder))!r}, 'w').close()")


@attack(52, "conftest.py and pytest.ini beside the notebook")
def _settings_beside(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    write(folder / "conftest.py", f"open({str(trap_of(folder))!r}, 'w').close()")
    write(folder / "pytest.ini", "[pytest]\naddopts = --nbval-lax")
    for name in ("pyproject.toml", "tox.ini"):
        write(folder / name, "[tool.pytest.ini_options]\naddopts = '--co'\n")


@attack(57, "a link to a neighbour's notebook", "links are not followed")
def _link(folder, light):
    right = write(folder.parents[1] / "right.ipynb", notebook(light, answers_of(light, "right")))
    folder.mkdir(parents=True)
    (folder / f"{LESSON}.ipynb").symlink_to(right)


@attack(57, "a folder that is a link")
def _link_to_folder(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    (folder / "more").symlink_to("/etc")


@attack(57, "a pipe without a writer", "not a regular file")
def _pipe(folder, light):
    folder.mkdir(parents=True)
    os.mkfifo(folder / f"{LESSON}.ipynb")


@attack(57, "a link in a zip", "a link or a device in a zip")
def _link_in_zip(folder, light):
    link = zipfile.ZipInfo(f"{LESSON}.ipynb")
    link.external_attr = 0o120777 << 16
    _zip(folder, [(link, "/etc/passwd")])


@attack(58, "a name in a zip that leads out of it", "leads out of the zip")
def _out_of_zip(folder, light):
    _zip(folder, [(f"../../{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])


@attack(58, "an absolute name in a zip", "leads out of the zip")
def _absolute_in_zip(folder, light):
    _zip(folder, [(f"/etc/{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])


@attack(58, "a name that is options and markup", folder="-p x::[1] <b>\u202egpj.\nx")
def _odd_name(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


@attack(58, "a name that is no text", folder=os.fsdecode(b"\xff\xfe"))
def _name_of_bytes(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


@attack(59, "a zip bomb", "200 times its size")
def _bomb(folder, light):
    _zip(folder, [(f"{LESSON}.ipynb", b"0" * 20_000_000)])


@attack(59, "a zip in a zip", "a zip in a zip")
def _nested(folder, light):
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))
    _zip(folder, [("inner.zip", inner.getvalue())])


@attack(59, "a zip that lies about its sizes", "cannot be")
def _lying(folder, light):
    path = _zip(folder, [(f"{LESSON}.ipynb", os.urandom(5_000))])
    data = bytearray(path.read_bytes())
    for signature, offset in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        at = data.index(signature) + offset
        data[at : at + 4] = (100).to_bytes(4, "little")
    path.write_bytes(data)


@attack(59, "a file that is not a zip", "zip cannot be read")
def _no_zip(folder, light):
    write(folder / "work.zip", b"PK\x03\x04 no zip")


@attack(
    60,
    "a name that is a formula",
    folder='=cmd|"calc"!A1,x\t;y',
    never=(("**/*.csv", '"=cmd'), ("**/*.csv", "\t")),
)
def _formula(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


@attack(
    61, "a name that is a script", folder="<img src=x onerror=alert(1)>", never=(("**/*.html", "<img src=x"),)
)
def _script(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


def _zip(folder, members):
    folder.mkdir(parents=True)
    path = folder / "work.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members:
            if isinstance(name, str):  # unchanged: writestr() would remove a leading slash
                info = zipfile.ZipInfo("x")
                info.filename, info.compress_type = name, zipfile.ZIP_DEFLATED
            else:
                info = name
            archive.writestr(info, data)
    return path


# ---------------------------------------------------------------- senders and budgets

TOMORROW = (2099, 1, 1, 0, 0, 0)


def _neighbour_of(folder):
    return f"{folder.name}, neighbour"


def _dated_zip(path, names, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in names:
            archive.writestr(zipfile.ZipInfo(name, TOMORROW), data)


@attack(201, "a zip with a folder of a neighbour's name", "submitted 3 times")
def _neighbours_name_in_zip(folder, light):
    names = [f"{LESSON}.ipynb", f"{_neighbour_of(folder)}/{LESSON}.ipynb", f"{_neighbour_of(folder)}.ipynb"]
    _dated_zip(folder.with_name(f"{folder.name}.zip"), names, json.dumps(wrong_notebook(light)))


@attack(202, "a zip of Moodle's form with a neighbour's name", "whose own submission of light counts")
def _forged_platform_zip(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    names = [f"{_neighbour_of(folder)}_{id}_assignsubmission_file_/{LESSON}.ipynb" for id in (7, 8)]
    names += [f"somebody else {id}_{id}_assignsubmission_file_/{LESSON}.ipynb" for id in range(3)]
    path = folder.with_name(f"{folder.name}, all submissions.zip")
    _dated_zip(path, names, json.dumps(wrong_notebook(light)))


@attack(203, "a zip of Moodle's form under the sender's own name", "whose own submission of light counts")
def _forged_platform_zip_of_a_known_sender(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    names = [f"{_neighbour_of(folder)}_7_assignsubmission_file_/{LESSON}.ipynb"]
    _dated_zip(folder.with_name(f"{folder.name}.zip"), names, json.dumps(wrong_notebook(light)))


@attack(
    204,
    "a display name with Moodle's mark in it",
    "Moodle's mark more than once",
    folder="204 a display name with Moodle's mark in it, neighbour_1_assignsubmission_file_"
    "Eve_2_assignsubmission_file_",
)
def _mark_in_display_name(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


@attack(205, "an environment of 20,001 files", "installed packages")
def _environment(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    packages = folder / ".venv" / "lib"
    packages.mkdir(parents=True)
    for number in range(20_001):
        (packages / f"{number}.ipynb").touch()


@attack(206, "two hundred notebooks", "more than 100 notebooks")
def _many_notebooks(folder, light):
    for number in range(200):
        write(folder / f"{number}.ipynb", b"{}")


@attack(207, "a zip packed with LZMA", "unusual method")
def _unusual_packing(folder, light):
    folder.mkdir(parents=True)
    with zipfile.ZipFile(folder / "work.zip", "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))


@attack(208, "a zip with a table of contents of 10 MB", "table of contents has")
def _huge_contents(folder, light):
    _zip(folder, [(f"{number:05d}{'x' * 1000}.ipynb", b"") for number in range(10_000)])


@attack(209, "a socket", "not a regular file")
def _socket(folder, light):
    folder.mkdir(parents=True)
    descriptor = os.open(folder, os.O_RDONLY)  # the path of a socket has at most 107 bytes
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(f"/proc/self/fd/{descriptor}/{LESSON}.ipynb")
    os.close(descriptor)


@attack(210, "a link to the folder of submissions, and links in a circle", "links are not followed")
def _links_in_a_circle(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    (folder / "all").symlink_to(folder.parent)
    (folder / "circle").symlink_to("circle")


@attack(211, "a folder deeper than a path can be", "folders deep")
def _deep_folders(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    descriptor = os.open(folder, os.O_RDONLY)
    for _ in range(40):
        os.mkdir("d" * 200, dir_fd=descriptor)
        deeper = os.open("d" * 200, os.O_RDONLY, dir_fd=descriptor)
        os.close(descriptor)
        descriptor = deeper
    os.close(descriptor)


@attack(
    221,
    "the neighbour's name in capitals",
    folder="221 THE NEIGHBOUR'S NAME IN CAPITALS, NEIGHBOUR",
)
def _capitals(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(
    222,
    "the neighbour's name and a mark that nobody sees",
    folder="222 the neighbour's name and a mark that nobody sees, neighbour\u200b",
)
def _unseen_mark(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(223, "one name twice in a zip", "submitted 2 times")
def _one_name_twice(folder, light):
    answers = [wrong_notebook(light), notebook(light, answers_of(light, "untouched"))]
    with warnings.catch_warnings(action="ignore"):
        _zip(folder, [(f"{LESSON}.ipynb", json.dumps(lesson)) for lesson in answers])


@attack(224, "names of another system in a zip", "submitted 3 times")
def _names_of_another_system(folder, light):
    names = (f"..\\{_neighbour_of(folder)}\\{LESSON}.ipynb", f"C:\\{LESSON}.ipynb", f"{LESSON}.ipynb:x")
    _zip(folder, [(name, json.dumps(wrong_notebook(light))) for name in (f"{LESSON}.ipynb", *names)])


@attack(225, "a notebook of three hundred thousand cells", "at most 5000 are read")
def _many_cells(folder, light):
    lesson = wrong_notebook(light)
    lesson["cells"] += [{"cell_type": "code", "source": "", "metadata": {}, "outputs": []}] * 300_000
    write(folder / f"{LESSON}.ipynb", lesson)


@attack(226, "a zip that asks for a password", "locked with a password")
def _password(folder, light):
    path = _zip(folder, [(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])
    data = bytearray(path.read_bytes())
    for signature, place in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):  # the flags of a member: encrypted
        data[data.index(signature) + place] |= 1
    path.write_bytes(data)


# ---------------------------------------------------------------- more of each kind


@of_cells(301, "a lesson's name that is a list, and answers that point at each other")
def _odd_metadata(lesson):
    lesson["metadata"]["imgproc_course"] = {"lesson": ["light"], "version": {"x": 1}}
    for id, exercise in (("light-double", "light-halves"), ("light-halves", "light-double")):
        cell_of(lesson, f"answer-{id}")["metadata"]["imgproc_course"] = {"exercise": exercise}


@of_cells(302, "helper functions that read each other in a circle of hundreds")
def _circle(lesson):
    cell_of(lesson, "answer-light-double")["source"] = "def double(p):\n    return h0(p)"
    for number in range(600):
        source = f"def h{number}(p):\n    return h{(number + 1) % 600}(p)"
        lesson["cells"].append({"id": f"h{number}", "cell_type": "code", "metadata": {}, "source": source})


@of_cells(304, "a source of a million lines of one letter", "longer than")
def _lines(lesson):
    cell_of(lesson, "answer-light-double")["source"] = ["#\n"] * 1_000_000 + ["def double(p): return p"]


@of_cells(305, "outputs that claim in every form that there is", "stored output says that every check passes")
def _claims(lesson):
    claim(lesson)
    cell = cell_of(lesson, "check-light-double-1")
    cell["outputs"] += [None, 7, {"data": 7}, {"text": {"x": 1}}, {"data": {"text/plain": ["a", 1]}}]


@attack(306, "a notebook with two lists of cells")
def _two_lists(folder, light):
    right, wrong = notebook(light, answers_of(light, "right")), wrong_notebook(light)
    text = json.dumps(wrong)
    write(folder / f"{LESSON}.ipynb", '{"cells": ' + json.dumps(right["cells"]) + ", " + text[1:])


@attack(307, "numbers beyond every float in the notebook")
def _numbers(folder, light):
    text = json.dumps(wrong_notebook(light) | {"nbformat_minor": 0, "x": [float("inf"), float("nan")]})
    write(folder / f"{LESSON}.ipynb", text.replace('"nbformat_minor": 0', '"nbformat_minor": -1e999'))


@attack(308, "folders with the names of notebooks and zips")
def _folders_named_as_files(folder, light):
    write(folder / f"{LESSON}.ipynb" / "more.zip" / f"{LESSON}.IPYNB", wrong_notebook(light))


@attack(309, "a zip behind another file, with a comment that is a zip's end", "the zip cannot be read")
def _polyglot(folder, light):
    path = _zip(folder, [(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])
    data = path.read_bytes()
    end = data[data.rindex(b"PK\x05\x06") :]
    path.write_bytes(b"%PDF-1.7 <html>" * 999 + data[:-2] + len(end).to_bytes(2, "little") + end)


@attack(310, "a zip whose members lie upon each other", "more than 100 notebooks")
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


@attack(311, "sizes of 64 bits in a zip, beyond every file", "it has 4294 MB")
def _zip64(folder, light):
    path = _zip(folder, [(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])
    data = bytearray(path.read_bytes())
    place = data.index(b"PK\x01\x02") + 20
    data[place : place + 8] = b"\xff" * 8
    path.write_bytes(data)


@attack(312, "names in a zip that are marks and devices")
def _marks_in_names(folder, light):
    names = (
        "\u202egpj.ipynb",
        "\x00.ipynb",
        "a\nb\t.ipynb",
        "CON.ipynb",
        " .ipynb",
        "=1+1.ipynb",
        "-rf.ipynb",
    )
    with warnings.catch_warnings(action="ignore"):
        _zip(folder, [(name, json.dumps(wrong_notebook(light))) for name in (f"{LESSON}.ipynb", *names)])


@attack(
    313,
    "the neighbour's name with another apostrophe",
    folder="313 the neighbour\u2019s name with another apostrophe, neighbour",
)
def _look_alike(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(
    314,
    "the neighbour's name and a soft hyphen",
    folder="314 the neighbour's name and a soft hyphen, neigh\u00adbour",
)
def _soft_hyphen(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(
    315,
    "the neighbour's name in wide letters",
    folder="315 the neighbour's name in wide letters, \uff4eeighbour",
)
def _wide(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(
    316,
    "the neighbour's name and spaces of every kind",
    folder="316 the neighbour's name and spaces of every kind,\u00a0neigh\u2003bour",
)
def _spaces(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(317, "a zip with a wrong checksum", "cannot be unpacked")
def _bad_crc(folder, light):
    path = _zip(folder, [(f"{LESSON}.ipynb", json.dumps(wrong_notebook(light)))])
    data = bytearray(path.read_bytes())
    place = data.index(b"PK\x01\x02") + 16
    data[place : place + 4] = b"\x00" * 4
    path.write_bytes(data)


# ---------------------------------------------------------------- by fresh eyes


def _told_apart(name, given):
    """How a learner is listed whose name looks like another one's."""
    return f"{name} [{hashlib.sha256(os.fsencode(given)).hexdigest()[:6]}]"


_SPACE = "401 the neighbour's name and a space at its end, neighbour"
_ACCENT = "402 the neighbour\u2019s name in other bytes, le\u0301a, neighbour"


@attack(
    401,
    "the neighbour's name and a space at its end",
    "the two are graded apart",
    folder=f"{_SPACE} ",
    known_as=_told_apart(_SPACE, f"{_SPACE} "),
)
def _space_at_the_end(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(
    402,
    "the neighbour\u2019s name in other bytes, l\u00e9a",
    "the two are graded apart",
    folder=_ACCENT,
    known_as=_told_apart(unicodedata.normalize("NFC", _ACCENT), _ACCENT),
)
def _other_bytes(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light), datetime(2099, 1, 1))


@attack(404, "the neighbour's name, chosen on a platform", "whose own submission of light counts")
def _name_on_a_platform(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for name in (
        f"{_neighbour_of(folder)}_7_assignsubmission_file_",
        f"{_neighbour_of(folder)}_7_8_{LESSON}.ipynb",
    ):
        path = folder.with_name(name)
        path = path / f"{LESSON}.ipynb" if path.suffix != ".ipynb" else path
        write(path, wrong_notebook(light), datetime(2099, 1, 1))


@attack(405, "twenty thousand links", "more than 20000 files")
def _many_links(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for number in range(20_000):
        (folder / f"{number}.txt").symlink_to("/etc/passwd")


@attack(406, "zips of fifteen thousand files each", "hold more than 20000 files")
def _many_members(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for number in range(15_000):
            archive.writestr(zipfile.ZipInfo(f"{number}.txt"), "")
    for number in range(4):
        write(folder / f"{number}.zip", buffer.getvalue())


@attack(408, "a hundred files of no lesson", "it is not one of the lessons")
def _files_of_no_lesson(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))
    for number in range(99):
        write(
            folder / f"{number}.ipynb", b'{"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": []}'
        )


@attack(
    409,
    "a name that is a formula after a semicolon",
    folder="409 x;=cmd|' !C calc'!A0;y",
    never=(("**/*.csv", ";=cmd"),),
)
def _formula_after_a_semicolon(folder, light):
    write(folder / f"{LESSON}.ipynb", wrong_notebook(light))


@attack(410, "megabytes in a picture of a Markdown cell, and in metadata")
def _huge_attachments(folder, light):
    lesson = wrong_notebook(light)
    picture = {"a.png": {"image/png": "A" * 12_000_000}}
    lesson["cells"].append(
        {"id": "m", "cell_type": "markdown", "metadata": {}, "source": "", "attachments": picture}
    )
    lesson["metadata"]["more"] = [[{"a": 1}] * 1000] * 500
    write(folder / f"{LESSON}.ipynb", lesson)


@of_cells(411, "five thousand cells that all say that they are the answer", "4901 cells define double()")
def _marked_cells(lesson):
    source = "def double(p):\n    return p\ndef halves(p):\n    return p\n"
    about = {"imgproc_course": {"exercise": "light-double"}}
    for number in range(4_900):
        lesson["cells"].append({"id": f"c{number}", "cell_type": "code", "metadata": about, "source": source})


@attack(412, "names of files that a program could take for its own")
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


@attack(413, "zips of platforms' forms with a neighbour's name, one of them named like a lesson")
def _zips_of_platforms(folder, light):
    data = json.dumps(wrong_notebook(light))
    write(folder / f"{LESSON}.ipynb", data)
    moodle = f"{_neighbour_of(folder)}_7_assignsubmission_file_/{LESSON}.ipynb"
    canvas = f"{_neighbour_of(folder)}_7_8_{LESSON}.ipynb"
    _dated_zip(folder.with_name("413.zip"), [moodle, canvas], data)
    _dated_zip(folder.with_name(f"{LESSON}.zip"), [moodle], data)


# ---------------------------------------------------------------- grading them all


@dataclass(frozen=True)
class Attacked:
    """The result of an attack.

    gained    its points
    report    what the instructor reads about it, one line
    harmed    what it harmed, as texts; empty if its neighbour is graded as if alone
    """

    attack: FormAttack
    gained: int
    report: str
    harmed: tuple


def grade_attacks(light, key_path, folder, attacks=FORM_ATTACKS, **options):
    """Grade attacks at once, an honest submission after each, and one honest submission alone.

    Parameters
    ----------
    light : Master
    key_path : Path of its key
    folder : Path, empty
    attacks : list of FormAttack
    options : as `grade_submissions` takes them

    Returns
    -------
    list of Attacked
    """
    honest = notebook(light, answers_of(light, "right"))
    write(folder / "alone" / "alone.ipynb", honest)
    for attack in attacks:
        attack.put(folder / "submissions" / attack.folder_name, light)
        write(folder / "submissions" / attack.neighbour / f"{LESSON}.ipynb", honest)
    learners, intake = [], []
    for name in ("alone", "submissions"):
        out = folder / f"{name}-grades"
        grade_submissions(folder / name, [key_path], out, **({"workers": 1, "quiet": True} | options))
        grades = json.loads((out / "grades.json").read_text(encoding="utf-8"))
        learners.append({learner["name"]: learner for learner in grades["learners"]})
        intake = grades["intake"]
    (alone,) = learners[0]["alone"]["lessons"]
    return [_attacked(attack, learners[1], alone, folder, intake) for attack in attacks]


def _attacked(attack, learners, alone, folder, intake):
    lessons = learners[attack.learner]["lessons"]
    texts = [lesson["reason"] for lesson in lessons if lesson["reason"]]
    texts += [finding["text"] for lesson in lessons for finding in lesson["findings"]]
    texts += [
        finding["text"]
        for finding in intake
        if attack.learner in (finding["learner"], finding["file"][: len(attack.learner)])
    ]
    outcomes = {
        case["outcome"]
        for lesson in lessons
        for exercise in lesson["exercises"]
        for case in exercise["cases"]
    }
    texts = texts or [", ".join(sorted(outcomes))]
    return Attacked(
        attack, learners[attack.learner]["points"], "; ".join(texts), _harm(attack, learners, alone, folder)
    )


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
