"""Write the files that a lesson carries, and those of an answer key; compare stored ones; what learners get.

texts/<lesson>.json holds {name of a figure: its "caption" and "alt"}, and its questions' answers and replies;
<lesson>.py, written by hand, is code that the lesson imports; `exercises.check_files` describes the others.
"""

import contextlib
import hashlib
import io
import json
import re
import zipfile
from dataclasses import dataclass, fields, replace

from .. import course
from ..exercises import check_files
from ..exercises.canonical import canonical, decode, encode, shorten_form
from ..exercises.check_files import CHECKS, FORMAT, SOLUTIONS, change_values
from ..exercises.comparison import compare
from ..exercises.lesson import PUBLIC_SEED, Exercise, check_data_of

KEEP_OUTPUT_TAG = "keep-output"
TEXTS = "texts"  # name of the folder of captions and alternative texts
_NOT_FOR_LEARNERS = re.compile(rf"\..*|masters|__pycache__|{course.FILE}|{CHECKS}|{SOLUTIONS}")
_SMALL_BYTES = 96  # a larger wrong array is stored by its digest
# Fields of an Exercise that no checks file has as they are, and those that only some have.
_LEFT_OUT = ("id", "mistakes", "master", "preparation", "solution", "explanation", "helpers")
_FOR_SOME = ("function", "subject", "sensors", "unheeded", "figure", "rubric", "witnesses")


def lesson_files(master):
    """{relative path: text} of what the lesson of a master carries."""
    module = master.path.parent.parent / f"{master.name}.py"  # beside the lesson
    files = {module.name: module.read_text(encoding="utf-8")} if module.is_file() else {}
    if master.texts or master.questions:
        texts = {name: {"caption": caption, "alt": alt} for name, (caption, alt) in master.texts.items()}
        files[f"{TEXTS}/{master.name}.json"] = _text_of(texts | master.questions)
    if master.exercises:
        # Rubrics are with the solutions: learners compare their answers with both.
        about = [(check_data_of(exercise), _witnesses(exercise)) for exercise in master.exercises]
        as_learners_get = [replace(data, rubric=(), witnesses=witnesses) for data, witnesses in about]
        stored = {exercise.id: stored_exercise(exercise) for exercise in as_learners_get}
        files |= exercise_files(master, stored)
    return files


def _witnesses(exercise):
    """The public cases of an exercise whose values are shown, with other inputs, without a word on them."""
    if not exercise.kind.shows_values:  # what nodes and drives do is long
        return ()
    cases = check_data_of(replace(exercise, mistakes=()), exercise.public, PUBLIC_SEED + 2).cases
    cases = [case for case in cases if "arguments" in _case_entry(case)]
    return tuple(
        replace(case, id=f"witness-{number}", title="", hint="", points=0)
        for number, case in enumerate(cases, 1)
    )


def exercise_files(master, stored, **about):
    """{relative path: text} of a lesson's exercises, {id: stored form}, and solutions; `about` a key more."""
    entries = {id: entry for id, (entry, _) in stored.items()}
    values = {key: value for _, own in stored.values() for key, value in own.items()}
    head = {"format": FORMAT, "lesson": master.name, "version": course.release()} | about
    # Learners leave check and given cells as they are.
    cells = {cell.id: cell.source if cell.role in ("check", "given") else None for cell in master.cells}
    parts = {name: _dumps(value) for name, value in head.items()}
    mappings = {"cells": cells, "exercises": entries, "values": dict(sorted(values.items()))}
    parts |= {name: _lines(mapping) for name, mapping in mappings.items()}
    checks = "{\n" + ",\n".join(f"{_dumps(name)}: {text}" for name, text in parts.items()) + "\n}\n"
    solutions = {
        exercise.id: {"code": exercise.solution, "explanation": exercise.explanation}
        | ({"rubric": exercise.rubric} if exercise.rubric else {})
        for exercise in master.exercises
    }
    solutions_text = _text_of({"format": FORMAT, "lesson": master.name, "solutions": solutions})
    paths = (f"{folder}/{master.name}.json" for folder in (CHECKS, SOLUTIONS))
    return dict(zip(paths, (checks, solutions_text), strict=True))


def _text_of(data):
    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _dumps(value):
    return json.dumps(value, separators=(",", ":"))


def _lines(mapping):
    """A mapping as JSON with one line for each of its entries, so that two versions can be compared."""
    return "{\n" + ",\n".join(f" {_dumps(key)}: {_dumps(mapping[key])}" for key in mapping) + "\n}"


def stored_exercise(exercise):
    """(The entry of an Exercise that has its results, {key: value} of the values in it), plain data."""
    values = {}
    names = [field.name for field in fields(Exercise) if field.name not in _LEFT_OUT]
    entry = {name: getattr(exercise, name) for name in names}
    for name in _FOR_SOME:
        if entry[name] == getattr(Exercise, name):
            del entry[name]
    for name in {"cases", "witnesses"} & entry.keys():
        entry[name] = list(map(_case_entry, entry[name]))
    if any("inputs" in case for case in entry["cases"]):
        entry["preparation"] = exercise.preparation
    entry["mistakes"] = [_mistake_entry(mistake, exercise.cases) for mistake in exercise.mistakes]

    def keep(value, _tolerance):
        key = hashlib.sha256(_dumps(value).encode()).hexdigest()[:16]
        values[key] = value
        return key

    return change_values(entry, keep), values


