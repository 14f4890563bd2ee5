"""Every attack gains nothing, is reported by its name, and harms nobody."""

import pytest
from attacks import ATTACKS, grade_attacks

# All are graded in one fixture; what is out of time is run twice.
pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("attacks"), pytest.mark.timeout(900)]
# Some of each kind: tests/benchmarks/bench_attacks.py grades all of them.
SAMPLE = [attack for attack in ATTACKS if not attack.slow][::8]
TITLES = [attack.title for attack in SAMPLE]


@pytest.fixture(scope="module")
def results(key):
    """{title: AttackResult}."""
    return {result.attack.title: result for result in grade_attacks(key, SAMPLE, workers=2)}


@pytest.mark.parametrize("attack", SAMPLE, ids=TITLES)
def test_an_attack_gains_nothing(results, attack):
    exercise = results[attack.title].exercise
    assert exercise.points == 0
    assert {case.outcome for case in exercise.cases} <= attack.outcomes


@pytest.mark.parametrize("attack", SAMPLE, ids=TITLES)
def test_an_attack_reports_what_it_saw_and_no_more(results, attack):
    public, hidden = results[attack.title].exercise.cases
    assert attack.reported in public.message
    assert not attack.unreported or attack.unreported not in public.message
    assert "seen" not in hidden.message.lower()


@pytest.mark.parametrize("attack", SAMPLE, ids=TITLES)
def test_an_attack_costs_its_other_exercise_and_the_next_submission_nothing(results, attack):
    result = results[attack.title]
    assert result.harmed == ()
    assert result.alone.points == result.alone.max_points == 10


def test_there_are_as_many_attacks_as_were_promised():
    assert len({attack.title for attack in ATTACKS}) == len(ATTACKS) >= 120  # besides those on the form
