"""Furnished rooms: how long one takes to be placed, and its images, beside those of the recorded room.

Required: no seed fails. `environment/test --benchmarks furnished_rooms`; SEEDS=50 is shorter.
"""

import os
import time

import numpy as np
from rich.console import Console
from rich.table import Table
from tqdm import tqdm

from imgproc_course.simulation import Simulation, furnished, recorded_room
from imgproc_course.simulation.pieces import load_pieces

SEEDS = int(os.environ.get("SEEDS", "1000"))


def seeds():
    """Processor seconds of each seed's room; a RuntimeError ends the benchmark."""
    load_pieces()
    times = []
    for seed in tqdm(range(SEEDS), "seeds"):
        begin = time.process_time()
        furnished(seed)
        times.append(time.process_time() - begin)
    return np.array(times)


def times(room):
    """Processor seconds: to the first image, and for each further one."""
    begin = time.process_time()
    with Simulation(room=room) as simulation:
        simulation.frame()
        first = time.process_time() - begin
        begin = time.process_time()
        for _ in range(60):
            simulation.step(0.1, 0.3, 0.1)
            simulation.frame()
        return first, (time.process_time() - begin) / 60


def main():
    drawn = seeds()
    (first, further), (known_first, known_further) = times(furnished(10**6)), times(recorded_room())
    table = Table("what", "processor time", "recorded room", "ratio")
    table.add_row(f"a room, {SEEDS} seeds", f"{np.median(drawn):.3f} s, at most {drawn.max():.3f} s")
    table.add_row("first image", f"{first:.2f} s", f"{known_first:.2f} s", f"{first / known_first:.1f}")
    milliseconds = [f"{1000 * value:.1f} ms" for value in (further, known_further)]
    table.add_row("each further image, 640×360", *milliseconds, f"{further / known_further:.2f}")
    Console(width=110).print(table)


if __name__ == "__main__":
    main()
