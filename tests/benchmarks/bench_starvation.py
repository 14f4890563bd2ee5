"""What slow answers cost: those of others nothing, and the right ones of the same submission nothing.

A right answer that uses most of its processor time is graded beside submissions that keep the machine busy,
sixty processes in all: every one must pass. In a lesson of twenty checks some answers sleep for ever: every
other answer must keep its points, and the time that this submission takes is bounded by three times a
submission's budget, plus the last case of each.

    .venv/bin/python tests/benchmarks/bench_starvation.py [--workers 4] [--asleep 4] [--asleep 20]
"""

import sys
import tempfile
import time
from pathlib import Path

import click

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "autograder"))

from attacks import LESSON, MASTERS, RIGHT, SEED
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.autograder.make_answer_key import make_key
from nbclassroom.autograder.pool import Limits, autograde

COURSE = Path(__file__).resolve().parents[2] / "notebooks" / "masters"
# As many processes as it may have, all at work until they are ended.
BUSY = """
import os
def double(pixels):
    try:
        for _ in range(60):
            if os.fork() == 0:
                os.setsid()
                break
    except OSError:
        pass
    while True:
        pass
"""
# Eight tenths of the half second that the exercise allows.
SLOW = """
import time
def double(pixels):
    begun = time.process_time()
    while time.process_time() - begun < 0.4:
        pass
    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)
"""


def slow_beside_busy(folder, workers, rounds):
    """Whether every slow right answer passes beside busy ones; prints what was measured."""
    key = make_key(MASTERS, SEED, folder / "attacked")
    submissions = []
    for number in range(rounds):
        submissions += [
            (f"busy {number}.{k}", LESSON, RIGHT | {"attacked-double": BUSY}) for k in range(workers - 1)
        ]
        submissions.append((f"slow {number}", LESSON, RIGHT | {"attacked-double": SLOW}))
    begun = time.monotonic()
    points = {result.name: result.points for result in autograde(submissions, key, workers=workers)}
    slow = [points[name] for name in points if name.startswith("slow")]
    print(
        f"slow right answers beside {(workers - 1) * Limits().processes} busy processes: {slow.count(10)} of"
        f" {len(slow)} have all points; {time.monotonic() - begun:.0f} s for {len(submissions)} submissions"
    )
    return set(slow) == {10}


def asleep(key, master, count):
    """Whether the answers that do not sleep keep their points; prints what was measured."""
    answers, left, sleepers = {}, count, set()
    for exercise in master.exercises:
        answers[exercise.id] = exercise.solution
        if left > 0 and not exercise.practice:
            answers[exercise.id] = (
                f"import time\ndef {exercise.function}(*values, **options):\n    time.sleep(1e6)"
            )
            left -= len(exercise.cases)
            sleepers.add(exercise.id)
    begun = time.monotonic()
    (result,) = autograde([("asleep", master.name, answers)], key, workers=1)
    seconds = time.monotonic() - begun
    awake = [exercise for exercise in result.exercises if exercise.id not in sleepers]
    lost = [exercise.id for exercise in awake if exercise.points != exercise.max_points]
    longest = max(
        exercise.time_limit * len(case.calls)
        for exercise in key.lessons[master.name].exercises
        for case in exercise.cases
    )
    bound = 3 * (Limits().submission + Limits().deadline(longest))
    print(
        f"endless sleep in {count} checks of {master.name}: {seconds:.0f} s (bound {bound:.0f} s); of"
        f" {len(awake)} right exercises beside it {len(lost)} lost points {lost or ''}"
    )
    return not lost and seconds < bound


@click.command()
@click.option("--workers", type=click.IntRange(2), default=4, show_default=True)
@click.option("--rounds", type=click.IntRange(1), default=2, show_default=True)
@click.option(
    "--asleep", "counts", type=click.IntRange(1), multiple=True, default=(4, 10, 20), show_default=True
)
def main(workers, rounds, counts):
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        is_right = slow_beside_busy(Path(folder), workers, rounds)
        (path,) = find_masters(COURSE, ["canny_stages"])
        key = make_key(COURSE, SEED, Path(folder) / "course", ["canny_stages"])
        for count in counts:
            is_right = asleep(key, read_master(path), count) and is_right
    raise SystemExit(0 if is_right else 1)


if __name__ == "__main__":
    main()
