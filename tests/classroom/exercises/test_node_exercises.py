"""The node exercises of the lessons: verdicts and sentences on many answers."""

from pathlib import Path

import pytest
from node_answers import ANSWERS

from imgproc_course.classroom.exercises.checking import run_check
from imgproc_course.classroom.exercises.declaration import read_exercises
from imgproc_course.classroom.exercises.expected_results import check_data_of

MASTERS = Path(__file__).parents[3] / "notebooks/masters"
EXERCISES = {
    exercise.id: exercise
    for lesson in ("05_grayscale_node", "09_edge_detection_node")
    for exercise in read_exercises(MASTERS / f"{lesson}.py")
}


def result_of(answer):
    """The CheckResult of an answer on all cases, with those that only grading runs."""
    exercise = EXERCISES[answer.exercise]
    data = check_data_of(exercise, exercise.cases)
    names, error = data.run_answer(answer.source, exercise.function)
    assert not error
    return run_check(data, names[exercise.function])


@pytest.mark.parametrize("answer", ANSWERS, ids=[f"{a.exercise}: {a.name}" for a in ANSWERS])
def test_an_answer_passes_its_cases_and_is_told_why_not_the_others(answer):
    result = result_of(answer)
    passes = "".join(
        case.case.id.split("-")[-1] if not case.case.hidden else "h" for case in result.results if case.passed
    )
    text = " ".join(str(result).split())
    assert (passes, answer.says in text) == (answer.passes, True), str(result)
    assert "a dict" not in text and "In answer[" not in text
