"""A process of ours that is killed costs nobody a point, and a killed run leaves nothing."""

import random
import shutil

import pytest
from kills import COMMAND, KINDS, Run, write_submissions

pytestmark = pytest.mark.sandbox


def results_in(out):
    return len([path for path in (out / "results").glob("*.json") if "page" not in path.name])


def kill_all_kinds(run, out, rng):
    """Kill one process of each kind, the command last; whether the run lasted long enough for that."""
    shutil.rmtree(out, ignore_errors=True)
    run.start()
    for kind in [kind for kind in KINDS if kind != COMMAND]:
        while not run.kill(kind, rng):
            if run.process.poll() is not None:
                return run.finish()[0] != 0
    while results_in(out) < 2 and run.process.poll() is None:
        run.processes(COMMAND)
    run.kill(COMMAND, rng)
    run.process.communicate()
    return results_in(out) < 12


def test_kills_of_every_process_change_no_byte_and_leave_nothing(light, key_path, submissions, tmp_path):
    write_submissions(submissions, light, 12)
    calm, killed = tmp_path / "calm", tmp_path / "killed"
    run = Run(submissions, key_path, calm)
    run.start()
    assert run.finish()[0] == 0
    run = Run(submissions, key_path, killed)
    rng = random.Random(7)
    # On a busy machine a run may be over before this process has seen all kinds of processes.
    assert any(kill_all_kinds(run, killed, rng) for _ in range(5))
    assert 2 <= results_in(killed) < 12 and run.process.returncode < 0
    assert run.survivors(10) == []
    assert list(run.temporary.glob("nbclassroom-*"))
    (killed / "results" / ".writing-0.tmp").touch()
    run.start()
    assert run.finish()[0] == 0
    assert (killed / "grades.json").read_bytes() == (calm / "grades.json").read_bytes()
    assert list(run.temporary.iterdir()) == list(killed.rglob(".writing-*")) == []
    shutil.rmtree(run.temporary)
