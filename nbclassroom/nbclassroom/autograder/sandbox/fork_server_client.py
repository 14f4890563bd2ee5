"""The fork server and its kernels, seen from outside: cells go in, messages come out.

Nothing that comes out is trusted: it is read with a limit on its size and with a deadline that no message
extends, and all of it may be forged.
"""

import json
import math
import mmap
import os
import shutil
import signal
import socket
import subprocess
import time
from collections import deque
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass, field

from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.inside import MIME, PLACE

_MAX_TEXT = 2_000  # characters of an error's text that are kept
_MAX_NAME = 100  # characters of an exception's name

_NOWHERE = PLACE.pack(-1, -1)
_LOOK_SECONDS = 0.05  # between two looks at what all processes together use
# What the fork server and a waiting kernel use beside a check, at most: bytes, and seconds of processor time.
_OWN_MEMORY, _OWN_SECONDS = 256 << 20, 0.5
_STARTS = 3  # of a fork server that ends before it forks
_STATEMENT_SECONDS = 20  # of wall time, after which a statement of a page cannot be stopped from inside
_NOT_CONFINED = 70  # exit code of a fork that could not be confined, see `inside.fork_server`
_TIME_SIGNALS = (signal.SIGKILL, signal.SIGXCPU)  # by which the system ends a process whose time is used up


@dataclass
class CellRun:
    """What running one cell did, built from the messages of a kernel."""

    # "" if it ran to its end; else "time", "memory", "output", "crashed" or "hostile", as in Outcome; or
    # "gone" if the process that forks kernels was ended.
    ended: str = ""
    answers: list = field(default_factory=list)  # what check cells showed: the data of our MIME type
    error: tuple = ("", "")  # type and text of the exception that ended the cell
    errors: list = field(default_factory=list)  # of a page: (number of a cell, type, text) of a statement
    place: tuple = ()  # of a page that did not come to its end: (cell, statement) that ran last
    tried: list = field(default_factory=list)  # (number of a cell or None, what its code tried)
    status: dict = field(default_factory=dict)  # of a process that was forked: how it ended

    def add(self, kind, content):
        """Add a message; returns whether it ended the cell. ValueError, TypeError, KeyError: it is none."""
        if kind == "idle":
            self.error = (_text(content["ename"])[:_MAX_NAME], _text(content["evalue"]))
        elif kind == "display_data":
            data = dict(content["data"])
            self.answers += [data[MIME]] if MIME in data else []
        elif kind == "tried":
            cell = content["cell"]
            self.tried.append((None if cell is None else _number(cell), _text(content["text"])))
        elif kind == "errors":
            errors = content["errors"]
            self.errors = [(_number(cell), _text(name), _text(text)) for cell, name, text in errors]
        elif kind == "ended":
            self.status = {name: float(content[name]) for name in ("signal", "code", "cpu")}
        else:
            raise ValueError(f"a message of the kind {kind!r}")
        return kind == "idle"


def _number(value):
    if type(value) is not int or value < 0:
        raise ValueError(f"expected the number of a cell, got {str(value)[:20]}")
    return value


def _text(value):
    if not isinstance(value, str):
        raise TypeError(f"expected a text, got {type(value).__name__}")
    return value[:_MAX_TEXT]


class KernelEnded(Exception):
    """The kernel has ended; its text is a value of CellRun.ended. It never leaves this module."""


