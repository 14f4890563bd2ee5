"""A running camera in a notebook, and the result of a learner's function on each frame."""

import atexit
import html
import itertools
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import ipywidgets as widgets
import numpy as np
from IPython import get_ipython
from IPython.display import display

from imgproc_course.display.controls import Controls, in_a_row, make_button
from imgproc_course.display.figures import Output, split_text
from imgproc_course.display.printing import captured_prints, last_lines
from imgproc_course.display.screen import Screen, Style, View
from imgproc_course.learner_errors import describe

MAX_RATE = 30  # frames per second: enough for a camera on a screen, and the browser must keep up
PING_INTERVAL = 0.5  # seconds between two pings to the browser
LATE = 0.3  # seconds; a later reply means that a queue has formed
NO_BROWSER_AFTER = 10  # seconds without a reply
WITHOUT_REPLY = 0.2  # seconds between frames while no reply comes
WITHOUT_BROWSER = 1.0  # seconds between frames without a browser


def live_view(
    source: Any,
    process: Callable[..., Any] | None = None,
    *,
    encoding: str = "bgr8",
    width: int | None = None,
    limits: tuple[float, float] | None = None,
    text: str | None = None,
    **ranges: Any,
) -> "LiveView":
    """Shows a running camera in the notebook, each frame as the learner's function returns it.

    It runs on a thread: the cell ends at once, and sliders, other cells and other views go on working. An
    exception in `process`, or what it prints, is shown under the image; then the next frame is processed.
    If frames come faster than `process` or the browser can handle them, some are dropped. The view pauses
    while no page shows it. It stops when its cell runs again, and when the kernel stops.

    Parameters
    ----------
    source : Camera, ImageSubscriber, topic name, or Recording (which needs no ROS, and repeats)
    process : function (frame, **parameters) -> array, or a list or dict (title -> array) of arrays
        Arrays are shown side by side: uint8, bool, or colour in the order of `encoding`. Omitted: the frame.
    encoding : str
        Encoding of the frames, and channel order of colour results.
    width : int
        CSS pixels. If omitted: 640 for one image, 960 for several. Frames are sent at this width.
    limits : (low, high)
        The values shown black and white, for gray results that are neither uint8 nor bool.
    text : name of the sentence under the view and of the alternative text, as in `show`
    **ranges
        Parameters of `process` that sliders set while it runs: low=(0, 1020) is a slider, see `tune`.

    Returns
    -------
    LiveView : .stop(), .start(), .snapshot(), .snapshots, .parameters, .value, .error, .rate, .shown

    Raises
    ------
    ValueError : another kind of source, an invalid range
    RosMissingError : a topic, but rclpy is not installed
    """
    style = Style(encoding, width, limits, *split_text(text))
    view = LiveView(source, process, style, ranges)
    view.start()
    view.publish()
    return view


class Snapshot(NamedTuple):
    """What was on the screen: the frame, the result of `process`, and the file in which it was saved."""

    frame: np.ndarray
    result: Any
    path: Path | None


