"""Write the folder of grades.

grades.json        everything, as grades.schema.json describes it
grades.csv         one row per learner and lesson, for a spreadsheet
summary.html       the teacher's page
learners/*.html    one page per learner, to give back
exports/*.csv      for Moodle, Canvas, and programs that read nbgrader's table
results/*.json     every result, by a digest of key and answers: an interrupted run continues from here
"""

from imgproc_course.autograder.sanitize import sanitize_line
from imgproc_course.gradebook.grades_json import grades_text
from imgproc_course.gradebook.lms_export import exports, grades_csv
from imgproc_course.gradebook.report import learner_page, summary_page
from imgproc_course.gradebook.result_store import write_grades_file


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
    write_grades_file(out / "grades.json", grades_text(grades))
    write_grades_file(out / "grades.csv", grades_csv(grades))
    tables = exports(grades)
    for name, text in tables.items():
        write_grades_file(out / "exports" / name, text)
    _remove_others(out / "exports", "*.csv", tables)
    failed_pages = {}
    for learner, entry in zip(learners, grades["learners"], strict=True):
        page, reason = _page_or_reason(learner, entry, answer_keys, store)
        write_grades_file(out / "learners" / learner.page, page)
        if reason:
            failed_pages[learner.name] = reason
    _remove_others(out / "learners", "*.html", {learner.page for learner in learners})
    write_grades_file(out / "summary.html", summary_page(grades, failed_pages))
    return failed_pages


def _page_or_reason(learner, entry, answer_keys, store):
    """(the learner's page, ""), or (a page without values, why): one learner's values harm no other page."""
    try:
        results = {
            lesson: store.result(submission.answers_digest)
            for lesson, submission in learner.submissions.items()
            if submission.answers_digest
        }
        return learner_page(entry, results, answer_keys), ""
    except Exception as error:  # noqa: BLE001 - a page shows values that other people's code returned
        reason = sanitize_line(f"{type(error).__name__}: {error}", 200)
        return learner_page(entry, {}, answer_keys, incomplete=True), reason


def _remove_others(folder, pattern, names):
    """Remove the files of an earlier run: pages of learners who are gone would be given back by mistake."""
    for path in folder.glob(pattern):
        if path.name not in names:
            path.unlink()
