"""The process that reads notebooks, and the conversation with it; `submission_reader` is its program."""

import contextlib
import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

from .. import course

SECONDS = 60  # of processor time, for one request
MEMORY = 2 << 30  # bytes, of the process that reads notebooks
NOT_READ_IN_TIME = "reading it takes more time or memory than a notebook needs"
_TRIES = 4  # for one request
_READER = Path(__file__).with_name("submission_reader.py")


class NotebookReader(contextlib.AbstractContextManager):
    """The process that reads notebooks; each request has `seconds` of processor time, `memory` bytes."""

    def __init__(self, seconds=SECONDS, memory=MEMORY):
        self._arguments = [str(memory), str(seconds), course.name]
        self._process: Any = None  # a Popen, after the first request
        self._last_read = b""

    def read(self, data):
        """(What `submission_reader.read_notebook` makes of bytes, ""), or (None, why they are not read)."""
        self._last_read = data
        reply = self._reply(b"read", data) or {"reason": NOT_READ_IN_TIME}
        return reply.get("notebook"), reply.get("reason", "")

    def page(self, lesson_cells, exercises):
        """What `page.page_of_notebook` gives of the last notebook, and `shapes` of its answers.

        Three None if it takes too much.
        """
        reply = self._reply(b"page", json.dumps([lesson_cells, exercises]).encode("ascii")) or {}
        return reply.get("page"), reply.get("places"), reply.get("shapes")

    def _reply(self, kind, data):
        """The reply to a request, a dict; None if it takes too much, or is ended too often."""
        for _ in range(_TRIES):  # somebody else may end it
            if self._process is None:
                command = [sys.executable, "-I", "-S", "-B", str(_READER), *self._arguments]
                pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
                self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere)
                if kind == b"page":  # a new process does not know the notebook
                    self._exchange(b"read", self._last_read)
            line = self._exchange(kind, data)
            if line.endswith(b"\n"):
                return json.loads(line)
            if self.close() == -signal.SIGPROF:
                break
        return None

    def _exchange(self, kind, data):
        with contextlib.suppress(OSError):
            self._process.stdin.write(b"%b %d\n%b" % (kind, len(data), data))
            self._process.stdin.flush()
            return self._process.stdout.readline()
        return b""

    def close(self):
        """End the process; returns how it ended, as `Popen.returncode` says it."""
        if self._process is None:
            return None
        process, self._process = self._process, None
        process.kill()
        for stream in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                stream.close()
        return process.wait()

    def __exit__(self, *_error):
        self.close()
