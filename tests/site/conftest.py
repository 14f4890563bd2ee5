"""The site, built once for the tests of this folder, without a network."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="package")
def built():
    """(what the build printed, the folder of the pages)."""
    subprocess.run(["environment/site", "--packages"], cwd=ROOT, check=True)
    alone = ["bwrap", "--dev-bind", "/", "/", "--unshare-net"] if shutil.which("bwrap") else []
    command = [*alone, "environment/site", "--check"]
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout + ended.stderr, ROOT / "build/site/html"
