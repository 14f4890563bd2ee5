"""`check`, in a notebook and on its file, and `grade` give one verdict, whatever happened to a notebook."""

import json
import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from jupyterlab_cells import insert, new_cell, position_of
from kernel_points import NotebookKernel
from nbclassroom.authoring.masters import read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import autograde
from nbclassroom.gradebook.answer_keys import AnswerKeys
from nbclassroom.gradebook.check import check_lesson, run_answers
from nbclassroom.gradebook.collect import Collection
from nbclassroom.gradebook.learners import read_all
from nbclassroom.gradebook.submission import EQUALS
from nbclassroom.gradebook.submission_reader import syntax_tokens
from own_cells import FORMS, MORE, NODE, NODE_FORMS, NODE_MORE, TIMES
from submissions import SEED, answers_of, notebook
from template_master import write_carried_files

pytestmark = [pytest.mark.sandbox, pytest.mark.usefixtures("one_fork_server")]  # the key is made in a sandbox


class PageStore:
    """Stands in for the store of `grade`: it keeps the page of the last submission."""

    def __init__(self):
        self.page = None

    def keep_page(self, _key, _lesson, page):
        self.page = page
        return "digest"


def verdict_of(content, page):
    found = [one for one in content.findings if one.text != EQUALS]  # `check` has no solutions
    findings = [(finding.kind, finding.exercise, finding.text) for finding in found]
    return {"lesson": content.lesson, "page": page, "states": content.states, "findings": findings}


def verdict_of_check(path, checks):
    try:
        return checked(path, checks)[0]
    except ValueError as error:
        return {"reason": str(error).removeprefix(f"{path}: ")}


def checked(path, checks):
    """(verdict, LessonCheck) of `imgproc-course check`, whose answers can then be run."""
    lesson_check = check_lesson(path, [checks])
    assert {entry.exercise.id: entry.state for entry in lesson_check.exercises} == lesson_check.content.states
    return verdict_of(lesson_check.content, lesson_check.content.page), lesson_check


def verdict_of_grade(path, answer_keys):
    store = PageStore()
    folder = path.with_name(f"{path.name}, submitted")
    (folder / "ada").mkdir(parents=True, exist_ok=True)
    shutil.copy(path, folder / "ada")
    with Collection(folder, tuple(answer_keys.lessons), ["{learner}"]) as collection:
        (learner,) = read_all(collection, answer_keys, store)
    (submission,) = [*learner.submissions.values(), *learner.unidentified]
    if submission.reason:
        return {"reason": submission.reason}
    return verdict_of(submission, store.page)


CODE = [
    "",
    "# later",
    "x = 1",
    "def double(p):\n    return p",
    "def double(p)\n    return p",
    "def halves(p):\n    return p, p",
    'def double(pixels):\n    raise NotImplementedError("your turn")  # hm',
    "# NBVAL_SKIP\ndef double(p): ...",
    "%matplotlib inline\ndef double(p): ...",
    "LIMIT, wide = 3, halves\ndef halves(p):\n    return double(p), LIMIT",
    "def double(p):\n    return wide(halves(p))",
    "double = lambda p: p",
    "from numpy import *",
    "x = '\ud800'",
    "\x00",
    "x = " + "(" * 300,
    "x = " + "-" * 90_000 + "1",
    "#" * 200_100,
]
IDS = [
    "answer-light-double",
    "answer-light-halves",
    "answer-sound-mean",
    "check-light-double-1",
    "given-light-double-1",
    "mine",
    "",
    None,
    7,
]
positions = st.integers(0, 30)
sources = st.one_of(st.sampled_from(CODE), st.text(max_size=30), st.sampled_from([7, None, ["a", "b"], [1]]))
damages = st.one_of(
    st.tuples(st.just("delete"), positions),
    st.tuples(st.just("duplicate"), positions, positions),
    st.tuples(st.just("retype"), positions, st.sampled_from(["raw", "markdown", "code", "", None, []])),
    st.tuples(st.just("split"), positions),
    st.tuples(st.just("id"), positions, st.sampled_from(IDS)),
    st.tuples(st.just("source"), positions, sources),
    st.tuples(st.just("exercise"), positions, st.sampled_from(["light-double", "light-halves", 3])),
    st.tuples(st.just("tags"), positions, st.sampled_from([["nbval-skip"], ["mine"], 3])),
    st.tuples(st.just("insert"), positions, st.sampled_from([None, 3, "cell", {}, {"cell_type": "code"}])),
    st.tuples(st.just("reverse")),
    st.tuples(st.just("lose ids")),
    st.tuples(st.just("nbformat"), st.sampled_from([2, 3, 5, None, True, "4"])),
    st.tuples(st.just("lesson"), st.sampled_from(["21_sound", "20_light", "../x", 3, None])),
    st.tuples(st.just("version"), st.sampled_from(["0.0.9", None, "\u202e"])),
    st.tuples(st.just("kernel"), st.sampled_from(["bash", "python3", 3])),
    st.tuples(st.just("metadata"), st.sampled_from([{}, None, []])),
    st.tuples(st.just("cells"), st.sampled_from([[], None, {}])),
)
names = st.sampled_from(["20_light", "21_sound", "final", "20_light-1", "20_light 21_sound"])
file_damages = st.sampled_from(["none"] * 9 + ["cut", "byte order mark", "latin-1", "empty", "list"])


