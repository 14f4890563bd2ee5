"""The files that a lesson carries: checks/<lesson>.json and solutions/<lesson>.json beside the notebooks.

`imgproc_course.classroom.authoring.lesson_files` writes them; `check`, `hint` and `solution` read them. A
checks file holds, as text:

    format, lesson, version
    cells      {cell id: source of a check or given cell, null for the others}
    exercises  {id: the fields of CheckData; every value by its key in `values`}
    values     {key: an argument (see `input_encoding`) or a result (see `canonical`)}, each value once

An argument that is no data (a function, an open recording) is made again by the source of its case.
"""

import difflib
import json
import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from imgproc_course.classroom.exercises.check_data import CheckCase, CheckData, CheckMistake, ExpectedCall
from imgproc_course.classroom.exercises.declaration import Case, Exercise, MasterError
from imgproc_course.classroom.exercises.input_encoding import decode
from imgproc_course.classroom.exercises.lesson_description import ExerciseDescription, LessonDescription
from imgproc_course.classroom.exercises.running import CallResult

FORMAT = 1
CHECKS, SOLUTIONS = "checks", "solutions"  # names of the folders
CHECKS_VARIABLE = "IMGPROC_COURSE_CHECKS"
NO_CHECKS = (
    "there are no checks here: the folder checks/ must be beside the lesson; start the lessons with"
    " environment/lab, or take the folder again from what your teacher handed out"
)

PLAIN_FIELDS = (
    "title",
    "function",
    "names",
    "stub",
    "given",
    "provided",
    "allowed",
    "time_limit",
    "practice",
    "hidden_count",
    "hidden_points",
    "border_hint",
    "hints",
    "another_way",
    "exact_type",
)
RESULT_FIELDS = ("error", "message", "timed_out", "changed")  # of a mistake's call, beside its value
CASE_FIELDS = ("id", "title", "points", "hint", "tolerance")
DAMAGED = (ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError, SyntaxError)


class CheckFileError(ValueError):
    """A file that a lesson carries is missing or damaged, or does not know the exercise; says what to do."""

    def _render_traceback_(self):
        """One line in a notebook: the learner did nothing wrong that a traceback could show."""
        return [str(self)]


# ---------------------------------------------------------------- reading


@dataclass(frozen=True, eq=False)
class CheckFile:
    """A checks file as it was read; `exercise` gives its exercises.

    lesson   the lesson's name
    version  of the course that the lesson was built with
    cells    {cell id: source or None}, see above
    """

    path: Path
    lesson: str
    version: str
    cells: dict
    entries: dict
    values: dict

    @property
    def ids(self):
        """The ids of its exercises, as a list."""
        return list(self.entries)

    def description(self):
        """The LessonDescription."""
        try:
            exercises = tuple(
                ExerciseDescription(id, entry["function"], entry["stub"], tuple(entry["given"]))
                for id, entry in self.entries.items()
            )
        except DAMAGED as error:
            raise damaged(self.path, error) from error
        return LessonDescription(self.lesson, self.version, exercises, self.cells)

    def exercise(self, id):
        """The CheckData of one of its exercises.

        Raises
        ------
        CheckFileError : the file is damaged
        """
        try:
            return self._exercise(id)
        except MasterError as error:
            raise CheckFileError(f"{self.path.name}: {error}") from error
        except DAMAGED as error:
            raise damaged(self.path, error) from error

    def _exercise(self, id):
        entry = self.entries[id]
        fields = {name: entry[name] for name in PLAIN_FIELDS}
        fields = {name: tuple(value) if isinstance(value, list) else value for name, value in fields.items()}
        cases = tuple(self._case(id, entry, case) for case in entry["cases"])
        mistakes = tuple(
            CheckMistake(
                mistake["name"],
                mistake["says"],
                {
                    case_id: tuple(self._result(result) for result in results)
                    for case_id, results in mistake["results"].items()
                },
            )
            for mistake in entry["mistakes"]
        )
        return CheckData(id=id, cases=cases, mistakes=mistakes, **fields)

    def _case(self, id, entry, case):
        if "inputs" in case:
            calls_arguments = self._made_again(id, entry, case)
        else:
            calls_arguments = [tuple(decode(self.values[key]) for key in keys) for keys in case["arguments"]]
        results = [CallResult(value=self.values[key]) for key in case["expected"]]
        calls = tuple(ExpectedCall(*pair) for pair in zip(calls_arguments, results, strict=True))
        return CheckCase(**{name: case[name] for name in CASE_FIELDS}, calls=calls)

    def _made_again(self, id, entry, case):
        """The arguments of a case's calls, from its source."""
        fields = {name: case[name] for name in CASE_FIELDS}
        declared_case = Case(**fields, hidden=False, source=case["inputs"], line=0)
        declared = Exercise(
            id,
            entry["function"],
            entry["title"],
            entry["time_limit"],
            tuple(entry["allowed"]),
            case["tolerance"],
            entry["practice"],
            *("", "", (), "", ""),
            master=self.path,
            given=tuple(entry["given"]),
            preparation=entry["preparation"],
        )
        return declared.arguments(declared_case)

    def _result(self, entry):
        value = self.values[entry["value"]] if "value" in entry else None
        fields = {name: entry[name] for name in RESULT_FIELDS if name in entry}
        return CallResult(value, **fields | {"changed": tuple(entry.get("changed", ()))})


