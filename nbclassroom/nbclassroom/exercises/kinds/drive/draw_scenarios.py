"""Draw the scenarios of a driving exercise for a key: those that tell a right controller from a wrong one.

The solution must pass with a margin, else chance could cost a good answer its points; and in a hidden
scenario the stub must fail, and so must what the solution drives in a public one, repeated.
"""

import itertools
from dataclasses import replace

from nbclassroom.exercises.declaration import MasterError
from nbclassroom.exercises.kinds.drive.drive import LARGE, SLOW, passes
from nbclassroom.exercises.kinds.drive.graded import GradedDrive
from nbclassroom.exercises.kinds.drive.runs import drive_scenarios, with_own_globals
from nbclassroom.exercises.kinds.drive.sentences import sentences_of
from nbclassroom.exercises.lesson import ExpectedCall

MOST_DRAWS = 20  # of one case
MARGIN = 0.2  # by which the solution keeps each threshold, as a share of it


def draw_for_key(exercise, seed, run_solution):
    """As `Kind.draw_for_key`; `run_solution` gives the record of a GradedDrive."""
    public = public_drives(exercise)
    return {
        case.id: [ExpectedCall((draw_scenario(exercise, case, seed, run_solution, public),))]
        for case in exercise.cases
    }


def draw_scenario(exercise, case, seed, run_solution, public):
    """The first scenario of a case's draws that fits; MasterError says why none does.

    `run_solution` is as in `draw_for_key`; `public` are `public_drives`.
    """
    tried, problem = [], ""
    for ((scenario,),) in itertools.islice(exercise.draws(case, seed), MOST_DRAWS):
        if scenario in tried:  # perhaps it does not depend on the seed
            continue
        tried.append(scenario)
        if case.hidden and is_passed_by_repeating(exercise, public, scenario):
            problem = "a drive of the solution in a public scenario, repeated without looking, passes"
            continue
        stricter = with_margin(scenario)
        record = run_solution(GradedDrive(exercise, stricter))
        if not passes(record, stricter):
            sentences = " ".join(sentences_of(record, stricter)).rstrip(".")
            problem = f"the solution does not pass with a margin of {MARGIN:.0%}: {sentences}"
            continue
        if not (case.hidden and stub_passes(exercise, scenario)):
            return scenario
        problem = "the stub passes"
    raise MasterError(
        f"{exercise.master.name}, line {case.line}: {case.id}: none of {MOST_DRAWS} drawn scenarios fits;"
        f" in the last one {problem}. Change inputs(rng), the thresholds, the solution or the stub"
    )


def public_drives(exercise):
    """The actions of the solution in each public scenario that a learner has, a list of lists."""
    solution = exercise.function_of(exercise.solution, "solution")
    scenarios = [scenario for case in exercise.public for ((scenario,),) in [exercise.arguments(case)]]
    drives = drive_scenarios(exercise, scenarios, lambda: with_own_globals(solution))
    return [record["actions"] for record, _ in drives]


def is_passed_by_repeating(exercise, drives, scenario):
    """Whether one of these lists of actions, driven without looking, passes a scenario."""
    controls = iter([lambda *_, left=left: next(left, (0.0, 0.0)) for left in map(iter, drives)])
    blind = replace(exercise, sensors=())
    results = drive_scenarios(blind, [scenario] * len(drives), lambda: next(controls))
    return any(passes(record, scenario) for record, _ in results)


def stub_passes(exercise, scenario):
    """Whether the stub passes a scenario. MasterError: it costs too much."""
    stub = exercise.function_of(exercise.stub, "stub")
    ((record, result),) = drive_scenarios(exercise, [scenario], lambda: stub)
    if result.timed_out or record["ended"].endswith((SLOW, LARGE)):
        raise MasterError(f"{exercise.id}: the stub: {record['ended']}; make the key on an idle machine")
    return passes(record, scenario)


def with_margin(scenario):
    """The scenario with stricter thresholds."""
    thresholds = {
        name: [operator, limit + (MARGIN if operator == ">=" else -MARGIN) * abs(limit)]
        for name, (operator, limit) in scenario["thresholds"].items()
    }
    return scenario | {"thresholds": thresholds}
