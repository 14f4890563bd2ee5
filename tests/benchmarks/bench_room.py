"""The room on one core: images and depth per second, its start and memory, RoomEnv's looks, furnished rooms.

python tests/benchmarks/bench_room.py     prints; the peer, timed in turns, is cv2.remap of the same image

No seed of a furnished room may fail; SEEDS=50 in the environment places fewer of them.
"""

import itertools
import os
import subprocess
import sys
import time

import cv2
import numpy as np
from side_by_side import print_ratios, time_in_turns

from imgproc_course.simulation import Simulation, furnished
from imgproc_course.simulation.room_env import RoomEnv

# Simulated seconds per second that RoomEnv should have at least, by its sensors.
LEAST_SPEEDS = {("scan",): 40, ("scan", "depth"): 18, ("image",): 16, ("scan", "depth", "image"): 9}
SEEDS = int(os.environ.get("SEEDS", "1000"))
START = """
import time
started = time.perf_counter()
import psutil
from imgproc_course.simulation import Simulation
with Simulation() as room:
    room.frame(), room.depth()
    seconds = time.perf_counter() - started
    room.step(0.1, 0.0, 0.1)
    room.frame()  # with the second image, panda3d frees the textures that it has copied
    print(seconds, psutil.Process().memory_info().rss / 2**20)
"""


def remap_of(size):
    """A function without arguments: an image of this size through a lens, as cv2 does it."""
    width, height = size
    image = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
    col, row = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    maps = cv2.convertMaps(col * 0.98 + 3.3, row * 0.98 + 2.7, cv2.CV_16SC2)
    return lambda: cv2.remap(image, *maps, cv2.INTER_LINEAR)


def driving(room, *looks):
    """A step of the robot on a circle of 30 cm, then everything that `looks` names."""

    def turn():
        room.step(0.1, 0.33, 1 / 30)
        for name in looks:
            getattr(room, name)()

    return turn


def looks(env):
    """A function that drives one look of 0.1 s on a circle of 30 cm; a new drive begins in time."""
    numbers = itertools.count()

    def look():
        if next(numbers) % 300 == 0:
            env.reset(seed=1, options={"start": (1.0, 0.0, 0.0)})
        env.step((0.1, 0.33))

    return look


def print_looks():
    names = {sensors: ", ".join(sensors) for sensors in LEAST_SPEEDS}
    functions = {name: looks(RoomEnv(sensors)) for sensors, name in names.items()}
    medians = time_in_turns({"cv2.remap": remap_of((320, 180)), **functions}, rounds=60)
    print_ratios("RoomEnv, a look of 0.1 s", medians, "cv2.remap")
    for sensors, least in LEAST_SPEEDS.items():
        print(f"  {names[sensors]}: {0.1 / medians[names[sensors]]:.0f} simulated s per s, of {least}")


def print_furnished():
    furnished(SEEDS)  # loads the pieces
    seconds = []
    for seed in range(SEEDS):
        begin = time.process_time()
        furnished(seed)
        seconds.append(time.process_time() - begin)
    print(f"a furnished room, {SEEDS} seeds: {np.median(seconds):.2f} s, at most {max(seconds):.2f} s")
    begin = time.process_time()
    with Simulation(room=furnished(10**6)) as room:
        room.frame()
        print(f"its first image: {time.process_time() - begin:.2f} s")


def main():
    cv2.setNumThreads(1)
    large, small = (1280, 720), (640, 360)
    with (
        Simulation(size=large, lens=False, sensor=False) as plain,
        Simulation(size=large) as full,
        Simulation(size=small) as half,
    ):
        rows = {
            "1280×720": (large, {"plain colour": driving(plain, "frame"), "colour": driving(full, "frame")}),
            "640×360": (
                small,
                {
                    "colour": driving(half, "frame"),
                    "colour, depth, labels": driving(half, "frame", "depth", "labels"),
                    "scan": driving(half, "scan"),
                },
            ),
        }
        for title, (size, functions) in rows.items():
            medians = time_in_turns({"cv2.remap": remap_of(size), **functions}, rounds=60)
            print_ratios(f"room, {title}; plain: without lens and sensor", medians, "cv2.remap")
            for name in functions:
                print(f"  {name}: {1 / medians[name]:.1f} frames/s")
    command = [sys.executable, "-c", START]
    runs = [subprocess.run(command, capture_output=True, text=True, check=True) for _ in range(5)]
    seconds, megabytes = np.median([[float(v) for v in run.stdout.split()] for run in runs], 0)
    print(f"import, start, first image and depth: {seconds:.2f} s, {megabytes:.0f} MiB (median of 5)")
    print_looks()
    print_furnished()


if __name__ == "__main__":
    main()
