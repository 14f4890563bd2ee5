"""The command line `imgproc-course`. What a command calls is imported when that command runs."""

import subprocess
from datetime import datetime
from pathlib import Path

import click

CHECKOUT = Path(__file__).resolve().parents[1]
_FOLDER = click.Path(path_type=Path, file_okay=False)
_COULD_NOT_GRADE = 3


class CourseGroup(click.Group):
    """The commands, with one line instead of a traceback where a package is not installed."""

    def invoke(self, ctx):
        try:
            return super().invoke(ctx)
        except ModuleNotFoundError as error:
            # The course without all that it needs, as in a robot's environment.
            missing = (error.name or "").partition(".")[0]
            if missing in ("", "imgproc_course"):
                raise
            raise click.ClickException(
                f"{missing} is not installed for this Python, and this command needs it; use the "
                "imgproc-course of the course's own .venv, which environment/setup makes"
            ) from error


@click.group(cls=CourseGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="imgproc-course")
def main():
    """Image processing in ROS 2: the course's own commands."""


@main.command()
def doctor():
    """Look at everything that the lessons use; each failure names its remedy."""
    from imgproc_course.doctor import doctor as examine

    report = examine()
    report.print()
    if not report.ready:
        raise SystemExit(1)


@main.command(context_settings={"ignore_unknown_options": True, "help_option_names": ["-h", "--help"]})
@click.argument("jupyter_options", nargs=-1, type=click.UNPROCESSED)
def start(jupyter_options):
    """Bring the lessons into my_lessons/ and open JupyterLab there.

    An update of the course brings new and corrected lessons beside what you have begun, never over it.
    Every option goes on to JupyterLab: --no-browser, --port 8890, --ip ADDRESS, and so on.
    """
    from imgproc_course.lab import LabError
    from imgproc_course.lab import start as start_lab
    from imgproc_course.working_copies import LessonsError

    try:
        start_lab(jupyter_options, say=click.echo)
    except (LabError, LessonsError) as error:
        raise click.ClickException(str(error)) from error


@main.command()
@click.option("--speed", type=float, default=1.0, show_default=True, help="Times the recording's own rate.")
@click.option("--loop/--once", default=True, show_default=True, help="Start again at the end, or stop there.")
@click.option("--recording", default="drive", show_default=True, help="'drive', or the path of a rosbag2.")
@click.option("--camera-topic", help="Which of its cameras to play; the first of colour unless said.")
@click.option(
    "--topic", default="/kachaka/front_camera/image_raw", show_default=True, help="Raw pictures' topic."
)
@click.option(
    "--stamps",
    type=click.Choice(["now", "recorded"]),
    default="now",
    show_default=True,
    help="Stamp each picture with the time it is sent, or as it was recorded.",
)
def play(**options):
    """Publish the recorded drive as the robot publishes its camera, until Ctrl-C."""
    from imgproc_course.ros import ros_problem

    problem = ros_problem()
    if problem is not None:
        raise click.ClickException(problem)
    from imgproc_course.ros.player import play as play_recording

    try:
        code = play_recording(**options)
    except ValueError as error:
        raise click.ClickException(str(error)) from error
    raise SystemExit(code)


@main.command()
@click.option("--minutes", type=float, default=10.0, show_default=True, help="How long, after a warm-up.")
@click.option("--speed", type=float, default=3.0, show_default=True, help="Times the drive's own 10 Hz.")
@click.option("--warm-up", type=float, default=25.0, show_default=True, help="Seconds that do not count.")
def soak(minutes, speed, warm_up):
    """Run camera, both nodes and a subscriber, and say what was lost and what grew; exit 1 if anything."""
    from imgproc_course.ros import ros_problem

    problem = ros_problem()
    if problem is not None:
        raise click.ClickException(problem)
    from imgproc_course.ros.soak import soak as run_soak

    try:
        code = run_soak(minutes, speed, warm_up=warm_up, say=click.echo)
    except ValueError as error:
        raise click.ClickException(str(error)) from error
    raise SystemExit(code)


# ---------------------------------------------------------------- lessons and grades