class Connection:
    """The socket to a process that runs cells, and the limits on what comes out of it."""

    def __init__(self, factory, place):
        self._factory, self._limits = factory, factory.limits
        self.place, self._last = place, ()  # memory with the statement of a page that runs; as it was last
        self._lines: deque[bytes] = deque()
        self._buffer, self._is_confined = b"", True
        self._next_look = 0.0
        # Processor time of all processes together: what they may use from a look on, and where it ends.
        self._cpu_most, self._cpu_ends = {}, {}
        self._deadline = self._statement_ends = math.inf
        self.socket, self.other_end = socket.socketpair()

    def _begin(self, seconds):
        """Start the clock for so many seconds of processor time."""
        self.cpu_limit = self._limits.cpu(seconds)
        self._deadline = time.monotonic() + self._limits.deadline(seconds)
        self._next_look = time.monotonic() + _LOOK_SECONDS

    def run(self, code):
        """Run a source that is no part of a page; returns its CellRun."""
        return self._request({"code": code})

    def run_check(self, code, inputs, seconds):
        """Run a check cell with its inputs (see `check_cell.deliver`); returns its CellRun.

        The system limits the processor time of each process, and this limits that of all together: a slow
        answer could compute in one process after another.
        """
        self._limit_cpu(check=seconds * len(inputs) + self._limits.grace)
        return self._request({"case": {"calls": inputs, "seconds": seconds}, "code": code})

    def _limit_cpu(self, **seconds):
        """Limit the processor time of all processes together, for each of these names, from now on."""
        self._cpu_most |= {name: most + _OWN_SECONDS for name, most in seconds.items()}
        for name in seconds:
            self._cpu_ends.pop(name, None)

    def run_with(self, code, partner):
        """Run a check cell that asks a partner again and again, such as a GradedDrive; returns its CellRun.

        The time of all its processes together is limited for each call, and for all. The time that the
        partner takes is its own: the deadlines leave it out.
        """
        run, seconds = CellRun(), partner.cpu_seconds
        data = _line_of({"case": {"layout": partner.layout, "seconds": partner.call_seconds}, "code": code})
        self._limit_cpu(check=seconds + self._limits.grace)
        # The page's time is not the drive's: a controller that sends and never reads waits for its end.
        deadline = time.monotonic() + self._limits.deadline(seconds)
        self._deadline = min(self._deadline, deadline) + partner.seconds
        self._bytes_left = self._limits.output
        while (action := self._run_until_action(run, data)) is not None:
            self._limit_cpu(call=partner.call_seconds)
            seconds_before = partner.seconds
            data = partner.answer(action)
            self._deadline += partner.seconds - seconds_before
            self._statement_ends = time.monotonic() + self._limits.deadline(partner.call_seconds)
        return run

    def run_below(self, name):
        """Run the cells of the page below, until a name is there; returns its CellRun."""
        return self._request({"below": name})

    def _request(self, request):
        run = CellRun()
        self._bytes_left = self._limits.output
        if self._run_until_action(run, _line_of(request)) is not None:
            run.ended = "hostile"
        run.place = self._statement() if run.ended else ()
        self.place[:] = _NOWHERE
        self._statement_ends, self._cpu_most, self._cpu_ends = math.inf, {}, {}
        return run

    def _run_until_action(self, run, data):
        """Send data, and add messages to a CellRun; the content of an "action", None at the cell's end."""
        try:
            self._send(data)
            while True:
                line = self._read_line(self._bytes_left)
                if not self._is_confined:  # its first line is empty: `fork_server` has confined it
                    self._is_confined = True
                    continue
                self._bytes_left -= len(line)
                message = json.loads(line)
                if message["type"] == "action":
                    return dict(message["content"])
                if run.add(message["type"], message["content"]):
                    return None
        except KernelEnded as error:
            run.ended = str(error)
        except (ValueError, KeyError, TypeError, RecursionError):  # anybody may have written the message
            run.ended = "hostile"
        return None

    def _send(self, data):
        data = memoryview(data)
        while data:
            data = data[self._exchange(self.socket.send, data) :]

    def _read_line(self, max_bytes):
        while not self._lines:
            if len(self._buffer) > max_bytes:
                raise KernelEnded("output")
            data = self._exchange(self.socket.recv, 1 << 18)
            if not data:
                raise KernelEnded(self._how_it_ended())
            *lines, self._buffer = (self._buffer + data).split(b"\n")
            self._lines.extend(lines)
        return self._lines.popleft()

    def _exchange(self, send_or_receive, argument):
        """The result of sending or receiving once; the kernel ends if time or memory runs out meanwhile."""
        while True:
            seconds_left = min(self._deadline, self._statement_ends) - time.monotonic()
            if seconds_left <= 0:
                raise KernelEnded("time")
            self._check_use()
            self.socket.settimeout(min(seconds_left, _LOOK_SECONDS))
            try:
                return send_or_receive(argument)
            except TimeoutError:  # the time of a statement begins anew if it is another one
                if self._statement() not in ((), self._last):
                    self._last = self._statement()
                    self._statement_ends = time.monotonic() + _STATEMENT_SECONDS
            except OSError as error:
                raise KernelEnded(self._how_it_ended()) from error

    def _statement(self):
        """(cell, statement) that began last, () if none did; a learner's code may have written anything."""
        place = PLACE.unpack(self.place)
        return place if min(place) >= 0 else ()

    def _check_use(self):
        """End the kernel if it and all that it started use too much memory or time together."""
        if time.monotonic() < self._next_look:
            return
        memory, seconds = self._factory.used()
        if memory > self._limits.memory + _OWN_MEMORY:
            raise KernelEnded("memory")
        ends = {name: seconds + most for name, most in self._cpu_most.items()} | self._cpu_ends
        if any(seconds > end for end in ends.values()):
            raise KernelEnded("time")
        self._cpu_ends = ends
        self._next_look = time.monotonic() + _LOOK_SECONDS

    def _how_it_ended(self):
        """The value of CellRun.ended for a process that ended by itself."""
        raise NotImplementedError

    def _ending(self, status):
        """The value of CellRun.ended for a process that ended by itself, by its exit status."""
        # The system's limit is in whole seconds; on a busy machine it counts up to a fifth too much.
        most = min(self.cpu_limit - 0.9, 0.75 * self.cpu_limit)
        if status["signal"] in _TIME_SIGNALS and status["cpu"] > most:
            return "time"
        return "crashed"


