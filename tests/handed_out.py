"""What learners can read (a hand-out, the site), searched for solutions and hidden cases."""

import ast
import io
import json
import zipfile

from nbclassroom.exercises.canonical import encode
from nbclassroom.exercises.cell_syntax import plain_python
from nbclassroom.gradebook.submission_reader import syntax_tokens

RUN = 16  # tokens; a line of code has about ten
COPIED = 0.8  # of a solution's runs of tokens: a text that shares more contains it


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


def runs_of_tokens(source):
    """Every RUN successive tokens of a source, whatever its own names, as a set."""
    tokens = ["V" if token[:1] == "V" and token[1:].isdigit() else token for token in syntax_tokens(source)]
    return {tuple(tokens[start : start + RUN]) for start in range(len(tokens) - RUN + 1)}


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
        self.shapes = {tuple(syntax_tokens(source)) for source in functions}
        self.runs = [runs_of_tokens(plain_python(text)) for text in texts if "\n" in text]

    def share_of(self, source):
        """The largest share of a source's runs of tokens that one text has."""
        runs = runs_of_tokens(source)
        if len(runs) <= RUN:
            return 0
        return max((len(runs & others) for others in self.runs), default=0) / len(runs)

    def leaks(self, exercise):
        """What of an exercise learners must not get, and would get."""
        source = exercise.solution
        if exercise.kind.graded_by_person:
            texts = [source, *(text for text, _ in exercise.rubric)]
            yield from (f"{text!r}" for text in texts if squeezed(text) in self.text)
            return
        body = body_of(source) if exercise.subject == "function" else without_imports(source)
        if body in self.text:
            yield "the solution, as text"
        if {tuple(syntax_tokens(function)) for function in functions_in(source)} & self.shapes:
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
