"""Starts JupyterLab on the learner's lessons: loopback only, quiet, with the kernel of this environment."""

import contextlib
import errno
import functools
import importlib.util
import os
import platform
import re
import socket
import sys
import tempfile
from pathlib import Path

import nbformat
from jupyter_client.kernelspec import KernelSpecManager, NoSuchKernel
from jupyter_core.paths import jupyter_runtime_dir
from jupyter_server.serverapp import list_running_servers
from nbformat.sign import NotebookNotary

from imgproc_course.working_copies import CHECKOUT, bring_lessons

LOOPBACK = "127.0.0.1"
DEFAULT_PORT = 8888
PORTS_TO_TRY = 50
FIRST_LESSON = "00_start_here.ipynb"
PORT_OPTION = re.compile(r"--(?:ServerApp\.)?port(?:=(.*))?$")
OUR_CONFIG = Path(__file__).with_name("jupyter_config")
ALIASES = {"root_dir": ["notebook-dir"], "log_level": ["debug"]}
CHOSEN_REACH = ("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY", "ROS_STATIC_PEERS")
OUR_PYTHON = {"python", "python3", f"python3.{sys.version_info.minor}", sys.executable}


say_now = functools.partial(print, flush=True)  # before JupyterLab's own lines, also in a log file


class LabError(Exception):
    """JupyterLab cannot be started; the text is one line that says what to do."""


def start(options=(), say=say_now):
    """Brings the lessons into my_lessons/, then runs JupyterLab there until it is shut down.

    Parameters
    ----------
    options : options for JupyterLab, as on its command line
    say : called with each line for the learner

    Raises
    ------
    LessonsError, LabError : one line that says what to do
    """
    lessons = CHECKOUT / "my_lessons"
    brought = bring_lessons(target=lessons)
    for line in brought.lines():
        say(line)
    check_own_files()
    trust([lessons / name for name in brought.written if name.endswith(".ipynb")])
    run(lessons, options, say)


def trust(notebooks):
    """Tells Jupyter that these notebooks are ours, so that it shows their stored figures as they are."""
    notary = NotebookNotary()
    for path in notebooks:
        notary.sign(nbformat.read(path, as_version=4))
    notary.store.close()


def run(folder, options=(), say=say_now):
    """Runs JupyterLab on a folder until it is shut down; `options` go on to it."""
    check_own_files()
    if importlib.util.find_spec("rclpy") is None:
        say(
            "ROS 2 is missing here: everything works from the recording, live topics do not. "
            "environment/pixi.toml says how to get it."
        )
    else:
        keep_topics_here(say)
    for url in running_on(folder):
        say(f"JupyterLab is already running on these lessons: {url}")
        say("This starts a second one; a lesson that is open in both keeps what was saved last.")
    arguments = lab_arguments(folder, list(options), say)
    # A kernel named python3 in the learner's home would hide this environment's, which has the course.
    os.environ["JUPYTER_PREFER_ENV_PATH"] = "1"
    # No question whether to fetch news; the settings in the learner's home stay as they are.
    others = os.environ.get("JUPYTER_CONFIG_PATH")
    os.environ["JUPYTER_CONFIG_PATH"] = os.pathsep.join([str(OUR_CONFIG), *([others] if others else [])])
    from jupyterlab.labapp import LabApp

    LabApp.launch_instance(arguments)


def keep_topics_here(say=say_now):
    """Keeps the lessons' topics on this machine, unless the learner chose a domain or a range.

    Everybody of a classroom is on domain 0 at first, and would get the pictures of all the others.
    """
    if not any(os.environ.get(name) for name in CHOSEN_REACH):
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        say("ROS topics stay on this machine. To hear a robot: ROS_DOMAIN_ID=THE_ROBOTS environment/lab")


