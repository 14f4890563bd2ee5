"""What is particular about controllers, `control(observation, memory)`."""

import json
import re
from dataclasses import replace
from functools import lru_cache

import numpy as np

from .... import course
from ...canonical import array_of
from ..kind import Kind as AnyKind
from .drive import (
    COUNTS,
    METRICS,
    PATH_TOLERANCE,
    PLACE_PERIOD,
    SENSORS,
    SLOW,
    STEP,
    metric_text,
    question_of,
    seconds_of,
    sentences_of,
    steps_of,
)

_CHECK = "from nbclassroom.autograder.sandbox.inside.drive_cell import drive\n\ndrive({function})"
_SECONDS_PER_DRIVE = 1.5  # of the solution or a mistake, while a key is made, two exercises at a time


class Kind(AnyKind):
    """A controller, which thresholds judge, never values."""

    name = "drive"
    kernel_modules = ("drive",)
    sensors = SENSORS
    expects_values = shares_kernel = False
    shows_last_prints = True
    not_attempted = "not attempted yet; the function drives as you got it"

    def modules(self):
        return course.drive_allowed

    def tolerance(self, declared):
        return PATH_TOLERANCE

    def checked_inputs(self, case, calls, place):
        """One scenario, read and checked."""
        # Here, because the kernels that grade import this module too.
        from ...percent_script import MasterError
        from .scenario import read_scenario

        if len(calls) != 1 or len(calls[0]) != 1 or not isinstance(calls[0][0], dict):
            text = "inputs(rng) of a drive returns one scenario, a dict: return (scenario,)"
            raise MasterError(f"{place}: {text}")
        try:
            return [(read_scenario({"title": case.title} | calls[0][0]),)]
        except ValueError as error:
            raise MasterError(f"{place}: {error}") from error

    def seconds_of(self, exercise, case):
        return seconds_of(scenario_of(case))

    def simulated_seconds(self, exercise):
        return STEP * sum(steps_of(scenario_of(case)) for case in exercise.cases)

    # ---------------------------------------------------------------- running

    def check_source(self, exercise):
        return _CHECK.format(function=exercise.function)

    def partner(self, exercise, case):
        from .graded import GradedDrive

        return GradedDrive(exercise, scenario_of(case))

    def progress(self, exercise):
        from ...progress_bar import progress_bar

        return progress_bar(f"Driving {len(exercise.cases)} scenarios")

    def run_cases(self, exercise, answer, progress=None):
        """Each drive with values of its own."""
        from ...names_read import with_own_globals
        from .runs import drive_scenarios

        scenarios = list(map(scenario_of, exercise.cases))
        return _judged(
            exercise, drive_scenarios(exercise, scenarios, lambda: with_own_globals(answer), progress)
        )

    def run_mistake(self, exercise, mistake):
        """It does not drive again."""
        return _judged(exercise, _drives_of_mistake(exercise, mistake, exercise.cases))

    def results_of_mistake(self, exercise, mistake, cases, case_id):
        drives = _drives_of_mistake(exercise, mistake, cases)
        return {case.id: (result,) for case, (_, result) in zip(cases, drives, strict=True)}

    def draw_for_key(self, exercise, seed, run_solution):
        from .draw_scenarios import draw_for_key

        return draw_for_key(exercise, seed, run_solution)

    def seconds_for_key(self, exercise):
        from .draw_scenarios import number_of_drives

        return _SECONDS_PER_DRIVE * number_of_drives(exercise)

    # ---------------------------------------------------------------- judging and explaining

    def known_mistake(self, exercise, calls):
        """One that drives as a learner's `control` does in each scenario in which that fails.

        It misses the same thresholds, and its path stays within PATH_TOLERANCE of the learner's until a
        second after the decisive moment. If several do, the nearest one counts.
        """
        failed = [call for call in calls if not call.passed]
        if all(np.ptp(call.record["path"], axis=0).max() < 0.02 for call in failed):
            return None  # it stands, and so is near to a robot that turns on the spot
        nearest, least = None, np.inf
        for mistake in exercise.mistakes:
            driven = [call for call in failed if call.case.id in mistake.results]  # a key: only hidden ones
            distance = max((_distance(mistake, call) for call in driven), default=np.inf)
            nearest, least = (mistake, distance) if distance < least else (nearest, least)
        return nearest if least <= PATH_TOLERANCE else None

    def explain(self, exercise, call):
        return "\n".join(sentences_of(call.record, *call.arguments))

    def explains_enough(self, call):
        return bool(call.record["ended"] or question_of(call.record))

    def common_failure(self, exercise, calls):
        """With the numbers of the first drive."""
        if len(calls) < 2 or not all(call.record["ended"] for call in calls):
            return ""
        texts = [self.explain(exercise, call) for call in calls]
        return texts[0] if len({re.sub(r"[0-9]+", "", text) for text in texts}) == 1 else ""

    def images_of(self, exercise, call):
        """What the camera saw before the decisive moment."""
        from .drive import environment
        from .images import look_back

        has_moment = call.record["decisive"] and not call.record["ended"]
        return look_back(environment(()), call.record, *call.arguments) if has_moment else ()

    def images_of_all(self, calls):
        """A map of each drive."""
        from .images import draw_map

        return [draw_map(call.record, *call.arguments) for call in calls]

    def table_of(self, calls):
        """The metrics that have a threshold; those that are missed are marked."""
        thresholds = [call.arguments[0]["thresholds"] for call in calls]
        metrics = [name for name in METRICS if any(name in own for own in thresholds)]
        head = ("scenario", *(METRICS[name].title for name in metrics), "points")
        rows = [[(text, False) for text in head]]
        for call, own in zip(calls, thresholds, strict=True):
            cells = [(f"{'✓' if call.passed else '✗'} {call.arguments[0]['title']}", False)]
            missed = {name for name, *_ in call.record["missed"]}
            for name in metrics:
                operator, limit = own.get(name, ("", None))
                asked = f" ({COUNTS[operator][0]} {metric_text(name, limit)})" if operator else ""
                text = metric_text(name, call.record["metrics"][name], limit)
                cells.append((text + asked, name in missed))
            points = call.case.points
            rows.append([*cells, (f"{points if call.passed else 0} of {points}", False)])
        return rows if calls else ()


