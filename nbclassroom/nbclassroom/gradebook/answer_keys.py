"""The answer keys that submissions are graded with: one key per version of a lesson."""

import hmac
from typing import Any

from ..autograder.answer_key import load_key
from . import submission_reader

SHORTEST_SOLUTION = 60  # tokens; independent learners often write the same short solution


class AnswerKeys:
    """The keys in some folders; KeyFolderError: one is none. `lessons` is {name: Lesson of the first key}."""

    def __init__(self, folders):
        self.keys = list(map(load_key, folders))
        self.lessons: dict[str, Any] = {}
        self._solution_shapes: dict[str, dict] = {}
        for key in self.keys:  # the first one that has a lesson counts
            self.lessons |= key.lessons | self.lessons

    def key_for(self, lesson, version):
        """The key made from this version of a lesson, or the lesson's default key."""
        candidates = [key for key in self.keys if lesson in key.lessons]
        return min(candidates, key=lambda key: key.lessons[lesson].version != version)

    def versions(self, lesson):
        """The Lesson of each key that has it."""
        return [key.lessons[lesson] for key in self.keys if lesson in key.lessons]

    def equal_to_solution(self, lesson, shapes):
        """The ids of a lesson's exercises with points whose shape is that of a long solution, sorted."""
        graded = {one.id for one in self.lessons[lesson].exercises if not one.practice}
        if lesson not in self._solution_shapes:
            self._solution_shapes[lesson] = submission_reader.shapes(self.solutions(lesson))
        solutions = self._solution_shapes[lesson]
        long = {id: shape for id, shape in shapes.items() if shape[1] >= SHORTEST_SOLUTION}
        return sorted(id for id in graded & long.keys() if long[id] == solutions.get(id))

    def solutions(self, lesson):
        keys = [key for key in self.keys if lesson in key.lessons]
        return {id: source for key in keys for id, source in key.solutions(lesson).items()}

    def anonymous_id(self, learner):
        """What only the first key's owner can compute from a name, and the same in every run."""
        digest = hmac.digest(self.keys[0].digest.encode(), learner.encode(), "sha256")
        return f"learner-{digest.hex()[:10]}"

    def key_of(self, digest):
        return next(key for key in self.keys if key.digest == digest)
