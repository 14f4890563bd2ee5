"""Which answers are read from a notebook, and what is reported about it."""

import json

import pytest
from nbclassroom.autograder.nbval_plugin import MAX_ANSWER
from nbclassroom.gradebook.submission import NOT_READ_IN_TIME, AnswerState, NotebookReader, read_submission
from nbclassroom.gradebook.submission_reader import (
    MOST_CHARACTERS,
    UnreadableError,
    read_notebook,
)
from submissions import answers_of, cell_of, notebook

pytestmark = pytest.mark.sandbox  # the key is made in one

DOUBLE = "answer-light-double"
ASKED = [["light-double", "double", ""]]


@pytest.fixture(scope="module")
def reader():
    with NotebookReader() as reader:
        yield reader


@pytest.fixture
def read(answer_keys, reader):
    """Reads a notebook, given as a dict or as bytes."""

    def read(made, name=""):
        data = made if isinstance(made, bytes) else json.dumps(made).encode()
        return read_submission(data, answer_keys.versions, reader, name)

    return read


@pytest.fixture
def made(light):
    return notebook(light, answers_of(light, "right"))


def texts(content, kind=None):
    return [finding.text for finding in content.findings if kind in (None, finding.kind)]


def test_a_complete_lesson_gives_its_answers_and_no_findings(read, made, light):
    content = read(made)
    assert content.answers == answers_of(light, "right")
    assert (content.lesson, content.version, content.reason) == ("light", "0.1.0", "")
    assert content.states == {"light-double": "answered", "light-halves": "answered"}
    assert content.findings == []


def test_what_runs_are_the_cells_above_the_check(read, made):
    """Given cells as handed out, what the learner wrote, and no check."""
    place = made["cells"].index(cell_of(made, DOUBLE))
    own = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    made["cells"].insert(place, own | {"id": "mine", "source": "%%writefile tool.py\nFACTOR = 2"})
    made["cells"].append(own | {"id": "out", "source": "%%writefile ../../x\nmine"})
    cell_of(made, "given-light-double-1")["source"] += "\nFACTOR = 3"
    content = read(made)
    assert texts(content, "hostile") == ["it tried to write files (../../x)"]
    page = content.page
    given, changed, _, tool, answer = page["cells"][:5]  # the third imports `check`
    assert (given["kind"], given["source"]) == ("given", "import numpy as np\n\nLIMIT = 255")
    assert (changed["kind"], changed["source"].splitlines()[-1]) == ("own", "FACTOR = 3")
    assert (tool["kind"], tool["file"], tool["source"]) == ("own", "tool.py", "FACTOR = 2")
    assert (answer["exercise"], answer["source"]) == ("light-double", page["answers"]["light-double"])
    assert page["checks"]["light-double"] == 5 and page["left_out"] == []


@pytest.mark.parametrize("kind", ["code", "markdown", "raw"])
def test_an_answer_in_another_cell(read, made, light, kind):
    cell_of(made, DOUBLE).update(id="mine", cell_type=kind)
    content = read(made)
    assert content.answers == answers_of(light, "right")
    assert texts(content, "message") == [
        f"graded from cell number 4, which defines double(): its answer cell ({DOUBLE}) is missing"
    ]


def test_text_about_a_function_is_no_answer(read, made):
    cell_of(made, DOUBLE).update(id="mine", cell_type="markdown", source="My function:\ndef double(p): ...")
    assert texts(read(made)) == [f"its answer cell ({DOUBLE}) is missing"]


def test_a_duplicated_answer_cell(read, made):
    cell_of(made, "answer-light-halves")["source"] += "\n\ndef double(pixels):\n    return pixels"
    assert texts(read(made), "message") == []
    copy = dict(cell_of(made, DOUBLE), source="def double(p):\n    return p")
    made["cells"].append(copy)
    made["cells"].insert(0, made["cells"].pop())
    content = read(made)
    assert "astype" in content.answers["light-double"]
    assert content.states["light-double"] is AnswerState.ANSWERED
    text = "2 cells define double(): cell number 5 is graded, and not cell number 1"  # they have one id
    assert texts(content, "message") == [text]