class LiveView(View):
    """A live view, running or stopped; `live_view` makes one and starts it.

    Attributes
    ----------
    shown : number of frames sent to the browser so far
    rate : frames sent per second, over the last two seconds
    value : what `process` returned last; None before the first frame
    error : the exception of the last frame, or None
    snapshots : list of Snapshot
    """

    def __init__(self, source: Any, process: Callable[..., Any] | None, style: Style, ranges: dict[str, Any]):
        if process is not None and not callable(process):
            raise ValueError(
                f"process is {type(process).__name__}; expected a function: live_view(camera, edges)"
            )
        if ranges and process is None:
            raise ValueError(f"{', '.join(ranges)}: sliders need a function whose parameters they set")
        self._process = process
        self._feed = _feed_from(source, style.encoding)
        self._controls = Controls(process, ranges) if ranges else None
        self._name = style.caption or getattr(process, "__name__", "camera").replace("<lambda>", "camera")
        self._screen = Screen(style, f"Live view: {self._name}")
        self._pacer = _Pacer()
        self._thread: threading.Thread | None = None
        self._stopping = threading.Event()
        self._frame = None
        self._cell = self._cell_run = None
        self._hidden = self._failing = False
        self.shown, self.rate, self.value = 0, 0.0, None
        self.error: BaseException | None = None
        self.snapshots: list[Snapshot] = []
        self._make_widgets()

    def _make_widgets(self):
        self._start = make_button("Start", "play", self.start)
        self._stop = make_button("Stop", "stop", self.stop)
        snapshot = make_button("Snapshot", "camera", self.snapshot)
        self._status = widgets.Label(value="waiting for the first frame", layout=widgets.Layout(flex="none"))
        bar = in_a_row(self._start, self._stop, snapshot, self._status)
        box = self._screen.box
        self._box = widgets.VBox([bar, in_a_row(box, self._controls.box) if self._controls else box])
        # With a number here, the browser counts the views of this widget: 0 means that no page shows it.
        self._screen.image._view_count = 0
        self._screen.image.observe(self._count_views, "_view_count")

    @property
    def running(self) -> bool:
        """Whether the view shows new images now."""
        return self._thread is not None and self._thread.is_alive()

    def start(self) -> None:
        """Starts the view, or starts it again. Does nothing if it runs."""
        if self.running:
            return
        self._stopping.clear()
        self._feed.open()
        self._thread = threading.Thread(target=self._run, name=f"live view: {self._name}", daemon=True)
        self._thread.start()
        _running.add(self)
        self._start.disabled, self._stop.disabled = True, False

    def stop(self) -> None:
        """Stops the thread and the view's own subscription; the last image stays."""
        self._stopping.set()
        self._feed.close()  # this also wakes the thread if it waits for a frame
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout=3)
        _running.discard(self)
        self._start.disabled, self._stop.disabled = False, True
        self._status.value = f"stopped after {self.shown} frame{'' if self.shown == 1 else 's'}"

    def snapshot(self) -> Snapshot | None:
        """Adds frame and result to `.snapshots`, and saves the image as a PNG file in the working folder."""
        if self._frame is None:
            self._screen.say("there is no snapshot: no frame has come yet", is_error=True)
            return None
        result = self._frame if self.value is None else self.value
        try:
            path = _save(self._screen.full_size(result))
            file_text = f" and {path}"
        except (OSError, ValueError) as error:
            path, file_text = None, f"; no file was written: {error}"
        snapshot = Snapshot(np.array(self._frame), result, path)
        self.snapshots.append(snapshot)
        self._screen.say(f"saved as .snapshots[{len(self.snapshots) - 1}]{file_text}")
        return snapshot

    def publish(self) -> None:
        """Shows the view in the cell that runs now, and stops the view of an earlier run of this cell."""
        cell, run = _running_cell()
        for view in list(_running):
            if cell is not None and view._cell == cell and view._cell_run != run:
                view.stop()
        self._cell, self._cell_run = cell, run
        name = html.escape(self._name.rstrip("."))
        still = f"<p>Live view: {name}. It moves when this cell is run.</p>"
        display(Output(f"Live view: {self._name}", still, self._box))

    def _ipython_display_(self):
        # As the last value of its own cell, it is already on the page.
        if (self._cell, self._cell_run) != _running_cell():
            self.publish()

    def __repr__(self):
        return f"Live view: {self._name}"

    def _run(self):
        recent_times = [0.0]  # when the processing of the last two seconds' frames started
        with captured_prints() as printed:
            while not self._stopping.is_set():
                if not self._wait_for_turn(recent_times[-1]):
                    continue
                frame = self._next_frame()
                if frame is None:
                    continue
                started = time.monotonic()
                self._show(frame)
                recent_times = [moment for moment in recent_times if started - moment < 2] + [started]
                self._report(recent_times, time.monotonic() - started, printed)

    def _wait_for_turn(self, last_time):
        """Sleeps until the browser may get a frame. False: check first whether the view was stopped."""
        if self._hidden:
            self._stopping.wait(0.2)
            return False
        remaining = last_time + self._pacer.interval() - time.monotonic()
        if remaining > 0:
            self._stopping.wait(min(remaining, 0.02))
            return remaining <= 0.02
        return True

    def _next_frame(self):
        try:
            return self._feed.next(timeout=1.0)
        except TimeoutError as error:
            self.rate, self._status.value = 0.0, "0.0 frames/s"
            self._say_error(str(error))
        except Exception as error:  # noqa: BLE001  the source may be the learner's own; its error belongs on the screen
            if self._stopping.is_set():
                return None
            self.error = error
            self._say_error(f"{type(error).__name__}: {error}")
            self._stopping.wait(0.5)
        return None

    def _show(self, frame):
        self._frame = frame
        try:
            self.value = frame if self._process is None else self._process(frame, **self.parameters)
            self._screen.show(self.value)
        except (Exception, SystemExit) as error:  # noqa: BLE001  the learner's function may raise anything
            self.error = error
            self._say_error(describe(error) or f"{type(error).__name__}: {error}")
        else:
            if self._failing:
                self._screen.say()
            self.error, self._failing = None, False
            self.shown += 1

    def _say_error(self, text):
        self._failing = True
        self._screen.say(text, is_error=True)

    def _report(self, times, seconds, printed):
        if self._pacer.is_due():
            if printed and not self._failing:
                self._screen.say(last_lines(printed))
            printed.clear()
            span = times[-1] - times[0]
            self.rate = (len(times) - 1) / span if span > 0 else 0.0
            self._status.value = f"{self.rate:.1f} frames/s, {seconds * 1000:.0f} ms per frame"
            self._pacer.ping()

    def _count_views(self, change):
        self._hidden = change["new"] == 0


