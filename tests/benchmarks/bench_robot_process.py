"""Programs use one camera and are killed at random: is there always one, and does it end with the last?

Each round, one of PROGRAMS programs is killed (kill -9) or leaves, or the camera's own process is killed, and
programs that ended start again. At the end the last ones are killed at once. Required: each program that
joins receives frames; there is never a second camera process; at the end no process and no socket is left.

Run it with `environment/test --benchmarks robot_process`; SECONDS=600 in the environment makes it longer.
"""

import collections
import os
import random
import subprocess
import sys
import time

import psutil

SECONDS = float(os.environ.get("SECONDS", "60"))
PROGRAMS = 4
TIMEOUT = 120.0
JOINS = """
import sys
from imgproc_course.ros import ImageSubscriber, open_camera
with open_camera(speed=3.0) as camera, ImageSubscriber(camera.topic) as subscriber:
    subscriber.wait(60)
    print("receives", flush=True)
    sys.stdin.readline()
    open_camera(speed=3.0)  # starts it again if it was killed
    subscriber.wait(60)
"""


def main():
    os.environ.setdefault("ROS_DOMAIN_ID", "98")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    choose = random.Random(1)
    counts = collections.Counter()
    programs, end = [], time.monotonic() + SECONDS
    while time.monotonic() < end:
        while len(programs) < PROGRAMS:
            programs.append(start())
        counts["most camera processes"] = max(counts["most camera processes"], len(camera_processes()))
        event(choose, programs, counts)
    for program in programs:
        program.kill()
        program.communicate()
    left = remaining()
    counts["left at the end"] = len(left)
    for name, count in counts.items():
        print(f"{name}: {count}")
    good = not left and not counts["failed"] and counts["most camera processes"] == 1
    print("one camera, and nothing left" if good else f"FAILED {left}")
    return 0 if good else 1


def start():
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([sys.executable, "-c", JOINS], text=True, **pipes)


def event(choose, programs, counts):
    """One of the programs ends, at once or when it has received a frame; or the camera process is killed."""
    program = programs.pop(choose.randrange(len(programs)))
    kind = choose.choice(["killed while it starts", "killed", "left", "left after its camera was killed"])
    if kind == "killed while it starts":
        time.sleep(choose.uniform(0, 2))
        program.kill()
    elif program.stdout.readline() != "receives\n":
        counts["failed"] += 1
    elif kind == "killed":
        program.kill()
    elif kind == "left after its camera was killed":
        for process in camera_processes():
            process.kill()
    if program.communicate("leave\n", timeout=TIMEOUT) and kind.startswith("left") and program.returncode:
        counts["failed"] += 1
    counts[kind] += 1


def camera_processes():
    processes = []
    for process in psutil.process_iter(["cmdline"]):
        command = process.info["cmdline"] or []
        if "robot_body import main" in " ".join(command) and command[-3] == os.environ["ROS_DOMAIN_ID"]:
            processes.append(process)
    return processes


def remaining():
    """The camera processes and sockets that are left after some time."""
    from imgproc_course.ros.robot_process import runtime_file

    socket_file = runtime_file(int(os.environ["ROS_DOMAIN_ID"]), "socket")
    end = time.monotonic() + TIMEOUT
    while (left := [*camera_processes(), *filter(os.path.exists, [socket_file])]) and time.monotonic() < end:
        time.sleep(0.1)
    return left


if __name__ == "__main__":
    raise SystemExit(main())
