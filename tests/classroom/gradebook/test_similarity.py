"""Similar submissions and copies of the solution are found, whatever the names; hostile text harms nobody."""

import json

import pytest
from submissions import notebook, write

from imgproc_course.classroom.gradebook import notebook_reader, similarity
from imgproc_course.classroom.gradebook.collect import collect
from imgproc_course.classroom.gradebook.fingerprints import (
    LONGEST,
    K,
    W,
    fingerprints,
    shape_of,
    syntax_tokens,
    winnowed,
)
from imgproc_course.classroom.gradebook.learners import read_all
from imgproc_course.classroom.gradebook.notebook_reader import NotebookReader
from imgproc_course.classroom.gradebook.result_store import ResultStore
from imgproc_course.classroom.gradebook.similarity import (
    MOST_VERSIONS,
    compare,
    report_copies,
    similarity_page,
)

MINE = '''
def double(pixels):
    """Twice as bright."""
    result = []
    for row in pixels:
        line = []
        for value in row:
            bright = int(value) + int(value)
            if bright > LIMIT:
                bright = LIMIT
            line.append(bright)
        result.append(line)
    return np.array(result, dtype=np.uint8)
'''
RENAMED = """
# entirely my own work <script>alert(1)</script>
def double(img: np.ndarray) -> np.ndarray:
    out = []
    for r in img:   # every row
        l = []
        for v in r:
            w = int(v) + int(v)
            if w > LIMIT:
                w = LIMIT
            l.append(w)
        out.append(l)
    return np.array(out, dtype=np.uint8)
"""
OTHER = """
def double(pixels):
    table = np.zeros(256, dtype=np.uint8)
    position = 0
    while position < 256:
        table[position] = min(2 * position, 255)
        position += 1
    flat = [table[element] for element in pixels.ravel().tolist()]
    return np.asarray(flat).reshape(pixels.shape)
"""
HOSTILE = {
    "deep": "x = " + "-" * 9_000 + "1",
    "brackets": "(" * 9_000,
    "a huge number": "x = 0x" + "f" * 19_000,
    "a long number": "x = " + "9" * 19_000,
    "surrogates": "x = '\ud800'",
    "a null byte": "x = 1\x00",
    "too long": "x = 1\n" * LONGEST,
    "one long line": "x = " + "a.b" * 6_000,
    "many strings": "x = " + "'a' " * 4_900,
}


def read_fingerprints(submissions):
    with NotebookReader(seconds=5) as reader:
        return [reader.fingerprints(answers) for answers in submissions]


def shape(source):
    return shape_of(syntax_tokens(source))


def test_names_comments_and_spacing_do_not_change_the_shape():
    assert shape(MINE) == shape(RENAMED)
    assert shape("import numpy as np\n" + MINE) == shape(MINE)
    assert (
        len(
            {
                shape(source)[0]
                for source in (MINE, OTHER, MINE.replace(">", "<"), MINE.replace("uint8", "int8"))
            }
        )
        == 4
    )
    assert shape("def f(a, b):\n    return a - b") == shape("def f(b, a):\n    return b - a")
    assert shape("def f(a, b):\n    return a - b") != shape("def f(a, b):\n    return b - a")
    assert shape("x = min(1, 2)") != shape("x = max(1, 2)")


@pytest.mark.parametrize("start", range(12))
def test_a_common_run_of_tokens_always_gives_a_common_fingerprint(start):
    common = [(f"c{n}", 1) for n in range(W + K - 1)]
    first = [(f"a{n}", 1) for n in range(start)] + common + [(f"b{n}", 1) for n in range(7)]
    second = [(f"d{n}", 1) for n in range(11)] + common
    assert winnowed(first).keys() & winnowed(second).keys()
    assert not winnowed(first[:-7][: start + K - 1]).keys() & winnowed(second).keys()


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_costs_only_its_own_comparison(name):
    hostile, mine = read_fingerprints([{"e": HOSTILE[name]}, {"e": MINE}])
    assert mine == json.loads(json.dumps(fingerprints({"e": MINE})))
    assert mine["shapes"]["e"] == shape(MINE)
    assert hostile["shapes"].get("e", [0, 0])[1] < LONGEST


def test_a_number_too_huge_to_write_in_decimals_is_compared_like_any_other():
    huge = HOSTILE["a huge number"]
    (result,) = read_fingerprints(
        [{"one": huge, "same": f"{huge}  # mine", "other": huge[:-1] + "e", "mine": MINE}]
    )
    assert result["shapes"]["one"] == result["shapes"]["same"] == shape(huge)
    assert result["shapes"]["one"] != result["shapes"]["other"]
    assert result["shapes"]["mine"] == shape(MINE)


def test_a_submission_that_ends_the_process_costs_only_its_own_comparison(tmp_path, monkeypatch):
    program, source = tmp_path / "reader.py", notebook_reader._READER.read_text(encoding="utf-8")
    ending = 'if b"ended" in body: os.abort()\n                reply = fingerprints.'
    source = source.replace("reply = fingerprints.", ending)
    source = source.replace("__file__", repr(str(notebook_reader._READER)))
    program.write_text(source, encoding="utf-8")
    monkeypatch.setattr(notebook_reader, "_READER", program)
    results = read_fingerprints([{"e": MINE}, {"e": "ended"}, {"e": OTHER}])
    assert [result["shapes"].get("e") for result in results] == [shape(MINE), None, shape(OTHER)]


@pytest.fixture
def submit(light, submissions):
    def write_answers(answers):
        for name, source in answers.items():
            write(submissions / f"{name}.ipynb", notebook(light, {"light-double": source}))
        return submissions

    return write_answers


