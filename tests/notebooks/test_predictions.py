"""No prediction whose answer a learner has read before, save those with a reason."""

import sys
from pathlib import Path

import nbformat
import pytest

sys.path.append(str(Path(__file__).parent))
from nbclassroom.authoring.masters import find_lessons
from spoiled_predictions import spoiled_predictions

LESSONS = find_lessons(Path(__file__).parents[2] / "notebooks")

CHOICE = "the question itself names it, beside other answers"
CHANCE = "the same number or word with another meaning"
SHAPE = "the shape above is the one before; the question is whether it changes"
ALLOWED = {
    "predict-start_here-1": CHOICE,
    "predict-arrays-4": SHAPE,
    "predict-arrays-5": "255 is known as the largest uint8; that 0 - 1 becomes 255 is not",
    "predict-arrays-7": CHOICE,
    "predict-arrays-8": "another question about the same small array had this number",
    "predict-images_as_messages-4": "the padding bytes are shown; the question is where one of them goes",
    "predict-grayscale-4": "the last two numbers of a longer shape",
    "predict-noise_removal-9": "one of the four filters that the question names",
    "predict-binarization-3": CHOICE,
    "predict-canny_stages-6": CHANCE,
    "predict-drive_the_robot-2": CHANCE,
    "predict-where_am_i-4": CHANCE,
    "predict-mapping_and_slam-5": CHANCE,
    "predict-faces-6": "how many of 30: the answer is all",
    "predict-the_errand-3": "one of the directions that the table above shows",
    "predict-reading_text-7": CHANCE,
}


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in LESSONS])
def test_no_answer_stands_above_its_prediction(path):
    spoiled = spoiled_predictions(nbformat.read(path, as_version=4).cells)
    unexpected = [str(one) for one in spoiled if one.prediction not in ALLOWED]
    assert unexpected == []
