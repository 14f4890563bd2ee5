"""The forked kernel seen from outside: cells go in, what they did comes out, whatever runs in it.

What comes out is read with a limit on its size, and with a deadline that no message moves; all of it may be
forged, and is taken for no more than what a learner's process has said.
"""

import json
import os
import select
import socket
import time
from contextlib import suppress
from dataclasses import dataclass, field

from imgproc_course.autograder.sandbox import bubblewrap

MIME = "application/vnd.imgproc-course.answer+json"
_KINDS = {
    "stream": {"name": str, "text": str},
    "display_data": {"data": dict, "metadata": dict},
    "execute_result": {"data": dict, "metadata": dict, "execution_count": int},
    "update_display_data": {"data": dict, "metadata": dict},
    "clear_output": {"wait": bool},
    "error": {"ename": str, "evalue": str, "traceback": list},
    "idle": {"ename": str, "evalue": str},
}
LOOK = 0.05  # seconds between looks at the memory of all processes together
_SAID = 2_000  # characters of an error's text, and of what a cell printed, that are kept


@dataclass
class CellRun:
    """What running one cell did.

    ended     "" where the cell came to its end; else "time", "memory", "output", "crashed" or "hostile", or
              "gone" where the process that forks kernels was ended by somebody
    answers   what check cells showed: the contents of their vendor MIME type
    error     type and text of the exception that ended the cell; ("", "") for none
    printed   the first part of what it printed
    """

    ended: str = ""
    answers: list = field(default_factory=list)
    error: tuple = ("", "")
    printed: str = ""


class Ended(Exception):
    """Not an error: a kernel is gone; its word is one of CellRun.ended."""


class ForkedKernel:
    """A kernel forked from a `Zygote`."""

    def __init__(self, zygote, refused, seconds, limits):
        self._zygote, self._limits = zygote, limits
        self._seconds, self._deadline = seconds, None
        self._next_look, self._looked = 0.0, False
        self._cpu = limits.of_system(seconds)["cpu"]
        self._kept = b""
        ours, theirs = socket.socketpair()
        self._socket = ours
        with theirs:
            self._id = zygote.fork(theirs.fileno(), refused, limits.of_system(seconds))

    def run(self, code):
        """The messages of one cell, as `CellRun` tells them."""
        return self._asked({"code": code})

    def deliver(self, inputs, seconds, refused):
        """Hand over the inputs of the next check (see `check_cell.deliver`); a CellRun, as of a cell."""
        return self._asked({"case": {"calls": inputs, "seconds": seconds, "refused": list(refused)}})

    def _asked(self, request):
        run = CellRun()
        if self._deadline is None:  # the clock starts with the first cell: a kernel may have waited for it
            self._deadline = time.monotonic() + self._limits.deadline(self._seconds)
            self._next_look = time.monotonic() + LOOK
            self._zygote.group.forget()
        try:
            self._send((json.dumps({"n": 1} | request) + "\n").encode("ascii"))
            left = self._limits.output
            while True:
                line = self._line(left)
                left -= len(line)
                if take(run, *_read_line(line)):
                    return run
        except Ended as ended:
            run.ended = str(ended)
            return run

    def answers(self):
        """Whether it runs cells; one that waited may have been ended for want of memory."""
        return not self.run("").ended

    def _send(self, raw):
        raw = memoryview(raw)
        self._socket.setblocking(False)
        while raw:
            if not self._wait(select.POLLOUT):
                raise Ended("time")
            try:
                raw = raw[self._socket.send(raw) :]
            except BlockingIOError:
                continue
            except OSError as error:
                raise Ended(self._why()) from error

    def _wait(self, event):
        poll = select.poll()
        poll.register(self._socket, event)
        while True:
            left = self._deadline - time.monotonic()
            ready = poll.poll(max(0.0, min(left, LOOK)) * 1000)
            self._look()
            if ready or left <= 0:
                return ready

    def _look(self):
        """End it where it and all that it started use too much memory together."""
        if time.monotonic() < self._next_look:
            return
        self._looked = True
        if self._zygote.ran_out():
            raise Ended("memory")
        self._next_look = time.monotonic() + LOOK

    def _line(self, most):
        while b"\n" not in self._kept:
            if len(self._kept) > most:
                raise Ended("output")
            if not self._wait(select.POLLIN):
                raise Ended("time")
            try:
                more = self._socket.recv(1 << 18)
            except BlockingIOError:
                continue
            except OSError:
                more = b""
            if not more:
                raise Ended(self._why())
            self._kept += more
        line, _, self._kept = self._kept.partition(b"\n")
        if len(line) > most:
            raise Ended("output")
        return line

    def _why(self):
        """How a kernel ended that ended by itself."""
        end = self._end()
        if end is None:
            return "gone"
        if end["code"] == 70:
            raise bubblewrap.SandboxError("a kernel could not be shut in; see imgproc-course doctor")
        if end["signal"] in (9, 24) and end["cpu"] > self._cpu - 0.9:
            return "time"
        return "memory" if self._zygote.ran_out() else "crashed"

    def _end(self):
        if self._id is None:
            return {"signal": 0, "code": 0, "cpu": 0.0}
        name, self._id = self._id, None
        # A moment for its end to be known: a process that ends closes its socket before it is gone.
        return self._zygote.end(name, patience=1.0)

    def stop(self):
        """End the kernel and all that it started."""
        with suppress(OSError):
            self._socket.close()
        if self._id is not None:
            name, self._id = self._id, None
            if self._looked and self._zygote.group.is_crowded():  # the next one needs that memory
                self._zygote.end(name, patience=0)
            else:
                self._zygote.drop(name)