class ForkedKernel(Connection):
    """A kernel of a `KernelFactory`; it waits until `begin`."""

    def __init__(self, factory):
        with os.fdopen(os.memfd_create("place"), "wb") as file:
            file.truncate(PLACE.size)
            super().__init__(factory, mmap.mmap(file.fileno(), PLACE.size))
            self.place[:] = _NOWHERE
            self._is_confined = False
            with self.other_end:
                self._id = factory.fork([self.other_end.fileno(), file.fileno()])

    def begin(self, allowed, seconds):
        """Start the clock; `KernelFactory.start` explains the arguments."""
        self._factory.await_ends()  # nothing of the kernel before is left now, and counts for this one
        self._begin(seconds)
        with suppress(KernelEnded):  # its first cell will find out
            self._send(_line_of({"allowed": list(allowed), "cpu": self.cpu_limit}))

    def open_page(self, page, skip):
        """Get a page (see `exercises.page`) ready to run, without the statements of `skip`."""
        return self._request({"page": page, "skip": skip})

    def run_page(self, number):
        """Run the page on to this cell; returns its CellRun, with the statements that failed."""
        return self._request({"to": number})

    def fork_check(self, seconds):
        """A ForkedCheck with the page as it is now; None: beside threads and processes there is no fork."""
        check, run = ForkedCheck(self, self._factory, seconds), CellRun()
        self._bytes_left = self._limits.output
        with suppress(OSError), check.other_end as other_end:
            socket.send_fds(self.socket, [_line_of({"fork": check.cpu_limit})], [other_end.fileno()])
            self._run_until_action(run, b"")
            if not run.ended and not run.error[0]:
                return check
        check.socket.close()
        return None

    def end_fork(self, patience=0.0):
        """How the forked process ended, {} if this one has ended as well.

        Without patience it is killed, and {} at once: this process waits for its end before the next request.
        """
        request = {"end": patience, "confined": self._factory.confined}
        if patience:
            return self._request(request).status
        with suppress(OSError):
            self.socket.send(_line_of(request))
        return {}

    def _how_it_ended(self):
        """The value of CellRun.ended for a kernel that ended by itself; "gone" if the fork server did too."""
        if self._id is None:  # somebody has asked before
            return "crashed"
        # A process closes its sockets a moment before its end is known: wait for that.
        self._factory.end(self._id, patience=1.0)
        status = self._factory.await_ends()  # the last reply is the one about this kernel
        self._id = None
        if status is None:
            return "gone"
        # Once it is confined, an answer can end with this code too.
        if status["code"] == _NOT_CONFINED and not self._is_confined:
            raise bubblewrap.SandboxError("a kernel could not be confined on this machine")
        return self._ending(status)

    def stop(self):
        """End the kernel and all that it started, without waiting for its end."""
        self.socket.close()
        if self._id is not None:
            self._factory.end(self._id)
            self._id = None


class ForkedCheck(Connection):
    """A process that a kernel forked for the cases of one exercise."""

    def __init__(self, kernel, factory, seconds):
        super().__init__(factory, kernel.place)
        self._kernel, self._status = kernel, None
        self._begin(seconds)

    def _how_it_ended(self):
        if self._status is None:
            self._status = self._kernel.end_fork(1.0)
        return self._ending(self._status) if self._status else "crashed"

    def stop(self):
        """End the process and all that it started."""
        self.socket.close()
        if self._status is None:
            self._status = self._kernel.end_fork()


def _line_of(request):
    return (json.dumps(request) + "\n").encode("ascii")


