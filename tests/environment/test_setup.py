"""environment/setup: its error messages, and that a second run does nothing; files for other systems."""

import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]


def run(command, **changes):
    env = {**os.environ, **{k: v for k, v in changes.items() if v is not None}}
    return subprocess.run([str(c) for c in command], env=env, capture_output=True, text=True, timeout=240)


@pytest.fixture
def checkout(tmp_path):
    """A checkout without an environment: only the files that environment/setup reads."""
    root = tmp_path / "course"
    shutil.copytree(
        ROOT / "environment", root / "environment", ignore=shutil.ignore_patterns("drive", "ros2_ws")
    )
    (root / "nbclassroom").mkdir()
    for name in ("pyproject.toml", "nbclassroom/pyproject.toml"):
        shutil.copy(ROOT / name, root / name)
    return root


@pytest.mark.parametrize("name", ["test", "lab"])  # the environment of the tests also serves the lab
def test_second_run_does_nothing_and_needs_no_network(tmp_path, name):
    (tmp_path / "link").symlink_to(ROOT)
    command = [tmp_path / "link/environment/setup", name]
    process = run(command, PIP_INDEX_URL="http://127.0.0.1:9/", PIP_NO_INDEX="1")
    assert (process.returncode, process.stdout, process.stderr) == (0, "", "")


def test_help_and_an_unknown_set_print_the_usage():
    process = run([ROOT / "environment/setup", "--help"])
    assert process.returncode == 0
    assert "environment/setup [lab|test|class]" in process.stdout
    assert run([ROOT / "environment/setup", "everything"]).returncode == 2


def test_an_unsupported_python_is_named(checkout):
    process = run([checkout / "environment/setup"], PYTHON="/bin/false")
    assert process.returncode == 1
    assert process.stderr == (
        "environment/setup: PYTHON=/bin/false is not a Python 3.11, 3.12 or 3.13; "
        "unset it or give a path to one\n"
    )


TOOLS = "bash cat cksum date df dirname awk env grep ln mkdir rm sed tail tee touch"


def set_up(checkout, programs, **variables):
    """Runs environment/setup with TOOLS and the programs, {path in the home folder: shell script}, alone."""
    home = checkout.parent / "home"
    (home / ".local/bin").mkdir(parents=True)
    for name in TOOLS.split():
        (home / name).symlink_to(shutil.which(name))
    for name, script in programs.items():
        (home / name).write_text(f"#!/bin/sh\n{script}")
        (home / name).chmod(0o755)
    variables |= {"PATH": str(home), "HOME": str(home), "PYTHON": ""}
    return run([home / "bash", checkout / "environment/setup"], **variables)


TOO_NEW = 'case "$2" in *version_info*) exit 1 ;; esac; echo Python 3.14.0'
NO_VENV = 'case "$2" in *ensurepip*) exit 1 ;; esac; echo Python 3.12.3'


@pytest.mark.parametrize(
    ("programs", "problem", "way"),
    [
        ({}, "(python3: none)", "curl -LsSf https://astral.sh/uv/install.sh | sh && ~/.local/bin/uv"),
        ({"python3": TOO_NEW}, "(python3: Python 3.14.0)", "~/.uv/bin/pip install uv && ~/.uv/bin/uv"),
        ({"python3": TOO_NEW, "uv": ""}, "(python3: Python 3.14.0)", "without root like this: uv"),
        ({"python3": NO_VENV}, "Python 3.12.3 has no venv", "install.sh | sh && ~/.local/bin/uv"),
    ],
)
def test_without_a_python_it_says_how_to_install_one_without_root(checkout, programs, problem, way):
    process = set_up(checkout, programs)
    assert (process.returncode, process.stderr.count("\n")) == (1, 1)
    assert problem in process.stderr
    assert f"{way} python install 3.13; then run the same command again" in process.stderr


