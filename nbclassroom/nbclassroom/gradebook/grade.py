"""Grade a folder of submissions, from the submitted files to the pages that learners get back."""

import contextlib
import shutil
import tempfile
import threading
from collections import namedtuple
from pathlib import Path

from ..autograder.pool import open_scheduler
from ..autograder.sandbox import bubblewrap
from . import result_store
from .answer_keys import load_keys
from .collect import Collection
from .csv_table import TableError
from .grades_folder import LearnerPages, write_grades
from .grades_json import count_not_graded, count_open, faults_of, grades_of
from .learners import read_all
from .lms_import import fill_table, read_tables
from .report import count_of, prepare_templates
from .roster import read_roster, roster_report
from .teacher_tables import DECISIONS_TEMPLATE, TeacherRules

_NOT_FILLED = "Not filled: "
_MAX_LINES = 12  # of a run's summary, before the last lines


# What to print after a run; how many submissions were not graded, and pages or tables not written.
GradingSummary = namedtuple("GradingSummary", ("text", "not_graded", "failed_pages"))


def grade_submissions(
    submissions,
    keys,
    out,
    *,
    deadline=None,
    late=None,
    extensions=None,
    decisions=None,
    anonymous=False,
    open_as_zero=False,
    fresh=False,
    scheduler=None,
    platform_tables=(),
    roster=None,
    layouts=(),
    quiet=None,
    **options,
):
    """Grade submissions, and write the folder of grades; returns a GradingSummary.

    The options are those of the command `grade`; in addition:

    deadline  a local datetime
    quiet     True for no progress bars; None: none if stderr is no terminal
    options   unsafe, workers, limits, executor, as `autograde` takes them

    CollectError, KeyFolderError, SandboxError and other ValueErrors are one line with the remedy.
    """
    out, submissions = Path(out), Path(submissions)
    answer_keys = load_keys(keys)
    _require_separate_folder(submissions, keys, out)
    platform_tables = read_tables(platform_tables)
    unsafe = options.get("unsafe", False)
    if not unsafe and scheduler is None:
        bubblewrap.require_sandbox()
    roster = read_roster(roster) if roster else None
    with contextlib.ExitStack() as stack:
        collection = stack.enter_context(Collection(submissions, tuple(answer_keys.lessons), layouts or ()))
        stack.enter_context(result_store.open_grades_folder(out))
        if not decisions:  # the table in the folder, which is never written again
            decisions = out / "decisions.csv"
            if not decisions.exists():
                result_store.write_grades_file(decisions, DECISIONS_TEMPLATE)
        rules = TeacherRules(
            answer_keys, deadline=deadline, late=late, extensions=extensions, decisions=decisions
        )
        store = result_store.ResultStore(out / "results", {"unsafe": unsafe})
        if scheduler is not None:
            options["executor"] = stack.enter_context(open_scheduler(scheduler))
        learners = read_all(collection, answer_keys, store, quiet=quiet)
        rules.assign(learners, roster or ())
        pages = LearnerPages(out, learners, answer_keys, store, rules, anonymous=anonymous)
        stack.callback(pages.parts.close)
        threading.Thread(target=prepare_templates, daemon=True).start()
        options |= {"fresh": fresh, "quiet": quiet, "on_result": pages.result_stored}
        graded_now = result_store.grade_missing(learners, answer_keys, store, **options)
        about = {"sandbox": not unsafe, "anonymous_pages": anonymous, "open_as_zero": open_as_zero}
        about["roster"] = roster_report(roster, learners) if roster is not None else None
        grades = grades_of(pages.finish(), answer_keys, rules, collection, about)
        changes = write_grades(out, grades, pages)
        table_lines = _fill_tables(platform_tables, grades, out)
    return _summary(grades, graded_now, out, changes, table_lines, pages.failed)


