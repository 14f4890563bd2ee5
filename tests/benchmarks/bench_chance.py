"""Does a test fail by chance? `environment/test` on a quiet machine, and beside two busy processes.

.venv/bin/python tests/benchmarks/bench_chance.py [RUNS]
"""

import re
import subprocess
import sys
import time
from pathlib import Path

COMMAND = Path(__file__).parents[2] / "environment" / "test"
runs, failures = int([*sys.argv, "5"][1]), 0
for beside in (0, 2):
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(beside)]
    for run in range(1, runs + 1):
        begin = time.monotonic()
        done = subprocess.run(
            [COMMAND], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False
        )
        failed = re.findall(r"^(?:FAILED|ERROR) \S+", done.stdout, re.MULTILINE) or [done.stderr[-500:]]
        text = "; ".join(failed) if done.returncode else "nothing failed"
        print(f"run {run} beside {beside}: {(time.monotonic() - begin) / 60:.1f} minutes, {text}", flush=True)
        failures += done.returncode != 0
    for process in busy:
        process.kill()
raise SystemExit(failures > 0)
