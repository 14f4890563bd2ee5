"""One robot for all programs of a user in a ROS domain: the first program starts it, it ends with the last.

The robot is a process of its own. Each program that uses it holds a connection to it, through a Unix socket;
when a program ends, in whatever way, the system closes its connection. A lock decides who starts the process:
the program that gets the lock opens the socket and passes both on to the process. So there is never a second
one, and nothing that a killed process leaves behind is in the way.

What the robot publishes is its *body*, for example a recorded camera. This module knows only that a body has
`description`, `running`, `status()`, `start(on_end)` and `stop()`, and that it logs its warnings: these go to
every program that uses the robot. A request is a dict that says which body it should be.

A program sends (kind, *arguments), where the kind is join, status or leave. The robot sends (kind, content,
status), where the kind is answer, refused or event.
"""

import contextlib
import contextvars
import functools
import logging
import os
import socket
import stat
import subprocess
import sys
import threading
import time
import weakref
from multiprocessing import Pipe
from multiprocessing.connection import Client, Connection, wait
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

try:
    import fcntl
except ImportError:
    fcntl = None  # type: ignore[assignment]  # Windows

SHAREABLE = fcntl is not None  # whether programs can share a robot here: not on Windows
FOLDERS = Path("/tmp")  # not the user's TMPDIR or XDG_RUNTIME_DIR: they differ between a user's logins
START_TIMEOUT = 60.0  # seconds that the process may take to answer, on a busy machine too
ANSWER_TIMEOUT = 10.0
STARTS = 5  # times that a program starts the process without an answer, until it gives up
UNEXPECTED_END = "the robot process has ended unexpectedly; open_camera() starts it again"
_RUN = "import sys; from {} import main; main(sys.argv[1:])"


class RobotInUseError(RuntimeError):
    """Other programs use the robot in another way. The text names them, and says what to do."""


class User(NamedTuple):
    """A program that uses the robot."""

    program: str
    pid: int

    def __str__(self):
        return f"{self.program} (pid {self.pid})"

    @classmethod
    def this_program(cls):
        command = Path(sys.argv[0])
        name = command.parent.name if command.name == "__main__.py" else command.name
        if name == "ipykernel_launcher.py" or command.parent.name.startswith("ipykernel"):
            name = Path(os.environ.get("JPY_SESSION_NAME", "a notebook")).name
        return cls({"-c": "python -c", "": "python"}.get(name, name), os.getpid())


def runtime_file(domain, kind):
    """The path of the "lock", "socket" or "log" of a domain's robot, in a folder of this user alone."""
    folder = FOLDERS / f"imgproc_course-{os.getuid()}"
    with contextlib.suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    state = folder.lstat()
    if not stat.S_ISDIR(state.st_mode) or state.st_uid != os.getuid() or state.st_mode & 0o077:
        raise RuntimeError(f"{folder} must be a folder that only you can open; remove it, then try again")
    return folder / f"robot-{domain}.{kind}"


def robot_runs(domain):
    """Whether a robot's process runs in a domain; it need not be able to answer now."""
    connection = _connect(domain) if SHAREABLE else None
    if connection is not None:
        connection.close()
    return connection is not None


def running_robot(domain):
    """The status of the robot that runs in a domain; {} if none does. The caller does not become its user."""
    connection = _connect(domain) if SHAREABLE else None
    if connection is not None:
        with connection, contextlib.suppress(EOFError, OSError):  # it may just have ended
            connection.send(("status",))
            if connection.poll(ANSWER_TIMEOUT):
                return connection.recv()[-1]
    return {}


