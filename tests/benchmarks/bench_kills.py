"""kill -9 of each kind of process of a run, ten times at random moments: grades.json stays byte-identical.

For each kind a run is started, and started again when it ends, until ten processes of the kind were killed;
then it may finish. Afterwards nothing of it may be left. The exit code is 1 if a run could not grade
everything, if grades.json differs from the one of a calm run, or if anything is left ten seconds after
the end.

    .venv/bin/python tests/benchmarks/bench_kills.py [--times 10] [--submissions 40] [--kind NAME]
"""

import random
import shutil
import sys
import tempfile
from pathlib import Path

import click

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "gradebook"))

from kills import COMMAND, KINDS, Run, run_with_kills, write_submissions
from nbclassroom.authoring.masters import read_master
from nbclassroom.autograder.make_answer_key import make_key
from submissions import MASTERS, SEED

PAUSE = (1.0, 5.0)  # seconds between two kills: a worker needs one or two to start


@click.command()
@click.option("--times", type=click.IntRange(1), default=10, show_default=True, help="Kills of each kind.")
@click.option("--submissions", "count", type=click.IntRange(2), default=40, show_default=True)
@click.option("--seed", type=int, default=1, show_default=True, help="Of the moments.")
@click.option("--kind", "kinds", type=click.Choice(list(KINDS)), multiple=True, help="Of process; all kinds.")
def main(times, count, seed, kinds):
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
        for kind in kinds or KINDS:
            # A killed command continues where it stopped; the others grade everything again.
            options = () if kind == COMMAND else ("--fresh",)
            run = Run(folder / "submissions", folder / "key", folder / "killed", *options)
            endings = run_with_kills(run, kind, times, PAUSE, rng)
            path = folder / "killed" / "grades.json"
            is_same = path.exists() and path.read_bytes() == expected
            left = run.survivors(10) + [str(path) for path in run.temporary.iterdir()]
            faults = [f"exit code {code}:\n{printed}" for code, printed in endings if code]
            print(
                f"{kind}: killed {times} times in {len(endings)} runs, {len(faults)} with a fault;"
                f" grades.json {'byte-identical' if is_same else 'DIFFERS'}; left: {left or '-'}",
                *faults,
                sep="\n",
                flush=True,
            )
            is_right = is_right and is_same and not faults and not left
            shutil.rmtree(folder / "killed")
            shutil.rmtree(run.temporary)
    raise SystemExit(0 if is_right else 1)


if __name__ == "__main__":
    main()
