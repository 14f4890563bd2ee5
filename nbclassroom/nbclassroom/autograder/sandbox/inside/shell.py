"""An IPython shell without ZMQ: it reads cells from a socket and writes messages, as lines of JSON.

In:  {"code": "..."}; a check has also "case": {...}, its inputs
     {"page": {...}, "skip": [...]}, a page (see `exercises.page`); {"to": number}: it runs on to this
     cell; {"below": "name"}: it runs on until this name is bound
     {"fork": seconds} with a socket: a process that answers the requests of the socket for a check, as this
     one does; {"end": patience, "confined": ...}: that process ends
Out: {"type": "display_data" | "idle", "content": {...}}, as Jupyter's messages. What a cell prints or draws
     is not sent, but for what a check cell shows. Of a page, "errors"; of a process that ended, "ended".
     Which statement of a page began last stands in memory that the grader reads, too: `place`.
"""

import json
import os
import signal
import socket
import threading
from contextlib import suppress

from IPython.core.displaypub import DisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from traitlets import Type
from traitlets.config import Config

from nbclassroom.autograder.sandbox.inside import MIME, PLACE, check_cell, confine, refusal
from nbclassroom.exercises.page_run import Missing, PageRun
from nbclassroom.exercises.running import attempt, error_name

# Looked up before any code of a learner's runs.
_fork, _exit, _kill, _waitpid = os.fork, os._exit, os.kill, os.waitpid
_write, _fstat, _dumps, _loads = os.write, os.fstat, json.dumps, json.loads


class MessageWriter:
    """Writes each message as one line to the kernel's socket."""

    def __init__(self):
        self.descriptor = -1
        self.place = bytearray(PLACE.size)
        self._cell = None  # of a page, that runs
        self._lock = threading.RLock()

    def send(self, kind, **content):
        text = _dumps({"type": kind, "content": content}, default=str) + "\n"
        data = memoryview(text.encode("ascii"))
        with self._lock:
            while data:
                data = data[_write(self.descriptor, data) :]

    def begin(self, cell, statement):
        """A statement of the page begins; OSError: the one before has closed the socket."""
        _fstat(self.descriptor)
        self._cell = cell
        self.place[:] = PLACE.pack(cell, statement)

    def finish(self, ename="", evalue=""):
        self._cell = None
        self.send("idle", ename=ename, evalue=evalue)

    def tell_attempt(self, text):
        self.send("tried", cell=self._cell, text=text)

    def send_answer(self, data):
        """Send what a check cell shows, of what a cell displays."""
        if MIME in data:
            self.send("display_data", data={MIME: data[MIME]})


WRITER = MessageWriter()


class AnswerPublisher(DisplayPublisher):
    def publish(self, data, metadata=None, source=None, **_ignored):
        WRITER.send_answer(data)


class KernelShell(InteractiveShell):
    """IPython's shell, for what a learner's code asks of it: `get_ipython`, `display`, plots."""

    display_pub_class = Type(AnswerPublisher)

    def enable_gui(self, gui=None):
        pass

    ask_exit = enable_gui


def make_shell():
    """The one shell of the fork server; each fork continues with its copy."""
    # A database would be one open file that all forks share.
    shell = KernelShell.instance(
        config=Config({"HistoryManager": {"enabled": False, "hist_file": ":memory:"}})
    )
    shell.colors = "nocolor"
    shell.user_ns["__name__"] = "__main__"
    return shell


def run_unseen(shell, sources):
    """Run sources whose output nobody reads."""
    WRITER.descriptor = os.open(os.devnull, os.O_WRONLY)
    run = PageRun(_NO_PAGE, shell.user_ns)
    for source in sources:
        run.run_beside(source)
    os.close(WRITER.descriptor)


def read_requests(connection):
    """The requests that come from a socket: (dict, the descriptor that came with it or None)."""
    data, descriptors = b"", []
    while part := connection.recvmsg(1 << 18, socket.CMSG_SPACE(4)):
        for level, kind, content in part[1]:
            if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
                descriptors += [*memoryview(content).cast("i")]
        if not part[0]:
            return
        *lines, data = (data + part[0]).split(b"\n")
        for line in lines:
            yield _loads(line), descriptors.pop(0) if descriptors else None


