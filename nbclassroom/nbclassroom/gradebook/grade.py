"""Grade a folder of submissions, from the submitted files to the pages that learners get back.

docs/teach/reference.md says what is in the folder of grades. An interrupted run continues from its results;
the grades that differed last are in grades.previous.json.
"""

import contextlib
import json
import shutil
import tempfile
import threading
import time
from collections import namedtuple
from functools import partial
from itertools import chain
from pathlib import Path

from tqdm import tqdm

from ..autograder.outcomes import Outcome
from ..autograder.pool import autograde, open_scheduler
from ..autograder.sandbox import bubblewrap
from ..autograder.sanitize import sanitize_line
from . import grades_json, result_store
from .answer_keys import AnswerKeys
from .collect import Collection
from .csv_table import TableError
from .learners import read_all
from .platforms import feedback_zips, fill_table, grades_csv, read_tables
from .report import FOLDER, AnswerParts, count_of, learner_page, points_text, prepare_templates, review_pages
from .roster import read_roster, roster_report
from .summary import summary_page
from .teacher_tables import DECISIONS_TEMPLATE, TeacherRules

PREVIOUS = "grades.previous.json"
_MOST_CHANGES = 20  # lines
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
    **options,
):
    """Grade submissions, and write the folder of grades; returns a GradingSummary.

    The options are those of the command `grade`; in addition:

    deadline  a local datetime
    options   unsafe, workers, limits, executor, as `autograde` takes them

    CollectError, KeyFolderError, SandboxError and other ValueErrors are one line with the remedy.
    """
    out, submissions = Path(out), Path(submissions)
    answer_keys = AnswerKeys(keys)
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
        learners = read_all(collection, answer_keys, store)
        rules.assign(learners, roster or ())
        pages = LearnerPages(out, learners, answer_keys, store, rules, anonymous=anonymous)
        stack.callback(pages.parts.close)
        threading.Thread(target=prepare_templates, daemon=True).start()
        graded_now = grade_missing(learners, answer_keys, store, pages.result_stored, fresh, options)
        about = {"sandbox": not unsafe, "anonymous_pages": anonymous, "open_as_zero": open_as_zero}
        about["roster"] = roster_report(roster, learners) if roster is not None else None
        grades = grades_json.grades_of(pages.finish(), answer_keys, rules, collection, about)
        changes = write_grades(out, grades, pages, answer_keys.solutions)
        table_lines = _fill_tables(platform_tables, grades, out)
    return _summary(grades, graded_now, out, changes, table_lines, pages.failed)


def grade_missing(learners, answer_keys, store, on_result, fresh, options):
    """Grade what has no result, or all if `fresh`, equal answers once; the number of those graded now."""
    digests = sorted({digest for learner in learners for digest in learner.digests.values()})
    missing = [digest for digest in digests if fresh or store.result(digest) is None]
    done, about = len(digests) - len(missing), {"desc": "grading", "unit": " submissions"}
    with tqdm(total=len(digests), initial=done, disable=None, **about) as bar:
        threading.Thread(target=show_time, args=(bar,), daemon=True).start()
        keys = {digest: answer_keys.key_of(store.page(digest)[0]) for digest in missing}
        submissions = ((digest, *store.page(digest)[1:]) for digest in missing)
        for result in autograde(submissions, keys, **options):
            store.keep_result(result.name, result)
            bar.update()
            on_result(result.name)
    return len(missing)


def show_time(bar):
    """Show each second that passes: a submission whose robot drives takes a minute."""
    while not bar.disable:  # a closed bar is disabled
        time.sleep(1)
        bar.refresh()


