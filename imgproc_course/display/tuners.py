"""Sliders beside an image: move one, and see what the parameter does."""

import base64
import html
import threading
import time
from collections.abc import Callable
from typing import Any

import ipywidgets as widgets
import numpy as np
from IPython.display import display

from imgproc_course.display.controls import Controls, in_a_row
from imgproc_course.display.figures import Output, split_text
from imgproc_course.display.printing import captured_prints, last_lines
from imgproc_course.display.screen import Screen, Style, View
from imgproc_course.learner_errors import describe

PATIENCE = 10  # seconds that `.value` waits for a computation
QUICK = 0.05  # seconds that the kernel waits for a computation before it reads its next message


def tune(
    function: Callable[..., Any],
    frame: Any,
    *,
    encoding: str = "bgr8",
    limits: tuple[float, float] | None = None,
    text: str | None = None,
    **sliders: Any,
) -> "Tuner":
    """Shows the result of `function` on a frame, with a slider for each of its parameters.

    tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0)) calls canny(gray, low=..., high=..., sigma=...)
    whenever a slider moves. Below the sliders are a reset button and the current call as code to copy.

    Parameters
    ----------
    function : function (frame, **parameters) -> array, or a list or dict (title -> array) of arrays
    frame : array; for a live source, live_view(source, function, **sliders)
    encoding, limits, text : as in `live_view`
    **sliders
        name=(low, high) or (low, high, step): a slider, of integers if all are integers. It starts at the
        parameter's own default if this is in the range, else in the middle.
        name=True or False: a check box. name=[...]: a choice. name=an ipywidgets widget: this widget.
        A name that is not a parameter of the function makes one range slider for two parameters that must not
        cross: low and high, or lower and upper, min and max, minimum and maximum, threshold1 and threshold2.

    Returns
    -------
    Tuner : .parameters, .value, .call, .error, .reset()

    Raises
    ------
    ValueError : nothing to tune, an invalid range, a name that the function does not know
    """
    if not callable(function):
        raise ValueError(
            f"{type(function).__name__} is not a function; call tune(function, frame, name=(low, high))"
        )
    if not sliders:
        raise ValueError("nothing to tune: give a parameter and its range, such as sigma=(0, 5.0)")
    if not isinstance(frame, np.ndarray):
        raise ValueError(
            f"frame is {type(frame).__name__}; expected an array; for a live source call "
            "live_view(source, function, name=(low, high))"
        )
    style = Style(encoding, None, limits, *split_text(text))
    tuner = Tuner(function, frame, style, sliders)
    tuner.publish()
    return tuner


class Tuner(View):
    """A function, a frame, and sliders; `tune` makes one and shows it.

    The function runs on a thread, so that a slow one does not block the sliders. While it runs, only the
    newest values wait.

    Attributes
    ----------
    error : the exception of the last call, None if there was none
    """

    _controls: Controls

    def __init__(self, function: Callable[..., Any], frame: Any, style: Style, ranges: dict[str, Any]):
        self._function, self._frame = function, frame
        self._name = getattr(function, "__name__", "function")
        self._controls = Controls(function, ranges, self._request)
        self._screen = Screen(style, f"Result of {self._name} on the frame")
        self._lock = threading.Lock()
        self._requests = 0
        self._idle = threading.Event()  # not set while a thread computes
        self.error: BaseException | None = None
        self._value = None
        self._jpeg = b""
        self._box = in_a_row(self._screen.box, self._controls.box)
        self._compute()
        self._idle.set()

    @property
    def value(self) -> Any:
        """What the function returned for the current parameters; None if it raised.

        Raises
        ------
        TimeoutError : the function has been running for more than 10 seconds
        """
        if not self._idle.wait(PATIENCE):
            raise TimeoutError(f"{self.call} has not returned within {PATIENCE} s; does its loop end?")
        return self._value

    def __getitem__(self, keyword: str) -> widgets.Widget:
        """The widget of a keyword: tuner["sigma"].value = 2.0 moves its slider."""
        return self._controls[keyword]

    def publish(self) -> None:
        """Shows the sliders in the cell that runs now."""
        code = html.escape(self.call)
        img_tag = ""
        if self._jpeg:
            data = base64.b64encode(self._jpeg).decode()
            alt = html.escape(self._screen.image.tooltip)
            img_tag = f'<img alt="{alt}" style="max-width: 100%" src="data:image/jpeg;base64,{data}">'
        still = f'<figure style="margin: 0">{img_tag}<figcaption><code>{code}</code></figcaption></figure>'
        display(Output(repr(self), still, self._box))

    def _ipython_display_(self):
        """Shows nothing: as the last value of its own cell, it is already on the page."""

    def __repr__(self):
        return f"Sliders for {self._name}: {self.call}"

    def _request(self):
        with self._lock:
            self._requests += 1
            if not self._idle.is_set():
                return
            self._idle.clear()
        threading.Thread(target=self._work, name=f"tune: {self._name}", daemon=True).start()
        # Threads take turns in the interpreter, 5 ms each. A quick computation ends sooner if this one waits.
        self._idle.wait(QUICK)

    def _work(self):
        while True:
            requests = self._requests
            with captured_prints() as printed:
                self._compute()
            if printed and self.error is None:
                self._screen.say(last_lines(printed))
            with self._lock:
                if requests == self._requests:
                    self._idle.set()
                    return

    def _compute(self):
        parameters = self.parameters
        started = time.monotonic()
        try:
            self._value = self._function(self._frame, **parameters)
            self._jpeg = self._screen.show(self._value)
        except (Exception, SystemExit) as error:  # noqa: BLE001  the learner's function may raise anything
            self.error, self._value = error, None
            self._screen.say(describe(error) or f"{type(error).__name__}: {error}", is_error=True)
            return
        if self.error is not None:
            self._screen.say()
            self.error = None
        self._controls.note(f"computed in {(time.monotonic() - started) * 1000:.0f} ms")
