"""Drives in the sandbox, on the plane of `plane_env`, without nbval: for tests and benchmarks."""

import time
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

from nbclassroom.autograder.nbval_plugin import ExerciseRun, PageKernels
from nbclassroom.autograder.results import graded_exercises
from nbclassroom.exercises.lesson import Case, Exercise, ExpectedCall
from nbclassroom.exercises.page import page_of
from plane_env import PlaneEnv, driving_on_a_plane

MASTERS = Path(__file__).parent / "driving/masters"
SCENARIO = {
    "seed": 3,
    "title": "a wall",
    "start": [0.0, 0.0, 0.0],
    "duration": 4.0,
    "thresholds": {"bumps": ["<=", 0], "clearance": [">=", 0.3], "reach": [">=", 0.8]},
}
PUBLIC = Case("case-plane-drive-1", "a wall", 2, "Look ahead.", 0.1)
HIDDEN = Case("hidden-plane-drive-1", "another wall", 3, "Look ahead.", 0.1, hidden=True)
GOOD = "def control(observation, memory):\n    return 0.25, 0.0"


class BrokenEnv(PlaneEnv):
    """It fails in the middle of a drive, as no controller can make it fail."""

    def step(self, action):
        if len(self.path) > 5:
            raise ValueError("the plane is broken")
        return super().step(action)


class SlowEnv(PlaneEnv):
    """Each of its steps takes so long that a drive takes longer than a kernel may."""

    def step(self, action):
        time.sleep(0.1)
        return super().step(action)


@contextmanager
def on_the_plane(kind="plane_env:PlaneEnv"):
    """Drives inside of this process are in this environment."""
    with driving_on_a_plane(kind):
        yield


def run_drives(factory, source, *, cases=(PUBLIC, HIDDEN), scenario=None, hidden=None, sensors=("scan",)):
    """(ExerciseRun, GradedExercise) of a controller; `scenario` changes all, `hidden` the hidden."""
    changes = {False: scenario or {}, True: (scenario or {}) | (hidden or {})}
    cases = tuple(replace(case, calls=(ExpectedCall((SCENARIO | changes[case.hidden],)),)) for case in cases)
    exercise = Exercise(
        id="plane-drive",
        title="Drive",
        function="control",
        subject="drive",
        sensors=sensors,
        cases=cases,
    )
    page = page_of({exercise.id: source}, SimpleNamespace(exercises=[exercise]))
    kernels = PageKernels(page, factory)
    exercise_run = ExerciseRun(exercise, kernels, stop_at=time.monotonic() + 1000)
    try:
        for case in cases:
            exercise_run.run(case, exercise.kind.check_source(exercise))
    finally:
        exercise_run.close()
    graded = graded_exercises({exercise.id: exercise_run}, page, kernels.tried)
    return exercise_run, graded[exercise.id]