def _distance(mistake, call):
    """How far the paths of a mistake and of a drive part, metres; infinite if they fail in other ways."""
    (predicted,) = mistake.results[call.case.id]
    if not (predicted.finished and call.result.finished):
        return np.inf
    end = (call.record["decisive"] + round(1 / STEP)) // PLACE_PERIOD + 1
    ((_, missed), (_, path)), ((_, own_missed), (_, own_path)) = (
        result.value["items"] for result in (predicted, call.result)
    )
    path, own_path = array_of(path), array_of(own_path)
    if path is None or own_path is None or missed != own_missed or path[:end].shape != own_path[:end].shape:
        return np.inf
    return float(np.abs(path[:end] - own_path[:end]).max())


def scenario_of(case):
    """What a case lets a controller drive through, a dict."""
    ((scenario,),) = (call.arguments for call in case.calls)
    return scenario


def _judged(exercise, drives):
    """Drives (record, CallResult), one for each case, as a list of CaseCall."""
    from .graded import case_call

    return [case_call(case, *drive) for case, drive in zip(exercise.cases, drives, strict=True)]


def _drives_of_mistake(exercise, mistake, cases):
    """What a declared mistake drove: (record, CallResult) of each case; it drives once."""
    same = replace(exercise, cases=(), mistakes=(), names=(), provided=())  # before and after it has run
    return _drive_mistake(same, mistake, json.dumps(list(map(scenario_of, cases))))


@lru_cache(maxsize=1024)
def _drive_mistake(exercise, mistake, scenarios):
    from ...percent_script import MasterError
    from .runs import drive_scenarios

    drives = drive_scenarios(exercise, json.loads(scenarios), lambda: exercise.function_of_mistake(mistake))
    if any(SLOW in record["ended"] or result.timed_out for record, result in drives):
        raise MasterError(f"{exercise.id}: mistake {mistake.name!r} was too slow; build on an idle machine")
    return drives
