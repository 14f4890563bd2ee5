"""The ten commands of docs/teach/walk.md on a term, each lesson graded, and all known mistakes that drive.

.venv/bin/python tests/benchmarks/bench_term.py
"""

import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
TESTS = ("tests/classroom/gradebook/test_teach.py", "tests/notebooks/test_lessons.py")


def main():
    began = time.monotonic()
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *TESTS, "-k", "teach or valid"]
    code = subprocess.run(command, cwd=ROOT, env=os.environ | {"WHOLE_TERM": "1"}, check=False).returncode
    print(f"key, 30 submissions graded twice, 3 of all lessons: {time.monotonic() - began:.0f} s")
    return code


if __name__ == "__main__":
    sys.exit(main())
