"""Write the files that a lesson carries, and compare stored ones; `exercises.check_files` describes them."""

import hashlib
import json
from importlib.metadata import version

from imgproc_course.classroom.exercises.canonical import array_of, canonical
from imgproc_course.classroom.exercises.check_data import check_data_of
from imgproc_course.classroom.exercises.check_files import (
    CASE_FIELDS,
    CHECKS,
    DAMAGED,
    FORMAT,
    PLAIN_FIELDS,
    RESULT_FIELDS,
    SOLUTIONS,
    CheckFileError,
    read_lesson_file,
)
from imgproc_course.classroom.exercises.comparison import compare
from imgproc_course.classroom.exercises.input_encoding import decode, encode

_SMALL_BYTES = 96  # a larger wrong array is stored by its digest


def lesson_files(master):
    """{relative path: text} of what the lesson of a master carries; {} for a lesson without exercises."""
    if not master.exercises:
        return {}
    return {
        f"{CHECKS}/{master.name}.json": _check_file_text(master),
        f"{SOLUTIONS}/{master.name}.json": _solution_file_text(master),
    }


def _check_file_text(master):
    values = {}
    entries = {exercise.id: _exercise_entry(exercise, values) for exercise in master.exercises}
    head = {"format": FORMAT, "lesson": master.name, "version": version("imgproc-course")}
    parts = {name: _dumps(value) for name, value in head.items()}
    parts |= {
        "cells": _lines(master.handed_out),
        "exercises": _lines(entries),
        "values": _lines(dict(sorted(values.items()))),
    }
    return "{\n" + ",\n".join(f"{_dumps(name)}: {text}" for name, text in parts.items()) + "\n}\n"


def _solution_file_text(master):
    solutions = {
        exercise.id: {"code": exercise.solution, "explanation": exercise.explanation}
        for exercise in master.exercises
    }
    data = {"format": FORMAT, "lesson": master.name, "solutions": solutions}
    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _dumps(value):
    return json.dumps(value, separators=(",", ":"))


def _lines(mapping):
    """A mapping as JSON with one line for each of its entries, so that two versions can be compared."""
    return "{\n" + ",\n".join(f" {_dumps(key)}: {_dumps(mapping[key])}" for key in mapping) + "\n}"


def _exercise_entry(exercise, values):
    data = check_data_of(exercise)
    entry = {name: getattr(data, name) for name in PLAIN_FIELDS}
    sources = {case.id: case.source for case in exercise.public}
    entry["cases"] = [_case_entry(case, sources[case.id], values) for case in data.cases]
    if any("inputs" in case_entry for case_entry in entry["cases"]):
        entry["preparation"] = exercise.preparation
    entry["mistakes"] = [_mistake_entry(mistake, data.cases, values) for mistake in data.mistakes]
    return entry


def _case_entry(case, source, values):
    entry = {name: getattr(case, name) for name in CASE_FIELDS}
    entry["expected"] = [_keep(values, call.result.value) for call in case.calls]
    try:
        entry["arguments"] = [
            [_keep(values, encode(value)) for value in call.arguments] for call in case.calls
        ]
    except TypeError:
        entry["inputs"] = source
    return entry


def _mistake_entry(mistake, cases, values):
    results = {
        case.id: [_result_entry(*pair, case.tolerance, values) for pair in _pairs(mistake, case)]
        for case in cases
    }
    return {"name": mistake.name, "says": mistake.says, "results": results}


def _pairs(mistake, case):
    return zip(mistake.results[case.id], case.calls, strict=True)


def _result_entry(result, call, tolerance, values):
    entry = {name: value for name in RESULT_FIELDS if (value := getattr(result, name))}
    if result.value is not None:
        is_right = result.value == call.result.value
        form = result.value if is_right or tolerance else _by_digest(result.value)
        entry["value"] = _keep(values, form)
    return entry


def _keep(values, value):
    """Store a value once; returns its key."""
    key = hashlib.sha256(_dumps(value).encode()).hexdigest()[:16]
    values[key] = value
    return key


def _by_digest(form):
    """A form whose larger arrays of integers are digests: nobody reads the values of a wrong answer."""
    if form["type"] == "ndarray":
        values = array_of(form)
        if values is None or values.dtype.kind not in "biu" or values.nbytes <= _SMALL_BYTES:
            return form
        return canonical(values, limit=_SMALL_BYTES) | {"summary": {}}
    if form["type"] in ("tuple", "list") and "items" in form:
        return form | {"items": [_by_digest(item) for item in form["items"]]}
    if form["type"] == "dict" and "items" in form:
        return form | {"items": [[key, _by_digest(value)] for key, value in form["items"]]}
    return form


# ---------------------------------------------------------------- comparing


def lesson_file_differences(files, folder):
    """How a stored lesson's files differ from those that are built now, a text for each exercise.

    Numbers are compared as `check` compares them: another processor may round a float differently. Solutions
    that are not stored are not missed.
    """
    differences = []
    for name, text in files.items():
        path = folder / name
        if name.startswith(CHECKS):
            differences += _check_file_differences(text, path)
        elif path.is_file() and path.read_text(encoding="utf-8", errors="replace") != text:
            differences.append(f"{name}: differs from the master; run imgproc-course build")
    return differences


def _check_file_differences(built, stored_path):
    place = f"{stored_path.parent.name}/{stored_path.name}"
    if not stored_path.is_file():
        return [f"{place}: not built yet; run imgproc-course build"]
    if stored_path.read_text(encoding="utf-8", errors="replace") == built:
        return []
    try:
        new, stored = json.loads(built), read_lesson_file(stored_path)
        names = [name for name in ("lesson", "version", "cells") if new[name] != stored[name]]
        ids = sorted(new["exercises"].keys() | stored["exercises"].keys())
        names += [id for id in ids if not _is_same_exercise(id, new, stored)]
    except (CheckFileError, *DAMAGED):
        return [f"{place}: damaged; run imgproc-course build"]
    return [f"{place}: {name} differs from the master; run imgproc-course build" for name in names]


def _is_same_exercise(id, new, stored):
    entries = [data["exercises"].get(id) for data in (new, stored)]
    if None in entries:
        return False
    (skeleton, values), (stored_skeleton, stored_values) = (
        _split(entry, data["values"]) for entry, data in zip(entries, (new, stored), strict=True)
    )
    return skeleton == stored_skeleton and all(
        _is_same_value(*pair) for pair in zip(values, stored_values, strict=True)
    )


def _split(entry, values):
    """An exercise's entry without values, and [(value, whether it is an argument, tolerance)] in order."""
    entry, kept_values = json.loads(json.dumps(entry)), []
    tolerances = {case["id"]: case["tolerance"] for case in entry["cases"]}

    def take(key, tolerance=None):
        kept_values.append((values[key], tolerance))
        return None

    for case in entry["cases"]:
        case["expected"] = [take(key, case["tolerance"]) for key in case["expected"]]
        case["arguments"] = [[take(key) for key in keys] for keys in case.get("arguments", ())]
    for mistake in entry["mistakes"]:
        for case_id, results in mistake["results"].items():
            for result in results:
                if "value" in result:
                    result["value"] = take(result["value"], tolerances[case_id])
    return entry, kept_values


def _is_same_value(new, stored):
    (value, tolerance), (stored_value, _) = new, stored
    if value == stored_value:
        return True
    if tolerance is None:  # an argument
        value, stored_value = (canonical(decode(form), limit=None) for form in (value, stored_value))
    return compare(value, stored_value, tolerance or 0.0, exact_type=True) is None
