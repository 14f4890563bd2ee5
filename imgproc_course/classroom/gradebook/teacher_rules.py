"""What a teacher adds to the autograder's points, assigned to learners: deadlines and decisions."""

from imgproc_course.classroom.gradebook.anonymity import anonymous_id
from imgproc_course.classroom.gradebook.csv_table import TableError
from imgproc_course.classroom.gradebook.deadlines import Deadlines, read_late_policy
from imgproc_course.classroom.gradebook.roster import names_in_roster
from imgproc_course.classroom.gradebook.teacher_tables import (
    by_learner,
    read_decisions,
    read_extensions,
)


class TeacherRules:
    """The teacher's deadline, late policy, extensions and decisions; those two are Paths of tables.

    After `assign`: names {name or anonymous id: the learner's name}, deadlines (Deadlines), and
    decisions {learner's name: list of Decision}. Mistakes in a table or in the policy are ValueErrors.
    """

    def __init__(self, answer_keys, *, deadline=None, late=None, extensions=None, decisions=None):
        if late and not deadline:
            raise ValueError("--late needs the deadline: --deadline 2026-12-01T23:59")
        self._answer_keys, self._deadline = answer_keys, deadline
        self._policy = read_late_policy(late) if late else None
        self._extensions = read_extensions(extensions, answer_keys) if extensions else []
        self._decisions = read_decisions(decisions, answer_keys) if decisions else []

    def assign(self, learners, roster=()):
        """Assign extensions and decisions to learners, who are read but not yet graded.

        A row about a person of the roster who handed in nothing waits for the submission. TableError:
        nobody has a name, or a decision is on an exercise that cannot be graded.
        """
        self.names = {anonymous_id(learner.name, self._answer_keys): learner.name for learner in learners}
        self.names |= {learner.name: learner.name for learner in learners}
        known_names = names_in_roster(roster, learners) | self.names
        extensions = by_learner(self._extensions, known_names)
        self.deadlines = Deadlines(self._deadline, self._policy, extensions)
        self.decisions = by_learner(self._decisions, known_names)
        for learner in learners:
            for decision in self.decisions.get(learner.name, ()):
                _require_exercises(decision, learner.submissions.get(decision.lesson))


def _require_exercises(decision, submission):
    """Refuse a decision on a single exercise of a lesson that has none to decide on."""
    if decision.exercise and (submission is None or not submission.answers_digest):
        problem = "was not submitted" if submission is None else "could not be graded"
        text = f"{decision.learner}'s {decision.lesson} {problem}, so it has no exercises"
        raise TableError(f"{decision.place}: {text}; leave the exercise empty")
