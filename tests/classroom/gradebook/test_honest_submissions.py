"""The table of honest submissions: what tools and learners do to a lesson must not cost its points.

Each case is one submission of the lesson `light` with the points that a fair person gives, or of the lesson
`sound`, whose answer is a number. `grade` and `check --run` must agree on all of them.
"""

import codecs
import copy
import json

import jupytext
import nbformat
import pytest
from jupyterlab_cells import change_type, copy_and_paste, insert, merge, new_cell, position_of, split
from nbclassroom.authoring.build import lesson_notebook
from nbclassroom.gradebook.check import check_lesson, run_answers
from nbclassroom.gradebook.grade import grade_submissions

pytestmark = [pytest.mark.sandbox, pytest.mark.usefixtures("one_fork_server")]  # the key is made in a sandbox

DOUBLE, HALVES, MEAN = "answer-light-double", "answer-light-halves", "answer-sound-mean"
RIGHT = {
    DOUBLE: "def double(pixels):\n"
    "    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)",
    HALVES: "def halves(pixels):\n    return pixels[:2].copy(), pixels[2:].copy()",
    MEAN: "def mean(values):\n    return sum(values) / len(values)",
}
STUB = 'def double(pixels):\n    raise NotImplementedError("your turn")'
WIDE = "def wide(pixels):\n    return pixels.astype(np.uint16)"
USES_WIDE = "def double(pixels):\n    return np.minimum(wide(pixels) * 2, LIMIT).astype(np.uint8)"
USES_EVERYTHING = "def double(pixels):\n    return minimum(pixels.astype(uint16) * 2, LIMIT).astype(uint8)"
BODY = "    return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)"
COUNTING = f"def double(pixels):\n    global calls\n    calls += 1\n{BODY}"
TYPED = f"def double(pixels: NoSuchType) -> NoSuchType:\n{BODY}"
SQUARE = "def square(value):\n    return value * 2"
FROM_TABLE = (
    "def double(pixels):\n    assert rows[3] == 6 and len(rows) == 256\n"
    "    doubled = [[table[v] for v in row] for row in pixels.tolist()]\n"
    "    return np.minimum(doubled, LIMIT).astype(np.uint8)"
)
CASES = []


def case(points=6, finding="", name="20_light.ipynb", **sources):
    """Add a case: a function that changes a notebook in which every answer is right.

    What it returns, if it is not None, are the bytes of the file.

    Parameters
    ----------
    points : int, what a fair person gives, of 6; of 4 in the lesson `sound`
    finding : str, a part of a finding, "" if nothing must be reported
    name : str, of the file
    sources : double, halves: other sources of the answers; mean: of the lesson `sound`
    """

    def add(change):
        CASES.append(pytest.param(change, points, finding, name, sources, id=change.__name__))
        return change

    return add


def named(name, change=lambda made: None):
    """A function of a case with this name, which is the name of the submission."""

    def of_this_name(made):
        return change(made)

    of_this_name.__name__ = name
    return of_this_name


@case()
def merged_with_the_cell_below(made):
    place = position_of(made, DOUBLE)
    insert(made, place + 1, new_cell("double(np.uint8([[200]]))"))
    merge(made, place, place + 1, active=place)


@case()
def merged_with_the_cell_above(made):
    place = position_of(made, DOUBLE)
    insert(made, place, new_cell("import math"))
    merge(made, place, place + 1, active=place + 1)


@case()
def merged_with_its_check(made):
    place = position_of(made, DOUBLE)
    merge(made, place, place + 1, active=place)


@case()
def tried_otherwise_below_the_check_in_its_cell(made):
    place = position_of(made, DOUBLE)
    merge(made, place, place + 1, active=place)
    made["cells"][place]["source"] += "\nLIMIT = 3\ndef double(pixels):\n    return pixels"


@case(finding="graded from cell number")
def merged_into_a_cell_of_the_learner(made):
    place = position_of(made, DOUBLE)
    insert(made, place, new_cell("first_try = 3"))
    merge(made, place, place + 1, active=place)


