"""What a lesson imports of the exercises: the names that `nbclassroom.exercises` lists."""

from imgproc_course.course_file import COURSE_FILE

try:
    from nbclassroom import course
except ModuleNotFoundError as error:
    what = "the exercises need nbclassroom, which is not installed: pip install ./nbclassroom in the checkout"
    raise ModuleNotFoundError(f"{what} of the course", name=error.name) from error

course.use(COURSE_FILE)

from nbclassroom.exercises import *  # noqa: E402, F403
