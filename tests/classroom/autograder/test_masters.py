"""Masters grade correctly: the stub gets no points, the solution all, and a mistake is named."""

import linecache

import pytest
from master_answers import sample_answers
from nbclassroom.exercises.checking import run_cases as check_answer
from nbclassroom.exercises.running import codes_of
from sample_answers import FOLDERS, ROOT, fault_of, grade_samples, samples, title_of

pytestmark = [pytest.mark.sandbox, pytest.mark.timeout(1800)]


def is_quick(sample):
    """The stub, the solution and the first mistake, of the tests' masters, but not of the benchmarks'.

    tests/classroom/gradebook/test_teach.py grades those of the lessons, with one key for all that it grades,
    and tests/benchmarks/bench_sample_answers.py all.
    """
    _, declared, name = sample
    return name in list(sample_answers(declared))[:3]


OTHERS = (ROOT / "notebooks", ROOT / "tests" / "benchmarks")
OWN = [folder for folder in FOLDERS if not any(other in folder.parents for other in OTHERS)]
SOME = [sample for sample in samples(OWN) if is_quick(sample)]
TITLES = [title_of(*sample) for sample in SOME]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """{title: GradedExercise}."""
    return grade_samples(SOME, tmp_path_factory.mktemp("keys"))


@pytest.mark.parametrize(("path", "declared", "name"), SOME, ids=TITLES)
def test_each_sample_answer_gets_its_points(results, path, declared, name):
    result = results[title_of(path, declared, name)]
    assert fault_of(declared, name, result) == ""


@pytest.mark.parametrize(("path", "declared", "name"), SOME, ids=TITLES)
def test_check_in_a_lesson_agrees(results, path, declared, name):
    """On the public cases. The lesson has other inputs, so a mistake may pass a case in only one of them."""
    prepared, source = name not in ("right", "untouched"), sample_answers(declared)[name]
    function = declared.function_of(source, name, prepared=prepared)
    for code in codes_of(function).values() if name == "untouched" else ():  # as a notebook knows its cells
        lines = source.splitlines(keepends=True)
        linecache.cache[code.co_filename] = (len(source), None, lines, code.co_filename)
    checked = check_answer(declared, function)
    result = results[title_of(path, declared, name)]
    public_passed = all(case.passed for case in result.cases if not case.hidden)
    if name in ("right", "untouched"):
        assert checked.passed == public_passed == (name == "right")
        assert checked.attempted == (name == "right")
    else:
        assert not checked.passed and not public_passed
        assert checked.mistake.name == result.mistake
