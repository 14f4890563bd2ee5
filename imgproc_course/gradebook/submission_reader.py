"""Reads notebooks of learners, in a process of its own that may fail without harm.

`submission.NotebookReader` starts this file as a program with a limit on memory, sends it the bytes of a
notebook and receives plain data: the id and type of each cell, and the source of the cells that belong to
the course. Nothing in a notebook is run or followed. The program imports the standard library only: it
starts quickly, and no module of a learner can take the place of ours.
"""

import ast
import ctypes
import hashlib
import json
import resource
import signal
import sys

MOST_CHARACTERS = 200_000  # of one source; grading refuses a longer answer
MOST_CELLS = 5_000
_COURSE_IDS = ("answer-", "check-", "given-", "predict-")
_MOST_FUNCTIONS = 200  # function names that are returned per cell
_MOST_OUTPUT = 2_000  # characters of a check cell's output
_MOST_NAME = 200  # characters of a name or an id
_PR_SET_PDEATHSIG = 1
_UNPARSABLE = (SyntaxError, ValueError, RecursionError, MemoryError)


class UnreadableError(ValueError):
    """Why the bytes are not a notebook, for instructors and learners."""


def read_notebook(data):
    """Read a notebook as plain data.

    Parameters
    ----------
    data : bytes of the file

    Returns
    -------
    dict with

    lesson, version, kernel : str, or None if the notebook does not name them
    cells : list of dict, None in the place of anything that is not a cell. Each has `id`, `type`, and of code
        cells `functions` (names defined at the top level). A cell of the course has `source`
        (str, at most one character more than MOST_CHARACTERS; None if it is not text) and `grader_tags`; an
        answer cell also has `answer` (see `_parsed_answer`), a check cell `output`

    Raises
    ------
    UnreadableError : the bytes are not a notebook of format 4
    """
    notebook = _parsed(data)
    nbformat = notebook.get("nbformat")
    if isinstance(nbformat, bool) or not isinstance(nbformat, int):
        raise UnreadableError("it does not say which notebook format it has; save it again in JupyterLab")
    if nbformat != 4:
        raise UnreadableError(
            f"it has notebook format {str(nbformat)[:20]}, but only cells of format 4 have ids; open the"
            " lesson in JupyterLab and copy your answers there"
        )
    cells = notebook.get("cells")
    if not isinstance(cells, list):
        raise UnreadableError("it has no list of cells; save it again in JupyterLab")
    if len(cells) > MOST_CELLS:
        raise UnreadableError(f"it has {len(cells)} cells; at most {MOST_CELLS} are read")
    metadata = _dict(notebook.get("metadata"))
    about = _dict(metadata.get("imgproc_course"))
    return {
        "lesson": _text(about.get("lesson")),
        "version": _text(about.get("version")),
        "kernel": _text(_dict(metadata.get("kernelspec")).get("name")),
        "cells": [_cell(cell) for cell in cells],
    }


def _parsed(data):
    if not data.strip():
        raise UnreadableError("the file is empty")
    try:
        notebook = json.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise UnreadableError(
            f"it is not UTF-8 text (byte {error.start}); save it again in JupyterLab"
        ) from error
    except RecursionError as error:
        raise UnreadableError("it is nested too deep to be a notebook") from error
    except ValueError as error:
        line = getattr(error, "lineno", None)
        place = f" (line {line})" if line else ""
        raise UnreadableError(
            f"it is not a notebook: its JSON is broken{place}; save it again in JupyterLab"
        ) from error
    if not isinstance(notebook, dict):
        raise UnreadableError("it is not a notebook: its JSON holds something else")
    return notebook


def _dict(value):
    return value if isinstance(value, dict) else {}


def _text(value):
    return value[:_MOST_NAME] if isinstance(value, str) else None


def _joined(text):
    """A text that may be stored as a list of lines, as one str; None if it is neither."""
    if isinstance(text, list) and all(isinstance(line, str) for line in text):
        text = "".join(text)
    return text if isinstance(text, str) else None


