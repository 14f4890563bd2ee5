"""What a node counts and notices: losses by the publisher's own numbers, rates, changes, silence."""

from types import SimpleNamespace

import pytest

from imgproc_course.ros import stream_statistics
from imgproc_course.ros.stream_statistics import ProcessingStatistics, StreamMonitor, statistics_line


def image_message(seconds, width=64, encoding="rgb8"):
    stamp = SimpleNamespace(sec=seconds, nanosec=0)
    header = SimpleNamespace(stamp=stamp)
    return SimpleNamespace(header=header, width=width, height=48, encoding=encoding)


@pytest.fixture
def clock(monkeypatch):
    """A clock that changes only when the test sets it."""
    clock = SimpleNamespace(now=100.0)
    monkeypatch.setattr(stream_statistics.time, "monotonic", lambda: clock.now)
    monkeypatch.setattr(stream_statistics.time, "perf_counter", lambda: clock.now)
    return clock


def test_without_message_numbers_the_losses_are_unknown():
    statistics = ProcessingStatistics()
    statistics.count_received(None)
    statistics.count_received(None)
    assert (statistics.as_dict()["lost"], statistics.new_losses()) == (None, None)


@pytest.mark.parametrize(
    "busy, elapsed, why, period",
    [
        (0.9, 1.0, "this node is busy most of the time, so the oldest images are dropped", "second"),
        (0.1, 1.0, "images get lost on the way to this node: the machine is too busy", "second"),
        (0.1, 2.7, "this node was blocked for some time, so the oldest images were dropped", "2.7 s"),
        (2.7, 3.0, "this node is busy most of the time, so the oldest images are dropped", "3.0 s"),
    ],
)
def test_losses_are_reported_once_with_their_cause(clock, busy, elapsed, why, period):
    statistics = ProcessingStatistics()
    for number in (1, 2, 6):
        statistics.count_received(number)
    statistics.busy, clock.now = busy, clock.now + elapsed
    cause, counts = statistics.new_losses()
    assert cause.startswith(why) and counts == f" (3 of 6 images of the last {period})"
    clock.now += 1.0
    assert statistics.new_losses() is None


def test_rate_and_times(clock):
    statistics = ProcessingStatistics()
    for number in range(1, 12):
        statistics.count_received(number)
        statistics.count_processed(latency=number / 1000, duration=0.002)
        clock.now += 0.05
    values = statistics.as_dict()
    assert values["rate"] == 20.0
    assert (values["latency_ms"], values["process_ms"]) == ([6.0, 10.9], [2.0, 2.0])
    assert statistics_line(values) == (
        "11 received, 11 processed, 0 failed, 0 ignored, 0 lost, 20.0 Hz, "
        "latency 6.0 ms (median), 10.9 ms (99 %)"
    )


def test_before_the_first_image_there_is_no_rate_and_no_time():
    values = ProcessingStatistics().as_dict()
    assert (values["rate"], values["latency_ms"], values["process_ms"]) == (None, None, None)
    assert statistics_line(values) == "0 received, 0 processed, 0 failed, 0 ignored, 0 lost"


def test_each_change_of_the_stream_is_reported_once(clock):
    stream = StreamMonitor()
    stream.observe(image_message(10))
    assert list(stream.changes()) == ["size and encoding: 64×48 rgb8"]
    stream.observe(image_message(11))
    assert list(stream.changes()) == []
    stream.observe(image_message(12, 32, "mono8"))
    stream.observe(image_message(9, 32, "mono8"))
    assert list(stream.changes()) == [
        "size and encoding: 32×48 mono8 (was 64×48 rgb8)",
        "stamps went back by 3.000 s: the camera was restarted, its recording started again, or its clock "
        "was set; the node continues",
    ]
    assert list(stream.changes()) == []


def test_silence_is_reported_once_and_its_end_too(clock):
    stream = StreamMonitor()
    stream.observe(image_message(1))
    list(stream.changes())
    clock.now += 2.9
    assert not stream.has_become_silent()
    clock.now += 0.1
    assert stream.has_become_silent()
    assert not stream.has_become_silent()
    clock.now += 4.0
    stream.observe(image_message(2))
    assert list(stream.changes()) == ["images arrive again, after 7.0 s without"]
    assert not stream.has_become_silent()
