"""Drives in the sandbox, on the plane of `plane_env`, without nbval: for tests and benchmarks."""

from dataclasses import replace

from imgproc_course.classroom.autograder.answer_key import ExerciseContent, KeyCase, KeyExercise
from imgproc_course.classroom.autograder.drives import CHECK
from imgproc_course.classroom.autograder.nbval_plugin import ExerciseRun
from imgproc_course.classroom.autograder.results import graded_exercise
from imgproc_course.classroom.exercises.input_encoding import encode

STUB = "def control(observation, memory):\n    raise NotImplementedError"
SCENARIO = {
    "seed": 3,
    "title": "a wall",
    "start": [0.0, 0.0, 0.0],
    "duration": 4.0,
    "thresholds": {"bumps": ["<=", 0], "clearance": [">=", 0.3], "reach": [">=", 0.8]},
}
CASES = (
    KeyCase("case-tiny-1", "a wall", "Look ahead.", 2, False, 0.0, 1),
    KeyCase("hidden-tiny-1", "another wall", "Look ahead.", 3, True, 0.0, 1),
)


def exercise_of(cases=CASES, **fields):
    fields = {"time_limit": 2.0, "allowed": (), "sensors": ("scan",)} | fields
    return KeyExercise(
        id="tiny-drive",
        title="Tiny",
        function="control",
        points=sum(case.points for case in cases),
        practice=False,
        stub=STUB,
        arguments=("observation", "memory"),
        cases=cases,
        mistakes=(),
        subject="drive",
        **fields,
    )


def run_drive(factory, source, *, scenario=None, cases=CASES, **fields):
    """(ExerciseRun, GradedExercise) of a controller; the scenario changes that of each case."""
    exercise = exercise_of(cases, **fields)
    inputs = {case.id: [encode((SCENARIO | (scenario or {}),))] for case in cases}
    content = ExerciseContent({}, inputs, {}, {})
    exercise_run = ExerciseRun(exercise, content, factory)
    for case in cases:
        run = exercise_run.run(case, [source], CHECK.format(function="control"))
        exercise_run.passed |= {case.id} if run.passed else set()
    exercise_run.close()
    return exercise_run, graded_exercise(exercise, content, exercise_run)


def one_case(hidden=False):
    """One case only: a drive and not two."""
    return (replace(CASES[hidden]),)
