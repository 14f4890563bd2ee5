"""The command line of a course: `python -m nbclassroom`. Each command imports what it calls when it runs."""

import contextlib
import subprocess
from pathlib import Path

import click
from click import option

from nbclassroom import course

_PATH = click.Path(path_type=Path)
_FOLDER = click.Path(path_type=Path, file_okay=False)
_FILE = click.Path(path_type=Path, dir_okay=False)
_STOPPED = {  # what Ctrl-C leaves of a command's work
    "key": "Stopped. Finished exercises are kept: run the same command again to continue.",
    "grade": "Stopped. Finished grades are saved: run the same command again to continue.",
    "league": "Stopped; nothing is written.",
}


class CourseGroup(click.Group):
    """The commands. An error that says what to do is printed as one line, without a traceback."""

    def invoke(self, ctx):
        try:
            return super().invoke(ctx)
        except ModuleNotFoundError as error:
            # A robot's environment, for example, has the course but not all the packages that it needs.
            package = (error.name or "").partition(".")[0]
            if package in ("", "nbclassroom", course.package):
                raise
            problem = f"this command needs {package}, which is not installed for this Python"
            remedy = f"use the {course.command} in the course's own .venv"
            raise click.ClickException(f"{problem}; {remedy}") from error
        except KeyboardInterrupt:
            click.echo(f"\n{_STOPPED.get(ctx.invoked_subcommand, 'Stopped.')}", err=True)
            raise SystemExit(130) from None
        except (OSError, RuntimeError, ValueError) as error:
            is_ours = type(error).__module__.startswith("nbclassroom.") or isinstance(error, ValueError)
            if not is_ours and not isinstance(error, OSError):
                raise
            text = str(error) if is_ours else f"{ctx.invoked_subcommand} stopped: {error}"
            exception = click.ClickException(text)
            exception.exit_code = getattr(error, "exit_code", 1)  # type: ignore[misc]  # click reads it there
            raise exception from error


def _course_option(*names, default, text, type=_FOLDER):
    """An option whose default is the course's own, which `default` finds when the command runs."""
    text += "  [default: the course's own]"
    return option(*names, type=type, default=default, show_default=False, help=text)


def _seed_option(subject, place):
    text = f"Secret seed of {subject}, 32 random hexadecimal digits or more."
    return option("--seed", help=f"{text}  [default: a new one, saved {place}]")


_masters_option = _course_option(
    "--masters", default=lambda: course.folder() / "masters", text="Folder of the masters."
)
_unsafe_help = "Run the learners' code without a sandbox: it can read and change your files."
_unsafe_option = option("--unsafe", is_flag=True, help=_unsafe_help)


@click.group(cls=CourseGroup, context_settings={"help_option_names": ["-h", "--help"], "show_default": True})
def main():
    """Commands of a course in notebooks: its lessons, its answer keys, its grades."""


@main.command(context_settings={"ignore_unknown_options": True})
@click.argument("jupyter_options", nargs=-1, type=click.UNPROCESSED)
def start(jupyter_options):
    """Copy the lessons into the learner's folder, my_lessons/, and open JupyterLab there.

    An update of the course never overwrites your work: an updated lesson is added under a new name.
    JupyterLab gets all options: --no-browser, --port 8890, --ip ADDRESS, and so on.
    """
    from nbclassroom.lab.server import start as start_lab

    start_lab(jupyter_options, say=click.echo)


