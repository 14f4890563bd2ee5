"""The running camera in a notebook, and what a learner's function makes of each frame."""

import atexit
import html
import itertools
import threading
import time
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import ipywidgets as widgets
import numpy as np
from IPython import get_ipython
from IPython.display import display

from imgproc_course.display.controls import Controls
from imgproc_course.display.printing import last_lines, prints_kept
from imgproc_course.display.screen import Screen, describe_error

MAX_RATE = 30  # frames a second: a screen shows no more of a camera, and the browser must keep up
BEAT = 0.5  # seconds between two questions to the browser whether it keeps up
LATE = 0.3  # seconds after which its answer shows a queue on the way
GONE = 10  # seconds of silence after which nobody seems to look
WITHOUT_ANSWER, WITHOUT_BROWSER = 0.2, 1.0  # seconds between frames while nobody answers, and nobody looks


def live_view(
    source,
    process=None,
    *,
    encoding="bgr8",
    width=None,
    limits=None,
    rate=None,
    caption=None,
    alt=None,
    **ranges,
):
    """Shows a running camera in the notebook, each frame as the learner's function returns it.

    It runs on a thread: the cell ends at once, and sliders, other cells and other views stay alive. An
    exception in `process` is shown under the picture, as is what it prints, and the next frame is tried.
    Frames that come faster than they are processed, or than the browser takes them, are dropped. It rests
    while no page shows it, and stops when its cell is run again and when the kernel stops.

    Parameters
    ----------
    source : Camera, ImageSubscriber, topic name, or Recording (which needs no ROS, and is repeated)
    process : function (frame, **parameters) -> array, or a list or dict (title -> array) of arrays
        Arrays are shown side by side: uint8, bool, or colour in the order of `encoding`. Left out: the frame.
    encoding : str
        What the frames are converted to, and how colours are read.
    width : int
        CSS pixels; left out: 640 for one picture, 960 where there are several. Frames are sent at this width.
    limits : (low, high)
        The values shown black and white, for gray results that are neither uint8 nor bool.
    rate : float, Hz
        At which a Recording is played; left out: its own.
    caption : str, a sentence under the view
    alt : str, what is seen; left out: made of the function's name
    **ranges
        Parameters of `process` to be set while it runs: low=(0, 1020) is a slider, see `tune`.

    Returns
    -------
    LiveView : .stop(), .start(), .snapshot(), .snapshots, .parameters, .value, .error, .rate, .shown

    Raises
    ------
    ValueError : a source that is none of these, a range that is none
    RosMissingError : a topic where rclpy is not installed
    """
    view = LiveView(
        source,
        process,
        encoding=encoding,
        width=width,
        limits=limits,
        rate=rate,
        caption=caption,
        alt=alt,
        ranges=ranges,
    )
    view.start()
    view.publish()
    return view


class Snapshot(NamedTuple):
    """What was on the screen: the frame as it came, what `process` made of it, and the file that keeps it."""

    frame: np.ndarray
    result: Any
    path: Path | None