_running: set[LiveView] = set()


@atexit.register
def _stop_all():
    for view in list(_running):
        view._stopping.set()
    for view in list(_running):
        view.stop()


class _Pacer:
    """Sends frames only as fast as the browser takes them: it pings the browser twice per second.

    The ping is a number, sent after the frames. In the browser a link between two widgets copies the number
    from one to the other, which sends it back. If the reply is late, frames wait in a queue.
    """

    def __init__(self):
        self._ping, self._reply = widgets.IntText(value=1), widgets.IntText(value=0)
        self._link = widgets.jsdlink((self._ping, "value"), (self._reply, "value"))
        self._reply.observe(self._on_reply, "value")
        self._fastest = 0.85 / MAX_RATE  # so that a frame that comes a little early is not dropped
        self._interval = self._fastest
        self._ping_time = self._reply_time = 0.0
        self._begin = time.monotonic()

    def interval(self):
        """Seconds from one frame to the next."""
        if not self._reply_time:  # no browser; or its cell still runs, and no reply can come
            return WITHOUT_REPLY if time.monotonic() - self._begin < NO_BROWSER_AFTER else WITHOUT_BROWSER
        silence = time.monotonic() - self._ping_time if self._is_waiting() else 0
        if silence > NO_BROWSER_AFTER:
            return WITHOUT_BROWSER
        return max(self._interval, WITHOUT_REPLY) if silence > 1 else self._interval

    def _is_waiting(self):
        return self._reply.value != self._ping.value

    def is_due(self):
        return time.monotonic() - self._ping_time > PING_INTERVAL

    def ping(self):
        if not self._is_waiting():
            self._ping_time = time.monotonic()
            self._ping.value += 1

    def _on_reply(self, _):
        self._reply_time = time.monotonic()
        is_late = self._ping_time and self._reply_time - self._ping_time > LATE
        self._interval = min(1.0, max(self._fastest, self._interval * (1.25 if is_late else 0.8)))


def _feed_from(source, encoding):
    if isinstance(source, str) and source in ("recording", "webcam", "drive"):
        call = 'open_recording("drive")' if source == "drive" else f'open_camera("{source}")'
        raise ValueError(f'"{source}" is not a topic; call live_view({call})')
    if isinstance(source, str):
        return _Topic(source, encoding)
    if hasattr(source, "wait") and hasattr(source, "latest"):
        return _Subscription(source)
    if hasattr(source, "frame") and hasattr(source, "__len__"):
        return _Playback(source, encoding)
    if hasattr(source, "topic"):
        return _Topic(source.topic, encoding)
    raise ValueError(
        f"cannot show {type(source).__name__} live; expected a Camera, an ImageSubscriber, a topic name "
        'such as "/kachaka/front_camera/image_raw", or a Recording; for a single image call show()'
    )


class _Feed:
    """Where a view's frames come from, by `next`, while it runs; what needs no opening stays as it is."""

    def open(self):
        pass

    def close(self):
        pass


class _Subscription(_Feed):
    """A learner's own subscription, which stays open when the view stops."""

    def __init__(self, subscriber):
        self._subscriber, self._last_frame = subscriber, None

    def next(self, timeout):
        """The newest frame that was not returned before."""
        frame = self._subscriber.latest()
        if frame is None or frame is self._last_frame:
            frame = self._subscriber.wait(timeout=timeout)
        self._last_frame = frame
        return frame


class _Topic(_Subscription):
    """The view's own subscription, which closes with the view."""

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


class _Playback(_Feed):
    """Plays a recording at its own rate, again and again; frames that would be late are dropped."""

    def __init__(self, recording, encoding):
        if len(recording) == 0:
            raise ValueError("the recording has no camera image; there is nothing to show")
        self._recording, self._encoding = recording, encoding
        self._rate = recording.rate or 1.0  # a single frame has no rate

    def open(self):
        self._started, self._next_number = time.monotonic(), 0

    def next(self, timeout):
        due = self._started + self._next_number / self._rate
        time.sleep(min(timeout, max(0.0, due - time.monotonic())))
        number = max(self._next_number, int((time.monotonic() - self._started) * self._rate))
        self._next_number = number + 1
        return self._recording.frame(number % len(self._recording), encoding=self._encoding)


def _running_cell():
    """The cell that runs now, and the kernel's execution count; (None, None) outside a notebook."""
    shell = get_ipython()
    if shell is None:
        return None, None
    parent = shell.get_parent() if hasattr(shell, "get_parent") else {}
    cell = parent.get("metadata", {}).get("cellId") or parent.get("content", {}).get("code")
    return cell, shell.execution_count


def _save(image):
    paths = (Path(f"snapshot-{number:03d}.png") for number in itertools.count(1))
    path = next(path for path in paths if not path.exists())
    path.write_bytes(cv2.imencode(".png", image)[1].tobytes())
    return path
