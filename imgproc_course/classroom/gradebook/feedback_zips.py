"""The pages as zips: those that Moodle and Canvas hand out themselves, one per lesson; else one per learner.

exports/moodle-feedback-<lesson>.zip
    for "Upload multiple feedback files in a zip". Moodle reads the participant's number and the kind of file
    from the folder's name, Ada Lovelace_12345_assignsubmission_file
exports/canvas-feedback-<lesson>.zip
    for "Re-Upload Submissions". Canvas reads the numbers of the learner and of the submitted file from the
    file's name, lovelaceada_77_100_20_light.html, and attaches the page to the submission as a comment
exports/feedback-<learner>.zip
    of a learner who submitted through no platform: nobody else's page is in it
"""

import io
import zipfile
from pathlib import PurePosixPath

from .lms_export import lessons_of


def feedback_zips(grades, read_page):
    """{file name: bytes} of all zips; `read_page` gives the bytes of the page of a learner's entry."""
    members, lessons = {}, lessons_of(grades)
    for learner in grades["learners"]:
        page = PurePosixPath(learner["page"])
        if not any(lesson["platform"] for lesson in learner["lessons"]):
            members[f"feedback-{page.stem}.zip"] = [(page.name, learner)]
        for lesson in learner["lessons"]:
            if lesson["platform"] and lesson["file"] and lesson["lesson"] in lessons:
                archive = f"{lesson['platform']}-feedback-{lesson['lesson']}.zip"
                members.setdefault(archive, []).append((_member(learner, lesson), learner))
    return {archive: _zip(names, read_page) for archive, names in members.items()}


def _member(learner, lesson):
    if lesson["platform"] == "canvas":
        # A learner's own folders and zips come after Canvas's name.
        parts = PurePosixPath(lesson["file"]).parts
        name = next((part for part in parts if f"_{lesson['platform_id']}_" in part), parts[-1])
        return f"{name.removesuffix('.ipynb').removesuffix('.zip')}.html"
    # Moodle splits the name at its underscores.
    name = learner["name"].replace("_", " ").replace("/", " ")
    return f"{name}_{lesson['platform_id']}_assignsubmission_file/feedback.html"


def _zip(members, read_page):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, learner in members:
            # A ZipInfo has no date of today: the same pages give the same bytes.
            archive.writestr(zipfile.ZipInfo(name), read_page(learner), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