def test_a_markdown_cell_with_the_id_of_an_answer_before_it(read, made, light):
    made["cells"].insert(0, dict(cell_of(made, DOUBLE), cell_type="markdown", source="Notes"))
    content = read(made)
    assert content.answers == answers_of(light, "right")
    assert content.states["light-double"] is AnswerState.ANSWERED
    assert texts(content, "message") == []


@pytest.mark.parametrize("kind", ["raw", "markdown"])
def test_a_retyped_answer_cell(read, made, light, kind):
    cell_of(made, DOUBLE)["cell_type"] = kind
    content = read(made)
    assert content.answers == answers_of(light, "right")
    assert texts(content, "message") == [
        f"its answer cell is a {kind} cell; its text is graded (key Y makes it code again)"
    ]
    cell_of(made, DOUBLE)["source"] = "I could not do it."
    content = read(made)
    assert list(content.answers) == ["light-halves"]
    assert content.states["light-double"] is AnswerState.BROKEN
    assert texts(content, "message") == [f"its answer cell is a {kind} cell; make it a code cell (key Y)"]


@pytest.mark.parametrize(
    ("source", "state", "text"),
    [
        ("", "broken", "its answer cell is empty"),
        ("# later\n", "broken", "its answer cell is empty"),
        ("def double(p)\n    I do", "broken", "line 1 of its answer cell is not Python: def double(p) "),
        (
            "def doubles(p)\n    return p",
            "broken",
            "line 1 of its answer cell is not Python: def doubles(p) ",
        ),
        (
            "I don\u2019t know",
            "broken",
            "line 1 of its answer cell is not Python: I don\u2019t know (invalid char",
        ),
        (
            "from numpy import *\ndef double(p):\n    retrun p",
            "broken",
            "line 3 of its answer cell is not Python: retrun p (invalid syntax). Look at this line",
        ),
        (
            "def double(p):\r    return p\u00d72",  # line ends that only Python counts
            "broken",
            "line 2 of its answer cell is not Python: return p\u00d72 (invalid character '\u00d7'"
            " (U+00D7)). \u00d7 is no character of Python: chats, word processors and web pages write it in"
            " the place of *. Type * there",
        ),
        ("double_it = 3", "broken", "its answer cell does not define double()"),
        ('def double(pixels):\n    # hm\n    raise NotImplementedError("your turn")', "not attempted", ""),
        ("double = lambda p: p", "answered", ""),
        ("from numpy import abs as double", "answered", ""),
        ("from numpy import *", "broken", "its answer cell does not define double()"),
        ("if True:\n    def double(p): return p", "answered", ""),
        ("double = " + "-" * 90_000 + "1", "broken", "line 1 of its answer cell is not Python:  ("),
    ],
)
def test_the_state_of_an_answer(read, made, source, state, text):
    cell_of(made, DOUBLE)["source"] = source
    content = read(made)
    assert content.states["light-double"] == state
    assert len(content.answers["light-double"]) == min(len(source), MOST_CHARACTERS + 1)
    (finding,) = [*texts(content, "answer"), *([] if text else [""])]
    assert finding.startswith(text) and texts(content, "message") == []


@pytest.mark.parametrize(
    ("source", "state", "text"),
    [
        ("#" * 200_100, "broken", "its answer is longer than 200000 characters, the most that are graded"),
        (
            "LIMIT = 3\ndef Double(p):\n    return p",
            "broken",
            "its answer cell does not define double(), but Double(); the name must be the one of the task",
        ),
        (
            "def double(p):\n    raise NotImplementedError('your turn')\n    return p * 2",
            "not attempted",
            "double(): The line with raise NotImplementedError is still there, and ends the function: delete"
            " it.",
        ),
    ],
)
def test_a_slip_that_costs_a_right_answer_is_told_to_the_learner(read, made, source, state, text):
    cell_of(made, DOUBLE)["source"] = source
    content = read(made)
    assert content.states["light-double"] == state
    assert texts(content, "message") == [text] and texts(content, "answer") == []


