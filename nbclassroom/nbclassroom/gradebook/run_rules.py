"""The rules of a run, kept in the folder of grades: the next run has them again, unless it is told otherwise.

They are in rules.json: the keys, the deadline, the late policy, the tables of extensions and decisions, the
roster, the layout. What a command does not say is not a change of the rules.
"""

import json
from datetime import datetime
from pathlib import Path

from .result_store import GradesFolderError, write_grades_file

FILE = "rules.json"
_TITLES = {
    "keys": "the key",
    "deadline": "the deadline",
    "late": "the late policy",
    "extensions": "the extensions",
    "decisions": "the decisions",
    "roster": "the roster",
    "layouts": "the layout",
}
NAMES = tuple(_TITLES)
_PATHS = ("keys", "extensions", "decisions", "roster")


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
        self.rules = dict.fromkeys(_TITLES) | usable | given
        self.rules["keys"] = self.rules["keys"] or [Path("key")]
        self.kept = [_text(name, value) for name, value in usable.items() if value and name not in given]
        self.lost = [text for name, value in before.items() for text in self._lost(name, value)]

    def _lost(self, name, value):
        if name == "keys":
            now = {Path(key).resolve() for key in self.rules["keys"]}
            return [_text(name, [key]) for key in value if key not in now]
        return [] if self.rules[name] else [_text(name, value)]

    def keep(self):
        """Write the rules into the folder of grades."""
        values = {name: value for name, value in self.rules.items() if value}
        write_grades_file(self._path, json.dumps(values, indent=1, default=_plain))


def _read(path):
    try:
        rules = json.loads(path.read_text(encoding="utf-8"))
        return {name: _value(name, rules[name]) for name in _TITLES if name in rules}
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, TypeError) as error:
        raise GradesFolderError(f"{path}: cannot be read; remove it, and give all options again") from error


def _value(name, value):
    if name == "keys":
        return [Path(path) for path in value]
    if name == "deadline":
        return datetime.fromisoformat(value)
    return Path(value) if name in _PATHS else value


def _plain(value):
    return str(value.resolve()) if isinstance(value, Path) else value.isoformat()


def _usable(name, value):
    """A rule without the paths that are not there any more; None if it is one of them."""
    if name == "keys":
        return [key for key in value if key.exists()]
    return None if name in _PATHS and not value.exists() else value


def _text(name, value):
    values = value if name in ("keys", "layouts") else [value]
    shown = ", ".join(value.isoformat() if name == "deadline" else str(value) for value in values)
    return f"{_TITLES[name]} {shown}"
