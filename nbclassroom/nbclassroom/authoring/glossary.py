"""The glossary: `masters/glossary.toml` explains each word of the field.

["structuring element"]                  the term, as it is written in the middle of a sentence
lesson = "canny_stages"                  the lesson that introduces it
definition = "One to three sentences."   Markdown, with references to lessons and to other terms
spellings = ["structuring elements"]     other forms of the word, and words that the entry explains too
ordinary = true                          also an ordinary English word, which `early_uses` does not look for
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from ..exercises.percent_script import MasterError

GLOSSARY = "glossary.toml"
GLOSSARY_PAGE = "glossary.md"  # no notebook: JupyterLab draws hundreds of cells late
_KEYS = {"lesson", "definition", "spellings", "ordinary"}
_INTRODUCTION = """\
# Glossary

The words of this course, from A to Z. Each entry ends with the lesson that introduces the word.

**Ctrl + F** finds a word on this page."""


@dataclass(frozen=True)
class Term:
    name: str  # as it is written in the middle of a sentence
    lesson: str  # that introduces it
    definition: str  # Markdown
    forms: tuple  # the name and its other spellings, in lower case
    ordinary: bool = False  # whether it is also an ordinary English word

    @property
    def address(self):
        """The target of a link to its entry: JupyterLab's name of its heading."""
        return f"{GLOSSARY_PAGE}#{self.name.replace(' ', '-')}"


def read_toml(path):
    """The entries of a TOML file beside the masters; none without the file. MasterError: it is not TOML."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    except tomllib.TOMLDecodeError as error:
        raise MasterError(f"{path.name}: it is not TOML: {error}") from error


def read_glossary(path):
    """The Terms of a glossary.toml in alphabetical order; none without the file. MasterError names faults."""
    path = Path(path)
    terms = [_read_term(path, name, entry) for name, entry in read_toml(path).items()]
    owners: dict[str, str] = {}
    for term in terms:
        for form in term.forms:
            if owners.setdefault(form, term.name) != term.name:
                raise MasterError(f"{path.name}: {form!r} belongs to {owners[form]!r} and to {term.name!r}")
    return tuple(sorted(terms, key=lambda term: (term.name.casefold(), term.name)))


def _read_term(path, name, entry):
    place = f"{path.name}: [{name!r}]"
    if not isinstance(entry, dict) or set(entry) - _KEYS:
        raise MasterError(f"{place} takes only {', '.join(sorted(_KEYS))}")
    for key in ("lesson", "definition"):
        if not isinstance(entry.get(key), str) or not entry[key].strip():
            raise MasterError(f'{place} needs {key} = "..."')
    forms = dict.fromkeys(form.casefold() for form in (name, *entry.get("spellings", ())))
    ordinary = bool(entry.get("ordinary", False))
    return Term(name, entry["lesson"], entry["definition"].strip(), tuple(forms), ordinary)


def glossary_page(terms, references):
    """The glossary as learners read it, in Markdown: a heading per term, to which the lessons link."""
    entries = [f"### {term.name}\n\n{term.definition}\n\n→ [[{term.lesson}]]" for term in terms]
    return "\n\n".join([_INTRODUCTION, *map(references.in_prose, entries)]) + "\n"
