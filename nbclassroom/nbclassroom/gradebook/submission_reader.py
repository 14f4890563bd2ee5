"""Reads notebooks of learners, in a process of its own that may fail without harm.

`submission.NotebookReader` starts this file as a program with limits on memory and processor time, sends
it the bytes of a notebook and receives plain data: the id and type of each cell, and the sources of code. It
also makes the page that is graded, and takes the shapes of answers. Nothing in a notebook is run or
followed. The program imports the standard library only, and `cell_syntax` and `page`, which do the same: it
starts quickly, and no module of a learner can take the place of ours.
"""

import ast
import builtins
import codecs
import ctypes
import functools
import hashlib
import json
import re
import resource
import signal
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path.append(str(Path(__file__).parents[1] / "exercises"))
    import cell_syntax  # type: ignore[import-not-found]  # modules by themselves, which mypy does not know
    import page  # type: ignore[import-not-found]
else:
    from nbclassroom import course
    from nbclassroom.exercises import cell_syntax, page

MOST_CHARACTERS = 200_000  # of one source; grading refuses a longer answer
MOST_CELLS = 5_000
MOST_CODE = 2_000_000  # characters of all cells that are not the course's; what comes after is not searched
_COURSE_IDS = ("answer-", "check-", "given-")
_MOST_NAMES = 500  # that are returned of a cell
_MOST_NAME = 200  # characters of a name or an id
_SAVE = "save it again in JupyterLab"
_FENCED = re.compile(r"^```\w*\n(.*?)^```", re.M | re.S)  # code in a Markdown cell
_CODE_BEGINS = re.compile(r"^(def|async def|class) \w|^\w+ *= *(lambda|\w)", re.M)
_CHECK_OF_WRITTEN = re.compile(r"""\s*check\(\s*["']([\w-]+)["']\s*\);?\s*""")
_PR_SET_PDEATHSIG = 1
_COURSE = sys.argv[3] if __name__ == "__main__" else course.name
# Of the shape of an answer.
LONGEST = 20_000  # characters of an answer; a longer one is not compared
_NAMES = ("id", "arg", "name", "asname")  # fields of syntax that hold a name
_KEPT = {"np", *dir(builtins)}  # everybody's
_IGNORED = (ast.expr_context, ast.Import, ast.ImportFrom, ast.Pass)
_UNTOLD = {"annotation", "returns", "type_comment", "kind"}  # fields that change nothing


class UnreadableError(ValueError):
    """Why the bytes are not a notebook, for instructors and learners."""


def read_notebook(data):
    """Read the bytes of a notebook as plain data; UnreadableError: they are none of format 4.

    lesson, version, python  str, or None if the notebook does not name them
    deeper  list, with the ids of the exercises that can be left out
    cells  list of dict, None in the place of anything that is not a cell. Each has `number`, `id`, `type`,
           `exercise` (by its id or metadata, or `by_place` that of the check below; or "") and `names`
           (that it binds at its top level; of a cell that is no code only if its text is). A code cell
           and a cell of the course have `source` (str, at most one character more than MOST_CHARACTERS; None
           if it is not text, or after MOST_CODE), an answer cell also `answer` (see `_parsed_answer`)
    """
    notebook = _parsed(data)
    nbformat = notebook.get("nbformat")
    if isinstance(nbformat, bool) or not isinstance(nbformat, int):
        raise UnreadableError(f"it does not say which notebook format it has; {_SAVE}")
    if nbformat != 4:
        problem = f"it has notebook format {str(nbformat)[:20]}, and only format 4 can be read"
        raise UnreadableError(f"{problem}; open the lesson in JupyterLab and copy your answers there")
    cells = notebook.get("cells")
    if not isinstance(cells, list):
        raise UnreadableError(f"it has no list of cells; {_SAVE}")
    if len(cells) > MOST_CELLS:
        raise UnreadableError(f"it has {len(cells)} cells; at most {MOST_CELLS} are read")
    return {
        "lesson": _text(notebook, "metadata", _COURSE, "lesson"),
        "version": _text(notebook, "metadata", _COURSE, "version"),
        "python": _text(notebook, "metadata", "language_info", "version"),
        "deeper": _at(notebook, list, "metadata", _COURSE, "deeper") or [],
        "cells": _cells(cells),
    }


