"""How often `check` says what is wrong with an answer: the share of a folder's recorded answers.

Of the feedback only the sentences count: not the titles of the cases, the tables, the values that differ, the
points, or the line of the learner's that is quoted. An answer's feedback is

- right: it matches every pattern of `must_say` and none of `must_not_say`;
- false: it matches one of `must_not_say`, or names a known mistake without being right;
- silent: neither. "passing" counts those silent ones that pass every public check.

    .venv/bin/python tests/benchmarks/bench_feedback.py [--answers FOLDER] [--exercise ID] [--list]

The recorded answers helped to write the sentences. New ones, written from the tasks alone, measure: a folder
in the same form, see tests/classroom/exercises/wrong_answers.py.
"""

import sys
import time
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "classroom" / "exercises"))
from all_masters import all_exercises
from answer_feedback import feedback_on
from wrong_answers import FOLDER, read_wrong_answers


def judge(answer, result, text):
    """ "right", "false" or "silent"."""
    if answer.is_named_by(text):
        return "right"
    return "false" if answer.is_misled_by(text) or result.mistake is not None else "silent"


def measure(path, is_listed):
    """The counts of one exercise: right, false, silent, and the silent ones that pass."""
    exercise = all_exercises()[path.stem]
    counts = {"answers": 0, "right": 0, "false": 0, "silent": 0, "passing": 0}
    for answer in read_wrong_answers(path):
        result, text = feedback_on(exercise, answer)
        verdict = judge(answer, result, text)
        counts["answers"] += 1
        counts[verdict] += 1
        counts["passing"] += verdict == "silent" and result.passed
        if is_listed and verdict != "right":
            print(f"---- {verdict.upper()} {exercise.id}: {answer.name} ({answer.kind})\n{answer.sentence}")
            print(f"must say {answer.must_say}, not {answer.must_not_say}\n{text}\n")
    return counts


@click.command()
@click.option("--exercise", "ids", multiple=True, help="Only this exercise (may be repeated).")
@click.option("--list", "is_listed", is_flag=True, help="Print the answers whose feedback is not right.")
@click.option("--answers", "folder", default=FOLDER, type=click.Path(exists=True, path_type=Path))
def main(ids, is_listed, folder):
    paths = [path for path in sorted(folder.glob("*.py")) if not ids or path.stem in ids]
    if not paths:
        raise click.ClickException(f"no wrong answers for {', '.join(ids)} in {folder}")
    table = Table("exercise", "answers", "right", "false", "silent", "passing", "right %", "false %")
    total, started = {}, time.perf_counter()
    for path in paths:
        counts = measure(path, is_listed)
        total = {key: total.get(key, 0) + count for key, count in counts.items()}
        add_row(table, path.stem, counts)
    add_row(table, "all", total)
    Console(width=100).print(table)
    print(f"{time.perf_counter() - started:.0f} s")


def add_row(table, name, counts):
    """One row of the table."""
    shares = [f"{100 * counts[key] / counts['answers']:.1f}" for key in ("right", "false")]
    table.add_row(name, *(str(count) for count in counts.values()), *shares)


if __name__ == "__main__":
    main()