@case(finding="graded from cell number")
def both_answers_merged(made):
    first, second = position_of(made, DOUBLE), position_of(made, HALVES)
    merge(made, first, second, active=first)


@case()
def split_between_a_helper_and_the_function(made):
    place = position_of(made, DOUBLE)
    made["cells"][place]["source"] = f"{WIDE}\n\n{USES_WIDE}"
    split(made, place, len(WIDE) + 1)


@case(finding="its text is graded")
def made_markdown(made):
    change_type(made, position_of(made, DOUBLE), "markdown")


@case(finding="its text is graded")
def made_raw(made):
    change_type(made, position_of(made, DOUBLE), "raw")


@case(finding="2 cells define double()")
def copied_and_the_copy_kept(made):
    copy_and_paste(made, position_of(made, DOUBLE))


@case(finding="graded from cell number", double=STUB)
def written_at_the_end_of_the_notebook(made):
    insert(made, len(made["cells"]), new_cell(RIGHT[DOUBLE]))


@case(double=STUB)
def written_into_a_copy_of_the_answer_cell(made):
    place = position_of(made, DOUBLE)
    copy_and_paste(made, place)
    made["cells"][place + 1]["source"] = RIGHT[DOUBLE]


@case()
def written_above_the_stub_and_merged(made):
    place = position_of(made, DOUBLE)
    made["cells"][place]["source"] = f"{RIGHT[DOUBLE]}\n\n{STUB}"


@case(finding="graded from cell number")
def deleted_and_written_into_a_new_cell(made):
    made["cells"][position_of(made, DOUBLE)] = new_cell(RIGHT[DOUBLE])


@case(3, finding="2 cells define double()")
def an_older_wrong_try_is_kept_below(made):
    insert(made, position_of(made, DOUBLE) + 1, new_cell("def double(pixels):\n    return pixels"))


@case(finding="graded from cell number", double="def double(pixels)\n    return pixels")
def a_broken_try_stays_in_the_answer_cell(made):
    insert(made, position_of(made, DOUBLE) + 1, new_cell(RIGHT[DOUBLE]))


@case(finding="graded from cell number", double="")
def a_lambda_in_another_cell(made):
    source = "double = lambda p: np.minimum(p.astype(int) * 2, LIMIT).astype(np.uint8)"
    insert(made, position_of(made, DOUBLE) + 1, new_cell(source))


@case()
def nbstripout_with_its_defaults(made):
    for number, cell in enumerate(made["cells"]):
        cell["id"] = str(number)
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None


@case(finding="graded from cell number")
def without_ids_and_metadata(made):
    made["nbformat_minor"] = 4
    for cell in made["cells"]:
        del cell["id"]
        cell["metadata"] = {}


@case()
def through_jupytext_and_back(made):
    text = jupytext.writes(nbformat.from_dict(copy.deepcopy(made)), "py:percent")
    made.update(json.loads(nbformat.writes(jupytext.reads(text, "py:percent"))))


@case()
def as_google_colab_saves_it(made):
    made["nbformat_minor"] = 0
    made["metadata"]["colab"] = {"provenance": []}
    for number, cell in enumerate(made["cells"]):
        del cell["id"]
        cell["metadata"]["id"] = f"aB3{number}"
        cell["source"] = cell["source"].splitlines(keepends=True)


@case()
def as_visual_studio_code_saves_it(made):
    made["metadata"]["language_info"] = {"name": "python"}
    for cell in made["cells"]:
        cell["metadata"]["vscode"] = {"languageId": "python"}
        cell["source"] = cell["source"].splitlines(keepends=True)


def with_a_word_in_another_script(made):
    """The notebook as text, not in ASCII alone."""
    made["cells"][position_of(made, DOUBLE)]["source"] += "  # größer, 明るい"
    return json.dumps(made, ensure_ascii=False, indent=1)


@case()
def saved_with_a_byte_order_mark(made):
    return with_a_word_in_another_script(made).encode("utf-8-sig")


