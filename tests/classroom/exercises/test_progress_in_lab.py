"""A notebook of a real Jupyter server keeps progress in a learner's folder; nbval and nbconvert do not."""

import json
import os
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import contextmanager

import nbformat
import pytest
from jupyter_client import BlockingKernelClient
from nbclassroom.authoring.masters import read_master
from nbclassroom.exercises.progress import PROGRESS, read_progress
from nbformat.v4 import new_code_cell, new_notebook
from template_master import write_carried_files

CODE = """
from imgproc_course.exercises import check, hint, solution

def double(pixels):
    return pixels * 2

check("test-double", double), hint("test-double"), check("test-double", lambda pixels: 0)
"""
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@pytest.fixture
def folder(write_master, tmp_path):
    """A learner's folder with a notebook and its checks."""
    folder = tmp_path / "my_lessons"
    texts = 'hints=("A?", "B.", "c()"), explanation="It widens.", another_way="You can also write +."'
    hints = f'exercise("test-double", function="double", {texts})\nSIDE = 3'
    path = write_master(exercise=f'# %% role="exercise"\n{hints}')
    write_carried_files(read_master(path), folder)
    (folder / ".course.json").write_text("{}")
    nbformat.write(new_notebook(cells=[new_code_cell(CODE)]), folder / "lesson.ipynb")
    return folder


@contextmanager
def jupyter_server(folder, runtime, environment):
    """Runs a server on a folder; gives its address."""
    options = ["--no-browser", "--port=0", "--ServerApp.token=t", f"--ServerApp.root_dir={folder}"]
    process = subprocess.Popen(
        [sys.executable, "-m", "jupyter_server", "--allow-root", *options], env=environment, **QUIET
    )
    try:
        deadline = time.monotonic() + 60
        # The server makes the file first, and then writes it.
        while not (texts := [text for file in runtime.glob("jpserver-*.json") if (text := file.read_text())]):
            assert process.poll() is None and time.monotonic() < deadline, "the server did not start"
            time.sleep(0.05)
        yield json.loads(texts[0])["url"]
    finally:
        process.terminate()
        process.wait(60)


def post(url, data):
    request = urllib.request.Request(f"{url}?token=t", json.dumps(data).encode(), method="POST")
    for attempt in range(50):
        try:
            with urllib.request.urlopen(request, timeout=60) as response:
                return json.load(response)
        except (ConnectionError, urllib.error.URLError):
            if attempt == 49:
                raise
            time.sleep(0.1)
    return None


def test_a_notebook_of_a_server_keeps_progress(folder, tmp_path):
    runtime = tmp_path / "runtime"
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
    environment |= {"JUPYTER_RUNTIME_DIR": str(runtime), "IPYTHONDIR": str(tmp_path / "ipython")}
    session = {
        "path": "lesson.ipynb",
        "name": "lesson.ipynb",
        "type": "notebook",
        "kernel": {"name": "python3"},
    }
    with jupyter_server(folder, runtime, environment) as url:
        kernel = post(f"{url}api/sessions", session)["kernel"]["id"]
        client = BlockingKernelClient(connection_file=str(runtime / f"kernel-{kernel}.json"))
        client.load_connection_file()
        client.start_channels(hb=False)  # on a busy machine a starting kernel misses heartbeats
        client.wait_for_ready(timeout=60)
        reply = client.execute_interactive(CODE, timeout=60, output_hook=lambda message: None)
        client.stop_channels()
    assert reply["content"]["status"] == "ok"
    progress = read_progress(folder)["test-double"]
    assert (progress.passed, len(progress.tries), progress.hints) == (False, 2, 1)


@pytest.mark.parametrize(
    "command",
    [
        ["pytest", "-q", "-p", "no:cacheprovider", "--nbval-lax", "lesson.ipynb"],
        ["nbconvert", "--to", "notebook", "--execute", "--output", "run.ipynb", "lesson.ipynb"],
    ],
)
def test_nbval_and_nbconvert_keep_none(folder, tmp_path, command):
    environment = os.environ | {"IPYTHONDIR": str(tmp_path / "ipython"), "PYTEST_ADDOPTS": ""}
    if command[0] == "pytest":
        environment["JPY_SESSION_NAME"] = "lesson.ipynb"  # started from a notebook
    else:
        environment.pop("PYTEST_CURRENT_TEST")
    subprocess.run([sys.executable, "-m", *command], cwd=folder, env=environment, check=True, **QUIET)
    assert not (folder / PROGRESS).exists()
