"""Ctrl-C and SIGTERM as an event, for what runs until one of them."""

import contextlib
import math
import signal
import threading


@contextlib.contextmanager
def stop_signals(patience=math.inf):
    """An event that either signal sets; in the main thread. The handlers before are put back at the end.

    One more signal than `patience` interrupts at once, as Ctrl-C usually does.
    """
    stopping, numbers = threading.Event(), []

    def on_signal(number, _):
        numbers.append(number)
        stopping.set()
        if len(numbers) > patience:
            raise KeyboardInterrupt

    handlers = {number: signal.signal(number, on_signal) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stopping
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