def _case_entry(case):
    entry = {name: getattr(case, name) for name in ("id", "title", "points", "hint", "tolerance")}
    entry |= {"hidden": True} if case.hidden else {}
    entry["expected"] = [call.result.value for call in case.calls]
    try:
        return entry | {"arguments": [list(map(encode, call.arguments)) for call in case.calls]}
    except TypeError:
        return entry | {"inputs": case.source}


def _mistake_entry(mistake, cases):
    results = {
        case.id: [
            _result_entry(result, call.result.value, case.tolerance)
            for result, call in zip(mistake.results[case.id], case.calls, strict=True)
        ]
        for case in cases
        if case.id in mistake.results
    }
    return {"name": mistake.name, "says": mistake.says, "results": results}


def _result_entry(result, expected, tolerance):
    names = ("error", "message", "timed_out", "changed")
    entry = {name: value for name in names if (value := getattr(result, name))}
    if result.value is None:
        return entry
    is_right = result.value == expected
    return entry | {"value": result.value if is_right or tolerance else _by_digest(result.value)}


def _by_digest(form):
    """A form whose larger arrays of integers are digests: nobody reads the values of a wrong answer."""
    if form["type"] == "ndarray":
        short = shorten_form(form, _SMALL_BYTES)
        return form if "float" in form["dtype"] or short == form else short | {"summary": {}}
    if form["type"] in ("tuple", "list") and "items" in form:
        return form | {"items": [_by_digest(item) for item in form["items"]]}
    if form["type"] == "dict" and "items" in form:
        return form | {"items": [[key, _by_digest(value)] for key, value in form["items"]]}
    return form


def lesson_file_differences(files, folder):
    """How a stored lesson's files differ from those that are built now, a text for each exercise.

    Numbers are compared as `check` compares them: another processor may round a float differently. Solutions
    that are not stored are not missed.
    """
    return [
        f"{name}: {problem}; run {course.command} build"
        for name, text in files.items()
        for problem in _file_problems(name, text, folder / name)
    ]


def _file_problems(name, built, stored_path):
    if not stored_path.is_file():
        return [] if name.startswith(SOLUTIONS) else ["not built yet"]
    if stored_path.read_text(encoding="utf-8", errors="replace") == built:
        return []
    if not name.startswith(CHECKS):
        return ["differs from the master"]
    try:
        with check_files.reading(stored_path):
            new, stored = json.loads(built), check_files.read_lesson_file(stored_path)
            parts = [part for part in ("lesson", "version", "cells") if new[part] != stored[part]]
            ids = sorted(new["exercises"].keys() | stored["exercises"].keys())
            parts += [id for id in ids if _entry_of(id, new) != _entry_of(id, stored)]
    except check_files.CheckFileError:
        return ["damaged"]
    return [f"{part} differs from the master" for part in parts]


def _entry_of(id, data):
    """An exercise of a checks file with a _Value for each of its values; None if it has none of that id."""
    entry = data["exercises"].get(id)
    return entry and change_values(entry, lambda key, tolerance: _Value(data["values"][key], tolerance))


@dataclass(eq=False)
class _Value:
    """A stored value, and the tolerance with which it equals another one; None for an argument."""

    form: object
    tolerance: float | None

    def __eq__(self, other):
        form, other_form = self.form, other.form
        if form == other_form:
            return True
        if self.tolerance is None:
            form, other_form = canonical(decode(form)), canonical(decode(other_form))
        return compare(form, other_form, self.tolerance or 0.0, exact_type=True) is None


def files_for_learners(source):
    """All files of a folder of lessons that belong to learners as they are: no masters, checks, solutions."""
    files = [path for path in sorted(source.rglob("*")) if path.is_file()]
    return [
        file for file in files if not any(map(_NOT_FOR_LEARNERS.fullmatch, file.relative_to(source).parts))
    ]


def without_outputs(data):
    """The bytes of a file as learners get it: of a notebook no counters, and only outputs tagged to stay."""
    with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
        notebook = json.loads(data)
        code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        cells = [cell for cell in code if KEEP_OUTPUT_TAG not in cell.get("metadata", {}).get("tags", ())]
        if any(cell["outputs"] or cell["execution_count"] is not None for cell in cells):
            for cell in cells:
                cell["outputs"], cell["execution_count"] = [], None
            return f"{json.dumps(notebook, ensure_ascii=False, indent=1, sort_keys=True)}\n".encode()
    return data


def zip_bytes(files):
    """The bytes of a zip with {name: bytes}; the same files give the same bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in sorted(files.items()):
            info = zipfile.ZipInfo(name)  # which has no date of today
            info.external_attr = 0o644 << 16  # without it, unzip makes files that nobody can read
            archive.writestr(info, data, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
