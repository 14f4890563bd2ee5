"""The glossary: `masters/glossary.toml` explains each word of the field.

["structuring element"]                  the term, as it is written in the middle of a sentence
lesson = "canny_stages"                  the lesson that introduces it
definition = "One to three sentences."   Markdown, with references to lessons and to other terms
spellings = ["structuring elements"]     other forms of the word, optional
"""

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from imgproc_course.exercises.percent_script import MasterError

GLOSSARY = "glossary.toml"


@dataclass(frozen=True)
class Term:
    """A word of the field.

    name        as it is written in the middle of a sentence
    lesson      the name of the lesson that introduces it
    definition  Markdown
    forms       the name and its other spellings, in lower case
    """

    name: str
    lesson: str
    definition: str
    forms: tuple

    @property
    def anchor(self):
        """The fragment of its heading, as JupyterLab makes it."""
        return self.name.replace(" ", "-")


def read_glossary(path):
    """Read a glossary.

    Parameters
    ----------
    path : Path of glossary.toml; without the file there are no terms

    Returns
    -------
    tuple of Term, in alphabetical order

    Raises
    ------
    MasterError : not TOML, or a term without lesson or definition, or two terms with one spelling
    """
    path = Path(path)
    return _read_glossary(path, path.stat().st_mtime_ns) if path.exists() else ()


@lru_cache(maxsize=8)
def _read_glossary(path, _modified):
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise MasterError(f"{path.name}: it is not TOML: {error}") from error
    terms = [_read_term(path, name, entry) for name, entry in entries.items()]
    owners = {}
    for term in terms:
        for form in term.forms:
            if owners.setdefault(form, term.name) != term.name:
                raise MasterError(f"{path.name}: {form!r} belongs to {owners[form]!r} and to {term.name!r}")
    return tuple(sorted(terms, key=lambda term: (term.name.casefold(), term.name)))


def _read_term(path, name, entry):
    place = f"{path.name}: [{name!r}]"
    if not isinstance(entry, dict) or set(entry) - {"lesson", "definition", "spellings"}:
        raise MasterError(f"{place} takes lesson, definition and spellings")
    for key in ("lesson", "definition"):
        if not isinstance(entry.get(key), str) or not entry[key].strip():
            raise MasterError(f'{place} needs {key} = "..."')
    forms = dict.fromkeys(form.casefold() for form in (name, *entry.get("spellings", ())))
    return Term(name, entry["lesson"], entry["definition"].strip(), tuple(forms))
