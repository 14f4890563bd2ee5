"""Values in a report: an answer's canonical form as a small table or a line of text."""

from dataclasses import dataclass

from imgproc_course.classroom.autograder.sanitize import sanitize_line
from imgproc_course.classroom.exercises.values import describe_value, table_rows

_MOST_CHARACTERS = 400


@dataclass(frozen=True)
class Value:
    """A value in a report: its label, its description, and for a small array rows of (text, differs)."""

    label: str
    description: str
    rows: tuple = ()


def value_of(label, form, wrong=None):
    """The Value of a canonical form, or of None; `wrong` is a bool array: which elements differ."""
    if form is None:
        return Value(label, "nothing was returned")
    return Value(label, sanitize_line(describe_value(form), _MOST_CHARACTERS), table_rows(form, wrong))