class LiveView:
    """A live view, running or stopped; `live_view` makes one and starts it.

    Attributes
    ----------
    shown : frames sent to the browser since it was made
    rate : frames sent in one second, lately
    value : what `process` returned last; None before the first frame
    error : the exception of the last frame, None if there was none
    snapshots : list of Snapshot
    """

    def __init__(self, source, process, *, encoding, width, limits, rate, caption, alt, ranges):
        if process is not None and not callable(process):
            raise ValueError(
                f"process is {type(process).__name__}; expected a function: live_view(camera, edges)"
            )
        if ranges and process is None:
            raise ValueError(f"{', '.join(ranges)}: sliders need a function whose parameters they set")
        self._process = process
        self._feed = _feed_from(source, encoding, rate)
        self._controls = Controls(process, ranges) if ranges else None
        self._name = caption or getattr(process, "__name__", "camera").replace("<lambda>", "camera")
        self._screen = Screen(encoding, width, limits, alt or caption or f"Live view: {self._name}", caption)
        self._beat = _Beat()
        self._thread = None
        self._stopping = threading.Event()
        self._frame = None
        self._cell = self._cell_run = None
        self._hidden = self._failing = False
        self.shown, self.rate, self.value, self.error, self.snapshots = 0, 0.0, None, None, []
        self._make_widgets()

    def _make_widgets(self):
        button = widgets.Layout(width="110px")
        self._start = widgets.Button(description="Start", icon="play", layout=button)
        self._stop = widgets.Button(description="Stop", icon="stop", layout=button)
        self._shoot = widgets.Button(description="Snapshot", icon="camera", layout=button)
        self._start.on_click(lambda _: self.start())
        self._stop.on_click(lambda _: self.stop())
        self._shoot.on_click(lambda _: self.snapshot())
        self._figures = widgets.Label(value="waiting for the first frame")
        picture = self._screen.box
        if self._controls:
            picture = widgets.HBox([picture, self._controls.box], layout=widgets.Layout(flex_flow="row wrap"))
        bar = widgets.HBox([self._start, self._stop, self._shoot, self._figures])
        self._box = widgets.VBox([bar, picture])
        # The browser counts the views of a widget that asks for it: none left means its output was deleted.
        self._screen.image._view_count = 0
        self._screen.image.observe(self._count_views, "_view_count")

    # ------------------------------------------------------------ what a learner calls

    @property
    def running(self):
        return self._thread is not None and self._thread.is_alive()

    @property
    def parameters(self):
        """Dict of parameter -> value, as `process` is called."""
        return self._controls.values if self._controls else {}

    @property
    def call(self):
        """The call of `process` as code to copy."""
        return self._controls.call if self._controls else f"{self._name}(frame)"

    def reset(self):
        """Puts every slider back to where it began."""
        if self._controls:
            self._controls.reset()

    def start(self):
        """Starts, or starts again; nothing happens where it runs."""
        if self.running:
            return
        self._stopping.clear()
        self._feed.open()
        self._thread = threading.Thread(target=self._run, name=f"live view: {self._name}", daemon=True)
        self._thread.start()
        _running.add(self)
        self._start.disabled, self._stop.disabled = True, False

    def stop(self):
        """Stops the thread, and the view's own subscription; the last picture stays."""
        self._stopping.set()
        self._feed.close()  # which wakes the thread, if it waits for a frame
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout=3)
        _running.discard(self)
        self._start.disabled, self._stop.disabled = False, True
        self._figures.value = f"stopped after {self.shown} frame{'' if self.shown == 1 else 's'}"

    def snapshot(self):
        """Keeps frame and result in `.snapshots`, and the picture as a PNG file in the working folder."""
        if self._frame is None:
            self._screen.say("no frame has come yet, so there is nothing to keep", wrong=True)
            return None
        result = self._frame if self.value is None else self.value
        try:
            path, words = _save(self._screen.full_size(result)), ""
        except (OSError, ValueError) as error:
            path, words = None, f"; no file was written: {error}"
        kept = Snapshot(np.array(self._frame), result, path)
        self.snapshots.append(kept)
        self._screen.say(
            f"kept as .snapshots[{len(self.snapshots) - 1}]" + (f" and {path}" if path else words)
        )
        return kept

    def publish(self):
        """Shows the view in the cell that runs now; an earlier run's view of the same cell is stopped."""
        cell, run = _where()
        for view in list(_running):
            if cell is not None and view._cell == cell and view._cell_run != run:
                view.stop()
        self._cell, self._cell_run = cell, run
        name = html.escape(self._name.rstrip("."))
        still = f"<p>Live view: {name}. It moves when this cell is run.</p>"
        publish(self._box, f"Live view: {self._name}", still)

    def _ipython_display_(self):
        if (self._cell, self._cell_run) != _where():  # as the last word of its own cell it is there already
            self.publish()

    def __repr__(self):
        return f"Live view: {self._name}"

    # ------------------------------------------------------------ the thread

    def _run(self):
        recent = [0.0]  # when the frames of the last two seconds were begun
        with prints_kept() as printed:
            while not self._stopping.is_set():
                if not self._wait_for_turn(recent[-1]):
                    continue
                frame = self._next_frame()
                if frame is None:
                    continue
                started = time.monotonic()
                self._show(frame)
                recent = [then for then in recent if started - then < 2] + [started]
                self._report(recent, time.monotonic() - started, printed)

    def _wait_for_turn(self, last):
        """Sleeps until the browser may be sent a frame; False if there is another reason to look up."""
        if self._hidden:
            self._stopping.wait(0.2)
            return False
        left = last + self._beat.interval() - time.monotonic()
        if left > 0:
            self._stopping.wait(min(left, 0.02))
            return left <= 0.02
        return True

    def _next_frame(self):
        try:
            return self._feed.next(timeout=1.0)
        except TimeoutError as error:
            self._say_wrong(str(error))
        except Exception as error:  # noqa: BLE001  a source may be anybody's; its error belongs on the screen
            if self._stopping.is_set():
                return None
            self.error = error
            self._say_wrong(f"{type(error).__name__}: {error}")
            self._stopping.wait(0.5)
        return None

    def _show(self, frame):
        self._frame = frame
        try:
            self.value = frame if self._process is None else self._process(frame, **self.parameters)
            self._screen.show(self.value)
        except (Exception, SystemExit) as error:  # noqa: BLE001  the learner's function may raise anything
            self.error = error
            self._say_wrong(describe_error(error, self._process))
        else:
            if self._failing:
                self._screen.say()
            self.error, self._failing = None, False
            self.shown += 1

    def _say_wrong(self, words):
        self._failing = True
        self._screen.say(words, wrong=True)

    def _report(self, recent, seconds, printed):
        if self._beat.is_due():
            if printed and not self._failing:
                self._screen.say(last_lines(printed))
            printed.clear()
            span = recent[-1] - recent[0]
            self.rate = (len(recent) - 1) / span if span > 0 else 0.0
            self._figures.value = f"{self.rate:.1f} frames/s, {seconds * 1000:.0f} ms each"
            self._beat.ask()

    def _count_views(self, change):
        self._hidden = change["new"] == 0


