"""Hints in three steps, and the solution after honest tries."""

import json

import numpy as np
import pytest
from nbclassroom.authoring.masters import read_master
from nbclassroom.exercises import check, hint, progress, solution
from nbclassroom.exercises.check_files import CheckFileError
from readable_cell import run_cell
from template_master import write_carried_files

DECLARATION = (
    '# %% role="exercise"\nSIDE = 3\n'
    'exercise("test-double", function="double", hints=("What is 2 * 200 in `uint8`?", "Widen.", "a < b"),\n'
    '    explanation="It is widened first.", another_way="You can also write np.clip(...).")'
)


@pytest.fixture(autouse=True)
def lesson(write_master, tmp_path, monkeypatch):
    """The folder of a lesson with its checks and solutions, as the current one; no progress yet."""
    path = write_master(exercise=DECLARATION)
    write_carried_files(read_master(path), tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(progress, "_of_this_process", {})
    return tmp_path


def right(pixels):
    return np.minimum(pixels.astype(np.uint16) * 2, 255).astype(np.uint8)


def answers(count):
    """So many different wrong answers."""
    for number in range(count):
        namespace = {}
        exec(f"def double(pixels):\n    return pixels + {number}\n", namespace)
        yield namespace["double"]


def test_hints_come_one_after_another():
    assert repr(hint("test-double")) == "test-double: hint 1 of 3\nWhat is 2 * 200 in `uint8`?"
    assert repr(hint("test-double")) == "test-double: hint 2 of 3\nWiden."
    assert repr(hint("test-double", step=1)).endswith("in `uint8`?")  # again
    assert repr(hint("test-double")) == "test-double: hint 3 of 3\na < b"
    for _ in range(2):
        assert repr(hint("test-double")).splitlines() == [
            "There are no more hints for test-double: you saw all 3.",
            'hint("test-double", step=1) shows the first one again. solution("test-double") shows how the'
            " function can be written.",
        ]


@pytest.mark.parametrize("step", [0, 4, -1, "2", 1.0, True])
def test_a_step_that_does_not_exist_is_answered_with_the_right_call(step):
    assert repr(hint("test-double", step)) == (
        'test-double has the hints 1 to 3.\nWrite hint("test-double", step=1).'
    )
    assert progress.progress_of("test-double").hints == 0


def test_html_is_escaped_and_shows_code_as_code():
    assert "2 * 200 in <code>uint8</code>?" in hint("test-double")._repr_html_()
    assert "a &lt; b" in hint("test-double", step=3)._repr_html_()


OPEN = "test-double: one solution"


def test_the_solution_opens_after_three_different_tries():
    text = repr(solution("test-double"))
    assert text.startswith("The solution of test-double opens after 3 tries of your own: no try so far.\n")
    assert 'A try is check("test-double", double) with a changed function' in text
    first, second, third = answers(3)
    for function in (first, first, first):
        check("test-double", function)
    assert ": 1 try so far." in repr(solution("test-double"))
    check("test-double", second)
    assert ": 2 tries so far." in repr(solution("test-double"))
    check("test-double", third)
    assert repr(solution("test-double")).startswith(OPEN)


def test_the_solution_holds_code_explanation_and_another_way():
    lines = repr(solution("test-double", give_up=True)).splitlines()
    assert lines == [
        OPEN,
        "    def double(pixels):",
        "        return np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)",
        "It is widened first.",
        "What else could be right:",
        "You can also write np.clip(...).",
    ]
    html = solution("test-double", give_up=True)._repr_html_()
    assert "<pre" in html and "np.minimum(pixels.astype(np.uint16) * 2, LIMIT)" in html


def test_the_stub_is_no_try_and_a_right_answer_opens_the_solution():
    def stub(pixels):
        raise NotImplementedError("your turn")

    for _ in range(3):
        check("test-double", stub)
    assert ": no try so far." in repr(solution("test-double"))
    result = check("test-double", right)
    assert repr(result).endswith("\nYou can also write np.clip(...).")
    assert "You can also write np.clip(...)." in result._repr_html_()
    assert repr(solution("test-double")).startswith(OPEN)


def test_comments_make_no_new_try():
    for comment in ("", "# one more\n", "\n\n"):
        check("test-double", run_cell(f"{comment}def double(pixels):\n    return pixels\n")["double"])
    assert len(progress.progress_of("test-double").tries) == 1


def test_a_wrong_answer_shows_no_other_way():
    assert "np.clip" not in repr(check("test-double", next(answers(1))))


def test_a_solution_that_is_not_there_is_not_released(lesson):
    (lesson / "solutions" / "doubling.json").unlink()
    for function in answers(3):
        check("test-double", function)
    for give_up in (False, True):
        assert repr(solution("test-double", give_up=give_up)) == (
            "Your teacher has not released the solution of test-double yet."
        )


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": 1}', '{"format": 1, "solutions": {}}'])
def test_a_damaged_solution_is_named_with_the_remedy(lesson, text):
    (lesson / "solutions" / "doubling.json").write_text(text)
    with pytest.raises(CheckFileError, match=r"solutions/doubling.json cannot be read .*take the folder sol"):
        solution("test-double", give_up=True)


@pytest.mark.parametrize("function", [hint, solution, lambda id: check(id, right)])
def test_for_an_unknown_exercise_the_nearest_is_named(function):
    with pytest.raises(
        CheckFileError, match="there is no exercise 'test-duoble'; did you mean 'test-double'"
    ):
        function("test-duoble")


@pytest.mark.parametrize(
    "change",
    [
        lambda data: data.clear(),
        lambda data: data.update(format="one"),
        lambda data: data.pop("cells"),
        lambda data: data["exercises"]["test-double"].pop("cases"),
        lambda data: data["exercises"]["test-double"].update(cases=7),
        lambda data: data["values"].clear(),
        lambda data: data["exercises"]["test-double"]["mistakes"][0].pop("says"),
    ],
)
def test_damaged_checks_are_one_line_with_the_remedy(lesson, change):
    path = lesson / "checks" / "doubling.json"
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data) + ' "test-double"')
    assert_damaged()
    path.write_text(json.dumps(data | {"note": "test-double"}))
    assert_damaged()


