"""What grading a class costs whose exercise is a drive.

A class hands in one exercise with a public and four hidden scenarios of 40 s, with scan and depth: right
answers, slow ones, ones that raise, in turn.

    .venv/bin/python tests/benchmarks/bench_driving.py [--learners 30]

Budgets: 15 s of processor time for a submission, and so 8 minutes for 30 on two cores; 5 minutes of processor
time for the key. The exit code is 1 otherwise.
"""

import resource
import sys
import tempfile
import time
from pathlib import Path

import click
from nbclassroom.authoring.masters import read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import autograde

MOST_CPU, MOST_KEY, MOST_MINUTES, CORES = 15.0, 300.0, 8.0, 2
MASTER = Path(__file__).resolve().parent / "driving/masters/10_long_drives.py"
ANSWERS = (
    None,  # the solution
    "def control(observation, memory):\n    return 0.05, 0.3",
    "def control(observation, memory):\n    return 1 / (30 - observation['time']), 0.5",
)


def cpu_seconds():
    """Processor seconds of this process and of all its children that have ended."""
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def measured(work):
    """(what it returns, processor seconds, wall seconds) of a piece of work."""
    cpu, began = cpu_seconds(), time.monotonic()
    return work(), cpu_seconds() - cpu, time.monotonic() - began


def class_problems(learners):
    """Prints what a key and a class of so many learners cost; what is too slow."""
    (exercise,) = read_master(MASTER).exercises
    with tempfile.TemporaryDirectory() as folder:
        key, cpu, wall = measured(lambda: make_key(MASTER.parent, 8_675_309, Path(folder) / "key"))
        print(f"key: {cpu:.0f} s of processor time, {wall:.0f} s")
        if cpu > MOST_KEY:
            yield "the key is slow"
        submissions = [
            (f"{n}", "long_drives", {exercise.id: f"# {n}\n{ANSWERS[n % 3] or exercise.solution}"})
            for n in range(learners)
        ]
        results, cpu, wall = measured(lambda: list(autograde(submissions, key, workers=CORES)))
    for result in results[:3]:
        exercise = result.exercises[0]
        print(f"  {result.points} of {exercise.max_points}: {exercise.cases[0].message}")
    minutes = 30 * cpu / learners / CORES / 60
    print(
        f"{learners} submissions: {cpu / learners:.1f} s of processor time each, {wall:.0f} s in all;", end=""
    )
    print(f" a class of 30 takes {minutes:.1f} minutes of {CORES} cores")
    if cpu / learners > MOST_CPU or minutes > MOST_MINUTES:
        yield "grading is slow"


@click.command()
@click.option("--learners", type=click.IntRange(1), default=30, show_default=True)
def main(learners):
    problems = list(class_problems(learners))
    print(f"not as it should be: {', '.join(problems)}" if problems else "all as it should be")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
