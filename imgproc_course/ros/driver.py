"""The room for a terminal: `imgproc-course drive` starts or joins it. Programs drive the robot."""

import time

from imgproc_course.ros.camera import open_camera
from imgproc_course.ros.robot import Robot
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.stop_signals import stop_signals

STATUS_SECONDS = 10.0


def drive(*, status_seconds=STATUS_SECONDS, **options):
    """Uses the room of these options until a signal; the exit code is 1 after an error."""
    with stop_signals() as stopping, RosSession() as session, open_camera("room", **options) as camera:
        others = camera.other_users
        how = f"joined the robot of {', '.join(others)}" if others else "started"
        domain = session.context.get_domain_id()
        print(f"{how}: {camera.description} in domain {domain} (Ctrl-C stops)", flush=True)
        with Robot() as robot:
            _print_status(camera, robot, stopping, status_seconds)
        print(f"stopped by an error: {camera.last_error}" if camera.last_error else "stopped", flush=True)
        return 0 if camera.last_error is None else 1


def _print_status(camera, robot, stopping, period):
    next_status = 0.0
    while not stopping.wait(0.1) and camera.running:
        if time.monotonic() > next_status:
            next_status = time.monotonic() + period
            print(_status(camera, robot), flush=True)


def _status(camera, robot):
    try:
        x, y, yaw = robot.pose
    except TimeoutError as error:
        return str(error)
    rate = "" if camera.reached_rate is None else f", {camera.reached_rate:.0f} images/s"
    return f"x {x:.2f} m, y {y:.2f} m, heading {yaw * 57.29578:.0f}°, {camera.bumps} bumps{rate}"
