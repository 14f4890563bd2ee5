"""The process that reads notebooks, and the conversation with it; `submission_reader` is its program."""

import contextlib
import json
import resource
import select
import subprocess
import sys
import time
from pathlib import Path

SECONDS = 60  # for reading one notebook
MEMORY = 2 << 30  # bytes, of the process that reads notebooks
NOT_READ_IN_TIME = "reading it takes more time or memory than a notebook needs"
_READER = Path(__file__).with_name("submission_reader.py")


class NotebookReader:
    """The process that reads notebooks. It starts when it is needed, and again if a notebook has ended it.

    Parameters
    ----------
    seconds : float, for reading one notebook
    memory : int, bytes
    cpu_seconds : int, for all notebooks together, or None; on a busy machine they take longer
    """

    def __init__(self, seconds=SECONDS, memory=MEMORY, cpu_seconds=None):
        self._seconds, self._memory, self._cpu_seconds = seconds, memory, cpu_seconds
        self._process, self._last_read = None, b""

    def read(self, data):
        """Read a notebook.

        Parameters
        ----------
        data : bytes

        Returns
        -------
        (dict as `submission_reader.read_notebook` returns it, ""), or (None, the reason)
        """
        self._last_read = data
        for _ in range(2):  # somebody else may have ended the process
            reply = self._reply(b"read", data)
            if reply is not None:
                return reply.get("notebook"), reply.get("reason", "")
        return None, NOT_READ_IN_TIME

    def compose(self, requests):
        """Compose the sources by which answers in the last notebook are graded.

        Parameters
        ----------
        requests : list of the arguments of `cell_syntax.CellDefinitions.compose`

        Returns
        -------
        list of [source, [[name, kind, number of the cell], ...]], or None if it takes too much time or memory
        """
        data = json.dumps(requests).encode("ascii")
        for _ in range(2):  # as above; a new process does not know the notebook
            if self._process is None:
                self._reply(b"read", self._last_read)
            reply = self._process and self._reply(b"compose", data)
            if reply:
                return reply.get("answers")
        return None

    def _reply(self, kind, data):
        """The reply to a request as a dict; None, and the process is ended, if there is none in time."""
        if self._process is None:
            self._start()
        line = b""
        with contextlib.suppress(OSError):
            line = self._reply_line(b"%b %d\n" % (kind, len(data)), data)
        if not line.endswith(b"\n"):
            self.close()
            return None
        return json.loads(line)

    def _reply_line(self, header, data):
        stdin, stdout = self._process.stdin, self._process.stdout
        stdin.write(header)
        stdin.write(data)
        stdin.flush()
        end, chunks = time.monotonic() + self._seconds, [b""]
        while not chunks[-1].endswith(b"\n"):
            readable, _, _ = select.select([stdout], [], [], max(0.0, end - time.monotonic()))
            chunk = stdout.read1(1 << 20) if readable else b""
            if not chunk:
                break
            chunks.append(chunk)
        return b"".join(chunks)

    def _start(self):
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", "-B", str(_READER), str(self._memory)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        if self._cpu_seconds:
            limits = (self._cpu_seconds, self._cpu_seconds)
            resource.prlimit(self._process.pid, resource.RLIMIT_CPU, limits)

    def close(self):
        """End the process."""
        if self._process is None:
            return
        process, self._process = self._process, None
        process.kill()
        for stream in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                stream.close()
        process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()
