"""What a node counts and notices of its pictures: losses by the camera's own count, changes, silence."""

from types import SimpleNamespace

import pytest

from imgproc_course.ros import stream_watch
from imgproc_course.ros.stream_watch import Stream, Tally, in_words


def picture(seconds, width=64, encoding="rgb8"):
    stamp = SimpleNamespace(sec=seconds, nanosec=0)
    header = SimpleNamespace(stamp=stamp)
    return SimpleNamespace(header=header, width=width, height=48, encoding=encoding)


@pytest.fixture
def clock(monkeypatch):
    """A clock that stands still until it is set."""
    clock = SimpleNamespace(now=100.0)
    monkeypatch.setattr(stream_watch.time, "monotonic", lambda: clock.now)
    monkeypatch.setattr(stream_watch.time, "perf_counter", lambda: clock.now)
    return clock


def test_numbers_that_the_camera_left_out_are_lost_and_a_new_camera_counts_anew():
    tally = Tally()
    for number in (7, 8, 12, 13):
        tally.arrived(number)
    assert tally.as_dict()["lost"] == 3
    tally.cameras(1)  # the camera was restarted
    for number in (1, 2, 4):
        tally.arrived(number)
    assert tally.as_dict()["lost"] == 4
    tally.cameras(2)  # two at a time cannot be told apart
    tally.arrived(90)
    tally.arrived(5)
    assert tally.as_dict()["lost"] is None
    tally.cameras(1)
    tally.arrived(6)
    tally.arrived(8)
    assert tally.as_dict()["lost"] == 5


def test_a_middleware_that_does_not_number_messages_tells_no_losses():
    tally = Tally()
    tally.arrived(None)
    tally.arrived(None)
    assert (tally.as_dict()["lost"], tally.new_losses()) == (None, None)


@pytest.mark.parametrize(
    "busy, passed, told",
    [
        (0.9, 1.0, "last second never came: this node is busy 90% of the time, so the oldest are dropped"),
        (0.1, 1.0, "last second never came: lost on the way; does the camera's process use the course's DDS"),
        (0.1, 2.7, "last 2.7 s never came: this node's thread was held up meanwhile, so the oldest were"),
        (2.7, 3.0, "last 3.0 s never came: this node is busy 90% of the time, so the oldest are dropped"),
    ],
)
def test_losses_are_told_once_with_their_cause(clock, busy, passed, told):
    tally = Tally()
    for number in (1, 2, 6):
        tally.arrived(number)
    tally.busy, clock.now = busy, clock.now + passed
    assert tally.new_losses().startswith(f"3 of 6 pictures of the {told}")
    clock.now += 1.0
    assert tally.new_losses() is None


def test_rate_and_times(clock):
    tally = Tally()
    for number in range(1, 12):
        tally.arrived(number)
        tally.done(latency=number / 1000, span=0.002)
        clock.now += 0.05
    numbers = tally.as_dict()
    assert numbers["rate"] == 20.0
    assert (numbers["latency_ms"], numbers["process_ms"]) == ([6.0, 10.9], [2.0, 2.0])
    assert in_words(numbers) == (
        "11 received, 11 processed, 0 failed, 0 unheard, 0 lost, 20.0 Hz, "
        "latency 6.0 ms (median), 10.9 ms (99 %)"
    )


def test_before_the_first_picture_there_is_no_rate_and_no_time():
    numbers = Tally().as_dict()
    assert (numbers["rate"], numbers["latency_ms"], numbers["process_ms"]) == (None, None, None)
    assert in_words(numbers) == "0 received, 0 processed, 0 failed, 0 unheard, 0 lost"


def test_a_stream_tells_each_change_once(clock):
    stream = Stream()
    stream.see(picture(10))
    assert list(stream.news()) == ["size and encoding: 64×48 rgb8"]
    stream.see(picture(11))
    assert list(stream.news()) == []
    stream.see(picture(12, 32, "mono8"))
    stream.see(picture(9, 32, "mono8"))
    assert list(stream.news()) == [
        "size and encoding: 32×48 mono8 (were 64×48 rgb8)",
        "stamps went back by 3.000 s: the camera was restarted, its recording began anew, or its clock was "
        "set; going on",
    ]
    assert list(stream.news()) == []


def test_silence_is_told_once_and_its_end_too(clock):
    stream = Stream()
    stream.see(picture(1))
    list(stream.news())
    clock.now += 2.9
    assert not stream.has_fallen_silent()
    clock.now += 0.1
    assert stream.has_fallen_silent()
    assert not stream.has_fallen_silent()
    clock.now += 4.0
    stream.see(picture(2))
    assert list(stream.news()) == ["pictures come, after 7.0 s without"]
    assert not stream.has_fallen_silent()
