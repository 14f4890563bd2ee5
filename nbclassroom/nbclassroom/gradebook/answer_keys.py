"""The answer keys that submissions are graded with: one key per version of a lesson."""

import hmac
from itertools import chain

from ..autograder.answer_key import load_key
from . import submission_reader

SHORTEST_SOLUTION = 60  # tokens; independent learners often write the same short solution


class AnswerKeys:
    """The keys in some folders; KeyFolderError: one is none.

    `versions` are {lesson: its Lesson in each key that has it}, `lessons` {lesson: the first of these}.
    """

    def __init__(self, folders):
        self.keys = list(map(load_key, folders))
        self.versions: dict[str, list] = {}
        self._solution_shapes: dict[str, dict] = {}
        for name, lesson in chain.from_iterable(key.lessons.items() for key in self.keys):
            self.versions.setdefault(name, []).append(lesson)
        self.lessons = {name: versions[0] for name, versions in self.versions.items()}

    def key_for(self, lesson, version):
        """The key made from this version of a lesson, or the lesson's default key."""
        candidates = [key for key in self.keys if lesson in key.lessons]
        return min(candidates, key=lambda key: key.lessons[lesson].version != version)

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
