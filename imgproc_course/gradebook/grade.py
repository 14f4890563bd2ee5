"""Grade a folder of submissions, from the submitted files to the pages that learners get back.

The folder of grades contains:
    grades.json        everything, as grades.schema.json describes it
    grades.csv         one row per learner and lesson, for a spreadsheet
    summary.html       the teacher's page
    learners/*.html    one page per learner, to give back
    exports/*.csv      for Moodle, Canvas, and programs that read nbgrader's table
    results/*.json     every result, by a digest of key and answers: an interrupted run continues from here
"""

import contextlib
import shutil
from dataclasses import dataclass
from pathlib import Path

from imgproc_course.autograder.pool import open_scheduler
from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.gradebook.answer_keys import load_keys
from imgproc_course.gradebook.collect import collect
from imgproc_course.gradebook.grades_json import count_not_graded, grades_of, grades_text
from imgproc_course.gradebook.learners import read_all
from imgproc_course.gradebook.lms_export import exports, grades_csv
from imgproc_course.gradebook.lms_import import TableError, fill_table, read_tables
from imgproc_course.gradebook.report import learner_page, summary_page
from imgproc_course.gradebook.result_store import (
    GradesFolderError,
    ResultStore,
    grade_missing,
    make_private_folder,
    write_grades_file,
)

_MAX_LINES = 12  # of a run's summary, before the last lines


@dataclass(frozen=True)
class GradingSummary:
    """What to print after a run: `text`, and how many submissions could not be graded."""

    text: str
    not_graded: int


def grade_submissions(
    submissions,
    keys,
    out,
    *,
    deadline=None,
    fresh=False,
    scheduler=None,
    platform_tables=(),
    quiet=None,
    **options,
):
    """Grade submissions, and write the folder of grades.

    Parameters
    ----------
    submissions : Path of a folder, a zip or a notebook
    keys : sequence of Path
    out : Path of the folder of grades
    deadline : datetime, local, or None
    fresh : bool, grade again what was graded before
    scheduler : str, address of a Dask scheduler, or None
    platform_tables : sequence of Path, tables that platforms exported, to be filled with points
    quiet : True for no progress bars; None: no progress bars if stderr is no terminal
    options : kernel, unsafe, workers, limits, as `autograde` takes them

    Returns
    -------
    GradingSummary

    Raises
    ------
    CollectError, KeyFolderError, SandboxError, GradesFolderError, ValueError : one line with the remedy
    """
    out, submissions = Path(out), Path(submissions)
    answer_keys = load_keys(keys)
    _require_separate_folder(submissions, keys, out)
    platform_tables = read_tables(platform_tables)
    unsafe, kernel = options.get("unsafe", False), options.get("kernel", "fast")
    if not unsafe and scheduler is None:
        bubblewrap.require_sandbox()
    make_private_folder(out)
    store = ResultStore(out / "results", {"kernel": kernel, "unsafe": unsafe})
    with contextlib.ExitStack() as stack:
        if scheduler is not None:
            options["executor"] = stack.enter_context(open_scheduler(scheduler))
        collection = stack.enter_context(collect(submissions, tuple(answer_keys.lessons)))
        learners = read_all(collection, answer_keys, store, deadline=deadline, quiet=quiet)
        graded_now = grade_missing(learners, answer_keys, store, fresh=fresh, quiet=quiet, **options)
    grades = grades_of(
        learners, answer_keys, store, sandbox=not unsafe, deadline=deadline, ignored=collection.ignored
    )
    _write(out, grades, learners, answer_keys, store)
    return _summary(grades, graded_now, out, _fill_tables(platform_tables, grades, out))


def _require_separate_folder(submissions, keys, out):
    """Refuse to write grades among the submissions: the next run would collect them as submissions."""
    folder = out.resolve()
    for path in (submissions.resolve(), *(Path(key).resolve() for key in keys)):
        if folder == path or folder.is_relative_to(path):
            raise GradesFolderError(f"{out}: lies in {path}; name a folder outside it, --out grades")


def _fill_tables(platform_tables, grades, out):
    """Write the platforms' tables with points in them; returns lines for the summary."""
    lines = []
    for table in platform_tables:
        try:
            text, table_lines = fill_table(table, grades)
        except TableError as error:  # the other tables have the points all the same
            lines.append(f"Not filled: {error}")
            continue
        write_grades_file(out / "exports" / f"filled-{table.path.name}", text)
        lines += table_lines
    return lines


def _write(out, grades, learners, answer_keys, store):
    write_grades_file(out / "grades.json", grades_text(grades))
    write_grades_file(out / "grades.csv", grades_csv(grades))
    tables = exports(grades)
    for name, text in tables.items():
        write_grades_file(out / "exports" / name, text)
    _remove_others(out / "exports", "*.csv", tables)
    for learner, entry in zip(learners, grades["learners"], strict=True):
        results = {
            lesson: store.result(submission.answers_digest)
            for lesson, submission in learner.submissions.items()
            if submission.answers_digest
        }
        write_grades_file(out / "learners" / learner.page, learner_page(entry, results, answer_keys))
    _remove_others(out / "learners", "*.html", {learner.page for learner in learners})
    write_grades_file(out / "summary.html", summary_page(grades))


def _remove_others(folder, pattern, names):
    """Remove the files of an earlier run: pages of learners who are gone would be given back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in names:
            path.unlink()


def _summary(grades, graded_now, out, table_lines):
    lessons = [lesson for learner in grades["learners"] for lesson in learner["lessons"]]
    graded = sum(lesson["status"] == "graded" for lesson in lessons)
    late = sum(lesson["late"] for lesson in lessons)
    not_graded = count_not_graded(grades)
    lines = [
        f"{len(grades['learners'])} learners, {graded} lessons graded ({graded_now} now), {late} late,"
        f" {not_graded} could not be graded."
    ]
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            if lesson["status"] != "graded":
                lines.append(f"  {learner['name']}: {lesson['file']}: {lesson['reason']}")
    if len(lines) > _MAX_LINES:
        lines[_MAX_LINES - 1 :] = [f"  and {len(lines) - _MAX_LINES + 1} more"]
    if not grades["sandbox"]:
        lines.append("Graded without a sandbox; grades.json records it.")
    lines += table_lines
    width = shutil.get_terminal_size().columns * 3
    lines = [line[:width] for line in lines]
    lines += [
        f"Points: {out}/grades.csv   Your page: {out}/summary.html   Pages to give back: {out}/learners/"
    ]
    return GradingSummary("\n".join(lines), not_graded)
