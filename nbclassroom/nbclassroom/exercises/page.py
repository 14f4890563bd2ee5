"""What of a notebook is graded: what Restart & Run All would have run up to each exercise's check.

A page is plain data:

    answers   {exercise id: source of the cell that holds its answer}
    cells     the cells that run, from the top: {"kind", "source", "exercise", "file"}; `kind` is "given" (as
              handed out) or "own" (the learner's); `exercise` is the id of the exercise that the cell
              answers, or ""; `file` is the name that `%%writefile` gives, or "", with a `mode`: "w" or "a"
    checks    {exercise id: how many of the cells run before its check}
    left_out  [[number of a cell, number of a statement], ...]: stubs

Nothing is run here, and only the standard library and `cell_syntax` are imported: the process that reads
notebooks loads this file (see `gradebook.submission_reader`). `page_run` runs a page.
"""

import re
from itertools import pairwise

if __package__:
    from . import cell_syntax
else:  # a module by itself, which mypy does not know
    import cell_syntax  # type: ignore[import-not-found,no-redef]

_CHECK = re.compile(r"""\bcheck\(\s*["']([\w-]+)["']""")
_WRITE_FILE = re.compile(r"\s*%%writefile[ \t]+(-a[ \t]+)?([\w./-]+)[ \t]*\n")


def page_of(answers, lesson):
    """The page of answers alone, {exercise id: source}, each below the given cells of its exercise."""
    cells, checks = [], {}
    for exercise in lesson.exercises:
        if isinstance(answers.get(exercise.id), str):
            cells += [_counted("given", source) for source in exercise.given]
            cells.append(_counted("own", answers[exercise.id], exercise.id))
            checks[exercise.id] = len(cells)
    return {"answers": dict(answers), "cells": cells, "checks": checks, "left_out": []}


def page_of_notebook(cells, lesson_cells, exercises):
    """(The page of a notebook, {exercise id: numbers of the cells that answer it, the first one counts}).

    `cells` are as `submission_reader.read_notebook` describes them, `lesson_cells` {cell id: source of a
    check or given cell as handed out, None for the others}, `exercises` [id, function, source of the stub].
    """
    counted, origins, calls = _counted_cells(cells, lesson_cells, exercises)
    answers, places, checks, left_out = {}, {}, {}, list[list]()
    for id, function, stub in exercises:
        definitions, stubs = _definitions(counted, function, stub)
        left_out += stubs if definitions else []
        marked = [place for place, cell in enumerate(counted) if cell["exercise"] == id]
        checks[id] = check = max([calls.get(id, len(counted)), *(place + 1 for place in marked[:1])])
        found = {place for place, _ in definitions}  # the last one above the check, or the first one below
        ordered = sorted(found, key=lambda place: (place >= check, abs(place - check)))
        places[id] = list(dict.fromkeys(origins[place]["number"] for place in ordered))
        for place in [*ordered, *marked][:1]:
            counted[place]["exercise"] = id
            answers[id] = counted[place]["source"]
    return {"answers": answers, "cells": counted, "checks": checks, "left_out": left_out}, places


def _counted_cells(cells, lesson_cells, exercises):
    """(A page's cells, for each the notebook's cell, {exercise id: how many stand above its last check})."""
    in_code = {name for cell in cells if cell["type"] == "code" for name in cell["names"]}
    in_text = {function for _, function, _ in exercises} - in_code  # counts if there is no other answer
    present = {cell["id"] for cell in cells}
    deleted = [{"id": id, "type": "code", "exercise": ""} for id in lesson_cells if id not in present]
    counted, origins, calls = [], [], dict[str, int]()
    for cell in [*deleted, *cells]:
        if cell["type"] == "code" or in_text & {*cell["names"]}:
            for part in _parts(cell, lesson_cells, exercises):
                if part["kind"]:
                    counted.append(part)
                    origins.append(cell)
                calls |= dict.fromkeys(_CHECK.findall(re.sub("#.*", "", part["source"])), len(counted))
    return counted, origins, calls


def _parts(cell, lesson_cells, exercises):
    """What runs of a cell: a given cell as handed out, what was changed in parts that end with a check."""
    source, handed_out = cell.get("source"), lesson_cells.get(cell["id"])
    if handed_out is not None and cell["id"].startswith("given-"):
        yield _counted("given", handed_out)
    mark = cell["exercise"] if cell["exercise"] in (id for id, *_ in exercises) else ""
    if source is not None and (source.strip() or mark):
        own = _counted("" if handed_out and handed_out.strip() == source.strip() else "own", source, mark)
        is_cut = not own["file"] and _CHECK.search(own["source"])
        lines, nodes = own["source"].split("\n"), cell_syntax.top_level(own["source"] if is_cut else "")
        spans = [(node.lineno - 1, node.end_lineno) for node in nodes[:-1]]
        ends = [end for begin, end in spans if _CHECK.search("\n".join(lines[begin:end]))]
        for begin, end in pairwise([0, *ends, len(lines)]):
            yield own | {"source": "\n" * begin + "\n".join(lines[begin:end])}


def _counted(kind, source, exercise=""):
    source = source.replace("\r\n", "\n").replace("\r", "\n")
    match = _WRITE_FILE.match(source)
    text = source[match.end() :] if match else cell_syntax.plain_python(source)
    file, mode = (match[2], "a" if match[1] else "w") if match else ("", "")
    return {"kind": kind, "source": text, "exercise": exercise, "file": file, "mode": mode}


def _definitions(cells, function, stub):
    """([number of a cell, of a statement] of all statements that bind a function, of its stubs apart)."""
    found: tuple[list, list] = ([], [])
    for number, cell in enumerate(cells):
        is_read = function and function in cell["source"] and cell["kind"] != "given" and not cell["file"]
        for place, statement in enumerate(cell_syntax.top_level(cell["source"]) if is_read else ()):
            if function in cell_syntax.names_of(statement).binds:
                found[cell_syntax.is_stub(statement, stub)].append([number, place])
    return found
