"""What is particular about controllers, `control(observation, memory)`."""

import re

from .... import course
from ..kind import Kind as AnyKind
from .drive import COUNTS, METRICS, SENSORS, STEP, metric_text, seconds_of, steps_of
from .sentences import CLEAR, behaviours, drives_alike, sentences_of

_CHECK = "from nbclassroom.autograder.sandbox.inside.drive_cell import drive\n\ndrive({function})"
_SECONDS_PER_DRIVE = 1.5  # while a key is made, two exercises at a time


class Kind(AnyKind):
    """A controller, which thresholds judge, never values."""

    name = "drive"
    kernel_modules = ("drive", "sentences")
    sensors = SENSORS
    expects_values = shares_kernel = False
    shows_last_prints = explains_enough = True
    not_attempted = "not attempted yet; the function drives as you got it"

    def modules(self):
        return course.drive_allowed

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

    def check_source(self, exercise):
        return _CHECK.format(function=exercise.function)

    def partner(self, exercise, case):
        from .graded import GradedDrive

        return GradedDrive(exercise, scenario_of(case))

    def run_cases(self, exercise, answer):
        """Each drive with values of its own."""
        from .graded import case_call
        from .runs import drive_scenarios, with_own_globals

        scenarios = list(map(scenario_of, exercise.cases))
        drives = drive_scenarios(exercise, scenarios, lambda: with_own_globals(answer))
        return [case_call(case, *drive) for case, drive in zip(exercise.cases, drives, strict=True)]

    def draw_for_key(self, exercise, seed, run_solution):
        from .draw_scenarios import draw_for_key

        return draw_for_key(exercise, seed, run_solution)

    def seconds_for_key(self, exercise):
        """If the first draw of each case fits: two drives in a hidden one, the second one of the stub."""
        return _SECONDS_PER_DRIVE * (len(exercise.cases) + len(exercise.hidden))

    def known_mistake(self, exercise, calls):
        """The first one named like a behaviour of the first drive that fails, or a clear one of any drive."""
        drives = [
            (call.record, *call.arguments) for call in calls if not call.passed and call.result.finished
        ]
        if not drives:
            return None
        alike = ["it drives the same way"] * drives_alike([call.record for call in calls])
        shown = [behaviours(*drive) for drive in drives]
        clear = [name for name in CLEAR if any(name in names for names in shown)]
        names = [*shown[0], *alike, *clear]
        return next((mistake for mistake in exercise.mistakes if mistake.name in names), None)

    def explain(self, exercise, call):
        return "\n".join(sentences_of(call.record, *call.arguments))

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

    def blocks_of_all(self, calls):
        """A table of the metrics that have a threshold, with marks on those that are missed; and maps."""
        from ...document import Figures, Table
        from ...source_remarks import SAYS

        if calls:
            yield Table(_rows(calls), has_head=True)
            yield Figures(lambda: _maps(calls), SAYS["map of a drive"])


def _rows(calls):
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
    return rows


def _maps(calls):
    from .images import draw_map

    return [draw_map(call.record, *call.arguments) for call in calls]


def scenario_of(case):
    """What a case lets a controller drive through, a dict."""
    ((scenario,),) = (call.arguments for call in case.calls)
    return scenario
