"""The tables of learners' wrong answers are well formed, and every answer in them is wrong.

The tables were written without the feedback code, so that they can measure the feedback; the fresh answers
also without the known mistakes and the hints of the exercises.
"""

import importlib.util
import re
from dataclasses import replace
from pathlib import Path

import pytest

from imgproc_course.classroom.authoring.masters import find_masters
from imgproc_course.classroom.exercises import MasterError, read_exercises
from imgproc_course.classroom.exercises.checking import run_cases
from imgproc_course.classroom.exercises.dependencies import find_refused

_spec = importlib.util.spec_from_file_location("wrong_answers", Path(__file__).with_name("wrong_answers.py"))
wrong_answers = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(wrong_answers)

MASTERS = Path(__file__).parents[3] / "notebooks" / "masters"
TABLES = {"table": wrong_answers.FOLDER, "fresh": wrong_answers.FRESH_FOLDER}
FILES = [path for folder in TABLES.values() for path in sorted(folder.glob("*.py"))]
EXERCISES = {declared.id: declared for path in find_masters(MASTERS) for declared in read_exercises(path)}
KINDS = {
    "value",
    "dtype",
    "shape",
    "type",
    "error",
    "syntax",
    "missing-import",
    "no-return",
    "input-changed",
    "not-attempted",
    "other-cell",
    "other-name",
    "refused",
    "too-slow",
}

each_file = pytest.mark.parametrize("path", FILES, ids=[f"{path.parent.name}/{path.stem}" for path in FILES])


def passes(declared, answer):
    """Whether an answer earns all points."""
    if answer.kind == "too-slow":  # an endless loop takes any time limit
        declared = replace(declared, time_limit=1.0)
    try:
        function = declared.function_of(answer.source, answer.name)
    except MasterError:  # the cell does not run
        return False
    given = set(declared.namespace())
    if find_refused(answer.source, declared.function, declared.allowed, given, function.__globals__):
        return False
    return all(run_cases(declared, function, cases=[case]).passed for case in declared.cases)


@pytest.mark.parametrize("name", TABLES)
def test_every_exercise_has_a_file(name):
    functions = {id for id, declared in EXERCISES.items() if declared.subject == "function"}
    assert {path.stem for path in TABLES[name].glob("*.py")} == functions


@each_file
def test_the_exercise_exists(path):
    assert path.stem in EXERCISES


@each_file
def test_the_fields_are_well_formed(path):
    answers = wrong_answers.read_wrong_answers(path)
    names = [answer.name for answer in answers]
    assert len(set(names)) == len(names)
    is_fresh = path.parent == wrong_answers.FRESH_FOLDER
    new_answers = sum(answer.origin == "new" for answer in answers)
    # An answer that a known mistake repeats stands there alone: `build` checks that it is recognized.
    assert is_fresh or new_answers + len(EXERCISES[path.stem].mistakes) >= 12
    for answer in answers:
        assert answer.origin in ({"fresh"} if is_fresh else {"walk", "new"}), answer.name
        assert answer.kind in KINDS, answer.name
        assert answer.passes in {True, False}, answer.name
        assert answer.sentence.endswith((".", "!")) and answer.source.strip(), answer.name
        assert answer.must_say, answer.name
        for pattern in [*answer.must_say, *answer.must_not_say]:
            assert isinstance(pattern, str) and re.compile(pattern), answer.name


@each_file
def test_every_sentence_names_its_own_mistake(path):
    answers = wrong_answers.read_wrong_answers(path)
    assert [answer.name for answer in answers if not answer.is_named_by(answer.sentence)] == []


@each_file
def test_only_a_cell_of_that_kind_does_not_parse(path):
    for answer in wrong_answers.read_wrong_answers(path):
        try:
            compile(answer.source, answer.name, "exec")
        except SyntaxError:
            assert answer.kind == "syntax", answer.name
        else:
            assert answer.kind != "syntax", answer.name


@each_file
def test_no_wrong_answer_earns_all_points(path):
    declared = EXERCISES[path.stem]
    answers = wrong_answers.read_wrong_answers(path)
    passing = {answer.name for answer in answers if passes(declared, answer)}
    known = {answer.name for answer in answers if answer.passes}
    assert passing - known == set(), "these answers are wrong and pass: add a case that catches them"
    assert known - passing == set(), (
        "the cases catch these answers now: take passes=true out of their headers"
    )