def _parsed(data):
    if not data.strip():
        raise UnreadableError("the file is empty")
    # Windows PowerShell and some editors save UTF-16; its byte order mark cannot begin UTF-8.
    encoding = "utf-16" if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig"
    try:
        notebook = json.loads(data.decode(encoding))
    except UnicodeDecodeError as error:
        name = "UTF-16" if encoding == "utf-16" else "UTF-8"
        raise UnreadableError(f"it is not {name} text (byte {error.start}); {_SAVE}") from error
    except RecursionError as error:
        raise UnreadableError("it is nested too deep to be a notebook") from error
    except ValueError as error:
        place = f" (line {error.lineno})" if isinstance(error, json.JSONDecodeError) else ""
        raise UnreadableError(f"it is not a notebook: its JSON is broken{place}; {_SAVE}") from error
    if not isinstance(notebook, dict):
        raise UnreadableError("it is not a notebook: its JSON holds something else")
    return notebook


def _at(value, kind, *names):
    """What is found by these names in dicts within dicts, if it is of this kind; else None."""
    for name in names:
        value = value.get(name) if isinstance(value, dict) else None
    return value if isinstance(value, kind) else None


def _text(value, *names):
    text = _at(value, str, *names)
    return None if text is None else text[:_MOST_NAME]


def _joined(text):
    """A text that may be stored as a list of lines, as one str, cut; None if it is neither."""
    if isinstance(text, list) and all(isinstance(line, str) for line in text):
        text = "".join(text)
    return text[: MOST_CHARACTERS + 1] if isinstance(text, str) else None


def _cells(cells):
    contents, code_left, by_place = [], MOST_CODE, _written_by_place(cells)
    for number, cell in enumerate(cells):
        content = _cell(cell, number, code_left, by_place) if isinstance(cell, dict) else None
        contents.append(content)
        if content and "answer" not in content:
            code_left -= len(content.get("source") or "")
    return contents


def _written_by_place(cells):
    """{number of a cell: the written exercise whose only check is below it}."""
    sources = [_joined(_at(cell, object, "source")) or "" for cell in cells]
    checks = [_CHECK_OF_WRITTEN.fullmatch(source) for source in sources[1:]]
    ids = [match[1] if match else "" for match in checks]
    return {number: id for number, id in enumerate(ids) if id and ids.count(id) == 1}


def _cell(cell, number, code_left, by_place):
    content = {
        "number": number,
        "id": _text(cell, "id") or "",
        "type": _text(cell, "cell_type") or "",
        "exercise": _text(cell, "metadata", _COURSE, "exercise") or "",
        "names": [],
    }
    has_mark = content["exercise"] or content["id"].startswith(_COURSE_IDS)
    content["by_place"] = number in by_place and not has_mark
    content["exercise"] = by_place[number] if content["by_place"] else content["exercise"]
    if content["id"].startswith("answer-"):
        content["exercise"] = content["id"].removeprefix("answer-")
    is_answer = bool(content["exercise"])
    source = _joined(cell.get("source"))
    if is_answer or content["id"].startswith(_COURSE_IDS):
        content["source"] = source
    elif content["type"] == "code":
        content["source"] = source if len(source or "") <= code_left else None
    if is_answer and source is not None:
        content["answer"] = _parsed_answer(source)
    source = content["source"] if content["type"] == "code" else _code_in(source or "")
    if source:
        content["names"] = _bound_names(source)
    if content["names"]:
        content["source"] = source
    return content


def _code_in(text):
    """What a cell of text has in code fences, or all of it; "" if no line of it begins like code."""
    code = "\n".join(_FENCED.findall(text)) or text
    return code if len(code) <= MOST_CHARACTERS and _CODE_BEGINS.search(code) else ""


@functools.lru_cache(maxsize=2_000)  # most cells are the lesson's, in every notebook
def _bound_names(source):
    names = sorted(cell_syntax.bound_names(cell_syntax.plain_python(source)))
    return [name for name in names if len(name) <= _MOST_NAME][:_MOST_NAMES]


def _parsed_answer(source):
    """What the syntax of an answer says.

    error : [line number, text of the line, message] of an error, or None
    functions : names of its functions and classes
    stub_lines : those that go on after the stub's `raise NotImplementedError(...)`
    """
    try:
        statements = ast.parse(cell_syntax.plain_python(source)).body
    except cell_syntax.UNPARSABLE as error:
        line, text = getattr(error, "lineno", None) or 1, getattr(error, "text", None) or ""
        message = getattr(error, "msg", type(error).__name__)
        return {"error": [line, text.strip()[:_MOST_NAME], message[:_MOST_NAME]]}
    found = [part for part in statements if isinstance(part, cell_syntax.DEFINITIONS)][:_MOST_NAMES]
    stubs = [part.name for part in found if cell_syntax.has_stub_line(part)]
    return {"error": None, "functions": [part.name for part in found], "stub_lines": stubs}


