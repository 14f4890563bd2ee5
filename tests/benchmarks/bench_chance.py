"""Does a test fail by chance? `environment/test` on a quiet machine, and beside two busy processes.

Each run's time, and every failure. It takes five times ten minutes, twice.

    .venv/bin/python tests/benchmarks/bench_chance.py [--runs 5]
"""

import contextlib
import re
import subprocess
import sys
import time
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parents[2]
BUSY = [sys.executable, "-c", "while True: pass"]
FAILURE = re.compile(r"^(?:FAILED|ERROR) (\S+)", re.MULTILINE)


@contextlib.contextmanager
def busy_processes(count):
    processes = [subprocess.Popen(BUSY) for _ in range(count)]
    try:
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()


def run_tests():
    """(minutes, failed tests) of one run."""
    began = time.monotonic()
    command = [str(ROOT / "environment" / "test")]
    process = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    failed = sorted(set(FAILURE.findall(process.stdout)))
    if process.returncode and not failed:
        failed = [f"exit {process.returncode}: {process.stdout[-500:]}{process.stderr[-500:]}"]
    return (time.monotonic() - began) / 60, failed


@click.command()
@click.option("--runs", default=5, help="Runs of each kind.")
def main(runs):
    table, failures = Table("run", "beside", "minutes", "failed"), 0
    for count in (0, 2):
        for run in range(1, runs + 1):
            with busy_processes(count):
                minutes, failed = run_tests()
            failures += len(failed)
            table.add_row(str(run), f"{count} busy processes", f"{minutes:.1f}", "\n".join(failed) or "–")
            print(f"{run} beside {count}: {minutes:.1f} minutes, {len(failed)} failed", flush=True)
    Console(width=110).print(table)
    raise SystemExit(failures > 0)


if __name__ == "__main__":
    main()
