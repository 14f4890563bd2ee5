"""A class on one machine: three learners receive images at once, each in a graph of their own.

Prints the memory of each. Their peer is one learner alone in the same run: images received in 20 s.

Usage: environment/test --benchmarks class
"""

import json
import sys
import tempfile
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil

sys.path.insert(0, str(Path(__file__).parents[1]))
from class_machine import RECEIVE, Class, Learner, wait_for

SECONDS = 20


def receive(learner):
    return json.loads(learner.run(RECEIVE.format(seconds=SECONDS)))


def memory_of(hub):
    """Megabytes that each learner's processes hold alone or share (PSS), by kind of process."""
    rows = {}
    for process in hub.processes():
        try:
            command = " ".join(process.cmdline())
            kinds = ("singleuser", "server"), ("ipykernel", "kernel"), ("imgproc_course", "camera")
            kind = next((kind for word, kind in kinds if word in command), "other")
            row = rows.setdefault(Path(process.environ()["HOME"]).name, Counter())
            row[kind] += process.memory_full_info().pss / 2**20
        except psutil.Error:
            continue
    return rows


def main():
    with tempfile.TemporaryDirectory() as folder, Class(folder, ["ada", "bob", "cem"]) as hub:
        learners = [Learner(hub, name) for name in ("ada", "bob", "cem")]
        started = time.monotonic()
        for learner in learners:
            learner.start()
        for learner in learners:
            learner.wait_until_ready()
        print(f"three servers ready after {time.monotonic() - started:.0f} s")
        alone = receive(learners[0])
        print(f"one learner alone: {alone['received']} images in {SECONDS} s, {alone['dropped']} dropped")

        rows = {}
        timer = threading.Timer(SECONDS, lambda: rows.update(memory_of(hub)))
        timer.start()
        with ThreadPoolExecutor() as pool:
            results = list(pool.map(receive, learners))
        timer.join()
        for learner, result in zip(learners, results, strict=True):
            print(
                f"{learner.name}: domain {result['domain']}, {result['received']} images, "
                f"{result['received'] / alone['received']:.2f} times as many as alone, "
                f"{result['dropped']} dropped, {result['publishers']} publisher"
            )
        for name, row in sorted(rows.items()):
            parts = ", ".join(f"{kind} {size:.0f}" for kind, size in sorted(row.items()))
            print(f"memory of {name}: {sum(row.values()):.0f} MB ({parts})")
        assert len({result["domain"] for result in results}) == 3
        assert {result["publishers"] for result in results} == {1}
        assert not any(result["dropped"] for result in results)
    wait_for(lambda: not hub.processes(), hub, seconds=60)
    print("after the end of the hub no process of a learner is left")


if __name__ == "__main__":
    main()
