"""Sliders beside an image: what is computed, with which values, and what is stored."""

import base64
import re
import threading

import cv2
import numpy as np
import pytest

from imgproc_course.display import tune, tuners

GRAY = cv2.GaussianBlur(np.random.default_rng(3).integers(0, 256, (90, 160), np.uint8), (0, 0), 2)


def canny(gray, low, high, *, sigma=0.0):
    return cv2.Canny(cv2.GaussianBlur(gray, (0, 0), sigma) if sigma else gray, low, high)


@pytest.fixture(autouse=True)
def stored(monkeypatch):
    outputs = []
    monkeypatch.setattr(tuners, "display", lambda output: outputs.append(output._repr_mimebundle_()))
    return outputs


def test_value_follows_the_sliders():
    tuner = tune(canny, GRAY, thresholds=(0, 1020), sigma=(0, 5.0))
    assert (tuner.value == cv2.Canny(GRAY, 100, 200)).all()
    tuner["thresholds"].value = (10, 20)
    assert (tuner.value == cv2.Canny(GRAY, 10, 20)).all()
    tuner["sigma"].value = 1.5
    assert (tuner.value == canny(GRAY, 10, 20, sigma=1.5)).all()
    assert tuner.parameters == {"low": 10, "high": 20, "sigma": 1.5}
    assert tuner.call == "canny(gray, low=10, high=20, sigma=1.5)"
    tuner.reset()
    assert (tuner.value == cv2.Canny(GRAY, 100, 200)).all()


def test_the_image_on_the_screen_is_the_value():
    tuner = tune(canny, GRAY, thresholds=(0, 1020))
    tuner["thresholds"].value = (10, 20)
    assert tuner.value.any()
    shown = cv2.imdecode(np.frombuffer(tuner._screen.image.value, np.uint8), cv2.IMREAD_GRAYSCALE)
    expected = cv2.resize(tuner.value, (640, 360), interpolation=cv2.INTER_NEAREST)
    assert np.abs(shown.astype(int) - expected).mean() < 3


def test_while_the_function_runs_only_the_newest_values_wait():
    calls, may_return, is_busy = [], threading.Event(), threading.Event()

    def slow(frame, level):
        calls.append(level)
        if len(calls) == 2:
            is_busy.set()
            assert may_return.wait(60)
        return np.full((4, 4), level, np.uint8)

    tuner = tune(slow, GRAY, level=(0, 255))
    for level in range(1, 100):
        tuner["level"].value = level
        if level == 1:
            assert is_busy.wait(60)
    may_return.set()
    assert (tuner.value == 99).all()
    assert calls[1:] == [1, 99]


def test_an_exception_is_shown_and_the_next_value_is_tried():
    def root(frame, level):
        if level < 100:
            raise ValueError(f"level {level} is too dark")
        return np.full((4, 4), level, np.uint8)

    tuner = tune(root, GRAY, level=(0, 200))
    assert tuner.error is None
    tuner["level"].value = 50
    assert tuner.value is None
    assert isinstance(tuner.error, ValueError)
    message = tuner._screen._message
    assert "in root, line" in message.value and message.value.count("ValueError: level 50 is too dark") == 1
    tuner["level"].value = 150
    assert (tuner.value == 150).all()
    assert tuner.error is None
    assert "ValueError" not in message.value


def test_a_function_that_fails_from_the_start_is_shown_too(stored):
    tuner = tune(lambda frame, level: None, GRAY, level=(0, 10))
    assert "returned None" in tuner._screen._message.value
    assert "<img" not in stored[0]["text/html"]


def test_a_function_that_does_not_return_is_reported(monkeypatch):
    monkeypatch.setattr(tuners, "PATIENCE", 0.1)
    released, calls = threading.Event(), []

    def endless(frame, level):
        calls.append(level)
        if len(calls) > 1:
            released.wait(60)
        return frame

    tuner = tune(endless, GRAY, level=(0, 10))
    tuner["level"].value = 1
    with pytest.raises(TimeoutError, match=r"endless\(frame, level=1\) has not returned"):
        _ = tuner.value
    released.set()


def test_the_stored_output_is_the_image_and_its_call_and_the_same_in_every_run(stored):
    for _ in range(2):
        tune(canny, GRAY, thresholds=(0, 1020))
    for bundle in stored:
        assert bundle.pop("application/vnd.jupyter.widget-view+json")
    assert stored[0] == stored[1]
    assert stored[0]["text/plain"] == "Sliders for canny: canny(gray, low=100, high=200)"
    html = stored[0]["text/html"]
    assert 'alt="Result of canny on the frame"' in html
    assert "<code>canny(gray, low=100, high=200)</code>" in html
    jpeg = base64.b64decode(re.search(r'base64,([^"]+)"', html)[1])
    assert cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE).shape == (360, 640)


@pytest.mark.parametrize(
    ("arguments", "sliders", "error"),
    [
        ((canny, GRAY), {}, r"nothing to tune: .*sigma=\(0, 5\.0\)"),
        ((GRAY, canny), {"sigma": (0, 5.0)}, "ndarray is not a function"),
        (
            (canny, [1, 2]),
            {"sigma": (0, 5.0)},
            "frame is list; expected an array; .* call live_view",
        ),
        ((canny, GRAY), {"aperture": [3, 5]}, "canny has no parameter 'aperture'"),
    ],
)
def test_what_cannot_be_tuned_is_an_error(arguments, sliders, error):
    with pytest.raises(ValueError, match=error):
        tune(*arguments, **sliders)
