"""Copies of the solution are found, whatever their names and numbers; hostile text harms nobody."""

import pytest
from nbclassroom.gradebook import copies, notebook_reader
from nbclassroom.gradebook.collect import Collection
from nbclassroom.gradebook.copies import find_copies, report_copies
from nbclassroom.gradebook.learners import read_all
from nbclassroom.gradebook.notebook_reader import NotebookReader
from nbclassroom.gradebook.result_store import ResultStore
from nbclassroom.gradebook.syntax_shapes import LONGEST, shapes
from submissions import notebook, write

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


def read_shapes(submissions):
    with NotebookReader(seconds=5) as reader:
        return [reader.shapes(answers) for answers in submissions]


def shape(source):
    return shapes({"e": source})["e"]


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


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_costs_only_its_own_comparison(name):
    hostile, mine = read_shapes([{"e": HOSTILE[name]}, {"e": MINE}])
    assert mine == {"e": shape(MINE)}
    assert hostile.get("e", ("", 0))[1] < LONGEST


def test_a_submission_that_ends_the_process_costs_only_its_own_comparison(tmp_path, monkeypatch):
    program, source = tmp_path / "reader.py", notebook_reader._READER.read_text(encoding="utf-8")
    ending = 'if b"ended" in body: os.abort()\n                reply = {"shapes"'
    source = source.replace('reply = {"shapes"', ending)
    source = source.replace("__file__", repr(str(notebook_reader._READER)))
    program.write_text(source, encoding="utf-8")
    monkeypatch.setattr(notebook_reader, "_READER", program)
    results = read_shapes([{"e": MINE}, {"e": "ended"}, {"e": OTHER}])
    assert results == [{"e": shape(MINE)}, {}, {"e": shape(OTHER)}]


@pytest.fixture
def submit(light, submissions):
    def write_answers(answers):
        for name, source in answers.items():
            write(submissions / f"{name}.ipynb", notebook(light, {"light-double": source}))
        return submissions

    return write_answers


def learners_of(folder, answer_keys, tmp_path):
    (tmp_path / "results").mkdir(exist_ok=True)
    store = ResultStore(tmp_path / "results", {})
    with Collection(folder, ("light", "sound")) as collection:
        return read_all(collection, answer_keys, store, quiet=True), store


def test_a_copy_of_the_solution_is_reported_unless_it_is_short(
    submit, masters, answer_keys, tmp_path, monkeypatch
):
    solution = next(e.solution for e in masters["light"].exercises if e.id == "light-double")
    folder = submit({"ada": "# mine\n" + solution.replace("pixels", "p").replace("255", "254"), "bob": MINE})
    learners, store = learners_of(folder, answer_keys, tmp_path)
    ada = learners[0].submissions["light"].answers_digest
    assert find_copies(learners, answer_keys, store)[ada] == []  # independent learners often write the same
    monkeypatch.setattr(copies, "SHORTEST_SOLUTION", 20)
    equal = find_copies(learners, answer_keys, store)
    assert equal[ada] == ["light-double"] and sum(map(len, equal.values())) == 1
    (first, second) = report_copies(entries_of(learners, "light-double"), learners, equal)
    assert "equals the course's solution" in first["lessons"][0]["findings"][0]["text"]
    assert second["lessons"][0]["findings"] == []
    (first, _) = report_copies(entries_of(learners, "light-halves"), learners, equal)
    assert first["lessons"][0]["findings"] == []  # light-double is practice in this one


def entries_of(learners, graded):
    exercises = [{"id": graded}]
    return [{"lessons": [{"lesson": "light", "findings": [], "exercises": exercises}]} for _ in learners]
