"""Functions of learners: stopped, caught, kept harmless."""

import contextlib
import threading
import warnings

import numpy as np
import pytest

from imgproc_course.exercises.running import call


def run(function, *arguments, seconds=0.3):
    names = [f"a{k}" for k in range(len(arguments))]
    return call(function, arguments, names, seconds)


def endless(_):
    while True:
        pass


def endless_and_deaf(_):
    while True:
        with contextlib.suppress(Exception):
            len("")


def test_what_comes_back_is_kept_by_value():
    assert run(lambda a: a + 1, 2).value == {"type": "int", "value": 3}


@pytest.mark.parametrize("function", [endless, endless_and_deaf])
def test_an_endless_loop_is_stopped(function):
    outcome = run(function, 1)
    assert outcome.timed_out and not outcome.stuck and not outcome.finished


@pytest.mark.parametrize("function", [endless, endless_and_deaf])
def test_an_endless_loop_is_stopped_outside_the_main_thread(function):
    outcomes = []
    thread = threading.Thread(target=lambda: outcomes.append(run(function, 1)))
    thread.start()
    thread.join(30)
    assert outcomes[0].timed_out and not outcomes[0].stuck


def test_another_user_of_the_alarm_gets_it_back():
    import signal

    rang = []
    handler = signal.signal(signal.SIGALRM, lambda *_: rang.append(True))
    before = signal.setitimer(signal.ITIMER_REAL, 60)
    try:
        run(lambda a: a, 1)
        left, _ = signal.getitimer(signal.ITIMER_REAL)
        assert 50 < left <= 60
        signal.raise_signal(signal.SIGALRM)
        assert rang == [True]
    finally:
        signal.setitimer(signal.ITIMER_REAL, *before)
        signal.signal(signal.SIGALRM, handler)


def test_the_arguments_are_copies_and_a_change_is_told():
    frame = np.zeros(3, np.uint8)

    def change(a, b):
        b += 1
        return b

    outcome = run(change, np.ones(3), frame)
    assert outcome.changed == ("a1",)
    assert not frame.any()


def test_an_error_is_told_with_the_learners_own_line():
    outcome = run(lambda a: np.zeros(2)[a], 5)
    assert outcome.error == "IndexError"
    assert "outcome = run(lambda a: np.zeros(2)[a], 5)" in outcome.line
    outcome = run(lambda a: np.stack(a), [])  # raised inside NumPy: the line is still the learner's
    assert "np.stack(a)" in outcome.line


@pytest.mark.parametrize("error", [SystemExit, RecursionError, MemoryError])
def test_whatever_is_raised_is_caught(error):
    def fail(_):
        raise error("no")

    assert run(fail, 1).error == error.__name__


def test_the_stop_button_stays_the_learners():
    def stop(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(stop, 1)


def test_an_address_in_a_message_does_not_vary():
    def fail(_):
        raise ValueError(f"bad {object()}")

    assert run(fail, 1).message == "bad <object object at 0x…>"


def test_what_is_printed_is_kept_and_cut(capsys):
    outcome = run(lambda a: [print("row", k) for k in range(10_000)] and None, 1, seconds=5)
    assert outcome.printed.startswith("row 0\nrow 1\n")
    assert len(outcome.printed) == 2_000
    assert capsys.readouterr().out == ""


def test_a_warning_is_kept():
    def warn(_):
        warnings.warn("overflow", stacklevel=1)

    assert run(warn, 1).warned == "overflow"
