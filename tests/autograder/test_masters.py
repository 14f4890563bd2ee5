"""Every master grades correctly: the stub gets no points, the solution all, and each mistake is named."""

from pathlib import Path

import pytest

from imgproc_course.authoring.lesson_names import lesson_name
from imgproc_course.authoring.masters import find_masters
from imgproc_course.autograder.make_answer_key import make_key, sample_answers
from imgproc_course.autograder.outcomes import Outcome
from imgproc_course.autograder.pool import autograde
from imgproc_course.exercises import read_exercises
from imgproc_course.exercises.checking import run_cases as check_answer

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("masters"), pytest.mark.timeout(1800)]
ROOT = Path(__file__).parents[2]
FOLDERS = sorted({path.parent for path in ROOT.glob("*/**/masters/[0-9]*.py")})
MASTERS = [path for folder in FOLDERS for path in find_masters(folder)]
GRADED = [(path, exercise) for path in MASTERS for exercise in read_exercises(path) if not exercise.practice]
SAMPLES = [(path, exercise, name) for path, exercise in GRADED for name in sample_answers(exercise)]
TITLES = [f"{path.stem}: {exercise.id}: {name}" for path, exercise, name in SAMPLES]


def name_of(path, declared, name):
    return f"{path.stem}: {declared.id}: {name}"


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """{title: GradedSubmission} of each sample answer, graded with inputs that no lesson shows."""
    graded = {}
    for folder in {path.parent for path, _ in GRADED}:
        key = make_key(folder, "a secret of the tests", tmp_path_factory.mktemp("keys") / "key")
        submissions = [
            (
                name_of(path, declared, name),
                lesson_name(path.stem),
                {declared.id: sample_answers(declared)[name]},
            )
            for path, declared, name in SAMPLES
            if path.parent == folder
        ]
        graded |= {result.name: result for result in autograde(submissions, key, workers=2)}
    return graded


def graded_exercise(results, path, declared, name):
    result = results[name_of(path, declared, name)]
    return next(exercise for exercise in result.exercises if exercise.id == declared.id)


@pytest.mark.parametrize(("path", "declared", "name"), SAMPLES, ids=TITLES)
def test_each_sample_answer_gets_its_points(results, path, declared, name):
    result = graded_exercise(results, path, declared, name)
    assert result.max_points == declared.points > 0
    if name == "right":
        assert result.points == result.max_points
    elif name == "untouched":
        assert result.points == 0
        assert {case.outcome for case in result.cases} == {Outcome.NOT_ATTEMPTED}
    else:
        assert result.points < result.max_points
        assert result.mistake == name


@pytest.mark.parametrize(("path", "declared", "name"), SAMPLES, ids=TITLES)
def test_check_in_a_lesson_agrees(results, path, declared, name):
    """On the public cases. The lesson has other inputs, so a mistake may pass a case in only one of them."""
    prepared = name not in ("right", "untouched")
    function = declared.function_of(sample_answers(declared)[name], name, prepared=prepared)
    checked = check_answer(declared, function)
    result = graded_exercise(results, path, declared, name)
    public_passed = all(case.passed for case in result.cases if not case.hidden)
    if name in ("right", "untouched"):
        assert checked.passed == public_passed == (name == "right")
        assert checked.attempted == (name == "right")
    else:
        assert not checked.passed and not public_passed
        assert checked.mistake.name == result.mistake


def test_there_are_masters_to_grade():
    assert {ROOT / "notebooks" / "masters", Path(__file__).parent / "masters"} <= set(FOLDERS)
