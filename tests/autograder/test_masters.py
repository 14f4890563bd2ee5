"""Every master grades justly: the stub gets nothing, the solution everything, each known mistake its own."""

from pathlib import Path

import pytest

from imgproc_course.authoring.masters import find_masters
from imgproc_course.autograder.make_answer_key import make_key, sample_answers
from imgproc_course.autograder.pool import autograde
from imgproc_course.exercises import read_exercises
from imgproc_course.exercises.checking import run_cases as check_answer

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("masters")]
ROOT = Path(__file__).parents[2]
FOLDERS = sorted({path.parent for path in ROOT.glob("*/**/masters/[0-9]*.py")})
MASTERS = [path for folder in FOLDERS for path in find_masters(folder)]
GRADED = [(path, each) for path in MASTERS for each in read_exercises(path) if not each.practice]
SAMPLES = [(path, each, name) for path, each in GRADED for name in sample_answers(each)]


def name_of(path, declared, name):
    return f"{path.stem}: {declared.id}: {name}"


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    """Each sample answer of each exercise, judged with inputs that no lesson shows."""
    results = {}
    for folder in {path.parent for path, _ in GRADED}:
        key = make_key(folder, "a secret of the tests", tmp_path_factory.mktemp("keys") / "key")
        handed = [
            (name_of(path, declared, name), path.stem, {declared.id: sample_answers(declared)[name]})
            for path, declared, name in SAMPLES
            if path.parent == folder
        ]
        results |= {result["submission"]: result for result in autograde(handed, key, workers=2)}
    return results


def exercise(judged, path, declared, name):
    result = judged[name_of(path, declared, name)]
    return next(each for each in result["exercises"] if each["id"] == declared.id)


@pytest.mark.parametrize(("path", "declared", "name"), SAMPLES, ids=[name_of(*each) for each in SAMPLES])
def test_each_sample_gets_what_it_should(judged, path, declared, name):
    result = exercise(judged, path, declared, name)
    assert result["points"] == declared.points > 0
    if name == "right":
        assert result["got"] == result["points"]
    elif name == "untouched":
        assert result["got"] == 0
        assert {case["outcome"] for case in result["cases"]} == {"not attempted"}
    else:
        assert result["got"] < result["points"]
        assert result["mistake"] == name


@pytest.mark.parametrize(("path", "declared", "name"), SAMPLES, ids=[name_of(*each) for each in SAMPLES])
def test_check_in_a_lesson_says_the_same(judged, path, declared, name):
    """Of the public cases; the lesson's inputs are others, so a mistake may pass one here and not there."""
    prepared = name not in ("right", "untouched")
    function = declared.function_of(sample_answers(declared)[name], name, prepared=prepared)
    checked = check_answer(declared, function)
    public = [case for case in exercise(judged, path, declared, name)["cases"] if not case["hidden"]]
    if name in ("right", "untouched"):
        assert checked.passed == all(case["outcome"] == "passed" for case in public) == (name == "right")
        assert checked.attempted == (name == "right")
    else:
        assert not checked.passed and not all(case["outcome"] == "passed" for case in public)
        assert checked.mistake.name == exercise(judged, path, declared, name)["mistake"]


def test_there_are_masters_to_grade():
    assert {ROOT / "notebooks" / "masters", Path(__file__).parent / "masters"} <= set(FOLDERS)