@main.command()
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@option(
    "--check",
    "only_check",
    is_flag=True,
    help="Write nothing; fail if a stored lesson differs from its master.",
)
@_masters_option
@option("--out", type=_FOLDER, help="Folder for the lessons.  [default: the parent of the masters' folder]")
@option("--solved", type=_FOLDER, help="Folder for the solved lessons.  [default: solved/]")
@option(
    "--with-solutions",
    is_flag=True,
    help="Also write solutions/, which solution() opens. The course's own lessons always get them.",
)
def build(lessons, only_check, masters, out, solved, with_solutions):
    """Build the lessons from their masters, and each lesson a second time with solutions.

    Beside the lessons, checks/ gets what `check` and `hint` need.

    LESSON is a number or a name: 03 or 03_images_as_messages. Without LESSON, all lessons are built.
    """
    from nbclassroom.authoring.build import build as build_lessons
    from nbclassroom.authoring.build import compare_lessons

    out = out or masters.parent
    solved = solved or course.folder().parent / "solved"
    if only_check:
        result = compare_lessons(masters, out, lessons, progress=click.echo)
    else:
        with_solutions |= masters.resolve() == course.folder() / "masters"
        options = {"progress": click.echo, "with_solutions": with_solutions}
        result = build_lessons(masters, out, solved, lessons, **options)
    for problem in result.problems:
        click.echo(problem, err=True)
    if result.problems:
        raise SystemExit(1)
    verdict = "equal to their masters" if only_check else f"built into {out}"
    click.echo(f"Lessons {verdict}: {len(result.built)}.")


@main.command()
@click.argument("folder", type=_FOLDER)
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@_course_option("--from", "source", default=course.folder, text="Folder of the built lessons.")
@option("--with-solutions", is_flag=True, help="Let learners open solutions after three tries.")
@option("--zip", "zipped", is_flag=True, help="Also write FOLDER.zip.")
def handout(folder, lessons, source, with_solutions, zipped):
    """Write what learners get into FOLDER: the lessons without outputs, and what their checks need.

    LESSON is a number or a name: 03 or images_as_messages. Without LESSON, all lessons are handed out.
    A file in FOLDER that differs is never replaced.
    """
    from nbclassroom.authoring.handout import hand_out

    count, archive = hand_out(folder, source, lessons, with_solutions=with_solutions, zipped=zipped)
    place = f"{folder}/ and {archive}" if zipped else f"{folder}/"
    solutions = "with" if with_solutions else "without"
    click.echo(f"Lessons handed out: {count}, {solutions} solutions, in {place}")


@main.command()
@click.argument("notebooks", nargs=-1, required=True, type=_PATH, metavar="LESSON.ipynb...")
@option("--run", "and_run", is_flag=True, help="Also run the checks on your answers.")
def check(notebooks, and_run):
    """Check a lesson before you submit it: is every answer present, and in its answer cell?"""
    from nbclassroom.gradebook import check

    ready = 0
    for path in notebooks:
        try:
            lesson_check = check.check_lesson(path)
            if and_run:
                check.run_answers(lesson_check)
        except ValueError as error:
            click.echo(f"Error: {error}", err=True)
        else:
            ready += lesson_check.ready
            click.echo("\n".join(check.report_lines(lesson_check)))
    if ready < len(notebooks):
        raise SystemExit(1)


def _local_time(ctx, param, value):
    from nbclassroom.gradebook.teacher_tables import local_time_of

    try:
        return value and local_time_of(value)
    except ValueError as error:
        problem = f"{value!r} is not a date and time"
        raise click.BadParameter(f"{problem}; write it like 2026-12-01T23:59") from error


