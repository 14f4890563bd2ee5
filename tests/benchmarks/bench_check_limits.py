"""What `check` costs over a wrong answer itself: seconds, and megabytes at the peak, of each monster.

Each runs in two processes of its own: one calls the answer as often as `check` does, the other checks it and
shows the result. The memory is that of the process and of those that it starts, pages that they share once.

    .venv/bin/python tests/benchmarks/bench_check_limits.py [--monster NAME]
"""

import json
import subprocess
import sys
import threading
from pathlib import Path

import click
import psutil
from rich.console import Console
from rich.table import Table

EXERCISES = Path(__file__).parents[1] / "classroom" / "exercises"
CHILD = """
import json, linecache, sys, time
sys.path.insert(0, {folder!r})
import numpy as np
from monsters import MONSTERS
from nbclassroom.exercises import check
from nbclassroom.exercises.check_files import find_check_file
from nbclassroom.exercises.running import call_within
source = MONSTERS[{name!r}]
linecache.cache["<answer>"] = (len(source), None, source.splitlines(keepends=True), "<answer>")
names = {{"np": np, "frame": np.zeros((720, 1280, 3), np.uint8)}}
exec(compile(source, "<answer>", "exec"), names)
exercise = find_check_file("grayscale-luma").exercise("grayscale-luma")
print("ready", flush=True)
sys.stdin.readline()
began = time.perf_counter()
if {checks}:
    result = check("grayscale-luma", names["luma"])
    text = repr(result)
    result._repr_html_()
else:
    text = ""
    for case in exercise.cases:
        for call in case.calls:
            try:
                call_within(lambda: names["luma"](*call.arguments), exercise.time_limit)
            except BaseException:
                pass
print(json.dumps([time.perf_counter() - began, text[:300]]))
"""


def peak_of(process, is_over):
    """The most megabytes of a process with all that it starts, until it is over."""
    peak = 0
    while not is_over.wait(0.02):
        total = 0
        for one in [process, *process.children(recursive=True)]:
            try:
                total += one.memory_full_info().pss
            except psutil.Error:
                continue
        peak = max(peak, total)
    return peak / 1e6


def measure(name, checks):
    """(seconds, megabytes over the beginning, the text of the check) of a monster."""
    code = CHILD.format(folder=str(EXERCISES), name=name, checks=checks)
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, "text": True}
    with subprocess.Popen([sys.executable, "-c", code], **pipes) as process:
        process.stdout.readline()
        is_over, watched, peaks = threading.Event(), psutil.Process(process.pid), []
        before = watched.memory_full_info().pss / 1e6
        thread = threading.Thread(target=lambda: peaks.append(peak_of(watched, is_over)))
        thread.start()
        process.stdin.write("\n")
        process.stdin.flush()
        line = process.stdout.readline()
        is_over.set()
        thread.join()
    seconds, text = json.loads(line) if line else (float("nan"), "the process ended")
    return seconds, peaks[0] - before, text


@click.command()
@click.option("--monster", "chosen", multiple=True, help="Only this one (may be repeated).")
def main(chosen):
    sys.path.insert(0, str(EXERCISES))
    from monsters import MONSTERS

    table = Table("monster", "answer s", "check s", "more s", "answer MB", "check MB", "more MB")
    for name in chosen or MONSTERS:
        answer, check = measure(name, False), measure(name, True)
        pairs = [(answer[k], check[k], check[k] - answer[k]) for k in (0, 1)]
        numbers = [f"{value:.{1 - k}f}" for k, pair in enumerate(pairs) for value in pair]
        table.add_row(name, *numbers)
    Console(width=110).print(table)


if __name__ == "__main__":
    main()
