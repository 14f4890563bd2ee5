"""The room for a terminal: `imgproc-course drive` starts or joins it, and the keyboard drives the robot."""

import contextlib
import os
import select
import sys
import time

from imgproc_course.ros.camera import open_camera
from imgproc_course.ros.robot import Robot
from imgproc_course.ros.session import RosSession
from imgproc_course.ros.stop_signals import stop_signals

try:
    import termios
    import tty
except ImportError:
    termios = None  # type: ignore[assignment]  # Windows: the robot is then driven by other programs alone

LINEAR, ANGULAR = 0.25, 1.0  # m/s, rad/s
KEYS = {
    "w": (LINEAR, 0.0),
    "s": (-LINEAR, 0.0),
    "a": (0.0, ANGULAR),
    "d": (0.0, -ANGULAR),
    "q": (LINEAR, ANGULAR),
    "e": (LINEAR, -ANGULAR),
    " ": (0.0, 0.0),
}
ARROWS = {"\x1b[A": "w", "\x1b[B": "s", "\x1b[D": "a", "\x1b[C": "d"}
HELP = "arrows or W A S D drive, Q and E drive a curve, space stops; no key, no motion; X or Ctrl-C ends"
STATUS_SECONDS = 0.5
PLAIN_STATUS_SECONDS = 10.0  # where no terminal rewrites its line


def drive(*, status_seconds=None, **options):
    """Uses the room of these options until a signal or the key X; the exit code is 1 after an error."""
    with stop_signals() as stopping, RosSession() as session, open_camera("room", **options) as camera:
        others = camera.other_users
        how = f"joined the robot of {', '.join(others)}" if others else "started"
        domain = session.context.get_domain_id()
        with Robot() as robot, _keyboard() as read_key:
            print(f"{how}: {camera.description} in domain {domain} (Ctrl-C stops)", flush=True)
            if read_key is not None:
                print(HELP, flush=True)
            _drive(camera, robot, stopping, read_key, status_seconds)
            return 0 if camera.last_error is None else 1


def _drive(camera, robot, stopping, read_key, status_seconds):
    period = status_seconds or (PLAIN_STATUS_SECONDS if read_key is None else STATUS_SECONDS)
    line_start, line_end = ("", "\n") if read_key is None else ("\r\x1b[K", "")
    next_status = 0.0
    while not stopping.wait(0.1 if read_key is None else 0):
        key = read_key and read_key(0.05)
        if key == "x":
            break
        if key in KEYS:
            robot.drive(*KEYS[key])
        if time.monotonic() > next_status:
            if not camera.running:
                break
            next_status = time.monotonic() + period
            print(f"{line_start}{_status(camera, robot)}", end=line_end, flush=True)
    end = f"stopped by an error: {camera.last_error}" if camera.last_error else "stopped"
    print(f"{line_start}{end}", flush=True)


def _status(camera, robot):
    try:
        x, y, yaw = robot.pose
    except TimeoutError as error:
        return str(error)
    rate = "" if camera.reached_rate is None else f", {camera.reached_rate:.0f} images/s"
    return f"x {x:.2f} m, y {y:.2f} m, heading {yaw * 57.29578:.0f}°, {camera.bumps} bumps{rate}"


@contextlib.contextmanager
def _keyboard():
    """A function of a timeout in seconds, which returns the next key or None; or None without a terminal."""
    if termios is None or not sys.stdin.isatty():
        yield None
        return
    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)
    try:
        yield lambda timeout: _read_key(descriptor, timeout)
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)


def _read_key(descriptor, timeout):
    """The newest key; those that came while the robot was busy are dropped, so that it stops at once."""
    if not select.select([descriptor], [], [], timeout)[0]:
        return None
    text = os.read(descriptor, 1024).decode(errors="ignore")
    return ARROWS.get(text[-3:]) or text[-1:].lower()
