"""The fork server and its kernels, seen from outside: cells go in, messages come out.

Nothing that comes out is trusted: it is read with a limit on its size and with a deadline that no message
extends, and all of it may be forged.
"""

import json
import os
import select
import socket
import subprocess
import time
from collections import deque
from contextlib import suppress
from functools import lru_cache

from imgproc_course.classroom.autograder.sandbox import bubblewrap
from imgproc_course.classroom.autograder.sandbox.cell_run import LOOK_SECONDS, CellRun

_OWN_SECONDS = 0.5  # of processor time, that the fork server and a waiting kernel use beside a check, at most
_STARTS = 3  # of a fork server that is not ready in time
_CONTENT_TYPES = {
    "stream": {"name": str, "text": str},
    "display_data": {"data": dict, "metadata": dict},
    "execute_result": {"data": dict, "metadata": dict, "execution_count": int},
    "update_display_data": {"data": dict, "metadata": dict},
    "clear_output": {"wait": bool},
    "error": {"ename": str, "evalue": str, "traceback": list},
    "idle": {"ename": str, "evalue": str},
}


class KernelEnded(Exception):
    """The kernel has ended; its text is a value of CellRun.ended. It never leaves this module."""


class ForkedKernel:
    """A kernel that was forked from a `ForkServer`."""

    def __init__(self, fork_server, allowed, seconds, limits, *, has_time=False):
        self._fork_server, self._limits = fork_server, limits
        self._seconds, self._deadline = seconds, None
        self._next_look, self._has_looked = 0.0, False
        self._cpu_limit = limits.for_system(seconds)["cpu"]
        self._lines, self._buffer, self._is_confined = deque(), b"", False
        our_end, kernel_end = socket.socketpair()
        self._socket = our_end
        with kernel_end:
            limits = limits.for_system(seconds)
            self._id = fork_server.fork(kernel_end.fileno(), allowed, limits, has_time=has_time)

    def run(self, code):
        """Run one cell; returns its CellRun."""
        return self._request({"code": code})

    def run_statements(self, sources):
        """Run cells of which each statement that fails costs only itself; the CellRun has the first error."""
        return self._request({"cells": [cell for source in sources for cell in _cells_to_send(source)]})

    def run_check(self, code, inputs, seconds):
        """Run a check cell with its inputs (see `check_cell.deliver`); returns its CellRun.

        The system limits the processor time of each process, and this limits that of all together: a slow
        answer could compute in one process after another.
        """
        group = self._fork_server.group
        cpu_before, began = group.cpu_seconds(), time.monotonic()
        run = self._request({"case": {"calls": inputs, "seconds": seconds}, "code": code})
        most = seconds * len(inputs) + self._limits.grace
        if run.ended or cpu_before is None or time.monotonic() - began <= most:
            return run
        if (group.cpu_seconds() or 0.0) - cpu_before > most + _OWN_SECONDS:
            run.ended = "time"
        return run

    def _request(self, request):
        run = CellRun()
        self._fork_server.finish_drops()  # nothing of the kernel before is left now, and counts for this one
        if self._deadline is None:  # the clock starts with the first cell: the kernel may have waited for it
            self._deadline = time.monotonic() + self._limits.deadline(self._seconds)
            self._next_look = time.monotonic() + LOOK_SECONDS
            self._fork_server.group.reset()
        try:
            self._send((json.dumps({"n": 1} | request) + "\n").encode("ascii"))
            bytes_left = self._limits.output
            while True:
                line = self._read_line(bytes_left)
                if not self._is_confined:  # its first line, which `fork_server` writes
                    self._is_confined = True
                    continue
                bytes_left -= len(line)
                if run.add(*_parse_message(line)):
                    return run
        except KernelEnded as error:
            run.ended = str(error)
            return run

    def is_alive(self):
        """Whether it runs cells; a waiting kernel may have been ended because memory ran out."""
        try:
            if not self._is_confined:
                self._is_confined = bool(self._socket.recv(1, socket.MSG_DONTWAIT))  # its first line
            return bool(self._socket.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT))
        except BlockingIOError:  # it is starting, or it waits
            return True
        except OSError:
            return False

    def _send(self, data):
        data = memoryview(data)
        self._socket.setblocking(False)
        while data:
            if not self._wait(select.POLLOUT):
                raise KernelEnded("time")
            try:
                data = data[self._socket.send(data) :]
            except BlockingIOError:
                continue
            except OSError as error:
                raise KernelEnded(self._how_it_ended()) from error

    def _wait(self, event):
        poll = select.poll()
        poll.register(self._socket, event)
        while True:
            seconds_left = self._deadline - time.monotonic()
            ready = poll.poll(max(0.0, min(seconds_left, LOOK_SECONDS)) * 1000)
            self._check_memory()
            if ready or seconds_left <= 0:
                return ready

    def _check_memory(self):
        """End the kernel if it and all that it started use too much memory together."""
        if time.monotonic() < self._next_look:
            return
        self._has_looked = True
        if self._fork_server.ran_out_of_memory():
            raise KernelEnded("memory")
        self._next_look = time.monotonic() + LOOK_SECONDS

    def _read_line(self, max_bytes):
        while not self._lines:
            if len(self._buffer) > max_bytes:
                raise KernelEnded("output")
            if not self._wait(select.POLLIN):
                raise KernelEnded("time")
            try:
                data = self._socket.recv(1 << 18)
            except BlockingIOError:
                continue
            except OSError:
                data = b""
            if not data:
                raise KernelEnded(self._how_it_ended())
            *lines, self._buffer = (self._buffer + data).split(b"\n")
            self._lines.extend(lines)
        line = self._lines.popleft()
        if len(line) > max_bytes:
            raise KernelEnded("output")
        return line

    def _how_it_ended(self):
        """The value of CellRun.ended for a kernel that ended by itself."""
        status = self._exit_status()
        if status is None:
            return "gone"
        self.is_alive()  # reads the first line, if nobody has
        if status["code"] == 70 and not self._is_confined:  # later, an answer can end with this code too
            raise bubblewrap.SandboxError("a kernel could not be confined; see imgproc-course doctor")
        if status["signal"] in (9, 24) and status["cpu"] > self._cpu_limit - 0.9:
            return "time"
        return "memory" if self._fork_server.ran_out_of_memory() else "crashed"

    def _exit_status(self):
        if self._id is None:
            return {"signal": 0, "code": 0, "cpu": 0.0}
        kernel_id, self._id = self._id, None
        # A process closes its sockets a moment before its end is known: wait for that.
        return self._fork_server.end(kernel_id, patience=1.0)

    def stop(self):
        """End the kernel and all that it started."""
        with suppress(OSError):
            self._socket.close()
        if self._id is not None:
            kernel_id, self._id = self._id, None
            if self._has_looked and self._fork_server.group.is_crowded():  # the next one needs that memory
                self._fork_server.end(kernel_id, patience=0)
            else:
                self._fork_server.drop(kernel_id)