class Server:
    """What one connection asks for: a kernel's, or that of a check which was forked from it."""

    def __init__(self, shell, page_run=None):
        self._shell = shell
        self._page_run = page_run or PageRun(_NO_PAGE, shell.user_ns)
        self._check = None  # process id of the check that was forked

    def serve(self, requests):
        """Answer requests, through the socket that WRITER has, until there are no more."""
        for request, descriptor in requests:
            handler = next(_HANDLERS[name] for name in request if name in _HANDLERS)
            handler(self, request, descriptor)

    def _run_code(self, request, _descriptor):
        """Run what is no part of the page. A check has also "case": its inputs."""
        if "case" in request:
            check_cell.deliver(request["case"])
        error = self._page_run.run_beside(request["code"])
        # The text by `attempt`: the error's class may be the learner's.
        ending = () if error is None else (error_name(error), attempt(lambda: str(error), ""))
        WRITER.finish(*ending)

    def _open_page(self, request, _descriptor):
        """Get a page ready to run, without the statements that ended the process before."""
        refusal.allow_files(cell["file"] for cell in request["page"]["cells"] if cell["file"])
        self._page_run = PageRun(request["page"], self._shell.user_ns, request["skip"], WRITER.begin)
        WRITER.finish()

    def _run_page(self, request, _descriptor):
        """Run the page on to a cell, or below until a name is there; tell which statements have failed."""
        if "to" in request:
            self._page_run.run_to(request["to"])
        else:
            names, name = self._shell.user_ns, request["below"]
            self._page_run.run_to(is_found=lambda: name in names and type(names[name]) is not Missing)
            if type(names.get(name)) is Missing:  # in the end, too: then it is not bound
                del names[name]
        WRITER.send("errors", errors=self._page_run.errors[:_MOST_ERRORS])
        WRITER.finish()

    def _fork_check(self, request, descriptor):
        """Fork a process that answers the requests of another socket; none beside threads and processes."""
        self._check = None if _has_company() else _fork()
        if self._check == 0:
            _serve_check(self, request, descriptor)
        os.close(descriptor)
        WRITER.finish("" if self._check else "not alone")

    def _end_check(self, request, _descriptor):
        """End the forked process with all that it started; tell how it ended, if somebody is patient."""
        status = _end(self._check, request["end"], request["confined"])
        self._check = None
        if request["end"]:
            WRITER.send("ended", **status)
            WRITER.finish()


_MOST_ERRORS = 100
_NO_PAGE: dict = {"answers": {}, "cells": [], "checks": {}, "left_out": []}
_HANDLERS = {
    "code": Server._run_code,
    "page": Server._open_page,
    "to": Server._run_page,
    "below": Server._run_page,
    "fork": Server._fork_check,
    "end": Server._end_check,
}


def _has_company():
    """Whether this process has other threads, or has started processes: a fork would lack them."""
    try:
        tasks = os.listdir("/proc/self/task")  # noqa: PTH208 - `os` only, see `confine`
        path = f"/proc/self/task/{os.getpid()}/children"
        with open(path, encoding="ascii") as children:  # noqa: PTH123 - as above
            return len(tasks) > 1 or bool(children.read().strip())
    except OSError:  # a system without it
        return threading.active_count() > 1


def _serve_check(server, request, descriptor):
    """What the forked process does; it does not return."""
    exit_code = 71  # the learner's code ended it
    try:
        os.close(WRITER.descriptor)
        os.setpgid(0, 0)
        confine.set_time_limit(request["fork"])
        WRITER.descriptor = descriptor
        connection = socket.socket(fileno=descriptor)
        server._page_run.adopt_process()
        Server(server._shell, server._page_run).serve(read_requests(connection))
        exit_code = 0
    finally:
        _exit(exit_code)


def _end(check, patience, confined):
    """How a forked process ended: {"signal", "code", "cpu"}; it is killed if it does not end in time."""
    try:
        status = confine.end_child(check, patience)
        # Where this process is the first one of its namespace, this reaches all others there and no more.
        with suppress(OSError):
            _kill(-1 if confined else -check, signal.SIGKILL)
        with suppress(OSError):
            while _waitpid(-1, 0)[0]:
                pass
    except (OSError, TypeError):  # the learner's code has waited for it
        return {"signal": 0, "code": 71, "cpu": 0.0}
    return status
