"""environment/setup: what it says when it cannot, and that a second run does nothing."""

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
    """A checkout with no environment made in it yet: only what environment/setup reads."""
    root = tmp_path / "course"
    shutil.copytree(
        ROOT / "environment", root / "environment", ignore=shutil.ignore_patterns("drive", "ros2_ws")
    )
    shutil.copy(ROOT / "pyproject.toml", root)
    return root


def test_second_run_does_nothing_and_needs_no_network():
    done = run([ROOT / "environment/setup", "test"], PIP_INDEX_URL="http://127.0.0.1:9/", PIP_NO_INDEX="1")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_the_tests_environment_serves_the_lab_too():
    done = run([ROOT / "environment/setup", "lab"], PIP_INDEX_URL="http://127.0.0.1:9/", PIP_NO_INDEX="1")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_help_and_unknown_sets_say_how_to_call_it():
    helped = run([ROOT / "environment/setup", "--help"])
    assert helped.returncode == 0
    assert "environment/setup [lab|test]" in helped.stdout
    assert run([ROOT / "environment/setup", "everything"]).returncode == 2


def test_a_python_that_does_not_suit_is_named(checkout):
    done = run([checkout / "environment/setup"], PYTHON="/bin/false")
    assert done.returncode == 1
    assert done.stderr == (
        "environment/setup: PYTHON=/bin/false is not a Python 3.11, 3.12 or 3.13; "
        "unset it or name one that is\n"
    )


def test_without_any_python_it_says_what_to_install(checkout, tmp_path):
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("bash", "env", "dirname", "cat", "cksum", "df", "awk", "touch", "sed"):
        (tools / name).symlink_to(shutil.which(name))
    done = run([shutil.which("bash"), checkout / "environment/setup"], PATH=str(tools), PYTHON="")
    assert done.returncode == 1
    assert "no Python 3.11, 3.12 or 3.13 found; install one" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_index_out_of_reach_is_said_in_one_line(checkout):
    done = run(
        [checkout / "environment/setup"],
        PYTHON=sys.executable,
        PIP_INDEX_URL="http://127.0.0.1:9/",
        PIP_EXTRA_INDEX_URL="",
        PIP_CONFIG_FILE=os.devnull,
        PIP_FIND_LINKS="",
        PIP_RETRIES="0",
    )
    assert done.returncode == 1
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith("environment/setup: the package index was not reached; connect to the network")


@pytest.mark.sandbox
def test_a_read_only_folder_is_said(checkout):
    done = run(
        ["bwrap", "--dev-bind", "/", "/", "--ro-bind", checkout, checkout, checkout / "environment/setup"]
    )
    assert done.returncode == 1
    assert "read-only or full disk?); clone the course to a folder of your own" in done.stderr


@pytest.mark.sandbox
def test_a_disk_that_is_too_small_is_said_before_anything_is_loaded(checkout):
    small = [
        "--size",
        str(64 * 2**20),
        "--tmpfs",
        checkout,
        "--ro-bind",
        ROOT / "environment",
        checkout / "environment",
    ]
    done = run(["bwrap", "--dev-bind", "/", "/", *small, checkout / "environment/setup"])
    assert done.returncode == 1
    assert "MB free in" in done.stderr
    assert "2000 MB are needed; free some space and run the same command again" in done.stderr
