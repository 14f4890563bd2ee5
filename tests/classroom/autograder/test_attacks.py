"""Every attack gains nothing, is reported by its name, and harms nobody."""

import pytest
from attacks import ATTACKS, grade_attacks

# All are graded in one fixture; what is out of time is run twice.
pytestmark = [pytest.mark.sandbox, pytest.mark.timeout(900)]


@pytest.fixture(scope="module")
def results(key):
    return grade_attacks(key)


@pytest.mark.parametrize("attack", ATTACKS, ids=[attack.name for attack in ATTACKS])
def test_an_attack_gains_nothing_is_reported_and_harms_nobody(results, attack):
    result, exercise = results[attack.name], results[attack.name].exercise
    assert exercise.points == 0
    assert {case.outcome for case in exercise.cases} <= attack.outcomes
    public, hidden = exercise.cases
    assert attack.reported in public.message
    assert not attack.unreported or attack.unreported not in public.message
    assert "seen" not in hidden.message.lower()
    assert result.harmed == ()
    assert result.alone.points == 10