@lru_cache(maxsize=16)  # every case that fails has a kernel of its own, with the same cells
def _cells_to_send(source):
    """A source as the kernel takes it: whole cells where it can tell the statements apart by itself."""
    # Its package imports NumPy; the fork server starts before that.
    from imgproc_course.classroom.exercises.cell_syntax import cells_of, parts_of

    cells = []
    for cell in cells_of(source):
        parts = parts_of(cell)
        if len(parts) > 1 and "async" not in cell and "await" not in cell:
            cells.append({"code": cell, "apart": True})
        else:
            cells += [{"code": part, "apart": False} for part in parts]
    return cells


def _parse_message(line):
    """Type and content of a message; the learner's process may have written anything."""
    try:
        message = json.loads(line)
        kind, content = message["type"], message["content"]
        field_types = _CONTENT_TYPES[kind]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise KernelEnded("hostile") from error
    if not isinstance(content, dict):
        raise KernelEnded("hostile")
    for name, field_type in field_types.items():
        if not isinstance(content.get(name), field_type):
            raise KernelEnded("hostile")
    return kind, content


class ForkServer:
    """The process that forks kernels, seen from outside; it is started again if it has ended.

    group   ProcessGroup of all its processes
    """

    def __init__(self, group, *, confined):
        self._confined = confined
        self.group = group
        self._process = None
        self._control = None
        self._is_ready = False
        self._fork_count = 0
        self._drops = 0  # that have no reply yet

    def start(self):
        """Start the process, without waiting until it is ready."""
        our_end, server_end = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with server_end:
            self._process = _start_process(server_end, self.group, confined=self._confined)
        self._control, self._is_ready = our_end, False

    def _await_ready(self):
        """Wait until it is loaded; it is started again if it ends before, because somebody may kill it."""
        for starts_left in reversed(range(_STARTS)):
            self._control.settimeout(60)
            with suppress(TimeoutError):
                self._is_ready = bool(self._control.recv(1 << 20))
            if self._is_ready:
                return
            errors = self._last_errors()
            self.stop()
            if starts_left:
                self.start()
        raise bubblewrap.SandboxError(f"the fork server did not start: {errors}")

    def _last_errors(self):
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, 9)
        errors = self._process.stderr.read().decode(errors="replace")
        return " ".join(errors.split())[-400:] or "it was killed"

    def fork(self, descriptor, allowed, limits, *, has_time=False):
        """Fork a kernel that has one end of a socket; returns its id.

        If it `has_time`, because it will wait for its first cell, it makes itself ready to run that faster.
        """
        if self._process is None or self._process.poll() is not None:
            self._close()
            self.start()
        self._fork_count += 1
        if not self._is_ready:
            self._await_ready()
        order = {
            "op": "fork",
            "id": self._fork_count,
            "allowed": list(allowed),
            "limits": limits,
            "has_time": has_time,
        }
        data = [json.dumps(order).encode()]
        try:
            socket.send_fds(self._control, data, [descriptor])
        except OSError:
            self.stop()
            self.start()
            self._await_ready()
            socket.send_fds(self._control, data, [descriptor])
        return self._fork_count

    def end(self, kernel_id, patience):
        """End a kernel that did not end by itself within `patience` seconds.

        Returns how it ended: "signal", "code", "cpu" (seconds); None if the fork server itself has ended.
        """
        order = {"op": "end", "id": kernel_id, "patience": patience}
        self.finish_drops()
        if self._control is None:
            return None
        try:
            self._control.send(json.dumps(order).encode())
            return json.loads(self._control.recv(1 << 16))
        except (OSError, ValueError):
            self.stop()
            return None

    def drop(self, kernel_id):
        """End a kernel without asking how it ended; `finish_drops` waits for its end."""
        if self._control is None:
            return
        try:
            self._control.send(json.dumps({"op": "drop", "id": kernel_id}).encode())
            self._drops += 1
        except OSError:
            self.stop()

    def finish_drops(self):
        """Wait until every kernel that was dropped has ended, with all that it had started."""
        while self._drops:
            self._drops -= 1
            try:
                if not self._control.recv(1 << 16):
                    self.stop()
            except OSError:
                self.stop()

    def ran_out_of_memory(self):
        """Whether the processes of all its kernels together use more memory than they may."""
        return self._process is not None and self.group.ran_out_of_memory(self._process.pid)

    def stop(self):
        """End the process and every kernel; the next fork starts another process."""
        if self._process is not None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, 9)
            self._process.wait()
        self._close()

    def _close(self):
        self._drops = 0
        if self._control is not None:
            self._control.close()
            self._control = None
        if self._process is not None:
            self._process.stderr.close()


def _start_process(control, group, *, confined):
    settings = {
        "confined": confined,
        "user": bubblewrap.kernel_user() if confined else None,
        "control": control.fileno(),
    }
    code = f"import sys; sys.path += {bubblewrap.search_path(confined)!r}; "
    code += "from imgproc_course.classroom.autograder.sandbox.inside import fork_server; fork_server.main()"
    return subprocess.Popen(
        [*bubblewrap.sandbox_command(confined), "-c", code, json.dumps(settings)],
        env={} if confined else bubblewrap.environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        pass_fds=[control.fileno()],
        preexec_fn=group.enter,
        start_new_session=True,
    )
