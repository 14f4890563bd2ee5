"""Starts JupyterLab on the learner's lessons, with the configuration in jupyter_config/."""

import errno
import functools
import os
import sys
import tempfile
from pathlib import Path

import nbformat
from jupyter_core.paths import jupyter_runtime_dir
from jupyter_server.serverapp import ServerApp, list_running_servers
from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection
from nbformat.sign import NotebookNotary
from traitlets import TraitError, default, validate

from nbclassroom import course
from nbclassroom.lab.working_copies import update_lessons

CONFIGURATION = Path(__file__).with_name("jupyter_config")

print_now = functools.partial(print, flush=True)  # before JupyterLab's own lines, also in a log file


class CourseServer(ServerApp):
    """Jupyter's server. It prints the port that it uses if the configured one is in use.

    Jupyter Server 2.21 logs this at the level INFO only, among much that no learner needs. This class can go
    when a release of Jupyter Server logs it at the level WARNING.
    """

    @validate("port")
    def _check_port(self, proposal):
        port = proposal["value"]
        if not 0 <= port <= 65535:  # the system would take 65536 for 0, any free port
            raise TraitError(f"--port {port} is not a port; give a number from 1024 to 65535: --port 8888")
        return port

    @default("static_custom_path")
    def _static_custom_path_default(self):
        return [str(CONFIGURATION / "custom")]  # custom.css; LabApp.custom_css switches it on

    def init_httpserver(self):
        configured_port = self.port
        try:
            super().init_httpserver()  # sets `port` to the one that it found free
        except SystemExit:  # Jupyter has logged that it found none, but not what to do
            print_now(
                f"Port {configured_port} belongs to another program, or only root may use it. "
                f"Give another one: {course.lab_command} --port 8890 (or 0: any that is free)"
            )
            raise
        if self.port != configured_port and configured_port != 0:
            print_now(f"Port {configured_port} is not free; JupyterLab uses port {self.port} instead.")


class PromptWebsocketConnection(ZMQChannelsWebsocketConnection):
    """Jupyter Server's own connection, on a socket that sends at once.

    After a slider has moved, the kernel sends four or five short messages. TCP delays the second until the
    browser has acknowledged the first (Nagle's algorithm, RFC 896), which the browser does after up to 40 ms.
    Tornado lets the application switch this off; Jupyter Server 2.21 does not do it. This class can go when a
    release of Jupyter Server calls `set_nodelay` itself.
    """

    def connect(self):
        self.websocket_handler.set_nodelay(True)
        return super().connect()


def start(options=(), say=print_now):
    """Copies the lessons into the learner's folder, then runs JupyterLab there until it is shut down.

    `options` are JupyterLab's own. ValueError: one line that says what to do.
    """
    folder = course.learners_folder()
    changes = update_lessons(target=folder)
    for line in changes.lines():
        say(line)
    check_runtime_folder()
    trust([folder / name for name in changes.written if name.endswith(".ipynb")])
    run(folder, options, say)


def trust(notebooks):
    """Signs these notebooks, so that Jupyter shows their stored figures as they are."""
    notary = NotebookNotary()
    for path in notebooks:
        notary.sign(nbformat.read(path, as_version=4))
    notary.store.close()


def run(folder, options=(), say=print_now):
    """Runs JupyterLab on a folder until it is shut down; JupyterLab gets the `options`."""
    check_runtime_folder()
    for place in course.lab_prepare:
        course.load(place)(say)
    for url in running_on(folder):
        say(f"JupyterLab is already running on these lessons: {url}")
        say("This starts a second one. If a lesson is open in both, the last save wins.")
    configure(folder)
    from jupyterlab.labapp import LabApp

    LabApp.serverapp_class = CourseServer
    LabApp.launch_instance(list(options))


def configure(folder):
    """Sets the environment variables by which Jupyter reads the course's configuration for a folder."""
    # A kernel named python3 elsewhere would hide the one of this environment, which has the course.
    kernels = Path(sys.prefix) / "share" / "jupyter"
    for variable, path in (("JUPYTER_CONFIG_PATH", CONFIGURATION), ("JUPYTER_PATH", kernels)):
        os.environ[variable] = os.pathsep.join(filter(None, [str(path), os.environ.get(variable)]))
    course.use(course.file())
    os.environ["NBCLASSROOM_LESSONS"] = str(folder)


def running_on(folder):
    """URLs of the JupyterLabs that run on this folder already."""
    try:
        servers = list(list_running_servers())
    except OSError:
        return []
    return [
        f"{server['url']}lab?token={server.get('token', '')}"
        for server in servers
        if Path(server.get("root_dir", "")).resolve() == Path(folder).resolve()
    ]


def check_runtime_folder():
    """Raises a ValueError if JupyterLab cannot write its running state in the home folder, as it must."""
    folder = Path(jupyter_runtime_dir())
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(4096))
    except OSError as error:
        remedy = f"name a folder that you can write: HOME=FOLDER {course.lab_command}"
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            remedy = "free some space there"
        text = f"JupyterLab cannot keep its running state in your home folder ({error.strerror})"
        raise ValueError(f"{text}; {remedy}") from error
