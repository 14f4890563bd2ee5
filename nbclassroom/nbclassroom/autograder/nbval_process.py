"""The threads that grade, and the nbval process that each keeps, for one submission after another.

An nbval process is a pytest with nbval and `nbval_plugin`; its program is `main`. It is started so that
nothing on this machine and nothing in a submission can configure it. It never runs learners' code: kernels
do (`sandbox`).

When the thread that started it ends, also because its process was killed, the system ends the nbval process,
then the sandbox with its kernels. Little is imported here, so that they start while the rest of a command is
imported: a process can start before there is anything to grade.
"""

import atexit
import contextlib
import itertools
import json
import os
import shutil
import socket
import subprocess
import sys
import threading
import types
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict

from .. import course
from .sandbox import bubblewrap
from .sandbox.bubblewrap import Limits, SandboxError, make_temporary_folder, remove_abandoned_folders
from .sandbox.fork_server_client import KernelFactory
from .sandbox.inside import confine

_START_SECONDS = 120
_BLOCKED_PLUGINS = (
    *("cacheprovider", "logging", "warnings", "doctest", "junitxml", "faulthandler", "debugging", "pastebin"),
    *("setuponly", "setupplan", "stepwise", "unraisableexception", "threadexception", "subtests", "skipping"),
)
_PROGRAM = "from nbclassroom.autograder import nbval_process; nbval_process.main()"

_processes: dict[str, "NbvalProcess"] = {}  # by the names of the threads
_stopped: set[str] = set()  # prefixes of the threads that start no more
_numbers = itertools.count(1)  # of the pools of threads


class NbvalProcessEnded(Exception):
    """The process ended or does not answer; the message says what is known of it. Start another one."""


class NbvalProcessKilled(Exception):
    """A signal ended it: the system had no memory left, or somebody killed it. No submission did that."""


class NbvalProcessNotStarted(SandboxError):
    """The process ended by itself while it started; the message says why."""


def nbval_process_of_thread(unsafe, limits):
    """This thread's NbvalProcess with these options of `autograde`; one with others is stopped."""
    thread = threading.current_thread().name
    if thread.startswith(tuple(_stopped)):
        raise NbvalProcessNotStarted("the run was stopped")
    process = _processes.get(thread)
    if process is not None and process.options != (unsafe, limits):
        process.stop()
    return _processes.get(thread) or NbvalProcess(unsafe, limits)


def stop_nbval_processes(thread_prefix="", *, for_good=False):
    """Stop the nbval processes of threads with this prefix; `for_good`: in these none starts again."""
    if for_good:
        _stopped.add(thread_prefix)
    processes = [process for name, process in list(_processes.items()) if name.startswith(thread_prefix)]
    for process in processes:
        process.close_connection()
    for process in processes:
        process.stop()


atexit.register(stop_nbval_processes)


