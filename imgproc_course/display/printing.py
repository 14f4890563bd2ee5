"""What a learner's function prints on a thread: kept for its own view, not poured into some cell."""

import sys
import threading
from contextlib import contextmanager

MOST_LINES = 3


class _ThreadAwareStream:
    """Stands in for sys.stdout: keeps what the threads in `kept` write, and passes on everything else."""

    def __init__(self, stream):
        self.stream, self.kept = stream, {}

    def write(self, text):
        kept = self.kept.get(threading.get_ident())
        if kept is None:
            return self.stream.write(text)
        kept.append(text)
        return len(text)

    def __getattr__(self, name):
        return getattr(self.stream, name)


_lock = threading.Lock()


@contextmanager
def prints_kept():
    """Within it, what the calling thread prints goes into the list that it yields, for `last_lines`."""
    kept = []
    with _lock:
        if not isinstance(sys.stdout, _ThreadAwareStream):
            sys.stdout = _ThreadAwareStream(sys.stdout)
        stream = sys.stdout
        stream.kept[threading.get_ident()] = kept
    try:
        yield kept
    finally:
        with _lock:
            del stream.kept[threading.get_ident()]
            if not stream.kept and sys.stdout is stream:
                sys.stdout = stream.stream


def last_lines(kept):
    """The last lines printed, as one text; empties the list."""
    lines = "".join(kept).splitlines()[-MOST_LINES:]
    kept.clear()
    return "\n".join(lines)
