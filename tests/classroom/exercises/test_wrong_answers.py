"""What `check` says to recorded wrong answers: the sentence that a good teacher would say, and no points."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from all_masters import all_exercises
from answer_feedback import feedback_on
from nbclassroom.exercises import MasterError
from nbclassroom.exercises.checking import run_cases
from nbclassroom.exercises.names_read import NamesRead
from wrong_answers import FOLDER, read_wrong_answers

FILES = sorted(FOLDER.glob("*.py"))
MOST = 5

each_file = pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)


def passes(exercise, answer):
    """Whether an answer earns all points."""
    if answer.kind == "too-slow":  # an endless loop takes any time limit
        exercise = replace(exercise, time_limit=1.0)
    try:
        function = exercise.function_of(answer.source, answer.name)
    except MasterError:  # the cell does not run
        return False
    if NamesRead(function).refused(exercise.allowed, set(exercise.provided)):
        return False
    return all(run_cases(exercise, function, cases=[case]).passed for case in exercise.cases)


def is_named(exercise, answer):
    """Whether `check` names what is wrong, if need be by the search for one change, which takes a second."""
    return any(answer.is_named_by(feedback_on(exercise, answer, searches=way)[1]) for way in (False, True))


def test_every_exercise_has_its_answers_and_few():
    functions = {id for id, exercise in all_exercises().items() if exercise.subject == "function"}
    assert {path.stem for path in FILES} == functions
    for path in FILES:
        answers = read_wrong_answers(path)
        assert 0 < len({answer.name for answer in answers}) == len(answers) <= MOST, path.name
        assert [one.name for one in answers if not one.is_named_by(one.sentence)] == [], path.name


@each_file
def test_no_wrong_answer_earns_all_points_and_check_names_the_mistake(path):
    exercise, answers = all_exercises()[path.stem], read_wrong_answers(path)
    assert [answer.name for answer in answers if passes(exercise, answer) != answer.passes] == []
    assert [answer.name for answer in answers if not is_named(exercise, answer)] == []