_running = set()


@atexit.register
def _stop_all():
    for view in list(_running):
        view._stopping.set()
    for view in list(_running):
        view.stop()


class _Beat:
    """How fast the browser takes frames, by asking it twice a second.

    A number is sent after the frames. In the browser, a link between two widgets copies it into another one,
    which sends it back: the answer's delay is the length of the queue on the way.
    """

    def __init__(self):
        self._question, self._answer = widgets.IntText(value=1), widgets.IntText(value=0)
        self._link = widgets.jsdlink((self._question, "value"), (self._answer, "value"))
        self._answer.observe(self._hear, "value")
        self._fastest = 0.85 / MAX_RATE  # a frame that comes a little early is not to be missed
        self._interval = self._fastest
        self._asked = self._heard = 0.0

    def interval(self):
        """Seconds from one frame to the next."""
        if not self._heard:
            return WITHOUT_BROWSER
        silence = time.monotonic() - self._asked if self._is_waiting() else 0
        if silence > GONE:
            return WITHOUT_BROWSER
        return max(self._interval, WITHOUT_ANSWER) if silence > 1 else self._interval

    def _is_waiting(self):
        return self._answer.value != self._question.value

    def is_due(self):
        return time.monotonic() - self._asked > BEAT

    def ask(self):
        if not self._is_waiting():
            self._asked = time.monotonic()
            self._question.value += 1

    def _hear(self, _):
        self._heard = time.monotonic()
        late = self._asked and self._heard - self._asked > LATE
        self._interval = min(1.0, max(self._fastest, self._interval * (1.25 if late else 0.8)))


# ---------------------------------------------------------------- where frames come from