class NbvalProcess:
    """A thread's nbval process, and the socket to it; NbvalProcessKilled, SandboxError: it does not start."""

    def __init__(self, unsafe, limits):
        self.options = (unsafe, limits)
        self._limits = limits or Limits()
        self._folder = make_temporary_folder()
        self._errors = (self._folder / "errors").open("w+b")
        self._socket, process_end = socket.socketpair()
        self._lines = self._socket.makefile("r", 1 << 20, encoding="ascii")
        with process_end:
            self._process = self._start(process_end)
        self._is_ready, self._last_errors = False, ""
        self._thread = threading.current_thread().name
        _processes[self._thread] = self
        try:
            if not unsafe:
                bubblewrap.require_sandbox()  # while the process starts
            self._answer("", _START_SECONDS)
            self._is_ready = True
        except NbvalProcessEnded as error:
            raise NbvalProcessNotStarted(f"the nbval process did not start: {error}") from error
        except SandboxError:
            self.stop()
            raise

    def _start(self, connection):
        folder = self._folder
        (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
        (folder / "work").mkdir()
        settings = {
            "unsafe": self.options[0],
            "limits": asdict(self._limits),
            "folder": str(folder / "work"),
            "socket": connection.fileno(),
        }
        command = [sys.executable, "-I", "-c", _PROGRAM, json.dumps(settings)]
        command += ["-c", str(folder / "pytest.ini"), "--rootdir", str(folder), "--noconftest"]
        command += ["--color=no", "-q", "-s"]
        # The blocked imports first, so that nbval does not import what they block.
        for plugin in (*_BLOCKED_PLUGINS, "nbclassroom.autograder.blocked_imports", "nbval.plugin"):
            command += ["-p", f"no:{plugin}" if plugin in _BLOCKED_PLUGINS else plugin]
        environment = {name: os.environ[name] for name in ("PATH", "LANG", "HOME") if name in os.environ}
        environment |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "OPENBLAS_NUM_THREADS": "1"}
        environment[course.VARIABLE] = str(course.file())
        environment["TMPDIR"] = str(folder)
        return subprocess.Popen(
            [*command, "--nbval", str(folder / "work")],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            pass_fds=[connection.fileno()],
            start_new_session=True,
        )

    def grade(self, key, name, lesson, page):
        """Grade one submission; what `results.to_json` wrote. NbvalProcessEnded, NbvalProcessKilled."""
        job = {"key": str(key.path), "digest": key.digest, "submission": name, "lesson": lesson, "page": page}
        return self._answer(json.dumps(job) + "\n", self._patience(key.lessons[lesson]))

    def _patience(self, lesson):
        """Seconds after which the process itself must be stuck: twice what kernels and robots may take."""
        deadlines = [
            self._limits.deadline(exercise.kind.seconds_of(exercise, case))
            for exercise in lesson.exercises
            for case in exercise.cases
        ]
        # The last case begins within the submission's time, and it may be run again.
        kernels = self._limits.submission + 2 * max(deadlines, default=0)
        # A robot needs less time than the one in the scenario would.
        robots = sum(exercise.kind.simulated_seconds(exercise) for exercise in lesson.exercises)
        return 60 + 2 * (kernels + robots)

    def _answer(self, request, patience):
        self._socket.settimeout(patience)
        try:
            self._socket.sendall(request.encode("ascii"))
            line = self._lines.readline()
        except TimeoutError as error:
            raise self._stopped(f"no answer within {patience:.0f} s") from error
        except OSError as error:
            raise self._stopped(str(error)) from error
        if not line.endswith("\n"):
            raise self._stopped("it closed the connection")
        return json.loads(line)

    def _stopped(self, fault):
        """Clean up after a process that ended, or is stuck; returns the exception to raise."""
        code = self.stop(patience=5)
        if code < 0:
            return NbvalProcessKilled(f"signal {-code} ended it")
        return NbvalProcessEnded(self._last_errors or fault)

    def close_connection(self):
        """Tell the process that no more submissions come, without waiting for its end."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)

    def stop(self, patience=None):
        """End it and its fork server; its exit code if it ended by itself within `patience` seconds."""
        code = 0
        if _processes.get(self._thread) is not self:  # it was stopped before
            return code
        del _processes[self._thread]
        self.close_connection()
        self._lines.close()
        self._socket.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = self._process.wait((5 if self._is_ready else 0) if patience is None else patience)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        self._process.wait()
        self._errors.seek(0)
        errors = self._errors.read().decode(errors="replace").strip().splitlines()
        self._last_errors = " | ".join(errors[-3:])[:500]
        self._errors.close()
        shutil.rmtree(self._folder, ignore_errors=True)
        return code


def usual_workers(lessons):
    """How many submissions to grade at once; `lessons` are those of keys.

    A worker with its kernels, the next submission and the pages keep two cores busy; a robot keeps one.
    """
    cores, kinds = os.cpu_count() or 1, (each.kind for lesson in lessons for each in lesson.exercises)
    return (cores + 1) // 2 if all(kind.shares_kernel for kind in kinds) else cores


@contextlib.contextmanager
def open_worker_threads(workers=None, *, early=False, unsafe=False, limits=None):
    """A thread pool whose nbval processes are stopped at the end; `early`: they start now.

    They are stopped before the threads: a process ends at once with the thread that started it.
    """
    workers, prefix = workers or os.cpu_count() or 1, f"autograde-{next(_numbers)}-"
    executor = ThreadPoolExecutor(workers, thread_name_prefix=prefix)
    try:
        for _ in range(workers if early else 0):  # an error comes again with the first submission
            executor.submit(nbval_process_of_thread, unsafe, limits)
        yield executor
    finally:
        stop_nbval_processes(prefix, for_good=True)
        executor.shutdown()
        # The next run after a killed one perhaps finds everything graded, and needs no folder of its own.
        remove_abandoned_folders()


def main():
    """The program of an nbval process: the fork server loads while pytest and nbval are imported."""
    confine.die_with_parent()  # if it has ended already, there is nothing to read from the socket
    settings, arguments = json.loads(sys.argv[1]), sys.argv[2:]
    connection = socket.socket(fileno=settings["socket"])
    kernel_factory = KernelFactory(unsafe=settings["unsafe"], limits=Limits(**settings["limits"]))
    _leave_out_kernels_of_nbval()
    import pytest

    from .nbval_plugin import GradingPlugin

    sys.exit(pytest.main(arguments, plugins=[GradingPlugin(connection, settings["folder"], kernel_factory)]))


def _leave_out_kernels_of_nbval():
    """Spare nbval the import of Jupyter's client and of coverage: `nbval_plugin` has kernels of its own."""
    kernel, cover = types.ModuleType("nbval.kernel"), types.ModuleType("nbval.cover")
    vars(kernel).update(RunningKernel=None, CURRENT_ENV_KERNEL_NAME=None)
    vars(cover).update(setup_coverage=None, teardown_coverage=None)
    sys.modules |= {"nbval.kernel": kernel, "nbval.cover": cover}
