"""The robot for a terminal, until Ctrl-C: `imgproc-course play` is a recording's camera, `drive` the room."""

import time

from imgproc_course.ros.camera import open_camera
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.stop_signals import stop_signals

STATUS_SECONDS = 10.0
TO_DRIVE = """\
To drive it by keys, run in a notebook:
    from imgproc_course.display import drive
    from imgproc_course.ros import Robot
    drive(Robot())"""


def play(source="recording", *, status_seconds=STATUS_SECONDS, **options):
    """Uses the camera of these options until a signal, or its end; the exit code is 1 after an error."""
    with stop_signals() as stopping, RosSession() as session, open_camera(source, **options) as camera:
        others = ", ".join(camera.other_users)
        how = f"joined the robot of {others}" if others else "started"
        topics = ", ".join((camera.compressed_topic, *camera.info_topics))
        domain = session.context.get_domain_id()
        print(f"{how}: {camera.description} in domain {domain}, with {topics} (Ctrl-C stops)", flush=True)
        if source == "room":
            print(TO_DRIVE, flush=True)
        start, due = time.monotonic(), status_seconds
        while not stopping.wait(0.1) and camera.running:
            if (elapsed := time.monotonic() - start) >= due and source != "room":
                due = elapsed + status_seconds
                counts = [f"{topic} {count}" for topic, count in camera.subscribers().items() if count]
                subscribers = ", ".join(counts) or "none"
                print(f"{elapsed:.0f} s: {camera.played} images; subscribers: {subscribers}", flush=True)
        print(_last_line(camera), flush=True)
        return 0 if camera.last_error is None else 1


def _last_line(camera):
    if camera.last_error is not None:
        return f"stopped by an error: {camera.last_error}"
    if camera.running and camera.other_users:
        return f"left; the camera goes on for {', '.join(camera.other_users)}"
    reason = "" if camera.published else " (the raw topic had no subscriber)"
    return f"stopped after {camera.played} images; {camera.published} raw images sent{reason}"
