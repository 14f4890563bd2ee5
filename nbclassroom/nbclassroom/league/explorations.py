"""Drives of the league: a controller explores a room that nobody has seen, in a process of its own.

The robot and its score are in this process, the controller in a kernel of the sandbox, as in grading. What
it says that it found comes out of the kernel. Anybody may have forged it: it is only compared.
"""

import atexit
import os
import signal
from dataclasses import dataclass
from types import SimpleNamespace

from nbclassroom import course
from nbclassroom.autograder.nbval_plugin import ExerciseRun
from nbclassroom.autograder.outcomes import Outcome
from nbclassroom.autograder.page_kernels import PageKernels
from nbclassroom.autograder.results import checked_exercise
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.autograder.sandbox.inside import confine
from nbclassroom.autograder.verdict import CaseRun
from nbclassroom.exercises.kinds.drive.drive import SENSORS, environment
from nbclassroom.exercises.kinds.drive.images import draw_film, draw_map
from nbclassroom.exercises.lesson import Case, Exercise, ExpectedCall
from nbclassroom.exercises.page import page_of

FUNCTION = "control"
_CASE = "room"
_CHECK = f"from nbclassroom.autograder.sandbox.inside.drive_cell import explore\n\nexplore({FUNCTION})"
_factories: list[KernelFactory] = []  # this process's KernelFactory


@dataclass(frozen=True)
class Exploration:
    outcome: Outcome  # it passes if the robot drove to the end
    message: str  # why it did not, with texts of the learner's
    values: dict  # what `course.league_score` gives; {} if the robot did not drive to the end
    told: bool  # whether the controller said what it found
    record: dict | None  # of the drive, see `drive.Drive.record`; None if there was none


def scenario_of(room, seed):
    """The scenario of a room's number, with a seed."""
    return course.load(course.league_scenario)(room, seed) | {"title": "", "thresholds": {}}


def start(unsafe):
    """Get this process ready for `explore`; it ends with the one that started it."""
    confine.die_with_parent()
    signal.signal(signal.SIGINT, lambda *_: os._exit(1))  # Ctrl-C: no drive is waited for
    _factories.append(KernelFactory(unsafe=unsafe))
    atexit.register(_factories[0].__exit__)


def explore(source, scenario):
    """The Exploration of a controller, by its source."""
    exercise = _exercise(scenario)
    page = page_of({exercise.id: source}, SimpleNamespace(exercises=[exercise]))
    exercise_run = ExerciseRun(exercise, PageKernels(page, _factories[0]))
    try:
        run = exercise_run.run(exercise.cases[0], _CHECK)
    finally:
        exercise_run.close()
    is_whole = run.verdict.passed
    exercise_run.passed |= {_CASE} if is_whole else set()
    found = _found(run) if is_whole else None
    values = course.load(course.league_score)(environment(SENSORS), found) if is_whole else {}
    (case,) = checked_exercise(exercise, exercise_run)[0].cases
    record = getattr(run.verdict, "record", None)
    return Exploration(case.outcome, case.message, values, found is not None, record)


def draw(record, scenario, *, with_film):
    """(the map of a drive, its film or None) as AnswerImages."""
    film = draw_film(environment(()), record, scenario) if with_film else None
    return draw_map(record, scenario), film


def _exercise(scenario):
    case = Case(_CASE, "", 1, "", 0.0, calls=(ExpectedCall((scenario,)),))
    return Exercise(
        id="league",
        function=FUNCTION,
        subject="drive",
        sensors=SENSORS,
        allowed=(*course.drive_allowed, *course.league_allowed),
        cases=(case,),
    )


def _found(run: CaseRun) -> dict | None:
    """What a controller says that it found, as `course.league_score` takes it; None if it says nothing."""
    try:
        (told,) = run.told
        markers = {int(number): (x, y) for number, x, y in told["markers"]}
        return {"markers": markers, "word": told["word"]}
    except (TypeError, ValueError, LookupError, OverflowError):
        return None
