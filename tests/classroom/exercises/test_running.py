"""Calls of learners' functions: stopped at the time limit, every exception caught, arguments protected."""

import contextlib
import re
import threading
import time
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.running import bytes_allowed, call, overwrite_freed_memory


def run(function, *arguments, seconds=0.3):
    names = [f"a{k}" for k in range(len(arguments))]
    return call(function, arguments, names, seconds)


def endless(_):
    while True:
        pass


def endless_and_catching(_):
    while True:
        with contextlib.suppress(Exception):
            len("")


def test_the_returned_value_is_stored_as_a_form():
    assert run(lambda a: a + 1, 2).value == {"type": "int", "value": 3}


@pytest.mark.parametrize("function", [endless, endless_and_catching])
def test_an_endless_loop_is_stopped(function):
    result = run(function, 1)
    assert result.timed_out and not result.stuck and not result.finished


def test_a_function_that_waits_for_the_processor_is_not_stopped():
    assert run(lambda seconds: time.sleep(seconds) or "done", 0.3, seconds=0.2).value["value"] == "done"


def test_a_function_that_waits_for_ever_is_stopped():
    assert run(time.sleep, 600, seconds=0.1).timed_out


def test_the_alarm_may_ring_in_a_finalizer():
    class Slow:
        def __del__(self):
            while True:
                pass

    def function():
        Slow()  # here the first TimeUp is dropped, in silence
        while True:
            pass

    assert call(function, (), (), 0.1).timed_out


@pytest.mark.parametrize("function", [endless, endless_and_catching])
def test_an_endless_loop_is_stopped_outside_the_main_thread(function):
    results = []
    thread = threading.Thread(target=lambda: results.append(run(function, 1)))
    thread.start()
    thread.join(60)
    assert results[0].timed_out and not results[0].stuck


def test_another_user_of_the_alarm_gets_it_back():
    import signal

    alarms = []
    handler = signal.signal(signal.SIGALRM, lambda *_: alarms.append(True))
    before = signal.setitimer(signal.ITIMER_REAL, 60)
    try:
        run(lambda a: a, 1)
        seconds_left, _ = signal.getitimer(signal.ITIMER_REAL)
        assert 50 < seconds_left <= 60
        signal.raise_signal(signal.SIGALRM)
        assert alarms == [True]
    finally:
        signal.setitimer(signal.ITIMER_REAL, *before)
        signal.signal(signal.SIGALRM, handler)


def test_the_arguments_are_copies_and_a_change_is_reported():
    frame = np.zeros(3, np.uint8)

    def change(a, b):
        b += 1
        return b

    result = run(change, np.ones(3), frame)
    assert result.changed == ("a1",)
    assert not frame.any()


def test_an_error_is_reported_with_the_learners_own_line():
    result = run(lambda a: np.zeros(2)[a], 5)
    assert result.error == "IndexError"
    assert "result = run(lambda a: np.zeros(2)[a], 5)" in result.line
    result = run(lambda a: np.stack(a), [])  # raised inside NumPy: the line is still the learner's
    assert "np.stack(a)" in result.line


@pytest.mark.parametrize("error", [SystemExit, RecursionError, MemoryError])
def test_every_exception_is_caught(error):
    def fail(_):
        raise error("no")

    assert run(fail, 1).error == error.__name__


def test_the_stop_button_still_works():
    def stop(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(stop, 1)


def test_an_address_in_a_message_does_not_vary():
    def fail(_):
        raise ValueError(f"bad {object()}")

    assert run(fail, 1).message == "bad <object object at 0x…>"


def test_only_the_first_part_of_the_output_is_stored(capsys):
    result = run(lambda a: [print("row", k) for k in range(10_000)] and None, 1, seconds=5)
    assert result.printed.startswith("row 0\nrow 1\n")
    assert len(result.printed) == 2_000
    assert capsys.readouterr().out == ""


def test_a_warning_is_kept():
    def warn(_):
        warnings.warn("overflow", stacklevel=1)

    assert run(warn, 1).warning == "overflow"


class Bell:
    def __init__(self, tone):
        self.sound = "ding"

    def tune(self):
        return tone  # noqa: F821

    def ring(self):
        return sound  # noqa: F821


@pytest.mark.parametrize(
    ("function", "closest"),
    [
        (lambda image: image.astyp(float), "astype"),
        (lambda image: np.zero_like(image), "np.zeros_like"),
        (lambda image: re.Compile(image), "re.compile"),
        (lambda image: imge + 1, "image"),  # noqa: F821
        (lambda image: SimpleNamespace(height=image).heigth, "height"),
        (lambda image: Bell(image).ring(), "self.sound"),
        (lambda image: Bell(image).tune(), "self.tone"),
        (lambda image: image.crop(), ""),  # no copy
        (lambda image: image.nothing_like_this, ""),
        (lambda image: unknown, ""),  # noqa: F821
        (lambda image: image / 0 + {}[3], ""),
    ],
)
def test_the_closest_name_to_one_that_is_not_there(function, closest):
    with np.errstate(all="ignore"):
        assert run(function, np.ones(3)).closest == closest


@pytest.mark.parametrize("shape", [(5, 6), (40, 40), (300, 400)])
def test_freed_memory_no_longer_holds_the_expected_values(shape):
    expected = np.arange(np.prod(shape), dtype=np.int32).reshape(shape)
    form = canonical((expected, {"more": expected}))
    copies = [expected.copy() for _ in range(12)]
    del copies
    overwrite_freed_memory(form)
    found = [np.empty_like(expected) for _ in range(4)]
    assert not any((array == expected).mean() > 0.5 for array in found)


def test_an_overflow_is_the_warning_that_is_told():
    def warns(_):
        np.zeros(0).mean()
        return np.uint8(255) + np.uint8(1)

    assert "overflow" in run(warns, 0).warning


def test_two_errors_are_the_same_only_with_the_same_message():
    first, second = run(lambda a: a[3], (0,)), run(lambda a: [0][3], (0,))
    assert first.error == second.error == "IndexError" and not first.matches(second, 0.0)
    assert first.matches(run(lambda a: a[4], (0,)), 0.0)


@pytest.mark.parametrize(
    "value",
    [
        {f"key number {number}": number for number in range(19_000)},
        ["é" * 9_000] * 100,
        b"x" * 3_000_000,
        {"a": np.ones((300, 400)), "b": (np.zeros(5), b"abc")},
        [np.ones(100, np.uint8)] * 5_000,
        None,
    ],
)
def test_a_value_equal_to_the_expected_one_is_written_whole(value):
    form = canonical(value)
    assert canonical(value, most=bytes_allowed(form)) == form
    assert canonical([value, np.ones((99, 999, 9))], most=bytes_allowed(form))["items"] == [
        form,
        {"type": "ndarray", "dtype": "float64", "shape": [99, 999, 9]},
    ]
