"""Copies of the solution are found, whatever their names and numbers; hostile text harms nobody."""

import json

import pytest
from nbclassroom.gradebook import answer_keys as answer_keys_module
from nbclassroom.gradebook.submission import EQUALS, NotebookReader, read_submission
from nbclassroom.gradebook.submission_reader import LONGEST, shapes
from submissions import notebook, write

pytestmark = pytest.mark.sandbox
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


def shape(source):
    return shapes({"e": source})["e"]


def test_names_comments_and_spacing_do_not_change_the_shape():
    assert shape(MINE) == shape(RENAMED)
    assert shape("import numpy as np\n" + MINE) == shape(MINE)
    others = (MINE, OTHER, MINE.replace(">", "<"), MINE.replace("uint8", "int8"))
    assert len({shape(source)[0] for source in others}) == 4
    assert shape("def f(a, b):\n    return a - b") == shape("def f(b, a):\n    return b - a")
    assert shape("def f(a, b):\n    return a - b") != shape("def f(a, b):\n    return b - a")
    assert shape("x = min(1, 2)") != shape("x = max(1, 2)")
    assert shape("It is *salt*.\n\nSingle pixels.") == shape("It is  *salt*. Single pixels.")
    assert shape("It is *salt*.") != shape("It is *sand*.")


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_costs_only_its_own_comparison(light, answer_keys, name):
    answers = {"light-double": MINE, "light-halves": HOSTILE[name]}
    with NotebookReader(seconds=5) as reader:
        data = json.dumps(notebook(light, answers)).encode()
        found = read_submission(data, answer_keys.versions, reader).shapes
    assert found.pop("light-double") == shape(MINE)
    assert all(count < LONGEST for _, count in found.values())


def test_a_copy_of_the_solution_is_reported_unless_it_is_short(masters, submissions, grade, monkeypatch):
    solution = next(e.solution for e in masters["light"].exercises if e.id == "light-double")
    copied = "# mine\n" + solution.replace("pixels", "p").replace("255", "254")
    for name, source in {"ada": copied, "bob": MINE}.items():
        write(submissions / f"{name}.ipynb", notebook(masters["light"], {"light-double": source}))
    for shortest, expected in ((60, []), (20, [("light-double", EQUALS)])):
        monkeypatch.setattr(answer_keys_module, "SHORTEST_SOLUTION", shortest)
        ada, bob = (learner["lessons"][0]["findings"] for learner in grade(submissions)["learners"])
        assert [(one["exercise"], one["text"]) for one in ada] == expected and bob == []


def test_practice_is_no_copy(answer_keys, monkeypatch):
    monkeypatch.setattr(answer_keys_module, "SHORTEST_SOLUTION", 1)
    equal = shapes(answer_keys.solutions("sound"))
    assert len(equal) > len(answer_keys.equal_to_solution("sound", equal)) > 0