class KernelFactory(AbstractContextManager):
    """Starts kernels, `unsafe` ones without a sandbox, as the user who grades; a context manager.

    They are forked from a process, which is started again if it has ended.
    """

    def __init__(self, *, unsafe=False, limits=None):
        self.limits, self.confined = limits or bubblewrap.Limits(), not unsafe
        self._folder = bubblewrap.make_temporary_folder() if unsafe else None
        self._process: subprocess.Popen | None = None
        self._fork_count = 0
        self._spare = None  # a kernel that waits: to fork and confine one takes ten milliseconds
        self._start_server()

    def start(self, allowed, seconds, *, alone=False):
        """Start a ForkedKernel.

        Its modules are `allowed`, beside those of every answer. Its first case, and so every case that
        shares it, may use so many seconds of processor time. `alone`: a new one, while no other one waits.
        """
        if alone:
            self._drop_spare()
        kernel = self._spare or ForkedKernel(self)
        self._spare = None if alone else ForkedKernel(self)
        kernel.begin(allowed, seconds)
        return kernel

    def _drop_spare(self):
        if self._spare is not None:
            self._spare.stop()
        self._spare = None

    def __exit__(self, *_error):
        self._drop_spare()
        self._stop_server()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def _start_server(self):
        """Start the process that forks, without waiting until it is ready."""
        confined = self.confined
        self._control, server_end = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._control.settimeout(60)
        settings = {
            "confined": confined,
            "user": bubblewrap.kernel_user() if confined else None,
            "limits": vars(self.limits),
            "control": server_end.fileno(),
        }
        code = f"import sys; sys.path += {bubblewrap.search_path(confined)!r}; "
        code += "from nbclassroom.autograder.sandbox.inside import fork_server; fork_server.main()"
        with server_end:
            self._process = subprocess.Popen(
                [*bubblewrap.sandbox_command(confined), "-c", code, json.dumps(settings)],
                env={} if confined else bubblewrap.environment(confined=False),
                cwd=self._folder,  # where cells write files
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                pass_fds=[server_end.fileno()],
                start_new_session=True,
            )
        self._is_ready, self._prepared = False, set()  # (a lesson's code, draws)
        self._replies = 0  # to the orders of `end`, that nobody has read yet

    def fork(self, descriptors):
        """Fork a kernel that has one end of a socket, and memory for its place in a page; returns its id."""
        self._fork_count += 1
        order = json.dumps({"op": "fork", "id": self._fork_count}).encode()
        for _ in range(_STARTS):  # somebody may kill it
            if self._process is None or self._process.poll() is not None:
                self._stop_server()
                self._start_server()
            with suppress(OSError):
                self._is_ready = self._is_ready or bool(self._control.recv(1 << 20))
                if self._is_ready:
                    socket.send_fds(self._control, [order], descriptors)
                    return self._fork_count
            last_words = self._stop_server()
        raise bubblewrap.SandboxError(f"the fork server did not start: {last_words or 'it was killed'}")

    def prepare(self, code, *, draws):
        """Let kernels have a lesson's cells compiled, a tuple of sources; and matplotlib, if a page draws."""
        if (code, draws) not in self._prepared:
            self._prepared.add((code, draws))
            with suppress(OSError):  # too many for one message
                self._control.send(json.dumps({"op": "prepare", "code": code, "draws": draws}).encode())

    def end(self, kernel_id, patience=0.0):
        """End a kernel that does not end by itself within `patience` seconds; the process replies later."""
        if self._process is None:
            return
        try:
            order = {"op": "end", "id": kernel_id, "patience": patience}
            self._control.send(json.dumps(order).encode())
            self._replies += 1
        except OSError:
            self._stop_server()

    def await_ends(self):
        """Wait until every kernel of `end` has ended, with all that it had started.

        Returns how the last one ended: "signal", "code", "cpu" (seconds); None if it had ended with the
        process.
        """
        status = None
        while self._process is not None and self._replies:
            self._replies -= 1
            try:
                status = json.loads(self._control.recv(1 << 16))
            except (OSError, ValueError):
                status = None
                self._stop_server()
        return status

    def used(self):
        """(bytes, seconds of processor time) that it and all its kernels use."""
        if self._process is None:
            return 0, 0.0
        return bubblewrap.used_under(self._process.pid, self.limits.memory)

    def _stop_server(self):
        """End the process and every kernel; returns what it said last. The next fork starts another one."""
        if self._process is None:
            return ""
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        # First: what has lost its bubblewrap ends by this, and until then it holds the pipe of errors.
        self._control.close()
        _, errors = self._process.communicate()
        self._process = None
        return " ".join(errors.decode(errors="replace").split())[-400:]