RECORDER = """
echo "$*" "$PIP_USER$PIP_TARGET$PYTHONPATH$PYTHONHOME" >>"$LOG"
case "$2" in venv) mkdir -p "$3/bin" && ln -s "$0" "$3/bin/python" ;; esac"""


@pytest.mark.parametrize(("installer", "files"), [("pip", "pip lab"), ("uv", "pip uv lab")])
def test_a_pinned_pip_installs_whatever_the_users_variables_say(checkout, installer, files):
    python = {".local/bin/python3.13": RECORDER}  # where uv installs one
    log = checkout / "log"
    variables = {"PIP_USER": "1", "PIP_TARGET": "/x", "PYTHONPATH": "/y", "PYTHONHOME": "/z"}
    process = set_up(checkout, python, COURSE_INSTALLER=installer, LOG=str(log), **variables)
    assert process.returncode == 0, process.stderr
    *lines, editable = re.findall(r"-m pip .*", log.read_text())
    assert [re.search(r"requirements-(\w+)", line)[1] for line in lines] == files.split()
    assert {line.rpartition(" ")[2] for line in [*lines, editable]} == {"0"}


@pytest.mark.parametrize(
    ("folder", "problem"),
    [
        ("a b", "has a space"),
        ("$a", "has a space"),
        ("a" * 99, "is longer"),
        ("a:b", "has a colon"),
        ("ö", ""),
    ],
)
def test_a_path_in_which_ros_packages_do_not_start_is_named(checkout, tmp_path, folder, problem):
    (tmp_path / folder).mkdir()
    root = checkout.rename(tmp_path / folder / "course")
    process = run([root / "environment/setup"], PYTHON="/bin/false")
    text = process.stdout + process.stderr.partition("environment/setup: PYTHON=")[0]
    assert [f"checkout {problem}" in text, str(root) in text, "move the" in text] == [bool(problem)] * 3


def test_an_unreachable_index_is_reported_in_one_line(checkout):
    process = run(
        [checkout / "environment/setup"],
        PYTHON=sys.executable,
        PIP_INDEX_URL="http://127.0.0.1:9/",
        PIP_EXTRA_INDEX_URL="",
        PIP_CONFIG_FILE=os.devnull,
        PIP_FIND_LINKS="",
        PIP_RETRIES="0",
    )
    assert process.returncode == 1
    last_line = process.stderr.strip().splitlines()[-1]
    assert last_line.startswith(
        "environment/setup: the package index cannot be reached; connect to the network"
    )


PYTHON = f"python3.{sys.version_info.minor}"
ROS = f"/ros/lib/{PYTHON}/site-packages:/ros/local/lib/{PYTHON}/dist-packages"


@pytest.mark.parametrize(
    ("dropped", "kept", "ament", "libraries"),
    [
        ("/x", "", "", "/ros/lib"),
        ("/x", ROS, "/a:/ros", "/ros/lib"),
        (ROS, "", "", "/ros/lib"),  # it was not sourced
        ("/ros/lib/python2.7/site-packages", "", "/ros", ""),
    ],
)
def test_of_pythonpath_the_lab_keeps_a_sourced_ros_for_its_python(dropped, kept, ament, libraries):
    script = 'venv=$0; . "$1"; printf "%s\\n" "${PYTHONPATH-}" "${LD_LIBRARY_PATH-}" "${PYTHONHOME-}"'
    variables = {"AMENT_PREFIX_PATH": ament, "LD_LIBRARY_PATH": "/ros/lib", "PYTHONHOME": "/z"}
    command = ["bash", "-euc", script, sys.prefix, ROOT / "environment/variables"]
    process = run(command, PYTHONPATH=f"{dropped}:{kept}".strip(":"), **variables)
    message, *values = process.stdout.splitlines()
    assert message.startswith(f"The course does not use {dropped} of PYTHONPATH")
    assert values == [kept, libraries, ""]


