"""Every attack gains nothing, is told by its name, and harms nobody."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from attacks import ATTACKS
from conftest import SHORT

from imgproc_course.grading.judge import judge

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("attacks")]
NAMES = [f"{each.number}: {each.name}" for each in ATTACKS]


@pytest.fixture(scope="module")
def results(key, right):
    """Every attack, each followed by an honest submission; and the honest one graded alone."""
    honest = dict(right)
    handed = [("alone", "10_attacked", honest)]
    for name, each in zip(NAMES, ATTACKS, strict=True):
        handed.append((name, "10_attacked", right | {"attacked-double": each.source}))
        handed.append((f"after {name}", "10_attacked", honest))
    return {result["submission"]: result for result in judge(handed, key, workers=2, limits=SHORT)}


def of_submission(result):
    return {name: value for name, value in result.items() if name != "submission"}


def exercise(result, id):
    return next(each for each in result["exercises"] if each["id"] == id)


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_gains_nothing(results, attack):
    attacked = exercise(results[f"{attack.number}: {attack.name}"], "attacked-double")
    assert attacked["got"] == 0
    assert {case["outcome"] for case in attacked["cases"]} <= attack.outcomes


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_tells_what_it_found_and_no_more(results, attack):
    public, hidden = exercise(results[f"{attack.number}: {attack.name}"], "attacked-double")["cases"]
    assert attack.told in public["said"]
    assert not attack.silent or attack.silent not in public["said"]
    assert not {"given", "expected", "actual", "printed"} & hidden.keys()
    assert "seen" not in hidden["said"].lower()


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_costs_its_other_exercise_nothing(results, attack):
    assert exercise(results[f"{attack.number}: {attack.name}"], "attacked-mean")["got"] == 7


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_the_next_submission_is_graded_as_if_alone(results, attack):
    assert of_submission(results[f"after {attack.number}: {attack.name}"]) == of_submission(results["alone"])
    assert results["alone"]["got"] == results["alone"]["points"] == 10


def test_there_are_as_many_attacks_as_were_promised():
    assert len(ATTACKS) >= 75 - 13  # those of form stand with the taking in of submissions
    assert len(set(NAMES)) == len(NAMES)
