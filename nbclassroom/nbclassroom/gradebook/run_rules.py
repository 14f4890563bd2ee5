"""The rules of a run, kept in the folder of grades: the next run has them again, unless it is told otherwise.

They are in rules.json: the keys, the deadline, the late policy, the tables of extensions and decisions, the
roster, the layout. What a command does not say is not a change of the rules.
"""

import json
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

from .result_store import write_grades_file

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
    """

    def __init__(self, out, given, *, forget=False):
        self._path = Path(out) / FILE
        before = {} if forget else _read(self._path)
        given = {name: value for name, value in given.items() if value}
        self.rules = dict.fromkeys(_RULES) | before | given
        self.rules["keys"] = self.rules["keys"] or [Path("key")]
        self.kept = [_text(name, value) for name, value in before.items() if name not in given]

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
        raise ValueError(f"{path}: cannot be read; remove it, and give all options again") from error


def _plain(value):
    return str(value.resolve()) if isinstance(value, Path) else value.isoformat()


def _text(name, value):
    values = value if name in _LISTS else [value]
    shown = ", ".join(one.isoformat() if name == "deadline" else str(one) for one in values)
    return f"{_RULES[name][0]} {shown}"