@pytest.mark.parametrize(("version", "is_named"), [("3.99.1", True), ("3.11.0", False), (7, False)])
def test_syntax_of_a_newer_python_is_named(read, made, version, is_named):
    made["metadata"]["language_info"] = {"version": version}
    assert texts(read(made)) == []
    cell_of(made, DOUBLE)["source"] = "def double(pixels):\n    return pixels ?? 3"
    findings = texts(read(made))
    assert any(text.startswith("it was run with Python 3.99, and Python 3.") for text in findings) == is_named


def test_a_pasted_program_is_named(read, made):
    cell_of(made, DOUBLE)["source"] = (
        "def double(p):\n    return p\n\nwhile rclpy.ok():\n    spin(3)\ninput()"
    )
    content = read(made)
    loop, _, person = texts(content, "message")
    assert loop.startswith("line 4, rclpy.ok(), belongs to a program that runs by itself")
    assert person.startswith("line 6, input(), belongs to a program")


def test_a_hostile_mass_of_definitions_costs_only_itself(read, made, light):
    names = [f"name_{number}" for number in range(3_000)]
    cell_of(made, DOUBLE)["source"] = f"def double(p):\n    return sum([{', '.join(names)}])"
    for start in range(0, 3_000, 10):
        source = "\n".join(f"{name} = {name}_2 = 3" for name in names[start : start + 10])
        made["cells"].append({"id": f"h{start}", "cell_type": "code", "metadata": {}, "source": source})
    content = read(made)
    assert sum(cell["source"].count(" = 3") for cell in content.page["cells"]) == 3_000
    assert content.answers["light-halves"] == answers_of(light, "right")["light-halves"]


def test_changed_removed_and_retyped_check_cells(read, made):
    cell_of(made, "check-light-double-1")["source"] = "print('all 1 checks pass')"
    made["cells"].remove(cell_of(made, "check-light-halves-1"))
    cell_of(made, "given-light-double-1")["cell_type"] = "markdown"
    content = read(made)
    assert texts(content) == [
        "its check cell (check-light-double-1) was changed; grading uses its own",
        "its given cell (given-light-double-1) is not a code cell any more; grading uses its own",
        "its check cell (check-light-halves-1) is missing; grading uses its own",
    ]
    assert set(content.states.values()) == {"answered"}


# ---------------------------------------------------------------- which lesson it is


def test_without_metadata_the_answer_cells_name_the_lesson(read, made):
    made["metadata"] = {}
    content = read(made, "21_sound.ipynb")
    assert (content.lesson, content.version) == ("light", None)
    assert texts(content) == [
        "it was recognized as light by its answer cells, and not as sound",
        "it was made from an unknown version of the lesson, not from version 0.1.0",
    ]


def test_without_any_mark_the_name_decides_and_then_the_functions(read, made):
    made["metadata"] = {}
    for number, cell in enumerate(made["cells"]):
        cell["id"] = str(number)
    assert texts(read(made, "20_light.ipynb"))[0].startswith("it was made from an unknown version")
    assert texts(read(made, "final.ipynb"))[0] == "it was recognized as light by its functions"
    assert read(made, "21_sound.ipynb").lesson == "sound"


def test_without_metadata_and_answer_cells_the_file_name_names_the_lesson(read, made):
    made["metadata"], made["cells"] = {}, made["cells"][:1]
    content = read(made, "ada/20_light-1.ipynb")
    assert (content.lesson, content.answers) == ("light", {})
    assert set(content.states.values()) == {AnswerState.MISSING}
    assert read(made, "20_light/21_sound.ipynb").lesson is None


