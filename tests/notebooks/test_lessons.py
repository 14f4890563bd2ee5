"""Every lesson as shipped, and its solved twin: run by nbval, built from its master, and run without ROS.

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
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import nbformat
import pytest
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

sys.path.append(str(Path(__file__).parent))
from cells_of_ros import cells_of_ros
from nbclassroom.authoring import validation
from nbclassroom.authoring.build import (
    INDEX,
    build_lesson,
    compare_other_files,
    differences,
    lesson_notebook,
)
from nbclassroom.authoring.execute import execute
from nbclassroom.authoring.lesson_files import lesson_file_differences, lesson_files
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.exercises import checking
from nbclassroom.exercises.check_files import read_check_file
from nbclassroom.exercises.checking import run_cases, run_check
from selection import IS_SHORT
from solved_twin import assert_passing, solved_twin

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
MASTERS = [*find_masters(NOTEBOOKS / "masters"), NOTEBOOKS / "masters" / f"{INDEX}.py"]
# Variables of the tests' environment that would change a lesson's outputs.
OURS = (
    "MPLBACKEND",
    "PYTEST_ADDOPTS",
    "PYTEST_CURRENT_TEST",
    "PYTEST_XDIST_WORKER",
    "PYTEST_XDIST_TESTRUNUID",
)


# nbval alone, as the autograder starts it: other plugins and JupyterLab's modules cost seconds per notebook.
PLUGINS = [
    "-p",
    "nbclassroom.autograder.blocked_imports",
    "-p",
    "nbval.plugin",
    "-p",
    "recorded_outputs",
]


def by_lesson(paths):
    return [pytest.param(path, id=path.stem) for path in paths]


@pytest.mark.parametrize("path", by_lesson(MASTERS))
def test_the_task_says_whether_the_type_counts(path):
    master, task, exact = read_master(path), "", {}
    for cell in master.cells:
        if cell.role == "answer":
            exact[cell.exercise] = bool(re.search(r"type counts|types count|dtype must be exactly", task))
        task = cell.source if cell.kind == "markdown" else task
    assert exact == {exercise.id: exercise.exact_type for exercise in master.exercises}


def run_nbval(paths, folder):
    """Let nbval execute notebooks and compare them; the outputs, {path of a notebook: {cell id: outputs}}."""
    environment = {name: value for name, value in os.environ.items() if name not in OURS}
    recorded = folder / "outputs.json"
    options = ["-p", "no:cacheprovider", "-q", *PLUGINS, "--nbval", f"--outputs={recorded}"]
    process = subprocess.run(
        [sys.executable, "-m", "pytest", *options, *map(str, paths)],
        cwd=Path(__file__).parent,  # of the plugin that records
        env=environment | {"IPYTHONDIR": str(folder / ".ipython"), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
    )
    assert process.returncode == 0, process.stdout[-4000:] + process.stderr[-2000:]
    return json.loads(recorded.read_text(), object_hook=NotebookNode)


def test_every_master_has_its_lesson_and_every_other_file_its_source():
    assert MASTERS
    assert [path.stem for path in MASTERS] == [path.stem for path in sorted(NOTEBOOKS.glob("*.ipynb"))]
    assert compare_other_files(NOTEBOOKS / "masters", NOTEBOOKS) == []


def test_the_cells_of_every_lesson_are_its_masters():
    """Without running one: a cell added to a lesson also changes the links that other lessons hold to it."""
    for path in MASTERS:
        built, stored = lesson_notebook(read_master(path)), NOTEBOOKS / f"{path.stem}.ipynb"
        for cell, stored_cell in zip(built.cells, nbformat.read(stored, as_version=4).cells, strict=True):
            assert (cell.id, cell.source) == (stored_cell.id, stored_cell.source), stored.name


@pytest.mark.parametrize("path", by_lesson(MASTERS))
def test_nbval_finds_the_lesson_as_shipped_and_every_check_of_its_solved_twin_passing(
    path, tmp_path, pytestconfig
):
    """And the master gives the lesson as shipped. One process for both: it takes a second to start.

    A newcomer's tests run the lesson as shipped alone.
    """
    shipped, master = NOTEBOOKS / f"{path.stem}.ipynb", read_master(path)
    # A copy: what a lesson writes beside itself must not land among the shipped ones.
    copies = [tmp_path / folder / shipped.name for folder in ("shipped", "solved")]
    for copy in copies:
        copy.parent.mkdir()
        for module in NOTEBOOKS.glob(f"{master.name}.py"):  # the lesson imports it
            shutil.copy(module, copy.parent)
    shutil.copy(shipped, copies[0])
    if path.stem == INDEX or pytestconfig.stash[IS_SHORT]:
        copies = copies[:1]
    else:
        twin = solved_twin(master, nbformat.read(shipped, as_version=4))
        nbformat.write(twin, copies[1])
    outputs, *solved_outputs = run_nbval(copies, tmp_path).values()
    for recorded in solved_outputs:
        assert_passing(twin, recorded)
    assert_stubs_that_drive_earn_nothing(master, outputs)
    executed = lesson_notebook(master)
    for cell in executed.cells:
        if cell.cell_type == "code":
            cell.outputs = outputs.get(cell.id, [])
    assert differences(build_lesson(master, shipped, executed), shipped) == []


def assert_stubs_that_drive_earn_nothing(master, outputs):
    """By the output of each exercise's check, which nbval does not compare."""
    for exercise in master.exercises:
        if exercise.subject == "drive":
            (result,) = outputs[f"check-{exercise.id}-1"]
            text = result.data["text/plain"]
            assert re.findall(r"(\d+) of 1\n", text) == ["0"] * len(exercise.public), text


