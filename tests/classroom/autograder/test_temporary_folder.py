"""Temporary folders of killed runs are removed by the next run, those in use stay."""

import fcntl
import os
import tempfile

import pytest
from nbclassroom.autograder.temporary_folder import TemporaryFolder
from nbclassroom.autograder.worker_threads import open_worker_threads


@pytest.fixture
def killed_run(tmp_path, monkeypatch):
    """(the folder for temporary files, another run's folder in it, the descriptor that locks the latter)"""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    folder = tmp_path / "nbclassroom-other"
    (folder / "work").mkdir(parents=True)
    lock = os.open(folder / ".lock", os.O_RDWR | os.O_CREAT)
    fcntl.flock(lock, fcntl.LOCK_EX)
    return tmp_path, folder, lock


def test_a_run_that_was_killed_leaves_no_folder_after_the_next_one_began(killed_run):
    temporary, _, lock = killed_run
    os.close(lock)
    folder = TemporaryFolder()
    assert list(temporary.iterdir()) == [folder.path]
    folder.remove()
    assert list(temporary.iterdir()) == []


def test_a_killed_run_leaves_no_folder_if_the_next_one_has_nothing_to_grade(killed_run):
    temporary, other, lock = killed_run
    with open_worker_threads(1):
        assert list(temporary.iterdir()) == [other]
        os.close(lock)
    assert list(temporary.iterdir()) == []


def test_a_killed_run_that_took_long_to_end_leaves_no_folder(killed_run):
    temporary, other, lock = killed_run
    with open_worker_threads(1):
        folder = TemporaryFolder()
        assert sorted(temporary.iterdir()) == sorted([folder.path, other])
        os.close(lock)
        folder.remove()
    assert list(temporary.iterdir()) == []


def test_the_folder_of_a_run_that_goes_on_stays(killed_run):
    temporary, other, lock = killed_run
    with open_worker_threads(1):
        TemporaryFolder().remove()
    assert list(temporary.iterdir()) == [other] and (other / "work").is_dir()
    os.close(lock)