def damaged(made, damage):
    """Apply one damage to a notebook (a dict), in place."""
    kind, *values = damage
    about = made["metadata"].get("imgproc_course", {}) if isinstance(made["metadata"], dict) else {}
    if kind in ("nbformat", "metadata", "cells"):
        made[kind] = values[0]
    elif kind in ("lesson", "version"):
        about[kind] = values[0]
    elif kind == "kernel":
        if isinstance(made["metadata"], dict):
            made["metadata"]["kernelspec"] = {"name": values[0]}
    elif isinstance(made["cells"], list) and made["cells"]:
        damage_cells(made["cells"], kind, values)


def damage_cells(cells, kind, values):
    if kind == "reverse":
        cells.reverse()
        return
    if kind == "lose ids":
        for cell in cells:
            if isinstance(cell, dict):
                cell.pop("id", None)
        return
    position = values[0] % len(cells)
    cell = cells[position]
    if kind == "delete":
        del cells[position]
    elif kind == "insert":
        cells.insert(position, values[1])
    elif not isinstance(cell, dict):
        return
    elif kind == "duplicate":
        cells.insert(values[1] % len(cells), dict(cell))
    elif kind == "retype":
        cell["cell_type"] = values[1]
    elif kind == "split" and isinstance(cell.get("source"), str):
        lines = cell["source"].splitlines(keepends=True)
        cells.insert(position + 1, dict(cell, id="second-half", source="".join(lines[1:])))
        cell["source"] = "".join(lines[:1])
    elif kind == "id":
        cell["id"] = values[1]
    elif kind == "source":
        cell["source"] = values[1]
    elif kind == "exercise":
        cell["metadata"] = {"imgproc_course": {"exercise": values[1]}}
    elif kind == "tags":
        cell["metadata"] = {"tags": values[1]}


