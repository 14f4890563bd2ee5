"""Every lesson as it is shipped, and its solved twin: run by nbval, proved, and run where ROS is missing.

Lessons and masters are found, never listed.
"""

import importlib.metadata
import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import nbformat
import pytest

from imgproc_course.authoring.build import build_solved, execute
from imgproc_course.authoring.masters import read_master
from imgproc_course.authoring.validation import prove
from imgproc_course.exercises import read_exercises
from imgproc_course.exercises.checking import run_cases

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
MASTERS = sorted((NOTEBOOKS / "masters").glob("[0-9][0-9]_*.py"))
# What of the tests' own surroundings would change a lesson's outputs.
OURS = (
    "MPLBACKEND",
    "PYTEST_ADDOPTS",
    "PYTEST_CURRENT_TEST",
    "PYTEST_XDIST_WORKER",
    "PYTEST_XDIST_TESTRUNUID",
)


# nbval alone, as the judge starts it: other plugins, and what JupyterLab brings, cost seconds a notebook.
NBVAL = ["-p", "imgproc_course.autograder.blocked_imports", "-p", "nbval.plugin", "--nbval"]


def by_lesson(paths):
    return [pytest.param(path, id=path.stem) for path in paths]


def exercises():
    return [pytest.param(declared, id=declared.id) for path in MASTERS for declared in read_exercises(path)]


def run_nbval(path, folder):
    """nbval's own words on a notebook, and whether it found it as stored."""
    environment = {name: value for name, value in os.environ.items() if name not in OURS}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *NBVAL, str(path)],
        cwd=NOTEBOOKS.parent,
        env=environment | {"IPYTHONDIR": str(folder / ".ipython"), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
    )
    return done.returncode, done.stdout[-4000:] + done.stderr[-2000:]


def test_every_master_has_its_lesson_and_every_lesson_its_master():
    assert MASTERS
    assert [path.stem for path in MASTERS] == sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb"))


@pytest.mark.parametrize("master", by_lesson(MASTERS))
def test_nbval_finds_the_lesson_as_shipped(master, tmp_path):
    # A copy: what a lesson writes beside itself must not land among the shipped ones.
    path = shutil.copy(NOTEBOOKS / f"{master.stem}.ipynb", tmp_path)
    code, said = run_nbval(path, tmp_path)
    assert code == 0, said


@pytest.mark.parametrize("master", by_lesson(MASTERS))
def test_nbval_finds_the_solved_twin_as_built(master, tmp_path):
    twin = build_solved(read_master(master))
    for cell in twin.cells:
        if cell.id.startswith("check-"):
            text = cell.outputs[0].data["text/plain"]
            assert re.match(r"[\w-]+: (the check passes|both checks pass|all \d+ checks pass)\.\n", text), (
                text
            )
    path = tmp_path / f"{master.stem}.ipynb"
    nbformat.write(twin, path)
    code, said = run_nbval(path, tmp_path)
    assert code == 0, said


@pytest.mark.parametrize("declared", exercises())
def test_an_exercise_grades_justly(declared):
    assert prove(declared) == []
    stub = run_cases(declared, declared.function_of(declared.stub, "stub"), cases=declared.cases)
    assert not stub.attempted and stub.points == 0
    solution = declared.function_of(declared.solution, "solution")
    right = run_cases(declared, solution, cases=declared.cases, seed=7)
    assert right.passed and right.points == declared.points


@pytest.mark.parametrize("declared", exercises())
def test_every_known_mistake_is_caught_under_its_own_name(declared):
    caught = {}
    for mistake in declared.mistakes:
        wrong = declared.function_of(mistake.source, mistake.name, prepared=True)
        result = run_cases(declared, wrong)
        assert result.attempted and not result.passed
        caught[mistake.name] = result.mistake and result.mistake.name
        assert mistake.says in repr(result)
    assert caught == {mistake.name: mistake.name for mistake in declared.mistakes}


# ---------------------------------------------------------------- without ROS


def files_of(distribution):
    """The names directly in site-packages that a distribution brings."""
    tops = {Path(file).parts[0] for file in distribution.files or () if Path(file).parts}
    return tops - {"..", "__pycache__"}


@pytest.fixture(scope="session")
def kernel_without_ros(tmp_path_factory):
    """A kernel whose site-packages hold everything of ours but the ROS distributions; its name."""
    home = tmp_path_factory.mktemp("no-ros")
    here = Path(sysconfig.get_path("purelib"))
    distributions = list(importlib.metadata.distributions(path=[str(here)]))
    ros = set().union(*(files_of(each) for each in distributions if each.name.startswith("ros-")))
    there = home / "venv" / here.relative_to(sys.prefix)
    there.mkdir(parents=True)
    for entry in here.iterdir():
        if entry.name not in ros:
            (there / entry.name).symlink_to(entry)
    python = home / "venv" / "bin" / "python"
    python.parent.mkdir()
    python.symlink_to(Path(sys.executable).resolve())
    (home / "venv" / "pyvenv.cfg").write_text((Path(sys.prefix) / "pyvenv.cfg").read_text())
    kernel = home / "share" / "jupyter" / "kernels" / "without-ros"
    kernel.mkdir(parents=True)
    argv = [str(python), "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    spec = {"argv": argv, "display_name": "without ROS", "language": "python"}
    (kernel / "kernel.json").write_text(json.dumps(spec))
    probe = "import importlib.util as u; print(u.find_spec('rclpy'), u.find_spec('sensor_msgs'))"
    seen = subprocess.run([str(python), "-c", probe], capture_output=True, text=True, check=True)
    assert seen.stdout == "None None\n"
    return home / "share" / "jupyter"


@pytest.mark.parametrize("master", by_lesson(MASTERS))
def test_the_lesson_runs_where_ros_is_missing(master, kernel_without_ros, monkeypatch):
    monkeypatch.setenv("JUPYTER_PATH", str(kernel_without_ros))
    notebook = nbformat.read(NOTEBOOKS / f"{master.stem}.ipynb", as_version=4)
    execute(notebook, master, kernel_name="without-ros")
    assert all(cell.execution_count for cell in notebook.cells if cell.cell_type == "code")