def damaged(path, error):
    """The CheckFileError for a file that cannot be read as what it is.

    Parameters
    ----------
    path : Path
    error : Exception

    Returns
    -------
    CheckFileError
    """
    reason = error.strerror if isinstance(error, OSError) else f"{type(error).__name__}: {error}"
    place = f"{path.parent.name}/{path.name}"
    return CheckFileError(
        f"{place} cannot be read ({str(reason)[:120]}); take the folder {path.parent.name}/ again"
        " from the course or from your teacher"
    )


def read_lesson_file(path):
    """The JSON of a checks or solutions file, as a dict.

    Parameters
    ----------
    path : Path

    Returns
    -------
    dict

    Raises
    ------
    CheckFileError : it is missing or damaged, or of a newer format
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        number = data["format"]
        if number != FORMAT and isinstance(number, int) and number > FORMAT:
            raise CheckFileError(
                f"{path.parent.name}/{path.name} was made by a newer version of the course (format {number},"
                f" this one reads {FORMAT}): update the course"
            )
        if number != FORMAT:
            raise ValueError(f"format {number!r}, expected {FORMAT}")
    except CheckFileError:
        raise
    except (OSError, *DAMAGED) as error:
        raise damaged(path, error) from error
    return data


def read_check_file(path):
    """Read a checks file; one that has not changed is read once.

    Parameters
    ----------
    path : Path

    Returns
    -------
    CheckFile

    Raises
    ------
    CheckFileError : it is missing or damaged, or of a newer format
    """
    try:
        status = path.stat()
    except OSError as error:
        raise damaged(path, error) from error
    return _read_check_file(path, (status.st_mtime_ns, status.st_size))


@lru_cache(maxsize=64)
def _read_check_file(path, _version):
    data = read_lesson_file(path)
    try:
        cells, entries, values = (dict(data[name]) for name in ("cells", "exercises", "values"))
        return CheckFile(path, str(data["lesson"]), str(data["version"]), cells, entries, values)
    except DAMAGED as error:
        raise damaged(path, error) from error


# ---------------------------------------------------------------- finding


def checks_folders(beside=None):
    """The folders that hold checks files, those that are searched first in front.

    These are the folders of IMGPROC_COURSE_CHECKS, checks/ in the current folder, and the checkout's
    notebooks/checks.

    Parameters
    ----------
    beside : Path of the folder whose checks/ takes the place of the current folder's

    Returns
    -------
    list of Path, those that exist
    """
    chosen_folders = [Path(part) for part in os.environ.get(CHECKS_VARIABLE, "").split(os.pathsep) if part]
    checkout = Path(__file__).resolve().parents[3] / "notebooks"
    folders = [*chosen_folders, (beside or Path.cwd()) / CHECKS, checkout / CHECKS]
    return [folder for folder in dict.fromkeys(folders) if folder.is_dir()]


def find_check_file(id):
    """The checks file that has this exercise.

    Parameters
    ----------
    id : str

    Returns
    -------
    CheckFile

    Raises
    ------
    CheckFileError : no checks files, no such exercise (the message names the nearest id), or a damaged file
    """
    paths = [path for folder in checks_folders() for path in sorted(folder.glob("*.json"))]
    if not paths:
        raise CheckFileError(NO_CHECKS)
    name = json.dumps(str(id))
    for path in paths:
        # A file without this id is not parsed: it may be damaged.
        if name in _text_of(path):
            file = read_check_file(path)
            if id in file.entries:
                return file
    raise CheckFileError(f"there is no exercise {id!r}; {_advice(id, paths)}")


def _text_of(path):
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise damaged(path, error) from error


def _advice(id, paths):
    ids = []
    for path in paths:
        try:
            ids += read_check_file(path).ids
        except CheckFileError as error:
            return str(error)  # the exercise may be in this file
    nearest = difflib.get_close_matches(str(id), ids, n=1)
    return f"did you mean {nearest[0]!r}?" if nearest else f"there are: {', '.join(ids) or 'none'}"


def find_check_data(id):
    """The CheckData of an exercise, from the files that the lessons carry.

    Parameters
    ----------
    id : str

    Returns
    -------
    CheckData

    Raises
    ------
    CheckFileError : as `find_check_file`
    """
    return find_check_file(id).exercise(id)
