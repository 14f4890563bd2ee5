"""The site, built once for the tests of this folder, without a network."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "docs/_ext"))


@pytest.fixture(scope="package")
def built(tmp_path_factory):
    """(what the build printed, the folder of the pages)."""
    folder = tmp_path_factory.mktemp("site")
    subprocess.run(["environment/site", "--packages"], cwd=ROOT, check=True)
    alone = ["bwrap", "--dev-bind", "/", "/", "--unshare-net"] if shutil.which("bwrap") else []
    command = [*alone, "environment/site", "--check"]
    environment = os.environ | {"SITE": str(folder)}
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout + ended.stderr, folder / "html"
