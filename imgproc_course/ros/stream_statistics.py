"""What a node counts of the images that it receives, lost ones too, and whether they have stopped."""

import time

COUNTS = ("received", "processed", "failed", "ignored")  # of images
SILENCE = 3.0  # seconds without an image after which a stream is silent
LATE = 1.5  # seconds between two reports, one second apart, from which on the thread was blocked


class SilenceMonitor:
    """Notices that a stream of images has become silent, and that it goes on."""

    def __init__(self):
        self._last_arrival, self._is_silent = time.monotonic(), False

    def observe(self):
        """Takes the arrival of an image; the seconds of a silence that it ends, else 0."""
        now = time.monotonic()
        pause = now - self._last_arrival if self._is_silent else 0.0
        self._last_arrival, self._is_silent = now, False
        return pause

    def has_become_silent(self):
        """True once, when no image has arrived for some seconds."""
        if self._is_silent or time.monotonic() - self._last_arrival < SILENCE:
            return False
        self._is_silent = True
        return True


class LossCounter:
    """Counts the messages that the publisher sent and this process never received.

    A publisher numbers its messages. If a number is missing, that message is lost: on the way, or because it
    was overwritten in the queue while the callback's thread was busy.
    """

    def __init__(self):
        self.total = 0  # messages known to be lost
        self._can_count = True
        self._last_number: int | None = None

    def receive(self, number):
        """Takes the number of a message that arrived; None or 0 if the middleware does not number them."""
        if not number:
            self._can_count = False
        elif self._can_count and self._last_number is not None and number > self._last_number:
            self.total += number - self._last_number - 1
        self._last_number = number

    def on_matched(self, event):
        """Takes a change of the publishers: each has its own numbers, and two cannot be told apart."""
        self._last_number = None
        self._can_count = event.current_count <= 1

    @property
    def lost(self):
        """`total`, or None while it cannot be known: several publishers, or messages without numbers."""
        return self.total if self._can_count else None


class ProcessingStatistics:
    """What an ImageProcessor counts; `ImageProcessor.statistics` explains it."""

    def __init__(self):
        self.received = self.processed = self.failed = self.ignored = 0
        self.last_error: str | None = None
        self.busy = 0.0  # seconds spent in the callback
        self.losses = LossCounter()
        self._reported = (0, 0, 0.0, time.perf_counter())

    def new_losses(self):
        """Why images were lost since the last call, and how many: two parts of a line; None if none was."""
        lost, received, busy, start = self._reported
        now = time.perf_counter()
        self._reported = (self.losses.total, self.received, self.busy, now)
        lost = self.losses.total - lost
        if not lost:
            return None
        elapsed = now - start
        counts = f" ({lost} of {lost + self.received - received} images of the last {elapsed:.1f} s)"
        if self.busy - busy > elapsed / 2 or elapsed >= LATE:
            return "this node was busy or blocked, so the oldest images were dropped", counts
        return (
            "images get lost on the way to this node: the machine is too busy (subscribe to the /compressed "
            "topic), or the program of the camera does not import imgproc_course.ros"
        ), counts

    def as_dict(self):
        counts = {name: getattr(self, name) for name in COUNTS}
        return {**counts, "lost": self.losses.lost, "last_error": self.last_error}


def statistics_line(statistics):
    parts = [f"{statistics[key]} {key}" for key in (*COUNTS, "lost") if statistics[key] is not None]
    if statistics["last_error"] is not None:
        parts.append(f"last error: {statistics['last_error']}")
    return ", ".join(parts)
