"""environment/lab's last step: JupyterLab on the learner's lessons; the real one, without a browser."""

import asyncio
import contextlib
import json
import os
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
from nbformat.sign import NotebookNotary
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from imgproc_course import lab
from imgproc_course.lab import LabError, check_own_files, choose_port, lab_arguments, run

RUN = "import sys; from imgproc_course.lab import run; run(sys.argv[1], sys.argv[2:])"
# The same, and it says whether the socket to the browser sends at once.
RUN_AND_TELL = (
    """
import socket
from imgproc_course.lab_websocket import PromptWebsocketConnection as Connection
connect = Connection.connect
def connect_and_tell(self):
    answer = connect(self)
    sends = self.websocket_handler.ws_connection.stream.socket
    print("TCP_NODELAY", sends.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY), flush=True)
    return answer
Connection.connect = connect_and_tell
"""
    + RUN
)


@pytest.fixture
def said():
    return []


@contextlib.contextmanager
def taken(port=0, ip="127.0.0.1"):
    with socket.socket() as server:
        server.bind((ip, port))
        server.listen()
        yield server.getsockname()[1]


def free_port():
    with taken() as port:
        return port


# ---------------------------------------------------------------------------------------- ports


def test_a_free_port_is_taken_without_a_word(said):
    port = free_port()
    assert choose_port(str(port), say=said.append) == port
    assert said == []


def test_a_port_in_use_is_said_and_a_later_one_used(said):
    with taken() as port:
        chosen = choose_port(str(port), say=said.append)
    assert port < chosen <= port + 50
    assert said == [f"Port {port} is in use; JupyterLab uses port {chosen} instead."]


def test_a_port_that_was_just_left_is_free(said):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        with socket.create_connection(("127.0.0.1", port)) as client:
            server.accept()[0].close()  # who closes first keeps the port for a minute, in TIME_WAIT
            assert client.recv(1) == b""
    assert choose_port(str(port), say=said.append) == port
    assert said == []


def test_the_port_is_8888_unless_said(monkeypatch, said):
    monkeypatch.setattr(lab, "_port_trouble", lambda port, ip: None)
    monkeypatch.delenv("JUPYTER_PORT", raising=False)
    assert choose_port(say=said.append) == 8888
    monkeypatch.setenv("JUPYTER_PORT", "9001")
    assert choose_port(say=said.append) == 9001
    assert choose_port("9002", say=said.append) == 9002


def test_a_port_that_is_not_open_to_you(monkeypatch, said):
    monkeypatch.setattr(lab, "_port_trouble", lambda port, ip: "is not open to you" if port < 1024 else None)
    assert choose_port("80", say=said.append) == 8888
    assert said == ["Port 80 is not open to you; JupyterLab uses port 8888 instead."]


def test_fifty_ports_in_use(monkeypatch):
    monkeypatch.setattr(lab, "_port_trouble", lambda port, ip: "is in use")
    with pytest.raises(LabError, match=r"^port 8890 is in use, and so are the 50 after it; name a free one"):
        choose_port("8890")
    with pytest.raises(LabError, match=r"^port 65535 is in use"):
        choose_port("65535")


@pytest.mark.parametrize("port", ["", "no", "-1", "65536", "8888.5"])
def test_a_port_that_is_none(port):
    with pytest.raises(LabError, match=r"is no port; give a number from 1024 to 65535, such as --port 8888$"):
        choose_port(port)


def test_port_zero_lets_the_system_choose(said):
    assert choose_port("0", say=said.append) == 0


def test_an_address_that_cannot_be_looked_up_is_jupyters_to_refuse(said):
    assert choose_port("8899", "no such address", said.append) == 8899


# ---------------------------------------------------------------------------------------- command line


@pytest.fixture
def arguments(monkeypatch, tmp_path):
    monkeypatch.setattr(lab, "_port_trouble", lambda port, ip: None)
    return lambda *options: lab_arguments(tmp_path, list(options), say=lambda _: None)