def syntax_tokens(source):
    """The tokens of a source, a list of str: kinds of syntax, constants, attributes, and everybody's names.

    Another name is "V" and its number, by first occurrence. Of a text that is no Python, such
    as a written answer, they are its words. There are none if the source is longer than LONGEST.
    """
    try:
        tree = ast.parse(source) if len(source) <= LONGEST else ast.Module([], [])
    except cell_syntax.UNPARSABLE:
        return source.split()
    tokens, nodes = [], [tree]
    numbers: dict[str, int] = {}
    while nodes:
        node = nodes.pop()
        if isinstance(node, tuple):
            tokens.append(f"V{numbers.setdefault(node[0], len(numbers))}")
        elif isinstance(node, str):
            tokens.append(node)
        elif isinstance(node, ast.Constant):
            value = node.value  # Python refuses to write huge decimals
            tokens.append(hex(value) if type(value) is int else repr(value))
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue  # a docstring, or another statement that is only a text
        elif not isinstance(node, _IGNORED):
            tokens.append(type(node).__name__)
            nodes += reversed(list(_parts(node)))
    return tokens


def _parts(node):
    """What is inside a node; a name of its own in a tuple. So is an attribute of self."""
    names = (*_NAMES, "attr") if getattr(getattr(node, "value", None), "id", "") == "self" else _NAMES
    for field, value in ast.iter_fields(node):
        if isinstance(value, str) and field not in _UNTOLD:
            yield (value,) if field in names and value not in _KEPT else value
        elif field not in _UNTOLD:
            parts = value if isinstance(value, list) else (value,)
            yield from (part for part in parts if isinstance(part, ast.AST))


def shapes(answers):
    """The shapes of {id: source}: {id: [digest, number of tokens]}, without sources that have no tokens.

    The shape of an answer is what it is by its syntax, whatever its names, numbers, comments and spacing.
    """
    found = {}
    for id, source in answers.items():
        if tokens := syntax_tokens(source):
            text = "\0".join("number" if token[:1].isdigit() else token for token in tokens)
            digest = hashlib.blake2b(text.encode("utf-8", "surrogatepass"), digest_size=8).hexdigest()
            found[id] = [digest, len(tokens)]
    return found


def serve(requests, replies, most_memory, seconds):
    """Answer each request with a line of JSON, until there is no more, or the memory is in use.

    `read <length>`, and the bytes of a notebook: {"notebook": } or {"reason": }
    `page <length>`, and [lesson_cells, exercises] of `page.page_of_notebook` as JSON: that of the last
    notebook, {"page": , "places": , "shapes": }, see `shapes`

    With more than `most_memory` bytes in use, it ends instead of reading another notebook: so what it
    remembers of earlier notebooks leaves enough memory for each one. A request that takes more `seconds` of
    processor time ends it.
    """
    notebook: dict = {}
    while header := requests.readline():
        kind, length = header.split()
        if kind == b"read" and _memory_in_use() > most_memory:
            return
        body = requests.read(int(length))
        signal.setitimer(signal.ITIMER_PROF, seconds)  # nobody handles its signal, which ends the process
        try:
            if kind == b"read":
                notebook = read_notebook(body)
                reply: dict = {"notebook": notebook}
            else:
                cells = [cell for cell in notebook["cells"] if cell is not None]
                made, places = page.page_of_notebook(cells, *json.loads(body))
                reply = {"page": made, "places": places, "shapes": shapes(made["answers"])}
        except UnreadableError as error:
            reply = {"reason": str(error)}
        except (MemoryError, RecursionError):
            reply = {"reason": "reading it takes more memory than a notebook needs"}
        replies.write(json.dumps(reply).encode("ascii") + b"\n")
        replies.flush()


def _memory_in_use():
    """Bytes of this process; 0 where the system does not say it."""
    try:
        pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
    except OSError:
        return 0
    return int(pages) * resource.getpagesize()


if __name__ == "__main__":
    memory = int(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)  # end with the process that started this
    serve(sys.stdin.buffer, sys.stdout.buffer, memory // 4, float(sys.argv[2]))
