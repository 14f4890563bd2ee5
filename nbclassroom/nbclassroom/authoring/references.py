"""The glossary, and references in masters: `[[grayscale]]` names a lesson, `[[term:mask]]` a term.

In prose a reference becomes a link. In code and in the texts of exercises it becomes plain text.

    [[grayscale]]           [lesson 04, Grayscale](04_grayscale.ipynb)                lesson 04
    [[grayscale#3]]         [section 3 of lesson 04](04_grayscale.ipynb#cell-id=...)  section 3 of lesson 04
    [[grayscale|any text]]  [any text](04_grayscale.ipynb)                            any text
    [[term:mask|masks]]     [masks](glossary.md#mask)                                masks

The glossary, `masters/glossary.toml`, explains each word of the field.

["structuring element"]                  the term, as it is written in the middle of a sentence
lesson = "canny_stages"                  the lesson that introduces it
definition = "One to three sentences."   Markdown, with references to lessons and to other terms
spellings = ["structuring elements"]     other forms of the word, and words that the entry explains too
ordinary = true                          also an ordinary English word, which `early_uses` does not look for
"""

import difflib
import io
import re
import tokenize
import tomllib
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from pathlib import Path

from ..exercises.percent_script import DROPPED_ROLES, MISTAKES_SUFFIX, MasterError, read_script
from .lesson_names import lesson_name

GLOSSARY = "glossary.toml"
GLOSSARY_PAGE = "glossary.md"  # no notebook: JupyterLab draws hundreds of cells late
_KEYS = {"lesson", "definition", "spellings", "ordinary"}
_INTRODUCTION = """\
# Glossary

The words of this course, from A to Z. Each entry ends with the lesson that introduces the word.

**Ctrl + F** finds a word on this page."""
_IN_PROSE = re.compile(
    r"(?P<code>(?<!`)(?P<ticks>`{1,3})(?!`).+?(?<!`)(?P=ticks)(?!`))|\[\[(?P<target>[A-Za-z][^\[\]]*)\]\]",
    re.S,
)
_IN_CODE = re.compile(r"\[\[(?P<target>(?:term:[^\[\]]+|[a-z][a-z0-9_]+(?:#\d+)?(?:\|[^\[\]]+)?))\]\]")
_TITLE = re.compile(r"^#\s+title:\s*(.+?)\s*$", re.M)
_AT_START = re.compile(r"(?:\A|\n[^\S\n]*\n|[.!?] )\Z")
_WITH_WORDS = {tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}


class References:
    """The references of the master with this path, to the lessons and the glossary of its folder."""

    def __init__(self, path):
        self._path = Path(path)

    @cached_property
    def _lessons(self):
        """{name of a lesson: its master}"""
        files = sorted(self._path.parent.glob("[0-9][0-9]_*.py"))
        return {lesson_name(file.stem): file for file in files if lesson_name(file.stem) != file.stem}

    @cached_property
    def _terms(self):
        return {form: term for term in read_glossary(self._path.with_name(GLOSSARY)) for form in term.forms}

    def in_prose(self, text):
        """Markdown with links; code spans stay as they are."""

        def replacement(match):
            if match["code"]:
                return match[0]
            label, address = self._resolve(match["target"], in_prose=True)
            return f"[{_capitalized(label, match, text)}]({address})"

        return _IN_PROSE.sub(replacement, text)

    def in_text(self, text):
        """A text with plain words in place of references."""
        return _IN_CODE.sub(lambda match: _capitalized(self._resolve(match["target"])[0], match, text), text)

    def in_code(self, source):
        """Code whose comments and strings have plain words in place of references."""
        if not _IN_CODE.search(source):
            return source
        try:
            tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))
        except (tokenize.TokenError, SyntaxError):  # a cell with a magic
            return self.in_text(source)
        starts = list(accumulate(map(len, source.splitlines(keepends=True)), initial=0))
        for token in reversed(tokens):
            if token.type in _WITH_WORDS:
                begin = starts[token.start[0] - 1] + token.start[1]
                end = starts[token.end[0] - 1] + token.end[1]
                source = source[:begin] + self.in_text(source[begin:end]) + source[end:]
        return source

    def _resolve(self, target, *, in_prose=False):
        """(the words, the address) of what stands between the brackets."""
        name, _, label = target.partition("|")
        if name.startswith("term:"):
            word = name.removeprefix("term:")
            return label or word, self._find("term", word.casefold(), self._terms, target).address
        name, _, section = name.partition("#")
        path = self._find("lesson", name, self._lessons, target)
        address, number = f"{path.stem}.ipynb", path.stem[:2]
        if section:
            address += f"#cell-id={self._section_cell(path, section, target)}"
            return label or f"section {section} of lesson {number}", address
        return label or f"lesson {number}" + (f", {_title(path)}" if in_prose else ""), address

    def _find(self, kind, name, known, target):
        if name in known:
            return known[name]
        nearest = difflib.get_close_matches(name, list(known), n=1, cutoff=0.4)
        advice = f"there are: {', '.join(sorted(known)) or 'none'}"
        if nearest:
            advice = f"did you mean {nearest[0]}?"
        raise MasterError(f"{self._place(target)}: [[{target}]] names no {kind}; {advice}")

    def _section_cell(self, path, section, target):
        heading = re.compile(rf"^#+ {section}\b", re.M)
        cells = (cell for cell in read_script(path).cells if cell.role not in DROPPED_ROLES)
        for position, cell in enumerate(cells, 1):
            if cell.kind == "markdown" and heading.search(cell.source):
                return f"{lesson_name(path.stem)}-{position}"
        raise MasterError(f"{self._place(target)}: {path.name} has no section {section}")

    def _place(self, target):
        places = (
            f"{file.name}, line {number}"
            for file in (self._path, self._path.with_suffix(MISTAKES_SUFFIX))
            if file.exists()
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1)
            if f"[[{target}]]" in line
        )
        return next(places, self._path.name)


def _title(path):
    match = _TITLE.search(path.read_text(encoding="utf-8"))
    return match[1].strip("\"'") if match else lesson_name(path.stem).replace("_", " ").capitalize()


def _capitalized(words, match, text):
    """The words, with a capital letter if they begin a sentence."""
    return words[:1].upper() + words[1:] if _AT_START.search(text[: match.start()]) else words


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


def glossary_page(path):
    """The glossary as learners read it, in Markdown: a heading per term, to which the lessons link."""
    terms = read_glossary(path)
    entries = [f"### {term.name}\n\n{term.definition}\n\n→ [[{term.lesson}]]" for term in terms]
    return "\n\n".join([_INTRODUCTION, *map(References(path).in_prose, entries)]) + "\n"