def who_sent_what(submissions, keys, *, layouts=(), quiet=None):
    """The text of `grade --dry-run`: each learner's files, which of them count, and what is left out.

    Nothing is graded or written; the errors are those of `grade_submissions`.
    """
    answer_keys = load_keys(keys)
    with tempfile.TemporaryDirectory() as results, contextlib.ExitStack() as stack:
        collection = stack.enter_context(Collection(submissions, tuple(answer_keys.lessons), layouts or ()))
        store = result_store.ResultStore(results, {})
        learners = read_all(collection, answer_keys, store, quiet=quiet)
    lines = [f"layout {collection.layout}: {count_of(len(learners), 'learner')}, nothing graded"]
    for learner in learners:
        lines.append(learner.name)
        for lesson, submission in learner.submissions.items():
            reason = submission.content.reason
            lines.append(f"  {lesson}: {submission.file.source}{reason and f' (not read: {reason})'}")
            if others := [one.file.source for one in learner.earlier.get(lesson, ())]:
                lines.append(f"    not counted: {', '.join(others)}")
        for submission in learner.unidentified:
            lines.append(f"  left out: {submission.file.source}: {submission.content.reason}")
    if collection.ignored:
        lines += ["left out, since they are no notebooks:", *(f"  {name}" for name in collection.ignored)]
    return "\n".join(lines)


def _require_separate_folder(submissions, keys, out):
    """Refuse to write grades among the submissions: the next run would collect them as submissions."""
    folder = out.resolve()
    for path in (submissions.resolve(), *(Path(key).resolve() for key in keys)):
        if folder == path or folder.is_relative_to(path):
            raise ValueError(f"{out}: lies in {path}; name a folder outside it, --out grades")


def _fill_tables(platform_tables, grades, out):
    """Write the platforms' tables with points in them; returns lines for the summary."""
    lines = []
    for table in platform_tables:
        try:
            text, table_lines = fill_table(table, grades)
        except TableError as error:  # the other tables have the points all the same
            lines.append(f"{_NOT_FILLED}{error}")
            continue
        result_store.write_grades_file(out / "exports" / f"filled-{table.path.name}", text)
        lines += table_lines
    return lines


def _summary(grades, graded_now, out, changes, table_lines, failed_pages):
    lessons = [lesson for learner in grades["learners"] for lesson in learner["lessons"]]
    graded = sum(lesson["status"] == "graded" for lesson in lessons)
    late = sum(lesson["late"] for lesson in lessons)
    not_graded = count_not_graded(grades)
    others = "; the others equal one of these, or were graded before" if graded_now < graded else ""
    lines = [
        f"{count_of(len(grades['learners']), 'learner')}, {count_of(graded, 'lesson')} graded"
        f" ({graded_now} in this run{others}), {late} late,"
        f" {not_graded} could not be graded. Layout: {grades['layout']}."
    ]
    if roster := grades["roster"]:
        lines[0] += f" Of {roster['count']} in the roster, {len(roster['missing'])} have not submitted."
        if roster["unknown"]:
            unknown = count_of(len(roster["unknown"]), "learner")
            lines[0] += f" Not in it: {unknown} (summary.html names them)."
    for learner in grades["learners"]:
        for lesson in learner["lessons"]:
            if lesson["status"] != "graded":
                lines.append(f"  {learner['name']}: {lesson['file']}: {lesson['reason']}")
            elif fault := next(faults_of(lesson), None):
                lines.append(f"  {learner['name']}: {lesson['file']}: {fault}; run the command again")
    if len(lines) > _MAX_LINES:
        lines[_MAX_LINES - 1 :] = [f"  and {len(lines) - _MAX_LINES + 1} more"]
    lines += [f"The page of {name} is incomplete ({reason})." for name, reason in failed_pages.items()]
    if waiting := count_open(grades):
        lines.append(f"{count_of(waiting, 'answer')} still to be graded by a person: --review.")
    if not grades["sandbox"]:
        lines.append("Graded without a sandbox; grades.json records it.")
    lines += changes + table_lines
    width = shutil.get_terminal_size().columns * 3
    places = f"Points: {out}/grades.csv   Your page: {out}/summary.html   Pages to give back: {out}/learners/"
    lines = [*(line[:width] for line in lines), places]
    not_filled = sum(line.startswith(_NOT_FILLED) for line in table_lines)
    return GradingSummary("\n".join(lines), not_graded, len(failed_pages) + not_filled)
