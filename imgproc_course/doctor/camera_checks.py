"""The doctor's checks of the images: the recording, free disk space, and topics that deliver."""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from imgproc_course.doctor.report import failure, ok, warning

ENOUGH_DISK = 200 << 20
FRAMES = 3


def check_recording():
    from imgproc_course.messages import ConversionError
    from imgproc_course.recording import RecordingError, open_recording

    try:
        with open_recording("drive") as drive:
            rows, cols, _ = drive.frame(0).shape
            yield ok("recording", f"{len(drive)} frames of {cols}×{rows}, {drive.rate:g} per second")
    except (RecordingError, ConversionError) as error:
        observation, _, remedy = str(error).partition("; ")
        yield failure("recording", observation, remedy or "git checkout -- imgproc_course/recording/drive")


def check_disk():
    free = shutil.disk_usage(Path.cwd()).free
    if free >= ENOUGH_DISK:
        yield ok("disk", "enough space for your work")
    else:
        yield warning(
            "disk", f"{free >> 20} MiB free where your lessons are", "free some space before you go on"
        )


def check_topics():
    """Plays the drive on topics of its own, in this process and in another one, and waits for frames."""
    from imgproc_course.ros import RosSession, ros_available

    if not ros_available():
        return
    was_running = RosSession().running
    try:
        yield from _topic_in_this_process()
        yield from _topic_of_another_process()
    except (
        ValueError
    ) as error:  # a node did not start: the error names the environment variable that is wrong
        observation, _, remedy = str(error).partition("; ")
        yield failure("topic", observation, remedy or "correct it, then restart the kernel")
    finally:
        if not was_running:
            RosSession().stop()


def _topic_in_this_process():
    from imgproc_course.ros import open_camera

    topic = f"/doctor_{os.getpid()}/image_raw"
    with open_camera(topic=topic) as camera:
        problem = _why_no_frames(camera.topic)
    if problem is None:
        yield ok("topic", "frames arrive, published in this process")
    else:
        observation, _, remedy = problem.partition("; ")
        yield failure("topic", observation, remedy or "restart the kernel and run the doctor again")


def _topic_of_another_process():
    topic = f"/doctor_{os.getpid()}/elsewhere/image_raw"
    command = [sys.executable, "-c", "from imgproc_course.cli import main; main()", "play", "--topic", topic]
    player = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        problem = _why_no_frames(topic, timeout=15.0)
    finally:
        player.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            player.wait(5)
        player.kill()
    if problem is None:
        yield ok("two programs", "frames arrive from imgproc-course play, another process")
    else:
        yield warning(
            "two programs",
            "frames published by another process do not arrive (within one notebook they do)",
            "see the lines on DDS profile, shared memory and loopback; a firewall may block them",
        )


def _why_no_frames(topic, timeout=5.0):
    """Why no frames arrive, in one line; None if they do."""
    from imgproc_course.ros import ImageSubscriber

    with ImageSubscriber(topic) as subscriber:
        try:
            for _ in range(FRAMES):
                subscriber.wait(timeout)
        except TimeoutError as error:
            return str(error)
    return None