@main.command()
@click.argument("lessons", nargs=-1, metavar="[LESSON]...")
@_seed_option("the inputs", "beside the key")
@option("--out", type=_FOLDER, default="key", help="Folder for the key.")
@_masters_option
@option("--replace", is_flag=True, help="Replace an existing key.")
@option("--unsafe", is_flag=True, help="Run the masters' solutions without a sandbox.")
def key(lessons, seed, out, masters, replace, unsafe):
    """Make the answer key: run the solutions on inputs drawn from a secret seed.

    LESSON is a number or a name: 03 or 03_images_as_messages. Without LESSON, the key has all lessons, which
    take about five minutes on two quiet cores. After Ctrl-C, the same command goes on where it stopped.
    """
    from nbclassroom.autograder.answer_key import secret_seed
    from nbclassroom.autograder.make_answer_key import make_key

    seed_file, is_seed_saved = out.with_name(f"{out.name}.seed"), seed is None  # beside the key
    seed = secret_seed(seed, seed_file)
    answer_key = make_key(masters, seed, out, lessons, unsafe=unsafe, replace=replace, say=click.echo)
    lessons = answer_key.lessons.values()
    count = sum(not exercise.practice for lesson in lessons for exercise in lesson.exercises)
    click.echo(f"Key in {out}/: lessons {len(lessons)}, exercises with points {count}.")
    if without_points := [lesson.name for lesson in lessons if not lesson.points]:
        click.echo(f"Lessons without points: {', '.join(without_points)}.")
    if is_seed_saved:
        click.echo(f"Its secret seed is saved in {seed_file}: you need it to make the same key again.")
    else:
        click.echo("Its seed is not saved: remember it, you need it to make the same key again.")
    for path in (out, *([seed_file] if is_seed_saved else ())):
        if _would_be_committed(path):
            text = "is in a git checkout and git does not ignore it: add it to .gitignore"
            click.echo(f"Warning: {path} {text}", err=True)


