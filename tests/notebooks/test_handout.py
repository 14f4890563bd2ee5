"""What learners get holds no solution and no hidden case: every file is opened, also in the zip file."""

import ast
import io
import json
import zipfile
from pathlib import Path
from textwrap import indent

import pytest

from imgproc_course.classroom.authoring.handout import hand_out
from imgproc_course.classroom.authoring.masters import find_masters, read_master
from imgproc_course.classroom.exercises.cell_syntax import plain_python
from imgproc_course.classroom.exercises.input_encoding import encode
from imgproc_course.classroom.gradebook.fingerprints import shape_of, syntax_tokens, winnowed

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
MASTERS = {master.name: master for master in map(read_master, find_masters(NOTEBOOKS / "masters"))}
EXERCISES = [exercise for master in MASTERS.values() for exercise in master.exercises]
COPIED = 0.8  # of a solution's fingerprints: a text that shares more contains it


def files_in(data, place):
    """(place, text) of a file, and of all files in it."""
    if zipfile.is_zipfile(io.BytesIO(data)):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for name in archive.namelist():
                yield from files_in(archive.read(name), f"{place}/{name}")
    else:
        yield place, data.decode("utf-8")


def strings_in(data):
    """Every text in JSON data; the sources of a notebook's cells as one more text."""
    if isinstance(data, str):
        yield data
    elif isinstance(data, list):
        for item in data:
            yield from strings_in(item)
        if all(isinstance(item, str) for item in data):
            yield "".join(data)
    elif isinstance(data, dict):
        for key, value in data.items():
            yield key
            yield from strings_in(value)


def functions_in(text):
    """The sources of all functions in a text that is Python."""
    if "def " not in text and "lambda" not in text:
        return
    try:
        tree = ast.parse(plain_python(text))
    except (SyntaxError, ValueError, RecursionError):
        return
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.Lambda)):
            yield ast.unparse(node)


def body_of(source):
    """The statements of the functions of a source, without spaces, comments and docstrings."""
    functions = [node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)]
    statements = [
        statement
        for function in functions
        for statement in function.body
        if not (isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant))
    ]
    return squeezed("\n".join(map(ast.unparse, statements)))


def without_imports(source):
    """A class, or the texts of a package, and their functions, without spaces and comments."""
    nodes = ast.parse(source).body
    statements = [node for node in nodes if not isinstance(node, ast.Import | ast.ImportFrom)]
    return squeezed("\n".join(map(ast.unparse, statements)))


def squeezed(text):
    return "".join(text.replace('"', "'").split())


class HandedOut:
    """All that a hand-out holds: its texts, and the syntax of what is Python in them."""

    def __init__(self, paths):
        self.files, texts = {}, set()
        for path in paths:
            if path.is_file():
                self.files |= dict(files_in(path.read_bytes(), f"{path.parent.name}/{path.name}"))
        for text in self.files.values():
            try:
                texts |= set(strings_in(json.loads(text)))
            except ValueError:
                texts.add(text)
        functions = {source for text in texts for source in functions_in(text)}
        self.text = "\0".join(squeezed(text) for text in texts | functions)
        self.shapes = {shape_of(syntax_tokens(source))[0] for source in functions}
        self.prints = [winnowed(syntax_tokens(plain_python(text))).keys() for text in texts if "\n" in text]

    def share_of(self, source):
        """The largest share of a source's fingerprints that one text has."""
        prints = winnowed(syntax_tokens(source)).keys()
        if len(prints) <= 3:
            return 0
        return max((len(prints & others) for others in self.prints), default=0) / len(prints)

    def leaks(self, exercise):
        """What of an exercise learners must not get, and would get."""
        source = exercise.solution
        body = body_of(source) if exercise.subject == "function" else without_imports(source)
        if body in self.text:
            yield "the solution, as text"
        if {shape_of(syntax_tokens(function))[0] for function in functions_in(source)} & self.shapes:
            yield "the solution's function, under whatever names"
        if self.share_of(source) > COPIED:
            yield "the solution's statements"
        for case in exercise.hidden:
            if case.id in self.text:
                yield f"the name of {case.id}"
            if body_of(case.source) in self.text:
                yield f"the inputs of {case.id}"
            if any(data in self.text for data in data_of(exercise, case)):
                yield f"the values of {case.id}"


def data_of(exercise, case):
    """The arrays that a case's calls get in a lesson, as files hold them."""
    if exercise.practice:
        return set()  # it may get functions
    forms = [encode(arguments) for arguments in exercise.arguments(case)]
    return {
        text for text in strings_in(forms) if len(text) > 40 and len(set(text)) > 8
    }  # no images of one value


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handout") / "handout"
    result = hand_out(folder, NOTEBOOKS, zipped=True)
    return HandedOut([*folder.rglob("*"), result.archive])


@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda exercise: exercise.id)
def test_no_file_holds_a_solution_or_a_hidden_case(handed_out, exercise):
    assert list(handed_out.leaks(exercise)) == []


def test_every_file_was_opened(handed_out):
    names = {Path(name).name for name in handed_out.files}
    assert {path.name for path in NOTEBOOKS.glob("*.ipynb")} <= names
    assert {path.name for path in (NOTEBOOKS / "checks").glob("*.json")} <= names
    zipped = [name for name in handed_out.files if ".zip/" in name]
    assert 2 * len(zipped) == len(handed_out.files) > 2 * len(MASTERS)


def test_a_leak_would_be_found(tmp_path):
    """The solution as it is, renamed, and without its def line; a hidden case's inputs."""
    exercise = next(exercise for exercise in EXERCISES if exercise.id == "canny-suppression")
    tree = ast.parse(exercise.solution)
    renamed = ast.unparse(Renamed().visit(ast.parse(exercise.solution)))
    hidden = exercise.hidden[0]
    leaked = {
        "as it is": exercise.solution,
        "renamed": renamed,
        "in another function": f"def other():\n{indent(renamed, '    ')}\n    print(1)",
        "without def": "\n".join(map(ast.unparse, tree.body[-1].body)),
        "a name": f"{hidden.id} is the hard one",
        "inputs": hidden.source,
    }
    for name, text in leaked.items():
        notebook = {"cells": [{"cell_type": "markdown", "source": f"{text}\n".splitlines(keepends=True)}]}
        path = tmp_path / f"{name}.ipynb"
        path.write_text(json.dumps(notebook))
        assert list(HandedOut([path]).leaks(exercise)), name


class Renamed(ast.NodeTransformer):
    """Gives every variable another name."""

    def visit_Name(self, node):
        return ast.Name(f"{node.id}_2" if node.id not in ("np", "range", "len") else node.id, node.ctx)

    def visit_arg(self, node):
        return ast.arg(f"{node.arg}_2")

    def visit_FunctionDef(self, node):
        node.name += "_2"
        return self.generic_visit(node)
