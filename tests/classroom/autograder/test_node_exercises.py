"""Nodes in the sandbox: the verdicts of `check`, and attacks that gain nothing."""

from pathlib import Path

import pytest
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.outcomes import Outcome
from nbclassroom.autograder.pool import autograde, grade_one, nbval_process_of_thread, stop_nbval_processes
from nbclassroom.exercises.page import page_of
from node_answers import ANSWERS
from node_attacks import NODE_ATTACKS

pytestmark = [pytest.mark.sandbox, pytest.mark.timeout(600)]

MASTERS = Path(__file__).parents[3] / "notebooks/masters"
LESSONS = {"node-class": "grayscale_node", "edges-class": "edge_detection_node"}
ATTACKS = {name: outcomes for name, _, outcomes in NODE_ATTACKS}
UNGRADED = "a service"  # the double does not have it
# test_node_exercises.py beside `check` has all of them.
SAMPLE = [
    answer
    for number, answer in enumerate(ANSWERS)
    if answer.exercise in LESSONS and (number % 5 == 0 or answer.name in (UNGRADED, "reliable"))
]


@pytest.fixture(scope="module")
def key(tmp_path_factory):
    return make_key(MASTERS, 8_675_309, tmp_path_factory.mktemp("key") / "key", LESSONS.values())


@pytest.fixture(scope="module")
def exercises(key):
    """{name of an answer or an attack: its GradedExercise}."""
    submissions = [
        (f"{answer.exercise}: {answer.name}", LESSONS[answer.exercise], {answer.exercise: answer.source})
        for answer in SAMPLE
    ]
    submissions += [(name, "grayscale_node", {"node-class": source}) for name, source, _ in NODE_ATTACKS]
    return {
        result.name: next(graded for graded in result.exercises if graded.id in LESSONS)
        for result in autograde(submissions, key, workers=2)
    }


@pytest.mark.parametrize("answer", SAMPLE, ids=[f"{a.exercise}: {a.name}" for a in SAMPLE])
def test_grading_says_what_check_says(answer, exercises):
    exercise = exercises[f"{answer.exercise}: {answer.name}"]
    passes = "".join(
        case.id.split("-")[-1] if not case.hidden else "h" for case in exercise.cases if case.passed
    )
    assert passes == answer.passes
    outcomes = {case.outcome.value for case in exercise.cases if not case.passed}
    assert ("not graded" in outcomes) == (answer.name == UNGRADED)
    messages = [case.message for case in exercise.cases]
    assert not any("a dict" in message or "in answer[" in message for message in messages)


def test_a_message_is_the_sentence_of_check(exercises):
    reliable = exercises["node-class: reliable"].cases
    assert reliable[0].message.startswith("The sensor offers best effort: ROS does not connect a RELIABLE")
    assert reliable[0].message.endswith("(A number in the place of the profile means reliable, too.)")
    assert reliable[-1].hidden and reliable[-1].message == ""
    service = exercises["node-class: a service"].cases[0]
    assert service.message.startswith("This check does not know create_service of a node")


def test_what_the_check_does_not_know_is_graded_once(key):
    source = next(answer.source for answer in ANSWERS if answer.name == UNGRADED)
    page = page_of({"node-class": source}, key.lessons["grayscale_node"])
    process = nbval_process_of_thread(False, None)
    result = grade_one(("a", "grayscale_node", page), key.path, key.digest)
    is_same = nbval_process_of_thread(False, None) is process  # each attempt has a process of its own
    stop_nbval_processes()
    assert "node-class" in result.exercises_with(Outcome.NOT_GRADED)
    assert not result.has_fault and is_same


@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_gains_nothing(name, exercises):
    first, *others = exercises[name].cases
    assert exercises[name].points <= first.max_points and not any(case.passed for case in others)
    assert {case.outcome.value for case in others} <= ATTACKS[name]
