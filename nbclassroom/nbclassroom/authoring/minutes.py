"""The minutes of a lesson, by one rule, and which of its sections go deeper.

A section begins at a heading with `[[minutes]]` (docs/teach/masters.md); build writes its minutes there, and
the lesson's elsewhere: `### Two levels ([[minutes+2]], deeper)` becomes `### Two levels (8 minutes, deeper)`.
A deeper section ends at the next heading of its level or of a higher one. The rest is the core of the lesson:
it runs, and can be understood, without the deeper sections. tests/notebooks/test_minutes.py has the estimate.
"""

import re
from collections import Counter
from dataclasses import dataclass, field, replace

from nbclassroom.authoring.rules import CHECK_LINE

MINUTES = {  # fitted to an estimate of each section; the words carry the time for the figures, too
    "words": 1 / 70,
    "code lines": 0.1,
    "predictions": 1.5,
    "exercises": 3,
    "solution lines": 1,
    "written answers": 8,
    "further minutes": 1,
}
_REFERENCE = re.compile(r"\[\[minutes(?:\+(?P<further>\d+))?\]\]")
_PART = re.compile(r"^(?=#{2,4} )", re.M)  # of a Markdown cell: a heading and the text below it
_HEADING = re.compile(rf"(#{{2,4}}) .*?(?P<timed> \({_REFERENCE.pattern}(?P<words>, [a-z, ]+)?\))?$", re.M)
_NO_WORDS = re.compile(r"\$\$.+?\$\$|```.*?```|\[\[(?:[^|\[\]]*\|)?", re.S)  # a label counts
_WORD = re.compile(r"\w[\w'’.-]*")


@dataclass
class Section:
    """A part of a lesson with minutes of its own; `counts` has a number for each key of MINUTES."""

    deeper: bool = False
    counts: Counter = field(default_factory=Counter)


def minutes_of(counts):
    """The minutes, a float, for words, code lines and so on."""
    return sum(MINUTES[name] * count for name, count in counts.items())


def timed_script(script):
    """(Cells with their minutes filled in, whether each is deeper, the minutes of the whole, of the core)."""
    sections, deeper = read_sections(script.cells)
    minutes = [max(1, round(minutes_of(section.counts))) for section in sections]
    of_core = (m for m, section in zip(minutes, sections, strict=True) if not section.deeper)
    core, whole = (max(5, 5 * round(total / 5)) for total in (sum(of_core), sum(minutes)))
    time = f"about {core} minutes" + f" for the core, {whole} with the deeper sections" * any(deeper)
    headings = iter(minutes[1:])
    cells = tuple(_filled(cell, headings, time) if cell.kind == "markdown" else cell for cell in script.cells)
    return cells, deeper, whole, core


def _filled(cell, minutes, time):
    """A Markdown cell with the next minutes in its headings, and the lesson's time everywhere else."""
    parts = _PART.split(cell.source)
    for number, part in enumerate(parts):
        heading = _HEADING.match(part)
        if heading and heading["timed"]:
            section = next(minutes)
            parts[number] = _REFERENCE.sub(f"{section} minute{'s' * (section != 1)}", part, count=1)
    return replace(cell, source=_REFERENCE.sub(time, "".join(parts)))


def read_sections(cells):
    """The sections of a script, the first without a heading; and for each cell whether it is deeper."""
    section = core = Section()
    sections, deeper, deeper_level, stub = [section], [], 0, ""
    for cell in cells:
        for part in _PART.split(cell.source) if cell.kind == "markdown" and cell.role != "solution" else ():
            heading = _HEADING.match(part)
            if heading and len(heading[1]) <= deeper_level:
                section, deeper_level = core, 0
            if heading and heading["timed"]:
                if not deeper_level and "deeper" in (heading["words"] or ""):
                    deeper_level = len(heading[1])
                section = Section(deeper_level > 0)
                section.counts["further minutes"] = int(heading["further"] or 0)
                sections.append(section)
                core = core if section.deeper else section
            section.counts["words"] += len(_WORD.findall(_NO_WORDS.sub(" ", part)))
        stub = cell.source if cell.role == "answer" else stub
        section.counts.update(_counts_of_code(cell, stub) if cell.kind == "code" or cell.role else {})
        deeper.append(section.deeper)
    return sections, deeper


def _counts_of_code(cell, stub):
    """What a code cell adds to the counts; of a solution, what its stub lacks; imports are not read."""
    if cell.role in ("predict", "ask"):
        return {"predictions": 1}
    if cell.role == "answer":
        return {"exercises" if cell.kind == "code" else "written answers": 1}
    if cell.role == "solution" and cell.kind == "code":
        return {"solution lines": (_code_lines(cell.source) - _code_lines(stub)).total()}
    if cell.role not in ("", "given") or cell.source.startswith(CHECK_LINE):
        return {}
    lines = _code_lines(cell.source)
    return {"code lines": sum(n for line, n in lines.items() if not line.startswith(("import ", "from ")))}


def _code_lines(source):
    """The lines of code, with how often each stands there; a wrapped call is one line."""
    lines = (line for raw in source.splitlines() if (line := raw.strip()) and line[0] != "#")
    return Counter(line for line in lines if not line.endswith(("(", "[", ",")))
