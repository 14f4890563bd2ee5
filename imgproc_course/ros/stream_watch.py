"""What a node counts, times, and notices of the pictures that come to it, in numbers and in words."""

import collections
import time

import numpy as np

SILENCE = 3.0  # seconds without a picture after which a stream is silent
RECENT = 600  # pictures that rate and times are taken from
LATE = 1.5  # seconds from one look to the next, due after one, by which something has held up the thread


class Stream:
    """The camera's pictures as a stream: what changes from one to the next, to be told once a while."""

    def __init__(self):
        self._look = self._told_look = self._stamp = None
        self._last = time.monotonic()
        self._silent = False
        self._pause = self._step_back = 0.0  # seconds, not told yet

    def see(self, msg):
        """Takes note of a picture."""
        now = time.monotonic()
        if self._silent:
            self._pause, self._silent = now - self._last, False
        self._last = now
        self._look = _look(msg)
        stamp = msg.header.stamp.sec * 10**9 + msg.header.stamp.nanosec
        if self._stamp is not None:
            self._step_back = max(self._step_back, (self._stamp - stamp) / 1e9)
        self._stamp = stamp

    def news(self):
        """What has changed since the last call, in sentences."""
        if self._pause:
            yield f"pictures come, after {self._pause:.1f} s without"
        if self._look != self._told_look:
            former = f" (were {self._told_look})" if self._told_look else ""
            yield f"size and encoding: {self._look}{former}"
        if self._step_back:
            yield (
                f"stamps went back by {self._step_back:.3f} s: the camera was restarted, its recording began "
                "anew, or its clock was set; going on"
            )
        self._told_look, self._pause, self._step_back = self._look, 0.0, 0.0

    def has_fallen_silent(self):
        """True once, when no picture has come for some seconds."""
        if self._silent or time.monotonic() - self._last < SILENCE:
            return False
        self._silent = True
        return True


class Tally:
    """What an ImageProcessor counts and times."""

    def __init__(self):
        self.received = self.processed = self.failed = self.unheard = 0
        self.last_error = None
        self.busy = 0.0  # seconds spent in the callback
        self._lost, self._counts, self._sequence = 0, True, None
        self._arrivals = collections.deque(maxlen=RECENT)
        self._latencies = collections.deque(maxlen=RECENT)
        self._spans = collections.deque(maxlen=RECENT)
        self._told = (0, 0, 0.0, time.perf_counter())

    def arrived(self, sequence):
        self.received += 1
        self._arrivals.append(time.monotonic())
        # The publisher numbers its messages; a number left out is a message that never came.
        if not sequence:
            self._counts = False
        elif self._counts and self._sequence is not None and sequence > self._sequence:
            self._lost += sequence - self._sequence - 1
        self._sequence = sequence

    def cameras(self, count):
        """Another publisher counts anew, and two at a time cannot be told apart."""
        self._sequence = None
        self._counts = count <= 1

    def done(self, latency, span):
        self.processed += 1
        self._latencies.append(latency)
        self._spans.append(span)

    def new_losses(self):
        """What was lost since the last call and why, in one line; None where nothing was."""
        lost, received, busy, then = self._told
        now = time.perf_counter()
        self._told = (self._lost, self.received, self.busy, now)
        lost = self._lost - lost
        if not lost:
            return None
        sent = lost + self.received - received
        share = (self.busy - busy) / (now - then)
        lasted = "second" if now - then < LATE else f"{now - then:.1f} s"
        start = f"{lost} of {sent} pictures of the last {lasted} never came: "
        if share > 0.5:
            return f"{start}this node is busy {share:.0%} of the time, so the oldest are dropped"
        if now - then >= LATE:
            return f"{start}this node's thread was held up meanwhile, so the oldest were dropped"
        return (
            f"{start}lost on the way; does the camera's process use the course's DDS profile (import "
            "imgproc_course.ros there)? Or this machine is too busy: subscribe to the /compressed topic"
        )

    def as_dict(self):
        span = self._arrivals[-1] - self._arrivals[0] if len(self._arrivals) > 1 else 0
        return {
            "received": self.received,
            "processed": self.processed,
            "failed": self.failed,
            "unheard": self.unheard,
            "lost": self._lost if self._counts else None,
            "rate": round((len(self._arrivals) - 1) / span, 1) if span else None,
            "latency_ms": _percentiles(self._latencies),
            "process_ms": _percentiles(self._spans),
            "last_error": self.last_error,
        }


def _percentiles(seconds):
    return np.percentile(seconds, (50, 99)).dot(1e3).round(2).tolist() if seconds else None


def in_words(numbers):
    words = [f"{numbers[key]} {key}" for key in ("received", "processed", "failed", "unheard")]
    if numbers["lost"] is not None:
        words.append(f"{numbers['lost']} lost")
    if numbers["rate"] is not None:
        words.append(f"{numbers['rate']} Hz")
    if numbers["latency_ms"] is not None:
        words.append("latency {} ms (median), {} ms (99 %)".format(*numbers["latency_ms"]))
    if numbers["last_error"] is not None:
        words.append(f"last error: {numbers['last_error']}")
    return ", ".join(words)


def _look(msg):
    if hasattr(msg, "format"):
        return msg.format
    return f"{msg.width}×{msg.height} {msg.encoding}"
