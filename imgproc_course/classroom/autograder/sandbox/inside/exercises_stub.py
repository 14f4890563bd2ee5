"""Replaces `imgproc_course.exercises` inside the sandbox, because an answer cell may import from it."""


def check(exercise_id, function):
    """Do nothing: the autograder has check cells of its own."""


def compare_guess(guess, value, unit=""):
    """Do nothing: a guess is not graded."""


def exercise(*_arguments, **_keywords):
    """Do nothing: the declaration was read from the master."""


def hint(exercise_id, step=None):
    """Do nothing: hints are for the learner's own notebook."""


def solution(exercise_id, give_up=False):
    """Do nothing: the sandbox holds no solution."""
