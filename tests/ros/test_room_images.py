"""The room in real time: its steps, commands and images, with a clock that the test moves."""

import threading
import types

import numpy as np
import pytest

pytestmark = pytest.mark.ros


class Clock:
    """A monotonic clock that goes on only when something sleeps, or takes time."""

    def __init__(self):
        self.now = 100.0

    def monotonic(self):
        return self.now

    def time_ns(self):
        return round(self.now * 1e9)

    def sleep(self, seconds):
        self.now += seconds


class FakeSimulation:
    """Records its steps; an image takes `drawing` seconds."""

    drawing = 0.0
    clock = None
    place = (1.0, 2.0, 1.287)

    def __init__(self, *, time=0.0, **options):
        if options.get("seed") == 13:
            raise ValueError("an unlucky seed")
        self.options, self.time, self.steps, self.depths = options, time, [], []
        self.bumped, self.closed = False, False

    def step(self, linear, angular, dt):
        self.steps.append((linear, angular, dt))
        self.time += dt

    def frame(self):
        self.clock.now += self.drawing

    def depth(self, camera="front"):
        self.depths.append((camera, threading.current_thread() is not threading.main_thread()))
        return np.full((2, 3), len(self.steps), np.uint16)

    def close(self):
        self.closed = True


@pytest.fixture
def room(monkeypatch):
    """room(rate) -> (RoomImages of a FakeSimulation, its clock)."""
    from imgproc_course.ros import room_images as module

    clock = Clock()
    monkeypatch.setattr(
        module,
        "time",
        types.SimpleNamespace(monotonic=clock.monotonic, time_ns=clock.time_ns, sleep=clock.sleep),
    )
    monkeypatch.setattr(module, "Simulation", FakeSimulation)
    monkeypatch.setattr(FakeSimulation, "clock", clock)
    return lambda rate=30.0: (module.RoomImages(rate, seed=0), clock)


def test_simulated_time_is_real_time_and_a_slow_camera_still_moves_at_30_hz(room):
    for rate, steps in ((30.0, 1), (10.0, 3), (7.0, 5), (60.0, 1)):
        images, clock = room(rate)
        start, iterator = clock.now, iter(images)
        for k in range(20):
            _, image = next(iterator)
            assert clock.now - start == pytest.approx(k / rate, abs=1e-6)
            assert image.stamp == clock.time_ns()
        assert len(images.simulation.steps) == 19 * steps + 1
        assert images.simulation.time == pytest.approx(19 / rate + 1 / rate / steps)


def test_a_command_moves_the_robot_until_half_a_second_later(room):
    images, _ = room()
    iterator = iter(images)
    next(iterator)
    images.command(0.2, -0.4)
    for _ in range(30):
        next(iterator)
    commands = [step[:2] for step in images.simulation.steps]
    assert commands == [(0.0, 0.0)] + 15 * [(0.2, -0.4)] + 15 * [(0.0, 0.0)]


def test_where_drawing_takes_too_long_images_are_left_out_and_the_motion_is_not(room):
    images, clock = room()
    start, iterator = clock.now, iter(images)
    for _ in range(40):
        next(iterator)
        clock.now += 0.07  # more than two periods
    elapsed = clock.now - start
    assert images.simulation.time == pytest.approx(elapsed, abs=0.11)
    assert len(images.simulation.steps) == pytest.approx(elapsed * 30, abs=4)


def test_a_room_that_is_too_slow_says_it_once(room, caplog):
    images, clock = room()
    iterator = iter(images)
    for _ in range(400):
        next(iterator)
        clock.now += 0.05
    (record,) = caplog.records
    # Two of three images are in time.
    assert record.message.startswith(
        "the room reaches 20.0 of 30 images per second on this machine; ask for "
    )
    assert 'open_camera("room", rate=20, switch=True)' in record.message


def test_a_room_in_time_says_nothing(room, caplog):
    images, clock = room()
    iterator = iter(images)
    for _ in range(400):
        next(iterator)
        clock.now += 0.02
    assert not caplog.records