def _feed_from(source, encoding, rate):
    if isinstance(source, str) and source in ("recording", "webcam", "drive"):
        call = 'open_recording("drive")' if source == "drive" else f'open_camera("{source}")'
        raise ValueError(f'"{source}" is no topic; show live_view({call})')
    if isinstance(source, str):
        return _Topic(source, encoding)
    if hasattr(source, "wait") and hasattr(source, "latest"):
        return _Subscription(source)
    if hasattr(source, "frame") and hasattr(source, "__len__"):
        return _Playback(source, encoding, rate)
    if hasattr(source, "topic"):
        return _Topic(source.topic, encoding)
    raise ValueError(
        f"cannot show {type(source).__name__} live; expected a Camera, an ImageSubscriber, a topic name "
        'such as "/kachaka/front_camera/image_raw", or a Recording; a single picture is for show()'
    )


def is_live(source):
    """Whether frames can be had from it again and again."""
    return isinstance(source, str) or any(hasattr(source, name) for name in ("wait", "frame", "topic"))


class _Subscription:
    """A learner's own subscription: it goes on when the view stops."""

    def __init__(self, subscriber):
        self._subscriber, self._last = subscriber, None

    def open(self):
        pass

    def next(self, timeout):
        """The newest frame that was not given yet."""
        frame = self._subscriber.latest()
        if frame is None or frame is self._last:
            frame = self._subscriber.wait(timeout=timeout)
        self._last = frame
        return frame

    def close(self):
        pass


class _Topic(_Subscription):
    """A subscription of the view's own, closed with it."""

    def __init__(self, topic, encoding):
        super().__init__(None)
        self._topic, self._encoding = topic, encoding

    def open(self):
        from imgproc_course.ros import ImageSubscriber

        self._subscriber = ImageSubscriber(self._topic, encoding=self._encoding)

    def close(self):
        subscriber, self._subscriber = self._subscriber, None
        if subscriber is not None:
            subscriber.stop()


class _Playback:
    """A recording at its own speed, from the start and over again; frames that come too late are left out."""

    def __init__(self, recording, encoding, rate):
        if len(recording) == 0:
            raise ValueError("the recording holds no camera picture; nothing to show")
        self._rate = rate or recording.rate
        if not self._rate > 0:
            raise ValueError(f"rate={rate}: a recording is played at more than 0 frames a second")
        self._recording, self._encoding = recording, encoding

    def open(self):
        self._started, self._next = time.monotonic(), 0

    def next(self, timeout):
        due = self._started + self._next / self._rate
        time.sleep(min(timeout, max(0.0, due - time.monotonic())))
        number = max(self._next, int((time.monotonic() - self._started) * self._rate))
        self._next = number + 1
        return self._recording.frame(number % len(self._recording), encoding=self._encoding)

    def close(self):
        pass


# ---------------------------------------------------------------- the notebook around it


def publish(widget, text, still):
    """Shows a widget in the running cell; a notebook that is only read shows `still`, HTML, in its place.

    The stored output holds `text` and `still`, alike in every run; only the widget's number differs.
    """
    display(_Published(widget, text, still))


class _Published:
    def __init__(self, widget, text, still):
        self._widget, self._text, self._still = widget, text, still

    def _repr_mimebundle_(self, include=None, exclude=None):
        bundle = self._widget._repr_mimebundle_() or {}
        return {**bundle, "text/plain": self._text, "text/html": self._still}

    def __repr__(self):
        return self._text


def _where():
    """The cell that runs now, and which run of the kernel's it is; (None, None) outside a notebook."""
    shell = get_ipython()
    if shell is None:
        return None, None
    parent = shell.get_parent() if hasattr(shell, "get_parent") else {}
    cell = parent.get("metadata", {}).get("cellId") or parent.get("content", {}).get("code")
    return cell, shell.execution_count


def _save(picture):
    for number in itertools.count(1):
        path = Path(f"snapshot-{number:03d}.png")
        if not path.exists():
            break
    path.write_bytes(cv2.imencode(".png", picture)[1].tobytes())
    return path