def assert_points(exercise):
    """None for the stub, all for the solution."""
    stub = run_cases(exercise, exercise.function_of(exercise.stub, "stub"), cases=exercise.cases)
    assert not stub.attempted and stub.points == 0
    solution = exercise.function_of(exercise.solution, "solution")
    result = run_cases(exercise, solution, cases=exercise.cases, seed=7)
    assert result.passed and result.points == exercise.points


@pytest.fixture
def stub_and_solution_do_not_drive(monkeypatch):
    """nbval's run of a lesson asserts that the stub fails everywhere, and that the solution passes.

    A mistake drives in one scenario. The benchmark `term` lets all drive, and so does a build.
    """
    run, data_of = validation.run_cases, checking.check_data_of

    def data_of_one(exercise, cases=None, *seed):
        is_one = cases is None and exercise.subject == "drive" and not os.environ.get("WHOLE_TERM")
        return data_of(exercise, exercise.public[:1] if is_one else cases, *seed)

    def run_others(exercise, function, **options):
        if exercise.subject != "drive" or os.environ.get("WHOLE_TERM"):
            return run(exercise, function, **options)
        is_stub = function.__code__ == exercise.function_of(exercise.stub, "stub").__code__
        result = SimpleNamespace(passed=not is_stub)
        return SimpleNamespace(results=[result] * len(exercise.public))

    monkeypatch.setattr(validation, "run_cases", run_others)
    monkeypatch.setattr(checking, "check_data_of", data_of_one)


@pytest.mark.parametrize("path", by_lesson(MASTERS))
def test_the_exercises_are_valid_and_their_stored_checks_say_the_same(
    path, tmp_path, stub_and_solution_do_not_drive
):
    """For the stub, the solution and each known mistake; and the stored checks are those of the master.

    One test for both, because what the mistakes give is computed once in a process. Hidden scenarios of
    drives are drawn by `key` until they fit; the last mistake drives here, in one scenario.
    """
    master = read_master(path)
    files = lesson_files(master)
    assert lesson_file_differences(files, NOTEBOOKS) == []
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
        assert len(text) < 550_000
    for exercise in master.exercises:
        if exercise.subject == "drive":
            is_whole = os.environ.get("WHOLE_TERM")
            driven = exercise if is_whole else replace(exercise, mistakes=exercise.mistakes[-1:])
            assert validation.validate_exercise(driven) == []
            continue
        assert validation.validate_exercise(exercise, seeds=50) == []
        if exercise.kind.graded_by_person:
            continue
        assert_points(exercise)
        data = read_check_file(tmp_path / "checks" / f"{master.name}.json").exercise(exercise.id)
        answers = {"stub": exercise.stub, "solution": exercise.solution}
        functions = [(exercise.function_of(source, label), "") for label, source in answers.items()]
        functions += [
            (exercise.function_of(mistake.source, mistake.name, prepared=True), mistake.says)
            for mistake in exercise.mistakes
        ]
        for function, says in functions:
            text = repr(run_cases(exercise, function))
            assert repr(run_check(data, function, searches=False)) == text
            assert says in text


# ---------------------------------------------------------------- without ROS


def files_of(distribution):
    """The names at the top of site-packages that a distribution installs."""
    tops = {Path(file).parts[0] for file in distribution.files or () if Path(file).parts}
    return tops - {"..", "__pycache__"}


@pytest.fixture(scope="session")
def kernel_without_ros(tmp_path_factory):
    """A kernel whose site-packages lack the ROS distributions; its Jupyter folder."""
    home = tmp_path_factory.mktemp("no-ros")
    own_site_packages = Path(sysconfig.get_path("purelib"))
    distributions = list(importlib.metadata.distributions(path=[str(own_site_packages)]))
    ros = set().union(
        *(files_of(distribution) for distribution in distributions if distribution.name.startswith("ros-"))
    )
    site_packages = home / "venv" / own_site_packages.relative_to(sys.prefix)
    site_packages.mkdir(parents=True)
    for entry in own_site_packages.iterdir():
        if entry.name not in ros:
            (site_packages / entry.name).symlink_to(entry)
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
    output = subprocess.run([str(python), "-c", probe], capture_output=True, text=True, check=True)
    assert output.stdout == "None None\n"
    return home / "share" / "jupyter"


# The others are executed as shipped, and import nothing of ROS; so do the other cells of these.
OF_ROS = [path for path in MASTERS if "imgproc_course.ros" in path.read_text(encoding="utf-8")]


def test_the_lessons_run_without_ros(kernel_without_ros, monkeypatch):
    """In one kernel, which takes seconds to start; each lesson begins without the names of the others."""
    monkeypatch.setenv("JUPYTER_PATH", str(kernel_without_ros))
    cells = []
    for master in OF_ROS:
        notebook = nbformat.read(NOTEBOOKS / f"{master.stem}.ipynb", as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        chosen = [code[number] for number in cells_of_ros([cell.source for cell in code])]
        assert any("ros_available()" in cell.source for cell in chosen), master.stem
        cells += [new_code_cell("%reset -f"), *chosen]
    for cell in cells:
        cell.execution_count = None
    modules = {path.name: path.read_text(encoding="utf-8") for path in NOTEBOOKS.glob("*.py")}
    execute(new_notebook(cells=cells), Path("without ROS"), kernel_name="without-ros", files=modules)
    assert all(cell.execution_count for cell in cells)
    printed = "".join(output.get("text", "") for cell in cells for output in cell.outputs)
    assert printed.count("do nothing. environment/site --serve opens the course's pages") == 1
