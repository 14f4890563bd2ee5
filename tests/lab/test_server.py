"""environment/lab's last step: JupyterLab on the learner's lessons; the real one, without a browser."""

import asyncio
import json
import logging
import os
import platform
import re
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import nbformat
import psutil
import pytest
from jupyter_client.kernelspec import KernelSpecManager
from jupyter_core.application import JupyterApp
from jupyterlab.labapp import LabApp
from nbclassroom.lab import server as lab
from nbclassroom.lab.server import CourseServer, check_runtime_folder, configure, run
from nbformat.sign import NotebookNotary
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

RUN = "import sys; from nbclassroom.lab.server import run; run(sys.argv[1], sys.argv[2:])"
# As environment/lab starts it; and it prints whether the socket to the browser sends at once.
RUN_AND_PRINT_NODELAY = (
    """
import socket
from nbclassroom.lab.server import PromptWebsocketConnection as Connection
connect = Connection.connect
def connect_and_print(self):
    result = connect(self)
    stream_socket = self.websocket_handler.ws_connection.stream.socket
    print("TCP_NODELAY", stream_socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY), flush=True)
    return result
Connection.connect = connect_and_print
"""
    + RUN
)


@pytest.fixture
def lines():
    """What the learner is told, line by line."""
    return []


# ---------------------------------------------------------------------------------------- configuration


@pytest.fixture
def configured(monkeypatch, tmp_path):
    """Function of JupyterLab's options: the server and LabApp as Jupyter itself configures them."""
    for variable in ("JUPYTER_CONFIG_PATH", "JUPYTER_PATH", "NBCLASSROOM_LESSONS", "JUPYTER_PORT"):
        monkeypatch.setenv(variable, "")  # restores what `configure` sets
        monkeypatch.delenv(variable)
    monkeypatch.setenv("JUPYTER_CONFIG_DIR", str(tmp_path / "config"))

    def initialize(*options):
        configure(tmp_path)
        server = CourseServer()
        JupyterApp.initialize(server, list(options))
        return server, LabApp(config=server.config)

    return initialize


def test_it_serves_this_computer_alone_and_asks_nobody_for_news(configured, tmp_path):
    server, lab_app = configured()
    assert (server.ip, server.port, server.root_dir) == ("127.0.0.1", 8888, str(tmp_path))
    assert lab_app.default_url == "/lab/tree/index.ipynb"
    assert lab_app.news_url is None
    assert lab_app.check_for_updates_class.__name__ == "NeverCheckForUpdate"
    assert server.kernel_websocket_connection_class.__name__ == "PromptWebsocketConnection"
    assert server.log_level == logging.WARNING


@pytest.mark.parametrize(
    ("options", "name", "value"),
    [
        (["--ip", "192.0.2.1"], "ip", "192.0.2.1"),
        (["--ServerApp.ip=192.0.2.1"], "ip", "192.0.2.1"),
        (["--port", "8891"], "port", 8891),
        (["--ServerApp.port=8891", "--no-browser"], "port", 8891),
        (["--ServerApp.root_dir=/"], "root_dir", "/"),
        (["--log-level=INFO"], "log_level", logging.INFO),
    ],
)
def test_the_learners_options_win(configured, options, name, value):
    server, _ = configured(*options)
    assert getattr(server, name) == value


def test_the_configuration_in_the_home_folder_does_not_open_the_lessons_to_others(configured, tmp_path):
    (tmp_path / "config").mkdir()
    own = {"ServerApp": {"ip": "0.0.0.0", "port": 9001, "root_dir": "/"}}
    (tmp_path / "config" / "jupyter_server_config.json").write_text(json.dumps(own))
    server, _ = configured()
    assert (server.ip, server.port, server.root_dir) == ("127.0.0.1", 9001, str(tmp_path))


def test_the_port_of_the_environment_variable_is_used(configured, monkeypatch):
    monkeypatch.setenv("JUPYTER_PORT", "9001")
    assert configured()[0].port == 9001
    assert configured("--port=9002")[0].port == 9002


@pytest.mark.parametrize("user", [0, 1000])
def test_root_is_allowed_only_if_root_starts_it(configured, monkeypatch, user):
    monkeypatch.setattr(os, "geteuid", lambda: user, raising=False)
    assert configured()[0].allow_root == (user == 0)
    assert configured("--allow-root")[0].allow_root is True


def test_a_browser_that_cannot_read_hidden_files_gets_the_address_itself(configured, monkeypatch):
    monkeypatch.setattr(platform, "release", lambda: "6.8.0-generic")
    assert configured()[0].use_redirect_file is not Path("/snap/bin/firefox").exists()
    monkeypatch.setattr(platform, "release", lambda: "5.15.153.1-microsoft-standard-WSL2")
    assert configured()[0].use_redirect_file is False