def test_the_name_decides_and_never_the_number(read, made):
    made["metadata"]["imgproc_course"]["lesson"] = "21_light"  # from a course in which it was number 21
    assert read(made, "21_light.ipynb").lesson == "light"
    made["cells"] = made["cells"][:1]
    assert read(made, "ada.ipynb").lesson == "light"
    made["metadata"] = {}
    assert read(made, "21_light.ipynb").lesson == read(made, "light (1).ipynb").lesson == "light"
    for name in ("20.ipynb", "21.ipynb", "ada/20_.ipynb", "21_sounds.ipynb"):
        assert read(made, name).lesson is None


def test_a_lesson_without_a_key_is_not_graded_as_another_one(read, made):
    made["cells"] = made["cells"][:1]
    made["metadata"]["imgproc_course"]["lesson"] = "light_node"
    content = read(made, "20_light_node.ipynb")
    assert (content.lesson, content.states) == (None, {})
    assert content.reason == "its lesson, 'light_node', is not, or no longer, one of light, sound"


def test_a_lesson_with_the_answer_cells_of_another_one(read, made):
    made["metadata"]["imgproc_course"]["lesson"] = "21_sound"
    content = read(made)
    assert content.lesson == "light"
    assert texts(content, "message")[0] == "it was recognized as light by its answer cells, and not as sound"