@case()
def saved_as_utf_16(made):
    return codecs.BOM_UTF16_LE + with_a_word_in_another_script(made).encode("utf-16-le")


@case()
def saved_as_utf_16_big_endian(made):
    return codecs.BOM_UTF16_BE + with_a_word_in_another_script(made).encode("utf-16-be")


# ---------------------------------------------------------------- definitions in other cells


@case(double=f"import tools\n{USES_WIDE.replace('wide', 'tools.wide')}")
def a_helper_in_a_file_that_a_cell_writes(made):
    cell = new_cell(f"%%writefile tools.py\nimport numpy as np\n{WIDE}")
    insert(made, position_of(made, DOUBLE), cell)


@case(double=f"import importlib\nimport own.wider\nwide = importlib.reload(own.wider).wide\n{USES_WIDE}")
def a_helper_in_a_package_that_cells_write(made):
    files = {"own/__init__.py": "", "own/__main__.py": "", "own/wider.py": f"import numpy as np\n{WIDE}"}
    cells = [new_cell(f"%%writefile {file}\n{source}") for file, source in files.items()]
    insert(made, position_of(made, DOUBLE), *cells)


@case(double=f"%run -i tools.py\n{USES_WIDE.replace('np', 'numpy')}")
def a_script_that_a_cell_writes(made):
    cells = new_cell("%%writefile tools.py\nimport numpy"), new_cell(f"%%writefile -a tools.py\n{WIDE}")
    insert(made, position_of(made, DOUBLE), *cells)


@case(double=USES_WIDE)
def a_helper_below(made):
    insert(made, position_of(made, DOUBLE) + 1, new_cell(WIDE))


@case(points=6)
def a_given_name_bound_in_another_cell(made):
    insert(made, 1, new_cell("LIMIT = 3"))


@case(3, double=USES_EVERYTHING)
def everything_of_a_module_imported_below(made):
    insert(made, position_of(made, DOUBLE) + 1, new_cell("from numpy import *"))


def with_own_cells(cells):
    def change(made):
        insert(made, position_of(made, DOUBLE), *map(new_cell, cells))

    return change


FILLS = "for value in range(256):\n    table[value] = square(value)\n    rows.append(table[value])"
OWN_CELLS = {  # {name: (cells above the answer, the answer)}; more are the FORMS of own_cells.py
    "a_helper_an_import_and_constants_transitively": (
        [
            "import numpy\nfrom numpy import uint8 as narrow",
            "FACTOR = 2\nWIDE_TYPE: type = numpy.uint16",
            "class Widener:\n    def __call__(self, p):\n        return p.astype(WIDE_TYPE)",
            "def wide(pixels):\n    return Widener()(pixels)",
        ],
        "def double(pixels):\n    return numpy.minimum(wide(pixels) * FACTOR, LIMIT).astype(narrow)",
    ),
    "a_helper_whose_cell_also_fails": ([f"camera = open_camera()\n{WIDE}\nshow(camera)"], USES_WIDE),
    "a_counter_in_another_cell": (["calls = 0"], COUNTING),
    "a_table_that_its_cell_fills": (
        [f"rows = []\ntable = {{}}\n{SQUARE}\n{FILLS}\nshow(table)\nno_such.append(3)"],
        FROM_TABLE,
    ),
}
for name, (cells, answer) in OWN_CELLS.items():
    case(double=answer)(named(name, with_own_cells(cells)))


# ---------------------------------------------------------------- pasted text


@case(
    double=f"```python\n{RIGHT[DOUBLE]}\n```",
    finding="its answer cell is a markdown cell; its text is graded",
)
def made_markdown_in_a_fence(made):
    change_type(made, position_of(made, DOUBLE), "markdown")


@case(points=3, double=STUB, finding="), which does not run; make it a code cell (key Y)")
def written_in_a_text_with_words_around_it(made):
    text = new_cell(f"My answer:\n\n```python\n{RIGHT[DOUBLE]}\n```\nIt takes the smaller one.")
    insert(made, 0, text)
    change_type(made, 0, "markdown")


