"""kill -9 of each kind of process of a run, ten times at random moments: grades.json stays byte-identical.

For each kind a run is started, and started again when it ends, until ten processes of the kind were killed;
then it may finish. Afterwards nothing of it may be left. The exit code is 1 if grades.json differs from the
one of a calm run, or if anything is left ten seconds after the end.

    .venv/bin/python tests/benchmarks/bench_kills.py [--times 10] [--submissions 40]
"""

import random
import shutil
import sys
import tempfile
from pathlib import Path

import click

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "gradebook"))

from kills import COMMAND, KINDS, Run, run_with_kills, write_submissions
from submissions import MASTERS, SEED

from imgproc_course.authoring.masters import read_master
from imgproc_course.autograder.make_answer_key import make_key

PAUSE = (1.0, 5.0)  # seconds between two kills: a worker needs one or two to start


@click.command()
@click.option("--times", type=click.IntRange(1), default=10, show_default=True, help="Kills of each kind.")
@click.option("--submissions", "count", type=click.IntRange(2), default=40, show_default=True)
@click.option("--seed", type=int, default=1, show_default=True, help="Of the moments.")
def main(times, count, seed):
    rng, is_right = random.Random(seed), True
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        folder = Path(folder)
        make_key(MASTERS, SEED, folder / "key")
        write_submissions(folder / "submissions", read_master(MASTERS / "20_light.py"), count)
        calm = Run(folder / "submissions", folder / "key", folder / "calm")
        calm.start()
        calm.finish()
        shutil.rmtree(calm.temporary)
        expected = (folder / "calm" / "grades.json").read_bytes()
        for kind in KINDS:
            # A killed command continues where it stopped; the others grade everything again.
            options = () if kind == COMMAND else ("--fresh",)
            run = Run(folder / "submissions", folder / "key", folder / "killed", *options)
            code, printed = run_with_kills(run, kind, times, PAUSE, rng)
            is_same = (folder / "killed" / "grades.json").read_bytes() == expected
            left = run.survivors(10) + [str(path) for path in run.temporary.iterdir()]
            ending = "byte-identical" if is_same else f"DIFFERS\n{printed}"
            print(
                f"{kind}: killed {times} times; exit code {code}; grades.json {ending}; left: {left or '-'}"
            )
            is_right = is_right and is_same and code == 0 and not left
            shutil.rmtree(folder / "killed")
            shutil.rmtree(run.temporary)
    raise SystemExit(0 if is_right else 1)


if __name__ == "__main__":
    main()
