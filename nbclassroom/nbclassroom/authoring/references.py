"""References in masters: `[[grayscale]]` names a lesson, `[[term:mask]]` a term of the glossary.

In prose a reference becomes a link. In code and in the texts of exercises it becomes plain text.

    [[grayscale]]           [lesson 04, Grayscale](04_grayscale.ipynb)                lesson 04
    [[grayscale#3]]         [section 3 of lesson 04](04_grayscale.ipynb#cell-id=...)  section 3 of lesson 04
    [[grayscale|any text]]  [any text](04_grayscale.ipynb)                            any text
    [[term:mask|masks]]     [masks](glossary.md#mask)                                masks
"""

import difflib
import io
import re
import tokenize
from functools import cached_property
from itertools import accumulate
from pathlib import Path

from ..exercises.percent_script import DROPPED_ROLES, MISTAKES_SUFFIX, MasterError, read_script
from .glossary import GLOSSARY, read_glossary
from .lesson_names import lesson_name

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
        files = (self._path, self._path.with_suffix(MISTAKES_SUFFIX))
        places = (
            f"{file.name}, line {number}"
            for file in files
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