class RobotConnection:
    """A program's use of the robot, until `leave` or the end of the program.

    `module` has the function `main(arguments)` that runs in the process and calls `serve`. With `switch`, a
    robot that others use in another way is switched to this request. `on_event(text, status)` is called in a
    thread of its own: for a warning of the robot, for the unexpected end of its process, and, with the text
    None, for the end of what it plays.

    Raises RobotInUseError, RuntimeError if the process does not start, and what opening the body raises.
    """

    _all: ClassVar["weakref.WeakSet[RobotConnection]"] = weakref.WeakSet()  # of this program

    def __init__(self, domain, module, request, *, switch, on_event):
        self._domain, self._module = domain, module
        self._on_event = on_event
        self._asking = threading.Lock()
        self._change = threading.Condition()
        self._answer_count = 0
        self.left = False
        self._connection, self.status = self._join(request, switch)
        self._all.add(self)
        # In this call's context: a notebook shows a late warning below the cell that opened the robot, and
        # not below the cell that happens to run.
        read = functools.partial(contextvars.copy_context().run, self._read)
        threading.Thread(target=read, name="robot connection", daemon=True).start()

    def ask(self, message="status"):
        """The robot's status now; the last known one if it does not answer or was left."""
        with self._asking:
            with self._change:
                answers = self._answer_count
            with contextlib.suppress(OSError):  # the reading thread notices it too
                self._connection.send((message,))
                with self._change:
                    self._change.wait_for(lambda: self._answer_count > answers, ANSWER_TIMEOUT)
            return self.status

    def leave(self):
        """Stops using the robot; the last one who leaves ends it. A second call does nothing."""
        if not self.left:
            self.left = True
            self.ask("leave")

    def leave_soon(self):
        """Leaves without waiting for the answer: the garbage collector calls this, and must not wait."""
        self.left = True
        with contextlib.suppress(OSError):
            self._connection.send(("leave",))

    def _join(self, request, switch):
        end, starts = time.monotonic() + START_TIMEOUT, 0
        while time.monotonic() < end and starts <= STARTS:
            connection = _connect(self._domain)
            if connection is None:
                starts += _start(self._domain, self._module)
                time.sleep(0.01)  # another program may be starting it, or it is just ending
                continue
            try:
                connection.send(("join", request, User.this_program(), switch))
                answer = connection.recv() if connection.poll(end - time.monotonic()) else None
            except (EOFError, OSError):
                answer = None  # it was ending, or was killed
            if answer is None:
                connection.close()
            elif answer[0] == "refused":
                connection.close()
                raise answer[1]
            else:
                return connection, answer[2]
        log_lines = runtime_file(self._domain, "log").read_text(errors="replace").strip().splitlines()
        raise RuntimeError(f"the robot process does not answer; its last line: {(log_lines or ['none'])[-1]}")

    def _read(self):
        while message := self._receive():
            kind, text, status = message
            with self._change:
                self.status = status
                self._answer_count += kind == "answer"
                self._change.notify_all()
            if kind == "event":
                self._on_event(text, status)
        self._connection.close()
        is_unexpected = not self.left
        self.left = True
        with self._change:
            if is_unexpected:
                self.status |= {"running": False, "last_error": UNEXPECTED_END}
            self._answer_count += 1  # nobody waits for an answer any more
            self._change.notify_all()
        if is_unexpected:
            self._on_event(UNEXPECTED_END, self.status)

    def _receive(self):
        """The robot's next message; None if its process has ended."""
        with contextlib.suppress(EOFError, OSError):
            return self._connection.recv()


def _close_connections_after_fork():
    # A forked child must not count as a user of the robot after its parent has ended.
    for connection in list(RobotConnection._all):
        connection.left = True
        connection._connection.close()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_connections_after_fork)


def _connect(domain):
    """A connection to the domain's robot process; None if there is none."""
    try:
        return Client(str(runtime_file(domain, "socket")), "AF_UNIX")
    except (FileNotFoundError, ConnectionRefusedError):
        return None


def _start(domain, module):
    """Starts the robot process, unless it runs, or another program is just starting it; returns whether."""
    lock = os.open(runtime_file(domain, "lock"), os.O_RDWR | os.O_CREAT, 0o600)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        path = runtime_file(domain, "socket")
        path.unlink(missing_ok=True)  # of a killed process
        with socket.socket(socket.AF_UNIX) as listener, runtime_file(domain, "log").open("wb") as log_file:
            listener.bind(str(path))
            listener.listen(128)
            descriptors = (lock, listener.fileno())
            process = subprocess.Popen(
                # -P: a learner's own numpy.py in the current folder must not be imported
                [sys.executable, "-P", "-c", _RUN.format(module), *map(str, (domain, *descriptors))],
                pass_fds=descriptors,
                stdin=subprocess.DEVNULL,
                stdout=log_file,
                stderr=subprocess.STDOUT,
                start_new_session=True,  # it survives Ctrl-C in the terminal, and the kernel's interrupt
            )
    except BlockingIOError:
        return False
    finally:
        os.close(lock)  # the process keeps it
    threading.Thread(target=process.wait, daemon=True).start()  # so that it leaves no zombie
    return True


