"""The command `imgproc-course`. What a command calls is imported when that command runs."""

import importlib

import click

# name -> where its click command is
ELSEWHERE = {
    "build": "imgproc_course.grading.commands:build",
    "check": "imgproc_course.grading.commands:check",
    "grade": "imgproc_course.grading.office_commands:grade",
    "key": "imgproc_course.grading.office_commands:key",
    "new-lesson": "imgproc_course.grading.office_commands:new_lesson",
}


class LazyGroup(click.Group):
    """Commands of this module, and those of other rooms, which are imported when they are asked for."""

    def list_commands(self, ctx):
        return sorted({*super().list_commands(ctx), *ELSEWHERE})

    def get_command(self, ctx, name):
        if name not in ELSEWHERE:
            return super().get_command(ctx, name)
        module, _, attribute = ELSEWHERE[name].partition(":")
        return getattr(importlib.import_module(module), attribute)

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


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="imgproc-course")
def main():
    """Image processing in ROS 2: the course's own commands."""


@main.command()
def doctor():
    """Look at everything that the lessons use; each failure names its cure."""
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
