"""Furnished rooms: physics against rays cast apart in 20 rooms, 1,000 seeds, marker corners, and times.

Required: no seed fails, and scan, depth, labels and free space are those of the rays. The times stand beside
those of the recorded room. `environment/test --benchmarks furnished_rooms`; ROOMS=3 SEEDS=50 is shorter.
"""

import math
import os
import sys
import time
from pathlib import Path

import cv2
import numpy as np
from rich.console import Console
from rich.table import Table
from tqdm import tqdm

from imgproc_course.geometry import Pose
from imgproc_course.simulation import Simulation, furnished, recorded_room
from imgproc_course.simulation.furnished import outwards
from imgproc_course.simulation.pieces import load_pieces
from imgproc_course.simulation.simulation import OPTICAL

sys.path.insert(0, str(Path(__file__).parents[1]))
from independent_room import compare

ROOMS, SEEDS = int(os.environ.get("ROOMS", "20")), int(os.environ.get("SEEDS", "1000"))
DISTANCE = 1.1  # metres from which markers are looked at
PARAMETERS = cv2.aruco.DetectorParameters()
PARAMETERS.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
DETECTOR = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), PARAMETERS)


def physics():
    """The differences of all rooms, and whether they are small enough."""
    found = []
    for seed in tqdm(range(ROOMS), "physics"):
        with Simulation(room=furnished(seed), sensor=False, movers=False) as simulation:
            found.append(compare(simulation, np.random.default_rng(seed)))
    return {name: np.concatenate([room[name] for room in found]) for name in found[0]}


def seeds():
    """Processor seconds of each seed's room; a RuntimeError ends the benchmark."""
    load_pieces()
    times = []
    for seed in tqdm(range(SEEDS), "seeds"):
        begin = time.process_time()
        furnished(seed)
        times.append(time.process_time() - begin)
    return np.array(times)


def corner_errors(room):
    """Largest error of a marker's corners, in pixels of 1280×720, for each marker that is found."""
    errors = {}
    with Simulation(room=room, size=(1280, 720), movers=False) as simulation:
        for name, number in room.markers.items():
            pose = Pose.from_vector(room.poses[name])
            u, v = outwards(room.poses[name])
            eye = Pose.planar(*(pose.position[:2] + DISTANCE * np.array([u, v])), math.atan2(-v, -u))
            camera = eye @ Pose(OPTICAL, np.array([0, 0, 0.20]))
            simulation.look(camera.vector)
            corners, ids, _ = DETECTOR.detectMarkers(simulation.frame())
            found = [] if ids is None else ids.ravel().tolist()
            if number in found:
                half = 0.125
                square = half * np.array([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)])
                expected = simulation.camera.project(camera.inverse().apply(pose.apply(square)))
                errors[name] = float(np.abs(expected - corners[found.index(number)][0]).max())
    return errors


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


def rows():
    """(what, result) of each measurement; asserts what is required."""
    found = physics()
    scan, depth, free = 1000 * np.abs(found["scan"]), np.abs(found["depth"]), 1000 * found["free"]
    yield f"scan, {len(scan)} rays", f"at most {scan.max():.4f} mm"
    below = f"95 % below {np.quantile(depth, 0.95):.2f} mm"
    yield f"depth, {len(depth)} pixels", f"{below}; {(depth > 20).sum()} above 20 mm (silhouettes)"
    yield f"labels, {len(found['labels'])} pixels", f"{(~found['labels']).sum()} differ"
    yield (
        f"free space, {len(free)} places",
        f"mean {free.mean():.1f} mm, {free.min():.1f} to {free.max():.1f}",
    )
    assert scan.max() < 0.02 and np.quantile(depth, 0.95) < 0.6 and np.abs(free).max() < 12
    assert (depth > 20).mean() < 0.02 and (~found["labels"]).mean() < 0.02
    drawn = seeds()
    seconds = f"{np.median(drawn):.3f} s of processor time, at most {drawn.max():.3f} s"
    yield f"rooms of {SEEDS} seeds", f"none failed; {seconds}"
    markers = [corner_errors(furnished(seed)) for seed in range(min(ROOMS, 10))]
    corners = [error for errors in markers for error in errors.values()]
    known = max(corner_errors(recorded_room()).values())
    within = f"corners within {max(corners):.2f} pixels (recorded room: {known:.2f})"
    yield f"markers from {DISTANCE} m", f"{len(corners)} of {2 * len(markers)} found, {within}"
    (first, further), (known_first, known_further) = times(furnished(10**6)), times(recorded_room())
    yield "first image", f"{first:.2f} s, recorded room {known_first:.2f} s: {first / known_first:.1f} ×"
    both = f"{1000 * further:.1f} ms, recorded room {1000 * known_further:.1f} ms"
    yield "each further image, 640×360", f"{both}: {further / known_further:.2f} ×"


def main():
    table = Table("what", "result")
    for row in rows():
        table.add_row(*row)
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
