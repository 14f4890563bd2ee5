"""An answer to a question from an earlier lesson: right, or why not, and never an error."""

import json

import pytest
from nbclassroom.exercises.guesses import read_bare_guess

from imgproc_course.exercises import ask

CHOICE = {"answer": "b", "replies": {"a": "Not a.", "b": "It is b."}, "again": "Read section 3 again."}
NUMBER = {
    "answer": 17,
    "replies": {"17": "2 · 8 + 1.", "11": "You forgot step.", "less": "Too small.", "more": "Too large."},
    "again": "Read section 4 again.",
}


@pytest.fixture(autouse=True)
def _lesson(tmp_path, monkeypatch):
    (tmp_path / "texts").mkdir()
    (tmp_path / "texts/light.json").write_text(json.dumps({"which": CHOICE, "where": NUMBER}))
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        ("b", "Right. It is b."),
        (" B) ", "Right. It is b."),
        ("a", "Not yet. Not a. Read section 3 again."),
        ("c", "The answer is one of a, b, in quotes."),
        (3, "The answer is one of a, b, in quotes."),
        ({}, "The answer is one of a, b, in quotes."),
    ],
)
def test_a_choice_is_answered_with_its_own_reason(answer, text, capsys):
    ask("light/which", answer)
    assert capsys.readouterr().out == f"{text}\n"


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        (17, "Right. 2 · 8 + 1."),
        ("17", "Right. 2 · 8 + 1."),
        (17.0, "Right. 2 · 8 + 1."),
        (11, "Not yet. You forgot step. Read section 4 again."),
        (16, "Not yet. Too small. Read section 4 again."),
        (18.5, "Not yet. Too large. Read section 4 again."),
        ("less", "The answer is a number, such as 36."),
        ((1, 2), "The answer is a number, such as 36."),
        (True, "The answer is a number, such as 36."),
        ({}, "The answer is a number, such as 36."),
    ],
)
def test_a_number_is_right_a_known_slip_too_small_or_too_large(answer, text, capsys):
    ask("light/where", answer)
    assert capsys.readouterr().out == f"{text}\n"


def test_a_number_may_have_commas(capsys):
    ask("light/where", 691, 200)
    assert capsys.readouterr().out == "Not yet. Too large. Read section 4 again.\n"


@pytest.mark.parametrize("answer", [None, "", "?", ...])
@pytest.mark.parametrize("name", ["which", "where"])
def test_without_an_answer_it_says_how_to_give_one(name, answer, capsys):
    ask(f"light/{name}", answer)
    sentence = "No answer yet. Write your answer in place of None, and run this cell again.\n"
    assert capsys.readouterr().out == sentence


@pytest.mark.parametrize("name", ["light/other", "dark/which", "", None])
def test_a_question_whose_texts_are_missing_says_what_to_do(name, capsys):
    ask(name, "b")
    sentence = "The folder texts/ must be beside the lesson: take it again where you got the lesson.\n"
    assert capsys.readouterr().out == sentence


CALL = 'from imgproc_course.exercises import ask\n\nask("light/which", {})  # your answer: "a" or "b"'


@pytest.mark.parametrize(("typed", "answer"), [("b", "b"), ("b?", "b?"), ("'b", "b"), ("8 bytes", "8 bytes")])
def test_an_answer_without_quotes_becomes_a_text_and_a_sentence_says_so(typed, answer, capsys):
    lines = read_bare_guess(CALL.format(typed).splitlines(keepends=True), {"frame"})
    assert lines[-1].splitlines()[-1] == f'ask("light/which", "{answer}")'
    exec("".join(lines), {})
    assert capsys.readouterr().out.startswith(
        "Your answer is taken as a text. Write a number alone, such as 36, and a text in quotes:"
        f' ask("light/which", "{answer}")\n'
    )


@pytest.mark.parametrize("typed", ["None", '"b"', "17", "", "frame"])
def test_an_answer_that_python_can_read_stays(typed):
    assert read_bare_guess([CALL.format(typed)], {"frame"}) == [CALL.format(typed)]
