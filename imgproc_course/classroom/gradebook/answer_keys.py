"""The answer keys that submissions are graded with: one key per version of a lesson."""

import contextlib
import json

from ..autograder.answer_key import HANDED_OUT, SOLUTIONS, load_key, reading
from ..exercises.check_data import LessonDescription


class AnswerKeys:
    """The keys that a folder of submissions is graded with.

    One key per version of a lesson; the first that has a lesson is the default for it, and `lessons` is
    {name: KeyLesson of the default key}.
    """

    def __init__(self, keys):
        self.keys = list(keys)
        self.lessons = {}
        for key in self.keys:
            for name, lesson in key.lessons.items():
                self.lessons.setdefault(name, lesson)
        self._cells = {key.digest: _read(key.path, HANDED_OUT) for key in self.keys}
        self._solutions = {key.digest: _read(key.path, SOLUTIONS) for key in self.keys}

    def key_for(self, lesson, version):
        """The key made from this version of a lesson, or the lesson's default key."""
        candidates = [key for key in self.keys if lesson in key.lessons]
        return next((key for key in candidates if key.lessons[lesson].version == version), candidates[0])

    def functions(self, lesson):
        """{(id of an exercise, the function that it asks for)} of a lesson, in any version."""
        versions = [key.lessons[lesson] for key in self.keys if lesson in key.lessons]
        return {(exercise.id, exercise.function) for version in versions for exercise in version.exercises}

    def describe(self, lesson, version):
        """The LessonDescription of a lesson, from the key for this version."""
        key = self.key_for(lesson, version)
        key_lesson, cells = key.lessons[lesson], self._cells[key.digest].get(lesson, {})
        return LessonDescription(lesson, key_lesson.version, key_lesson.exercises, cells)

    def solutions(self, lesson):
        """{exercise id: solution} of a lesson."""
        return {
            exercise.id: self._solutions[key.digest][exercise.id]
            for key in self.keys
            if lesson in key.lessons
            for exercise in key.lessons[lesson].exercises
            if exercise.id in self._solutions[key.digest]
        }

    def key_of(self, digest):
        """The key with this digest."""
        return next(key for key in self.keys if key.digest == digest)


def load_keys(folders):
    """Read the AnswerKeys in some folders; KeyFolderError: one of them is not an answer key."""
    return AnswerKeys([load_key(folder) for folder in folders])


def _read(folder, name):
    """The content of a file of a key, a dict; empty if the key does not have it."""
    with reading(folder / name), contextlib.suppress(FileNotFoundError):
        return dict(json.loads((folder / name).read_text(encoding="utf-8")))
    return {}
