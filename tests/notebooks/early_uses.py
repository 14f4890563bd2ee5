"""Words that a lesson uses before another lesson introduces them."""

import ast
import re
from typing import NamedTuple

from nbclassroom.authoring.references import Term

_CODE_OR_FORMULA = re.compile(r"(`+).+?(?<!`)\1(?!`)|\$\$.+?\$\$|\$[^$\n]+\$", re.S)
_LINK = r"\[(?P<text>[^\]]*)\]\((?P<address>[^)\s]*)\)"
_LESSON = re.compile(r"\d\d_\w+\.ipynb")


class EarlyUse(NamedTuple):
    """A term that a lesson uses before the lesson that introduces it, without a link into the glossary."""

    lesson: str
    cell: str
    words: str
    term: Term

    def __str__(self):
        return f"{self.lesson}: cell {self.cell}: {self.words!r}, which {self.term.lesson} introduces"


def early_uses(masters, terms):
    """The first use of each term in each lesson before the one that introduces it.

    The prose and the captions of figures are read, without code, formulas and links to lessons. After a link
    to a term, `[[term:mask]]`, the lesson may use the term.

    Parameters
    ----------
    masters : sequence of Master, in the order of the course
    terms : sequence of Term

    Returns
    -------
    list of EarlyUse
    """
    places = {master.name: place for place, master in enumerate(masters)}
    owners = {form: term for term in terms for form in term.forms}
    forms = "|".join(re.escape(form) for form in sorted(owners, key=len, reverse=True))
    pattern = re.compile(rf"{_LINK}|(?<![\w-])(?P<form>{forms})(?![\w-])", re.I)
    uses = []
    for master in masters:
        explained = {term for term in terms if term.ordinary or places[term.lesson] <= places[master.name]}
        for cell in master.cells:
            for words, term in _terms_in(master, cell, pattern, owners):
                if words and term not in explained:
                    uses.append(EarlyUse(master.name, cell.id, words, term))
                explained.add(term)
    return uses


def _terms_in(master, cell, pattern, owners):
    """(the words, the term) of each use in a cell; the words are "" in a link to the term."""
    addresses = {term.address: term for term in owners.values()}
    text = cell.source if cell.kind == "markdown" else "\n".join(_captions(master, cell))
    for match in pattern.finditer(_CODE_OR_FORMULA.sub(" ", text)):
        if match["form"]:
            yield match["form"], owners[match["form"].casefold()]
            continue
        if match["address"] in addresses:
            yield "", addresses[match["address"]]
        elif not _LESSON.match(match["address"]):
            for inner in pattern.finditer(match["text"]):
                yield inner["form"], owners[inner["form"].casefold()]


def _captions(master, cell):
    """The captions of a code cell: `caption="..."`, and those of the texts that it names."""
    try:
        nodes = list(ast.walk(ast.parse(cell.source)))
    except SyntaxError:  # a cell with a magic
        return
    captions = {f"{master.name}/{name}": caption for name, (caption, _alt) in master.texts.items()}
    for node in nodes:
        if isinstance(node, ast.keyword) and node.arg == "caption" and isinstance(node.value, ast.Constant):
            yield str(node.value.value)
        elif isinstance(node, ast.Constant) and node.value in captions:
            yield captions[node.value]
