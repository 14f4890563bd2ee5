"""The files of a lesson's exercises: checks/<lesson>.json and solutions/<lesson>.json.

`authoring.lesson_files` writes them, beside the notebooks and in an answer key: a key is the same with the
hidden cases, and with inputs from a secret seed. `check`, `hint` and `solution` read the lesson's, grading
reads the key's. A checks file holds, as text:

    format, lesson, version; a key's has `number` and `title` of the lesson, and the `code` of its cells, too
    cells      {cell id: source of a check or given cell, null for the others}
    exercises  {id: the fields of Exercise, with a key of `values` in the place of each value; in addition a
                case has `expected`, one result for each call, and `arguments`, one list for each call}
    values     {key: an argument (see `canonical.encode`) or a result (see `canonical`)}, each value once

An argument that is no data (a function, an open recording) is made again: then the case has no `arguments`,
but `inputs`, a source that runs after `preparation`, the source of the declaration's cell. A key has no such
case: reading one runs nothing, and an altered key can at most grade wrongly.
"""

import contextlib
import copy
import difflib
import json
import os
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

from .. import course
from .canonical import decode
from .lesson import Exercise, ExpectedCall
from .percent_script import MasterError
from .running import CallResult

FORMAT = 1
CHECKS, SOLUTIONS = "checks", "solutions"  # names of the folders
CHECKS_VARIABLE = "NBCLASSROOM_CHECKS"
NO_CHECKS = (
    "there are no checks here: the folder checks/ must be beside the lesson; start the lessons as"
    " the course says, or take the folder again from what your teacher handed out"
)

DAMAGED = (ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError, SyntaxError)


class CheckFileError(ValueError):
    """A file that a lesson carries is missing or damaged, or does not know the exercise; says what to do.

    `problem` does not.
    """

    def __init__(self, problem: str, remedy: str = ""):
        super().__init__("; ".join(filter(None, (problem, remedy))))
        self.problem = problem

    def _render_traceback_(self):
        """IPython calls it: one line, because a traceback would show nothing that the learner did."""
        return [str(self)]


class UnknownExerciseError(CheckFileError):
    """No lesson of the course has the exercise."""


@dataclass(frozen=True, eq=False)
class Lesson:
    """A lesson as it was handed out, or as a key grades it: its checks file, see above.

    Its name identifies it. `entries` are its exercises as they are stored.
    """

    path: Any  # a Path
    name: str
    version: str  # of the course
    cells: dict[str, str | None]
    entries: dict
    values: dict
    number: str = ""  # only its place in the course: "04"
    title: str = ""
    code: tuple[str, ...] = ()

    @cached_property
    def exercises(self):
        """All of them; errors as in `exercise`."""
        return tuple(map(self.exercise, self.entries))

    @property
    def points(self):
        return sum(exercise.points for exercise in self.exercises)

    def exercise(self, id):
        """One of its exercises; CheckFileError: the file is damaged."""
        import msgspec  # here, because the kernels that grade import this module too

        with reading(self.path):
            entry = change_values(self.entries[id], lambda key, _tolerance: self.values[key])
            exercise = replace(msgspec.convert(entry | {"id": id}, Exercise), master=self.path)
            witnesses = self._with_calls(exercise, exercise.witnesses, entry.get("witnesses", ()))
            cases = self._with_calls(exercise, exercise.cases, entry["cases"])
            return replace(exercise, cases=cases, witnesses=witnesses)

    def _with_calls(self, exercise, cases, stored_cases):
        pairs = zip(cases, stored_cases, strict=True)
        return tuple(replace(case, calls=self._calls(exercise, case, stored)) for case, stored in pairs)

    def _calls(self, exercise, case, stored_case):
        if "inputs" in stored_case:
            calls_arguments = exercise.arguments(replace(case, source=stored_case["inputs"]))
        else:
            calls_arguments = [tuple(map(decode, forms)) for forms in stored_case["arguments"]]
        results = map(CallResult, stored_case["expected"])
        return tuple(ExpectedCall(*pair) for pair in zip(calls_arguments, results, strict=True))


