"""The answers that the masters contain: stub, solution and known mistakes, and how they are graded."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2]))
from master_answers import sample_answers
from nbclassroom.authoring.lesson_names import lesson_name
from nbclassroom.authoring.masters import find_masters
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.outcomes import Outcome
from nbclassroom.autograder.pool import autograde
from nbclassroom.exercises import read_exercises

ROOT = Path(__file__).parents[3]
FOLDERS = sorted(
    {path.parent for name in ("notebooks", "tests") for path in (ROOT / name).glob("**/masters/[0-9]*.py")}
)


def samples(folders):
    """(path, exercise, name) of each sample answer of the masters in folders."""
    return [
        (path, exercise, name)
        for folder in folders
        for path in find_masters(folder)
        for exercise in read_exercises(path)
        if not exercise.practice
        for name in sample_answers(exercise)
    ]


def title_of(path, declared, name):
    return f"{path.stem}: {declared.id}: {name}"


def grade_samples(samples, scratch):
    """{title: GradedExercise} of sample answers, graded with inputs that no lesson shows.

    Parameters
    ----------
    samples : list as of `samples`
    scratch : Path of an existing folder, for the keys
    """
    graded = {}
    for number, folder in enumerate(sorted({path.parent for path, _, _ in samples})):
        key = make_key(folder, "a secret of the tests", scratch / f"key-{number}")
        chosen = {title_of(*sample): sample for sample in samples if sample[0].parent == folder}
        submissions = [
            (title, lesson_name(path.stem), {declared.id: sample_answers(declared)[name]})
            for title, (path, declared, name) in chosen.items()
        ]
        for result in autograde(submissions, key, workers=2):
            declared = chosen[result.name][1]
            graded[result.name] = next(e for e in result.exercises if e.id == declared.id)
    return graded


def fault_of(declared, name, result):
    """What is wrong with the GradedExercise of a sample answer; "" if nothing is."""
    if not result.max_points == declared.points > 0:
        return f"{result.max_points} points instead of {declared.points}"
    if name == "right":
        return "" if result.points == result.max_points else f"{result.points} of {result.max_points} points"
    if name == "untouched":
        outcomes = {case.outcome for case in result.cases}
        return "" if outcomes == {Outcome.NOT_ATTEMPTED} else f"its cases are {sorted(outcomes)}"
    if result.points == result.max_points:
        return "a mistake has all points"
    return "" if result.mistake == name else f"it is named {result.mistake!r}"
