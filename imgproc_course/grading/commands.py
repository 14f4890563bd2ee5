"""The grading commands of `imgproc-course`. What they call is imported when they are called."""

from pathlib import Path

import click

CHECKOUT = Path(__file__).resolve().parents[2]


@click.command()
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@click.option(
    "--check",
    "only_check",
    is_flag=True,
    help="Write nothing; fail where a stored lesson differs from its master.",
)
@click.option(
    "--masters",
    type=click.Path(path_type=Path, file_okay=False),
    default=CHECKOUT / "notebooks" / "masters",
    help="Folder of masters; the course's own unless said.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the lessons; the masters' parent unless said.",
)
@click.option(
    "--solved",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the solved twins; solved/ unless said.",
)
def build(lessons, only_check, masters, out, solved):
    """Make lessons, and their solved twins, from masters.

    LESSON names one of them, 02 or 02_images_as_messages; all are built where none is named.
    """
    from imgproc_course.exercises.declaration import MasterError
    from imgproc_course.grading.build import build as build_lessons
    from imgproc_course.grading.build import compare_lessons

    out = out or masters.parent
    solved = solved or CHECKOUT / "solved"
    try:
        if only_check:
            report = compare_lessons(masters, out, lessons, say=click.echo)
        else:
            report = build_lessons(masters, out, solved, lessons, say=click.echo)
    except MasterError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"cannot write the lessons: {error}") from error
    for problem in report.problems:
        click.echo(problem, err=True)
    if report.problems:
        raise SystemExit(1)
    what = "as their masters say" if only_check else f"built into {out}"
    click.echo(f"Lessons {what}: {len(report.built)}.")


@click.command()
@click.argument(
    "notebooks", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="LESSON.ipynb..."
)
@click.option("--run", "and_run", is_flag=True, help="Run your answers against the checks too.")
def check(notebooks, and_run):
    """Look at a lesson before you hand it in: is every answer there, and where grading looks for it?"""
    from imgproc_course.exercises.declaration import MasterError
    from imgproc_course.grading.handin import HandInError, look_at, report_lines, run_answers

    ready = True
    for path in notebooks:
        try:
            handin = look_at(path)
            if and_run:
                run_answers(handin)
        except (HandInError, MasterError) as error:
            raise click.ClickException(str(error)) from error
        click.echo("\n".join(report_lines(handin)))
        ready = ready and handin.ready
    if not ready:
        raise SystemExit(1)
