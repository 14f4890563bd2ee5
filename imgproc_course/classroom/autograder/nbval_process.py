"""The nbval processes: each thread that grades keeps one, and sends it one submission after another.

An nbval process is a pytest with nbval and `nbval_plugin`; its program is `nbval_main`. It is started so that
nothing on this machine and nothing in a submission can configure it. It never runs learners' code: kernels
do (`sandbox`).

When the thread that started it ends, also because its process was killed, the system ends the nbval process,
then the sandbox with its kernels.
"""

import atexit
import contextlib
import json
import os
import select
import socket
import subprocess
import sys
import threading
import time
from dataclasses import asdict

from imgproc_course.classroom.autograder.sandbox import bubblewrap
from imgproc_course.classroom.autograder.sandbox.bubblewrap import Limits, SandboxError
from imgproc_course.classroom.autograder.temporary_folder import TemporaryFolder

SOCKET_VARIABLE = "IMGPROC_NBVAL_SOCKET"  # environment variable with the descriptor of the socket
_START_SECONDS = 120
_SEND_SECONDS = 60
_BLOCKED_PLUGINS = (
    *("cacheprovider", "logging", "warnings", "doctest", "junitxml", "faulthandler", "debugging", "pastebin"),
    *("setuponly", "setupplan", "stepwise", "unraisableexception", "threadexception", "subtests", "skipping"),
)
_PLUGINS = (
    # First, so that nbval does not import what it blocks.
    "imgproc_course.classroom.autograder.blocked_imports",
    "nbval.plugin",
)
_PROGRAM = "from imgproc_course.classroom.autograder import nbval_main; nbval_main.main()"

_of_thread = threading.local()
_running = {}
_lock = threading.Lock()


class NbvalProcessEnded(Exception):
    """The process ended or does not answer; the message says what is known of it. Start another one."""


class NbvalProcessKilled(NbvalProcessEnded):
    """A signal ended it: the system had no memory left, or somebody killed it. No submission did that."""


class NbvalProcessNotStarted(SandboxError):
    """The process ended by itself while it started; the message says why."""


def nbval_process_of_thread(unsafe, limits):
    """This thread's NbvalProcess with these options of `autograde`; one with others is stopped."""
    options = (unsafe, limits)
    process = getattr(_of_thread, "process", None)
    if process is None or process.options != options or not process.is_alive:
        if process is not None:
            process.stop()
        process = _of_thread.process = NbvalProcess(*options)
    return process


def stop_nbval_processes(thread_prefix=""):
    """Stop this Python process's nbval processes, or those of threads whose names begin with the prefix.

    The next submission starts others.
    """
    with _lock:
        processes = [process for process in _running.values() if process.thread.startswith(thread_prefix)]
    for process in processes:
        process.close_connection()
    for process in processes:
        process.stop()


atexit.register(stop_nbval_processes)