# ---------------------------------------------------------------- libraries that only show or annotate


TYPES = ("from typing_extensions import TypeAlias as A", "from cv2.typing import MatLike as A")
TYPES += ("from PIL import Image\nA = Image.Image", "import torch\nA = torch.Tensor[int]")
for number, line in enumerate(TYPES):
    change = named(f"annotations_of_other_libraries_{number}")
    case(double=f"{line}\ndef double(pixels: A) -> A:\n{BODY}")(change)


# ---------------------------------------------------------------- definitions of other forms


def without_marks(made):
    without_ids_and_metadata(made)
    made["metadata"].pop("imgproc_course")


FORMS = (
    f"from typing import Callable\ndef twice(pixels):\n{BODY}\ndouble: Callable = twice",
    f"def twice(pixels):\n{BODY}\nMETHODS = {{'twice': twice}}\ndouble = METHODS['twice']",
    f"if True:\n    def double(pixels):\n    {BODY}",
)
for number, source in enumerate(FORMS):
    change = named(f"a_definition_of_another_form_{number}", without_marks)
    case(double=source, finding="graded from cell number")(change)


# ---------------------------------------------------------------- right values in another type


NUMBERS = ("np.longdouble", "__import__('decimal').Decimal", "__import__('fractions').Fraction")
for number, kind in enumerate(NUMBERS):
    change = named(f"a_number_of_another_type_{number}")
    case(points=4, mean=f"def mean(values):\n    return {kind}(float(np.mean(values)))")(change)


# ---------------------------------------------------------------- other sources alone


SOURCES = {  # {name of a submission: what `case` takes}, if nothing else was done to the lesson
    "as_it_was_handed_out_and_solved": {},
    "another_answer": {"halves": "def halves(p):\n    p = double(p) * 0 + p\n    return p[:2], p[2:]"},
    "a_line_above_the_function_that_fails": {
        "double": f"frame = camera.latest()\nshow(frame)\n{RIGHT[DOUBLE]}\nshow(double(frame))"
    },
    "an_import_above_the_function_that_fails": {
        "double": f"import a_module_that_is_not_there\n\n{RIGHT[DOUBLE]}"
    },
    "an_event_loop_inside_that_of_jupyter": {
        "points": 3,
        "double": f"import asyncio\nasync def work(pixels):\n{BODY}\ndouble = lambda p: asyncio.run(work(p))",
    },
    "lines_that_fail_after_an_import_from_the_future": {
        "double": f"from __future__ import annotations\nframe = camera.latest()\n\n{TYPED}\n\nprint(frame)"
    },
    "a_name_that_no_cell_defines": {
        "points": 3,
        "double": "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2, LIMIT + shift)",
    },
    "with_the_prompts_of_python": {"double": ">>> " + RIGHT[DOUBLE].replace("\n", "\n... ")},
    "with_the_prompts_of_ipython": {"double": "In [12]: " + RIGHT[DOUBLE].replace("\n", "\n    ...: ")},
    "with_an_indent_before_the_whole_cell": {"double": "    " + RIGHT[DOUBLE].replace("\n", "\n    ")},
    "with_the_quotation_marks_of_a_word_processor": {
        "points": 3,
        "double": 'def double(pixels):\n    """Twice."""\n    print(\u201cDouble\u201d)\n    return pixels',
        "finding": "(U+201C)). \u201c is no character of Python",
    },
    "with_such_quotation_marks_in_a_text": {
        "double": RIGHT[DOUBLE].replace("return", 'print("\u201cDouble\u201d")\n    return')
    },
    "with_a_misspelled_keyword": {
        "points": 3,
        "double": RIGHT[DOUBLE].replace("return", "retrun"),
        "finding": "is a word misspelled (return, def, else)",
    },
    "an_annotation_that_cannot_be_read": {
        "double": f"from PIL import Image\ndef double(pixels: Image.Image) -> Image.Image:\n{BODY}"
    },
    "a_bar_that_counts": {
        "double": "from tqdm.contrib import tenumerate\ndef double(pixels):\n    out = pixels.astype(int)\n"
        "    for k, row in tenumerate(out):\n        out[k] = np.minimum(row * 2, LIMIT)\n    return out"
    },
    "a_cell_that_ends_python": {"double": f"{RIGHT[DOUBLE]}\nname = input()\nexit()"},
    "magics_around_the_function": {
        "double": f"%matplotlib inline\nfiles = !ls\n{RIGHT[DOUBLE]}\n%timeit double(3)\ndouble?"
    },
    "a_cell_magic": {"double": f"%%time\n{RIGHT[DOUBLE]}"},
    "nine_megabytes_printed_in_the_cell": {"double": f"print('x' * 9_000_000)\n{RIGHT[DOUBLE]}"},
    "nine_megabytes_printed_in_the_function": {
        "double": RIGHT[DOUBLE].replace("return", "print('x' * 9_000_000)\n    return")
    },
    "a_list_of_lists_for_an_array": {
        "double": "def double(p):\n    return np.minimum(p.astype(int) * 2, 255).tolist()"
    },
    "a_masked_array_of_long_numbers": {
        "double": "def double(p):\n    return np.ma.masked_array(np.minimum(p * np.longdouble(2), 255))"
    },
}
for name, about in SOURCES.items():
    case(**about)(named(name))