def _read_line(line):
    """The kind and content of a message; the learner's process may have written anything at all."""
    try:
        message = json.loads(line)
        kind, content = message["type"], message["content"]
        wanted = _KINDS[kind]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise Ended("hostile") from error
    if not isinstance(content, dict):
        raise Ended("hostile")
    for name, type_ in wanted.items():
        if not isinstance(content.get(name), type_):
            raise Ended("hostile")
    return kind, content


def take(run, kind, content):
    """Add a message to what a cell did; True at its end."""
    if kind == "idle":
        if not run.error[0]:  # a cell may fail without an error's being shown: a magic that is none
            run.error = (content["ename"][:100], content["evalue"][:_SAID])
        return True
    if kind == "stream" and len(run.printed) < _SAID:
        run.printed = (run.printed + content["text"])[:_SAID]
    elif kind == "error":
        run.error = (content["ename"][:100], content["evalue"][:_SAID])
    elif kind in ("display_data", "execute_result") and MIME in content["data"]:
        run.answers.append(content["data"][MIME])
    return False


class Zygote:
    """The process that forks kernels, seen from outside; started again when it is gone.

    group     Group of all of them
    """

    def __init__(self, group, *, confined):
        self._confined = confined
        self.group = group
        self._process = None
        self._control = None
        self._ready = False
        self._count = 0

    def begin(self):
        """Start it, without waiting until it is ready."""
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = bubblewrap.start_zygote(theirs, self.group, confined=self._confined)
        self._control, self._ready = ours, False

    def _await(self):
        self._control.settimeout(60)
        try:
            ready = self._control.recv(1 << 20)
        except TimeoutError:
            ready = b""
        if not ready:
            said = self._last_words()
            self.stop()
            raise bubblewrap.SandboxError(f"the kernels' process did not start: {said}")
        self._ready = True

    def _last_words(self):
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        said = self._process.stderr.read().decode(errors="replace")
        return " ".join(said.split())[-400:] or f"exit code {self._process.returncode}"

    def fork(self, descriptor, refused, limits):
        """Fork a kernel; returns its number."""
        if self._process is None or self._process.poll() is not None:
            self.begin()
        self._count += 1
        hidden = [place for module in refused for place in bubblewrap.places_of(module)]  # while it loads
        if not self._ready:
            self._await()
        order = {
            "op": "fork",
            "id": self._count,
            "hidden": hidden,
            "refused": list(refused),
            "limits": limits,
        }
        raw = [json.dumps(order).encode()]
        try:
            socket.send_fds(self._control, raw, [descriptor])
        except OSError:
            self.stop()
            self.begin()
            self._await()
            socket.send_fds(self._control, raw, [descriptor])
        return self._count

    def end(self, name, patience):
        """End a kernel: how it had ended, or None where this process has ended itself."""
        order = {"op": "end", "id": name, "patience": patience}
        if self._control is None:
            return None
        try:
            self._control.send(json.dumps(order).encode())
            return json.loads(self._control.recv(1 << 16))
        except (OSError, ValueError):
            self.stop()
            return None

    def drop(self, name):
        """End a kernel of which nothing more is to be known."""
        if self._control is None:
            return
        try:
            self._control.send(json.dumps({"op": "drop", "id": name, "patience": 0}).encode())
        except OSError:
            self.stop()

    def ran_out(self):
        """Whether all its kernels' processes together use more memory than they may."""
        return self._process is not None and self.group.ran_out(self._process.pid)

    def stop(self):
        """End it and every kernel; the next fork starts another."""
        if self._control is not None:
            self._control.close()
            self._control = None
        if self._process is not None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, 9)
            self._process.wait()
            if self._process.stderr:
                self._process.stderr.close()
