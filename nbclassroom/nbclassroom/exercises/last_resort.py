"""The last resort of `check`, `hint` and `solution`: of an error of the course's own a sentence."""

import traceback
from pathlib import Path

from .. import course
from .check_files import CheckFileError
from .source_remarks import SAYS


def with_last_resort(exercise_id, show, otherwise):
    """What show() gives; after an error that is none for learners what otherwise(a sentence on it) gives."""
    try:
        return show()
    except CheckFileError:
        raise
    except Exception as error:  # noqa: BLE001 - whatever it is, nobody shall lose a lesson to it
        return otherwise(_sentence(error, exercise_id))


def _sentence(error, exercise_id):
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(place.filename).stem}, line {place.lineno}"
    parts = {"course": course.name, "version": course.release()}
    return SAYS["fault"].format(**parts, id=exercise_id, error=type(error).__name__, place=where)
