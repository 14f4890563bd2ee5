"""The league: what it costs to let a class's controllers drive.

Five controllers in ten rooms, 60 s each: the processor time of a drive, of the robot's process and of the
sandbox together, against the same drive alone in one process, without a sandbox.

    .venv/bin/python tests/benchmarks/bench_league.py [--rooms 10] [--controllers 5]

Budget: at most twice the time of the drive alone. The exit code is 1 otherwise.
"""

import sys
import time

import click
from nbclassroom.autograder.sandbox.kernel_factory import KernelFactory
from nbclassroom.exercises.kinds.drive.draw_scenarios import drive_here
from nbclassroom.exercises.kinds.drive.drive import SENSORS
from nbclassroom.league import explorations
from nbclassroom.league.league import scenarios_of

MOST_RATIO, CLASS, CORES = 2.0, 31, 2  # 30 learners and the baseline
SEED = "8f1c0b5e7a3d92464be0917cd5f2a863"
# Each turns for another time where something is near.
SOURCE = """
def control(observation, memory):
    scan = observation["scan"]
    ahead = min(scan[:25].min(), scan[-25:].min())
    memory["turns"] = {number} if ahead < 0.6 else memory.get("turns", 0) - 1
    return (0.0, 0.8) if memory["turns"] > 0 else (0.25, 0.0)
"""


def in_league(factory, source, scenario):
    """(processor seconds of this process, of the sandbox, the Exploration) of a drive of the league."""
    began = time.process_time()
    exploration = explorations.explore(source, scenario)
    # Counted since the kernel began.
    return time.process_time() - began, factory._group.cpu_seconds() or 0.0, exploration


def alone(source, scenario):
    """Processor seconds of the same drive in this process, without a sandbox."""
    namespace, began = {}, time.process_time()
    exec(source, namespace)
    record, _ = drive_here(namespace["control"], SENSORS, scenario)
    return time.process_time() - began, record


@click.command()
@click.option("--rooms", default=10, show_default=True)
@click.option("--controllers", default=5, show_default=True)
def main(rooms, controllers):
    robot = sandbox = own = 0.0
    with KernelFactory() as factory:
        explorations._factories.append(factory)
        for scenario in scenarios_of(SEED, rooms):
            for number in range(controllers):
                source = SOURCE.format(number=5 + 4 * number)
                seconds, others, exploration = in_league(factory, source, scenario)
                seconds_alone, record = alone(source, scenario)
                assert record["path"] == exploration.record["path"]
                robot, sandbox, own = robot + seconds, sandbox + others, own + seconds_alone
    count = rooms * controllers
    ratio, minutes = (robot + sandbox) / own, CLASS * 10 * (robot + sandbox) / count / CORES / 60
    print(f"{count} drives: {robot / count:.1f} s of processor time for the robot", end="")
    print(
        f" and {sandbox / count:.1f} s in the sandbox; alone {own / count:.1f} s: {ratio:.2f} times as much"
    )
    print(f"a class of 30 and the baseline in 10 rooms: {minutes:.0f} minutes of {CORES} cores")
    sys.exit(0 if ratio <= MOST_RATIO else 1)


if __name__ == "__main__":
    main()
