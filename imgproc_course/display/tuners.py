"""Sliders beside a picture: what a parameter does, seen while it moves."""

import base64
import html
import threading
import time

import ipywidgets as widgets
import numpy as np

from imgproc_course.display.controls import Controls
from imgproc_course.display.live_view import is_live, live_view, publish
from imgproc_course.display.printing import last_lines, prints_kept
from imgproc_course.display.screen import Screen, describe_error

PATIENCE = 10  # seconds that `.value` waits for a computation
QUICK = 0.05  # seconds that the kernel leaves a computation undisturbed before it takes its next message


def tune(function, frame, *, encoding="bgr8", width=None, limits=None, caption=None, alt=None, **sliders):
    """Shows what `function` makes of a frame, with a slider for each of its parameters.

    tune(canny, gray, thresholds=(0, 1020), sigma=(0, 5.0)) calls canny(gray, low=..., high=..., sigma=...)
    whenever a slider moves. Below the sliders are a reset button and the present call as code to copy.

    Parameters
    ----------
    function : function (frame, **parameters) -> array, or a list or dict (title -> array) of arrays
    frame : array, or anything that `live_view` shows: a Camera, ImageSubscriber, topic name or Recording
    encoding, width, limits, caption, alt : as in `live_view`
    **sliders
        name=(low, high) or (low, high, step): a slider, of integers if all are integers. It starts at the
        parameter's own default where it has one within reach, else in the middle.
        name=True or False: a box to tick. name=[...]: a choice. name=an ipywidgets widget: that one.
        A name that the function does not have is one range slider for the two of its parameters that must not
        cross, called low and high (or lower and upper, min and max, minimum and maximum, threshold1 and
        threshold2).

    Returns
    -------
    Tuner, or LiveView of a live source : .parameters, .value, .call, .error, .reset()

    Raises
    ------
    ValueError : nothing to tune, a range that is none, a name that the function does not know
    """
    if not callable(function):
        raise ValueError(f"{type(function).__name__} is no function; tune(function, frame, name=(low, high))")
    if not sliders:
        raise ValueError("nothing to tune: name a parameter and its range, such as sigma=(0, 5.0)")
    common = {"encoding": encoding, "width": width, "limits": limits, "caption": caption, "alt": alt}
    if is_live(frame) and not isinstance(frame, np.ndarray):
        return live_view(frame, function, **common, **sliders)
    if not isinstance(frame, np.ndarray):
        raise ValueError(
            f"frame is {type(frame).__name__}; expected an array, or a source as live_view takes it"
        )
    tuner = Tuner(function, frame, **common, ranges=sliders)
    tuner.publish()
    return tuner


class Tuner:
    """A function, a frame, and sliders; `tune` makes one and shows it.

    The function runs on a thread, so that a slow one never holds the sliders up: while it runs, only the
    newest values wait for it.

    Attributes
    ----------
    error : the exception of the last call, None if there was none
    """

    def __init__(self, function, frame, *, encoding, width, limits, caption, alt, ranges):
        self._function, self._frame = function, frame
        self._name = getattr(function, "__name__", "function")
        self._controls = Controls(function, ranges, self._ask)
        self._alt = alt or caption or f"What {self._name} makes of the frame"
        self._screen = Screen(encoding, width, limits, self._alt, caption)
        self._lock = threading.Lock()
        self._asked, self._working = 0, False
        self._idle = threading.Event()
        self.error = self._value = None
        self._jpeg = b""
        layout = widgets.Layout(flex_flow="row wrap")
        self._box = widgets.HBox([self._screen.box, self._controls.box], layout=layout)
        self._compute()
        self._idle.set()

    @property
    def parameters(self):
        """Dict of parameter -> value, as the function is called."""
        return self._controls.values

    @property
    def call(self):
        """The present call as code."""
        return self._controls.call

    @property
    def value(self):
        """What the function returned for the present parameters; None where it raised.

        Raises
        ------
        TimeoutError : it has been running for more than 10 seconds
        """
        if not self._idle.wait(PATIENCE):
            raise TimeoutError(f"{self.call} has not returned within {PATIENCE} s; does it end?")
        return self._value

    def reset(self):
        """Puts every slider back to where it began."""
        self._controls.reset()

    def __getitem__(self, keyword):
        """The widget of a keyword: tuner["sigma"].value = 2.0 moves its slider."""
        return self._controls[keyword]

    def publish(self):
        """Shows it in the cell that runs now."""
        code = html.escape(self.call)
        picture = ""
        if self._jpeg:
            data = base64.b64encode(self._jpeg).decode()
            alt = html.escape(self._alt)
            picture = f'<img alt="{alt}" style="max-width: 100%" src="data:image/jpeg;base64,{data}">'
        still = f'<figure style="margin: 0">{picture}<figcaption><code>{code}</code></figcaption></figure>'
        publish(self._box, f"Sliders for {self._name}: {self.call}", still)

    def _ipython_display_(self):
        """As the last word of its own cell it is there already."""

    def __repr__(self):
        return f"Sliders for {self._name}: {self.call}"

    def _ask(self):
        with self._lock:
            self._asked += 1
            self._idle.clear()
            if self._working:
                return
            self._working = True
        threading.Thread(target=self._work, name=f"tune: {self._name}", daemon=True).start()
        # Two threads would take turns at the interpreter, 5 ms each: a quick picture comes sooner alone.
        self._idle.wait(QUICK)

    def _work(self):
        while True:
            asked = self._asked
            with prints_kept() as printed:
                self._compute()
            if printed and self.error is None:
                self._screen.say(last_lines(printed))
            with self._lock:
                if asked == self._asked:
                    self._working = False
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
            self._screen.say(describe_error(error, self._function), wrong=True)
            return
        if self.error is not None:
            self._screen.say()
            self.error = None
        self._controls.note(f"computed in {(time.monotonic() - started) * 1000:.0f} ms")