def test_by_default_it_binds_to_the_loopback_and_asks_nobody_for_news(arguments, tmp_path):
    assert set(arguments()) >= {
        f"--ServerApp.root_dir={tmp_path}",
        "--LabApp.default_url=/lab/tree/00_start_here.ipynb",
        "--ServerApp.ip=127.0.0.1",
        "--ServerApp.port=8888",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    }


@pytest.mark.parametrize(
    "options",
    [
        ["--port", "8891"],
        ["--port=8891"],
        ["--ServerApp.port=8891"],
        ["--port=8890", "--no-browser", "--port", "8891"],
    ],
)
def test_a_port_is_named_once(arguments, options):
    given = arguments(*options)
    assert [word for word in given if re.match(r"--\S*port\b", word)] == ["--ServerApp.port=8891"]
    assert ("--no-browser" in given) == ("--no-browser" in options)


@pytest.mark.parametrize(
    "options",
    [
        ["--ip", "192.0.2.1"],
        ["--ip=192.0.2.1"],
        ["--ServerApp.ip=192.0.2.1"],
        ["--ServerApp.ip", "192.0.2.1"],
    ],
)
def test_the_learners_options_win(arguments, options):
    given = arguments(*options)
    assert "--ServerApp.ip=127.0.0.1" not in given
    assert given[-len(options) :] == options


def test_a_port_is_sought_on_the_address_that_is_used(monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr(lab, "_port_trouble", lambda port, ip: asked.append(ip))
    lab_arguments(tmp_path, ["--ip", "192.0.2.1"], say=print)
    lab_arguments(tmp_path, [], say=print)
    assert asked == ["192.0.2.1", "127.0.0.1"]


@pytest.mark.parametrize("user", [0, 1000])
def test_root_is_allowed_only_when_it_is_root_who_starts(arguments, monkeypatch, user):
    monkeypatch.setattr(os, "geteuid", lambda: user, raising=False)
    assert ("--ServerApp.allow_root=True" in arguments()) == (user == 0)
    assert "--ServerApp.allow_root=True" not in arguments("--allow-root")


def test_a_browser_that_cannot_read_hidden_files_gets_the_address_itself(arguments, monkeypatch):
    assert ("--ServerApp.use_redirect_file=False" in arguments()) == Path("/snap/bin/firefox").exists()
    monkeypatch.setattr(lab.platform, "release", lambda: "5.15.153.1-microsoft-standard-WSL2")
    assert "--ServerApp.use_redirect_file=False" in arguments()


@pytest.mark.parametrize("argv", [["/usr/bin/python3", "-m", "ipykernel_launcher"], []])
def test_another_environments_kernel_is_set_aside(arguments, monkeypatch, tmp_path, argv):
    kernel = tmp_path / "kernels" / "python3"
    kernel.mkdir(parents=True)
    (kernel / "kernel.json").write_text(
        json.dumps({"argv": argv, "display_name": "Other", "language": "python"})
    )
    assert not [word for word in arguments() if "kernel_dirs" in word]
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    assert f"--KernelSpecManager.kernel_dirs={Path(sys.prefix)}/share/jupyter/kernels" in arguments()


def test_looking_for_the_kernel_leaves_the_environment_as_it_was(arguments, monkeypatch):
    monkeypatch.delenv("JUPYTER_PREFER_ENV_PATH", raising=False)
    arguments()
    assert "JUPYTER_PREFER_ENV_PATH" not in os.environ
    monkeypatch.setenv("JUPYTER_PREFER_ENV_PATH", "0")
    arguments()
    assert os.environ["JUPYTER_PREFER_ENV_PATH"] == "0"


# ---------------------------------------------------------------------------------------- what can be wrong


def test_a_home_that_cannot_be_written_is_one_line(monkeypatch, tmp_path):
    (tmp_path / "home").write_text("a file")
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "home" / "runtime"))
    with pytest.raises(LabError, match=r"home folder \(.*\); name a folder that you can write: HOME=FOLDER"):
        check_own_files()


