"""What of a notebook is graded: what Restart & Run All would have run up to each exercise's check.

A page is plain data:

    answers   {exercise id: source of the cell that holds its answer}
    cells     the cells that run, from the top: {"kind", "source", "exercise", "file"}; `kind` is "given" (as
              handed out), "lesson" or "own" (the learner's, answers too); `exercise` is the id of the
              exercise that the cell answers, or ""; `file` is the name that `%%writefile` gives, or "", with
              a `mode`: "w", or "a" to append
    checks    {exercise id: [number of a cell, number of a statement in it], before which its check runs}
    left_out  [[number of a cell, number of a statement], ...]: stubs, and what spins a node

Nothing is run here, and only the standard library and `cell_syntax` are imported: the process that reads
notebooks loads this file (see `gradebook.submission_reader`). `page_run` runs a page.
"""

import ast
import re

if __package__:
    from . import cell_syntax
else:  # a module by itself, which mypy does not know
    import cell_syntax  # type: ignore[import-not-found,no-redef]

_WRITE_FILE = re.compile(r"\s*%%writefile[ \t]+(-a[ \t]+)?([\w./-]+)[ \t]*\n")


def page_of(answers, lesson):
    """The page of answers alone, {exercise id: source}, each below the given cells of its exercise."""
    cells, checks = [], {}
    for exercise in lesson.exercises:
        if isinstance(answers.get(exercise.id), str):
            cells += [_counted("given", source) for source in exercise.given]
            cells.append(_counted("own", answers[exercise.id], exercise.id))
            checks[exercise.id] = [len(cells), 0]
    functions = {exercise.id: exercise.function for exercise in lesson.exercises}
    return _page(dict(answers), cells, checks, functions)


def page_of_notebook(cells, lesson_cells, exercises):
    """(The page of a notebook, {exercise id: numbers of the cells that answer it, the first one counts}).

    `cells` are as `submission_reader.read_notebook` describes them, `lesson_cells` {cell id: source of a
    check or given cell as handed out, None for the others}, `exercises` [id, function, source of the stub].
    """
    functions = {id: function for id, function, _ in exercises}
    counted, checks = _counted_cells(cells, lesson_cells, functions)
    answers, places = {}, {}
    for id, function, stub in exercises:
        found = [
            place for place, (_, cell) in enumerate(counted) if cell and _is_answer(cell, id, function, stub)
        ]
        marked = [place for place, (one, _) in enumerate(counted) if one["exercise"] == id]
        check = checks.setdefault(id, [len(counted), 0])
        above_check = [place for place in found if place in marked][:1]
        if above_check and above_check[0] >= check[0]:  # the check stands above the answer
            checks[id] = check = [above_check[0] + 1, 0]
        ordered = sorted(
            found, key=lambda place: ([place, 0] >= check, place if [place, 0] >= check else -place)
        )
        places[id] = [counted[place][1]["number"] for place in ordered]
        for place in [*ordered, *marked][:1]:
            counted[place][0]["exercise"] = id
            answers[id] = counted[place][1]["source"]
    return _page(answers, [one for one, _ in counted], checks, functions), places


def _counted_cells(cells, lesson_cells, functions):
    """([(a page's cell, the notebook's cell or None), ...], {exercise id: place of its last check})."""
    in_code = {name for cell in cells if cell["type"] == "code" for name in cell["functions"]}
    in_text = set(functions.values()) - in_code  # an answer in a text counts if there is no other one
    present = {cell["id"] for cell in cells}
    absent = [id for id in lesson_cells if id.startswith("given-") and lesson_cells[id] and id not in present]
    counted, checks = [(_counted("given", lesson_cells[id]), None) for id in absent], {}
    for cell in cells:
        if cell["type"] == "code" or in_text & {*cell["functions"]}:
            own = [*_parts(cell, lesson_cells.get(cell["id"]), cell["id"] in lesson_cells, functions)]
            counted += own
            for id in functions if cell["type"] == "code" else ():
                if (statement := _statement_of_check(id, cell.get("source") or "")) is not None:
                    checks[id] = [len(counted) - 1, statement] if own else [len(counted), 0]
    return counted, checks


def _parts(cell, handed_out, is_lessons, functions):
    """What runs of a cell, see `_counted_cells`: a given cell as handed out, and what was changed."""
    source = cell.get("source")
    if handed_out is not None and cell["id"].startswith("given-"):
        yield _counted("given", handed_out), None
    is_as_handed_out = handed_out is not None and handed_out.strip() == (source or "").strip()
    mark = next((id for id in functions if is_marked(cell, id)), "")
    if not is_as_handed_out and source is not None and (source.strip() or mark):
        yield _counted("lesson" if is_lessons and not mark else "own", source, mark), cell


def is_marked(cell, exercise):
    """Whether a cell is the answer cell of an exercise, by its id or its metadata."""
    return cell["id"] == f"answer-{exercise}" or cell["exercise"] == exercise


def _is_answer(cell, exercise, function, stub):
    """Whether a cell defines the function of an exercise, and not as the stub.

    A marked cell may define it in any way, or so that reading does not find out.
    """
    if function in cell["functions"]:
        source = cell_syntax.plain_python(cell["source"])
        definition = cell_syntax.definitions(source)[function]
        own_source = ast.get_source_segment(source, definition) or source
        is_handed_out = cell_syntax.is_whole_part(own_source, stub)
        return not is_handed_out and not cell_syntax.is_blank(definition)
    if "answer" not in cell or cell["type"] != "code" or not is_marked(cell, exercise):
        return False
    names = cell["answer"]["names"]
    return not cell["answer"]["error"] and (names is None or function in names)


def _counted(kind, source, exercise=""):
    source = source.replace("\r\n", "\n").replace("\r", "\n")
    match = _WRITE_FILE.match(source) if kind != "given" else None
    if match:
        written = {"source": source[match.end() :], "file": match[2], "mode": "a" if match[1] else "w"}
        return {"kind": kind, "exercise": exercise} | written
    return {"kind": kind, "source": cell_syntax.plain_python(source), "exercise": exercise, "file": ""}


def _statement_of_check(id, source):
    """The number of the last statement with an exercise's check, 0 if it is unknown; None: there is none."""
    call = re.compile(rf"""\bcheck\(\s*["']{re.escape(id)}["']""")
    if not call.search(source):
        return None
    source = cell_syntax.plain_python(source)
    parts = [ast.get_source_segment(source, part) or "" for part in cell_syntax.top_level(source)]
    numbers = [number for number, part in enumerate(parts) if call.search(part)]
    return numbers[-1] if numbers else None if parts else 0


def _page(answers, cells, checks, functions):
    left_out, stubs, defined = [], [], set()
    for number, cell in enumerate(cells):
        statements = [] if cell["file"] else cell_syntax.top_level(cell["source"])
        endless = cell_syntax.statements_that_call(statements, cell_syntax.ENDLESS_CALLS)
        for place, statement in enumerate(statements):
            name = cell_syntax.callable_name(statement)
            left_out += [[number, place]] if statement in endless else []
            if name in functions.values() and cell_syntax.is_blank(statement):
                stubs.append((name, [number, place]))
            else:
                defined.add(name)
    left_out += [place for name, place in stubs if name in defined]
    return {"answers": answers, "cells": cells, "checks": checks, "left_out": left_out}
