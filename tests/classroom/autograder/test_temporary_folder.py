"""Temporary folders of killed runs are removed by the next run, those in use stay."""

import os
import tempfile

from nbclassroom.autograder.pool import open_worker_threads
from nbclassroom.autograder.sandbox.bubblewrap import make_temporary_folder


def test_the_folders_of_killed_runs_are_removed_and_those_of_others_stay(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    used, killed = (tmp_path / f"nbclassroom-{number}-x" for number in (os.getppid(), 2**22 + 1))
    (used / "work").mkdir(parents=True)
    killed.mkdir()
    folder = make_temporary_folder()
    assert sorted(tmp_path.iterdir()) == sorted([folder, used])
    with open_worker_threads(1):  # which has nothing to grade
        killed.mkdir()
    assert sorted(tmp_path.iterdir()) == sorted([folder, used]) and (used / "work").is_dir()