def test_a_home_that_cannot_be_written_is_seen_before_jupyterlab_is(monkeypatch, tmp_path):
    monkeypatch.setattr(lab, "jupyter_runtime_dir", lambda: "/dev/null/runtime")
    monkeypatch.setattr("jupyterlab.labapp.LabApp.launch_instance", lambda _: pytest.fail("started"))
    with pytest.raises(LabError, match="home folder"):
        run(tmp_path)


def test_a_home_on_a_full_disk_is_one_line(monkeypatch, tmp_path):
    def full(**_):
        raise OSError(28, "No space left on device")

    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(lab.tempfile, "TemporaryFile", full)
    with pytest.raises(LabError, match=r"\(No space left on device\); free some space there$"):
        check_own_files()


def test_without_ros_it_starts_and_says_what_will_not_work(monkeypatch, tmp_path, said):
    monkeypatch.setattr(lab.importlib.util, "find_spec", lambda _: None)
    monkeypatch.setattr(lab, "lab_arguments", lambda *_: ["--version"])
    monkeypatch.setattr(lab, "running_on", lambda _: [])
    monkeypatch.setenv("JUPYTER_PREFER_ENV_PATH", "0")
    monkeypatch.setenv("JUPYTER_CONFIG_PATH", "mine")
    started = []
    monkeypatch.setattr("jupyterlab.labapp.LabApp.launch_instance", started.append)
    run(tmp_path, (), said.append)
    assert started == [["--version"]]
    assert os.environ["JUPYTER_PREFER_ENV_PATH"] == "1"
    assert os.environ["JUPYTER_CONFIG_PATH"] == os.pathsep.join([str(lab.OUR_CONFIG), "mine"])
    assert said == [
        "ROS 2 is missing here: everything works from the recording, live topics do not. "
        "environment/pixi.toml says how to get it."
    ]


@pytest.fixture
def no_reach(monkeypatch):
    for name in lab.CHOSEN_REACH:
        monkeypatch.delenv(name, raising=False)
    yield
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE", raising=False)


def test_topics_stay_on_this_machine_unless_said(no_reach, said):
    lab.keep_topics_here(said.append)
    assert os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert said == [
        "ROS topics stay on this machine. To hear a robot: ROS_DOMAIN_ID=THE_ROBOTS environment/lab"
    ]


@pytest.mark.parametrize("chosen", [{"ROS_DOMAIN_ID": "7"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}])
def test_a_reach_that_the_learner_chose_is_kept(no_reach, monkeypatch, said, chosen):
    for name, value in chosen.items():
        monkeypatch.setenv(name, value)
    lab.keep_topics_here(said.append)
    assert {name: os.environ.get(name) for name in lab.CHOSEN_REACH if os.environ.get(name)} == chosen
    assert said == []


