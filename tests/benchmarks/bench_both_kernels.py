"""Grade every sample answer of autograder/test_pool.py with the forked kernel and with Jupyter's own.

The results must be equal. Then both grade the answers of autograder/test_isolation.py, of which a check
leaves something behind. The test suite does the same with some of them: an ipykernel starts in seconds.

    .venv/bin/python tests/benchmarks/bench_both_kernels.py
"""

import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "autograder"))

from attacks import MASTERS, RIGHT, SEED
from test_isolation import OUTCOMES, outcomes_of
from test_pool import PATIENT, SAMPLES, doubles, submissions_of

from imgproc_course.classroom.autograder.make_answer_key import make_key
from imgproc_course.classroom.autograder.pool import autograde


def main():
    names = [name for name in SAMPLES if name != "prints beside"]  # only one of them sees what C code prints
    graded = {}
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        key = make_key(MASTERS, SEED, Path(folder) / "key")
        for kernel in ("fast", "ipykernel"):
            begun = time.monotonic()
            results = autograde(submissions_of({}, names), key, kernel=kernel, workers=2, limits=PATIENT)
            graded[kernel] = {result.name: doubles(result) for result in results}
            print(f"{kernel}: {len(names)} answers in {time.monotonic() - begun:.0f} s")
        left = {kernel: outcomes_of(OUTCOMES, key, RIGHT, kernel) for kernel in graded}
    differing = [name for name in names if graded["fast"][name] != graded["ipykernel"][name]]
    print(f"equal results: {len(names) - len(differing)} of {len(names)} {differing or ''}")
    unlike = [
        f"{kernel}: {name}" for kernel in left for name in OUTCOMES if left[kernel][name] != OUTCOMES[name]
    ]
    count = len(left) * len(OUTCOMES)
    print(f"neither costs nor helps another check: {count - len(unlike)} of {count} {unlike or ''}")
    raise SystemExit(1 if differing or unlike else 0)


if __name__ == "__main__":
    main()