def _cell(cell):
    """A cell as `read_notebook` describes it; None for anything that is not a cell."""
    if not isinstance(cell, dict):
        return None
    content = {"id": _text(cell.get("id")) or "", "type": _text(cell.get("cell_type")) or ""}
    source = _joined(cell.get("source"))
    if source is not None:
        source = source[: MOST_CHARACTERS + 1]
    if content["type"] == "code":
        content["functions"] = function_names(source or "")
    if content["id"].startswith(_COURSE_IDS):
        content["source"] = source
        content["grader_tags"] = _grader_tags(cell)
    if content["id"].startswith("answer-") and source is not None:
        content["answer"] = _parsed_answer(source)
    if content["id"].startswith("check-"):
        content["output"] = _output_text(cell)
    return content


def _grader_tags(cell):
    """The tags and metadata that would direct nbval, nbgrader or otter-grader."""
    metadata = _dict(cell.get("metadata"))
    tags = metadata.get("tags")
    tags = [tag for tag in tags if isinstance(tag, str)] if isinstance(tags, list) else []
    prefixes = ("nbval-", "raises-exception", "skip", "otter")
    grader_tags = [tag[:_MOST_NAME] for tag in tags if tag.startswith(prefixes)]
    return grader_tags[:10] + [name for name in ("nbgrader", "points", "otter") if name in metadata]


def function_names(source):
    """The names of the functions that a source defines at its top level; empty if it does not parse."""
    try:
        tree = ast.parse(source)
    except _UNPARSABLE:
        return []
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return [node.name[:_MOST_NAME] for node in tree.body if isinstance(node, kinds)][:_MOST_FUNCTIONS]


def syntax_digest(source):
    """SHA-256 of a source's syntax tree: equal for sources that differ only in comments and spacing.

    Returns
    -------
    str of hexadecimal digits, or None if the source does not parse
    """
    try:
        return _tree_digest(ast.parse(source))
    except _UNPARSABLE:
        return None


def _tree_digest(tree):
    try:
        return hashlib.sha256(ast.dump(tree).encode("utf-8", "surrogatepass")).hexdigest()
    except (RecursionError, MemoryError):
        return None


def _parsed_answer(source):
    """What the syntax of an answer says.

    Returns
    -------
    dict with

    error : [line number, text of the line, message] of a syntax error, or None
    digest : see `syntax_digest`
    names : list of str, what the source binds at its top level; None if that is unknown
    """
    try:
        tree = ast.parse(source)
    except SyntaxError as error:
        text = (error.text or "").strip()[:_MOST_NAME]
        return {"error": [error.lineno or 1, text, error.msg[:_MOST_NAME]], "digest": None, "names": None}
    except (ValueError, RecursionError, MemoryError):
        return {"error": None, "digest": None, "names": None}
    return {"error": None, "digest": _tree_digest(tree), "names": _bound_names(tree)}


def _bound_names(tree):
    """The names that a module binds at its top level; None if it imports `*`, which can bind any name."""
    names, nodes = set(), list(tree.body)
    while nodes:
        node = nodes.pop()
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            names.add(node.name)
            continue
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            names |= {(alias.asname or alias.name).split(".")[0] for alias in node.names}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        if not isinstance(node, ast.Lambda):
            nodes.extend(ast.iter_child_nodes(node))
    return None if "*" in names else sorted(names)


def _output_text(cell):
    """The beginning of a cell's stored outputs, as text."""
    outputs = cell.get("outputs")
    texts = []
    for output in outputs[:20] if isinstance(outputs, list) else ():
        output = _dict(output)
        for text in (output.get("text"), _dict(output.get("data")).get("text/plain")):
            texts.append((_joined(text) or "")[:_MOST_OUTPUT])
    return "\n".join(filter(None, texts))[:_MOST_OUTPUT]


def serve(requests, replies):
    """Answer each request, `<length>\\n<bytes>`, with a line of JSON: {"notebook": } or {"reason": }."""
    while header := requests.readline():
        data = requests.read(int(header))
        try:
            reply = {"notebook": read_notebook(data)}
        except UnreadableError as error:
            reply = {"reason": str(error)}
        except (MemoryError, RecursionError):
            reply = {"reason": "reading it takes more memory than a notebook needs"}
        replies.write(json.dumps(reply).encode("ascii") + b"\n")
        replies.flush()


if __name__ == "__main__":
    memory = int(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)  # end with the process that started this
    serve(sys.stdin.buffer, sys.stdout.buffer)
