"""Is the robot ever held for good? It chases what moves, and corners, for a minute each, in ten rooms.

The hand trembles: steps of 0.1 s, 0.3 m/s if the target is within 0.6 rad, turning at 3 × the angle, plus up
to ± 1 rad/s at random. Afterwards back, left, right and forward are tried for 3 s each, twice: one of them
has to move the robot by 5 cm. `environment/test --benchmarks chases` runs it.
"""

import argparse
import functools
import math
from multiprocessing import Pool

import numpy as np

from imgproc_course.simulation import Simulation, furnished, recorded_room
from imgproc_course.simulation.scene import Scene

TARGETS = ("ball", "toycar", "corner")
ROOMS = (None, *range(31, 40))  # the recorded room, and nine furnished ones
COMMANDS = ((-0.3, 0.0), (0.0, 1.0), (0.0, -1.0), (0.3, 0.0))


@functools.cache
def scene_of(number):
    return Scene(recorded_room() if number is None else furnished(number))


def free_simulation(random, room):
    while True:
        start = (random.uniform(0, 5), random.uniform(-2, 2), random.uniform(-math.pi, math.pi))
        try:
            return Simulation(1, room=scene_of(room), start=start, sensor=False)
        except ValueError:
            continue


def place(simulation):
    x, y, _, _, _, qz, qw = simulation.pose("robot")
    return x, y, 2 * math.atan2(qz, qw)


def is_held(simulation):
    x, y, yaw = place(simulation)
    for linear, angular in COMMANDS * 2:
        for _ in range(30):
            simulation.step(linear, angular, 0.1)
            new_x, new_y, new_yaw = place(simulation)
            turned = abs(math.remainder(new_yaw - yaw, 2 * math.pi))
            if math.hypot(new_x - x, new_y - y) > 0.05 or turned > 0.1:
                return False
    return True


def chase(job):
    number, target = job
    random = np.random.default_rng([number, 5])
    simulation = free_simulation(random, ROOMS[number % len(ROOMS)])
    corner = random.choice([0, 5]), random.choice([-2, 2])
    for _ in range(600):
        x, y, yaw = place(simulation)
        to_x, to_y = corner if target == "corner" else simulation.pose(target)[:2]
        angle = math.remainder(math.atan2(to_y - y, to_x - x) - yaw, 2 * math.pi)
        simulation.step(0.3 if abs(angle) < 0.6 else 0.0, 3 * angle + random.uniform(-1, 1), 0.1)
    return *job, is_held(simulation), np.round(place(simulation), 2).tolist()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--starts", type=int, default=200, help="of each target, in ten rooms in turn")
    starts = parser.parse_args().starts
    with Pool(2) as pool:
        ends = pool.map(chase, [(n, target) for target in TARGETS for n in range(starts)], chunksize=10)
    for target in TARGETS:
        held = [end for end in ends if end[1] == target and end[2]]
        print(f"{target:8} {starts} chases, held at the end: {len(held)}", *held)
    raise SystemExit(any(end[2] for end in ends))


if __name__ == "__main__":
    main()
