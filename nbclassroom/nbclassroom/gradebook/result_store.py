"""What the folder of grades keeps for the next run: the results, and the rules.

Every result is stored at once, so an interrupted run continues where it stopped. The rules are in rules.json:
what a command does not say is not a change of them.
"""

import contextlib
import fcntl
import hashlib
import json
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

from .. import course
from ..autograder.outcomes import Outcome
from ..autograder.results import from_json, to_json
from ..exercises.atomic_write import write_file

_FORMAT = 6  # of the files of results
_RULES_FILE = "rules.json"
# {name: (what texts call it, how its text in rules.json is read)}
_RULES: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "keys": ("the key", lambda paths: list(map(Path, paths))),
    "deadline": ("the deadline", datetime.fromisoformat),
    "late": ("the late policy", str),
    "extensions": ("the extensions", Path),
    "decisions": ("the decisions", Path),
    "roster": ("the roster", Path),
    "layouts": ("the layout", list),
}


def write_grades_file(path, data):
    """Write a file for its owner alone, whole, over the old one; ValueError: it cannot be written."""
    try:
        write_file(path, data, permissions=0o600)
    except OSError as error:
        raise ValueError(f"{path}: cannot be written ({error.strerror})") from error


@contextlib.contextmanager
def open_grades_folder(folder):
    """Make a folder for its owner, lock it, remove unfinished files; ValueError: it is in use."""
    with contextlib.ExitStack() as stack:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            folder.chmod(0o700)
            lock = stack.enter_context((folder / ".lock").open("w", encoding="ascii"))
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            for path in folder.rglob(".writing-*.tmp"):
                path.unlink(missing_ok=True)
        except BlockingIOError as error:
            message = f"{folder}: another run is writing into it; wait for its end, or name another --out"
            raise ValueError(message) from error
        except OSError as error:
            raise ValueError(f"{folder}: cannot be made ({error.strerror})") from error
        yield


class ResultStore:
    """Pages and results in a folder, by a digest of page, key, and `options` such as the sandbox."""

    def __init__(self, folder, options):
        self._folder = Path(folder)
        self._not_graded = {}
        self._options = options | {"version": course.release(), "format": _FORMAT}

    def keep_page(self, key, lesson, page):
        """Store a page (see `exercises.page`) until it is graded; returns its digest."""
        everything = json.dumps([key.digest, lesson, page, self._options], sort_keys=True)
        digest = hashlib.sha256(everything.encode("ascii")).hexdigest()
        path = self._folder / f"{digest}.page.json"
        if not path.exists():
            write_grades_file(path, json.dumps([key.digest, lesson, page], sort_keys=True))
        return digest

    def page(self, digest):
        """The stored page: (digest of the key, lesson, page)."""
        return json.loads((self._folder / f"{digest}.page.json").read_text(encoding="utf-8"))

    def keep_result(self, digest, result):
        """Store a GradedSubmission; one not graded is kept for this run alone: the next tries again."""
        if result.exercises_with(Outcome.NOT_GRADED):
            self._not_graded[digest] = result
            return
        write_grades_file(self._folder / f"{digest}.json", json.dumps(to_json(result), sort_keys=True))

    def result(self, digest):
        """The GradedSubmission, or None if there is none yet or its file is damaged."""
        if digest in self._not_graded:
            return self._not_graded[digest]
        try:
            return from_json(json.loads((self._folder / f"{digest}.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, KeyError, TypeError):
            return None


class RunRules:
    """The rules of a run: those given, and else those of the run before; `given` are the options of `grade`.

    rules  {name: value}, as the command `grade` takes them
    kept   texts: the rules that were not given, and are those of the run before
    """

    def __init__(self, out, given, *, forget=False):
        self._path = Path(out) / _RULES_FILE
        before = {} if forget else _read_rules(self._path)
        given = {name: given[name] for name in _RULES if given[name]}
        self.rules = dict.fromkeys(_RULES) | before | given
        self.rules["keys"] = self.rules["keys"] or [Path("key")]
        self.kept = [_text_of(name, value) for name, value in before.items() if name not in given]

    def keep(self):
        values = {name: value for name, value in self.rules.items() if value}
        write_grades_file(self._path, json.dumps(values, indent=1, default=_plain))


def _read_rules(path):
    try:
        rules = json.loads(path.read_text(encoding="utf-8"))
        return {name: read(rules[name]) for name, (_, read) in _RULES.items() if name in rules}
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, TypeError) as error:
        raise ValueError(f"{path}: cannot be read; remove it, and give all options again") from error


def _plain(value):
    return str(value.resolve()) if isinstance(value, Path) else value.isoformat()


def _text_of(name, value):
    values = value if isinstance(value, list) else [value]
    shown = ", ".join(one.isoformat() if name == "deadline" else str(one) for one in values)
    return f"{_RULES[name][0]} {shown}"
