"""What is lifted out of a notebook, what is told of it, and that a broken one is a reason and no more."""

import json

import pytest
from form_attacks import MALFORMED
from submissions import answers_of, cell_of, notebook

from imgproc_course.gradebook.submission import NotebookReader, read_submission
from imgproc_course.gradebook.submission_reader import LONGEST, Unreadable, read_notebook

pytestmark = pytest.mark.sandbox  # the key is made in one


@pytest.fixture(scope="module")
def reader():
    with NotebookReader() as reader:
        yield reader


@pytest.fixture
def lifted(answer_keys, reader):
    def of(made):
        return read_submission(
            made if isinstance(made, bytes) else json.dumps(made).encode(), answer_keys, reader
        )

    return of


@pytest.fixture
def made(light):
    return notebook(light, answers_of(light, "right"))


def told(lifted, kind=None):
    return [each.text for each in lifted.findings if kind in (None, each.kind)]


def test_a_whole_lesson_gives_its_answers_and_nothing_to_tell(lifted, made, light):
    found = lifted(made)
    assert found.answers == answers_of(light, "right")
    assert (found.lesson, found.version, found.reason) == ("20_light", "0.1.0", "")
    assert found.findings == [] and found.claims == []


def test_a_source_in_lines_is_the_same_source(lifted, made, light):
    for cell in made["cells"]:
        cell["source"] = cell["source"].splitlines(keepends=True)
    assert lifted(made).answers == answers_of(light, "right")


def test_a_deleted_answer_cell(lifted, made):
    made["cells"].remove(cell_of(made, "answer-light-double"))
    found = lifted(made)
    assert list(found.answers) == ["light-halves"]
    assert told(found, "message") == ["its answer cell was deleted"]


def test_an_answer_in_another_cell(lifted, made):
    cell_of(made, "answer-light-double")["id"] = "mine"
    found = lifted(made)
    assert "light-double" not in found.answers
    assert "double() stands in another cell (mine), which is not graded" in told(found, "message")[0]


def test_a_duplicated_answer_cell(lifted, made):
    copy = dict(cell_of(made, "answer-light-double"), source="def double(p):\n    return p")
    made["cells"].append(copy)
    found = lifted(made)
    assert "astype" in found.answers["light-double"]
    assert told(found, "message") == [
        "its answer cell stands there 2 times; the first one with code is graded"
    ]


@pytest.mark.parametrize("kind", ["raw", "markdown"])
def test_a_retyped_answer_cell(lifted, made, kind):
    cell_of(made, "answer-light-double")["cell_type"] = kind
    found = lifted(made)
    assert list(found.answers) == ["light-halves"]
    assert told(found, "message") == [f"its answer cell was made a {kind} cell"]


def test_a_split_answer_cell(lifted, made):
    cell = cell_of(made, "answer-light-double")
    at = made["cells"].index(cell)
    made["cells"].insert(at + 1, dict(cell, id="new-half"))
    cell["source"] = "import numpy as np"
    assert "cell new-half does, which is not graded: was it split?" in told(lifted(made), "message")[0]


def test_a_helper_behind_the_answer(lifted, made):
    at = made["cells"].index(cell_of(made, "answer-light-double"))
    helper = {"id": "h", "cell_type": "code", "metadata": {}, "source": "def wide(p): ...", "outputs": []}
    made["cells"].insert(at + 1, helper)
    assert told(lifted(made)) == [
        "a cell behind its answer defines wide(); the answer's own cell alone is graded"
    ]


def test_changed_removed_and_retyped_check_cells(lifted, made):
    cell_of(made, "check-light-double-1")["source"] = "print('all 1 checks pass')"
    made["cells"].remove(cell_of(made, "check-light-halves-1"))
    cell_of(made, "given-light-double-1")["cell_type"] = "markdown"
    assert told(lifted(made)) == [
        "its check cell (check-light-double-1) was changed; grading uses its own",
        "its given cell (given-light-double-1) is no code any more; grading uses its own",
        "its check cell (check-light-halves-1) was removed; grading uses its own",
    ]


def test_orders_to_a_grader(lifted, made):
    cell = cell_of(made, "answer-light-double")
    cell["metadata"] = {
        "tags": ["nbval-skip", "raises-exception"],
        "nbgrader": {"points": 1000},
        "points": 99,
    }
    cell_of(made, "answer-light-halves")["source"] = "# NBVAL_SKIP\ndef halves(p): ..."
    assert [each.exercise for each in lifted(made).findings if each.kind == "odd"] == [
        "light-double",
        "light-halves",
    ]