def test_after_the_machine_slept_the_robot_goes_on_from_there(room):
    images, clock = room()
    iterator = iter(images)
    next(iterator)
    clock.now += 3600
    for _ in range(10):
        next(iterator)
    assert len(images.simulation.steps) == 11


def test_a_restart_begins_with_the_next_step_and_the_time_goes_on_or_begins(room, monkeypatch):
    from imgproc_course.simulation import furnished, recorded_room

    images, _ = room()
    monkeypatch.setattr("imgproc_course.ros.room_images.RESTART_TIMEOUT", 0.0)
    iterator, old = iter(images), images.simulation
    for _ in range(30):
        next(iterator)
    images.command(0.3, 0.0)
    images.restart(lighting="evening")
    next(iterator)
    new = images.simulation
    assert (old.closed, len(old.steps), new.steps) == (True, 30, [(0.0, 0.0, pytest.approx(1 / 30))])
    start = new.options["start"]
    assert new.options == {"seed": 0, "lighting": "evening", "start": start, "room": recorded_room()}
    assert start == old.place  # where the robot stood
    assert new.time - 1 / 30 == pytest.approx(old.time)
    with pytest.raises(ValueError, match="unlucky"):
        images.restart(seed=13)
    next(iterator)
    assert images.simulation is new and images.options["seed"] == 0
    images.restart(seed=2, start=(0.0, 0.0, 0.0))
    next(iterator)
    given = {"seed": 2, "lighting": "evening", "start": (0.0, 0.0, 0.0)}
    assert images.simulation.options == given | {"room": recorded_room()}
    assert images.simulation.time == pytest.approx(1 / 30)  # as a new Simulation
    images.restart(room=17)
    next(iterator)
    assert images.simulation.options == given | {"room": furnished(17), "start": furnished(17).start}
    assert images.simulation.time == pytest.approx(1 / 30)
    images.restart(room=None)
    next(iterator)
    assert images.simulation.options["start"] == recorded_room().start
    images.close()
    assert images.simulation.closed


def test_depth_is_computed_by_a_second_thread_if_the_image_before_was_asked_for_it(room):
    from std_msgs.msg import Header

    images, _ = room()
    iterator, depths = iter(images), images.simulation.depths
    threads = []
    for asks in (False, True, True, True, False, False, True):
        _, image = next(iterator)
        if asks:
            msg = image.depth(Header(frame_id="camera"))
            value = len(images.simulation.steps)
            assert (msg.header.frame_id, msg.encoding, msg.width, msg.height) == ("camera", "16UC1", 3, 2)
            assert bytes(msg.data) == 6 * value.to_bytes(2, "little")
        image.end_depth()
        threads.append([other for _, other in depths])
        depths.clear()
    # The fifth image is drawn in vain: nobody asks any more. The last one was not expected.
    assert threads == [[], [False], [True], [True], [True], [], [False]]
    images.close()


def test_the_other_depth_camera_waits_and_a_room_is_closed_after_its_depth(room, monkeypatch):
    from std_msgs.msg import Header

    images, _ = room()
    iterator, events, may_end = iter(images), [], threading.Event()

    def slow_depth(self, camera="front"):
        if threading.current_thread() is not threading.main_thread():
            may_end.wait(60)
        events.append(camera)
        return np.zeros((2, 3), np.uint16)

    next(iterator)[1].depth(Header())
    monkeypatch.setattr(FakeSimulation, "depth", slow_depth)
    monkeypatch.setattr(FakeSimulation, "close", lambda self: events.append("closed"))
    _, image = next(iterator)
    threading.Timer(0.2, may_end.set).start()
    image.depth(Header(), "tof")
    assert events == ["front", "tof"]
    image.depth(Header())
    may_end.clear()
    next(iterator)
    threading.Timer(0.2, may_end.set).start()
    images.close()
    assert events == ["front", "tof", "front", "closed"]
