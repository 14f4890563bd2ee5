"""What a lesson imports of the exercises; `imgproc_course.classroom.exercises` has the code."""

from imgproc_course.classroom.exercises import (
    CheckFileError,
    CheckResult,
    GuessComparison,
    Overview,
    check,
    compare_guess,
    exercise,
    hint,
    offer_modules,
    overview,
    solution,
    with_progress,
)

__all__ = [
    "CheckFileError",
    "CheckResult",
    "GuessComparison",
    "Overview",
    "check",
    "compare_guess",
    "exercise",
    "hint",
    "offer_modules",
    "overview",
    "solution",
    "with_progress",
]
