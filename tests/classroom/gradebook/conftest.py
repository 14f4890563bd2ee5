"""A key of two small lessons, made once per session, and fixtures that grade with it."""

import contextlib
import json
import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
sys.path.append(str(Path(__file__).parents[1] / "authoring"))
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.autograder import pool
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import open_worker_threads
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.gradebook import check
from nbclassroom.gradebook.answer_keys import AnswerKeys
from nbclassroom.gradebook.grade import grade_submissions
from submissions import MASTERS, SEED
from template_master import write_carried_files, write_master

__all__ = ["write_master"]


@pytest.fixture(scope="module", autouse=True)
def one_worker():
    """All runs of a module with one worker share an nbval process, which takes two seconds to start."""
    with open_worker_threads(1) as shared, pytest.MonkeyPatch.context() as patch:

        def open_shared(workers, **options):
            is_alone = options or workers > 1
            return open_worker_threads(workers, **options) if is_alone else contextlib.nullcontext(shared)

        patch.setattr(pool, "open_worker_threads", open_shared)
        yield


@pytest.fixture(scope="module")
def one_fork_server():
    """All runs of `check --run` in a module take their kernels from one fork server."""
    with KernelFactory(unsafe=True) as shared, pytest.MonkeyPatch.context() as patch:
        patch.setattr(check, "KernelFactory", lambda unsafe: contextlib.nullcontext(shared))
        yield


@pytest.fixture(scope="session")
def masters():
    return {master.name: master for master in map(read_master, find_masters(MASTERS))}


@pytest.fixture(scope="session")
def light(masters):
    return masters["light"]


@pytest.fixture(scope="session")
def checks(tmp_path_factory, masters):
    """The folder of the lessons' checks files."""
    folder = tmp_path_factory.mktemp("lessons")
    for master in masters.values():
        write_carried_files(master, folder)
    return folder / "checks"


@pytest.fixture(scope="session")
def key_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("answer_key") / "key"
    make_key(MASTERS, SEED, path)
    return path


@pytest.fixture(scope="session")
def answer_keys(key_path):
    return AnswerKeys([key_path])


@pytest.fixture
def grade(key_path, tmp_path):
    """Grades a folder, and returns the content of grades.json."""

    def graded(submissions, out=None, **options):
        out = out or tmp_path / "grades"
        grade_submissions(submissions, [key_path], out, **({"workers": 1} | options))
        return json.loads((out / "grades.json").read_text(encoding="utf-8"))

    return graded


@pytest.fixture(scope="module")
def chromium():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        options = {"executable_path": shutil.which("chromium"), "args": ["--no-sandbox"]}
        browser = playwright.chromium.launch(**options)
        yield browser
        browser.close()


@pytest.fixture
def submissions(tmp_path):
    folder = tmp_path / "submissions"
    folder.mkdir()
    return folder