def assert_damaged():
    with pytest.raises(CheckFileError) as error:
        check("test-double", right)
    assert str(error.value).startswith("checks/doubling.json cannot be read (")
    assert str(error.value).endswith("take the folder checks/ again from the course or from your teacher")
    assert error.value._render_traceback_() == [str(error.value)]


def test_a_newer_format_asks_for_an_update(lesson):
    path = lesson / "checks" / "doubling.json"
    path.write_text(path.read_text().replace('"format": 1', '"format": 2'))
    with pytest.raises(
        CheckFileError, match=r"newer version of the course \(format 2, this one reads 1\): up"
    ):
        check("test-double", right)


def test_a_damaged_file_of_another_lesson_does_no_harm(lesson):
    (lesson / "checks" / "aaa.json").write_text("{")
    assert check("test-double", right).passed
    with pytest.raises(CheckFileError, match=r"checks/aaa.json cannot be read"):
        check("test-unknown", right)  # it may be in the damaged file


def test_the_variable_comes_first_and_then_the_current_folder(lesson, monkeypatch):
    other = lesson / "other"
    other.mkdir()
    data = json.loads((lesson / "checks" / "doubling.json").read_text())
    data["exercises"]["test-double"]["hints"] = ["Another hint."]
    (other / "mine.json").write_text(json.dumps(data))
    assert "uint8" in repr(hint("test-double", 1))
    monkeypatch.setenv("NBCLASSROOM_CHECKS", str(other))
    assert "Another hint." in repr(hint("test-double", 1))
