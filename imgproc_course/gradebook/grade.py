"""Grade a folder of submissions, from what was handed in to the pages that are handed back."""

import contextlib
import shutil
from dataclasses import dataclass
from pathlib import Path

from imgproc_course.autograder.pool import open_scheduler
from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.gradebook.answer_keys import load_keys
from imgproc_course.gradebook.collect import collect
from imgproc_course.gradebook.grades_json import (
    GradesFolderError,
    Store,
    as_text,
    grades_of,
    judge_all,
    make_private,
    needs_a_look,
    write_whole,
)
from imgproc_course.gradebook.learners import read_all
from imgproc_course.gradebook.lms_export import exports, grades_csv
from imgproc_course.gradebook.lms_import import TableError, fill, read_tables
from imgproc_course.gradebook.report import learner_page, summary_page


@dataclass(frozen=True)
class Told:
    """What a run has to say: `text`, and how many hand-ins could not be graded."""

    text: str
    not_graded: int


def grade_submissions(
    submissions,
    keys,
    out,
    *,
    deadline=None,
    afresh=False,
    scheduler=None,
    platform_tables=(),
    quiet=None,
    **options,
):
    """Grade what was handed in, and write everything.

    Parameters
    ----------
    submissions : Path of a folder, a zip or a notebook
    keys : sequence of Path
    out : Path of the folder of grades
    deadline : datetime, local, or None
    afresh : bool, judge again what was judged before
    scheduler : str, address of a Dask scheduler, or None
    platform_tables : sequence of Path, tables that platforms exported, to be filled with points
    quiet : True for no progress bars; None: where stderr is no terminal
    options : kernel, unsafe, workers, limits, as `judge` takes them

    Returns
    -------
    Told

    Raises
    ------
    CollectError, KeyFolderError, SandboxError, GradesFolderError, ValueError : one line with the remedy
    """
    out, submissions = Path(out), Path(submissions)
    answer_keys = load_keys(keys)
    _refuse_muddle(submissions, keys, out)
    platform_tables = read_tables(platform_tables)
    unsafe, kernel = options.get("unsafe", False), options.get("kernel", "fast")
    if not unsafe and scheduler is None:
        bubblewrap.demand()
    make_private(out)
    store = Store(out / "judged", {"kernel": kernel, "unsafe": unsafe})
    with contextlib.ExitStack() as stack:
        if scheduler is not None:
            options["executor"] = stack.enter_context(open_scheduler(scheduler))
        collection = stack.enter_context(collect(submissions, tuple(answer_keys.lessons)))
        learners = read_all(collection, answer_keys, store, deadline=deadline, quiet=quiet)
        judged = judge_all(learners, answer_keys, store, afresh=afresh, quiet=quiet, **options)
    grades = grades_of(
        learners, answer_keys, store, sandbox=not unsafe, deadline=deadline, ignored=collection.ignored
    )
    _write(out, grades, learners, answer_keys, store)
    return _told(grades, judged, out, _fill(platform_tables, grades, out))


def _fill(platform_tables, grades, out):
    """Write the platforms' tables with points in them; gives what is to be said of them."""
    told = []
    for table in platform_tables:
        try:
            text, said = fill(table, grades)
        except TableError as error:  # the points stand in the other tables all the same
            told.append(f"Not filled: {error}")
            continue
        write_whole(out / "exports" / f"filled-{table.path.name}", text)
        told += said
    return told


def _refuse_muddle(submissions, keys, out):
    """Grades among the submissions would be taken for submissions the next time."""
    here = out.resolve()
    for path in (submissions.resolve(), *(Path(key).resolve() for key in keys)):
        if here == path or here.is_relative_to(path):
            raise GradesFolderError(f"{out}: lies in {path}; name a folder outside it, --out grades")


def _write(out, grades, learners, answer_keys, store):
    write_whole(out / "grades.json", as_text(grades))
    write_whole(out / "grades.csv", grades_csv(grades))
    tables = exports(grades)
    for name, text in tables.items():
        write_whole(out / "exports" / name, text)
    _remove_others(out / "exports", "*.csv", tables)
    pages = set()
    for learner, entry in zip(learners, grades["learners"], strict=True):
        results = {
            name: store.result(each.answers_digest)
            for name, each in learner.submissions.items()
            if each.answers_digest
        }
        write_whole(out / "learners" / learner.page, learner_page(entry, results, answer_keys))
        pages.add(learner.page)
    _remove_others(out / "learners", "*.html", pages)
    write_whole(out / "summary.html", summary_page(grades))


def _remove_others(folder, pattern, kept):
    """Pages of learners who are not there any more would be handed back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in kept:
            path.unlink()


def _told(grades, judged, out, filled):
    handed_in = [lesson for learner in grades["learners"] for lesson in learner["lessons"]]
    graded = [lesson for lesson in handed_in if lesson["status"] == "graded"]
    late = sum(lesson["late"] for lesson in handed_in)
    missing = needs_a_look(grades)
    lines = [
        f"{len(grades['learners'])} learners, {len(graded)} lessons graded ({judged} now), {late} late,"
        f" {missing} could not be graded."
    ]
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            if lesson["status"] != "graded":
                lines.append(f"  {learner['name']}: {lesson['source']}: {lesson['reason']}")
    if len(lines) > 12:
        lines[11:] = [f"  and {len(lines) - 11} more"]
    if not grades["sandbox"]:
        lines.append("Graded without a sandbox; grades.json says so.")
    lines += filled
    width = shutil.get_terminal_size().columns * 3
    lines = [line[:width] for line in lines]
    lines += [f"Points: {out}/grades.csv   Yours: {out}/summary.html   To hand back: {out}/learners/"]
    return Told("\n".join(lines), missing)
