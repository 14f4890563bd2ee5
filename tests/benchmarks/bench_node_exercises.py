"""What a check of a node costs: in the notebook, and in the sandbox that grades.

    .venv/bin/python tests/benchmarks/bench_node_exercises.py

Budgets: 0.1 s of wall time for a check in the notebook, 0.5 s of processor time for a submission in the
sandbox. The exit code is 1 if one is exceeded.
"""

import statistics
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from node_answers import ORIGINAL

from imgproc_course.classroom.autograder.make_answer_key import _check_source
from imgproc_course.classroom.autograder.sandbox.kernel_factory import KernelFactory
from imgproc_course.classroom.exercises.checking import run_check
from imgproc_course.classroom.exercises.declaration import read_exercises
from imgproc_course.classroom.exercises.expected_results import check_data_of
from imgproc_course.classroom.exercises.input_encoding import encode

MASTER = Path(__file__).resolve().parents[2] / "notebooks/masters/05_grayscale_node.py"
ROUNDS = 20
MOST_WALL, MOST_CPU = 0.1, 0.5  # seconds
CPU_CELL = "import time\n\nprint(time.process_time())"


def notebook_seconds(exercise):
    """Wall seconds of each check of a right answer, where the lesson runs it."""
    data = check_data_of(exercise)
    names, _ = data.run_answer(ORIGINAL, exercise.function)
    seconds = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        assert run_check(data, names[exercise.function]).passed
        seconds.append(time.perf_counter() - start)
    return seconds


def sandbox_seconds(exercise):
    """Processor seconds of each kernel that graded all cases of a right answer."""
    inputs = [[encode(call) for call in exercise.arguments(case)] for case in exercise.cases]
    seconds = []
    with KernelFactory() as factory:
        for _ in range(ROUNDS):
            kernel = factory.start(exercise.allowed, 5 * exercise.time_limit)
            kernel.run(ORIGINAL)
            runs = [kernel.run_check(_check_source(exercise), calls, exercise.time_limit) for calls in inputs]
            assert all(run.answers for run in runs)
            seconds.append(float(kernel.run(CPU_CELL).printed))
            kernel.stop()
    return seconds


def main():
    exercise = next(declared for declared in read_exercises(MASTER) if declared.id == "node-class")
    measured = (
        ("check in the notebook, wall", notebook_seconds(exercise), MOST_WALL),
        ("all cases in the sandbox, processor", sandbox_seconds(exercise), MOST_CPU),
    )
    for name, seconds, most in measured:
        middle, worst = statistics.median(seconds), max(seconds)
        print(
            f"{name}: median {1000 * middle:.0f} ms, worst {1000 * worst:.0f} ms; budget {1000 * most:.0f} ms"
        )
    raise SystemExit(any(statistics.median(seconds) > most for _, seconds, most in measured))


if __name__ == "__main__":
    main()
