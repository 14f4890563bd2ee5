"""Draw the scenarios of a driving exercise for a key: those that tell a right controller from a wrong one.

The solution must pass with a margin, else chance could cost a good answer its points; and in a hidden
scenario the stub must fail, and so must what the solution drives in a public one, repeated. A mistake may
pass there: every mistake fails a public scenario, and what drives well has earned its points. In public
scenarios they do not drive for a key: the lesson has drives of them.
"""

import itertools
from collections import namedtuple
from dataclasses import replace

from nbclassroom.exercises.declaration import MasterError
from nbclassroom.exercises.kinds.drive.drive import LARGE, SLOW, passes, sentences_of
from nbclassroom.exercises.kinds.drive.graded import GradedDrive
from nbclassroom.exercises.kinds.drive.runs import drive_scenarios
from nbclassroom.exercises.lesson import ExpectedCall
from nbclassroom.exercises.names_read import with_own_globals

MOST_DRAWS = 20  # of one case
MARGIN = 0.2  # by which the solution keeps each threshold, as a share of it

# A scenario that fits, the solution's record of it, and {mistake: CallResult of its drive}.
DrawnScenario = namedtuple("DrawnScenario", ("scenario", "record", "mistakes"))


def draw_for_key(exercise, seed, run_solution):
    """As `Kind.draw_for_key`; `run_solution` gives the verdict of a GradedDrive."""

    def drive_solution(scenario):
        return run_solution(GradedDrive(exercise, scenario)).record

    drawn, public = {}, public_drives(exercise)
    for case in exercise.cases:
        one = draw_scenario(exercise, case, seed, drive_solution, public)
        mistakes = {name: [result] for name, result in one.mistakes.items()}
        drawn[case.id] = [ExpectedCall((one.scenario,))], mistakes
    return drawn


def number_of_drives(exercise):
    """How many drives a key needs, if the first draw of each case fits."""
    hidden = len(exercise.cases) - len(exercise.public)
    return len(exercise.cases) + hidden * (1 + len(exercise.mistakes))


def draw_scenario(exercise, case, seed, drive_solution, public):
    """The first DrawnScenario of a case's draws that fits.

    `drive_solution` gives a scenario's record; `public` are `public_drives`.
    MasterError: no draw fits; it says why.
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
        record = drive_solution(stricter)
        if not passes(record, stricter):
            sentences = " ".join(sentences_of(record, stricter)).rstrip(".")
            problem = f"the solution does not pass with a margin of {MARGIN:.0%}: {sentences}"
            continue
        drives = drive_wrong_answers(exercise, scenario) if case.hidden else {}
        if not drives or not passes(drives[""][0], scenario):
            return DrawnScenario(scenario, record, {name: result for name, (_, result) in drives.items()})
        problem = "the stub passes"
    raise MasterError(
        f"{exercise.master.name}, line {case.line}: {case.id}: none of {MOST_DRAWS} drawn scenarios fits;"
        f" in the last one {problem}. Change inputs(rng), the thresholds, or one of the controllers"
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


def drive_wrong_answers(exercise, scenario):
    """{mistake, or "" for the stub: (record, CallResult)} in a scenario. MasterError: one costs too much."""
    controls = {mistake.name: exercise.function_of_mistake(mistake) for mistake in exercise.mistakes}
    controls[""] = exercise.function_of(exercise.stub, "stub")  # last: one that is slow ends all others
    waiting = iter(controls.values())
    drives = drive_scenarios(exercise, [scenario] * len(controls), lambda: next(waiting))
    for name, (record, result) in zip(controls, drives, strict=True):
        if result.timed_out or record["ended"].endswith((SLOW, LARGE)):
            name = f"mistake {name!r}" if name else "the stub"
            raise MasterError(f"{exercise.id}: {name}: {record['ended']}; make the key on an idle machine")
    return dict(zip(controls, drives, strict=True))


def with_margin(scenario):
    """The scenario with stricter thresholds."""
    thresholds = {
        name: [operator, limit + (MARGIN if operator == ">=" else -MARGIN) * abs(limit)]
        for name, (operator, limit) in scenario["thresholds"].items()
    }
    return scenario | {"thresholds": thresholds}
