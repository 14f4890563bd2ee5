"""Every attack on the autograder in one table: points gained, neighbors harmed, what was reported.

These are the attacks of autograder/attacks.py (an answer's source) and gradebook/form_attacks.py in
tests/classroom (cells, files, archives, names), each followed by an honest submission. The exit code is 1 if
an attack gained a point or harmed a neighbor, or if an attack of the published list of 62 is not tried.

    .venv/bin/python tests/benchmarks/bench_attacks.py [--workers 2]
"""

import sys
import tempfile
from pathlib import Path

import click
from rich.console import Console
from rich.markup import escape
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "autograder"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "classroom" / "gradebook"))

from attacks import MASTERS, PUBLISHED, SEED
from attacks import grade_attacks as grade_source_attacks
from form_attacks import LESSON
from form_attacks import grade_attacks as grade_form_attacks
from submissions import MASTERS as FORM_MASTERS

from imgproc_course.classroom.authoring.masters import read_master
from imgproc_course.classroom.autograder.make_answer_key import make_key
from imgproc_course.classroom.autograder.sanitize import sanitize_line


def source_rows(folder, workers):
    """(number, name, points gained, what it harmed, what was reported) of attacks by an answer's source."""
    key = make_key(MASTERS, SEED, folder / "key")
    for result in grade_source_attacks(key, quiet=None, workers=workers):
        public, hidden = result.exercise.cases
        report = f"{public.outcome} / {hidden.outcome}"
        report += f": {public.message}" if public.message else ""
        yield result.attack.number, result.attack.name, result.exercise.points, result.harmed, report


def form_rows(folder, workers):
    """The same of attacks by a submission's form."""
    make_key(FORM_MASTERS, SEED, folder / "form-key")
    light = read_master(FORM_MASTERS / f"{LESSON}.py")
    results = grade_form_attacks(light, folder / "form-key", folder / "form", quiet=None, workers=workers)
    for result in results:
        yield result.attack.number, result.attack.name, result.gained, result.harmed, result.report


@click.command()
@click.option("--workers", type=click.IntRange(1), default=2, show_default=True, help="Graded at once.")
def main(workers):
    with tempfile.TemporaryDirectory(prefix="bench-") as folder:
        rows = [*source_rows(Path(folder), workers), *form_rows(Path(folder), workers)]
    rows.sort(key=lambda row: row[0])
    table = Table("no.", "attack", "gained", "harmed", "reported: public / hidden check, or why not graded")
    for number, name, gained, harmed, report in rows:
        label = str(number) if number in PUBLISHED else f"own {number}"
        table.add_row(label, escape(name), str(gained), str(len(harmed)), escape(sanitize_line(report, 110)))
    Console(width=150).print(table)
    raise SystemExit(0 if report_totals(rows) else 1)


def report_totals(rows):
    """Print failures and totals; True if no attack gained or harmed anything and none was left out."""
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
        f" tried; points gained {gained}, neighbors harmed {harmed}"
    )
    return not (gained or harmed or missing)


if __name__ == "__main__":
    main()
