"""The teacher's commands of `imgproc-course`: key, grade, new-lesson. What they call is imported in them."""

import secrets
import subprocess
from datetime import datetime
from pathlib import Path

import click

_FOLDER = click.Path(path_type=Path, file_okay=False)
_COULD_NOT_GRADE = 3


class _Moment(click.ParamType):
    name = "moment"

    def convert(self, value, param, ctx):
        try:
            moment = datetime.fromisoformat(value)
        except ValueError:
            self.fail(f"{value!r} is no moment; give it like 2026-12-01T23:59", param, ctx)
        return moment.astimezone().replace(tzinfo=None) if moment.tzinfo else moment


def _masters_folder(masters):
    from imgproc_course.exercises.declaration import masters_folders

    folders = [masters] if masters else masters_folders()
    if not folders:
        raise click.ClickException("no masters here; say where they are: --masters FOLDER")
    return folders[0]


@click.command()
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@click.option("--seed", help="The secret that the inputs are drawn from; made and kept where none is given.")
@click.option("--out", type=_FOLDER, default=Path("key"), show_default=True, help="Folder of the key.")
@click.option(
    "--masters", type=_FOLDER, help="Folder of masters; IMGPROC_COURSE_MASTERS or the course's unless said."
)
@click.option("--force", "--replace", "replace", is_flag=True, help="Take the place of a key that is there.")
@click.option("--unsafe", is_flag=True, help="Run the masters' solutions without a sandbox.")
def key(lessons, seed, out, masters, replace, unsafe):
    """Make the answer key: run the solutions on inputs drawn from a secret seed.

    LESSON names one of them, 02 or 02_images_as_messages; all are in the key where none is named.
    """
    from imgproc_course.exercises.declaration import MasterError
    from imgproc_course.grading.kernel.sandbox import SandboxError
    from imgproc_course.grading.key import KeyFolderError, make_key
    from imgproc_course.grading.term import write_handed_out

    seed_file = out.with_name(f"{out.name}.seed")
    try:
        folder = _masters_folder(masters)
        kept = seed is None
        seed = _kept_seed(seed_file) if kept else seed
        made = make_key(folder, seed, out, lessons, unsafe=unsafe, replace=replace)
        write_handed_out(folder, out, lessons)
    except (MasterError, KeyFolderError, SandboxError) as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"the key cannot be written: {error}") from error
    count = sum(not each.practice for lesson in made.lessons.values() for each in lesson.exercises)
    click.echo(f"Key of {len(made.lessons)} lessons and {count} exercises: {out}/")
    if kept:
        click.echo(f"Its secret seed is kept in {seed_file}, to make the same key again.")
    else:
        click.echo("Its seed is kept nowhere: you need it to make the same key again.")
    for path in (out, *([seed_file] if kept else ())):
        if _would_be_committed(path):
            click.echo(
                f"Warning: {path} is in a git checkout and not ignored: add it to .gitignore", err=True
            )


def _kept_seed(path):
    """The seed that is kept beside a key, made where there is none."""
    if path.exists():
        return path.read_text(encoding="utf-8").strip()
    seed = secrets.token_hex(16)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch(mode=0o600)
    path.write_text(f"{seed}\n", encoding="utf-8")
    return seed


def _would_be_committed(path):
    try:
        asked = subprocess.run(
            ["git", "check-ignore", "-q", path.name],
            cwd=path.resolve().parent,
            capture_output=True,
            check=False,
            timeout=20,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return asked.returncode == 1  # 0: ignored; 128: no checkout


@click.command()
@click.argument("submissions", type=click.Path(path_type=Path))
@click.option(
    "--key",
    "keys",
    type=_FOLDER,
    multiple=True,
    default=(Path("key"),),
    show_default=True,
    help="Folder of the key; said again for keys of other versions or of other lessons.",
)
@click.option("--out", type=_FOLDER, default=Path("grades"), show_default=True, help="Folder of the grades.")
@click.option(
    "--workers", type=click.IntRange(1), help="How many are graded at once; one a core unless said."
)
@click.option("--kernel", type=click.Choice(["fast", "ipykernel"]), default="fast", show_default=True)
@click.option("--deadline", type=_Moment(), help="Mark what came later: 2026-12-01T23:59, in local time.")
@click.option("--unsafe", is_flag=True, help="Run learners' code without a sandbox, as you, with your files.")
@click.option("--fresh", is_flag=True, help="Grade again what was graded before.")
@click.option(
    "--roster",
    "rosters",
    type=click.Path(path_type=Path, dir_okay=False),
    multiple=True,
    help="Canvas's gradebook or Moodle's grading worksheet, as exported: filled with points, to import back.",
)
@click.option("--scheduler", metavar="ADDRESS", help="Grade on a Dask cluster: tcp://10.0.0.5:8786.")
def grade(submissions, keys, out, workers, kernel, deadline, unsafe, fresh, rosters, scheduler):
    """Grade everything in SUBMISSIONS: a folder, or the zip of a learning platform.

    What was graded before, with the same key and the same answers, is not graded again: a run that was
    interrupted goes on where it stopped. Exit codes: 0 all graded, 3 some could not be (they have 0 points
    and a reason), 1 nothing was graded, 130 interrupted.
    """
    from imgproc_course.grading.grades import GradesFolderError
    from imgproc_course.grading.intake import IntakeError
    from imgproc_course.grading.kernel.sandbox import SandboxError
    from imgproc_course.grading.key import KeyFolderError
    from imgproc_course.grading.office import grade_submissions

    try:
        told = grade_submissions(
            submissions,
            keys,
            out,
            deadline=deadline,
            afresh=fresh,
            scheduler=scheduler,
            rosters=rosters,
            kernel=kernel,
            unsafe=unsafe,
            workers=workers,
        )
    except (IntakeError, KeyFolderError, SandboxError, GradesFolderError, ValueError) as error:
        raise click.ClickException(str(error)) from error
    except KeyboardInterrupt:
        click.echo("\nStopped. What is graded is kept: the same command goes on from here.", err=True)
        raise SystemExit(130) from None
    click.echo(told.text)
    if told.not_graded:
        raise SystemExit(_COULD_NOT_GRADE)


@click.command("new-lesson")
@click.argument("name")
@click.option(
    "--out", type=_FOLDER, required=True, help="Folder of your masters; made where it is not there."
)
def new_lesson(name, out):
    """Begin a lesson of your own: a master that builds and grades at once."""
    from imgproc_course.exercises.declaration import MasterError
    from imgproc_course.grading.new_lesson import new_lesson as write

    try:
        path = write(name, out)
    except MasterError as error:
        raise click.ClickException(str(error)) from error
    click.echo(f"{path}: change it, then")
    click.echo(f"  imgproc-course build --masters {out} --out LESSONS --solved SOLVED")
    click.echo(f"  imgproc-course key --masters {out} --out KEY")
