"""Every attack gains nothing, is told by its name, and harms nobody."""

import pytest
from attacks import ATTACKS, judge_attacks

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("attacks")]
NAMES = [each.title for each in ATTACKS]


@pytest.fixture(scope="module")
def attacked(key):
    """What each attack came to."""
    return {each.attack.title: each for each in judge_attacks(key, workers=2)}


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_gains_nothing(attacked, attack):
    found = attacked[attack.title].exercise
    assert found["got"] == 0
    assert {case["outcome"] for case in found["cases"]} <= attack.outcomes


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_tells_what_it_found_and_no_more(attacked, attack):
    public, hidden = attacked[attack.title].exercise["cases"]
    assert attack.told in public["said"]
    assert not attack.silent or attack.silent not in public["said"]
    assert not {"given", "expected", "actual", "printed"} & hidden.keys()
    assert "seen" not in hidden["said"].lower()


@pytest.mark.parametrize("attack", ATTACKS, ids=NAMES)
def test_an_attack_costs_its_other_exercise_and_the_next_submission_nothing(attacked, attack):
    found = attacked[attack.title]
    assert found.harmed == ()
    assert found.alone["got"] == found.alone["points"] == 10


def test_there_are_as_many_attacks_as_were_promised():
    assert len(ATTACKS) >= 95  # and those of form, where submissions are taken in
    assert len(set(NAMES)) == len(NAMES)
