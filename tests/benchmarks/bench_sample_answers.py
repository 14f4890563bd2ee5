"""Every stub, solution and known mistake of every master, graded: none gets wrong points or a wrong name.

    .venv/bin/python tests/benchmarks/bench_sample_answers.py

The exit code is 1 if one does.
"""

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "autograder"))

from sample_answers import FOLDERS, fault_of, grade_samples, samples, title_of


def main():
    start, answers = time.monotonic(), samples(FOLDERS)
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        results = grade_samples(answers, Path(folder))
    faults = {}
    for sample in answers:
        if fault := fault_of(sample[1], sample[2], results[title_of(*sample)]):
            faults[title_of(*sample)] = fault
    for title, fault in faults.items():
        print(f"BROKEN {title}: {fault}")
    for lesson, count in sorted(Counter(path.stem for path, _, _ in answers).items()):
        print(f"{lesson:30} {count:4} answers")
    print(f"{len(answers)} answers graded in {time.monotonic() - start:.0f} s; faults: {len(faults)}")
    raise SystemExit(1 if faults else 0)


if __name__ == "__main__":
    main()
