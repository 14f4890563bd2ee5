"""A class on one machine: each learner has a home and a ROS domain, and what one does harms no other."""

import json
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

pytest.importorskip("rclpy", reason="needs ROS 2")
pytest.importorskip("jupyterhub", reason="needs JupyterHub")

from class_machine import RECEIVE, ROOT, Class, Learner, wait_for

START = ROOT / "environment/class/start"
COLLECT = ROOT / "environment/class/collect"


def test_without_names_it_says_where_to_write_them(tmp_path):
    process = subprocess.run(
        [START],
        env={"PATH": "/usr/bin:/bin", "CLASS_PYTHON": "python", "CLASS_FOLDER": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert process.returncode == 1
    assert "write the learners' names into" in process.stderr
    assert process.stderr.count("\n") == 1


def test_two_learners_have_a_robot_each_and_all_ends_with_the_hub(tmp_path):
    with Class(tmp_path, ["*ada", "bob", "cem"]) as hub:
        assert Learner(hub, "bob", "wrong password").login.status_code == 403
        assert Learner(hub, "eve").login.status_code == 403  # is not in users.txt
        learners = [Learner(hub, "bob"), Learner(hub, "cem")]
        for learner in learners:
            learner.start()
        for learner in learners:
            learner.wait_until_ready()
        with ThreadPoolExecutor() as pool:
            results = list(
                pool.map(lambda learner: json.loads(learner.run(RECEIVE.format(seconds=2))), learners)
            )
        assert [result["publishers"] for result in results] == [1, 1]
        assert results[0]["domain"] != results[1]["domain"]
        assert [Path(result["home"]).name for result in results] == ["bob", "cem"]
        assert min(result["received"] for result in results) >= 10

        [server] = [
            process
            for process in hub.processes()
            if "singleuser" in " ".join(process.cmdline()) and "bob" in process.environ()["HOME"]
        ]
        server.kill()
        assert learners[1].run("print(6 * 7)") == "42\n"
        assert learners[1].get("api/contents/04_grayscale.ipynb").status_code == 200
    wait_for(lambda: not hub.processes(), hub, seconds=60)


@pytest.mark.skipif(os.geteuid() != 0, reason="needs root: accounts, in a mount namespace of their own")
def test_learners_with_accounts_run_under_them_and_read_no_home_but_their_own(tmp_path):
    look = "import os; print(os.getuid(), *[n for n in ('bob', 'cem') if os.access('/home/' + n, 4)])"
    with Class(tmp_path, ["*ada", "bob", "cem"], has_accounts=True) as hub:
        assert Learner(hub, "bob", "wrong password").login.status_code == 403
        printed = {}
        for name in ("bob", "cem"):
            learner = Learner(hub, name, password=name)
            learner.start()
            learner.wait_until_ready()
            printed[name] = learner.run(look)
            assert learner.get("api/contents/04_grayscale.ipynb").status_code == 200
    assert printed == {"bob": "61002 bob\n", "cem": "61003 cem\n"}
    assert "/home/bob" not in Path("/etc/passwd").read_text()


@pytest.fixture
def homes(tmp_path):
    for name in ("bob", "cem"):
        folder = tmp_path / "homes" / name / "my_lessons"
        folder.mkdir(parents=True)
        shutil.copy(ROOT / "notebooks/04_grayscale.ipynb", folder)
    shutil.copy(ROOT / "notebooks/01_arrays.ipynb", folder)
    return tmp_path


def collect(homes, *arguments):
    environment = {"PATH": "/usr/bin:/bin", "CLASS_FOLDER": str(homes)}
    return subprocess.run([COLLECT, *arguments], env=environment, capture_output=True, text=True)


def test_submissions_are_collected_by_learner(homes, tmp_path):
    process = collect(homes, str(tmp_path / "submissions"), "grayscale", "arrays")
    assert process.returncode == 0, process.stderr
    assert process.stdout == "grayscale: 2 learners\narrays: 1 learner\n"
    found = sorted(
        path.relative_to(tmp_path / "submissions").as_posix()
        for path in (tmp_path / "submissions").rglob("*.ipynb")
    )
    assert found == ["bob/04_grayscale.ipynb", "cem/01_arrays.ipynb", "cem/04_grayscale.ipynb"]


def test_a_lesson_that_nobody_has_is_named(homes, tmp_path):
    process = collect(homes, str(tmp_path / "submissions"), "greyscale")
    assert process.returncode == 1
    assert f"no learner in {homes}/homes has a lesson greyscale; names are like grayscale" in process.stderr
    assert process.stderr.count("\n") == 1
