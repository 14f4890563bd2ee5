"""The answer key: what answers are compared with. `make_answer_key` makes it from a secret seed.

A key is a folder that learners must not get. It holds the files that lessons carry (`exercises.check_files`),
with the hidden cases, and with inputs from the secret seed, which is in none of them:

    checks/<lesson>.json      exercises, cases, arguments, expected values, known mistakes
    solutions/<lesson>.json   an answer that equals one is reported

Public cases get inputs from this seed too, so that nothing in the course's repository gives an answer away.
"""

import contextlib
import hashlib
import re
import secrets
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from .. import course
from ..exercises import check_files
from ..exercises.check_files import Lesson
from ..exercises.lesson import Exercise

_SEED = 32  # hexadecimal, drawn by chance: 128 bits


class KeyFolderError(ValueError):
    """A key cannot be read or written; the message is one line with the remedy."""


@dataclass(frozen=True)
class Key:
    path: Path
    digest: str  # identifies it
    lessons: dict[str, Lesson]  # by their names, in the order of the course

    def exercise(self, id: str) -> Exercise | None:
        every = (exercise for lesson in self.lessons.values() for exercise in lesson.exercises)
        return next((exercise for exercise in every if exercise.id == id), None)

    def solutions(self, lesson: str) -> dict[str, str]:
        """{exercise id: solution} of a lesson."""
        path = self.path / check_files.SOLUTIONS / f"{lesson}.json"
        with _reading_key(self.path), check_files.reading(path):
            entries = check_files.read_lesson_file(path)["solutions"]
            return {id: str(entry["code"]) for id, entry in entries.items()}


@contextlib.contextmanager
def _reading_key(path):
    try:
        yield
    except check_files.CheckFileError as error:
        raise KeyFolderError(f"{path}: {error.problem}; make the key again") from error


def load_key(path: Path | str) -> Key:
    """Read the Key in a folder; KeyFolderError: there is none that grading can use."""
    path = Path(path).resolve()
    paths = sorted((path / check_files.CHECKS).glob("*.json"))
    command = f"{course.command} key --out {path.name}"
    if not paths:
        raise KeyFolderError(f"{path}: there is no key; make one: {command}")
    digest, lessons = hashlib.sha256(), []
    with _reading_key(path):
        for file_path in paths:
            file = check_files.read_check_file(file_path)
            with check_files.reading(file_path):
                is_key = all(map(_is_of_key, file.entries.values()))
                digest.update(file_path.read_bytes())
            if not is_key:
                raise KeyFolderError(f"{path}: these are checks as learners have them; make a key: {command}")
            _ = file.exercises  # read here: one of them may be damaged
            lessons.append(file)
    lessons.sort(key=lambda lesson: (lesson.number, lesson.name))
    return Key(path, digest.hexdigest(), {lesson.name: lesson for lesson in lessons})


@lru_cache(maxsize=32)
def expected_key(folder, digest):
    """The Key in a folder; KeyFolderError, ValueError: there is none, or another one than expected."""
    key = load_key(folder)
    if key.digest != digest:
        raise ValueError(f"{folder}: this is another key than the one that grading began with")
    return key


def _is_of_key(entry):
    """Whether a stored exercise has its hidden cases, and nothing that reading would run."""
    hidden = [case for case in entry["cases"] if case.get("hidden")]
    is_whole = entry["practice"] or len(hidden) == entry["hidden_count"]
    return is_whole and not any("inputs" in case for case in entry["cases"])


def secret_seed(seed, path):
    """The seed, if it is not None, or that in a file which only its owner can read; it may have to be made.

    KeyFolderError for a seed that can be guessed: nobody can tell how many bits are in a phrase.
    """
    if seed is None and not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch(mode=0o600)
        path.write_text(f"{secrets.token_hex(_SEED // 2)}\n", encoding="utf-8")
    seed = path.read_text(encoding="utf-8").strip() if seed is None else seed
    if not re.fullmatch(rf"[0-9a-fA-F]{{{_SEED},}}", seed) or seed.isdecimal():
        expected = f"at least {_SEED} hexadecimal digits drawn by chance, 128 bits"
        remedy = "leave --seed out, and a seed is made, or draw one: openssl rand -hex 16"
        raise KeyFolderError(f"this seed can be guessed: expected {expected}; {remedy}")
    return seed
