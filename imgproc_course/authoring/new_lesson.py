"""A first master for a teacher's own lesson: it builds, and it grades, before a word of it is changed."""

import re
from pathlib import Path

from imgproc_course.authoring.masters import LESSON_NAME
from imgproc_course.exercises.declaration import MasterError

TEMPLATE = Path(__file__).with_name("new_lesson.py.txt")


def new_lesson(name, folder):
    """Write a template master.

    Parameters
    ----------
    name : str, "brightness", or "10_brightness"; without a number it gets the folder's next one from 10 on
    folder : Path, made where it is not there

    Returns
    -------
    Path of the master

    Raises
    ------
    MasterError : a name that no lesson can have, or a lesson that is there already
    """
    folder = Path(folder)
    words = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
    if words and not LESSON_NAME.fullmatch(words):
        words = f"{_next_number(folder):02d}_{words}"
    if not LESSON_NAME.fullmatch(words):
        raise MasterError(f"{name!r} cannot name a lesson; letters and digits can: brightness, 10_brightness")
    path = folder / f"{words}.py"
    plain = words[3:]
    text = TEMPLATE.read_text(encoding="utf-8")
    text = text.replace("LESSON-TITLE", plain.replace("_", " ").capitalize())
    text = text.replace("LESSON-ID", plain.replace("_", "-"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError as error:
        raise MasterError(f"{path}: there is a lesson of that name; choose another one") from error
    except OSError as error:
        raise MasterError(f"{path}: cannot be written ({error.strerror})") from error
    return path


def _next_number(folder):
    taken = {int(path.name[:2]) for path in folder.glob("*.py") if LESSON_NAME.fullmatch(path.stem)}
    free = (number for number in range(10, 100) if number not in taken)
    return next(free, 99)
