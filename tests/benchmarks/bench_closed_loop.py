"""Nodes drive the robot by its published topics alone: ten starts and seeds each, bumps counted.

A node of tests/ros/closed_loop_nodes.py is a process of its own. This process only sets the start, and reads
the truth afterwards. Required: no bump of the two nodes that see what they may hit (depth, and the marker's
over a free floor), and a distance to the marker that is right to 10 cm. The scan's plane is above slippers
and books: its bumps are shown, and not counted as failures.

Run it with `environment/test --benchmarks closed_loop`; LOOPS="depth marker" and STARTS=3 select.
"""

import math
import os
import subprocess
import sys
import time

import numpy as np
from geometry_msgs.msg import PoseStamped
from in_the_room import PROGRAMS, TRUTH, Topics, pose_of

from imgproc_course.ros import Robot, open_camera
from imgproc_course.simulation.room_model import FreeSpace
from imgproc_course.simulation.wheels import clearance

NODES = PROGRAMS / "closed_loop_nodes.py"
LOOPS = os.environ.get("LOOPS", "depth scan marker").split()
STARTS = int(os.environ.get("STARTS", "10"))
RATE = float(os.environ.get("RATE", "30"))
TIMEOUT = 240.0
MARKER, MARKER_STOP, TOLERANCE = (-0.896, 0.55), 1.0, 0.1  # metres


def starts(loop):
    """(seed, (x, y, yaw), lighting): free places, from which the way ahead, or to the marker, is free."""
    free = FreeSpace.load().distance
    seed, count = 0, 0
    while count < STARTS:
        seed += 1
        random = np.random.default_rng(seed)
        if loop == "marker":
            x, y = random.uniform(0.9, 1.6), random.uniform(-0.6, 1.4)
            towards = math.atan2(MARKER[1] - y, MARKER[0] - x)
            yaw = towards + random.uniform(-0.4, 0.4)
        else:
            x, y, yaw = (
                random.uniform(-0.5, 4.5),
                random.uniform(-1.5, 1.8),
                random.uniform(-math.pi, math.pi),
            )
            towards = yaw
        way = [(x + s * math.cos(towards), y + s * math.sin(towards)) for s in np.arange(0, 0.7, 0.1)]
        if all(clearance(free, u, v, towards) > 0.05 for u, v in way):
            count += 1
            yield seed, (round(x, 3), round(y, 3), round(yaw, 3)), ("day", "evening")[count % 2]


def run(loop, robot, camera, topics, seed, start, lighting):
    """Drives one loop: (bumps, metres driven, the node's distance, the true one to the marker's wall)."""
    while True:
        try:
            robot.restart(seed=seed, start=start, lighting=lighting)
            break
        except ValueError as error:  # person or car stand there just now
            print(f"waits: {error}", flush=True)
            time.sleep(2)
    bumps = camera.bumps
    node = subprocess.run(
        [sys.executable, str(NODES), loop], capture_output=True, text=True, timeout=TIMEOUT, check=True
    )
    x, y, yaw = true_place(topics)
    eye = (x + 0.21 * math.cos(yaw), y + 0.21 * math.sin(yaw))
    ahead = (MARKER[0] - eye[0]) * math.cos(yaw) + (MARKER[1] - eye[1]) * math.sin(yaw)
    return camera.bumps - bumps, math.dist((x, y), start[:2]), float(node.stdout), ahead


def true_place(topics):
    """The robot's newest true (x, y, yaw)."""
    topics.messages[TRUTH].clear()
    while not topics.messages[TRUTH]:
        time.sleep(0.01)
    pose = pose_of(topics.messages[TRUTH][-1])
    return *pose.position[:2], math.atan2(pose.rotation[1, 0], pose.rotation[0, 0])


def main():
    failed = False
    with open_camera("room", rate=RATE) as camera, Robot() as robot:
        topics = Topics({TRUTH: PoseStamped})
        for loop in LOOPS:
            total = 0
            for seed, start, lighting in starts(loop):
                bumps, way, measured, ahead = run(loop, robot, camera, topics, seed, start, lighting)
                total += bumps
                line = f"{loop} seed {seed} {lighting}, from {start}: {way:.2f} m, {bumps} bumps"
                line += f", measured {measured:.2f} m"
                if loop == "marker":
                    line += f", true {ahead:.2f} m"
                    failed |= abs(ahead - MARKER_STOP) > TOLERANCE
                print(line, flush=True)
            print(f"{loop}: {total} bumps in {STARTS} starts")
            failed |= total > 0 and loop != "scan"
    print("FAILED" if failed else "no bumps")
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
