"""The minutes of a lesson, by one rule, and which of its sections go deeper.

A section begins at a heading with `[[minutes]]`, and build replaces that by the minutes of the section:

    ## 3 · Masks ([[minutes]])               ## 3 · Masks (12 minutes)
    ### Two levels ([[minutes]], deeper)     ### Two levels (8 minutes, deeper)
    **Time** [[minutes]].                    **Time** about 60 minutes for the core, 75 with the ...

A deeper section ends at the next heading of its level or of a higher one. The rest of the lesson is its core:
it runs, and can be understood, without the deeper sections and their exercises.

The rule. Minutes are a sum over words of prose, lines of code that the learner reads, predictions, exercises,
and lines that the learner writes (those of the solution that the stub does not hold). From lesson 11 on a
learner is practised and needs 0.6 of this sum.

How it was calibrated. One person walked through the lessons 00 to 20 as a second-year student without NumPy,
ROS or image processing, and estimated the minutes of each. The six numbers below were fitted to these 21
estimates: the largest error is 15 %, on lessons 09, 15 and 17. They are no measurement of learners. With six
numbers for 21 lessons, they say little about one word or one line, and most about the sum. Without the
factor for practice no such rule comes nearer than 20 %. Mathematics counts as any other text.
"""

import re
from collections import Counter
from dataclasses import dataclass, field, replace

from imgproc_course.classroom.authoring.rules import CHECK_LINE

MINUTES = {"words": 1 / 80, "code lines": 0.35, "predictions": 0.5, "exercises": 4, "solution lines": 1.75}
PRACTISED, FIRST_OF_THE_PRACTISED = 0.6, "11"
REFERENCE, DEEPER = "[[minutes]]", "deeper"

_PART = re.compile(r"^(?=#{2,4} )", re.M)  # of a Markdown cell: a heading and the text below it
_HEADING = re.compile(r"(#{2,4}) .*?(?P<timed> \(\[\[minutes\]\](?P<words>, [a-z, ]+)?\))?$", re.M)
_NO_WORDS = re.compile(r"\$\$.+?\$\$|```.*?```|\[\[(?:[^|\]]*\|)?", re.S)  # of a reference, the label counts
_WORD = re.compile(r"\w[\w'’.-]*")


@dataclass
class Section:
    """A part of a lesson that has its own minutes; `counts` has a number for each key of MINUTES."""

    deeper: bool = False
    counts: Counter = field(default_factory=Counter)


@dataclass(frozen=True)
class TimedScript:
    """A lesson's script with its minutes filled in.

    cells   tuple of ScriptCell
    deeper  for each of them, whether it is in a deeper section
    whole   minutes of the lesson
    core    minutes of its core
    """

    cells: tuple
    deeper: tuple
    whole: int
    core: int


def minutes_of(counts, number):
    """The minutes, a float, for words, code lines and so on, in the lesson with this number ("03")."""
    minutes = sum(MINUTES[name] * count for name, count in counts.items())
    return minutes * PRACTISED if number >= FIRST_OF_THE_PRACTISED else minutes


def timed_script(script, number):
    """The TimedScript of a Script; `number` is the lesson's place in the course, "" for the index."""
    sections, deeper = read_sections(script.cells)
    minutes = [max(1, round(minutes_of(section.counts, number))) for section in sections]
    core = _in_fives(sum(m for m, section in zip(minutes, sections, strict=True) if not section.deeper))
    whole = _in_fives(sum(minutes))
    time = f"about {core} minutes"
    if any(deeper):
        time += f" for the core, {whole} with the deeper sections"
    headings = iter(minutes[1:])
    cells = tuple(_filled(cell, headings, time) if cell.kind == "markdown" else cell for cell in script.cells)
    return TimedScript(cells, tuple(deeper), whole, core)


def _in_fives(minutes):
    return max(5 * round(minutes / 5), 5)


def _filled(cell, minutes, time):
    """A Markdown cell with the next minutes in its headings, and the lesson's time everywhere else."""

    parts = []
    for part in _PART.split(cell.source):
        heading = _HEADING.match(part)
        if heading and heading["timed"]:
            part = part.replace(REFERENCE, _label(next(minutes)), 1)
        parts.append(part)
    return replace(cell, source="".join(parts).replace(REFERENCE, time))


def _label(minutes):
    return f"{minutes} minute{'s' * (minutes != 1)}"


def read_sections(cells):
    """The sections of a script, the first without a heading; and for each cell whether it is deeper."""
    section = core = Section()
    sections, deeper, deeper_level, stub = [section], [], 0, ""
    for cell in cells:
        for part in _PART.split(cell.source) if cell.kind == "markdown" else ():
            heading = _HEADING.match(part)
            if heading and len(heading[1]) <= deeper_level:
                section, deeper_level = core, 0
            if heading and heading["timed"]:
                if not deeper_level and DEEPER in (heading["words"] or ""):
                    deeper_level = len(heading[1])
                section = Section(deeper_level > 0)
                sections.append(section)
                core = core if section.deeper else section
            section.counts["words"] += len(_WORD.findall(_NO_WORDS.sub(" ", part)))
        stub = cell.source if cell.role == "answer" else stub
        section.counts.update(_counts_of_code(cell, stub) if cell.kind == "code" else {})
        deeper.append(section.deeper)
    return sections, deeper


def _counts_of_code(cell, stub):
    lines = Counter(_code_lines(cell.source))
    if cell.role == "predict":
        return {"predictions": 1}
    if cell.role == "answer":
        return {"exercises": 1}
    if cell.role == "solution":
        return {"solution lines": (lines - Counter(_code_lines(stub))).total()}
    is_read = cell.role in ("", "given") and not cell.source.startswith(CHECK_LINE)
    return {"code lines": lines.total()} if is_read else {}


def _code_lines(source):
    return [line.strip() for line in source.splitlines() if line.strip() and not line.strip().startswith("#")]
