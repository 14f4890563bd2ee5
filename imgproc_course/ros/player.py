"""The camera for a terminal: `imgproc-course play` starts or joins it, until Ctrl-C."""

import time

from imgproc_course.ros.camera import open_camera
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.stop_signals import stop_signals

STATUS_SECONDS = 10.0


def play(*, recording="drive", status_seconds=STATUS_SECONDS, **options):
    """Uses the camera of these options until a signal, or its end; the exit code is 1 after an error."""
    with stop_signals() as stopping, RosSession(), open_camera(recording=recording, **options) as camera:
        print(_first_line(camera, recording), flush=True)
        _print_status(camera, stopping, status_seconds)
        print(_last_line(camera), flush=True)
        return 0 if camera.last_error is None else 1


def _first_line(camera, recording):
    domain = RosSession.current().context.get_domain_id()
    topics = ", ".join((camera.topic, camera.compressed_topic, *camera.info_topics))
    others = camera.other_users
    how = f"joined the camera of {', '.join(others)}" if others else "started"
    return f"{how}: {recording} at {camera.rate:g} Hz in domain {domain}: {topics} (Ctrl-C stops)"


def _last_line(camera):
    if camera.last_error is not None:
        return f"stopped by an error: {camera.last_error}"
    if camera.running and camera.other_users:
        return f"left; the camera goes on for {', '.join(camera.other_users)}"
    reason = "" if camera.published else " (the raw topic had no subscriber)"
    return f"stopped after {camera.played} images; {camera.published} raw images sent{reason}"


def _print_status(camera, stopping, period):
    start = time.monotonic()
    lines = 0
    while not stopping.wait(0.1) and camera.running:
        elapsed = time.monotonic() - start
        if elapsed >= (lines + 1) * period:
            lines = int(elapsed // period)
            counts = [f"{topic} {count}" for topic, count in camera.subscribers().items() if count]
            subscribers = ", ".join(counts) or "none"
            print(f"{elapsed:.0f} s: {camera.played} images; subscribers: {subscribers}", flush=True)