def as_bytes(made, file_damage):
    data = json.dumps(made).encode()
    return {
        "cut": data[: len(data) // 2],
        "byte order mark": b"\xef\xbb\xbf" + data,
        "latin-1": data + "ä".encode("latin-1"),
        "empty": b"",
        "list": b"[%s]" % data,
    }.get(file_damage, data)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(solved=st.booleans(), changes=st.lists(damages, max_size=6), name=names, file_damage=file_damages)
def test_check_and_grade_give_one_verdict(
    light, answer_keys, checks, tmp_path, solved, changes, name, file_damage
):
    made = notebook(light, answers_of(light, "right") if solved else None)
    for damage in changes:
        damaged(made, damage)
    path = tmp_path / f"{name}.ipynb"
    path.write_bytes(as_bytes(made, file_damage))
    assert verdict_of_check(path, checks) == verdict_of_grade(path, answer_keys)


# ---------------------------------------------------------------- what an answer takes along

FUNCTIONS = {"light-double": "double", "light-halves": "halves"}
more_cells = st.lists(st.tuples(positions, st.sampled_from(MORE)), max_size=2)


def with_own_cells(light, own, answer, below=(), *, more=()):
    """The lesson with a learner's cells above and below their answer, and more of them in any place."""
    made = notebook(light, answers_of(light, "right") | {"light-double": answer})
    insert(made, position_of(made, "answer-light-double") + 1, *map(new_cell, below))
    insert(made, position_of(made, "answer-light-double"), *map(new_cell, own))
    for position, source in more:
        insert(made, position % len(made["cells"]), new_cell(source))
    return made


@pytest.fixture(scope="module")
def kernel(checks):
    kernel = NotebookKernel(checks)
    yield kernel
    kernel.close()


def points_of_run(lesson_check):
    """{exercise id: points}, as `imgproc-course check --run` gives them."""
    run_answers(lesson_check)
    return {entry.exercise.id: entry.result.points if entry.result else 0 for entry in lesson_check.exercises}


def assert_same_points(made, folder, checks, answer_keys, kernel):
    """`check` in a notebook that runs from the top, `check --run` and `grade` give the same points.

    Where a cell fails, JupyterLab leaves out the rest of it, and grading goes on with its next statement. A
    module that the exercise does not allow is there in a notebook, which says so.
    """
    path = folder / "20_light.ipynb"
    path.write_text(json.dumps(made), encoding="utf-8")
    content, lesson_check = checked(path, checks)
    assert content == verdict_of_grade(path, answer_keys)
    in_run = points_of_run(lesson_check)
    (result,) = autograde([("one", "light", content["page"])], answer_keys.keys[0], workers=1)
    graded = {one.id: sum(case.points for case in one.cases if not case.hidden) for one in result.exercises}
    assert graded == in_run
    here, has_failed = kernel.points(made["cells"], FUNCTIONS)
    for id, (points, text) in here.items():
        if has_failed or "grading would refuse" in text or "NameError" in text:
            assert points <= in_run[id], (text, content["findings"])
        else:
            assert points == in_run[id], (text, content["findings"])


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(form=st.sampled_from(FORMS), more=more_cells)
def test_check_in_a_notebook_check_of_its_file_and_grade_give_the_same_points(
    light, answer_keys, checks, kernel, tmp_path, form, more
):
    assert_same_points(with_own_cells(light, *form, more=more), tmp_path, checks, answer_keys, kernel)


@pytest.mark.parametrize("form", FORMS, ids=range(len(FORMS)))
def test_each_form_of_an_answer_gives_one_verdict(light, answer_keys, checks, kernel, tmp_path, form):
    assert_same_points(with_own_cells(light, *form), tmp_path, checks, answer_keys, kernel)


def test_the_check_of_another_name_says_so(light, answer_keys, kernel, tmp_path):
    made = with_own_cells(light, [], WRONG)
    cell = new_cell(RIGHT.replace("double", "double_2") + '\ncheck("light-double", double_2)')
    insert(made, position_of(made, "check-light-double-1") + 1, cell)
    path = tmp_path / "20_light.ipynb"
    path.write_text(json.dumps(made), encoding="utf-8")
    texts = [text for _, exercise, text in verdict_of_grade(path, answer_keys)["findings"] if exercise]
    assert texts == ["a cell checks double_2, and double() is graded"]
    here, _ = kernel.points(made["cells"], {"light-double": "double_2"})
    points, text = here["light-double"]
    assert points == 1
    assert "This is double_2, and grading takes double(): give it this name in the answer cell" in text


RIGHT, WRONG = TIMES.format(2), "def double(pixels):\n    return pixels"
DEFAULTS = {
    "an image of the lesson": "def double(pixels=PICTURE):\n    "
    "return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)",
    "an own argument keeps its value": "def double(pixels=PICTURE, factor=FACTOR):\n    "
    "return np.minimum(pixels.astype(int) * factor, LIMIT).astype(np.uint8)",
}


@pytest.mark.parametrize("name", DEFAULTS)
def test_a_default_value_of_an_argument_that_every_call_gives_needs_nothing(
    light, answer_keys, checks, tmp_path, name
):
    own = ["import skimage.data\nPICTURE = skimage.data.camera()\nFACTOR = 2"]
    path = tmp_path / "20_light.ipynb"
    path.write_text(json.dumps(with_own_cells(light, own, DEFAULTS[name])), encoding="utf-8")
    content, lesson_check = checked(path, checks)
    assert content == verdict_of_grade(path, answer_keys)
    assert points_of_run(lesson_check)["light-double"] == 1


# ---------------------------------------------------------------- an answer that is a class

NODE_MASTERS = Path(__file__).parent / "nodes" / "masters"


@pytest.fixture(scope="module")
def nodes(tmp_path_factory):
    """A lesson whose answer is a node: its Master, the folder of its checks, and its AnswerKeys."""
    folder = tmp_path_factory.mktemp("nodes")
    master = read_master(NODE_MASTERS / "22_nodes.py")
    write_carried_files(master, folder)
    make_key(NODE_MASTERS, SEED, folder / "key")
    return master, folder / "checks", AnswerKeys([folder / "key"])


@pytest.fixture(scope="module")
def node_kernel(nodes):
    kernel = NotebookKernel(nodes[1])
    yield kernel
    kernel.close()


def node_notebook(master, own, answer, more=()):
    made = notebook(master, {"nodes-double": answer})
    insert(made, position_of(made, "answer-nodes-double"), *map(new_cell, own))
    for position, source in more:
        insert(made, position % len(made["cells"]), new_cell(source))
    return made


def node_verdicts(made, folder, nodes, kernel):
    """(points in a kernel, points of `check --run`, the kernel's text, the verdict of `grade`'s reader)."""
    _, checks, answer_keys = nodes
    path = folder / "22_nodes.ipynb"
    path.write_text(json.dumps(made), encoding="utf-8")
    content, lesson_check = checked(path, checks)
    assert content == verdict_of_grade(path, answer_keys)
    here, _ = kernel.points(made["cells"], {"nodes-double": "Doubler"})
    points, text = here.get("nodes-double", (None, ""))
    in_run = points_of_run(lesson_check)["nodes-double"]
    return points, in_run, text, content


@pytest.mark.parametrize("name", NODE_FORMS)
def test_a_class_gets_the_same_points_everywhere(nodes, node_kernel, tmp_path, name):
    own, answer, points = NODE_FORMS[name]
    made = node_notebook(nodes[0], own, answer)
    in_kernel, in_run, text, content = node_verdicts(made, tmp_path, nodes, node_kernel)
    (result,) = autograde([("one", "nodes", content["page"])], nodes[2].keys[0], workers=1)
    graded = sum(case.points for case in result.exercises[0].cases if not case.hidden)
    assert (in_kernel, in_run, graded) == (points, points, points), (text, content["findings"])


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(
    form=st.sampled_from(sorted(NODE_FORMS)),
    more=st.lists(st.tuples(positions, st.sampled_from(NODE_MORE)), max_size=2),
)
def test_a_class_and_other_cells_give_the_same_points(nodes, node_kernel, tmp_path, form, more):
    made = node_notebook(nodes[0], *NODE_FORMS[form][:2], more)
    in_kernel, in_run, text, content = node_verdicts(made, tmp_path, nodes, node_kernel)
    assert in_kernel in (None, in_run), (text, content["findings"], content["page"]["answers"])


NODE_STUB = "class Doubler(Node):\n    def __init__(self):\n        f = 2\n        raise NotImplementedError"


@pytest.mark.parametrize(
    ("answer", "own", "state", "text"),
    [
        ("class Doubler(Node):\n    pass", [], "not attempted", None),
        (
            NODE_STUB,
            [],
            "not attempted",
            "Doubler: The line with raise NotImplementedError is still there, and ends the function: delete"
            " it.",
        ),
        (
            NODE.format(2).replace("Doubler", "Doublr"),
            [],
            "broken",
            "its answer cell does not define Doubler, but Doublr; the name must be the one of the task",
        ),
        (NODE_STUB, [NODE.format(2)], "answered", "graded from cell number 6, which defines Doubler"),
    ],
)
def test_what_is_reported_of_a_class(nodes, tmp_path, answer, own, state, text):
    made = node_notebook(nodes[0], [], answer)
    made["cells"] += [dict(new_cell(source), id="mine") for source in own]
    path = tmp_path / "22_nodes.ipynb"
    path.write_text(json.dumps(made), encoding="utf-8")
    content = verdict_of_check(path, nodes[1])
    assert content == verdict_of_grade(path, nodes[2])
    assert content["states"] == {"nodes-double": state}
    assert [finding[2] for finding in content["findings"]] == [text] * (text is not None)


def test_a_class_is_compared_whatever_its_names(nodes):
    renamed = NODE.format(2).replace("publisher =", "out =").replace("self.publisher.", "self.out.")
    shapes = [syntax_tokens(source) for source in (NODE.format(2), renamed, NODE.format(3))]
    assert shapes[0] == shapes[1] != shapes[2]
    assert shapes[0] == syntax_tokens(nodes[0].exercises[0].solution)