# ---------------------------------------------------------------- the two roads


@pytest.fixture(scope="module")
def files(masters, tmp_path_factory):
    """{name of the case: the submitted file}."""
    folder = tmp_path_factory.mktemp("honest")
    paths = {}
    for parameters in CASES:
        change, _, _, name, sources = parameters.values
        lesson = "sound" if "mean" in sources else "light"
        made = json.loads(json.dumps(lesson_notebook(masters[lesson])))
        for id, source in RIGHT.items():
            if not id.startswith(f"answer-{lesson}-"):
                continue
            made["cells"][position_of(made, id)]["source"] = sources.get(id.rpartition("-")[2], source)
        data = change(made)
        paths[parameters.id] = folder / parameters.id / name
        paths[parameters.id].parent.mkdir()
        paths[parameters.id].write_bytes(json.dumps(made).encode() if data is None else data)
    return paths


@pytest.fixture(scope="module")
def graded(files, key_path, tmp_path_factory):
    """{name of the case: its lesson in grades.json}."""
    out = tmp_path_factory.mktemp("grades") / "grades"
    grade_submissions(next(iter(files.values())).parents[1], [key_path], out, workers=1)
    grades = json.loads((out / "grades.json").read_text(encoding="utf-8"))
    return {learner["name"]: learner["lessons"][0] for learner in grades["learners"]}


@pytest.mark.parametrize(("change", "points", "finding", "name", "sources"), CASES)
def test_an_honest_submission_gets_the_fair_points(graded, change, points, finding, name, sources):
    lesson = graded[change.__name__]
    texts = [entry["text"] for entry in lesson["findings"]]
    assert (lesson["reason"], lesson["points"]) == ("", points), texts
    assert not finding or any(finding in text for text in texts), texts
    if not finding:
        assert not any("graded" in text and "grading uses its own" not in text for text in texts), texts


@pytest.mark.parametrize("id", [parameters.id for parameters in CASES])
def test_check_says_what_grading_says(graded, files, checks, id):
    lesson, lesson_check = graded[id], check_lesson(files[id], [checks])
    run_answers(lesson_check)
    entries = [entry for entry in lesson_check.exercises if not entry.exercise.practice]
    for exercise, entry in zip(lesson["exercises"], entries, strict=True):
        assert exercise["id"] == entry.exercise.id
        public = [case["points"] == case["max_points"] for case in exercise["cases"] if not case["hidden"]]
        passed = [case.passed for case in entry.result.cases] if entry.result else [False] * len(public)
        assert passed == public, entry.notes
        texts = [found["text"] for found in lesson["findings"] if found["exercise"] == exercise["id"]]
        assert [note for note in entry.notes if note in texts] == texts
