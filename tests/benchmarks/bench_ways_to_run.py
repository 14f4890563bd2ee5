"""Every lesson, run in every way in which a learner runs it: no traceback that its text does not announce.

.venv/bin/python tests/benchmarks/bench_ways_to_run.py [--lesson NAME ...] [--way WAY ...]
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

import nbformat

sys.path.append(str(Path(__file__).parents[1] / "notebooks"))
from nbclassroom.authoring.lesson_names import lesson_name
from nbclassroom.authoring.masters import find_lessons
from nbclassroom.lab.working_copies import update_lessons
from ways_to_run import CHANGES, tracebacks

ROOT = Path(__file__).parents[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lesson", nargs="+", default=[], metavar="NAME", help="of all lessons if omitted")
    parser.add_argument("--way", nargs="+", default=list(CHANGES), help=f"of {', '.join(CHANGES)}; or a+b")
    parser.add_argument("--notebooks", default=ROOT / "notebooks", help="the folder of the lessons")
    options = parser.parse_args()
    count = 0
    with tempfile.TemporaryDirectory(prefix="ways-") as folder:
        update_lessons(options.notebooks, folder)
        for path in find_lessons(folder, options.lesson):
            for way in options.way:
                start = time.monotonic()
                found = tracebacks(nbformat.read(path, as_version=4), way, folder)
                count += len(found)
                seconds = time.monotonic() - start
                print(
                    f"{lesson_name(path.stem):26}{way:12}{len(found) or 'none':>5}{seconds:7.0f} s",
                    flush=True,
                )
                for cell, text in found:
                    print(f"    {cell}: {text[:400]}", flush=True)
    print(f"unannounced tracebacks: {count}")
    return count > 0


if __name__ == "__main__":
    sys.exit(main())