def serve(arguments, open_body):
    """Runs the robot in this process until no program uses it.

    `arguments` are those that the starting program has passed. `open_body(request)` returns the body; it may
    raise ValueError, OSError or RuntimeError.
    """
    domain, lock, listener = (int(argument) for argument in arguments)
    for descriptor in (lock, listener):
        os.set_inheritable(descriptor, False)
    logging.basicConfig()  # also into the process's log file, with tracebacks
    robot = _Robot(socket.socket(fileno=listener), open_body)
    try:
        robot.run()
    finally:
        # Still under the lock: so this is not the socket of a next process.
        runtime_file(domain, "socket").unlink(missing_ok=True)
        robot.close()


class _Robot(logging.Handler):
    """The body, and the programs that use it. As a logging handler it sends them every warning."""

    def __init__(self, listener, open_body):
        super().__init__(logging.WARNING)
        self._listener = listener
        self._open_body = open_body
        self._events, self._event_sender = Pipe(duplex=False)  # from other threads to this one
        self._connections: list[Connection] = []
        self._users: dict[Connection, User] = {}
        self._body: Any = None
        self._request: dict[str, Any] = {}
        self._waits_until = time.monotonic() + START_TIMEOUT  # if the program that started it was killed
        logging.getLogger().addHandler(self)

    def emit(self, record):
        self._event_sender.send(record.getMessage()[:1000])  # so short that threads cannot mix their texts

    def run(self):
        while self._users or time.monotonic() < self._waits_until:
            for ready in wait([self._listener, self._events, *self._connections], timeout=1.0):
                if isinstance(ready, socket.socket):
                    self._connections.append(Connection(ready.accept()[0].detach()))
                elif ready is self._events:
                    self._tell(self._events.recv())
                else:
                    self._handle_request(ready)

    def close(self):
        self._listener.close()
        if self._body is not None:
            self._body.stop()
        super().close()

    def _handle_request(self, connection):
        try:
            kind, *arguments = connection.recv()
        except (EOFError, OSError):
            self._forget(connection)
            return
        error = None
        if kind == "join":
            self._waits_until = 0.0
            try:
                self._join(connection, *arguments)
            except (ValueError, OSError, RuntimeError) as reason:
                error = reason
        elif kind == "leave":
            self._users.pop(connection, None)
        self._send(connection, "refused" if error else "answer", error)
        if kind == "leave":
            self._forget(connection)

    def _join(self, connection, request, user, switch):
        needs_new_body = self._body is None or not self._body.running
        if not needs_new_body and request != self._request:
            others = {other for other in self._users.values() if other.pid != user.pid}
            if others and not switch:
                raise RobotInUseError(self._in_use(request, others))
            needs_new_body = True
        if needs_new_body:
            self._switch(request, user)
        self._users[connection] = user

    def _in_use(self, request, others):
        changes = [f"{name} {value!r}" for name, value in request.items() if self._request.get(name) != value]
        names = ", ".join(sorted(map(str, others)))
        return (
            f"the robot of this domain is {self._body.description}, used by {names}; "
            f"you asked for {', '.join(changes)}: switch=True (--switch in a terminal) switches it for all, "
            "or take another ROS_DOMAIN_ID (0 to 101)"
        )

    def _switch(self, request, user):
        # The old body is stopped only when the new one has started. If that fails, the old one goes on.
        body = self._open_body(request)
        body.start(on_end=lambda: self._event_sender.send(None))
        if self._body is not None:
            self._body.stop()
        self._body, self._request = body, request
        self._tell(f"{user} has switched the robot: it is now {body.description}", except_pid=user.pid)

    def _status(self):
        body_status = {} if self._body is None else self._body.status()
        users = list(dict.fromkeys(self._users.values()))
        description = "" if self._body is None else self._body.description
        return body_status | {"request": self._request, "description": description, "users": users}

    def _tell(self, text, except_pid=None):
        for connection, user in list(self._users.items()):
            if user.pid != except_pid:
                self._send(connection, "event", text)

    def _send(self, connection, kind, content):
        try:
            connection.send((kind, content, self._status()))
        except OSError:
            self._forget(connection)

    def _forget(self, connection):
        self._users.pop(connection, None)
        if connection in self._connections:
            self._connections.remove(connection)
            connection.close()
