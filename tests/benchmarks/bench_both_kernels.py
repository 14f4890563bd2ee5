"""Run every sample answer of autograder/test_pool.py in the forked kernel and in Jupyter's own.

What each check shows, raises and gets as its verdict must be equal.

    .venv/bin/python tests/benchmarks/bench_both_kernels.py
"""

import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "autograder"))

from attacks import MASTERS, SEED
from jupyter_kernel import JupyterKernels
from nbclassroom.autograder.make_answer_key import make_key
from test_isolation import runs_of, sandbox_kernels
from test_pool import SAMPLES


def main():
    # Only one of them sees what C code prints, and Jupyter's client waits for a kernel that has ended itself.
    names = [name for name in SAMPLES if name not in ("prints beside", "ends")]
    runs = []
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        key = make_key(MASTERS, SEED, Path(folder) / "key")
        for kind in (sandbox_kernels, JupyterKernels):
            begun = time.monotonic()
            runs.append({name: runs_of(key, SAMPLES[name], kind) for name in names})
            print(f"{kind.__name__}: {len(names)} answers in {time.monotonic() - begun:.0f} s")
    differing = [name for name in names if runs[0][name] != runs[1][name]]
    print(f"equal: {len(names) - len(differing)} of {len(names)} {differing or ''}")
    raise SystemExit(1 if differing else 0)


if __name__ == "__main__":
    main()