def test_another_environments_python3_does_not_hide_ours_and_its_other_kernels_stay(
    configured, monkeypatch, tmp_path
):
    for name in ("python3", "octave"):
        kernel = tmp_path / "kernels" / name
        kernel.mkdir(parents=True)
        specification = {"argv": ["/usr/bin/other"], "display_name": name, "language": name}
        (kernel / "kernel.json").write_text(json.dumps(specification))
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    configured()
    manager = KernelSpecManager()
    assert manager.get_kernel_spec("python3").argv[0] in {"python", "python3", sys.executable}
    assert manager.get_kernel_spec("octave").argv == ["/usr/bin/other"]


def test_the_learners_configuration_path_is_kept_behind_ours(configured, monkeypatch):
    monkeypatch.setenv("JUPYTER_CONFIG_PATH", "mine")
    configured()
    assert os.environ["JUPYTER_CONFIG_PATH"] == os.pathsep.join([str(lab.CONFIGURATION), "mine"])


# ---------------------------------------------------------------------------------------- what can be wrong


def test_a_home_that_cannot_be_written_is_reported_in_one_line(monkeypatch, tmp_path):
    (tmp_path / "home").write_text("a file")
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "home" / "runtime"))
    with pytest.raises(
        ValueError, match=r"home folder \(.*\); name a folder that you can write: HOME=FOLDER"
    ):
        check_runtime_folder()


def test_a_home_that_cannot_be_written_stops_it_before_jupyterlab_starts(monkeypatch, tmp_path):
    monkeypatch.setattr(lab, "jupyter_runtime_dir", lambda: "/dev/null/runtime")
    monkeypatch.setattr("jupyterlab.labapp.LabApp.launch_instance", lambda _: pytest.fail("started"))
    with pytest.raises(ValueError, match="home folder"):
        run(tmp_path)


def test_a_home_on_a_full_disk_is_reported_in_one_line(monkeypatch, tmp_path):
    def full(**_):
        raise OSError(28, "No space left on device")

    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(lab.tempfile, "TemporaryFile", full)
    with pytest.raises(ValueError, match=r"\(No space left on device\); free some space there$"):
        check_runtime_folder()


def test_what_the_course_prepares_is_done_before_jupyterlab_starts(configured, monkeypatch, tmp_path, lines):
    monkeypatch.setattr(lab.course, "load", lambda place: lambda say: say(f"{place} runs"))
    monkeypatch.setattr(lab, "running_on", lambda _: [])
    monkeypatch.setattr("jupyterlab.labapp.LabApp.launch_instance", lambda options: lines.append(options))
    run(tmp_path, ("--version",), lines.append)
    assert lines == ["imgproc_course.ros_domain:prepare_lab runs", ["--version"]]


def test_signed_lessons_are_trusted_and_others_are_not(monkeypatch, tmp_path):
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "data"))
    output = nbformat.v4.new_output("display_data", {"text/html": "<b>x</b>"})
    for name in ("ours", "other"):
        cell = nbformat.v4.new_code_cell(name, outputs=[output], id="a")
        nbformat.write(nbformat.v4.new_notebook(cells=[cell]), tmp_path / f"{name}.ipynb")
    lab.trust([tmp_path / "ours.ipynb"])
    notary = NotebookNotary()
    notebooks = [nbformat.read(tmp_path / name, as_version=4) for name in ("ours.ipynb", "other.ipynb")]
    assert [notary.check_signature(notebook) for notebook in notebooks] == [True, False]
    notary.store.close()


def test_a_list_of_servers_that_cannot_be_read_stops_nothing(monkeypatch, tmp_path):
    def refuse():
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(lab, "list_running_servers", refuse)
    assert lab.running_on(tmp_path) == []


# ---------------------------------------------------------------------------------------- the real one


