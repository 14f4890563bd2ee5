"""The command line `imgproc-course`: the classroom's commands, and the course's own.

Each command imports what it calls when it runs.
"""

import contextlib
from pathlib import Path

import click
from click import option
from nbclassroom.cli import CourseGroup
from nbclassroom.cli import main as classroom

from imgproc_course.course_file import COURSE_FILE
from nbclassroom import course

course.use(COURSE_FILE)
_FOLDER = click.Path(path_type=Path, file_okay=False)
_IMAGES = "/kachaka/front_camera/image_raw"


@click.group(
    cls=CourseGroup,
    commands=classroom.commands,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
)
@click.version_option(package_name="imgproc-course")
def main():
    """Commands of the course "Image processing in ROS 2"."""


@main.command()
def doctor():
    """Check everything that the lessons use; each failure comes with its remedy."""
    from imgproc_course.doctor import doctor as run_doctor

    report = run_doctor()
    report.print()
    if not report.ready:
        raise SystemExit(1)


@contextlib.contextmanager
def _with_ros():
    """Requires ROS, and prints errors as one line."""
    from imgproc_course.ros import ros_problem

    problem = ros_problem()
    if problem is not None:
        raise click.ClickException(problem)
    try:
        yield
    except RuntimeError as error:
        raise click.ClickException(str(error)) from error


@main.command()
@option("--speed", default=1.0, help="Playback speed: 2 is twice the recording's own rate.")
@option("--loop/--once", default=True, help="At the end, start again or stop.")
@option("--recording", default="drive", help="'drive', or the path of a rosbag2 recording.")
@option("--camera-topic", help="Camera topic to play from the recording.  [default: its first colour camera]")
@option("--topic", default=_IMAGES, help="Topic on which the raw images are published.")
@option(
    "--stamps",
    type=click.Choice(["now", "recorded"]),
    default="now",
    help="Stamp of each image: the time of sending, or the recorded stamp.",
)
@option("--switch", is_flag=True, help="Switch the camera for all programs that use it.")
def play(**options):
    """Publish the recorded drive as the robot publishes its camera images, until Ctrl-C.

    There is one camera for all your programs in a ROS domain. If one of them, such as an open lesson, has
    started it already, this command joins it.
    """
    with _with_ros():
        from imgproc_course.ros.player import play as play_recording

        raise SystemExit(play_recording(**options))


def _size(ctx, param, value):
    width, _, height = (value or "").partition("x")
    if value is None or (width.isdecimal() and height.isdecimal()):
        return value and (int(width), int(height))
    raise click.BadParameter(f"{value!r} is not a size; write it like 1280x720")


@main.command()
@option("--seed", type=int, help="Seed of the wheels' slip and of the sensors' noise.  [default: 0]")
@option("--size", callback=_size, metavar="WxH", help="Size of the images.  [default: 640x360]")
@option("--lighting", type=click.Choice(["day", "evening"]), help="[default: day]")
@option("--rate", type=float, help="Images per second.  [default: 30; 10 for images wider than 640]")
@option("--start", type=(float,) * 3, metavar="X Y YAW", help="Where the robot starts (m, rad).")
@option("--room", type=int, help="Number of a furnished room.  [default: the room of the recorded drive]")
@option("--switch", is_flag=True, help="Switch the robot for all programs that use it.")
def drive(**options):
    """Start a robot in the room of the recorded drive or in a furnished one, until Ctrl-C.

    Your programs see its camera, depth, scan and odometry, and drive it; in a notebook, drive(Robot()) drives
    it by keys. There is one robot for all your programs in a ROS domain: this command starts it or joins it.
    """
    with _with_ros():
        from imgproc_course.ros.player import play

        raise SystemExit(play("room", **options))


@main.command()
@click.argument("path", type=_FOLDER)
@click.argument("topics", nargs=-1, metavar="[TOPIC]...")
def record(path, topics):
    """Record topics into the new folder PATH, until Ctrl-C.

    Without TOPIC: the robot's compressed images, depth, scan, odometry, commands and true poses. The
    recording is a rosbag2 in MCAP: open_recording, Foxglove and `ros2 bag` read it. Nothing is overwritten.
    """
    with _with_ros():
        from imgproc_course.ros.recorder import record_until_signal

        raise SystemExit(record_until_signal(list(topics) or None, path, say=click.echo))