@main.command()
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@click.option(
    "--check",
    "only_check",
    is_flag=True,
    help="Write nothing; fail where a stored lesson differs from its master.",
)
@click.option(
    "--masters",
    type=_FOLDER,
    default=CHECKOUT / "notebooks" / "masters",
    help="Folder of masters; the course's own unless said.",
)
@click.option(
    "--out",
    type=_FOLDER,
    help="Folder for the lessons; the masters' parent unless said.",
)
@click.option(
    "--solved",
    type=_FOLDER,
    help="Folder for the solved twins; solved/ unless said.",
)
def build(lessons, only_check, masters, out, solved):
    """Make lessons, and their solved twins, from masters.

    LESSON names one of them, 02 or 02_images_as_messages; all are built where none is named.
    """
    from imgproc_course.authoring.build import build as build_lessons
    from imgproc_course.authoring.build import compare_lessons
    from imgproc_course.exercises.declaration import MasterError

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


@main.command()
@click.argument(
    "notebooks", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="LESSON.ipynb..."
)
@click.option("--run", "and_run", is_flag=True, help="Run your answers against the checks too.")
def check(notebooks, and_run):
    """Look at a lesson before you hand it in: is every answer there, and where grading looks for it?"""
    from imgproc_course.exercises.declaration import MasterError
    from imgproc_course.gradebook.check import HandInError, look_at, report_lines, run_answers

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


@main.command()
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
    from imgproc_course.autograder.answer_key import KeyFolderError
    from imgproc_course.autograder.make_answer_key import kept_seed, make_key
    from imgproc_course.autograder.sandbox.bubblewrap import SandboxError
    from imgproc_course.exercises.declaration import MasterError

    seed_file = out.with_name(f"{out.name}.seed")
    try:
        folder = _masters_folder(masters)
        kept = seed is None
        seed = kept_seed(seed_file) if kept else seed
        made = make_key(folder, seed, out, lessons, unsafe=unsafe, replace=replace)
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


@main.command()
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
    "--platform-table",
    "platform_tables",
    type=click.Path(path_type=Path, dir_okay=False),
    multiple=True,
    help="Canvas's gradebook or Moodle's grading worksheet, as exported: filled with points, to import back.",
)
@click.option("--scheduler", metavar="ADDRESS", help="Grade on a Dask cluster: tcp://10.0.0.5:8786.")
def grade(submissions, keys, out, workers, kernel, deadline, unsafe, fresh, platform_tables, scheduler):
    """Grade everything in SUBMISSIONS: a folder, or the zip of a learning platform.

    What was graded before, with the same key and the same answers, is not graded again: a run that was
    interrupted goes on where it stopped. Exit codes: 0 all graded, 3 some could not be (they have 0 points
    and a reason), 1 nothing was graded, 130 interrupted.
    """
    from imgproc_course.autograder.answer_key import KeyFolderError
    from imgproc_course.autograder.sandbox.bubblewrap import SandboxError
    from imgproc_course.gradebook.collect import CollectError
    from imgproc_course.gradebook.grade import grade_submissions
    from imgproc_course.gradebook.grades_json import GradesFolderError

    try:
        told = grade_submissions(
            submissions,
            keys,
            out,
            deadline=deadline,
            afresh=fresh,
            scheduler=scheduler,
            platform_tables=platform_tables,
            kernel=kernel,
            unsafe=unsafe,
            workers=workers,
        )
    except (CollectError, KeyFolderError, SandboxError, GradesFolderError, ValueError) as error:
        raise click.ClickException(str(error)) from error
    except KeyboardInterrupt:
        click.echo("\nStopped. What is graded is kept: the same command goes on from here.", err=True)
        raise SystemExit(130) from None
    click.echo(told.text)
    if told.not_graded:
        raise SystemExit(_COULD_NOT_GRADE)


@main.command("new-lesson")
@click.argument("name")
@click.option(
    "--out", type=_FOLDER, required=True, help="Folder of your masters; made where it is not there."
)
def new_lesson(name, out):
    """Begin a lesson of your own: a master that builds and grades at once."""
    from imgproc_course.authoring.new_lesson import new_lesson as write
    from imgproc_course.exercises.declaration import MasterError

    try:
        path = write(name, out)
    except MasterError as error:
        raise click.ClickException(str(error)) from error
    click.echo(f"{path}: change it, then")
    click.echo(f"  imgproc-course build --masters {out} --out LESSONS --solved SOLVED")
    click.echo(f"  imgproc-course key --masters {out} --out KEY")
