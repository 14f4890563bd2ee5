"""What a node counts and notices: losses by the publisher's own numbers, silence and its end."""

from types import SimpleNamespace

import pytest

from imgproc_course.ros import stream_statistics
from imgproc_course.ros.stream_statistics import ProcessingStatistics, SilenceMonitor, statistics_line


@pytest.fixture
def clock(monkeypatch):
    """A clock that changes only when the test sets it."""
    clock = SimpleNamespace(now=100.0)
    monkeypatch.setattr(stream_statistics.time, "monotonic", lambda: clock.now)
    monkeypatch.setattr(stream_statistics.time, "perf_counter", lambda: clock.now)
    return clock


def test_without_message_numbers_the_losses_are_unknown():
    statistics = ProcessingStatistics()
    statistics.losses.receive(None)
    assert (statistics.as_dict()["lost"], statistics.new_losses()) == (None, None)
    assert statistics_line(statistics.as_dict()) == "0 received, 0 processed, 0 failed, 0 ignored"


@pytest.mark.parametrize(
    "busy, elapsed, why",
    [
        (0.9, 1.0, "this node was busy or blocked, so the oldest images were dropped"),
        (0.1, 1.0, "images get lost on the way to this node: the machine is too busy"),
        (0.1, 2.7, "this node was busy or blocked, so the oldest images were dropped"),
    ],
)
def test_losses_are_reported_once_with_their_cause(clock, busy, elapsed, why):
    statistics = ProcessingStatistics()
    for number in (1, 2, 6):
        statistics.received += 1
        statistics.losses.receive(number)
    statistics.busy, clock.now = busy, clock.now + elapsed
    cause, counts = statistics.new_losses()
    assert cause.startswith(why) and counts == f" (3 of 6 images of the last {elapsed} s)"
    clock.now += 1.0
    assert statistics.new_losses() is None
    line = "3 received, 0 processed, 0 failed, 0 ignored, 3 lost"
    assert statistics_line(statistics.as_dict()) == line


def test_silence_is_reported_once_and_its_end_too(clock):
    stream = SilenceMonitor()
    assert stream.observe() == 0
    clock.now += 2.9
    assert not stream.has_become_silent()
    clock.now += 0.1
    assert stream.has_become_silent()
    assert not stream.has_become_silent()
    clock.now += 4.0
    assert stream.observe() == 7.0
    assert not stream.has_become_silent()
