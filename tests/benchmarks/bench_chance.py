"""Does a test fail by chance? `environment/test`, five times alone and beside two busy processes."""

import re
import subprocess
import sys
import time
from pathlib import Path

COMMAND = Path(__file__).parents[2] / "environment" / "test"
runs = int([*sys.argv, "5"][1])
for beside in (0, 2):
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(beside)]
    for run in range(1, runs + 1):
        begin = time.monotonic()
        done = subprocess.run([COMMAND], capture_output=True, text=True, check=False)
        failed = re.findall(r"^(?:FAILED|ERROR) \S+", done.stdout, re.MULTILINE)
        minutes = (time.monotonic() - begin) / 60
        print(f"run {run} beside {beside}: {minutes:.1f} minutes", *failed, done.stderr[-500:], flush=True)
    for process in busy:
        process.kill()