class Server:
    """A JupyterLab of the course on a folder, in a home of its own."""

    def __init__(self, folder, home, *options):
        environment = {**os.environ, "HOME": str(home), "JUPYTER_RUNTIME_DIR": str(home / "runtime")}
        command = [sys.executable, "-c", RUN_AND_PRINT_NODELAY, folder, "--no-browser", *options]
        self.log = home / f"log{time.monotonic_ns()}.txt"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(command, env=environment, stdout=log, stderr=log)
        self.url, self.token = self._wait()

    def _wait(self):
        end = time.monotonic() + 120
        while time.monotonic() < end and self.process.poll() is None:
            _, _, address = self.output().partition("To access the server")
            match = re.search(r"(http://127\.0\.0\.1:\d+/)\S*token=(\w+)", address)
            if match:
                return match[1], match[2]
            time.sleep(0.1)
        raise AssertionError(f"no JupyterLab: {self.output()}")

    def output(self):
        return self.log.read_text()

    def get(self, path):
        request = urllib.request.Request(self.url + path, headers={"Authorization": f"token {self.token}"})
        with urllib.request.urlopen(request, timeout=60) as response:
            return response.read().decode()

    def connect_to_a_kernel(self):
        """Starts a kernel, and opens the websocket that a notebook's page opens."""
        headers = {"Authorization": f"token {self.token}"}
        request = urllib.request.Request(self.url + "api/kernels", b"{}", headers)
        with urllib.request.urlopen(request, timeout=60) as response:
            kernel_id = json.load(response)["id"]
        url = f"{self.url.replace('http', 'ws')}api/kernels/{kernel_id}/channels?session_id=one"

        async def connect():
            connection = await websocket_connect(HTTPRequest(url, headers=headers, connect_timeout=60))
            connection.close()

        asyncio.run(connect())

    def listening(self):
        connections = psutil.Process(self.process.pid).net_connections(kind="tcp")
        return {connection.laddr.ip for connection in connections if connection.status == psutil.CONN_LISTEN}

    def stop(self):
        self.process.terminate()
        self.process.wait(60)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    folder = tmp_path_factory.mktemp("course") / "my_lessons"
    folder.mkdir()
    lesson = {"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / "index.ipynb").write_text(json.dumps(lesson))
    return folder, tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def server(folders):
    server = Server(*folders)
    yield server
    server.stop()


def test_it_listens_on_the_loopback_alone(server):
    assert server.listening() == {"127.0.0.1"}


def test_it_opens_at_the_index(server):
    assert f"{server.url}lab/tree/index.ipynb?token={server.token}" in server.output()
    contents = json.loads(server.get("api/contents"))["content"]
    assert [entry["name"] for entry in contents] == ["index.ipynb"]


def test_its_kernel_is_this_environments(server):
    kernels = json.loads(server.get("api/kernelspecs"))
    assert kernels["default"] == "python3"
    assert kernels["kernelspecs"]["python3"]["spec"]["argv"][0] in {"python", sys.executable}


def test_it_asks_for_no_news(server):
    page = server.get("lab")
    config = json.loads(re.search(r'id="jupyter-config-data"[^>]*>(.*?)</script>', page, re.DOTALL)[1])
    assert config["news"] == {"disabled": True}
    assert "@jupyterlab/apputils-extension:announcements" in config["disabledExtensions"]


def test_it_is_quiet(server):
    lines = [line for line in server.output().splitlines() if line.startswith("[")]
    assert all(line.startswith("[C ") for line in lines)


def test_a_short_message_is_not_held_back_on_its_way_to_the_browser(server):
    server.connect_to_a_kernel()
    end = time.monotonic() + 60
    while "TCP_NODELAY" not in server.output() and time.monotonic() < end:
        time.sleep(0.1)
    assert re.findall(r"TCP_NODELAY (\d)", server.output()) == ["1"]
    assert "websocket_ping" not in server.output()  # no warning of Tornado


def test_a_second_one_names_the_first_and_takes_another_port(server, folders):
    port = re.search(r":(\d+)/", server.url)[1]
    second = Server(*folders, "--port", port)
    try:
        second_port = re.search(r":(\d+)/", second.url)[1]
        first_lines = second.output().splitlines()[:3]
        assert first_lines == [
            f"JupyterLab is already running on these lessons: {server.url}lab?token={server.token}",
            "This starts a second one. If a lesson is open in both, the last save wins.",
            f"Port {port} is not free; JupyterLab uses port {second_port} instead.",
        ]
        assert json.loads(second.get("api/contents"))["content"][0]["name"] == "index.ipynb"
    finally:
        second.stop()


def test_if_no_port_is_free_it_ends_and_says_what_to_do(folders):
    folder, home = folders
    with socket.create_server(("127.0.0.1", 0)) as other_program:
        port = other_program.getsockname()[1]
        result = subprocess.run(
            [sys.executable, "-c", RUN, folder, "--no-browser", f"--port={port}", "--port-retries=0"],
            env={**os.environ, "HOME": str(home), "JUPYTER_RUNTIME_DIR": str(home / "runtime")},
            capture_output=True,
            text=True,
            timeout=120,
        )
    assert result.returncode == 1
    assert result.stdout.splitlines()[-1] == (
        f"Port {port} belongs to another program, or only root may use it. Give another one: "
        "environment/lab --port 8890 (or 0: any that is free)"
    )


def test_one_on_another_folder_is_not_mentioned(server, folders, tmp_path, monkeypatch):
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(folders[1] / "runtime"))
    assert lab.running_on(tmp_path) == []
    assert lab.running_on(folders[0]) == [f"{server.url}lab?token={server.token}"]


def test_a_number_that_is_not_a_port_is_refused_in_one_line(configured, capsys):
    with pytest.raises(SystemExit):
        configured("--port=65536")
    assert capsys.readouterr().err.count("--port 65536 is not a port") == 1
