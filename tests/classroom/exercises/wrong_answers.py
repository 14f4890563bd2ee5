"""Learners' wrong answers: a file for each exercise, at most five answers in it, each of its own kind.

Each cell of a file is one answer. Its first line describes the mistake, in fields with JSON values:

- ``name``: the mistake in a few words;
- ``sentence``: what a good teacher would say to it;
- ``must_say``: patterns, each of which a right sentence about this mistake matches, in whatever case;
- ``must_not_say``: patterns that would be false here;
- ``kind``: in what way the answer is wrong: value, dtype, shape, type, error, syntax, ...;
- ``passes``: true for an answer that is wrong and that the checks do not catch yet.
"""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

FOLDER = Path(__file__).parent / "wrong_answers"

_CELL = re.compile(r"^# %% ", re.MULTILINE)
_FIELD = re.compile(r"\s*(\w+)=")


class WrongAnswer(NamedTuple):
    """A cell of the table."""

    name: str
    sentence: str
    must_say: Sequence[str]
    kind: str
    source: str
    must_not_say: Sequence[str] = ()
    passes: bool = False

    def is_named_by(self, sentence: str) -> bool:
        """Whether this sentence says what is wrong with the answer, and nothing false."""
        says = all(re.search(pattern, sentence, re.IGNORECASE) for pattern in self.must_say)
        return says and not self.is_misled_by(sentence)

    def is_misled_by(self, sentence: str) -> bool:
        """Whether this sentence says something false about the answer."""
        return any(re.search(pattern, sentence, re.IGNORECASE) for pattern in self.must_not_say)


def read_wrong_answers(path: Path) -> list[WrongAnswer]:
    """The answers of one file, in its order."""
    cells = _CELL.split(path.read_text(encoding="utf-8"))
    if cells[0].strip():
        raise ValueError(f"{path.name}: text before the first cell")
    answers = []
    for cell in cells[1:]:
        header, _, source = cell.partition("\n")
        try:
            answers.append(WrongAnswer(**_read_header(header), source=source))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{path.name}: {error}: {header}") from error
    return answers


def _read_header(header: str) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    position = 0
    while position < len(header.rstrip()):
        key = _FIELD.match(header, position)
        if not key:
            raise ValueError(f"no field at column {position}")
        if key[1] in fields:
            raise ValueError(f"the field {key[1]} stands twice")
        fields[key[1]], position = json.JSONDecoder().raw_decode(header, key.end())
    return fields