def test_another_kernel(lifted, made):
    made["metadata"]["kernelspec"] = {"name": "evil\u202e"}
    assert told(lifted(made), "odd") == ["it asks for the kernel 'evil\\\\u202e'; grading uses its own"]


def test_claims_are_lifted(lifted, made):
    text = ["light-double: the check passes.\n", "✓ A picture\n"]
    cell_of(made, "check-light-double-1")["outputs"] = [
        {"output_type": "display_data", "data": {"text/plain": text}, "metadata": {}}
    ]
    assert lifted(made).claims == ["light-double"]
    text[0] = "light-double: 0 of 1 checks pass.\n"
    assert lifted(made).claims == []


def test_the_lesson_is_known_by_its_cells_where_the_metadata_are_lost(lifted, made):
    made["metadata"] = {}
    found = lifted(made)
    assert (found.lesson, found.version) == ("20_light", None)


def test_a_lesson_that_says_it_is_another_one(lifted, made):
    made["metadata"]["imgproc_course"]["lesson"] = "21_sound"
    found = lifted(made)
    assert found.lesson == "20_light"
    assert "it is graded as 20_light" in told(found, "message")[0]


def test_a_notebook_that_is_no_lesson(lifted):
    found = lifted({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": []})
    assert (
        found.lesson is None and found.reason == "it is no lesson of this key; the key has 20_light, 21_sound"
    )


@pytest.mark.parametrize("name", MALFORMED)
def test_a_malformed_notebook_is_a_reason(lifted, made, light, name):
    _, data, reason = MALFORMED[name]
    found = lifted(data)
    assert reason in found.reason
    assert found.answers == {} and found.lesson is None
    assert lifted(made).answers == answers_of(light, "right")  # the next one is read as if alone


@pytest.mark.parametrize("source", [7, None, True, {"a": 1}, [1, 2], [["x"]]])
def test_a_source_that_is_no_text(lifted, made, source):
    cell_of(made, "answer-light-double")["source"] = source
    found = lifted(made)
    assert list(found.answers) == ["light-halves"]
    assert "the source of its answer cell is no text" in told(found)


def test_cells_that_are_none(lifted, made, light):
    made["cells"] += [None, 7, "cell", [], {}, {"id": 3, "cell_type": []}]
    made["nbformat_minor"] = 99
    made["metadata"]["imgproc_course"]["version"] = ["0.1.0"]
    found = lifted(made)
    assert found.answers == answers_of(light, "right")
    assert "4 of its cells are none" in told(found, "odd")


def test_lone_surrogates_pass_through_as_data(lifted, made):
    cell_of(made, "answer-light-double")["source"] = "x = '\ud800\u202e'"
    made["cells"].append({"id": "\ud800", "cell_type": "code", "source": "def double(): ..."})
    found = lifted(made)
    assert found.answers["light-double"] == "x = '\ud800\u202e'"
    json.dumps([each.text for each in found.findings], ensure_ascii=False).encode("utf-8")


def test_a_huge_source_is_cut_and_judged_as_too_long(lifted, made):
    cell_of(made, "answer-light-double")["source"] = "#" * 3_000_000
    assert len(lifted(made).answers["light-double"]) == LONGEST


def test_a_byte_order_mark_is_no_mistake(lifted, made, light):
    assert lifted(b"\xef\xbb\xbf" + json.dumps(made).encode()).answers == answers_of(light, "right")


def test_a_notebook_that_eats_memory_costs_itself_only(answer_keys, made, light):
    with NotebookReader(memory=300 << 20) as reader:
        eats = b'{"nbformat": 4, "cells": [], "x": [' + b"[]," * 8_000_000 + b"[]]}"
        assert "memory" in read_submission(eats, answer_keys, reader).reason
        assert read_submission(json.dumps(made).encode(), answer_keys, reader).answers == answers_of(
            light, "right"
        )


def test_a_reader_that_hangs_is_ended(answer_keys, made, light):
    with NotebookReader(seconds=0.0) as reader:
        assert "time" in read_submission(json.dumps(made).encode(), answer_keys, reader).reason
    with NotebookReader() as reader:
        reader.read(b"{}")
        reader._process.kill()
        reader._process.wait()
        assert "time or memory" in read_submission(json.dumps(made).encode(), answer_keys, reader).reason
        assert read_submission(json.dumps(made).encode(), answer_keys, reader).answers == answers_of(
            light, "right"
        )


def test_reading_runs_and_imports_nothing_of_a_notebook(made):
    with pytest.raises(Unreadable):
        read_notebook(b"__import__('os')._exit(1)")
    assert read_notebook(json.dumps(made).encode())["lesson"] == "20_light"