def who_sent_what(submissions, keys, *, layouts=()):
    """The text of `grade --dry-run`: each learner's files, which of them count, and what is left out.

    Nothing is graded or written; the errors are those of `grade_submissions`.
    """
    answer_keys = AnswerKeys(keys)
    with tempfile.TemporaryDirectory() as results, contextlib.ExitStack() as stack:
        collection = stack.enter_context(Collection(submissions, tuple(answer_keys.lessons), layouts or ()))
        learners = read_all(collection, answer_keys, result_store.ResultStore(results, {}))
    lines = [f"layout {collection.layout}: {count_of(len(learners), 'learner')}, nothing graded"]
    for learner in learners:
        lines.append(learner.name)
        for lesson, submission in learner.submissions.items():
            reason = submission.reason
            lines.append(f"  {lesson}: {submission.file.source}{reason and f' (not read: {reason})'}")
            if others := [one.file.source for one in learner.earlier.get(lesson, ())]:
                lines.append(f"    not counted: {', '.join(others)}")
        for submission in learner.unidentified:
            lines.append(f"  left out: {submission.file.source}: {submission.reason}")
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
    waiting = sum(exercise["open_points"] > 0 for lesson in lessons for exercise in lesson["exercises"])
    not_graded = list(_not_graded(grades["learners"]))
    others = "; the others equal one of these, or were graded before" if graded_now < graded else ""
    lines = [
        f"{count_of(len(grades['learners']), 'learner')}, {count_of(graded, 'lesson')} graded"
        f" ({graded_now} in this run{others}), {late} late,"
        f" {len(not_graded)} could not be graded. Layout: {grades['layout']}."
    ]
    if roster := grades["roster"]:
        lines[0] += f" Of {roster['count']} in the roster, {len(roster['missing'])} have not submitted."
        if roster["unknown"]:
            unknown = count_of(len(roster["unknown"]), "learner")
            lines[0] += f" Not in it: {unknown} (summary.html names them)."
    lines += not_graded[: _MAX_LINES - 1]
    if more := not_graded[_MAX_LINES - 1 :]:
        lines[-1] = f"  and {len(more) + 1} more"
    lines += [f"The page of {name} is incomplete ({reason})." for name, reason in failed_pages.items()]
    if waiting:
        lines.append(f"{count_of(waiting, 'answer')} still to be graded by a person: --review.")
    if not grades["sandbox"]:
        lines.append("Graded without a sandbox; grades.json records it.")
    lines += changes + table_lines
    width = shutil.get_terminal_size().columns * 3
    places = f"Points: {out}/grades.csv   Your page: {out}/summary.html   Pages to give back: {out}/learners/"
    lines = [*(line[:width] for line in lines), places]
    not_filled = sum(line.startswith(_NOT_FILLED) for line in table_lines)
    return GradingSummary("\n".join(lines), len(not_graded), len(failed_pages) + not_filled)


def _not_graded(learners):
    """A line for each lesson of which all or a case could not be graded, and nobody decided it."""
    for learner in learners:
        for lesson in learner["lessons"]:
            faults = [
                f"{exercise['id']}: {case['message'] or exercise['message']}; run the command again"
                for exercise in lesson["exercises"]
                for case in exercise["cases"]
                if case["outcome"] == Outcome.NOT_GRADED and not (exercise["decision"] or lesson["decision"])
            ]
            if lesson["status"] != "graded" or faults:
                reason = [*faults, lesson["reason"]][0]
                yield f"  {learner['name']}: {lesson['file']}: {reason}"


class LearnerPages:
    """Writes the learners' pages, each as soon as all its results are there: the workers grade on meanwhile.

    entries  {learner's name: entry in grades.json}
    failed   {learner's name as pages show it: why their page lacks its details}
    parts    the AnswerParts for the teacher's pages
    """

    def __init__(self, out, learners, answer_keys, store, rules, *, anonymous=False):
        self.entries, self.failed, self.parts = {}, {}, AnswerParts(out)
        self._out, self._learners, self._answer_keys, self._store = out, learners, answer_keys, store
        self._rules, self._anonymous = rules, anonymous
        self._missing = {learner.name: set(learner.digests.values()) for learner in learners}

    def result_stored(self, digest):
        """Write the pages that waited only for this result."""
        for learner in self._learners:
            if self._missing[learner.name] == {digest}:
                self._write(learner)
            self._missing[learner.name].discard(digest)

    def finish(self):
        """Write all other pages, and remove those of an earlier run; returns the entries of all learners."""
        for learner in self._learners:
            if learner.name not in self.entries:
                self._write(learner)
        pages = {Path(entry["page"]).name for entry in self.entries.values()}
        _remove_others(self._out / "learners", "*.html", pages)
        return [self.entries[learner.name] for learner in self._learners]

    def _write(self, learner):
        entry = grades_json.learner_entry(
            learner, self._answer_keys, self._store, self._rules, anonymous=self._anonymous
        )
        self.entries[learner.name] = entry
        page_entry = grades_json.learner_without_name(entry) if self._anonymous else entry
        try:
            results = {lesson: self._store.result(digest) for lesson, digest in learner.digests.items()}
            pages = [self._store.page(digest)[2] for digest in learner.digests.values()]
            answers = dict(chain.from_iterable(page["answers"].items() for page in pages))
            keep = partial(self.parts.keep, entry["page"], answers)
            page = learner_page(page_entry, results, self._answer_keys, self._rules.policy, keep=keep)
        except Exception as error:  # noqa: BLE001 - a page shows values that other people's code returned
            self.failed[page_entry["name"]] = sanitize_line(f"{type(error).__name__}: {error}", 200)
            page = learner_page(page_entry, {}, self._answer_keys, self._rules.policy, incomplete=True)
        result_store.write_grades_file(self._out / entry["page"], page)


