"""No prediction whose answer a learner has read before, save those with a reason."""

import sys
from pathlib import Path

import nbformat
import pytest

sys.path.append(str(Path(__file__).parent))
from spoiled_predictions import spoiled_predictions

from imgproc_course.classroom.authoring.masters import find_lessons

LESSONS = find_lessons(Path(__file__).parents[2] / "notebooks")

ARRAY_IN_SIGHT = "the array is shown on purpose: the question is which of its numbers"
BY_CHANCE = "the same number with another meaning"
CHOICE = "the question names it among its choices"
ALLOWED = {}


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in LESSONS])
def test_no_answer_stands_above_its_prediction(path):
    spoiled = spoiled_predictions(nbformat.read(path, as_version=4).cells)
    unexpected = [str(each) for each in spoiled if each.prediction not in ALLOWED]
    assert unexpected == []


def test_every_exception_is_needed():
    found = {
        each.prediction
        for path in LESSONS
        for each in spoiled_predictions(nbformat.read(path, as_version=4).cells)
    }
    assert ALLOWED.keys() <= found


def lesson_with(heading="Numbers", text="Here they are.", question="how many there are", output=""):
    """The cells of a small lesson whose prediction has the answer 34 edges, told by none of the defaults."""
    cells = [
        nbformat.v4.new_markdown_cell(f"# Lesson\n\n**Time** about 34 edges.\n\n## 1 · {heading}\n\n{text}"),
        nbformat.v4.new_code_cell("x", outputs=[nbformat.v4.new_output("stream", text=output)]),
        nbformat.v4.new_markdown_cell(f"**Predict** {question}."),
        nbformat.v4.new_code_cell("guess = None", id="predict-small-1"),
    ]
    return cells


def with_answer(cells, answer):
    text = f"No guess yet. The result is {answer}."
    result = nbformat.v4.new_output("execute_result", data={"text/plain": text})
    return [*cells, nbformat.v4.new_code_cell("compare_guess(guess, x)", outputs=[result])]


@pytest.mark.parametrize(
    ("cells", "answer"),
    [
        (lesson_with(text="We find 34 edges here."), "34 edges"),
        (lesson_with(output="in all: 1,234"), "1234"),
        (lesson_with(output="shape (2, 4)"), "(2, 4)"),
        (lesson_with(heading="A subscription that receives nothing"), "0"),
        (lesson_with(heading="The median wins"), "median"),
        (lesson_with(text="So the median removes impulse noise best.", question="what is best for impulse noise"), "median"),
        (lesson_with(text="There are three wrong edges.", question="how many edges are wrong"), "3"),
    ],
)  # fmt: skip
def test_an_answer_that_stands_above_is_found(cells, answer):
    (spoiled,) = spoiled_predictions(with_answer(cells, answer))
    assert (spoiled.prediction, spoiled.answer) == ("predict-small-1", answer)


@pytest.mark.parametrize(
    ("cells", "answer"),
    [
        (lesson_with(text="34 cats, 134 edges, 34.5 edges and 34 edges/s"), "34 edges"),
        (lesson_with(), "34 edges"),
        (lesson_with(question="whether there are 34 edges"), "34 edges"),
        (lesson_with(text="The median is a filter.", question="what is best for impulse noise"), "median"),
        (lesson_with(text="There are three dogs.", question="how many edges are wrong"), "3"),
        (lesson_with(heading="Yes"), "yes"),
    ],
)
def test_other_numbers_and_words_are_not(cells, answer):
    assert spoiled_predictions(with_answer(cells, answer)) == []