@pytest.mark.sandbox
@pytest.mark.xdist_group("answer_key")
def test_similar_submissions_stand_side_by_side_on_a_page(submit, grade, tmp_path):
    answers = {
        "ada": MINE,
        "bob": RENAMED.replace("int(v) + int(v)", "2 * int(v)"),
        "cy": OTHER,
        "dora": "def double(",
    }
    grades = grade(submit(answers))
    ((pair),) = grades["similar"]
    assert (pair["lesson"], pair["learners"]) == ("light", ["ada", "bob"])
    assert 50 <= pair["percent"] < 100
    page = (tmp_path / "grades" / "similar.html").read_text(encoding="utf-8")
    assert (
        "<mark>    for row in pixels:</mark>" in page
        and "<mark>    for r in img:   # every row</mark>" in page
    )
    assert "<mark># entirely my own work" not in page
    assert "&lt;script&gt;" in page and "<script" not in page
    assert 'href="similar.html"' in (tmp_path / "grades" / "summary.html").read_text(encoding="utf-8")
    assert [learner["points"] for learner in grades["learners"]] == [3, 3, 3, 0]
    grades = grade(submit({"bob": "def double(p):\n    return p"}))
    assert grades["similar"] == [] and not (tmp_path / "grades" / "similar.html").exists()


def compared(folder, answer_keys, tmp_path):
    learners, store = learners_of(folder, answer_keys, tmp_path)
    return compare(learners, answer_keys, store)


def learners_of(folder, answer_keys, tmp_path):
    (tmp_path / "results").mkdir(exist_ok=True)
    store = ResultStore(tmp_path / "results", {})
    with collect(folder, ("light", "sound")) as collection:
        return read_all(collection, answer_keys, store, quiet=True), store


def test_equal_answers_are_one_entry_and_common_ones_do_not_count(submit, answer_keys, tmp_path):
    names = [f"learner {number:02d}" for number in range(30)]
    folder = submit(dict.fromkeys(names[:3], MINE) | {"x": OTHER})
    pairs, _ = compared(folder, answer_keys, tmp_path)
    assert [(pair.share, pair.learners) for pair in pairs] == [(1.0, tuple(names[:3]))]
    common = {name: MINE + f"\nx{n} = {n}\n" for n, name in enumerate(names)}
    pairs, _ = compared(submit(common), answer_keys, tmp_path)
    assert pairs == []


@pytest.mark.sandbox
@pytest.mark.xdist_group("answer_key")
def test_forty_learners_who_share_an_answer_are_one_group_and_its_code_is_shown_once(
    submit, grade, answer_keys, tmp_path
):
    names = [f"learner {number:02d}" for number in range(40)]
    grades = grade(submit(dict.fromkeys(names, MINE)))
    assert [(group["percent"], group["learners"]) for group in grades["similar"]] == [(100, names)]
    page = (tmp_path / "grades" / "similar.html").read_text(encoding="utf-8")
    assert page.count("<mark>    for row in pixels:</mark>") == 1
    assert page.count("and 35 more") == 2 and "All 40 learners" in page
    assert [page.count(name) for name in (names[0], names[39])] == [3, 1]


def test_submissions_that_share_one_answer_are_one_group_whatever_else_they_answer(
    light, submissions, answer_keys, tmp_path
):
    names, halves = [f"learner {number:02d}" for number in range(40)], OTHER.replace("double", "halves")
    for number, name in enumerate(names):
        own = halves + f"\nx = {number % 8}\n"
        write(submissions / f"{name}.ipynb", notebook(light, {"light-double": MINE, "light-halves": own}))
    ((group,), _) = compared(submissions, answer_keys, tmp_path)
    assert (group.lesson, group.learners, group.share) == ("light", tuple(names), 1.0)
    (shared,) = group.versions["light-double"]
    assert shared.learners == tuple(names) and shared.source.strip() == MINE.strip()
    versions = group.versions["light-halves"]
    assert [version.learners for version in versions] == [tuple(names[k::8]) for k in range(8)]
    page = similarity_page([group], {name: name for name in names})
    assert page.count("for row in pixels:") == 1 and page.count("while position") == MOST_VERSIONS
    assert "Other versions of" in page


def test_a_copy_of_the_solution_is_reported_unless_it_is_short(
    submit, masters, answer_keys, tmp_path, monkeypatch
):
    solution = next(e.solution for e in masters["light"].exercises if e.id == "light-double")
    folder = submit({"ada": "# mine\n" + solution.replace("pixels", "p").replace("255", "254"), "bob": MINE})
    learners, store = learners_of(folder, answer_keys, tmp_path)
    ada = learners[0].submissions["light"].answers_digest
    assert compare(learners, answer_keys, store)[1][ada] == []  # independent learners often write the same
    monkeypatch.setattr(similarity, "SHORTEST_SOLUTION", 20)
    copies = compare(learners, answer_keys, store)[1]
    assert copies[ada] == ["light-double"] and sum(map(len, copies.values())) == 1
    (first, second) = report_copies(entries_of(learners, "light-double"), learners, copies)
    assert "equals the course's solution" in first["lessons"][0]["findings"][0]["text"]
    assert second["lessons"][0]["findings"] == []
    (first, _) = report_copies(entries_of(learners, "light-halves"), learners, copies)
    assert first["lessons"][0]["findings"] == []  # light-double is practice in this one


def entries_of(learners, graded):
    exercises = [{"id": graded}]
    return [{"lessons": [{"lesson": "light", "findings": [], "exercises": exercises}]} for _ in learners]
