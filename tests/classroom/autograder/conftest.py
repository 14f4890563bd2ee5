"""A key of a small lesson that the tests attack, made once per session."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from attacks import LESSON, MASTERS, RIGHT, SEED, SHORT
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import autograde


@pytest.fixture(scope="session")
def key(tmp_path_factory):
    return make_key(MASTERS, SEED, tmp_path_factory.mktemp("key") / "key")


@pytest.fixture(scope="session")
def right():
    """The right answers of the attacked lesson."""
    return dict(RIGHT)


@pytest.fixture
def grade(key, right):
    """Grade one answer to `double` (the other answer is right); returns its GradedExercise."""

    def graded(source, *, exercise="attacked-double", **options):
        answers = right | {exercise: source}
        options = {"workers": 1, "limits": SHORT} | options
        (result,) = autograde([("one", LESSON, answers)], key, **options)
        return next(graded for graded in result.exercises if graded.id == exercise)

    return graded
