"""Draw the scenarios of a driving exercise for a key: those that tell a right controller from a wrong one.

The solution must pass with a margin, else chance could cost a good answer its points; and in a hidden
scenario stub and mistakes must fail, and so must what the solution drives in a public one, repeated.
"""

import itertools
from collections import namedtuple

from tqdm import tqdm

from nbclassroom.exercises.declaration import MasterError
from nbclassroom.exercises.kinds.drive.drive import Drive, passes, sentences_of, speeds_of
from nbclassroom.exercises.kinds.drive.graded import GradedDrive, environment
from nbclassroom.exercises.kinds.drive.simulators import form_of
from nbclassroom.exercises.lesson import ExpectedCall
from nbclassroom.exercises.running import CallResult, failure_fields

MOST_DRAWS = 20  # of one case
MARGIN = 0.2  # by which the solution keeps each threshold, as a share of it


# A scenario that fits, the solution's record of it, and {mistake: CallResult of its drive}.
DrawnScenario = namedtuple("DrawnScenario", ("scenario", "record", "mistakes"))


def draw_for_key(exercise, seed, run_solution):
    """As `Kind.draw_for_key`; `run_solution` gives the verdict of a GradedDrive."""

    def drive_solution(scenario):
        return run_solution(GradedDrive(exercise.sensors, scenario)).record

    drawn, least = {}, len(exercise.cases) * (1 + len(exercise.mistakes))
    with tqdm(total=least, desc=exercise.id, unit=" drives", delay=2, leave=False) as bar:
        public = list(public_drives(exercise))
        for case in exercise.cases:
            one = draw_scenario(exercise, case, seed, drive_solution, public, bar.update)
            mistakes = {name: [result] for name, result in one.mistakes.items()}
            drawn[case.id] = [ExpectedCall((one.scenario,))], mistakes
    return drawn


def draw_scenario(exercise, case, seed, drive_solution, public=(), on_drive=lambda: None):
    """The first DrawnScenario of a case's draws that fits.

    `drive_solution` gives a scenario's record; `public` are `public_drives`; `on_drive` follows each drive.
    MasterError: no draw fits; it says why.
    """
    tried, problem, stub = [], "", exercise.function_of(exercise.stub, "stub")
    for ((scenario,),) in itertools.islice(exercise.draws(case, seed), MOST_DRAWS):
        if scenario in tried:  # perhaps it does not depend on the seed
            continue
        tried.append(scenario)
        if case.hidden and is_passed_by_repeating(public, scenario):
            problem = "a drive of the solution in a public scenario, repeated without looking, passes"
            continue
        stricter = with_margin(scenario)
        mistakes: dict[str, CallResult] = {}
        record = drive_solution(stricter)
        on_drive()
        problem = _problem_of_solution(record, stricter)
        if not problem and case.hidden and passes(drive_here(stub, exercise.sensors, scenario)[0], scenario):
            problem = "the stub passes"
        while not problem and len(mistakes) < len(exercise.mistakes):
            mistake = exercise.mistakes[len(mistakes)]
            mistakes[mistake.name], has_passed = _drive_mistake(exercise, mistake, scenario)
            problem = f"the mistake {mistake.name!r} passes" if has_passed and case.hidden else ""
            on_drive()
        if not problem:
            return DrawnScenario(scenario, record, mistakes)
    raise MasterError(
        f"{exercise.master.name}, line {case.line}: {case.id}: none of {MOST_DRAWS} drawn scenarios fits;"
        f" in the last one {problem}. Change inputs(rng), the thresholds, or one of the controllers"
    )


def public_drives(exercise):
    """The actions of the solution in each public scenario that a learner has, one list after the other."""
    solution = exercise.function_of(exercise.solution, "solution")
    for case in exercise.public:
        ((scenario,),) = exercise.arguments(case)
        yield drive_here(solution, exercise.sensors, scenario)[0]["actions"]


def is_passed_by_repeating(drives, scenario):
    """Whether one of these lists of actions, driven without looking, passes a scenario."""
    controllers = [lambda *_, left=left: next(left, (0.0, 0.0)) for left in map(iter, drives)]
    return any(passes(drive_here(control, (), scenario)[0], scenario) for control in controllers)


def with_margin(scenario):
    """The scenario with stricter thresholds."""
    thresholds = {
        name: [operator, limit + (MARGIN if operator == ">=" else -MARGIN) * abs(limit)]
        for name, (operator, limit) in scenario["thresholds"].items()
    }
    return scenario | {"thresholds": thresholds}


def _problem_of_solution(record, scenario):
    """Why the solution does not pass, "" if it does."""
    if passes(record, scenario):
        return ""
    sentences = " ".join(sentences_of(record, scenario)).rstrip(".")
    return f"the solution does not pass with a margin of {MARGIN:.0%}: {sentences}"


def _drive_mistake(exercise, mistake, scenario):
    """What a mistake does in a scenario, as a CallResult, and whether it passes."""
    control = exercise.function_of_mistake(mistake)
    record, failure = drive_here(control, exercise.sensors, scenario)
    return CallResult(**failure or {"value": form_of(record)}), passes(record, scenario)


def drive_here(control, sensors, scenario):
    """The record of a drive of the course's own controller, in this process; and how a call failed, or {}."""
    drive = Drive(environment(tuple(sensors)), scenario)
    memory: dict = {}
    while not drive.over:
        try:
            speeds = speeds_of(control(drive.observation, memory))
        except Exception as error:  # noqa: BLE001 - a mistake may be to raise anything
            drive.stop(f"{type(error).__name__}: {error}")
            return drive.record(), failure_fields(error, control)
        drive.act(speeds)
    return drive.record(), {}
