"""Captures what a learner's function prints on a thread, to show it under its own view."""

import sys
import threading
from contextlib import contextmanager

MOST_LINES = 3


class _ThreadAwareStream:
    """Replaces sys.stdout: captures what the threads in `captures` write, and passes on everything else."""

    def __init__(self, stream):
        self.stream, self.captures = stream, {}

    def write(self, text):
        pieces = self.captures.get(threading.get_ident())
        if pieces is None:
            return self.stream.write(text)
        pieces.append(text)
        return len(text)

    def __getattr__(self, name):
        return getattr(self.stream, name)


_lock = threading.Lock()


@contextmanager
def captured_prints():
    """Within it, what the calling thread prints goes into the yielded list, which `last_lines` reads."""
    pieces: list[str] = []
    with _lock:
        if not isinstance(sys.stdout, _ThreadAwareStream):
            sys.stdout = _ThreadAwareStream(sys.stdout)
        stream = sys.stdout
        stream.captures[threading.get_ident()] = pieces
    try:
        yield pieces
    finally:
        with _lock:
            del stream.captures[threading.get_ident()]
            if not stream.captures and sys.stdout is stream:
                sys.stdout = stream.stream


def last_lines(pieces):
    """The last lines printed, as one text; empties the list."""
    lines = "".join(pieces).splitlines()[-MOST_LINES:]
    pieces.clear()
    return "\n".join(lines)
