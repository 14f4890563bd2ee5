"""The same grading on a Dask cluster; one of its workers is killed during the run."""

import os
import signal
import subprocess
import sys

import pytest
from nbclassroom.autograder.pool import Limits, autograde, open_scheduler

pytestmark = pytest.mark.sandbox
PATIENT = Limits(grace=4.0)


def make_submissions(right, count):
    wrong = "def double(pixels):\n    return pixels * 2"
    return [
        (f"s{number}", "attacked", right | ({"attacked-double": wrong} if number % 3 == 0 else {}))
        for number in range(count)
    ]


CLUSTER = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        print(cluster.scheduler_address, flush=True)
        print(*(nanny.pid for nanny in cluster.workers.values()), flush=True)
        sys.stdin.read()
"""


@pytest.fixture
def cluster(tmp_path):
    """A scheduler with two worker processes, in a process of its own: (address, process ids)."""
    pytest.importorskip("distributed", reason="Dask is an optional extra: imgproc-course[scheduler]")
    program = tmp_path / "cluster.py"
    program.write_text(CLUSTER)
    process = subprocess.Popen(
        [sys.executable, str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=tmp_path
    )
    address = process.stdout.readline().strip()
    workers = [int(word) for word in process.stdout.readline().split()]
    yield address, workers
    process.stdin.close()
    process.stdout.close()
    process.wait(60)


@pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")
def test_a_worker_that_is_killed_changes_no_grade(cluster, key, right):
    address, workers = cluster
    submissions = make_submissions(right, 24)
    alone = list(autograde(submissions, key, workers=1, limits=PATIENT))
    results = []
    with open_scheduler(address) as executor:
        for number, result in enumerate(
            autograde(submissions, key, workers=2, executor=executor, limits=PATIENT)
        ):
            results.append(result)
            if number == 3:
                os.kill(workers[0], signal.SIGKILL)
    assert results == alone
    assert {result.points for result in results} == {7, 10}


def test_an_address_without_a_scheduler_is_reported():
    pytest.importorskip("distributed", reason="Dask is an optional extra: imgproc-course[scheduler]")
    unused = "tcp://127.0.0.1:9"
    with (
        pytest.raises(ValueError, match=f"no Dask scheduler answers at {unused}"),
        open_scheduler(unused, patience=1),
    ):
        pass


def test_without_dask_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(ValueError, match='pip install "distributed"'),
        open_scheduler("tcp://127.0.0.1:8786"),
    ):
        pass
