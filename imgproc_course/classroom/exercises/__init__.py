"""Exercises: declared in a master, checked in the learner's notebook, graded by the instructor."""

from imgproc_course.classroom.exercises.canonical import array_of
from imgproc_course.classroom.exercises.cell_runs import watch_cells
from imgproc_course.classroom.exercises.check_files import CheckFileError
from imgproc_course.classroom.exercises.checking import CheckResult, check, run_cases
from imgproc_course.classroom.exercises.declaration import MasterError, exercise, read_exercises
from imgproc_course.classroom.exercises.drive_check import with_progress
from imgproc_course.classroom.exercises.guesses import GuessComparison, compare_guess
from imgproc_course.classroom.exercises.help_steps import hint, solution
from imgproc_course.classroom.exercises.overview import Overview, overview
from imgproc_course.classroom.exercises.ros_double import offer_modules

__all__ = [
    "CheckFileError",
    "CheckResult",
    "GuessComparison",
    "MasterError",
    "Overview",
    "array_of",
    "check",
    "compare_guess",
    "exercise",
    "hint",
    "offer_modules",
    "overview",
    "read_exercises",
    "run_cases",
    "solution",
    "with_progress",
]

watch_cells()