def change_values(entry, change):
    """A copy of a stored exercise with `change(item, tolerance)` in the place of each value, or of its key.

    The tolerance is that of the case; None for an argument.
    """
    entry = copy.deepcopy(entry)
    cases = (*entry["cases"], *entry.get("witnesses", ()))
    tolerances = {case["id"]: case["tolerance"] for case in cases}
    for case in cases:
        case["expected"] = [change(value, case["tolerance"]) for value in case["expected"]]
        if "arguments" in case:
            case["arguments"] = [[change(value, None) for value in call] for call in case["arguments"]]
    for mistake in entry["mistakes"]:
        for case_id, results in mistake["results"].items():
            for result in results:
                if "value" in result:
                    result["value"] = change(result["value"], tolerances[case_id])
    return entry


@contextlib.contextmanager
def reading(path):
    """What fails inside means that this file is missing or damaged: CheckFileError says so."""
    try:
        yield
    except CheckFileError:
        raise
    except MasterError as error:
        raise CheckFileError(f"{path.name}: {error}") from error
    except (OSError, *DAMAGED) as error:
        reason = error.strerror if isinstance(error, OSError) else f"{type(error).__name__}: {error}"
        raise CheckFileError(
            f"{path.parent.name}/{path.name} cannot be read ({str(reason)[:120]})",
            f"take the folder {path.parent.name}/ again from the course or from your teacher",
        ) from error


def read_lesson_file(path):
    """The JSON of a checks or solutions file; CheckFileError: it is missing, damaged or of a newer format."""
    with reading(path):
        data = json.loads(path.read_text(encoding="utf-8"))
        number = data["format"]
        if isinstance(number, int) and number > FORMAT:
            raise CheckFileError(
                f"{path.parent.name}/{path.name} was made by a newer version of the course (format {number},"
                f" this one reads {FORMAT}): update the course"
            )
        if number != FORMAT:
            raise ValueError(f"format {number!r}, expected {FORMAT}")
        return data


def read_check_file(path):
    """The Lesson in a file, read once as long as it does not change; errors as in `read_lesson_file`."""
    with reading(path):
        status = path.stat()
        return _read_check_file(path, (status.st_mtime_ns, status.st_size))


@lru_cache(maxsize=64)
def _read_check_file(path, _version):
    import msgspec

    data = read_lesson_file(path)
    names = {"path": path, "name": data["lesson"], "entries": data["exercises"]}
    return msgspec.convert(data | names, Lesson)


def checks_folders(beside=None):
    """The folders that hold checks files, those that are searched first in front, as a list of Path.

    These are the folders of NBCLASSROOM_CHECKS, checks/ in the folder `beside` (the current one if
    omitted), and checks/ beside course.toml.
    """
    chosen_folders = [Path(part) for part in os.environ.get(CHECKS_VARIABLE, "").split(os.pathsep) if part]
    beside_lessons = [folder / CHECKS for folder in (beside or Path.cwd(), *course.folders_of_lessons())]
    return [folder for folder in dict.fromkeys(chosen_folders + beside_lessons) if folder.is_dir()]


def find_check_file(id):
    """The Lesson that has this exercise.

    CheckFileError: no checks files, or a damaged file; UnknownExerciseError names the nearest id.
    """
    paths = [path for folder in checks_folders() for path in sorted(folder.glob("*.json"))]
    if not paths:
        raise CheckFileError(NO_CHECKS)
    name = json.dumps(str(id))
    for path in paths:
        with reading(path):
            text = path.read_text(encoding="utf-8", errors="replace")
        # A file without this id is not parsed: it may be damaged.
        if name in text:
            file = read_check_file(path)
            if id in file.entries:
                return file
    raise UnknownExerciseError(f"there is no exercise {id!r}; {_advice(id, paths)}")


def _advice(id, paths):
    ids = []
    for path in paths:
        try:
            ids += read_check_file(path).entries
        except CheckFileError as error:
            return str(error)  # the exercise may be in this file
    nearest = difflib.get_close_matches(str(id), ids, n=1)
    return f"did you mean {nearest[0]!r}?" if nearest else f"there are: {', '.join(ids) or 'none'}"
