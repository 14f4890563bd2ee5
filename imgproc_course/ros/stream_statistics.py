"""Statistics of the images that a node receives: counts, losses, times, changes, and silence."""

import collections
import time

import numpy as np

SILENCE = 3.0  # seconds without an image after which a stream is silent
RECENT = 600  # images from which rate and times are computed
LATE = 1.5  # seconds between two reports, one second apart, from which on the thread was blocked


class StreamMonitor:
    """Notices what changes in a stream of images, and whether it has become silent."""

    def __init__(self):
        self._format = self._reported_format = self._stamp = None
        self._last_arrival = time.monotonic()
        self._is_silent = False
        self._pause = self._step_back = 0.0  # seconds, not reported yet

    def observe(self, msg):
        now = time.monotonic()
        if self._is_silent:
            self._pause, self._is_silent = now - self._last_arrival, False
        self._last_arrival = now
        self._format = _format(msg)
        stamp = msg.header.stamp.sec * 10**9 + msg.header.stamp.nanosec
        if self._stamp is not None:
            self._step_back = max(self._step_back, (self._stamp - stamp) / 1e9)
        self._stamp = stamp

    def changes(self):
        """Yields one sentence for each change since the last call."""
        if self._pause:
            yield f"images arrive again, after {self._pause:.1f} s without"
        if self._format != self._reported_format:
            previous = f" (was {self._reported_format})" if self._reported_format else ""
            yield f"size and encoding: {self._format}{previous}"
        if self._step_back:
            yield (
                f"stamps went back by {self._step_back:.3f} s: the camera was restarted, its recording "
                "started again, or its clock was set; the node continues"
            )
        self._reported_format, self._pause, self._step_back = self._format, 0.0, 0.0

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

    def set_publishers(self, count):
        """Takes the new number of publishers: each has its own numbers, and two cannot be told apart."""
        self._last_number = None
        self._can_count = count <= 1

    def on_matched(self, event):
        """The callback of a subscription whose publishers have changed."""
        self.set_publishers(event.current_count)

    @property
    def lost(self):
        """`total`, or None while it cannot be known: several publishers, or messages without numbers."""
        return self.total if self._can_count else None


class ProcessingStatistics:
    """What an ImageProcessor counts and times; `ImageProcessor.statistics` explains it."""

    def __init__(self):
        self.received = self.processed = self.failed = self.ignored = 0
        self.last_error: str | None = None
        self.busy = 0.0  # seconds spent in the callback
        self.losses = LossCounter()
        self._arrivals = collections.deque[float](maxlen=RECENT)  # seconds, as the next two
        self._latencies = collections.deque[float](maxlen=RECENT)
        self._durations = collections.deque[float](maxlen=RECENT)
        self._reported = (0, 0, 0.0, time.perf_counter())

    def count_received(self, number):
        """Counts a message that arrived, with the number that its publisher gave it."""
        self.received += 1
        self._arrivals.append(time.monotonic())
        self.losses.receive(number)

    def count_processed(self, latency, duration):
        """Counts an image whose results are published; both times in seconds."""
        self.processed += 1
        self._latencies.append(latency)
        self._durations.append(duration)

    def new_losses(self):
        """Why images were lost since the last call, and how many: two parts of a line; None if none was."""
        lost, received, busy, start = self._reported
        now = time.perf_counter()
        self._reported = (self.losses.total, self.received, self.busy, now)
        lost = self.losses.total - lost
        if not lost:
            return None
        busy_share = (self.busy - busy) / (now - start)
        period = "second" if now - start < LATE else f"{now - start:.1f} s"
        counts = f" ({lost} of {lost + self.received - received} images of the last {period})"
        if busy_share > 0.5:
            return "this node is busy most of the time, so the oldest images are dropped", counts
        if now - start >= LATE:
            return "this node was blocked for some time, so the oldest images were dropped", counts
        return (
            "images get lost on the way to this node: the machine is too busy (subscribe to the /compressed "
            "topic), or the program of the camera does not import imgproc_course.ros"
        ), counts

    def as_dict(self):
        span = self._arrivals[-1] - self._arrivals[0] if len(self._arrivals) > 1 else 0
        return {
            "received": self.received,
            "processed": self.processed,
            "failed": self.failed,
            "ignored": self.ignored,
            "lost": self.losses.lost,
            "rate": round((len(self._arrivals) - 1) / span, 1) if span else None,
            "latency_ms": _percentiles(self._latencies),
            "process_ms": _percentiles(self._durations),
            "last_error": self.last_error,
        }


def _percentiles(seconds):
    return np.percentile(seconds, (50, 99)).dot(1e3).round(2).tolist() if seconds else None


def statistics_line(statistics):
    counts = ("received", "processed", "failed", "ignored", "lost")
    parts = [f"{statistics[key]} {key}" for key in counts if statistics[key] is not None]
    if statistics["rate"] is not None:
        parts.append(f"{statistics['rate']} Hz")
    if statistics["latency_ms"] is not None:
        parts.append("latency {} ms (median), {} ms (99 %)".format(*statistics["latency_ms"]))
    if statistics["last_error"] is not None:
        parts.append(f"last error: {statistics['last_error']}")
    return ", ".join(parts)


def _format(msg):
    if hasattr(msg, "format"):
        return msg.format
    return f"{msg.width}×{msg.height} {msg.encoding}"
