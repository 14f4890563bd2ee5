"""RoomEnv: where its time goes, and how controllers do in scenarios that nobody has seen.

python tests/benchmarks/bench_room_env.py                       milliseconds of processor time, by part
python tests/benchmarks/bench_room_env.py --controllers [-n 20] [--seed 1] [--lesson NAME] [--only NAME]
                                                                solution, stub, known mistakes and a replay
"""

import argparse
import statistics
import time
from pathlib import Path

import cv2
from bench_room import remap_of
from nbclassroom.exercises.declaration import read_exercises
from rich.console import Console
from rich.table import Table

from imgproc_course.simulation import Simulation
from imgproc_course.simulation.room_env import OPTIONS, RoomEnv, controller_observation

MASTERS = Path(__file__).parents[2] / "notebooks/masters"
LESSONS = ("obstacles_ahead", "object_tracking", "the_errand", "unknown_rooms")  # with a drive
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


def drive(env, control, scenario):
    """The metrics of a drive, and whether it keeps the thresholds."""
    options = {name: scenario[name] for name in OPTIONS if name in scenario}
    observation, info = env.reset(seed=scenario["seed"], options=options)
    memory, over = {}, False
    while not over:
        observation, _, _, over, info = env.step(control(controller_observation(observation), memory))
    signs = {"<=": lambda value, limit: value <= limit, ">=": lambda value, limit: value >= limit}
    return info, all(
        info[name] is not None and signs[sign](info[name], limit)
        for name, (sign, limit) in scenario["thresholds"].items()
    )


def replay_of(env, control, scenario):
    """A controller that repeats what another one did in a scenario, and then stands."""
    actions = []

    def recorded(observation, memory):
        actions.append(control(observation, memory))
        return actions[-1]

    def replay(_, memory):
        memory["look"] = memory.get("look", -1) + 1
        return (actions + [(0.0, 0.0)] * memory["look"])[memory["look"]]

    drive(env, recorded, scenario)
    return replay


def print_controllers(lesson, seed, count, only):
    (exercise,) = (e for e in read_exercises(next(MASTERS.glob(f"*_{lesson}.py"))) if e.subject == "drive")
    case = exercise.hidden[0]
    scenarios = [exercise.arguments(case, 1000 * seed + k)[0][0] for k in range(count)]
    answers = {"solution": exercise.solution, "stub": exercise.stub}
    answers |= {mistake.name: mistake.source for mistake in exercise.mistakes}
    functions = {name: exercise.function_of(answers[name], name, prepared=True) for name in answers}
    thresholds = scenarios[0]["thresholds"]
    limits = ", ".join(f"{name} {sign} {limit}" for name, (sign, limit) in thresholds.items())
    print(
        f"{exercise.id}: {count} scenarios of seed {seed}, {scenarios[0]['duration']} s; {limits}", flush=True
    )
    env = RoomEnv(exercise.sensors)
    public_scenario = exercise.arguments(exercise.cases[0])[0][0]
    functions["replay"] = replay_of(env, functions["solution"], public_scenario)
    for name, control in functions.items():
        if only and name not in only:
            continue
        started = time.process_time()
        drives = [drive(env, control, scenario) for scenario in scenarios]
        seconds = (time.process_time() - started) / count
        print(f"{name}: passes {sum(kept for _, kept in drives)} of {count}, {seconds:.1f} s each")
        for metric in thresholds:
            values = sorted(-1.0 if info[metric] is None else info[metric] for info, _ in drives)
            print(f"  {metric}: {' '.join(f'{value:.2f}' for value in values)}", flush=True)


def main():
    cv2.setNumThreads(1)
    parser = argparse.ArgumentParser()
    parser.add_argument("--controllers", action="store_true")
    parser.add_argument("--lesson", choices=LESSONS, default=LESSONS[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-n", type=int, default=20)
    parser.add_argument("--only", action="append")
    arguments = parser.parse_args()
    if arguments.controllers:
        print_controllers(arguments.lesson, arguments.seed, arguments.n, arguments.only)
    else:
        print_speed()


if __name__ == "__main__":
    main()
