"""The doctor's checks of the images: the recording, free disk space, and topics that deliver."""

import shutil
from pathlib import Path

from imgproc_course.doctor.report import failure, failure_of, ok, warning

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
        yield failure_of("recording", error, "git checkout -- imgproc_course/recording/drive")


def check_disk():
    free = shutil.disk_usage(Path.cwd()).free
    if free >= ENOUGH_DISK:
        yield ok("disk", "enough space for your work")
    else:
        problem = f"{free >> 20} MiB free where your lessons are"
        yield warning("disk", problem, "free some space before you go on")


def check_topics():
    """Waits for frames of the camera that runs; if none runs, the doctor starts it and ends it again."""
    from imgproc_course.ros import RosSession, ros_available

    if not ros_available():
        return
    was_running = RosSession().running
    try:
        yield _diagnosis_of_topic(_why_no_frames_of_the_camera())
    # A node or the robot process did not start; the error names the environment variable that is wrong.
    except (ValueError, RuntimeError) as error:
        yield failure_of("topic", error, "correct it, then restart the kernel")
    finally:
        if not was_running:
            RosSession().stop()


def _diagnosis_of_topic(problem):
    if problem is None:
        return ok("topic", "frames arrive from the camera, a process of its own")
    observation, _, remedy = problem.partition("; ")
    also = "see the lines on DDS profile, shared memory and loopback; a firewall may block the frames"
    return failure("topic", observation, f"{remedy}; {also}" if remedy else also)


def _why_no_frames_of_the_camera():
    from imgproc_course.ros import RosSession, open_camera
    from imgproc_course.ros.robot_process import running_robot

    robot = running_robot(RosSession.current().context.get_domain_id())
    if robot is not None and robot.get("running"):
        return _why_no_frames(robot["topic"])  # whatever it plays
    with open_camera() as camera:
        return _why_no_frames(camera.topic)


def _why_no_frames(topic, timeout=15.0):
    """Why no frames arrive, in one line; None if they do."""
    from imgproc_course.ros import ImageSubscriber

    with ImageSubscriber(topic) as subscriber:
        try:
            for _ in range(FRAMES):
                subscriber.wait(timeout)
        except TimeoutError as error:
            return str(error)
    return None
