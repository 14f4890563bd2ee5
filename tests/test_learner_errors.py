"""What a learner sees of an error in their function: their lines, the error, the advice; once per cause."""

import numpy as np

from imgproc_course import learner_errors
from imgproc_course.imaging import to_gray
from imgproc_course.learner_errors import RepeatedErrors, describe


def gray_of(frame):
    return to_gray(frame[0])


def error_of(function, *arguments):
    try:
        function(*arguments)
    except Exception as error:  # noqa: BLE001
        return error


def test_the_learners_lines_and_the_error_without_the_lines_of_packages():
    error = error_of(lambda: gray_of(np.zeros((2, 2, 3), np.uint8)))
    lines = describe(error).splitlines()
    assert [line.partition(":  ")[2] for line in lines[1:3]] == [
        "error = error_of(lambda: gray_of(np.zeros((2, 2, 3), np.uint8)))",
        "return to_gray(frame[0])",
    ]
    assert lines[2].startswith("in gray_of, line 1") and lines[3].startswith("ValueError: ")
    assert "grayscale.py" not in describe(error)


def test_an_error_without_a_line_of_the_learners_has_no_description():
    error = ValueError("raised nowhere")
    assert describe(error) == ""


def test_the_advice_of_the_exercises_follows(monkeypatch):
    from nbclassroom.exercises import error_advice

    monkeypatch.setattr(learner_errors, "advisers", [])
    mask = np.array([True, False])
    error = error_of(lambda: 1 if mask else 0)
    plain = describe(error)
    error_advice.advise_everywhere()
    error_advice.advise_everywhere()
    assert len(learner_errors.advisers) == 1
    assert describe(error).startswith(f"{plain}\n`if` and `while` need one True or False")
    assert describe(error_of(lambda: grey)).endswith("Run the cell that imports or defines grey.")  # noqa: F821


def test_a_cause_is_news_once_and_then_by_its_count():
    errors = RepeatedErrors()
    news = [errors.news(error_of(lambda k=k: [][k]), f"index {k}") for k in range(101)]
    assert [text for text in news if text] == [
        "index 0",
        "again, 10 times: IndexError: list index out of range",
        "again, 100 times: IndexError: list index out of range",
    ]
    assert errors.news(error_of(lambda: {}["a"]), "another cause") == "another cause"
