"""The rules of a run, kept in the folder of grades: the next run has them again, unless it is told otherwise.

They are in rules.json: the keys, the deadline, the late policy, the tables of extensions and decisions, the
roster, the layout. What a command does not say is not a change of the rules.
"""

import json
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

from .result_store import GradesFolderError, write_grades_file

FILE = "rules.json"
# {name: (what texts call it, how its text in rules.json is read)}
_RULES: dict[str, tuple[str, Callable[[str], Any]]] = {
    "keys": ("the key", Path),
    "deadline": ("the deadline", datetime.fromisoformat),
    "late": ("the late policy", str),
    "extensions": ("the extensions", Path),
    "decisions": ("the decisions", Path),
    "roster": ("the roster", Path),
    "layouts": ("the layout", str),
}
NAMES = tuple(_RULES)
_LISTS = ("keys", "layouts")  # whose value is a list


class RunRules:
    """The rules of a run: those given, and else those of the run before; `given` has a value for each name.

    rules  {name: value}, as the command `grade` takes them
    kept   texts: the rules that were not given, and are those of the run before
    lost   texts: the rules that the run before had, and this one has not
    """

    def __init__(self, out, given, *, forget=False):
        self._path = Path(out) / FILE
        before = _read(self._path)
        given = {name: value for name, value in given.items() if value}
        usable = {} if forget else {name: _usable(name, value) for name, value in before.items()}
        self.rules = dict.fromkeys(_RULES) | usable | given
        self.rules["keys"] = self.rules["keys"] or [Path("key")]
        self.kept = [_text(name, value) for name, value in usable.items() if value and name not in given]
        keys = {Path(key).resolve() for key in self.rules["keys"]}
        lost = {name: value for name, value in before.items() if not self.rules[name]}
        lost |= {"keys": [key for key in before.get("keys", ()) if key not in keys]}
        self.lost = [_text(name, lost[name]) for name in _RULES if lost.get(name)]

    def keep(self):
        """Write the rules into the folder of grades."""
        values = {name: value for name, value in self.rules.items() if value}
        write_grades_file(self._path, json.dumps(values, indent=1, default=_plain))


def _read(path):
    try:
        rules = json.loads(path.read_text(encoding="utf-8"))
        return {
            name: list(map(read, rules[name])) if name in _LISTS else read(rules[name])
            for name, (_, read) in _RULES.items()
            if name in rules
        }
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, TypeError) as error:
        raise GradesFolderError(f"{path}: cannot be read; remove it, and give all options again") from error


def _plain(value):
    return str(value.resolve()) if isinstance(value, Path) else value.isoformat()


def _usable(name, value):
    """A rule without the paths that are not there any more; None if it is one of them."""
    if name == "keys":
        return [key for key in value if key.exists()]
    return None if isinstance(value, Path) and not value.exists() else value


def _text(name, value):
    values = value if name in _LISTS else [value]
    shown = ", ".join(one.isoformat() if name == "deadline" else str(one) for one in values)
    return f"{_RULES[name][0]} {shown}"
