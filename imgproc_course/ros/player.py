"""The camera in a process of its own: what `imgproc-course play` runs until Ctrl-C."""

import signal
import threading
import time

from imgproc_course.ros.camera import open_camera
from imgproc_course.ros.session import RosSession

STATUS_SECONDS = 10.0


def play(*, recording="drive", status_seconds=STATUS_SECONDS, **options):
    """Publishes a recording until Ctrl-C, SIGTERM, or its end (without loop). Runs in the main thread.

    Parameters
    ----------
    recording, and `topic`, `camera_topic`, `speed`, `loop`, `stamps` : as in `open_camera`
    status_seconds : time between two lines that say how it goes

    Returns
    -------
    int, the exit code: 0, or 1 when the camera stopped on an error

    Raises
    ------
    ValueError : as `open_camera`
    """
    leaving = threading.Event()
    former = {number: signal.signal(number, lambda *_: leaving.set()) for number in _SIGNALS}
    try:
        with open_camera(recording=recording, **options) as camera:
            print(_opening(camera, recording), flush=True)
            _watch(camera, leaving, status_seconds)
            if camera.last_error is None:
                why = "" if camera.published else ", as nobody subscribed to these"
                print(
                    f"stopped after {camera.shown} pictures, {camera.published} of them sent raw{why}",
                    flush=True,
                )
            return 0 if camera.last_error is None else 1
    finally:
        RosSession().stop()
        for number, handler in former.items():
            signal.signal(number, handler)


_SIGNALS = (signal.SIGINT, signal.SIGTERM)


def _opening(camera, recording):
    domain = RosSession.current().context.get_domain_id()
    topics = ", ".join((camera.topic, camera.compressed_topic, *camera.info_topics))
    return f"{recording} at {camera.rate:g} Hz in domain {domain}: {topics} (Ctrl-C stops)"


def _watch(camera, leaving, status_seconds):
    began = time.monotonic()
    told = 0
    while not leaving.wait(0.1) and camera.running:
        running = time.monotonic() - began
        if running >= (told + 1) * status_seconds:
            told = int(running // status_seconds)
            print(f"{running:.0f} s: {camera.shown} pictures; subscribers: {_listeners(camera)}", flush=True)


def _listeners(camera):
    counts = [f"{topic} {count}" for topic, count in camera.subscribers().items() if count]
    return ", ".join(counts) or "none"
