"""Ctrl-C and SIGTERM as an event, for the commands that run until one of them."""

import contextlib
import signal
import threading

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


@contextlib.contextmanager
def stop_signals():
    """An event that either signal sets; in the main thread. The handlers before are put back at the end."""
    stopping = threading.Event()
    handlers = {number: signal.signal(number, lambda *_: stopping.set()) for number in _NUMBERS}
    try:
        yield stopping
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