def write_grades(out, grades, pages, solutions):
    """Write all but the results and the learners' pages; `solutions` is as in `review_pages`.

    Returns the lines that say whose points changed since the run before.
    """
    before, text = read_grades(out / "grades.json"), grades_json.grades_text(grades)
    result_store.write_grades_file(out / "grades.json", text)
    result_store.write_grades_file(out / "grades.csv", grades_csv(grades))
    page_grades = grades_json.without_names(grades) if grades["anonymous_pages"] else grades
    if before is not None and grades_json.grades_text(before) != text:
        result_store.write_grades_file(out / PREVIOUS, grades_json.grades_text(before))
    _write_review(out, page_grades, pages.parts, solutions)
    files = feedback_zips(grades, lambda entry: (out / entry["page"]).read_bytes())
    for name, data in files.items():
        result_store.write_grades_file(out / "exports" / name, data)
    for pattern in ("*.csv", "*.zip"):
        _remove_others(out / "exports", pattern, files)
    result_store.write_grades_file(out / "summary.html", summary_page(page_grades, pages.failed))
    return changed_points(before, grades) if before else []


def _write_review(out, *about):
    written = set()
    for name, page in review_pages(*about):
        written.add(Path(name).name)
        result_store.write_grades_file(out / name, page)
    _remove_others(out / FOLDER, "*.html", written)
    _remove_others(out, "review.html", written)


def _remove_others(folder, pattern, names):
    """Remove the files of an earlier run: pages of learners who are gone would be given back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in names:
            path.unlink()


def read_grades(path):
    """The content of a grades.json, or None if there is none in today's format."""
    try:
        grades = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return grades if isinstance(grades, dict) and grades.get("format") == grades_json.FORMAT else None


def changed_points(before, after):
    """Lines for the terminal: each lesson whose points differ in two contents of grades.json."""
    old, new = (
        {(who["name"], one["lesson"] or one["file"]): _points(one) for who in own for one in who["lessons"]}
        for own in (before["learners"], after["learners"])
    )
    keys = sorted(old.keys() | new.keys())
    pairs = ((key, old.get(key, "not there"), new.get(key, "not there")) for key in keys)
    lines = [f"  {name}: {lesson}: {one} → {other}" for (name, lesson), one, other in pairs if one != other]
    first = f"{count_of(len(lines), 'lesson')} with other points than in the run before ({PREVIOUS}):"
    more = [f"  and {len(lines) - _MOST_CHANGES} more"] if len(lines) > _MOST_CHANGES else []
    return [first, *lines[:_MOST_CHANGES], *more] if lines else []


def _points(lesson):
    if lesson["status"] == "not graded":
        return f"not graded: {lesson['reason']}"
    if lesson.get("decision") and lesson["decision"]["excused"]:
        return "excused"
    text = points_text(lesson)
    if lesson.get("late_deduction"):
        text += f", {lesson['late_deduction']} deducted because late"
    decided = f", decided by hand; the autograder gives {lesson.get('autograded_points')}"
    return text + (decided if lesson.get("decision") else "")
