"""A key of two small lessons, made once a session, and what grades with it."""

import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from submissions import MASTERS, SEED

from imgproc_course.grading.key import make_key
from imgproc_course.grading.masters import find_masters, read_master
from imgproc_course.grading.office import grade_submissions
from imgproc_course.grading.term import open_term, write_handed_out


@pytest.fixture(scope="session")
def masters():
    return {path.stem: read_master(path) for path in find_masters(MASTERS)}


@pytest.fixture(scope="session")
def light(masters):
    return masters["20_light"]


@pytest.fixture(scope="session")
def key_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("office") / "key"
    make_key(MASTERS, SEED, path)
    write_handed_out(MASTERS, path)
    return path


@pytest.fixture(scope="session")
def term(key_path):
    return open_term([key_path])


@pytest.fixture
def grade(key_path, tmp_path):
    """Grade a folder; gives what grades.json holds."""

    def graded(submissions, out=None, **options):
        out = out or tmp_path / "grades"
        grade_submissions(submissions, [key_path], out, **({"workers": 1, "quiet": True} | options))
        return json.loads((out / "grades.json").read_text(encoding="utf-8"))

    return graded


@pytest.fixture
def submissions(tmp_path):
    folder = tmp_path / "submissions"
    folder.mkdir()
    return folder