class NbvalProcess:
    """One nbval process, and the socket to it.

    Raises NbvalProcessKilled if it is killed while it starts, SandboxError if it does not start.
    """

    def __init__(self, unsafe, limits):
        self.options = (unsafe, limits)
        self.thread = threading.current_thread().name
        self._limits = limits or Limits()
        self._folder = TemporaryFolder()
        folder = self._folder.path
        (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
        (folder / "work").mkdir()
        self._errors, self._last_errors = (folder / "errors").open("w+b"), ""
        our_end, process_end = socket.socketpair()
        self._socket, self._buffer = our_end, b""
        with process_end:
            self._process = self._start(folder, process_end)
        self.is_alive, self._is_ready = True, False
        with _lock:
            _running[id(self)] = self
        settings = {
            "unsafe": unsafe,
            "limits": asdict(limits) if limits else None,
            "folder": str(folder / "work"),
        }
        try:
            self._send(settings)
            if not unsafe:
                bubblewrap.require_sandbox()  # while the process starts
            self._receive(_START_SECONDS)
            self._is_ready = True
        except NbvalProcessKilled:
            raise
        except NbvalProcessEnded as error:
            raise NbvalProcessNotStarted(f"the nbval process did not start: {error}") from error
        except SandboxError:
            self.stop(wait=False)
            raise

    def _start(self, folder, connection):
        command = [sys.executable, "-I", "-c", _PROGRAM, "-c", str(folder / "pytest.ini")]
        command += ["--rootdir", str(folder), "--noconftest", "--color=no", "-q", "-s"]
        for name in _BLOCKED_PLUGINS:
            command += ["-p", f"no:{name}"]
        for name in _PLUGINS:
            command += ["-p", name]
        command += ["--nbval", str(folder / "work")]
        inherited = ("PATH", "LANG", "HOME")
        environment = {name: os.environ[name] for name in inherited if name in os.environ}
        environment |= {
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            "OPENBLAS_NUM_THREADS": "1",
            "TMPDIR": str(folder),
            SOCKET_VARIABLE: str(connection.fileno()),
        }
        return subprocess.Popen(
            command,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            pass_fds=[connection.fileno()],
            start_new_session=True,
        )

    def grade(self, key, name, lesson, answers):
        """Grade one submission; what `results.to_json` wrote. NbvalProcessEnded: it ended, or it is stuck."""
        job = {"key": str(key.path), "digest": key.digest}
        self._send(job | {"submission": name, "lesson": lesson, "answers": answers})
        return self._receive(self._patience(key.lessons[lesson]))

    def _patience(self, lesson):
        """Seconds after which the process itself must be stuck: twice what its kernels may take."""
        deadlines = [
            self._limits.deadline(exercise.time_limit * case.calls)
            for exercise in lesson.exercises
            for case in exercise.cases
        ]
        # The last case begins within the submission's time, and it may be run again.
        return 60 + 2 * (self._limits.submission + 2 * max(deadlines, default=0))

    def _send(self, message):
        try:
            self._socket.settimeout(_SEND_SECONDS)
            self._socket.sendall((json.dumps(message) + "\n").encode("ascii"))
        except OSError as error:
            raise self._stopped(str(error)) from error

    def _receive(self, patience):
        deadline = time.monotonic() + patience
        poll = select.poll()
        poll.register(self._socket, select.POLLIN)
        chunks, data = [self._buffer], self._buffer
        while b"\n" not in data:
            data, is_answering = b"", poll.poll(max(0.0, deadline - time.monotonic()) * 1000)
            if is_answering:
                with contextlib.suppress(OSError):
                    data = self._socket.recv(1 << 20)
            if not is_answering:
                self.stop(wait=False)
                raise NbvalProcessEnded(self._last_errors or f"no answer within {patience:.0f} s")
            if not data:
                raise self._stopped("it closed the connection")
            chunks.append(data)
        line, _, self._buffer = b"".join(chunks).partition(b"\n")
        return json.loads(line)

    def _stopped(self, fault):
        """Clean up after a process that has closed its connection; returns the exception to raise."""
        code = 0
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = self._process.wait(5)
        self.stop(wait=False)
        if code < 0:
            return NbvalProcessKilled(f"signal {-code} ended it")
        return NbvalProcessEnded(self._last_errors or fault)

    def close_connection(self):
        """Tell the process that no more submissions come, without waiting for its end."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)

    def stop(self, *, wait=True):
        """End the process, and with it its fork server; `wait`: it has five seconds to end by itself."""
        if not self.is_alive:
            return
        self.is_alive = False
        with _lock:
            _running.pop(id(self), None)
        self._socket.close()
        if wait and self._is_ready:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(5)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        self._process.wait()
        self._errors.seek(0)
        errors = self._errors.read().decode(errors="replace").strip().splitlines()
        self._last_errors = " | ".join(errors[-3:])[:500]
        self._errors.close()
        self._folder.remove()