def _would_be_committed(path):
    command, folder = ["git", "check-ignore", "-q", path.name], path.resolve().parent
    try:
        process = subprocess.run(command, cwd=folder, capture_output=True, check=False, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return process.returncode == 1  # 0: ignored; 128: not a git checkout


@main.command()
@click.argument("submissions", type=_PATH)
@option(
    "--key",
    "keys",
    type=_FOLDER,
    multiple=True,
    help="Folder of a key; repeat the option for keys of other versions or other lessons.  [default: key]",
)
@option("--out", type=_FOLDER, default="grades", help="Folder for the grades.")
@option(
    "--workers",
    type=click.IntRange(1),
    help="Number of submissions graded at once.  [default: one for two cores; if robots drive, one per core]",
)
@option(
    "--deadline",
    callback=_local_time,
    metavar="TIME",
    help="Mark later submissions as late. In local time: 2026-12-01T23:59; a date alone is its end.",
)
@option(
    "--late",
    metavar="POLICY",
    help='What lateness costs: "10% a day", or "10% a day, 3 days" and then all points.',
)
@option(
    "--extensions", type=_FILE, help="CSV of learners' own deadlines: learner, lesson (or empty), deadline."
)
@option(
    "--decisions",
    type=_FILE,
    help="CSV of your decisions by hand.  [default: decisions.csv in the folder of grades]",
)
@option("--open-as-zero", is_flag=True, help="Export answers that nobody has graded yet as 0 points.")
@option("--anonymous", is_flag=True, help="Show an id instead of the name on every page.")
@_unsafe_option
@option("--fresh", is_flag=True, help="Grade again what was graded before.")
@option(
    "--platform-table",
    "platform_tables",
    type=_FILE,
    multiple=True,
    help="Gradebook of Canvas or grading worksheet of Moodle, as exported: it is returned with points.",
)
@option(
    "--roster",
    type=_FILE,
    help="Table of all learners, as Moodle or Canvas exports it: who has not submitted is reported.",
)
@option(
    "--layout",
    "layouts",
    multiple=True,
    help="How the folder names its learners: Moodle, Canvas, ILIAS, nbgrader, or a pattern such as"
    " {group}/{learner}/*.ipynb; repeat it for files of another layout.  [default: the one that fits]",
)
@option("--dry-run", is_flag=True, help="Print who sent what and what is left out, and grade nothing.")
@option("--scheduler", metavar="ADDRESS", help="Grade on a Dask cluster: tcp://10.0.0.5:8786.")
@option(
    "--review",
    is_flag=True,
    help="Afterwards, serve the pages on this machine until Ctrl-C, and count what you decide on them.",
)
@option("--forget-rules", is_flag=True, help="Do not use the rules of the run before.")
def grade(submissions, keys, out, review, forget_rules, dry_run, **options):
    """Grade everything in SUBMISSIONS: a folder, or the zip file of a learning platform.

    A submission that was graded before, with the same key and the same answers, is not graded again: after an
    interruption, the same command continues. Key, deadline, late policy, extensions, decisions, roster and
    layout are those of the run before into the same folder, unless you give others. Exit codes: 0 all graded,
    3 some could not be graded (they get 0 points and a reason) or a page is incomplete, or nothing was graded
    since it is in doubt whose a file is, 1 nothing was graded, 130 interrupted.
    """
    from nbclassroom.autograder.pool import usual_workers
    from nbclassroom.gradebook.answer_keys import AnswerKeys
    from nbclassroom.gradebook.result_store import RunRules

    rules = RunRules(out, options | {"keys": keys}, forget=forget_rules)
    if rules.kept:
        click.echo(f"As in the run before: {', '.join(rules.kept)}.")
    options |= rules.rules
    keys = options.pop("keys")
    if dry_run:
        from nbclassroom.gradebook.grade import who_sent_what

        click.echo(who_sent_what(submissions, keys, layouts=options["layouts"] or ()))
        return
    options["workers"] = options["workers"] or usual_workers(AnswerKeys(keys).lessons.values())
    report = _grade_and_review(submissions, keys, out, rules, review, options)
    click.echo(report.text)
    if not review:
        click.echo(f"Next: {course.command} grade {submissions} --out {out} --review (read, and decide)")
    if report.not_graded or report.failed_pages:
        raise SystemExit(3)  # something could not be graded, see the guide


def _grade_and_review(submissions, keys, out, rules, review, options):
    """The GradingSummary of a run, or of the second one after a review."""
    from nbclassroom.autograder.pool import open_worker_threads

    with contextlib.ExitStack() as stack:
        if not options["scheduler"]:
            # After a first run, perhaps nothing is left to do.
            is_first = options["fresh"] or not (out / "results").exists()
            settings = {name: options[name] for name in ("workers", "unsafe")}
            options["executor"] = stack.enter_context(open_worker_threads(early=is_first, **settings))
        # Imported while the workers start.
        from nbclassroom.gradebook.grade import grade_submissions
        from nbclassroom.gradebook.review_server import serve_review

        report = grade_submissions(submissions, keys, out, **options)
        rules.keep()
        if review:
            click.echo(report.text)
            serve_review(out, keys, options["decisions"], say=click.echo)
            options["fresh"] = False
            report = grade_submissions(submissions, keys, out, **options)
    return report


@main.command()
@click.argument("folder", type=_FOLDER)
@option("--out", type=_FOLDER, default="league", help="Folder for the page and the table.")
@option("--rooms", type=click.IntRange(1, 100), default=10, help="Number of secret rooms.")
@_seed_option("rooms and aliases", "in the folder: the next run has the same rooms")
@option("--workers", type=click.IntRange(1), help="Number of drives at once.  [default: one per core]")
@option("--names", is_flag=True, help="Show the learners' names instead of aliases.")
@_course_option(
    "--baseline",
    type=_FILE,
    default=lambda: course.folder() / course.league_baseline,
    text="Controller that drives beside the class.",
)
@_unsafe_option
def league(folder, out, **options):
    """Rank a class's controllers on secret rooms, on a page that you can show to the class.

    FOLDER has one file for each learner, NAME.py, with a function control(observation, memory). The page,
    league.html, has aliases, maps and films; league.csv says whose alias it is. A controller that fails or
    never ends costs only its own points.
    """
    from nbclassroom.league.league import run_league

    click.echo("\n".join(run_league(folder, out, **options)))


@main.command("new-lesson")
@click.argument("name")
@option("--out", type=_FOLDER, required=True, help="Folder of your masters; created if it does not exist.")
def new_lesson(name, out):
    """Create a lesson of your own: a master that you can build and grade at once."""
    from nbclassroom.authoring.masters import new_lesson as write

    path = write(name, out)
    click.echo(f"{path}: change it, then run")
    click.echo(f"  {course.command} build --masters {out} --out LESSONS --solved SOLVED")
    click.echo(f"  {course.command} key --masters {out} --out KEY")
