"""A learner's progress: honest tries, exercises that pass, hints seen. It is kept in .progress.json.

The file is written only by a notebook that a learner runs in JupyterLab, in a folder of working copies or a
hand-out (both hold .course.json). Elsewhere (nbval, tests, build, grading), and where the folder is
read-only, progress lasts as long as the process.
"""

import ast
import contextlib
import hashlib
import itertools
import json
import marshal
import os
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

from .atomic_write import write_file
from .running import cells_of, codes_of

PROGRESS, LOCK = ".progress.json", ".progress.lock"
LEARNERS_FOLDER = ".course.json"  # a folder with this file is a learner's
_DAMAGED = (ValueError, RecursionError)
_MOST_TRIES = 50
LAB_VARIABLE = "JPY_SESSION_NAME"  # Jupyter's server sets it for the kernel of a notebook
TEST_VARIABLE = "PYTEST_CURRENT_TEST"  # pytest sets it, so nbval and our builds have it


@dataclass(frozen=True)
class ExerciseProgress:
    """What a learner did in one exercise: digests of the wrong `tries`, the highest step of `hint`.

    `ticks` are the lines of a rubric that the learner sees in a written answer, from 1; None: not compared.
    """

    passed: bool = False
    tries: tuple[str, ...] = ()
    hints: int = 0
    ticks: tuple[int, ...] | None = None

    def __or__(self, other):
        tries = tuple(dict.fromkeys((*self.tries, *other.tries)))[:_MOST_TRIES]
        ticks = self.ticks if other.ticks is None else other.ticks
        return ExerciseProgress(self.passed or other.passed, tries, max(self.hints, other.hints), ticks)


@dataclass(frozen=True)
class _ProgressFile:
    format: Literal[1]
    exercises: dict[str, ExerciseProgress]


_of_this_process: dict[str, ExerciseProgress] = {}  # by the ids of the exercises


def learners_folder():
    """The folder in which this process keeps progress, or None."""
    is_learners_run = LAB_VARIABLE in os.environ and TEST_VARIABLE not in os.environ
    folder = Path.cwd()
    return folder if is_learners_run and (folder / LEARNERS_FOLDER).is_file() else None


def read_progress(folder):
    """{exercise id: ExerciseProgress} as kept in a folder; empty if there is none, or the file is damaged."""
    try:
        return _parse((Path(folder) / PROGRESS).read_bytes())
    except (OSError, *_DAMAGED):
        return {}


def progress_of(exercise_id):
    """The ExerciseProgress of one exercise: what its folder keeps, and what this process knows."""
    folder = learners_folder()
    stored = read_progress(folder) if folder else {}
    nothing = ExerciseProgress()
    return stored.get(exercise_id, nothing) | _of_this_process.get(exercise_id, nothing)


def note_progress(exercise_id, news):
    """Add news to the ExerciseProgress of one exercise."""
    earlier, folder = progress_of(exercise_id), learners_folder()
    progress = _of_this_process[exercise_id] = earlier | news
    if folder is not None and progress != earlier:
        with contextlib.suppress(OSError):  # a read-only folder: progress lasts as long as the kernel
            _write(folder, exercise_id, progress)


def _write(folder, exercise_id, progress):
    """Change the file; another notebook may change it at the same time."""
    path = folder / PROGRESS
    with one_at_a_time(folder / LOCK):
        entries = _read_or_move_aside(path)
        entries[exercise_id] = entries.get(exercise_id, ExerciseProgress()) | progress
        file = _ProgressFile(1, dict(sorted(entries.items())))
        write_file(path, json.dumps(asdict(file), indent=1) + "\n")


def _read_or_move_aside(path):
    try:
        return _parse(path.read_bytes())
    except FileNotFoundError:
        return {}
    except _DAMAGED:
        asides = (path.with_name(f".progress.damaged-{number}.json") for number in itertools.count(1))
        aside = next(aside for aside in asides if not aside.exists())
        path.rename(aside)
        print(f"Your progress in {PROGRESS} could not be read: it begins anew. The old file is {aside.name}.")
        return {}


def _parse(data):
    """The entries of a progress file; one of _DAMAGED is raised if it is damaged."""
    import msgspec  # here, because the kernels that grade import this module too

    return msgspec.json.decode(data, type=_ProgressFile).exercises


@contextlib.contextmanager
def one_at_a_time(path):
    """A lock: the second process that uses it waits for the first."""
    with path.open("a+b") as file:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_LOCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX)
        yield


def digest_of(answer):
    """16 hexadecimal digits of an answer and its cell; comments and spacing make no difference."""
    # From Python 3.13 on, "<string>" has the lines of `python -c`, which are not those of the answer.
    codes, cells = codes_of(answer), cells_of(answer) | {"<string>": ""}
    source = "\n".join(filter(None, cells.values()))
    with contextlib.suppress(SyntaxError, ValueError, RecursionError):
        source = source and ast.dump(ast.parse(source))
    names = [code.co_qualname for code in codes.values()]
    content = source.encode("utf-8", "surrogatepass") or b"".join(map(marshal.dumps, codes.values()))
    return hashlib.sha256(repr(names).encode() + content).hexdigest()[:16]
