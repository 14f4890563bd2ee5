"""Names of lessons, alone and in the names of files, folders and tables: "ada_03_grayscale-1".

The name decides, never the number: the number is only a lesson's place in the course, which changes.
"""

import re
from functools import lru_cache

LESSON_FILE = re.compile(r"(?P<number>\d\d)_(?P<name>(?!\d\d_)[a-z0-9_]+)")


def lesson_name(text):
    """The name of a lesson without its number: "04_grayscale" and "grayscale" give "grayscale"."""
    match = LESSON_FILE.fullmatch(text)
    return match["name"] if match else text


def lessons_named(text, lessons):
    """The lessons whose names are whole words of a text; of grayscale and grayscale_node the longer one."""
    return list(dict.fromkeys(match[1] for match in _pattern(tuple(lessons)).finditer(text)))


def is_lesson(text, lessons):
    """Whether a text is the name of a lesson, with or without a number."""
    return lesson_name(text) in lessons or lesson_name(text) != text


def without_lesson(text, lessons):
    """A text without the first name of a lesson in it, and without the separators around that name."""
    return _pattern(tuple(lessons)).sub("", text, count=1).strip(" -_.")


@lru_cache(maxsize=16)
def _pattern(lessons):
    names = "|".join(map(re.escape, sorted(lessons, key=len, reverse=True))) or r"(?!)"
    return re.compile(rf"(?<![a-z0-9])(?:\d\d_)?({names})(?![a-z0-9])")