def lab_arguments(folder, options, say=say_now):
    """JupyterLab's command line: a free port, and ours where the learner's options say nothing."""
    options, wanted = _take_port(options)
    ours = {
        "root_dir": f"--ServerApp.root_dir={folder}",
        "default_url": f"--LabApp.default_url=/lab/tree/{FIRST_LESSON}",
        "ip": f"--ServerApp.ip={LOOPBACK}",
        "log_level": "--Application.log_level=WARN",  # the address is told all the same
        # Nothing is asked of any server but this one.
        "news_url": "--LabApp.news_url=None",
        # A picture follows its slider at once, not 40 ms later.
        "kernel_websocket_connection_class": "--ServerApp.kernel_websocket_connection_class="
        "imgproc_course.lab_websocket.PromptWebsocketConnection",
        "check_for_updates_class": "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    }
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        ours["allow_root"] = "--ServerApp.allow_root=True"
    if not _browser_reads_hidden_files():
        ours["use_redirect_file"] = "--ServerApp.use_redirect_file=False"
    if not _kernel_is_ours():
        kernels = Path(sys.prefix) / "share" / "jupyter" / "kernels"
        ours["kernel_dirs"] = f"--KernelSpecManager.kernel_dirs={kernels}"
    if _value_of("sock", options) is None:
        ip = _value_of("ip", options) or LOOPBACK
        ours["port"] = f"--ServerApp.port={choose_port(wanted, ip, say)}"
    return [argument for name, argument in ours.items() if _value_of(name, options) is None] + options


def choose_port(wanted=None, ip=LOOPBACK, say=say_now):
    """A port that is free: the wanted one (8888 unless said), else a later one, and then it is said.

    Raises
    ------
    LabError : the wanted port is none, or all that were tried are taken
    """
    named = os.environ.get("JUPYTER_PORT", DEFAULT_PORT) if wanted is None else wanted
    try:
        first = int(named)
    except ValueError:
        first = -1
    if not 0 <= first <= 65535:
        raise LabError(
            f"--port {named} is no port; give a number from 1024 to 65535, such as --port {DEFAULT_PORT}"
        )
    trouble = _port_trouble(first, ip)
    if trouble is None:
        return first
    after = first if trouble == "is in use" else DEFAULT_PORT - 1
    for port in range(after + 1, min(after + 1 + PORTS_TO_TRY, 65536)):
        if _port_trouble(port, ip) is None:
            say(f"Port {first} {trouble}; JupyterLab uses port {port} instead.")
            return port
    raise LabError(
        f"port {first} {trouble}, and so are the {PORTS_TO_TRY} after it; name a free one with --port N"
    )


def _port_trouble(port, ip):
    """Why a server cannot listen on the port; None when it can."""
    try:
        found = socket.getaddrinfo(ip or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    except OSError:
        return None  # JupyterLab says better than we could what is wrong with the address
    for family, kind, protocol, _, address in found:
        with contextlib.suppress(OSError), socket.socket(family, kind, protocol) as probe:
            if os.name == "posix":  # as Jupyter's own server does: a port just left is free
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(address)
            except OSError as error:
                if error.errno == errno.EADDRINUSE:
                    return "is in use"
                if error.errno == errno.EACCES:
                    return "is not open to you"
    return None


def running_on(folder):
    """URLs of the JupyterLabs that run on this folder already."""
    try:
        servers = list(list_running_servers())
    except OSError:
        return []
    return [
        f"{server['url']}lab?token={server.get('token', '')}"
        for server in servers
        if _same_folder(server.get("root_dir", ""), folder)
    ]


def _same_folder(one, other):
    try:
        return Path(one).samefile(other)
    except OSError:
        return False


def check_own_files():
    """JupyterLab keeps its running state in the home folder: without that it would end in a traceback."""
    folder = Path(jupyter_runtime_dir())
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(4096))
    except OSError as error:
        full = error.errno in (errno.ENOSPC, errno.EDQUOT)
        raise LabError(
            f"JupyterLab cannot keep its running state in your home folder ({error.strerror}); "
            + (
                "free some space there"
                if full
                else "name a folder that you can write: HOME=FOLDER environment/lab"
            )
        ) from error


def _take_port(options):
    """The options without those that name a port, and the port that the last of them names."""
    left, port, words = [], None, iter(options)
    for word in words:
        match = PORT_OPTION.match(word)
        if match is None:
            left.append(word)
        else:
            port = match[1] if match[1] is not None else next(words, "")
    return left, port


def _value_of(name, options):
    """What the options give for a setting (--ip=A, --ip A, --ServerApp.ip=A, --allow-root), or None."""
    names = {name.replace("_", "-"), *ALIASES.get(name, ())}
    for i, word in enumerate(options):
        option, equals, value = word.partition("=")
        if option.startswith("--") and (option[2:] in names or option.endswith(f".{name}")):
            return value if equals else "".join(options[i + 1 : i + 2])
    return None


def _browser_reads_hidden_files():
    """Jupyter hands the browser a file in a hidden folder; a snap's, and Windows' under WSL, refuse it."""
    return not (Path("/snap/bin/firefox").exists() or "microsoft" in platform.release().lower())


def _kernel_is_ours():
    """Whether the kernel that the lessons name is this environment's, once the environment comes first."""
    with _environment_first():
        try:
            return KernelSpecManager().get_kernel_spec("python3").argv[0] in OUR_PYTHON
        except (NoSuchKernel, IndexError):
            return False


@contextlib.contextmanager
def _environment_first():
    former = os.environ.get("JUPYTER_PREFER_ENV_PATH")
    os.environ["JUPYTER_PREFER_ENV_PATH"] = "1"
    try:
        yield
    finally:
        if former is None:
            del os.environ["JUPYTER_PREFER_ENV_PATH"]
        else:
            os.environ["JUPYTER_PREFER_ENV_PATH"] = former
