"""Write the folder of grades.

grades.json        everything, as grades.schema.json describes it
grades.csv         one row per learner and lesson, for a spreadsheet
summary.html       the teacher's page
learners/*.html    one page per learner, to give back
predictions.html   what learners predicted
changes.html       what changed since the grades that differed last, which are in grades.previous.json
decisions.csv      the teacher's decisions; only read, once it is there
exports/           for Moodle, Canvas, and programs that read nbgrader's table
results/*.json     every result, by a digest of key and answers: an interrupted run continues from here
"""

from pathlib import Path

from imgproc_course.autograder.sanitize import sanitize_line
from imgproc_course.gradebook.anonymity import without_names
from imgproc_course.gradebook.changes import PREVIOUS, changes_page, read_grades
from imgproc_course.gradebook.feedback_zips import feedback_zips
from imgproc_course.gradebook.grades_json import grades_text
from imgproc_course.gradebook.lms_export import exports, grades_csv
from imgproc_course.gradebook.predictions import predictions_page
from imgproc_course.gradebook.report import learner_page
from imgproc_course.gradebook.result_store import write_grades_file
from imgproc_course.gradebook.summary import summary_page

_OTHER_PAGES = {
    "predictions.html": "What the learners predicted",
    "changes.html": "What changed since the run before",
}


def write_grades(out, grades, learners, answer_keys, store):
    """Write everything but the results, which are stored while grading.

    Parameters
    ----------
    out : Path
    grades : dict, the content of grades.json
    learners : list of Learner, in the order of grades["learners"]
    answer_keys : AnswerKeys
    store : ResultStore

    Returns
    -------
    {learner's name: why their page lacks its details}

    Raises
    ------
    GradesFolderError : the disk is full or read-only
    """
    before, text = read_grades(out / "grades.json"), grades_text(grades)
    write_grades_file(out / "grades.json", text)
    write_grades_file(out / "grades.csv", grades_csv(grades))
    shown = without_names(grades) if grades["anonymous_pages"] else grades
    failed_pages = {}
    for learner, entry in zip(learners, shown["learners"], strict=True):
        page, reason = _page_or_reason(learner, entry, answer_keys, store, grades["late_policy"])
        write_grades_file(out / entry["page"], page)
        if reason:
            failed_pages[entry["name"]] = reason
    _remove_others(out / "learners", "*.html", {Path(entry["page"]).name for entry in grades["learners"]})
    names = {
        entry["name"]: shown_entry["name"]
        for entry, shown_entry in zip(grades["learners"], shown["learners"], strict=True)
    }
    if (
        before and grades_text(before) != text
    ):  # after the same grades again, the page of the change before stays
        write_grades_file(out / PREVIOUS, grades_text(before))
        write_grades_file(out / "changes.html", changes_page(before, grades, names))
    _write_or_remove(out / "predictions.html", predictions_page(learners, answer_keys.lessons, names))
    files = exports(grades) | feedback_zips(grades, lambda entry: (out / entry["page"]).read_bytes())
    for name, data in files.items():
        write_grades_file(out / "exports" / name, data)
    for pattern in ("*.csv", "*.zip"):
        _remove_others(out / "exports", pattern, files)
    other_pages = {name: title for name, title in _OTHER_PAGES.items() if (out / name).exists()}
    write_grades_file(out / "summary.html", summary_page(shown, failed_pages, other_pages))
    return failed_pages


def _write_or_remove(path, page):
    if page:
        write_grades_file(path, page)
    else:
        path.unlink(missing_ok=True)


def _page_or_reason(learner, entry, answer_keys, store, late_policy):
    """(the learner's page, ""), or (a page without values, why): one learner's values harm no other page."""
    try:
        results = {
            lesson: store.result(submission.answers_digest)
            for lesson, submission in learner.submissions.items()
            if submission.answers_digest
        }
        return learner_page(entry, results, answer_keys, late_policy=late_policy), ""
    except Exception as error:  # noqa: BLE001 - a page shows values that other people's code returned
        reason = sanitize_line(f"{type(error).__name__}: {error}", 200)
        return learner_page(entry, {}, answer_keys, incomplete=True), reason


def _remove_others(folder, pattern, names):
    """Remove the files of an earlier run: pages of learners who are gone would be given back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in names:
            path.unlink()
