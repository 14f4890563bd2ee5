"""Every attack on the grader in one table: points gained, neighbours harmed, what was reported.

These are the very attacks of tests/autograder/attacks.py (an answer's source) and
tests/gradebook/form_attacks.py (cells, files, archives, names), each with an honest submission
behind it. Ends with exit code 1 where one gained a point or harmed a neighbour, or where one of the published
list of 62 is not tried.

    .venv/bin/python tests/benchmarks/bench_attacks.py [--workers 2]
"""

import sys
import tempfile
from pathlib import Path

import click
from rich.console import Console
from rich.markup import escape
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "autograder"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "gradebook"))

from attacks import MASTERS, PUBLISHED, SEED, judge_attacks
from form_attacks import LESSON, grade_attacks
from submissions import MASTERS as OFFICE_MASTERS

from imgproc_course.authoring.masters import read_master
from imgproc_course.autograder.make_answer_key import make_key
from imgproc_course.autograder.sanitize import sanitize_line


def source_rows(folder, workers):
    """(number, attack, points gained, what it harmed, what was reported) of attacks by an answer's source."""
    key = make_key(MASTERS, SEED, folder / "key")
    for found in judge_attacks(key, quiet=None, workers=workers):
        public, hidden = found.exercise["cases"]
        told = f"{public['outcome']} / {hidden['outcome']}"
        told += f": {public['said']}" if public["said"] else ""
        yield found.attack.number, found.attack.name, found.exercise["got"], found.harmed, told


def form_rows(folder, workers):
    """The same of attacks by a submission's form."""
    make_key(OFFICE_MASTERS, SEED, folder / "form-key")
    light = read_master(OFFICE_MASTERS / f"{LESSON}.py")
    for found in grade_attacks(light, folder / "form-key", folder / "form", quiet=None, workers=workers):
        yield found.attack.number, found.attack.name, found.gained, found.harmed, found.reported


@click.command()
@click.option("--workers", type=click.IntRange(1), default=2, show_default=True, help="Graded at once.")
def main(workers):
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        rows = [*source_rows(Path(folder), workers), *form_rows(Path(folder), workers)]
    rows.sort(key=lambda row: row[0])
    table = Table("no.", "attack", "gained", "harmed", "reported: public / hidden check, or why not graded")
    for number, name, gained, harmed, told in rows:
        where = str(number) if number in PUBLISHED else f"own {number}"
        table.add_row(where, escape(name), str(gained), str(len(harmed)), escape(sanitize_line(told, 110)))
    Console(width=150).print(table)
    raise SystemExit(0 if holds(rows) else 1)


def holds(rows):
    """Print what is broken, then the sums; True where nothing was gained, nobody harmed, nothing left out."""
    published = {row[0] for row in rows} & set(PUBLISHED)
    missing = sorted(set(PUBLISHED) - published)
    own = sum(row[0] not in PUBLISHED for row in rows)
    gained, harmed = sum(row[2] for row in rows), sum(len(row[3]) for row in rows)
    for _, name, points, harm, _ in rows:
        if points or harm:
            print(f"BROKEN by {name}: {points} points gained; harmed: {', '.join(harm) or 'nobody'}")
    if missing:
        print(f"BROKEN: no attack of the published numbers {missing}")
    print(
        f"{len(rows)} attacks, {own} of our own; {len(published)} of the {len(PUBLISHED)} published numbers"
        f" tried; points gained {gained}, neighbours harmed {harmed}"
    )
    return not (gained or harmed or missing)


if __name__ == "__main__":
    main()