def test_a_notebook_that_is_no_lesson(read):
    content = read({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": []})
    assert (content.lesson, content.reason) == (None, "it is not, or no longer, one of light, sound")


# ---------------------------------------------------------------- damaged notebooks


DEEP = 100_000
MALFORMED = {  # name: (the file's bytes, the reason)
    "blank": (b" \n", "the file is empty"),
    "cut off": (b'{"nbformat": 4, "cells": [', "its JSON is broken (line 1)"),
    "null bytes": (b"\x00" * 100, "its JSON is broken"),
    "UTF-16": ('{"nbformat": 4}'.encode("utf-16"), "no list of cells"),
    "UTF-16 cut off": ('{"nbformat": 4}'.encode("utf-16")[:-1], "it is not UTF-16"),
    "latin-1": ('{"nbformat": 4, "ä": 1}'.encode("latin-1"), "it is not UTF-8"),
    "a list": (b"[]", "its JSON holds something else"),
    "format true": (b'{"nbformat": true, "cells": []}', "which notebook format"),
    "format 2": (b'{"nbformat": 2, "worksheets": []}', "notebook format 2"),
    "format huge": (b'{"nbformat": 1' + b"0" * 400 + b', "cells": []}', "notebook format 1000"),
    "cells a dict": (b'{"nbformat": 4, "cells": {}}', "no list of cells"),
    "deep metadata": (b'{"nbformat": 4, "metadata": ' + b"[" * DEEP, "nested too deep"),
    "deep dicts": (b'{"a":' * DEEP + b"1" + b"}" * DEEP, "nested too deep"),
    "a long number": (b'{"nbformat": 4, "cells": ' + b"9" * 10_000 + b"}", "its JSON is broken"),
    "too many cells": (b'{"nbformat": 4, "cells": [' + b"1," * 6_000 + b"1]}", "6001 cells"),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_a_malformed_notebook_is_a_reason(read, made, light, name):
    data, reason = MALFORMED[name]
    content = read(data)
    assert reason in content.reason
    assert content.answers == {} and content.lesson is None
    assert read(made).answers == answers_of(light, "right")  # the next one is read as if alone


@pytest.mark.parametrize("source", [7, None, True, {"a": 1}, [1, 2], [["x"]]])
def test_a_source_that_is_not_text(read, made, source):
    cell_of(made, DOUBLE)["source"] = source
    content = read(made)
    assert list(content.answers) == ["light-halves"]
    assert "the source of its answer cell is not text" in texts(content)


def test_entries_that_are_not_cells(read, made, light):
    made["cells"] += [None, 7, "cell", [], {}, {"id": 3, "cell_type": []}]
    made["nbformat_minor"] = 99
    made["metadata"]["imgproc_course"]["version"] = ["0.1.0"]
    content = read(made)
    assert content.answers == answers_of(light, "right")


def test_lone_surrogates_pass_through_as_data(read, made):
    cell_of(made, DOUBLE)["source"] = "x = '\ud800\u202e'"
    made["cells"].append({"id": "\ud800", "cell_type": "code", "source": "def double(): ..."})
    content = read(made)
    assert content.answers["light-double"] == "x = '\ud800\u202e'"
    json.dumps(texts(content), ensure_ascii=False).encode("utf-8")


def test_a_huge_source_is_cut_and_still_too_long_for_grading(read, made):
    cell_of(made, DOUBLE)["source"] = "#" * 3_000_000
    assert len(read(made).answers["light-double"]) == MOST_CHARACTERS + 1 == MAX_ANSWER + 1


def test_a_notebook_that_uses_too_much_memory_harms_only_itself(answer_keys, made, light):
    with NotebookReader(memory=300 << 20) as reader:
        huge = b'{"nbformat": 4, "cells": [], "x": [' + b"[]," * 8_000_000 + b"[]]}"
        assert "memory" in read_submission(huge, answer_keys.versions, reader).reason
        content = read_submission(json.dumps(made).encode(), answer_keys.versions, reader)
        assert content.answers == answers_of(light, "right")


def test_notebooks_that_fill_the_readers_memory_cost_the_next_one_nothing():
    """Cells are remembered, because most are in every notebook; these are in one each."""
    answer = {"answer-light-double": "def double(p):\n    return twice(p)", "mine": "def twice(p): return p"}
    with NotebookReader(memory=110 << 20) as reader:
        cells = {f"own-{k}": f"twice = 1{k}\n" + "a;" * 2_400 for k in range(40)}
        reader.read(cells_as_notebook(answer | cells))
        reader.page({}, ASKED)
        assert reader.read(cells_as_notebook(answer, output="x" * 10_000_000))[1] == ""
        page, places, _ = reader.page({}, ASKED)
    assert [cell["source"] for cell in page["cells"]] == [*answer.values()]
    assert places == {"light-double": [0]}


def cells_as_notebook(sources, output=""):
    cells = [{"id": id, "cell_type": "code", "metadata": {}, "source": text} for id, text in sources.items()]
    cells[-1]["outputs"] = [{"output_type": "stream", "name": "stdout", "text": output}]
    return json.dumps({"nbformat": 4, "metadata": {}, "cells": cells}).encode()


def test_a_reader_that_hangs_is_ended_and_one_that_was_killed_costs_nothing(answer_keys, made, light):
    data = json.dumps(made).encode()
    with NotebookReader(seconds=0.1) as reader:
        slow = {f"answer-{number}": "x = 1\n" * 30_000 for number in range(6)}
        assert reader.read(cells_as_notebook(slow)) == (None, NOT_READ_IN_TIME)
        assert read_submission(data, answer_keys.versions, reader).reason == ""
        reader.page = lambda *_: (None, None, None)  # as if this took too long
        assert read_submission(data, answer_keys.versions, reader).answers == {}
    with NotebookReader() as reader:
        reader.read(b"{}")
        reader._process.kill()
        reader._process.wait()
        assert read_submission(data, answer_keys.versions, reader).answers == answers_of(light, "right")
        reader._process.kill()
        page, *_ = reader.page({}, ASKED)
        assert page["answers"] == {"light-double": answers_of(light, "right")["light-double"]}


def test_reading_runs_and_imports_nothing_of_a_notebook(made):
    with pytest.raises(UnreadableError):
        read_notebook(b"__import__('os')._exit(1)")
    assert read_notebook(json.dumps(made).encode())["lesson"] == "light"