def test_a_package_in_pythonpath_does_not_stop_the_lab(tmp_path):
    (tmp_path / "click.py").write_text("raise ImportError('built for another Python')")
    process = run([ROOT / "environment/lab", "--help"], PYTHONPATH=str(tmp_path), PYTHONHOME="/nowhere")
    assert process.returncode == 0, process.stderr
    assert f"The course does not use {tmp_path} of PYTHONPATH" in process.stdout


def test_nbval_runs_a_lesson_without_the_plugins_of_the_tests(tmp_path):
    output = nbformat.v4.new_output("stream", text="42\n")
    cell = nbformat.v4.new_code_cell("print(6 * 7)", execution_count=1, outputs=[output])
    kernel = {"name": "python3", "display_name": "Python 3"}
    lesson = nbformat.v4.new_notebook(cells=[cell], metadata={"kernelspec": kernel})
    nbformat.write(lesson, tmp_path / "lesson.ipynb")
    plugins = [f"-pno:{name}" for name in ("timeout", "xdist", "hypothesispytest", "rerunfailures")]
    options = [*plugins, "-pno:cacheprovider", "-c", ROOT / "pyproject.toml", "--nbval", tmp_path]
    process = run([sys.executable, "-m", "pytest", *options])
    assert "1 passed" in process.stdout, process.stdout + process.stderr


@pytest.mark.ros
def test_pixi_installs_every_ros_package_that_the_course_imports():
    owners = importlib.metadata.packages_distributions()
    files = [
        path
        for folder in ("imgproc_course", "nbclassroom", "notebooks")
        for path in (ROOT / folder).rglob("*.py")
    ]
    text = "\n".join(path.read_text(encoding="utf-8") for path in files)
    modules = set(re.findall(r"^\s*(?:from|import) (\w+)", text, re.MULTILINE))
    modules = {name for name in modules if any(owner.startswith("ros-") for owner in owners.get(name, ()))}
    names = tomllib.loads((ROOT / "environment/pixi.toml").read_text())["dependencies"]
    installed = {name.removeprefix("ros-jazzy-") for name in names if name.startswith("ros-")}
    assert installed == {name.replace("_", "-") for name in modules} | {"rmw-fastrtps-cpp"}


def test_the_container_gets_nothing_that_git_ignores():
    patterns = (ROOT / ".gitignore").read_text().splitlines()
    # Both read these alike: a path from the root whose * stops at a slash. Docker needs **/ for any depth.
    assert all(re.fullmatch(r"[\w.*/-]+", pattern) and "**" not in pattern for pattern in patterns)
    expected = [pattern if pattern.startswith("/") else f"**/{pattern}" for pattern in patterns]
    assert (ROOT / ".dockerignore").read_text().splitlines()[1:] == expected


@pytest.mark.parametrize("file", ["environment/Dockerfile", "environment/class/README.md", "binder/apt.txt"])
def test_what_the_room_needs_of_the_system_is_installed_or_named(file):
    assert re.search(r"\blibx11-6\b", (ROOT / file).read_text())


@pytest.mark.sandbox
def test_a_read_only_folder_is_reported(checkout):
    process = run(
        ["bwrap", "--dev-bind", "/", "/", "--ro-bind", checkout, checkout, checkout / "environment/setup"]
    )
    assert process.returncode == 1
    assert "read-only or full disk?); clone the course to a folder of your own" in process.stderr


@pytest.mark.sandbox
def test_a_disk_that_is_too_small_is_reported_before_any_download(checkout):
    mounts = ["--tmpfs", checkout, "--ro-bind", ROOT / "environment", checkout / "environment"]
    small_disk = ["--size", str(64 * 2**20), *mounts]
    process = run(["bwrap", "--dev-bind", "/", "/", *small_disk, checkout / "environment/setup"])
    assert process.returncode == 1
    assert "MB free in" in process.stderr
    assert "2000 MB are needed; free some space and run the same command again" in process.stderr
