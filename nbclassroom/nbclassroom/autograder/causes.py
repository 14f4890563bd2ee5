"""Why exercises of one submission fail alike: another cell should have made a name. It is told once."""

import re
from typing import NamedTuple

_MISSING = re.compile(
    r"name '(\w+)' is not def|(\w+) is not there, because|write this exercise without (\w+)"
)
_SYNTAX_PLACE = re.compile(r" ?\(<cell \d+>, line (\d+)\)$")


class Cause(NamedTuple):
    """Why an exercise fails, a sentence, "" if its checks say it; the id of the exercise that tells it."""

    text: str
    told_by: str


def causes_of(exercises, runs, page):
    """{exercise id: Cause} of the exercises that a cell which is not their answer lets fail.

    `runs` are {exercise id: {case id: CaseRun}}, in the order of the exercises.
    """
    places: dict[str, tuple[int, str]] = {}
    for exercise in exercises:
        missing = dict(map(missing_name, runs[exercise.id].values()))
        name, text = missing.popitem() if len(missing) == 1 else ("", "")
        place = _place_of(name, text, exercise.id, page, runs[exercise.id]) if name else None
        places |= {exercise.id: place} if place else {}
    titles = {exercise.id: exercise.title for exercise in exercises}
    failed = {id for id, own in runs.items() if not all(run.passed for run in own.values())}
    causes = {}
    for id, (number, text) in places.items():
        owner = page["cells"][number]["exercise"]
        first = owner if owner in failed else next(one for one in places if places[one][0] == number)
        same = f'It fails for the same reason as "{titles[first]}": mend that first'
        causes[id] = Cause(same if first != id else text, first)
    return causes


def missing_name(run):
    """(the name that a call or the check cell of a CaseRun misses, "" if none, the error's text)."""
    calls = getattr(run.verdict, "calls", None) or ()
    ends = [run.answer.error, run.check.error] if run.check.error[0] else []
    ends += [(call.error, call.message) for call in calls]
    text = next((text for error, text in ends if error in ("NameError", "RefusedModule")), "")
    match = _MISSING.match(text)
    return next(filter(None, match.groups())) if match else "", text


def _place_of(name, text, id, page, runs):
    """(the cell that fails and should make a name, or has it first, a sentence); None if it is the answer."""
    cells = page["cells"]
    errors = {number: error for number, *error in next(iter(runs.values())).answer.errors}
    numbers = [number for number in errors if number < len(cells) and _binds(cells[number]["source"], name)]
    word = re.compile(rf"\b{name}\b")
    if not word.search(page["answers"][id]):
        numbers += [number for number, cell in enumerate(cells) if word.search(cell["source"])]
    if not numbers or cells[numbers[0]]["exercise"] == id:
        return None
    lines = cells[numbers[0]]["source"].splitlines()
    first_line = next(filter(None, map(str.strip, lines)))
    error, error_text = errors.get(numbers[0], ("", text))
    reason = _reason(error, error_text, lines)
    sentence = f'The cell that begins with "{first_line[:60]}" does not work, and this exercise needs it'
    return numbers[0], "" if text.startswith("write this") else f"{sentence} ({reason}). Mend it first"


def _binds(source, name):
    """Whether a line of a source, which may be no Python, makes a name."""
    definition = re.compile(rf"(?:async )?(?:def|class) +{name}\b|{name} *[=:,]")
    word, lines = re.compile(rf"\b{name}\b"), list(map(str.strip, source.splitlines()))
    imports = [line for line in lines if line.startswith(("import ", "from "))]
    return any(map(definition.match, lines)) or any(map(word.search, imports))


def _reason(error, text, lines):
    """The error of a statement as a text, with the line that is not Python."""
    if match := _SYNTAX_PLACE.search(text):
        line = "".join(lines[int(match[1]) - 1 :][:1])
        text = f"{text[: match.start()]}, line {match[1]}: {line.strip()}"
    return ": ".join(filter(None, (error, text)))
