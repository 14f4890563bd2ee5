"""Every attack gains nothing, is reported by its name, and harms nobody."""

import pytest
from attacks import ATTACKS, grade_attacks

# All attacks are graded in one fixture; what is out of time is run twice.
pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("attacks"), pytest.mark.timeout(900)]
QUICK = [attack for attack in ATTACKS if not attack.slow]  # the benchmark grades the others too
TITLES = [attack.title for attack in QUICK]


@pytest.fixture(scope="module")
def results(key):
    """{title: AttackResult}."""
    return {result.attack.title: result for result in grade_attacks(key, QUICK, workers=2)}


@pytest.mark.parametrize("attack", QUICK, ids=TITLES)
def test_an_attack_gains_nothing(results, attack):
    exercise = results[attack.title].exercise
    assert exercise.points == 0
    assert {case.outcome for case in exercise.cases} <= attack.outcomes


@pytest.mark.parametrize("attack", QUICK, ids=TITLES)
def test_an_attack_reports_what_it_saw_and_no_more(results, attack):
    public, hidden = results[attack.title].exercise.cases
    assert attack.reported in public.message
    assert not attack.unreported or attack.unreported not in public.message
    assert hidden.failed_call is None
    assert "seen" not in hidden.message.lower()


@pytest.mark.parametrize("attack", QUICK, ids=TITLES)
def test_an_attack_costs_its_other_exercise_and_the_next_submission_nothing(results, attack):
    result = results[attack.title]
    assert result.harmed == ()
    assert result.alone.points == result.alone.max_points == 10


def test_there_are_as_many_attacks_as_were_promised():
    assert len(QUICK) >= 120  # besides those on the form of a submission
    assert len(set(TITLES)) == len(TITLES)
