"""Where course.toml lies, which tells the classroom what this course is."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
_IN_CHECKOUT = _PACKAGE.parent / "notebooks" / "course.toml"
COURSE_FILE = _IN_CHECKOUT if _IN_CHECKOUT.exists() else _PACKAGE / "course.toml"  # or in a wheel
