"""RoomEnv: where its time goes, in milliseconds of processor time.

.venv/bin/python tests/benchmarks/bench_room_env.py
"""

import statistics
import time

import cv2
from bench_room import remap_of
from rich.console import Console
from rich.table import Table

from imgproc_course.simulation import Simulation
from imgproc_course.simulation.room_env import RoomEnv

BUDGETS = {("scan",): 40, ("scan", "depth"): 18, ("image",): 16, ("scan", "depth", "image"): 9}
CONSOLE = Console(width=110)


def processor_times(functions, rounds=60):
    """{name: processor milliseconds of a call}, the median; the functions take turns."""
    durations = {name: [] for name in functions}
    for _ in range(rounds):
        for name, function in functions.items():
            started = time.process_time()
            function()
            durations[name].append(1000 * (time.process_time() - started))
    return {name: statistics.median(values) for name, values in durations.items()}


def looks(env):
    """A function that drives one look on a circle of 30 cm; it begins again before the drive is over."""
    state = {"look": 0}

    def look():
        if state["look"] % 300 == 0:
            env.reset(seed=1, options={"start": (1.0, 0.0, 0.0)})
        state["look"] += 1
        env.step((0.1, 0.33))

    return look


def print_speed():
    envs = {sensors: RoomEnv(sensors) for sensors in BUDGETS}
    plain = Simulation(size=(320, 180), start=(1.0, 0.0, 0.0))
    functions = {"cv2.remap 320×180": remap_of((320, 180))}
    functions |= {"plain " + name: getattr(plain, name) for name in ("scan", "depth", "frame")}
    functions |= {", ".join(sensors): looks(env) for sensors, env in envs.items()}
    for name in ("plain scan", "plain depth", "plain frame"):
        functions[name] = after_a_step(plain, functions[name])
    for function in functions.values():
        function()
    times = processor_times(functions)
    (again,) = processor_times({"another drive": lambda: envs["scan",].reset(seed=2)}, 20).values()
    table = Table("part", "ms", "× plain depth", "simulated s per s", "budget")
    for name, milliseconds in times.items():
        sensors = tuple(name.split(", "))
        ratio = milliseconds / times["plain depth"]
        speed = f"{100 / milliseconds:.1f}" if sensors in BUDGETS else ""
        table.add_row(name, f"{milliseconds:.2f}", f"{ratio:.2f}", speed, str(BUDGETS.get(sensors, "")))
    CONSOLE.print("Processor time of a look of 0.1 s; plain: a Simulation with person, car and ball")
    CONSOLE.print(table)
    print(f"reset of a scan, in a room that is ready: {again:.1f} ms")


def after_a_step(simulation, look):
    def both():
        simulation.step(0.1, 0.33, 0.1)
        look()

    return both


def main():
    cv2.setNumThreads(1)
    print_speed()


if __name__ == "__main__":
    main()
