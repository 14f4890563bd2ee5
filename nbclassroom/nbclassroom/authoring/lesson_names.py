"""Names of lessons, alone and in the names of files, folders and tables: "ada_03_grayscale-1".

The name decides, never the number: the number is only a lesson's place in the course, which changes.
"""

import re
from functools import lru_cache

# Some browsers save a notebook as text: 04_grayscale.ipynb.txt, and once more as 04_grayscale.ipynb (1).txt.
_NOTEBOOK = re.compile(r"(?P<stem>.+)\.ipynb(?:(?P<copy> ?\(\d{1,6}\))?\.(?:txt|json))?", re.S | re.I)
_REPEATED = re.compile(r"(?P<stem>.+?)(?:-\d{1,6}|[ _]?\((?P<copy>\d{1,6})\))", re.S)
_COPY_WORDS = re.compile(  # as Google Drive, Windows, macOS and JupyterLab write them
    r"(?:copy of|kopie von|copie de|copia de) (?P<of>.+)"
    r"|(?P<stem>.*?)(?:^| - | |-)(?:copy|kopie|copie|copia)(?: ?\d{1,6}| \(\d{1,6}\))?",
    re.S | re.I,
)
LESSON_FILE = re.compile(r"(?P<number>\d\d)_(?P<name>(?!\d\d_)[a-z0-9_]+)")


def lesson_name(text):
    """The name of a lesson without its number: "04_grayscale" and "grayscale" give "grayscale"."""
    match = LESSON_FILE.fullmatch(text)
    return match["name"] if match else text


def lessons_named(text, lessons):
    """The lessons whose names are whole words of a text; of grayscale and grayscale_node the longer one."""
    return list(dict.fromkeys(match[1] for match in _pattern(tuple(lessons)).finditer(text)))


def notebook_name(name):
    """The name of a file; of a notebook, also if a browser saved it as text, with .ipynb at the end."""
    match = _NOTEBOOK.fullmatch(name)
    return f"{match['stem']}{match['copy'] or ''}.ipynb" if match else name


def split_repetition(stem):
    """A stem without the mark of a repeated file, "-1" or " (2)", and the number of "(2)"; else 0."""
    match = _REPEATED.fullmatch(stem)
    return (match["stem"], int(match["copy"] or 0)) if match else (stem, 0)


def _without_copy_words(name):
    """A name without what says that its file is a copy: "Copy of ada", "ada - Kopie (2)", "ada-Copy1"."""
    match = _COPY_WORDS.fullmatch(name)
    return _without_copy_words(match["of"] or match["stem"]) if match else name


def name_in_stem(stem, lessons):
    """A file's stem without the lesson's name, "" if nothing else is in it.

    student-1 and student-2 are two learners; ada_04_grayscale and ada_04_grayscale-1 are both ada's.
    """
    stem = _without_copy_words(stem)
    unnumbered, _ = split_repetition(stem)
    named = lessons_named(unnumbered, lessons)
    if not named:
        return stem
    text = unnumbered if unnumbered.endswith(named[-1]) else stem
    return _pattern(tuple(lessons)).sub("", text, count=1).strip(" -_.")


@lru_cache(maxsize=16)
def _pattern(lessons):
    names = "|".join(map(re.escape, sorted(lessons, key=len, reverse=True))) or r"(?!)"
    return re.compile(rf"(?<![a-z0-9])(?:\d\d_)?({names})(?![a-z0-9])")