def test_lessons_that_were_brought_are_trusted_and_others_are_not(monkeypatch, tmp_path):
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

    def __init__(self, folder, home, *options, run=RUN):
        environment = {**os.environ, "HOME": str(home), "JUPYTER_RUNTIME_DIR": str(home / "runtime")}
        command = [sys.executable, "-c", run, folder, "--no-browser", *options]
        self.log = home / f"log{time.monotonic_ns()}.txt"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(command, env=environment, stdout=log, stderr=log)
        self.url, self.token = self._wait()

    def _wait(self):
        end = time.monotonic() + 120
        while time.monotonic() < end and self.process.poll() is None:
            _, _, told = self.output().partition("To access the server")
            found = re.search(r"(http://127\.0\.0\.1:\d+/)\S*token=(\w+)", told)
            if found:
                return found[1], found[2]
            time.sleep(0.1)
        raise AssertionError(f"no JupyterLab: {self.output()}")

    def output(self):
        return self.log.read_text()

    def get(self, path):
        request = urllib.request.Request(self.url + path, headers={"Authorization": f"token {self.token}"})
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.read().decode()

    def talk_to_a_kernel(self):
        """Starts one, and opens the websocket that a notebook's page opens."""
        headers = {"Authorization": f"token {self.token}"}
        request = urllib.request.Request(self.url + "api/kernels", b"{}", headers)
        with urllib.request.urlopen(request, timeout=60) as answer:
            number = json.load(answer)["id"]
        url = f"{self.url.replace('http', 'ws')}api/kernels/{number}/channels?session_id=one"

        async def meet():
            connection = await websocket_connect(HTTPRequest(url, headers=headers, connect_timeout=60))
            connection.close()

        asyncio.run(meet())

    def listening(self):
        connections = psutil.Process(self.process.pid).net_connections(kind="tcp")
        return {connection.laddr.ip for connection in connections if connection.status == psutil.CONN_LISTEN}

    def stop(self):
        self.process.terminate()
        self.process.wait(30)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("course") / "my_lessons"
    folder.mkdir()
    lesson = {"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / "00_start_here.ipynb").write_text(json.dumps(lesson))
    return folder, tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def server(place):
    server = Server(*place)
    yield server
    server.stop()


def test_it_listens_on_the_loopback_alone(server):
    assert server.listening() == {"127.0.0.1"}


def test_it_opens_at_the_first_lesson(server):
    assert f"{server.url}lab/tree/00_start_here.ipynb?token={server.token}" in server.output()
    listed = json.loads(server.get("api/contents"))["content"]
    assert [entry["name"] for entry in listed] == ["00_start_here.ipynb"]


def test_its_kernel_is_this_environments(server):
    kernels = json.loads(server.get("api/kernelspecs"))
    assert kernels["default"] == "python3"
    assert kernels["kernelspecs"]["python3"]["spec"]["argv"][0] in {"python", sys.executable}


def test_it_asks_for_no_news(server):
    page = server.get("lab")
    config = json.loads(re.search(r'id="jupyter-config-data"[^>]*>(.*?)</script>', page, re.DOTALL)[1])
    assert config["news"] == {"disabled": True}
    assert "@jupyterlab/apputils-extension:announcements" in config["disabledExtensions"]


def test_a_short_message_is_not_held_back_on_its_way_to_the_browser(place):
    server = Server(*place, run=RUN_AND_TELL)
    try:
        server.talk_to_a_kernel()
        end = time.monotonic() + 60
        while "TCP_NODELAY" not in server.output() and time.monotonic() < end:
            time.sleep(0.1)
        assert re.findall(r"TCP_NODELAY (\d)", server.output()) == ["1"]
    finally:
        server.stop()


def test_it_is_quiet(server):
    lines = [line for line in server.output().splitlines() if line.startswith("[")]
    assert all(line.startswith("[C ") for line in lines)


def test_a_second_one_says_where_the_first_is_and_takes_another_port(server, place):
    port = re.search(r":(\d+)/", server.url)[1]
    second = Server(*place, "--port", port)
    try:
        other = re.search(r":(\d+)/", second.url)[1]
        first_lines = second.output().splitlines()[:3]
        assert first_lines == [
            f"JupyterLab is already running on these lessons: {server.url}lab?token={server.token}",
            "This starts a second one; a lesson that is open in both keeps what was saved last.",
            f"Port {port} is in use; JupyterLab uses port {other} instead.",
        ]
        assert json.loads(second.get("api/contents"))["content"][0]["name"] == "00_start_here.ipynb"
    finally:
        second.stop()


def test_one_on_another_folder_is_not_mentioned(server, place, tmp_path, monkeypatch):
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(place[1] / "runtime"))
    assert lab.running_on(tmp_path) == []
    assert lab.running_on(place[0]) == [f"{server.url}lab?token={server.token}"]
