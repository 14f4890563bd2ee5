"""environment/setup: its error messages, and that a second run does nothing."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

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
    shutil.copy(ROOT / "pyproject.toml", root)
    return root


def test_second_run_does_nothing_and_needs_no_network():
    process = run([ROOT / "environment/setup", "test"], PIP_INDEX_URL="http://127.0.0.1:9/", PIP_NO_INDEX="1")
    assert (process.returncode, process.stdout, process.stderr) == (0, "", "")


def test_the_environment_of_the_tests_also_serves_the_lab():
    process = run([ROOT / "environment/setup", "lab"], PIP_INDEX_URL="http://127.0.0.1:9/", PIP_NO_INDEX="1")
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


def test_without_any_python_it_says_what_to_install(checkout, tmp_path):
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("bash", "env", "dirname", "cat", "cksum", "df", "awk", "touch", "sed"):
        (tools / name).symlink_to(shutil.which(name))
    process = run([shutil.which("bash"), checkout / "environment/setup"], PATH=str(tools), PYTHON="")
    assert process.returncode == 1
    assert "no Python 3.11, 3.12 or 3.13 found; install one" in process.stderr
    assert "Traceback" not in process.stderr


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


@pytest.mark.sandbox
def test_a_read_only_folder_is_reported(checkout):
    process = run(
        ["bwrap", "--dev-bind", "/", "/", "--ro-bind", checkout, checkout, checkout / "environment/setup"]
    )
    assert process.returncode == 1
    assert "read-only or full disk?); clone the course to a folder of your own" in process.stderr


@pytest.mark.sandbox
def test_a_disk_that_is_too_small_is_reported_before_any_download(checkout):
    small_disk = [
        "--size",
        str(64 * 2**20),
        "--tmpfs",
        checkout,
        "--ro-bind",
        ROOT / "environment",
        checkout / "environment",
    ]
    process = run(["bwrap", "--dev-bind", "/", "/", *small_disk, checkout / "environment/setup"])
    assert process.returncode == 1
    assert "MB free in" in process.stderr
    assert "2000 MB are needed; free some space and run the same command again" in process.stderr
