"""Reads notebooks that learners handed in, in a process of its own that may be lost.

`lift` starts it with a limit on memory, hands it bytes and takes back plain data: of each cell its id, its
type and, where it is one of the course's, its source. Nothing of a notebook is run or followed here.
"""

import ast
import json
import resource
import sys

LONGEST = 200_001  # characters of one source: one more than are graded
MOST_CELLS = 5_000
_COURSE = ("answer-", "check-", "given-")
_DEFINES = 200  # names of functions that are told of one cell
_SHOWN = 2_000  # characters of a check cell's output
_NAME = 200


class Unreadable(ValueError):
    """The reason, to be read by a teacher and a learner."""


def read_notebook(data):
    """What a notebook holds, as plain data.

    Parameters
    ----------
    data : bytes of the file

    Returns
    -------
    dict with lesson, version, kernel (str or None), format (str), cells: list of dict

    Raises
    ------
    Unreadable : it is none
    """
    notebook = _parsed(data)
    form = notebook.get("nbformat")
    if isinstance(form, bool) or not isinstance(form, int):
        raise Unreadable("it does not say which notebook format it has; save it again in JupyterLab")
    if form != 4:
        raise Unreadable(
            f"it has notebook format {str(form)[:20]}, and cells have names from format 4.5 on; open the"
            " lesson in JupyterLab and copy your answers there"
        )
    cells = notebook.get("cells")
    if not isinstance(cells, list):
        raise Unreadable("it has no list of cells")
    if len(cells) > MOST_CELLS:
        raise Unreadable(f"it has {len(cells)} cells; at most {MOST_CELLS} are read")
    metadata = _dict(notebook.get("metadata"))
    about = _dict(metadata.get("imgproc_course"))
    return {
        "lesson": _text(about.get("lesson")),
        "version": _text(about.get("version")),
        "kernel": _text(_dict(metadata.get("kernelspec")).get("name")),
        "minor": notebook["nbformat_minor"] if isinstance(notebook.get("nbformat_minor"), int) else None,
        "cells": [_cell(cell) for cell in cells],
    }


def _parsed(data):
    if not data.strip():
        raise Unreadable("the file is empty")
    try:
        notebook = json.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise Unreadable(f"it is not UTF-8 text (byte {error.start}); save it again in JupyterLab") from error
    except RecursionError as error:
        raise Unreadable("it is nested too deep to be a notebook") from error
    except ValueError as error:
        where = getattr(error, "lineno", None)
        place = f" (line {where})" if where else ""
        raise Unreadable(f"it is no notebook: its JSON is broken{place}; save it again") from error
    if not isinstance(notebook, dict):
        raise Unreadable("it is no notebook: its JSON holds something else")
    return notebook


def _dict(value):
    return value if isinstance(value, dict) else {}


def _text(value):
    return value[:_NAME] if isinstance(value, str) else None


def _cell(cell):
    """A cell's id, type and, where it is the course's, its source; None for what is no cell."""
    if not isinstance(cell, dict):
        return None
    read = {"id": _text(cell.get("id")) or "", "type": _text(cell.get("cell_type")) or ""}
    source = cell.get("source")
    if isinstance(source, list) and all(isinstance(line, str) for line in source):
        source = "".join(source)
    is_text = isinstance(source, str)
    if read["id"].startswith(_COURSE):
        read["source"] = source[:LONGEST] if is_text else None
        read["orders"] = _orders(cell)
    else:
        read["defines"] = _defined(source) if is_text else []
        read["blank"] = not is_text or not source.strip()
    if read["id"].startswith("check-"):
        read["shown"] = _shown(cell)
    return read


def _orders(cell):
    """Tags by which nbval or nbgrader would take orders."""
    metadata = _dict(cell.get("metadata"))
    tags = metadata.get("tags")
    tags = [tag for tag in tags if isinstance(tag, str)] if isinstance(tags, list) else []
    found = [tag[:_NAME] for tag in tags if tag.startswith(("nbval-", "raises-exception", "skip", "otter"))]
    return found[:10] + [name for name in ("nbgrader", "points", "otter") if name in metadata]


def _defined(source):
    try:
        tree = ast.parse(source[:LONGEST])
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return [node.name[:_NAME] for node in tree.body if isinstance(node, kinds)][:_DEFINES]


def _shown(cell):
    """The beginning of what the stored outputs show as text."""
    outputs = cell.get("outputs")
    texts = []
    for output in outputs[:20] if isinstance(outputs, list) else ():
        output = _dict(output)
        for text in (output.get("text"), _dict(output.get("data")).get("text/plain")):
            if isinstance(text, list) and all(isinstance(line, str) for line in text):
                text = "".join(text)
            if isinstance(text, str):
                texts.append(text[:_SHOWN])
    return "\n".join(texts)[:_SHOWN]


def serve(incoming, outgoing):
    """Answer each `<length>\\n<bytes>` with one line of JSON."""
    while header := incoming.readline():
        data = incoming.read(int(header))
        try:
            answer = {"read": read_notebook(data)}
        except Unreadable as reason:
            answer = {"reason": str(reason)}
        except (MemoryError, RecursionError):
            answer = {"reason": "reading it takes more memory than a notebook needs"}
        outgoing.write(json.dumps(answer).encode("ascii") + b"\n")
        outgoing.flush()


if __name__ == "__main__":
    memory = int(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    serve(sys.stdin.buffer, sys.stdout.buffer)
