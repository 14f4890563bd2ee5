"""The site, built once in a run of the tests, without a network: for tests/site and tests/browser."""

import fcntl
import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[1]


def built_site(tmp_path_factory):
    """(what the build printed, the folder of the pages). The first worker that needs it builds it."""
    folder = tmp_path_factory.getbasetemp()
    folder = (folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder) / "built-site"
    said = folder / "said.txt"
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not said.exists():
            said.write_text(_build(folder / "site"), encoding="utf-8")
    return said.read_text(encoding="utf-8"), folder / "site" / "html"


def _build(folder):
    subprocess.run(["environment/site", "--packages"], cwd=ROOT, check=True)
    alone = ["bwrap", "--dev-bind", "/", "/", "--unshare-net"] if shutil.which("bwrap") else []
    environment = os.environ | {"SITE": str(folder)}
    command = [*alone, "environment/site", "--check"]
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout + ended.stderr
