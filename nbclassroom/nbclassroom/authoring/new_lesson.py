"""A template master for an instructor's own lesson; it builds and grades as it is."""

import re
from pathlib import Path

from .. import course
from ..exercises.declaration import MasterError
from .lesson_names import LESSON_FILE

TEMPLATE = Path(__file__).with_name("new_lesson.py.txt")


def new_lesson(name, folder):
    """Write a template master, and return its path; MasterError for a name that is taken or impossible.

    A name without a number gets the next free one from 30 on, above the course's own lessons.
    """
    folder = Path(folder)
    stem = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
    if stem and not LESSON_FILE.fullmatch(stem):
        used = {int(path.name[:2]) for path in folder.glob("*.py") if LESSON_FILE.fullmatch(path.stem)}
        stem = f"{min({*range(30, 100)} - used, default=99):02d}_{stem}"
    if not LESSON_FILE.fullmatch(stem):
        raise MasterError(
            f"{name!r} cannot name a lesson; use letters and digits, as in brightness or 30_brightness"
        )
    path, name_part = folder / f"{stem}.py", stem[3:]
    for other in sorted(folder.glob(f"[0-9][0-9]_{name_part}.*py")):  # the number is only its place
        raise MasterError(f"{other}: a lesson with that name exists; choose another name")
    text = TEMPLATE.read_text(encoding="utf-8")
    text = text.replace("LESSON-TITLE", name_part.replace("_", " ").capitalize())
    text = text.replace("COURSE-NAME", course.name).replace("COURSE-FACE", course.face)
    text = text.replace("LESSON-ID", name_part.replace("_", "-"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise MasterError(f"{path}: cannot be written ({error.strerror})") from error
    return path
